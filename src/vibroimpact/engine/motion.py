"""A motion at one instant: one small value, and the only place that knows how it is laid out.

Displacement and velocity are those of the paper. Stop 0 is the right one, stop 1 the left one;
deformations of both are measured away from the mass (≥ 0).
"""

from __future__ import annotations

from typing import NamedTuple

from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.layout import Row
from vibroimpact.engine.state import ARRIVAL, EVENT, FRESH, MODE, ONE_MASS, STEP, Clock, T

RIGHT, LEFT = 1 << 0, 1 << 1
BOTH = RIGHT | LEFT
"""Modes in contact, by the stops that the mass touches (`state.MODE`)."""

SEEN_LEFT = 4
"""The table of BOTH in the left bumper's coordinates; that of the right one is BOTH itself."""

RELEASED = 4
"""Added to the bit of the stop that has just been left if the mass was at rest there."""

SLIPS = 16
"""Shifted by the number of the stop towards which it goes, still without velocity: the bit of a
mass that friction has just let go."""
SLIPPED = SLIPS | SLIPS << 1
"""Both of these bits."""

U, V = ONE_MASS.displacement(), ONE_MASS.velocity()
FACES = ONE_MASS.deformation(0)
ISOLATOR = ONE_MASS.memory()
AGE = ONE_MASS.age
STATE = ONE_MASS.width
"""A motion as a vector, between calls; its clock follows."""

Pair = tuple[float, float]
"""A number for each stop."""


@inlined
def facing(stop: int) -> float:
    """The sign of a displacement towards a stop."""
    return 1.0 if stop == 0 else -1.0


@inlined
def changed(pair: Pair, stop: int, x: float) -> Pair:
    """The same numbers with another one for a stop."""
    return (x, pair[1]) if stop == 0 else (pair[0], x)


class Motion(NamedTuple):
    """The state of a rig and of its forcing.

    `fresh` is the bit of the stop at which something has just happened (0 if nothing): the mode
    shows whether it was touched or left. `faces` are the stops' deformations; in contact the
    pressed bumper's is the primary quantity, the displacement `u` follows from it. `z` is what
    the isolator remembers (m), `age` how long the mode has lasted (s).
    """

    mode: int
    fresh: int
    u: float
    v: float
    faces: Pair
    z: float
    age: float
    clock: Clock


class Stretch(NamedTuple):
    """What lies between two events.

    `t` is the time since the section at its start, `event` what ends it (see `event`), `step` its
    length (s), `arrival` the velocity just before the event, which an impact changes.
    """

    before: Motion
    t: float
    event: int
    step: float
    arrival: float
    after: Motion


Ended = tuple[int, float, float, Motion]
"""event, t, arrival, motion: what ended a stretch (see `event`), its length (s), the velocity
just before, and the motion just behind."""


@kernel
def arrived(mode: int, arrival: float, after: Motion) -> Motion:
    """The motion just before an event, from that just after it."""
    _, fresh, u, _, faces, z, age, clock = after
    return Motion(mode, fresh, u, arrival, faces, z, age, clock)


@kernel
def unpacked(state: Vector) -> Motion:
    """The motion of a state vector, with its clock."""
    return Motion(
        int(state[MODE]),
        int(state[FRESH]),
        state[U],
        state[V],
        (state[FACES], state[FACES + 1]),
        state[ISOLATOR],
        state[AGE],
        (state[STATE], state[STATE + 1]),
    )


@kernel
def pack(motion: Motion, state: Vector) -> None:
    """Write a motion into a state vector, with its clock."""
    state[MODE], state[FRESH] = motion.mode, motion.fresh
    state[U], state[V] = motion.u, motion.v
    state[FACES], state[FACES + 1] = motion.faces
    state[ISOLATOR], state[AGE] = motion.z, motion.age
    state[STATE], state[STATE + 1] = motion.clock


@kernel
def stretch_of(before: Vector, ended: Vector, after: Vector) -> Stretch:
    """The stretch between two states, as an observer gets it."""
    event, arrival = int(ended[EVENT]), ended[ARRIVAL]
    return Stretch(unpacked(before), ended[T], event, ended[STEP], arrival, unpacked(after))


def swapped(sides: int) -> int:
    """Right for left, other bits as they are."""
    pairs = RIGHT | SLIPS
    return (sides & ~(pairs | pairs << 1)) | (sides & pairs) << 1 | (sides >> 1) & pairs


_swapped = kernel(swapped)


@kernel
def mirrored(motion: Motion) -> Motion:
    """The mirror image; the clock is left as it is."""
    mode, fresh, u, v, faces, z, age, clock = motion
    mirror = (faces[1], faces[0])
    return Motion(_swapped(mode), _swapped(fresh), -u, -v, mirror, -z, age, clock)


@inlined
def main_stop(mode: int) -> int:
    """The pressed stop whose deformation is the mode's own coordinate."""
    return 1 if mode == LEFT else 0


@inlined
def direction(mode: int) -> float:
    """The sign of a displacement along the mode's own coordinate."""
    return -1.0 if mode == LEFT else 1.0


@kernel
def coordinates(motion: Motion) -> tuple[float, Row]:
    """The mode's own coordinates, in which its tables are written.

    Returns
    -------
    sign, row
        `sign` is −1 where it is the mirror image's. Pressed on both sides, the mass is seen from
        the right.
    """
    s, c = motion.clock
    if motion.mode & RIGHT:
        return 1.0, Row(motion.faces[0], motion.v, s, c)
    if motion.mode == LEFT:
        return -1.0, Row(motion.faces[1], -motion.v, -s, -c)
    return 1.0, Row(motion.u, motion.v, s, c)
