"""The least acceleration for a gap, against grids of the same ranges."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from earthquakes.rigs import noise
from samples import sample
from vibroimpact.datasets.stops import over_stops

MASS = 550.0
RIG = vi.Oscillator(
    MASS,
    vi.Isolator.from_period(MASS, 1.2, 0.1),
    vi.Bumper("100 kN/m", "1 kN s/m", "20 mm"),
    vi.Bumper("100 kN/m", "1 kN s/m", "20 mm"),
)
RANGES = {"stops.stiffness": (5e3, 5e5), "stops.damping": (100.0, 2e4)}
RECORDS = [noise(seed, 1.5, 150) for seed in (1, 2)]
NODES = sample(30, 14)


def _grid(shaking):
    return vi.design_chart(
        RIG, {name: np.geomspace(*ends, NODES) for name, ends in RANGES.items()}, records=shaking
    )


@pytest.mark.parametrize("limits", [{}, {"peak_force": "900 N"}, {"penetration": "8 mm"}])
def test_no_node_of_a_grid_is_better(limits: dict) -> None:
    grid = _grid(RECORDS)
    design = vi.least_acceleration(RIG, RANGES, records=RECORDS, limits=limits)
    kept = grid["peak_acceleration"]
    for name, limit in {"peak_force": 900.0, "penetration": 8e-3}.items():
        if name in limits:
            assert (design[name] <= limit).all()
            kept = kept.where(over_stops(grid[name]) <= limit)
    best = float(kept.min())
    assert float(design["peak_acceleration"]) <= best * (1.0 + 1e-3)
    # What is said of the design is what it does.
    there = vi.design_chart(
        RIG, {name: [float(design[name])] for name in RANGES}, records=RECORDS
    ).squeeze(drop=True)
    for name in ("peak_acceleration", "peak_displacement", "peak_force", "penetration"):
        np.testing.assert_allclose(there[name], design[name], rtol=1e-12)


def test_of_sines() -> None:
    """One parameter, whose valley a grid shows."""
    ranges = {"stops.damping": RANGES["stops.damping"]}
    values = np.geomspace(*RANGES["stops.damping"], 41)
    grid = vi.design_chart(vi.Rig(RIG, "0.05 g"), {"stops.damping": values})["peak_acceleration"]
    design = vi.least_acceleration(vi.Rig(RIG, "0.05 g"), ranges)
    least = int(grid.values.argmin())
    assert 0 < least < 40
    assert float(design["peak_acceleration"]) == pytest.approx(float(grid.min()), rel=2e-3)
    assert values[least - 1] < float(design["stops.damping"]) < values[least + 1]


def test_a_wide_gap_leaves_nothing_to_choose() -> None:
    need = float(vi.required_gap(RIG, records=RECORDS)["common_gap"])
    untouched = (
        "the best design touches no stop, so the properties of the stops do not matter; the "
        "design stays below the limit of peak force: 0 N of 1 MN"
    )
    with pytest.warns(vi.InputWarning, match=f"^least_acceleration: {untouched}"):
        design = vi.least_acceleration(
            RIG, records=RECORDS, gap=need + 1e-9, limits={"peak_force": "1 MN"}
        )
    assert design.attrs["notes"].splitlines()[:2] == untouched.split("; ")
    free = max(
        float(vi.seismic_response(vi.Rig(RIG.without_bumpers(), one))["peak_acceleration"])
        for one in RECORDS
    )
    assert float(design["hitting"]) == 0.0
    assert float(design["peak_acceleration"]) == pytest.approx(free, rel=1e-10)


def test_what_binds_and_what_does_not_is_noted() -> None:
    """A limit that is reached is not noted, one that is not is, and so is the end of a range."""
    limits = {"penetration": "2 mm", "peak_force": "1 MN"}
    design = vi.least_acceleration(RIG, RANGES, records=RECORDS, limits=limits)
    assert float(design["penetration"]) == pytest.approx(2e-3, rel=1e-2)
    (note,) = design.attrs["notes"].splitlines()
    assert note.startswith("the design stays below the limit of peak force: ")
    assert note.endswith(" N of 1 MN")
    stiff = {"stops.stiffness": (2e6, 3e6)}
    ended = vi.least_acceleration(RIG, stiff, records=RECORDS, gap="10 mm")
    assert ended.attrs["notes"] == "stops.stiffness lies at the lower end of its range, 2000 kN/m"


def test_it_is_repeatable() -> None:
    first, again = (vi.least_acceleration(RIG, records=RECORDS, gap="10 mm") for _ in range(2))
    assert first.identical(again)
    assert first["stops.damping"].attrs["units"] == "N s m-1"
    assert float(first["evaluations"]) > 24


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ({"vary": {}}, "vary: no parameter; pass a dict of ranges by parameter, with at least one"),
        (
            {"vary": {"gap": 3.0}},
            r"vary\['gap'\]: 3.0; pass the lowest and the highest value of gap as \(low, high\)",
        ),
        (
            {"vary": {"gap": (2.0, 1.0)}},
            r"vary\['gap'\]: the first value, 2 m, is not below the second, 1 m",
        ),
        ({"vary": {"length": (1.0, 2.0)}}, "vary: 'length'"),
        ({"vary": {"frequency": (1.0, 2.0)}}, "vary: 'frequency' depends on the shaking"),
        ({"gap": "3 kg"}, "gap: '3 kg'"),
        ({"limits": {"speed": 1.0}}, "limits: 'speed' is unknown; use peak_displacement, "),
        ({"limits": {"peak_force": "3 m"}}, r"limits\['peak_force'\]: '3 m'"),
        (
            {"limits": {"peak_displacement": 1e-4}},
            r"limits\['peak_displacement'\]: no design that was tried meets this limit of 0.1 mm",
        ),
        ({"oscillator": RIG.without_bumpers()}, "vary: missing; .* has no stop"),
    ],
)
def test_wrong_input(arguments: dict, line: str) -> None:
    keywords = {"oscillator": RIG, "shaking": RECORDS[0], **arguments}
    with pytest.raises(vi.InputError, match=f"^{line}"):
        vi.least_acceleration(
            keywords.pop("oscillator"), records=keywords.pop("shaking"), **keywords
        )
