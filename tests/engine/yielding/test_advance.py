"""Legs between tables where it is easy to go wrong, against Taylor steps and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from engine.yielding.rigs import followed, started, vectors
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.state import ONE_MASS

FRICTION = vi.FrictionIsolator(1.0, 0.01, 0.15)
SOFT = vi.BilinearIsolator(10.0, 0.05, 4.0, 0.02)
WALL, STOP = vi.RigidStop(0.6, 0.05), vi.RigidStop(0.0, 0.0)
SHAKEN = vi.Harmonic(0.4, 0.05, 3.1)


def both(rig, shaken, samples=1, cycles=8):
    """The motion by tables and by Taylor steps; neither is given up."""
    runs = [
        followed(vector, shaken, started(rig), 0.0, samples, cycles)
        for vector in vectors(rig, shaken)
    ]
    assert [one[0] for one in runs] == [0, 0]
    return runs


CASES = {
    # An impact between the last node and the end of the cycle, and a turn behind it.
    "a wall met at the end of a cycle": (
        vi.BilinearIsolator(29.8, 0.19, 22.7, 0.0),
        vi.RigidStop(0.36, 0.56),
        vi.RigidStop(0.62, 0.05),
        vi.Harmonic(0.667, 0.298, 1.63),
    ),
    "held by friction, then pressed to a wall": (FRICTION, None, STOP, SHAKEN),
    # Without a spring it would come back to the wall without speed, and touch it by rounding.
    "held on a wall by friction": (vi.FrictionIsolator(0.05, 0.3, 0.14), STOP, None, SHAKEN),
    "let go by a wall without acceleration": (SOFT, None, STOP, SHAKEN),
    "two walls in turn": (SOFT, WALL, WALL, SHAKEN.replace(amplitude=2.0)),
    "a bumper and a wall at one place": (
        vi.BilinearIsolator(8.9, 0.05, 0.49, 0.01), STOP, vi.Bumper(50.8, 0.0, 0.0), SHAKEN
    ),
    "far from where it would rest": (
        vi.BilinearIsolator(20.0, 1e-6, 3.0, 0.0), vi.Bumper(300.0, 2.0, 0.5), None,
        vi.Harmonic(3.3, 0.4, 0.2),
    ),
    "preloaded": (FRICTION, vi.Bumper(300.0, 9.0, -0.1), vi.Bumper(90.0, 0.0, 0.3), SHAKEN),
    "overdamped bumpers": (
        SOFT, vi.Bumper(40.0, 90.0, 0.1), vi.Bumper(9e3, 400.0, 0.1), vi.Harmonic(3.0, 0.3)
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_tables_and_taylor_steps_agree(name: str) -> None:
    isolator, right, left, shaken = CASES[name]
    (_, ours, events, end), (_, theirs, others, last) = both(
        vi.Oscillator(1.0, isolator, right, left), shaken, samples=20
    )
    np.testing.assert_allclose(
        ours[: record_layout.ACCELERATION], theirs[: record_layout.ACCELERATION], atol=1e-12
    )
    np.testing.assert_allclose(end, last, atol=1e-12)
    np.testing.assert_allclose(events, others, atol=1e-8)


def test_turns_are_no_events_of_a_history() -> None:
    (_, _, events, _), (_, _, others, _) = both(vi.Oscillator(1.0, FRICTION), vi.Harmonic(1.0, 0.2))
    assert len(events) == len(others) == 0


def test_a_record_is_followed() -> None:
    """From sample to sample, between which the shaking is a line."""
    t = np.linspace(0.0, 30.0, 1501)
    shaken = vi.Record(2.0 * np.sin(0.9 * t) * np.sin(3.7 * t), t[1])
    bumper = vi.Bumper(300.0, 2.0, 0.2)
    for isolator in (FRICTION, SOFT):
        rig = vi.Oscillator(1.0, isolator, bumper, bumper)
        ends = []
        for other in (isolator, isolator.replace(damping_exponent=1.0 + 1e-13)):  # not by tables
            data = vi.simulate(vi.Rig(rig.replace(isolator=other), shaken))
            ends.append(data[["displacement", "velocity"]].to_array().values)
        np.testing.assert_allclose(ends[0], ends[1], atol=1e-11)
        assert np.abs(ends[0][0]).max() > 0.2  # the bumpers are met


def test_the_clock_does_not_grow() -> None:
    """Many legs a cycle in a stiff contact: each takes the clock on by rounded rows."""
    rig = vi.Oscillator(1.0, vi.BilinearIsolator(24.0, 0.25, 1.9, 0.3), None,
                        vi.Bumper(1145.0, 3.4, 1e-9))  # fmt: skip
    (_, ours, _, _), (_, theirs, _, _) = both(rig, vi.Harmonic(2.7, 0.107, 5.68), cycles=1)
    np.testing.assert_allclose(ours[:2], theirs[:2], atol=5e-14)


def test_free_slides_are_as_long_as_in_closed_form() -> None:
    """Each half swing of a mass on friction ends nearer to 0 by twice F/K."""
    still = vi.Harmonic(1e-300, 1.0 / math.pi)
    rig = vi.Oscillator(1.0, vi.FrictionIsolator(4.0, 0.0, 0.2))
    ends = [
        vi.simulate(vi.Rig(rig, still), cycles, vi.State(1.0), samples=0)["final_state"].values
        for cycles in (0.5, 1.0, 3.0, 20.0)
    ]
    np.testing.assert_allclose([end[0] for end in ends], [-0.9, 0.8, 0.4, 0.0], atol=1e-14)
    assert ends[-1][ONE_MASS.velocity() - ONE_MASS.displacement()] == 0.0
