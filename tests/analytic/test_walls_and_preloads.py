"""Rigid stops and preloaded bumpers against the independent integration to fifty digits.

Over `CYCLES` cycles from a start far from the steady motion, the state at each stroboscopic
section agrees within 1e-11 of the largest displacement (or velocity), and so do the events:
contacts, detachments, beginnings and ends of rest, and all impacts but the last ones of a chatter,
of which each of the two lists as many as it needs.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

import vibroimpact as vi
from reference import fifty_digits
from reference.public_motion import (
    SLOW,
    assert_agreement,
    events,
    reference_rig,
    reference_start,
)
from samples import sample

CYCLES = sample(20, 6)
TOLERANCE = 1e-11
Wall, Bumper = vi.RigidStop, vi.Bumper


class Setup(NamedTuple):
    """With M = K = 1; amplitude (m/s²), frequency (Hz) and phase of the base."""

    right: vi.Bumper | vi.RigidStop | None
    left: vi.Bumper | vi.RigidStop | None
    shaken: tuple[float, float, float]
    start: tuple[float, float] | None = None
    """None: the equilibrium."""
    damping: float = 0.1

    @property
    def rig(self) -> vi.Oscillator:
        return vi.Oscillator(1.0, vi.Isolator(1.0, self.damping), self.right, self.left)


SETUPS = {
    "two walls": Setup(Wall(0.8, 0.5), Wall(0.6, 0.4), (1.0, 0.25, 0.3)),
    "one wall": Setup(Wall(0.7, 0.3), None, (1.0, 0.3, 0.0)),
    "one wall without gap": Setup(None, Wall(0.65, 0.0), (1.0, 0.31, 1.0), (0.2, 0.0)),
    "held away by a wall": Setup(Wall(0.65, -0.2), None, (1.0, 0.35, 0.0)),
    "a wall faces a bumper": Setup(Wall(0.7, 0.3), Bumper(20.0, 0.9, 0.1), (1.0, 0.25, 0.3)),
    "a wall faces an elastic bumper": Setup(
        Bumper(20.0, 0.0, 0.2), Wall(0.4, 0.2), (1.0, 0.2, 0.3)
    ),
    "plastic impacts": Setup(Wall(0.0, 0.2), Wall(0.0, 0.3), (1.0, 0.1, 0.0)),
    "no loss": Setup(Wall(1.0, 0.3), None, (1.0, 0.3, 0.0), damping=0.3),
    "chatter and rest": Setup(Wall(0.5, -0.4), None, (1.0, 0.08, 0.0), (-1.0, 0.0)),
    "chatter and rest on both sides": Setup(Wall(0.3, 0.2), Wall(0.6, 0.1), (1.0, 0.05, 0.0)),
    "long chatter": Setup(Wall(0.8, 0.1), None, (1.0, 0.03, 0.0)),
    "chatter while a bumper presses": Setup(
        Wall(0.6, 0.1), Bumper(5.0, 0.3, -0.4), (4.0, 0.06, 0.0), (0.05, 0.0)
    ),
    "one preload": Setup(Bumper(6.0, 0.8, -0.2), None, (1.0, 0.25, 0.3)),
    "equal preloads": Setup(Bumper(6.0, 0.8, -0.2), Bumper(6.0, 0.8, -0.2), (6.0, 0.3, 0.3)),
    "unequal preloads": Setup(
        Bumper(6.0, 0.8, -0.3), Bumper(50.0, 2.0, -0.05), (2.0, 0.4, 1.0), (0.1, -0.2)
    ),
    "one preload reaches the other bumper": Setup(
        Bumper(6.0, 0.1, -0.3), Bumper(30.0, 0.05, 0.2), (1.5, 0.3, 0.0)
    ),
    "elastic preloads": Setup(Bumper(6.0, 0.0, -0.3), Bumper(9.0, 0.0, -0.1), (5.0, 0.4, 0.3)),
    "overdamped preloads": Setup(
        Bumper(3.0, 20.0, -0.3), Bumper(9.0, 15.0, -0.2), (20.0, 0.25, 0.3)
    ),
}


@pytest.mark.parametrize("name", sample([*SETUPS], [*SETUPS][1::3]))
def test_sections_and_events_agree_with_fifty_digits(name: str) -> None:
    setup = SETUPS[name]
    shaken = vi.Harmonic(*setup.shaken)
    start = vi.State(*setup.start) if setup.start else None
    data = vi.simulate(vi.Rig(setup.rig, shaken), CYCLES, start, samples=1)
    run = fifty_digits.integrate(
        reference_rig(setup.rig), *setup.shaken, reference_start(setup.rig, start), CYCLES
    )
    assert len(assert_agreement(data, run, shaken.period, TOLERANCE)) >= 5


@pytest.mark.parametrize("name", SETUPS)
def test_nothing_is_entered(name: str) -> None:
    """Looked at 300 times a cycle, the mass is never behind a wall or a bumper's face."""
    setup = SETUPS[name]
    data = vi.simulate(vi.Rig(setup.rig, vi.Harmonic(*setup.shaken)), CYCLES, samples=300)
    u = data["displacement"].values
    size = np.abs(u).max()
    for sign, stop, face in ((1, setup.right, "right"), (-1, setup.left, "left")):
        if stop is not None:
            inside = sign * u - data["deformation"].sel(stop=face).values - stop.gap
            assert inside.max() <= 1e-14 * max(size, abs(stop.gap))
            assert data["clearance"].sel(stop=face).values.min() >= 0.0
    assert np.isfinite(data["acceleration"]).all()


