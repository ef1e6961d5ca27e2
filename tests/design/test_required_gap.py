"""The required gap, against gaps that are narrowed until something is hit."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from earthquakes.rigs import RIGS, noise

RIG = RIGS["bumpers"]


def _bisected(hits) -> float:
    """The gap (m) below which something is hit."""
    low, high = 1e-3, 4.0
    assert hits(low)
    assert not hits(high)
    while high - low > 1e-7 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if hits(middle) else (low, middle)
    return high


@pytest.mark.parametrize("name", ["bumpers", "bilinear", "curved", "friction"])
def test_of_a_record_by_bisection(name: str) -> None:
    record = noise(5, count=200)
    rig = RIGS[name]
    need = vi.required_gap(rig, records=record)
    for side in ("right", "left"):

        def hits(gap: float, side: str = side) -> bool:
            wall = vi.Bumper(500.0, 3.0, gap)
            one = rig.without_bumpers().replace(**{side: wall})
            motion = vi.simulate(vi.Rig(one, record), samples=1, tail="4 s")
            return bool(motion.sizes["event"])

        assert float(need["required_gap"].sel(stop=side)) == pytest.approx(
            _bisected(hits), rel=1e-6
        )
    both = [float(need["required_gap"].sel(stop=side)) for side in ("right", "left")]
    assert float(need["common_gap"]) == max(both)


def test_of_sines_by_bisection() -> None:
    """Steady motion at the worst frequency, shifted by a constant force."""
    rig = RIG.replace(force=1.5)
    need = vi.required_gap(vi.Rig(rig, "0.1 g"))
    at = float(need["displacement_frequency"])
    xi, natural = rig.damping_ratio, rig.natural_frequency
    assert at == pytest.approx(natural * math.sqrt(1.0 - 2.0 * xi**2))
    for side in ("right", "left"):

        def hits(gap: float, side: str = side) -> bool:
            one = rig.without_bumpers().replace(**{side: vi.Bumper(500.0, 3.0, gap)})
            motion = vi.simulate(vi.Rig(one, vi.Harmonic("0.1 g", at)), 200, samples=1)
            return bool((motion["event_cycle"] > 190).any())

        assert float(need["required_gap"].sel(stop=side)) == pytest.approx(
            _bisected(hits), rel=1e-6
        )


@pytest.mark.parametrize("amplitude", ["0.1 g", "5 mm", "2 N"])
@pytest.mark.parametrize("ratio", [0.05, 0.5, 0.9])
@pytest.mark.parametrize("ends", [None, (0.3, 0.5), (0.9, 2.0)])
def test_no_frequency_needs_more(amplitude: str, ratio: float, ends) -> None:
    """Against the excursions of free flight on a fine grid of the range."""
    rig = vi.Oscillator(2.0, vi.Isolator.from_period(2.0, 1.4, ratio))
    need = vi.required_gap(vi.Rig(rig, amplitude), ends and {"frequency": ends})
    grid = np.geomspace(*(ends or (0.02, 60.0)), 4001)
    sweep = vi.sweep(vi.Rig(rig, amplitude), grid[::4], "forward", max_cycles=1, window=1)
    most = 0.5 * float(sweep["free_displacement_excursion"].max())
    assert float(need["common_gap"]) >= most * (1.0 - 1e-12)
    assert float(need["common_gap"]) == pytest.approx(most, rel=2e-2)


@pytest.mark.parametrize(
    ("vary", "line"),
    [
        ({"frequency": (2.0, 1.0)}, r"vary\['frequency'\]: the first value, 2 Hz, is not below"),
        ({"gap": (1.0, 2.0)}, "vary: 'gap'; the gap is required for one rig, so only 'frequency'"),
        (3, "vary: 3; pass a dict of ranges by parameter"),
    ],
)
def test_only_the_frequency_is_varied(vary, line: str) -> None:
    with pytest.raises(vi.InputError, match=f"^{line}"):
        vi.required_gap(vi.Rig(vi.Oscillator(2.0, vi.Isolator(10.0, 1.0)), 1.0), vary)


def test_of_curved_isolators_by_sweeps() -> None:
    """A weakly curved one is all but linear."""
    linear = vi.Oscillator(2.0, vi.Isolator(50.0, 1.5))
    curved = vi.Oscillator(2.0, vi.PolynomialIsolator(50.0, 1.5, 1e-6, 0.0))
    one, other = (vi.required_gap(vi.Rig(rig, 0.5)) for rig in (linear, curved))
    assert float(one["common_gap"]) == pytest.approx(float(other["common_gap"]), rel=1e-5)


def test_fractiles_of_records() -> None:
    records = [noise(seed, count=150) for seed in range(5)]
    every = vi.required_gap(RIG, records=records)
    right, left = (every["displacement_max"].values, -every["displacement_min"].values)
    wide = np.maximum(right, left)
    assert every["record"].values.tolist() == ["0", "1", "2", "3", "4"]
    assert float(every["common_gap"]) == wide.max()
    middle = vi.required_gap(RIG, records=records, fractile=0.5)
    assert float(middle["common_gap"]) == pytest.approx(np.sort(wide)[2])
    assert float(middle["required_gap"].sel(stop="left")) == pytest.approx(np.sort(left)[2])
    assert float(middle["required_gap"].sel(stop="right")) == pytest.approx(np.sort(right)[2])
    # Nothing is hit from there on, and something is below.
    for share, gap in ((0.0, float(every["common_gap"])), (0.2, np.sort(wide)[-1] - 1e-6)):
        data = vi.design_chart(
            RIG, {"gap": [gap + (1e-12 if share == 0.0 else 0.0)]}, records=records
        )
        assert float(data["hitting"][0]) == share


def test_refused() -> None:
    undamped = vi.Oscillator(2.0, vi.Isolator(50.0, 0.0))
    with pytest.raises(vi.InputError, match=r"natural frequency of an undamped"):
        vi.required_gap(vi.Rig(undamped, 0.1))
    away = vi.Oscillator(2.0, vi.PolynomialIsolator(50.0, 0.5, -50.0, 0.0))
    with pytest.raises(
        vi.InputError, match=r"^shaking: without stops the motion of the mass grows without bound"
    ):
        vi.required_gap(vi.Rig(away, 8.0))
