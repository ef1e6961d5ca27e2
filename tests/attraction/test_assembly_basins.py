"""Basins of assemblies on a plane through a state."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from stability.test_assembly_orbits import STOPS, alone, frame


@pytest.mark.parametrize("kind", STOPS)
def test_basins_of_one_mass_are_the_oscillators(kind: str) -> None:
    frequency, nodes = 1.9, (14, 12)
    one = vi.basins(
        alone(STOPS[kind], assembled=False), (-0.02, 0.02), (-0.3, 0.3), frequency=frequency,
        nodes=nodes,
    )  # fmt: skip
    several = vi.basins(
        alone(STOPS[kind], assembled=True),
        plane={"displacement.m": (-0.02, 0.02), "velocity.m": (-0.3, 0.3)},
        frequency=frequency,
        nodes=nodes,
    )
    assert several["basin"].dims == ("velocity.m", "displacement.m")
    assert several["displacement.m"].attrs["units"] == "m"
    assert several.sizes["attractor"] == one.sizes["attractor"]
    np.testing.assert_array_equal(several["basin"].values, one["basin"].values)
    np.testing.assert_allclose(several["share"], one["share"])
    np.testing.assert_array_equal(several["period"], one["period"])
    if kind == "walls":
        assert (one["basin"] == -2).any()


def test_basins_of_a_frame_lead_where_steady_does() -> None:
    rig = vi.Rig(frame(), vi.Harmonic("1 m/s2", 0.9))
    branch = vi.branch(rig, vary={"frequency": (0.6, 3.0)})
    folds = np.sort(branch["bifurcation_value"].values[branch["bifurcation_kind"].values == "fold"])
    frequency = float(0.5 * (folds[0] + folds[1]))
    start = vi.State(velocity={"base": 0.05})
    plane = {"displacement.roof": (-0.08, 0.08), "velocity.roof": (-0.6, 0.6)}
    coarse = vi.basins(rig, plane=plane, start=start, frequency=frequency, nodes=(9, 7))
    assert coarse.sizes["attractor"] >= 2
    assert (coarse["basin"] >= 0).all()
    for i, j in ((0, 0), (3, 4), (6, 8)):
        here = coarse["basin"][i, j]
        state = vi.State(
            {"roof": float(here["displacement.roof"])},
            {"roof": float(here["velocity.roof"]), "base": 0.05},
        )
        steady = vi.steady(rig, start=state, frequency=frequency)
        motion = coarse.isel(attractor=int(here))
        np.testing.assert_allclose(
            steady["displacement_excursion"], motion["displacement_excursion"], rtol=1e-6
        )
    # Refined near borders, the nodes of the first grid are the same.
    finer = vi.basins(rig, plane=plane, start=start, frequency=frequency, nodes=(9, 7), refine=1)
    np.testing.assert_array_equal(finer["basin"].values[::2, ::2], coarse["basin"].values)


def test_basins_with_a_curved_link_are_the_oscillators() -> None:
    isolator, stop = vi.PolynomialIsolator(200.0, 2.0, 4e3), vi.Bumper(1500.0, 20.0, 0.01)
    shaking, span, speeds = vi.Harmonic(4.0, 2.5), (-0.02, 0.02), (-1.0, 1.0)
    system = vi.Assembly(
        {"m": 1.0},
        {"isolator": vi.Link("ground", "m", isolator)},
        {"right": vi.Link("m", "ground", stop), "left": vi.Link("ground", "m", stop)},
    )
    plane = {"displacement.m": span, "velocity.m": speeds}
    several = vi.basins(vi.Rig(system, shaking), plane=plane, nodes=5)
    one = vi.basins(
        vi.Rig(vi.Oscillator(1.0, isolator, stop, stop), shaking), span, speeds, nodes=5
    )
    np.testing.assert_array_equal(several["basin"].values, one["basin"].values)


def test_wrong_planes() -> None:
    rig = vi.Rig(frame(), vi.Harmonic("1 m/s2", 0.9))
    good = {"displacement.roof": (-0.1, 0.1), "velocity.roof": (-1.0, 1.0)}
    for wrong, says in (
        ({}, "^plane: None is not a dict of two coordinates|^plane"),
        ({"plane": {"displacement.roof": (-1, 1)}}, r"^plane: 'displacement.roof'; pass a dict of"),
        ({"plane": {**good, "velocity.base": (0, 1)}}, "pass a dict of two coordinates"),
        (
            {"plane": {"displacement.x": (0, 1), "velocity.roof": (0, 1)}},
            "^plane: 'displacement.x' is unknown; ",
        ),
        (
            {"plane": {**good, "velocity.roof": (1, 0)}},
            r"^plane\['velocity.roof'\]: the first value, 1 m",
        ),
        ({"plane": good, "displacement": (0, 1)}, "^displacement: an Assembly has several"),
        ({"plane": good, "isolator": 0.1}, "^isolator: 0.1, but the rig is an Assembly"),
    ):
        with pytest.raises(vi.InputError, match=says) as error:
            vi.basins(rig, **wrong)
        assert "\n" not in str(error.value)
    with pytest.raises(vi.InputError, match=r"^plane: only for an Assembly"):
        vi.basins("B2-G1-A3", frequency=2.0, plane=good)
