"""Any shaking, a constant force and no spring against the independent integration to fifty digits.

Over `CYCLES` cycles, or `SECONDS` of a record, from rest or far from the steady motion, with
contacts on both sides: the state at each section, or sample, agrees within 1e-11 of the largest
displacement (or velocity), and so do the events.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

import vibroimpact as vi
from reference import fifty_digits
from reference.public_motion import (
    assert_agreement,
    reference_rig,
    reference_shaking,
    reference_start,
)
from samples import sample

CYCLES = sample(20, 2)
SECONDS = sample(20.0, 8.0)
TOLERANCE = 1e-11

Wall, Bumper = vi.RigidStop, vi.Bumper
BUMPERS = (Bumper(20.0, 0.9, 0.1), Bumper(15.0, 0.5, 0.2))
WALLS = (Wall(0.8, 0.5), Wall(0.6, 0.4))
SPRING, DASHPOT, NOTHING = vi.Isolator(1.0, 0.1), vi.Isolator(0.0, 0.3), vi.Isolator(0.0, 0.0)
FLYING = vi.State()
"""On a wall, where a constant force holds it, a rest may end at once: no event of the reference."""


class Setup(NamedTuple):
    """With M = 2, so that a force is no acceleration."""

    isolator: vi.Isolator
    stops: tuple[vi.Bumper | vi.RigidStop, vi.Bumper | vi.RigidStop]
    shaken: vi.Harmonic | vi.Periodic
    force: float = 0.0
    start: vi.State | None = None

    @property
    def rig(self) -> vi.Oscillator:
        return vi.Oscillator(2.0, self.isolator, *self.stops, force=self.force)


def periodic(frequency: float, of: str, *sizes: float) -> vi.Periodic:
    return vi.Periodic(frequency, sizes, [0.7 * n for n in range(len(sizes))], 0.3, of=of)


SETUPS = {
    "harmonics between bumpers": Setup(SPRING, BUMPERS, periodic(0.2, "acceleration", 1, 0.5, 0.7)),
    "harmonics between walls": Setup(SPRING, WALLS, periodic(0.17, "acceleration", 1, 0, 0.4)),
    "harmonics, chatter and rest": Setup(
        SPRING, (Wall(0.3, 0.2), Wall(0.6, 0.1)), periodic(0.04, "acceleration", 1, 0.6, 0.5)
    ),
    "a high harmonic": Setup(
        SPRING, (Wall(0.6, 0.1), BUMPERS[1]), periodic(0.13, "acceleration", 1, *[0] * 5, 2)
    ),
    "a moved base": Setup(SPRING, BUMPERS, vi.Harmonic(0.4, 0.22, 0.3, of="displacement")),
    "a moved base, a wall faces a bumper": Setup(
        SPRING, (WALLS[0], BUMPERS[0]), vi.Harmonic(0.7, 0.18, of="displacement")
    ),
    "a moved base, chatter and rest": Setup(
        SPRING, (Wall(0.3, 0.2), Wall(0.6, 0.1)), vi.Harmonic(15.0, 0.04, of="displacement")
    ),
    "a base moved in harmonics": Setup(SPRING, BUMPERS, periodic(0.15, "displacement", 1, 0.1)),
    "a force": Setup(SPRING, BUMPERS, vi.Harmonic(1.5, 0.25, 0.3, of="force")),
    "a force in harmonics between walls": Setup(SPRING, WALLS, periodic(0.13, "force", 2, 1, 0.5)),
    "a force, chatter and rest": Setup(
        SPRING, (Wall(0.3, 0.2), Wall(0.6, 0.1)), vi.Harmonic(2.0, 0.05, of="force")
    ),
    "an unbalance": Setup(SPRING, BUMPERS, vi.Harmonic(1.2, 0.25, 0.3, of="unbalance")),
    "unbalances of two shafts between walls": Setup(
        SPRING, WALLS, periodic(0.13, "unbalance", 2, 0.7)
    ),
    "a constant force": Setup(SPRING, BUMPERS, vi.Harmonic(1.0, 0.25), 0.7),
    "a constant force between walls": Setup(SPRING, WALLS, vi.Harmonic(1.5, 0.2), -0.8),
    "a constant force, chatter and rest": Setup(
        SPRING,
        (Wall(0.5, 0.1), Wall(0.4, 0.3)),
        periodic(0.04, "acceleration", 1, 0.3),
        0.7,
        FLYING,
    ),
    "a constant force on preloaded bumpers": Setup(
        SPRING, (Bumper(6.0, 0.8, -0.3), Bumper(9.0, 0.4, -0.1)), vi.Harmonic(9.0, 0.3), 1.3
    ),
    "no spring between bumpers": Setup(NOTHING, BUMPERS, vi.Harmonic(0.5, 0.2)),
    "no spring between walls": Setup(NOTHING, WALLS, vi.Harmonic(0.7, 0.2), 0.1),
    "no spring, a dashpot between bumpers": Setup(DASHPOT, BUMPERS, vi.Harmonic(0.6, 0.2), 0.4),
    "no spring, a dashpot between walls": Setup(DASHPOT, WALLS, vi.Harmonic(1.5, 0.25)),
    "no spring between elastic bumpers": Setup(
        NOTHING, (Bumper(5.0, 0.0, 0.1), Bumper(5.0, 0.0, 0.1)), vi.Harmonic(0.6, 0.15, 0.5)
    ),
    "no spring, chatter and rest": Setup(
        NOTHING, (Wall(0.5, 0.1), Wall(0.3, 0.2)), vi.Harmonic(1.0, 0.07)
    ),
    "no spring, harmonics, chatter and rest": Setup(
        DASHPOT, (Wall(0.5, 0.1), Wall(0.3, 0.2)), periodic(0.09, "force", 1, 0, 1), 0.1
    ),
    "a bouncing mass": Setup(
        NOTHING,
        (Wall(0.3, 40.0), Wall(0.5, 0.0)),
        vi.Harmonic(12.0, 0.5),
        -19.6,
        vi.State(1.0, 0.0),
    ),
}


@pytest.mark.parametrize("name", sample([*SETUPS], [*SETUPS][::2]))
def test_sections_and_events_agree_with_fifty_digits(name: str) -> None:
    setup = SETUPS[name]
    rig, shaken = setup.rig, setup.shaken
    data = vi.simulate(vi.Rig(rig, shaken), CYCLES, setup.start, samples=1)
    run = fifty_digits.follow(
        reference_rig(rig),
        reference_shaking(rig, shaken),
        reference_start(rig, setup.start),
        CYCLES,
    )
    kinds = assert_agreement(data, run, shaken.period, TOLERANCE)
    assert len(kinds) >= 5
    if name != "a bouncing mass":
        assert {kind.split("_")[1] for kind in kinds} == {"right", "left"}
    if "rest" in name:
        assert any(kind.startswith("detach") for kind in kinds)


def rough(step: float, size: float, seed: int = 3) -> vi.Record:
    """Noise, as long as is followed."""
    count = round(SECONDS / step)
    return vi.Record(np.random.default_rng(seed).uniform(-size, size, count + 1), step)


def rounded(values: Callable[[NDArray[np.float64]], NDArray[np.float64]], step: float) -> vi.Record:
    """A smooth record."""
    return vi.Record(values(step * np.arange(round(SECONDS / step) + 1)), step)


RECORDS: dict[str, tuple[vi.Oscillator, vi.Record]] = {
    "between bumpers": (vi.Oscillator(2.0, SPRING, *BUMPERS), rough(0.1, 6.0)),
    "between walls": (
        vi.Oscillator(2.0, SPRING, Wall(0.4, 0.5), Wall(0.3, 0.4)),
        rough(0.1, 14.0, 6),
    ),
    "a wall faces a bumper": (
        vi.Oscillator(2.0, SPRING, WALLS[1], BUMPERS[1], force=0.3),
        rough(0.25, 4.0),
    ),
    "chatter and rest": (
        vi.Oscillator(2.0, SPRING, Wall(0.3, 0.2), Wall(0.6, 0.1)),
        rounded(lambda t: 2.0 * np.sin(0.9 * t) + np.sin(2.3 * t + 1.0), 0.2),
    ),
    "preloaded bumpers": (
        vi.Oscillator(2.0, SPRING, Bumper(6.0, 0.8, -0.3), Bumper(9.0, 0.4, -0.1)),
        rough(0.2, 30.0),
    ),
    "no spring": (vi.Oscillator(2.0, DASHPOT, WALLS[0], BUMPERS[0]), rough(0.2, 4.0)),
}


@pytest.mark.parametrize("name", RECORDS)
def test_a_record_agrees_with_fifty_digits(name: str) -> None:
    rig, record = RECORDS[name]
    data = vi.simulate(vi.Rig(rig, record))
    spans = len(record.acceleration) - 1
    assert record.duration == pytest.approx(SECONDS)
    run = fifty_digits.follow(
        reference_rig(rig),
        reference_shaking(rig, record),
        reference_start(rig, None),
        spans,
        order=36,
    )
    kinds = assert_agreement(data, run, record.step, TOLERANCE)
    assert {kind.split("_")[1] for kind in kinds} == {"right", "left"}
    assert len(kinds) >= 5
    if "rest" in name:
        assert any(kind.startswith("detach") for kind in kinds)
