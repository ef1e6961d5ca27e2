"""A motion at one instant: one small value, and the only place that knows how it is laid out.

Displacement and velocity are those of the paper. Inside the engine a bumper's deformation is
measured away from the mass (≥ 0) on either side; datasets have the paper's sign, ≤ 0 on the left.
"""

from __future__ import annotations

from typing import NamedTuple

from vibroimpact.engine.jit import Vector, kernel

FLIGHT, RIGHT, LEFT = 0, 1, 2
"""The discrete mode: which bumper the mass touches, if any."""

LIMIT, DETACHED = 0, 3
"""What ends a stretch: the time limit, a contact (RIGHT or LEFT), or a detachment."""

MODE, FRESH, U, V, RIGHT_BUMPER, LEFT_BUMPER, AGE = range(7)
STATE = 7
"""A motion as a vector, between calls; its clock is the section's."""

Clock = tuple[float, float]
"""Sine and cosine of the forcing's phase."""


class Motion(NamedTuple):
    """The state of a rig and of its forcing.

    `fresh` is in flight the side that has just been left (0 if none), in contact whether it
    begins here. `right` and `left` are the bumpers' deformations; in contact the pressed
    bumper's is the primary quantity, the displacement `u` follows from it. `age` says how long
    the mode has lasted (s).
    """

    mode: int
    fresh: int
    u: float
    v: float
    right: float
    left: float
    age: float
    clock: Clock


@kernel
def unpacked(state: Vector, clock: Clock) -> Motion:
    """The motion of a state vector at a section."""
    return Motion(
        int(state[MODE]),
        int(state[FRESH]),
        state[U],
        state[V],
        state[RIGHT_BUMPER],
        state[LEFT_BUMPER],
        state[AGE],
        clock,
    )


@kernel
def pack(motion: Motion, state: Vector) -> None:
    """Write a motion into a state vector."""
    state[MODE], state[FRESH] = motion.mode, motion.fresh
    state[U], state[V] = motion.u, motion.v
    state[RIGHT_BUMPER], state[LEFT_BUMPER] = motion.right, motion.left
    state[AGE] = motion.age


@kernel
def at_section(motion: Motion, clock: Clock) -> Motion:
    """The same motion with the forcing's phase exactly that of the section."""
    mode, fresh, u, v, right, left, age, _ = motion
    return Motion(mode, fresh, u, v, right, left, age, clock)


@kernel
def aged(motion: Motion, age: float) -> Motion:
    """The same motion, its mode said to have lasted so long."""
    mode, fresh, u, v, right, left, _, clock = motion
    return Motion(mode, fresh, u, v, right, left, age, clock)


@kernel
def mirrored(motion: Motion) -> Motion:
    """The mirror image; the clock is left as it is."""
    mode, fresh, u, v, right, left, age, clock = motion
    if mode == FLIGHT:
        fresh = LEFT if fresh == RIGHT else (RIGHT if fresh == LEFT else 0)
    mode = LEFT if mode == RIGHT else (RIGHT if mode == LEFT else FLIGHT)
    return Motion(mode, fresh, -u, -v, left, right, age, clock)


@kernel
def finite(motion: Motion) -> bool:
    """Whether displacement and velocity are within the range of numbers."""
    return abs(motion.u) < 1e200 and abs(motion.v) < 1e200


@kernel
def coordinates(motion: Motion) -> tuple[float, float, float, float, float]:
    """The mode's own coordinates, in which its tables are written.

    Returns
    -------
    sign, x, v, s, c
        x is the displacement in flight, the pressed bumper's deformation in contact; a left
        contact is given as the mirror image of a right one, with `sign` −1.
    """
    s, c = motion.clock
    if motion.mode == RIGHT:
        return 1.0, motion.right, motion.v, s, c
    if motion.mode == LEFT:
        return -1.0, motion.left, -motion.v, -s, -c
    return 1.0, motion.u, motion.v, s, c