def test_rest_is_rest() -> None:
    """While it rests the mass stands on the wall, and moves with the base."""
    setup = SETUPS["chatter and rest"]
    data = vi.simulate(vi.Rig(setup.rig, vi.Harmonic(*setup.shaken)), CYCLES, samples=500)
    resting = data["touching"].sel(stop="right").values
    assert 0.2 < resting.mean() < 0.9
    assert (data["displacement"].values[resting] == setup.right.gap).all()
    assert (data["velocity"].values[resting] == 0.0).all()
    np.testing.assert_allclose(
        data["acceleration"].values[resting],
        data["base_acceleration"].values[resting],
        rtol=0.0,
        atol=1e-13,
    )


def test_both_bumpers_may_be_in_contact_at_once() -> None:
    setup = SETUPS["elastic preloads"]
    data = vi.simulate(vi.Rig(setup.rig, vi.Harmonic(*setup.shaken)), CYCLES, samples=500)
    both = (data["deformation"] > 0).all("stop")
    assert both.any()
    u = data["displacement"]
    force = u + 6.0 * (u + 0.3) + 9.0 * (u - 0.1) + 0.1 * data["velocity"]
    np.testing.assert_allclose(-force.values[both], data["acceleration"].values[both], atol=1e-12)


@pytest.mark.parametrize("e", [0.0, 0.5])
def test_a_rest_may_end_at_a_section(e: float) -> None:
    """Without a gap and a phase it ends where sin θ = 0, with the cycle: once, not twice."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), vi.RigidStop(e, 0.0))
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(1.0, 0.16)), CYCLES, vi.State(-1.0), samples=1)
    run = fifty_digits.integrate(reference_rig(rig), 1.0, 0.16, 0.0, (-1.0, 0.0, 0.0, 0.0), CYCLES)
    speed = max(abs(float(event.v)) for event in run.events)
    for u, v, exact in zip(
        data["displacement"].values, data["velocity"].values, run.states, strict=True
    ):
        assert abs(float(u - exact[0])) <= TOLERANCE
        assert abs(float(v - exact[1])) <= TOLERANCE

    def hits(log) -> list[str]:
        return [e.kind for e in log if not ("impact" in e.kind and abs(e.v) < SLOW * speed)]

    # The last rest may end just before or just behind the end of the run.
    assert hits(events(data))[: 3 * (CYCLES - 1)] == hits(run.events)[: 3 * (CYCLES - 1)]
