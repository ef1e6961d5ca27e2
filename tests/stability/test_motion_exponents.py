"""What the growth of disturbances says of a motion, and what it says if a limit is met."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine.status import Status
from vibroimpact.stability.motion_exponents import judge_orbit, judge_wandering
from vibroimpact.stability.settled_motion import approach

CASE = vi.laboratory.case("B3-10mm-A3")


def test_an_orbit_by_its_multipliers():
    motion = approach(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 1.2)), vi.State())
    kind, damping, cycles, status = judge_orbit(motion, 100)
    assert (kind.motion, kind.period, cycles, status) == ("periodic", 1, 2, Status.DONE)
    orbit = vi.orbit(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 1.2)))
    moduli = np.hypot(orbit["multiplier_real"], orbit["multiplier_imag"]).values
    np.testing.assert_allclose(np.sort(kind.exponents)[::-1], np.log(moduli[:2]), atol=1e-9)
    # Where bumpers forget the sum is that of the damping.
    assert kind.exponents.sum() == pytest.approx(-damping, rel=1e-9)


def test_an_orbit_that_meets_the_event_limit_is_not_judged():
    motion = approach(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 1.2)), vi.State())
    kind, damping, _, status = judge_orbit(motion, 1)
    assert status is Status.TOO_MANY_EVENTS
    assert (kind.motion, kind.evidence) == ("undecided", status.advice)
    assert np.isnan(kind.exponents).all()
    assert np.isnan(damping)


def test_a_wandering_motion_that_meets_the_event_limit():
    motion = approach(
        vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 1.06)), vi.State(), max_cycles=50
    )
    assert motion.status is Status.NOT_SETTLED
    *_, status = judge_wandering(motion, motion.state.copy(), 100, 1)
    assert status is Status.TOO_MANY_EVENTS
    kind, _, cycles, status = judge_wandering(motion, motion.state.copy(), 1000, 100)
    assert (kind.motion, cycles, status) == ("chaotic", 1000, Status.DONE)
