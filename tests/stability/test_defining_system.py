"""The defining system of a bifurcation, and Newton's method for it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import vibroimpact as vi
from reference.paper_signs import signed_parts
from vibroimpact.engine.status import Status
from vibroimpact.stability import defining_system
from vibroimpact.stability.defining_system import Defining, solve
from vibroimpact.stability.initial_orbit import scales
from vibroimpact.stability.two_parameters import plane

CASE = vi.laboratory.case("B2-G1-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 2.0)
HOLD_GAP = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])


@pytest.fixture(scope="module")
def fold():
    """The upper fold over frequency and gap: its system, and where it is."""
    data = vi.branch(vi.Rig(CASE.oscillator, SHAKEN), vary={"frequency": (1.0, 4.0)})
    row = int(np.flatnonzero(data["bifurcation_kind"].values == "fold")[-1])
    one = data.isel(bifurcation=row)
    state = one["bifurcation_section"].values
    point = np.array([*signed_parts(state), state[-1], float(one["bifurcation_value"])])
    over = plane(vi.Rig(CASE.oscillator, SHAKEN), ("frequency", "gap"))
    scale = np.append(scales(over.family, (1.0, 4.0), point), 0.02)
    mirror = bool(int(one["bifurcation_antisymmetric"]))
    return Defining(over, "fold", 1, mirror, 0.0, scale), np.append(point, over.value)


def test_a_bifurcation_solves_it(fold):
    system, y = fold
    _, residual = system.value(y)
    assert np.abs(residual).max() < 1e-8


@pytest.mark.parametrize("share", [1e-6, 1e-4])
def test_newton_comes_back_to_it(fold, share):
    system, y = fold
    beside = y + share * system.scale * np.array([1.0, -1.0, 0.0, 0.0, 0.0, 0.5, 0.0])
    spot = solve(system, beside, HOLD_GAP)
    assert spot is not None
    assert spot.y[5] == pytest.approx(y[5], rel=1e-9)
    assert spot.y[6] == y[6]
    assert np.abs(spot.orbit.map_multipliers - 1.0).min() < 1e-7


def test_far_from_any_there_is_none(fold):
    system, y = fold
    assert system.value(np.full(7, np.nan)) is None
    assert system.value(y + 1e4 * system.scale) is None
    assert solve(system, np.full(7, np.nan), HOLD_GAP) is None


def test_what_no_step_leads_back_from_is_none(fold, monkeypatch):
    """Such numbers overflow in the differences, where a warning would be an error."""
    system, y = fold
    orbit, _ = system.value(y)
    for steep, lost in ((1.0, False), (1e150, True), (np.inf, True), (np.nan, True)):
        seen = Status.DONE, replace(orbit, carried=np.full((5, 5), steep)), orbit.point
        monkeypatch.setattr(defining_system, "evaluated", lambda *_, seen=seen: seen)
        assert (system.value(y) is None) is lost
        assert solve(system, y, HOLD_GAP) is None or not lost
    far = Status.DONE, orbit, 1e120 * system.scale[:-1]
    monkeypatch.setattr(defining_system, "evaluated", lambda *_: far)
    assert system.value(y) is None


def test_a_curve_of_folds_warns_of_nothing():
    """On its way Newton's method meets maps so steep that squares of their slopes overflow."""
    stop = vi.Bumper(stiffness=680e3, damping=1e3, gap=5e-3)
    rig = vi.Oscillator(550.0, vi.Isolator(26.3e3, 1.14e3), stop, stop)
    branch = vi.branch(vi.Rig(rig, vi.Harmonic("0.05 g", 4.0)), vary={"frequency": (1.5, 4.0)})
    data = vi.bifurcation_curve(
        vi.Rig(rig, vi.Harmonic("0.05 g", 2.0)),
        branch.isel(bifurcation=1),
        vary={"frequency": (0.3, 8.0), "amplitude": (0.05, 5.0)},
    )
    for end in ("ended_low", "ended_high"):
        assert data.attrs[end] == "the range of amplitude ends at 0.509858106 g"
