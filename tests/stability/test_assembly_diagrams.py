"""Bifurcation diagrams of assemblies."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from stability.test_assembly_orbits import STOPS, alone, damper, frame

PATHS = {"gap": "gap", "isolator.stiffness": "links.isolator.stiffness", "frequency": "frequency"}
SPANS = {"gap": (0.004, 0.01), "isolator.stiffness": (1.2e4, 1.8e4), "frequency": (1.1, 1.6)}


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("kind", STOPS)
def test_of_one_mass_is_the_oscillators(path: str, kind: str) -> None:
    one, several = (
        vi.bifurcation_diagram(
            alone(STOPS[kind], assembled=assembled),
            vary={name: SPANS[path]},
            steps=5,
            points=40,
            exponent_cycles=64,
        )
        for assembled, name in ((False, path), (True, PATHS[path]))
    )
    periodic = (one["period"] > 0).values
    assert periodic.sum() >= 8
    np.testing.assert_array_equal(
        several["period"].values[periodic], one["period"].values[periodic]
    )
    assert (several["motion"].values[periodic] == "periodic").all()
    for name in ("displacement_max", "peak_acceleration"):
        mine, theirs = several[name].values[..., 0], one[name].values
        np.testing.assert_allclose(mine[periodic], theirs[periodic], rtol=1e-8)
    for name in ("displacement", "velocity"):
        mine = several[f"section_{name}"].values[..., 0, 0]
        theirs = one[f"section_{name}"].values[..., 0]
        size = np.nanmax(abs(theirs))
        np.testing.assert_allclose(mine[periodic], theirs[periodic], rtol=0, atol=1e-8 * size)
    assert several[PATHS[path]].attrs["units"] == one[path].attrs["units"]


def test_motions_are_those_of_steady() -> None:
    rig = vi.Rig(frame(), vi.Harmonic("1 m/s2", 0.9))
    diagram = vi.bifurcation_diagram(
        rig,
        vary={"stops.right.gap": (0.009, 0.013)},
        steps=3,
        starts={"pushed": vi.State(velocity={"roof": 0.2})},
        random=2,
    )
    assert diagram.sizes["start"] == 5
    assert diagram["section_velocity"].dims[-1] == "mass"
    assert diagram["section_deformation"].dims[-1] == "stop"
    settled = np.flatnonzero(diagram["period"].sel(start="pushed"))
    assert len(settled) == 3
    for i in settled:
        here = diagram.isel({"stops.right.gap": i}).sel(start="pushed")
        law = frame().stops["right"].law.replace(gap=float(here["stops.right.gap"]))
        wall = vi.Link("base", "ground", law)
        assembly = rig.system.replace(stops={**rig.system.stops, "right": wall})
        steady = vi.steady(vi.Rig(assembly, rig.shaking), start=here["section"])
        assert int(steady["period"]) == int(here["period"])
        np.testing.assert_allclose(steady["displacement_max"], here["displacement_max"], rtol=1e-8)


def test_no_wall_is_passed_where_a_motion_goes_on_with_a_smaller_gap() -> None:
    rig = vi.Rig(frame(vi.RigidStop(0.8, 0.012)), vi.Harmonic("1 m/s2", 0.9))
    vary = {"stops.right.gap": (0.004, 0.013)}
    options = {"points": 20, "exponent_cycles": 64, "max_cycles": 60}
    diagram = vi.bifurcation_diagram(rig, vary=vary, steps=4, directions="down", **options)
    most = diagram["displacement_max"].sel(mass="base").values
    assert (most <= diagram["stops.right.gap"].values * (1.0 + 1e-12)).all()


def test_a_motion_that_is_not_periodic_fills_its_section() -> None:
    rig = damper(zeta=0.05, mass=0.1, e=0.6, clearance=8.0)
    diagram = vi.bifurcation_diagram(
        rig,
        vary={"links.spring.stiffness": (0.999, 1.0)},
        steps=2,
        directions="up",
        points=30,
        exponent_cycles=800,
        max_cycles=200,
    )
    last = diagram.isel({"links.spring.stiffness": 1, "start": 0})
    assert str(last["motion"].values) == "chaotic"
    assert float(last["exponents"][0]) > 0.0
    assert np.isfinite(last["section_displacement"]).all()
    assert last["section_displacement"].shape == (30, 2)


def test_what_is_refused() -> None:
    rig = vi.Rig(frame(), vi.Harmonic("1 m/s2", 0.9))
    with pytest.raises(vi.InputError, match=r"^section: 'impacts'; for an Assembly, use 'strob"):
        vi.bifurcation_diagram(rig, vary={"gap": (0.01, 0.02)}, steps=2, section="impacts")
