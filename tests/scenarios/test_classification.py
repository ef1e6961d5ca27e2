"""From what the curves show to the scenario."""

from __future__ import annotations

import numpy as np
import pytest

from scenarios.made import GAP, GRID, RIG, bump, made, named, primary, slope
from vibroimpact.scenarios.classification import primary_jumps
from vibroimpact.scenarios.evidence import evidence


def test_smooth_curves_with_contact():
    smooth = 0.3 + bump(1.3, 0.4, 1.0)
    assert named(made(smooth, touching=smooth > 0.5)) == "S6"


def test_no_contact():
    assert named(made(0.1 + bump(1.0, 0.3, 0.1))) == "S0"


def test_attached_bumpers():
    side = RIG.oscillator.right.replace(gap=0.0)
    oscillator = RIG.oscillator.replace(right=side, left=side)
    smooth = 0.3 + bump(2.0, 0.8, 1.0)
    assert named(made(smooth), oscillator) == "S5"
    assert named(made(*primary()), oscillator) == "S2"  # attached, but it jumps


@pytest.mark.parametrize(
    ("thresholds", "expected"),
    [({}, "S1"), ({"touch": 0.04}, "S2"), ({"deformation": 0.01}, "S2")],
)
def test_grazing(thresholds, expected):
    """The gap is 0.95 of free flight's amplitude, and the mass presses in by 0.02 of it."""
    gap = 0.95 / 0.3 * GAP
    side = RIG.oscillator.right.replace(gap=gap)
    oscillator = RIG.oscillator.replace(right=side, left=side)
    data = made(*primary())
    for name, sign in (("displacement_max", 1), ("displacement_min", -1)):
        data[name] = data[name] * 0.0 + sign * 1.02 * gap
    assert named(data, oscillator, **thresholds) == expected


def test_a_primary_resonance_that_is_not_regular_is_unclassified():
    forward, backward = primary()
    data = made(forward, backward, period=np.where(GRID > 1.3, 0, 1))
    assert named(data) == "unclassified"


def test_a_jump_of_one_direction_alone_is_none():
    """A hysteresis between two frequencies makes both directions jump there."""
    hidden = evidence(RIG, made(slope(1.6)), 0.01)
    assert hidden.hysteresis == ()
    assert [jump.direction for jump in hidden.jumps] == ["forward", "backward"]
    assert primary_jumps(hidden)
    assert not primary_jumps(hidden._replace(jumps=hidden.jumps[:1]))


def test_a_resonance_that_has_moved_down_is_not_s6():
    smooth = 0.3 + bump(0.8, 0.2, 1.0)
    assert named(made(smooth, touching=smooth > 0.5)) == "unclassified"


def test_holds_without_values():
    data = made(*primary())
    for name in ("eta_a", "eta_d"):
        data[name] = data[name].where(data["direction"] == "forward")
    assert named(data) == "unclassified"
    for name in ("eta_a", "eta_d", "impacts"):
        data[name] = data[name] * np.nan
    assert named(data) == "unclassified"  # not free flight
    nothing = made(*primary(), period=0)
    assert named(nothing) == "unclassified"
