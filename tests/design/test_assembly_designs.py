"""Design charts of assemblies: one mass, responses one by one, limits of all parts."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from design.test_design_chart import RECORDS
from stability.test_assembly_orbits import STOPS, alone, frame
from vibroimpact import figures
from vibroimpact.design.limits import excesses
from vibroimpact.design.pareto import non_dominated

SINE = vi.Harmonic("1 m/s2", 0.9)
VARY = {"stops.right.gap": [0.004, 0.012], "links.storey.stiffness": [4e4, 6e4, 9e4]}


@pytest.mark.parametrize("kind", STOPS)
def test_sines_on_one_mass_are_the_oscillators(kind: str) -> None:
    one, several = (
        vi.design_chart(
            alone(STOPS[kind], assembled=assembled),
            {"gap": [0.004, 0.008], "frequency": (0.6, 2.0)},
            step=0.05,
        )
        for assembled in (False, True)
    )
    assert several["peak_displacement"].dims == ("gap", "mass")
    for name in ("peak_displacement", "displacement_min", "peak_acceleration", "peak_force"):
        values = np.squeeze(several[name].values)
        # Motions are held until they are within 1e-9 of a periodic one.
        np.testing.assert_allclose(values, one[name].values, rtol=1e-6)
    same = ["hitting", "pareto", "status"]
    if kind == "bumpers":  # a rigid wall is reached over a range of frequencies
        same += ["displacement_frequency", "unsettled_count"]
    for name in same:
        np.testing.assert_allclose(np.squeeze(several[name].values), one[name].values)


def test_sines_against_a_fine_sweep() -> None:
    rig = vi.Rig(frame(), SINE)
    vary = {"masses.roof": [200.0], "frequency": (0.7, 1.6)}
    data = vi.design_chart(rig, vary, step=0.05)
    moved = rig.system.replace(masses={**rig.system.masses, "roof": 200.0})
    fine = vi.sweep(vi.Rig(moved, SINE), np.linspace(0.7, 1.6, 901))
    for name in ("peak_displacement", "peak_acceleration"):
        peaks, largest = data[name].values[0], fine[name].max(("direction", "frequency")).values
        np.testing.assert_allclose(peaks, largest, rtol=2e-3)
        assert (peaks > largest * (1.0 - 1e-4)).all()
    at = fine["peak_displacement"].max("direction").sel(mass="roof").idxmax("frequency")
    place = data["displacement_frequency"].sel(mass="roof").item()
    assert place == pytest.approx(float(at), abs=3e-3)


def test_records_against_responses_one_by_one() -> None:
    data = vi.design_chart(frame(), VARY, records=RECORDS, fractile=0.5)
    assert data["peak_drift"].dims == ("stops.right.gap", "links.storey.stiffness", "link")
    assembly = frame()
    for gap in VARY["stops.right.gap"]:
        wall = vi.Link("base", "ground", assembly.stops["right"].law.replace(gap=gap))
        storey = vi.Link("base", "roof", assembly.links["storey"].law.replace(stiffness=9e4))
        moved = assembly.replace(
            stops={**assembly.stops, "right": wall}, links={**assembly.links, "storey": storey}
        )
        responses = [vi.seismic_response(vi.Rig(moved, record)) for record in RECORDS.values()]
        here = data.sel({"stops.right.gap": gap, "links.storey.stiffness": 9e4})
        for name in ("peak_displacement", "displacement_max", "peak_acceleration", "peak_drift"):
            middle = np.sort([one[name].values for one in responses], axis=0)[1]
            np.testing.assert_allclose(here[name], middle, rtol=1e-10)
        hits = sum(bool(one["impact_count"].any()) for one in responses) / len(responses)
        assert float(here["hitting"]) == pytest.approx(hits)


def test_limits_hold_for_each_part_and_the_front_is_that_of_the_largest() -> None:
    every = vi.design_chart(frame(), VARY, records=RECORDS)
    drift = float(every["peak_drift"].sel(link="storey").median())
    low = float(every["displacement_min"].min("mass").median())
    limits = {"peak_drift": max(drift, 1.0), "displacement_min": low}
    data = vi.design_chart(frame(), VARY, records=RECORDS, limits=limits)
    within = (every["displacement_min"] >= low).all("mass").values
    assert 0 < within.sum() < within.size
    np.testing.assert_array_equal(data["within_limits"], within)
    u, a = (
        np.where(within, every[name].max("mass").values, np.nan)
        for name in ("peak_displacement", "peak_acceleration")
    )
    np.testing.assert_array_equal(data["pareto"], non_dominated(u, a))
    # The figures show the largest of all masses.
    chart = figures.design_chart(data.isel({"links.storey.stiffness": 0}, drop=True))
    largest = 1e3 * every["peak_displacement"].max("mass").values[:, 0]
    assert any(np.array_equal(line.get_ydata(), largest) for line in chart[0].lines)
    assert "gap of the stop right (mm)" in chart[0].get_xlabel()
    assert chart[0].get_ylabel().endswith("of any mass")
    present = 1e3 * frame().stops["right"].law.gap
    assert any(present in line.get_xdata() for line in chart[0].lines if len(line.get_xdata()) == 2)
    contours = figures.design_chart(data)
    assert {ax.get_xlabel() for ax in contours} == {"stiffness of the link storey (kN/m)"}
    points = np.concatenate([one.get_xdata() for one in figures.pareto_front(data).lines])
    assert {*np.round(1e3 * u[within], 9)} <= {*np.round(points, 9)}


def test_wrong_input() -> None:
    for options, line in (
        ({}, "^vary: 'frequency' is missing; an Assembly has several resonances"),
        (
            {"records": RECORDS, "limits": {"penetration": 0.1}},
            "^limits: 'penetration' is unknown; use peak_displacement",
        ),
        (
            {"vary": {**VARY, "frequency": (1, 2)}, "limits": {"peak_drift": 0.1}},
            "^limits: 'peak_drift' is unknown; ",
        ),
    ):
        with pytest.raises(vi.InputError, match=line):
            vi.design_chart(vi.Rig(frame(), SINE), **{"vary": VARY, **options})
    with pytest.raises(vi.InputError, match=r"^vary: 'stops.rigt.gap' is unknown"):
        vi.design_chart(frame(), {"stops.rigt.gap": [0.01]}, records=RECORDS)


def test_stiffnesses_of_all_stops_keep_their_damping() -> None:
    stops = {"right": STOPS["bumpers"], "left": STOPS["bumpers"]}
    assembly = frame(STOPS["bumpers"])
    assert set(assembly.stops) == set(stops)
    damping = assembly.stops["right"].law.damping
    data = vi.design_chart(assembly, {"stops.stiffness": [1e5, 3e5]}, records=RECORDS)
    np.testing.assert_array_equal(data["stops.damping"], [damping, damping])
    stiff = assembly.stops["right"].law.replace(stiffness=3e5)
    alone = vi.demands(
        assembly.replace(
            stops={name: one.replace(law=stiff) for name, one in assembly.stops.items()}
        ),
        RECORDS,
    )
    expected = alone["peak_force"].max("record").values.ravel()
    np.testing.assert_allclose(data["peak_force"].values[1], expected, rtol=1e-12)


def test_a_limit_of_one_part() -> None:
    data = vi.design_chart(frame(), VARY, records=RECORDS)
    drift = data["peak_drift"].sel(link="isolator")
    middle = float(drift.median())
    chart = vi.design_chart(frame(), VARY, records=RECORDS, limits={"peak-drift.isolator": middle})
    np.testing.assert_array_equal(chart["within_limits"], drift <= middle)
    assert 0 < int(chart["within_limits"].sum()) < chart["within_limits"].size
    excess, *others = excesses(chart)
    assert not others
    np.testing.assert_array_equal(excess <= 0.0, chart["within_limits"])
    with pytest.raises(
        vi.InputError, match=r"limits: 'peak_drift\.attic' is unknown; .* peak_drift\.storey"
    ):
        vi.design_chart(frame(), VARY, records=RECORDS, limits={"peak_drift.attic": 1.0})


def test_required_gaps_are_a_table() -> None:
    rig = vi.Rig(frame(), SINE)
    gap = vi.required_gap(rig)
    table = vi.to_table(gap)
    assert table["stop"].tolist() == ["right", "left"]
    np.testing.assert_array_equal(table["required_gap"], gap["required_gap"])
