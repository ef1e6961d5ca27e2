"""A state between calls: a vector in memory, whose width its flow determines (see `flow`)."""

from __future__ import annotations

from typing import NamedTuple

from vibroimpact.engine import flow
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import stack

MODE, FRESH, FIRST = range(3)
"""Where the mode stands, what has just happened, and the first of the parts."""
BEHIND = 3
"""Numbers behind the parts: the age of the mode, and the clock."""

FLIGHT = 0
"""The mode in which no stop is touched; in others, bit j says that stop j is. Touching a rigid one
is resting."""
SETTLING = 8
"""Of what has just happened, the bit of an impact after which all others of a chatter follow at
once; flows that follow each impact never set it."""

Clock = tuple[float, float]
"""Of the forcing: sine and cosine of its phase, or a line's value and slope."""


class Parts(NamedTuple):
    """Where the parts of a state stand, of so many masses, stops and links with a memory.

    In the vector of a state they begin at `first`, behind the mode and what has just happened.
    """

    masses: int
    stops: int
    memories: int = 0
    first: int = FIRST

    @property
    def of_point(self) -> Parts:
        """Where they stand in a point of the section, which has nothing else."""
        return self._replace(first=0)

    @property
    def total(self) -> int:
        """How many there are."""
        return 2 * self.masses + self.stops + self.memories

    @property
    def age(self) -> int:
        """Where the age of the mode stands, after them."""
        return self.first + self.total

    @property
    def width(self) -> int:
        """Length of a state, its clock left out."""
        return self.age + 1

    def displacement(self, mass: int = 0) -> int:
        """Place of a displacement."""
        return self.first + mass

    def velocity(self, mass: int = 0) -> int:
        """Place of a velocity."""
        return self.first + self.masses + mass

    def deformation(self, stop: int) -> int:
        """Place of the deformation of a stop, or of the speed at which it was met."""
        return self.first + 2 * self.masses + stop

    def memory(self, link: int = 0) -> int:
        """Place of what a link remembers."""
        return self.first + 2 * self.masses + self.stops + link


ONE_MASS = Parts(1, 2, 1)
"""Of one mass: stop 0 is on the right, stop 1 on the left, and the isolator may remember."""

MOST_PARTS = 1024
"""Largest number of parts of a motion that is followed."""
LARGEST = 64
"""Of one that is disturbed, or of whose sections a map is made."""

EVENT, T, STEP, ARRIVAL = range(4)
"""Of a stretch between two states: what ended it, the time since the section at its start (s), its
length (s), and the velocity just before the event that ends it, which an impact changes."""

DAMPING, HITS = range(2)
"""Of the notes of `flow.tangent`: the integral of the damping, then the contacts begun at each
stop."""

MEASURES = 3 * LARGEST + 8
"""Largest number of notes of `flow.extremes`, and of what `flow.measured` writes."""

stretch_buffer = stack(4)
"""Room for what stands of a stretch."""
state_buffer = stack(FIRST + MOST_PARTS + BEHIND)
"""Room for a state."""
parts_buffer = stack(LARGEST)
"""Room for a number for each part."""
square_buffer = stack(LARGEST * LARGEST)
"""Room for as many for each."""
notes_buffer = stack(LARGEST)
"""Room for notes of `flow.tangent`."""
measures_buffer = stack(MEASURES)
"""Room for notes of `flow.extremes`."""


@kernel
def width(plan: Vector) -> int:
    """Of a state, its clock left out."""
    return FIRST + flow.parts(plan) + 1


@kernel
def copy(source: Vector, target: Vector, n: int) -> None:
    """Copy n numbers."""
    for i in range(n):
        target[i] = source[i]


@kernel
def put(plan: Vector, source: Vector, target: Vector) -> None:
    """Copy a state with its clock."""
    copy(source, target, width(plan) + 2)


@kernel
def wind(plan: Vector, state: Vector, s: float, c: float) -> None:
    """Set the clock of a state."""
    at = width(plan)
    state[at], state[at + 1] = s, c


@kernel
def load(plan: Vector, kept: Vector, state: Vector, s: float, c: float) -> None:
    """Take a state from a vector without a clock, at a section."""
    copy(kept, state, width(plan))
    wind(plan, state, s, c)


@kernel
def begin_again(plan: Vector, state: Vector) -> None:
    """Say that the mode begins now: the forcing has changed, what had died out is a transient."""
    state[width(plan) - 1] = 0.0


@kernel
def finite(plan: Vector, state: Vector) -> bool:
    """Whether all parts are within the range of numbers."""
    is_finite = True
    for i in range(FIRST, FIRST + flow.parts(plan)):
        is_finite = is_finite and abs(state[i]) < 1e200  # and no NaN
    return is_finite


@kernel
def distance(plan: Vector, one: Vector, other: Vector, units: Vector) -> float:
    """How far the parts of two states are apart, as a velocity."""
    most = 0.0
    for i in range(flow.parts(plan)):
        most = max(most, units[i] * abs(one[FIRST + i] - other[FIRST + i]))
    return most
