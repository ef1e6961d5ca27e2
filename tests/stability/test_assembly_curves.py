"""Bifurcations of assemblies over two parameters: one mass, scaling, branches elsewhere."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from figures.test_assembly_figures import DAMPER, PAIR
from samples import sample
from stability.test_assembly_orbits import STOPS, alone

TURN = 1.0 / (2.0 * np.pi)


def first(branch: xr.Dataset, kind: str) -> xr.Dataset:
    return branch.isel(bifurcation=int(np.argmax(branch["bifurcation_kind"].values == kind)))


@cache
def neighbours(gap: float) -> xr.Dataset:
    law = PAIR.stops["pounding"].law.replace(gap=gap)
    pair = PAIR.replace(stops={"pounding": vi.Link("north", "south", law)})
    rig = vi.Rig(pair, vi.Harmonic("0.2 g", "1.5 Hz"))
    return vi.branch(rig, vary={"frequency": (1.45, 1.7)})


def test_a_curve_of_one_mass_is_the_oscillators() -> None:
    vary = {"frequency": (0.8, 2.6)}
    curves = []
    for assembled in (False, True):
        rig = alone(STOPS["bumpers"], assembled=assembled)
        fold = first(vi.branch(rig, vary=vary), "fold")
        curves.append(vi.bifurcation_curve(rig, fold, vary={**vary, "gap": (0.006, 0.012)}))
    one, several = curves
    assert several.sizes["point"] == one.sizes["point"] > 10
    for name in ("frequency", "gap"):
        np.testing.assert_allclose(several[name], one[name], rtol=1e-11)
    assert several.attrs["ended_high"] == one.attrs["ended_high"]
    assert several.sizes["component"] == 7


KINDS = ["Neimark-Sacker", "fold", "symmetry breaking"]


@pytest.mark.parametrize("kind", sample(KINDS, KINDS[:1]))
def test_bifurcations_scale_with_the_gap(kind: str) -> None:
    """Where all links are linear, a motion of twice the size has twice the amplitude and gap."""
    stops = {
        name: vi.Link(link.left, link.right, vi.RigidStop(0.75, 0.5))
        for name, link in DAMPER.stops.items()
    }
    rig = vi.Rig(DAMPER.replace(stops=stops), vi.Harmonic(0.03, TURN, of="force", on="host"))
    moving = vi.State(displacement={"host": 0.5}, velocity={"ball": 1.0})
    orbit = vi.orbit(rig, vi.steady(rig, moving))
    branch = vi.branch(rig, orbit, vary={"amplitude": (0.005, 0.05)})
    start = first(branch, kind)
    vary = {"amplitude": (0.001, 0.1), "gap": (0.4, 0.7)}
    curve = vi.bifurcation_curve(rig, start, vary=vary)
    assert {*np.round(curve["gap"].values[[0, -1]], 9)} == {0.4, 0.7}
    expected = float(start["bifurcation_value"]) / 0.5
    np.testing.assert_allclose(curve["amplitude"] / curve["gap"], expected, rtol=1e-8)


@pytest.mark.full
def test_a_curve_of_tori_goes_through_those_of_branches_elsewhere() -> None:
    rig = vi.Rig(PAIR, vi.Harmonic("0.2 g", "1.5 Hz"))
    start = first(neighbours(0.02), "Neimark-Sacker")
    vary = {"frequency": (1.4, 1.7), "stops.pounding.gap": (0.015, 0.022)}
    curve = vi.bifurcation_curve(rig, start, vary=vary)
    values = curve["multiplier_real"].values + 1j * curve["multiplier_imag"].values
    away = np.abs(np.abs(values) - 1.0) + (np.abs(values.imag) < 1e-6)
    assert (away.min(axis=1) < 1e-8).all()
    gap = float(curve["stops.pounding.gap"][len(curve["point"]) // 4])
    assert abs(gap - 0.02) > 1e-4
    elsewhere = neighbours(gap)
    mine = elsewhere["bifurcation_kind"].values == "Neimark-Sacker"
    there = float(curve["frequency"][len(curve["point"]) // 4])
    assert np.abs(elsewhere["bifurcation_value"].values[mine] - there).min() < 1e-8


def test_what_no_curve_is_followed_of() -> None:
    rig = vi.Rig(PAIR, vi.Harmonic("0.2 g", "1.5 Hz"))
    grazing = first(neighbours(0.02), "grazing")
    vary = {"frequency": (1.4, 1.7), "stops.pounding.gap": (0.015, 0.022)}
    with pytest.raises(vi.InputError, match=r"^start: a grazing, of which no curve is followed"):
        vi.bifurcation_curve(rig, grazing, vary=vary)
    tori = first(neighbours(0.02), "Neimark-Sacker")
    with pytest.raises(vi.InputError, match=r"^vary: no curve can be followed along 'masses.nort"):
        vi.bifurcation_curve(rig, tori, vary={"frequency": (1.4, 1.7), "masses.north": (1e5, 3e5)})
