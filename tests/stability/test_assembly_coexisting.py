"""Coexisting motions of assemblies."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from stability.test_assembly_orbits import STOPS, alone, damper, frame

SOFT = vi.Bumper(2e5, 3e3, "8 mm")


@pytest.mark.parametrize("frequency", [1.2, 1.9])
def test_those_of_one_mass_are_the_oscillators(frequency: float) -> None:
    one, several = (
        vi.coexisting_motions(
            alone(STOPS["bumpers"], assembled=assembled), frequency=frequency, random=3
        )
        for assembled in (False, True)
    )
    assert several.sizes["attractor"] == one.sizes["attractor"]
    np.testing.assert_array_equal(several["period"], one["period"])
    np.testing.assert_allclose(
        several["displacement_max"].values[:, 0], one["displacement_max"].values, rtol=1e-9
    )
    np.testing.assert_array_equal(several["mirror_pair"], one["mirror_pair"])
    assert str(several["starts"].values[0]).startswith("rest") == str(
        one["starts"].values[0]
    ).startswith("rest")


def test_motions_beside_a_fold_are_both_found() -> None:
    """Within the range of frequencies between two folds, two stable orbits exist."""
    rig = vi.Rig(frame(), vi.Harmonic("1 m/s2", 0.9))
    branch = vi.branch(rig, vary={"frequency": (0.6, 3.0)})
    folds = branch["bifurcation_value"].values[branch["bifurcation_kind"].values == "fold"]
    assert len(folds) >= 2
    middle = float(0.5 * (np.sort(folds)[0] + np.sort(folds)[1]))
    motions = vi.coexisting_motions(rig, frequency=middle, random=4)
    stable = motions["stable"].values == 1
    assert stable.sum() >= 2
    assert motions["displacement_max"].dims == ("attractor", "mass")
    for i in np.flatnonzero(stable):
        one = motions.isel(attractor=i)
        again = vi.steady(rig, frequency=middle, start=one)
        np.testing.assert_allclose(again["displacement_max"], one["displacement_max"], rtol=1e-8)


def test_a_chaotic_motion_has_fewer_exponents() -> None:
    rig = damper(zeta=0.05, mass=0.1, e=0.6, clearance=8.0)
    motions = vi.coexisting_motions(
        rig, frequencies=[0.1, 0.2], random=1, max_cycles=300, exponent_cycles=1500
    )
    assert motions.sizes["attractor"] >= 1
    assert "chaotic" in motions["motion"].values


@pytest.mark.parametrize("isolator", ["hardens", "yields"])
def test_random_starts_of_curved_links_lead_to_their_motions(isolator: str) -> None:
    law = {
        "hardens": vi.PolynomialIsolator(2e5, 4e3, 2e9),
        "yields": vi.BilinearIsolator(2e5, 2e4, 400.0, 4e3),
    }[isolator]
    linked = vi.Assembly(
        {"west": 1500.0, "east": 1000.0},
        {
            "first": vi.Link("ground", "west", law),
            "second": vi.Link("ground", "east", vi.Isolator(3e5, 3e3)),
        },
        {"between": vi.Link("west", "east", SOFT)},
    )
    rig = vi.Rig(linked, vi.Harmonic("1 m/s2", 1.7))
    motions = vi.coexisting_motions(rig, random=4, max_cycles=400)
    assert "random 4" in " ".join(motions["starts"].values)
    one = motions.isel(attractor=0)
    again = vi.steady(rig, start=one)
    np.testing.assert_allclose(again["displacement_max"], one["displacement_max"], rtol=1e-8)
