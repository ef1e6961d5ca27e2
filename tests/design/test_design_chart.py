"""Design charts: closed forms, sweeps and responses by themselves, and what beats what."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

import vibroimpact as vi
from earthquakes.rigs import RIGS, noise
from samples import sample
from vibroimpact.design.pareto import non_dominated

BUILDING = vi.Oscillator(
    "5000 t",
    vi.Isolator.from_period("5000 t", period="2.5 s", damping_ratio=0.15),
    vi.Bumper("500 MN/m", "5 MN s/m", gap="300 mm"),
    vi.Bumper("500 MN/m", "5 MN s/m", gap="300 mm"),
)
RECORDS = {"a": noise(1, 5.0, 200), "b": noise(2, 6.0, 150), "c": noise(3, 4.0, 180)}
PEAKS = ("peak_displacement", "peak_acceleration", "peak_force")


def test_without_stops_it_is_the_closed_form() -> None:
    """u = A/(2ξ√(1−ξ²) ω0²); |ü + A_t| is largest at r² = (√(1 + 8ξ²) − 1)/(4ξ²)."""
    free = BUILDING.without_bumpers()
    periods, ratios = [1.5, 2.5], [0.05, 0.15, 0.4]
    data = vi.design_chart(vi.Rig(free, 0.4), {"isolator_period": periods, "damping_ratio": ratios})
    assert data["peak_displacement"].dims == ("isolator_period", "damping_ratio")
    for period in periods:
        for xi in ratios:
            one = data.sel(isolator_period=period, damping_ratio=xi)
            omega = 2.0 * math.pi / period
            swing = 0.4 / (2.0 * xi * math.sqrt(1.0 - xi**2) * omega**2)
            r2 = (math.sqrt(1.0 + 8.0 * xi**2) - 1.0) / (4.0 * xi**2)
            damped = 4.0 * xi**2 * r2
            size = 0.4 * math.sqrt((1.0 + damped) / ((1.0 - r2) ** 2 + damped))
            # The grid misses a smooth maximum by the square of a 64th of its step.
            assert float(one["peak_displacement"]) == pytest.approx(swing, rel=1e-5)
            assert float(one["peak_acceleration"]) == pytest.approx(size, rel=1e-5)
            at = math.sqrt(1.0 - 2.0 * xi**2) / period
            assert float(one["displacement_frequency"]) == pytest.approx(at, abs=1e-3 / period)
            assert float(one["acceleration_frequency"]) == pytest.approx(
                math.sqrt(r2) / period, abs=1e-3 / period
            )
    assert not data["hitting"].any()
    assert not data["peak_force"].any()


@pytest.mark.parametrize(("ratio", "gap"), [(3.0, 0.3), (30.0, 0.7), (8.0, 0.1)])
def test_sines_against_a_fine_sweep(ratio: float, gap: float) -> None:
    """A sweep of steps 20 times as fine over the whole range finds no more, and no less."""
    rig = vi.from_dimensionless(ratio, gap, 0.02, 0.15)
    data = vi.design_chart(rig, {"damping_ratio": [0.15]}).isel(damping_ratio=0)
    natural = rig.oscillator.natural_frequency
    grid = natural * np.arange(0.4, 4.0, sample(0.001, 0.004))
    fine = vi.sweep(rig, grid)
    for name, high, low in (
        ("peak_displacement", "displacement_max", "displacement_min"),
        ("peak_acceleration", "acceleration_max", "acceleration_min"),
    ):
        largest = float(np.maximum(fine[high], -fine[low]).max())
        assert float(data[name]) == pytest.approx(largest, rel=2e-4)
        assert float(data[name]) > largest * (1.0 - 1e-6)
    reach = float(data["peak_displacement"]) - rig.oscillator.right.gap
    assert float(data["penetration"]) == pytest.approx(reach)
    assert float(data["hitting"]) == 1.0
    # The motions of the sweep, followed from contact to contact.
    force = 0.0
    largest = fine["acceleration_max"].max("direction").values.argmax()
    for k in range(largest - 12, largest + 13, sample(1, 4)):
        for direction in ("forward", "backward"):
            start = fine["section"].isel(frequency=k).sel(direction=direction)
            shaken = vi.Harmonic(rig.amplitude, float(grid[k]))
            motion = vi.simulate(vi.Rig(rig.oscillator, shaken), 4, start=start, samples=1)
            peaks = vi.contacts(motion)["contact_peak_force"].values
            force = max(force, *peaks[np.isfinite(peaks)], 0.0)
    assert float(data["peak_force"].max()) == pytest.approx(force, rel=5e-3)
    assert float(data["peak_force"].max()) > force * (1.0 - 1e-6)


@pytest.mark.parametrize("name", ["bumpers", "walls", "bilinear", "curved", "preloaded"])
def test_records_against_responses_one_by_one(name: str) -> None:
    rig = RIGS[name]
    gaps = [0.02, 0.05]
    data = vi.design_chart(rig, {"gap": gaps}, records=RECORDS, fractile=0.5)
    for gap in gaps:
        moved = rig.replace(
            **{side: getattr(rig, side).replace(gap=gap) for side in ("right", "left")}
        )
        responses = [vi.seismic_response(vi.Rig(moved, record)) for record in RECORDS.values()]
        for peak in PEAKS:
            middle = np.sort([one[peak].values for one in responses], axis=0)[1]
            np.testing.assert_allclose(data[peak].sel(gap=gap), middle, rtol=1e-10)
        deep = sorted(max(float(one["peak_displacement"]) - gap, 0.0) for one in responses)[1]
        assert float(data["penetration"].sel(gap=gap)) == pytest.approx(deep, rel=1e-9)
        hits = sum(bool(one["impact_count"].any()) for one in responses) / 3.0
        assert float(data["hitting"].sel(gap=gap)) == pytest.approx(hits)
    largest = vi.design_chart(rig, {"gap": gaps}, records=RECORDS)
    assert (largest["peak_displacement"] >= data["peak_displacement"]).all()


def test_what_no_other_beats_on_the_whole_grid() -> None:
    data = vi.design_chart(
        BUILDING,
        {"gap": np.linspace(0.01, 0.3, 8), "stops.stiffness": np.geomspace(1e7, 1e9, 6)},
        records=RECORDS,
    )
    u, a = (data[name].values.ravel() for name in PEAKS[:2])
    by_hand = [
        not any((u <= u[i]) & (a <= a[i]) & ((u < u[i] - 1e-9) | (a < a[i] - 1e-9)))
        and not any(np.isclose(u[:i], u[i], 1e-9) & np.isclose(a[:i], a[i], 1e-9))
        for i in range(len(u))
    ]
    assert data["pareto"].values.ravel().tolist() == by_hand
    assert 2 < sum(by_hand) < len(u)


def test_what_exceeds_a_limit_beats_nobody() -> None:
    vary = {"gap": np.linspace(0.01, 0.3, 8), "stops.stiffness": np.geomspace(1e7, 1e9, 6)}
    every = vi.design_chart(BUILDING, vary, records=RECORDS)
    limits = {"penetration": "10 mm", "peak-force": 2e7}
    data = vi.design_chart(BUILDING, vary, records=RECORDS, limits=limits)
    within = ((every["penetration"] <= 0.01) & (every["peak_force"] <= 2e7).all("stop")).values
    assert 0 < within.sum() < within.size
    np.testing.assert_array_equal(data["within_limits"], within)
    for name in PEAKS:
        np.testing.assert_array_equal(data[name], every[name])
    assert not data["pareto"].values[~within].any()
    kept = non_dominated(*(data[name].values[within] for name in PEAKS[:2]))
    np.testing.assert_array_equal(data["pareto"].values[within], kept)
    assert (data["pareto"] & ~every["pareto"]).any()
    assert json.loads(data.attrs["parameters"])["limits"] == {
        "penetration": 0.01,
        "peak_force": 2e7,
    }
    none = vi.design_chart(
        BUILDING, {"gap": [0.01]}, records=RECORDS, limits={"peak_displacement": 1e-6}
    )
    assert not none["pareto"].any()


def test_designs_that_hit_nothing_count_once() -> None:
    data = vi.design_chart(
        BUILDING, {"gap": [2.0, 3.0], "stops.stiffness": [1e7, 1e8]}, records=RECORDS
    )
    assert not data["hitting"].any()
    assert data["pareto"].values.tolist() == [[True, False], [False, False]]


def test_threads_change_no_bit_and_it_is_saved(tmp_path) -> None:
    vary = {"gap": ["100 mm", "200 mm"], "stops.damping": [1e6, 1e7]}
    rig = vi.Rig(BUILDING, "0.05 g")
    one = vi.design_chart(rig, {**vary, "frequency": ("0.2 Hz", "0.8 Hz")}, threads=1)
    two = vi.design_chart(rig, {"frequency": (0.2, 0.8), **vary}, threads=2)
    assert one["pareto"].dims == ("gap", "stops.damping")
    assert one.identical(two)
    assert one["gap"].attrs["units"] == "m"
    assert json.loads(one.attrs["parameters"])["frequencies"] == [0.2, 0.8]
    vi.save(one, tmp_path / "design.nc")
    np.testing.assert_array_equal(vi.load(tmp_path / "design.nc")["pareto"], one["pareto"])


def test_what_has_no_bound_is_infinite() -> None:
    soft = vi.Oscillator(2.0, vi.PolynomialIsolator(50.0, 0.5, -50.0, 0.0))
    with pytest.warns(RuntimeWarning, match=r"design: 1 of 2 designs could not be computed: "):
        data = vi.design_chart(vi.Rig(soft, 3.0), {"isolator.damping": [1.0, 40.0]})
    assert np.isinf(data["peak_acceleration"].values[0])
    assert np.isfinite(data["peak_acceleration"].values[1])
    assert data["pareto"].values.tolist() == [False, True]


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ({"vary": {}}, "vary: no parameter; pass a dict of values by parameter, with at least one"),
        ({"vary": {"length": [1.0]}}, "vary: 'length' is unknown; use frequency, "),
        (
            {"vary": {"amplitude": [1.0]}},
            "vary: 'amplitude' depends on the shaking, which is not varied here; remove it",
        ),
        ({"vary": {"gap": []}}, r"vary\['gap'\]: the list is empty"),
        ({"vary": {"yield_force": [1.0]}}, "vary: 'yield_force' is not a parameter of this rig; "),
        ({"records": []}, "records: missing; pass at least one Record"),
        ({"records": [RECORDS["a"], 3]}, r"records\['1'\]: 3 is not a record; pass a Record"),
        ({"shaking": "3 s"}, "shaking: '3 s'"),
        ({"shaking": -1.0}, "shaking: -1"),
        (
            {"shaking": vi.Periodic(1.0, [1.0, 2.0])},
            "shaking: scenarios are not defined for a Periodic",
        ),
        (
            {"records": RECORDS, "vary": {"gap": [0.1], "frequency": (1, 2)}},
            "vary: 'frequency' depends on the shaking, which is a record; remove it",
        ),
        (
            {"vary": {"gap": [0.1], "frequency": (2.0, 1.0)}},
            r"vary\['frequency'\]: the first value, 2 Hz, is not below the second, 1 Hz",
        ),
        (
            {"vary": {"gap": [0.1], "frequency": "1 Hz"}},
            r"vary\['frequency'\]: '1 Hz'; pass the lowest",
        ),
        (
            {"vary": {"frequency": (1.0, 2.0)}},
            "vary: no parameter; pass a dict of values by parameter, with at least one",
        ),
        ({"records": RECORDS, "fractile": 1.5}, "fractile: 1.5"),
        ({"step": 0.0}, "step: 0"),
        ({"limits": {"speed": 1.0}}, "limits: 'speed' is unknown; use peak_displacement, "),
        ({"records": RECORDS, "tail": -1.0}, "tail: -1"),
        ({"threads": 0}, "threads: 0"),
        ({"rig": 3}, "rig: 3"),
    ],
)
def test_wrong_input(arguments: dict, line: str) -> None:
    keywords = {"vary": {"gap": [0.1]}, **arguments}
    with pytest.raises(vi.InputError, match=f"^{line}"):
        vi.design_chart(
            keywords.pop("rig", None) or vi.Rig(BUILDING, keywords.pop("shaking", "0.1 g")),
            **keywords,
        )


def test_a_sweep_of_too_many_frequencies_is_refused_before_it_is_made() -> None:
    heavy = vi.Oscillator(1e30, vi.Isolator(1.0, 1.0), right=vi.Bumper(1e4, 1.0, 0.01))
    with pytest.raises(vi.InputError, match=r"step: .* gives .* frequencies .* more than 100000"):
        vi.design_chart(vi.Rig(heavy, 0.5), {"gap": [0.01], "frequency": (1.0, 2.0)})


def test_limits_of_one_side_have_the_sign_of_the_displacement() -> None:
    vary = {"gap": np.linspace(0.01, 0.3, 8)}
    every = vi.design_chart(BUILDING, vary, records=RECORDS)
    for name, sense in (("displacement_max", 1.0), ("displacement_min", -1.0)):
        limit = float(every[name].median())
        data = vi.design_chart(BUILDING, vary, records=RECORDS, limits={name: limit})
        within = sense * every[name] <= sense * limit
        assert 0 < int(within.sum()) < within.size
        np.testing.assert_array_equal(data["within_limits"], within)
        with pytest.raises(vi.InputError, match=rf"^limits\['{name}'\]: "):
            vi.design_chart(BUILDING, vary, records=RECORDS, limits={name: -limit})
