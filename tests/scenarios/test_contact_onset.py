"""Where contact begins is no resonance of its own."""

from __future__ import annotations

import numpy as np
import pytest

from scenarios.made import GAP, GRID, RIG, bump, inside, made, named, primary
from vibroimpact.model.rig import Rig
from vibroimpact.scenarios.evidence import evidence


def test_where_contact_begins_is_no_secondary_resonance():
    """The same range, raised as much, but free flight is at its foot."""
    forward, backward = primary()
    here = inside(1.0, 1.2)
    peak = np.where(here, 0.3, 0.0)
    touching = np.array([(GRID > 0.985) & (forward > 0.25), (GRID > 0.985) & (backward > 0.25)])
    data = made(forward + peak, backward + peak, touching=touching, period=np.where(here, 0, 1))
    features = evidence(RIG, data, 0.01)
    assert features.onset == ((1.0, 1.2),)
    assert features.irregular == ()
    assert features.secondary == ()
    assert named(data) == "S2"
    # The same with contact all along: a resonance of its own if the curve falls towards it.
    valley = bump(0.85, 0.06, -0.4)
    alone = made(forward + peak + valley, backward + peak + valley, period=np.where(here, 0, 1))
    assert evidence(RIG, alone, 0.01).onset == ()
    assert named(alone) == "S4"


def test_left_hysteresis_where_contact_begins():
    """It joins the range that is not regular, which has free flight at its foot."""
    forward, backward = primary()
    touching = np.array([GRID > 0.985] * 2) & (np.array([forward, backward]) > 0.25)
    lift = np.where(inside(1.0, 1.2), 0.3, 0.0)
    more = lift + np.where(inside(1.13, 1.2), 0.3, 0.0)
    period = np.where(inside(1.0, 1.12), 3, 1)
    data = made(forward + lift, backward + more, touching=touching, period=period)
    features = evidence(RIG, data, 0.01)
    assert features.onset == ((1.0, 1.2),)
    assert features.left == ()
    assert named(data) == "S2"


def test_a_regular_peak_where_contact_begins_is_no_secondary_resonance():
    forward, backward = primary()
    touching = np.array([GRID > 0.985] * 2) & (np.array([forward, backward]) > 0.25)
    peak = bump(1.05, 0.04, 0.4)
    data = made(forward + peak, backward + peak, touching=touching)
    assert evidence(RIG, data, 0.01).secondary == ()
    assert named(data) == "S2"


@pytest.mark.parametrize(("share", "pressed"), [(0.999, False), (0.98, True)])
def test_a_range_that_begins_the_sweep(share, pressed):
    """Whether contact begins there or below: A/ω0² is 0.2966 of free flight's amplitude."""
    gap = share / 0.3 * 0.29665 * GAP
    gap = gap / 0.98 if not pressed else gap
    side = RIG.oscillator.right.replace(gap=gap)
    oscillator = RIG.oscillator.replace(right=side, left=side)
    forward, backward = primary()
    peak = bump(0.5, 0.05, 0.4)
    data = made(forward + peak, backward + peak, period=np.where(inside(0.4, 0.6), 3, 1))
    features = evidence(Rig(oscillator, RIG.sine), data, 0.01)
    assert bool(features.irregular) == pressed
    assert (features.onset == ()) == pressed
