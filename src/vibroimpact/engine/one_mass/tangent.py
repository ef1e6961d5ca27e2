"""What becomes of a small disturbance of a motion: the exact tangent flow.

A disturbance is (δu, δu̇, δu_R, δu_L, δz) at a fixed forcing phase. Within a phase it obeys the
homogeneous equation of motion; at an event it jumps (see `saltation`). A free bumper's δu_j fades
as the bumper relaxes, at once without a dashpot. In contact δu_j = δu, so that every contact loses
the bumper's own direction (docs/theory.md, section 6).
"""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.event import begins_contact, stop_of
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import (
    mirrored,
    pack,
    stretch_of,
    unpacked,
)
from vibroimpact.engine.one_mass.disturbed_events import DISTURBANCE, MEMORY
from vibroimpact.engine.one_mass.motions import carry
from vibroimpact.engine.state import DAMPING, HITS, MODE


@kernel
def mirror(plan: Vector, state: Vector, q: Vector) -> None:
    """See `flow.mirror`."""
    pack(mirrored(unpacked(state)), state)
    for i in range(DISTURBANCE):
        at = i * DISTURBANCE
        q[at], q[at + 1] = -q[at], -q[at + 1]
        q[at + 2], q[at + 3] = -q[at + 3], -q[at + 2]
        q[at + 4] = -q[at + 4]


@kernel
def unit_disturbances(plan: Vector, state: Vector, q: Vector) -> None:
    """Write a unit disturbance of each component into the rows of q.

    A pressed bumper has none of its own: its row is zero, and that of the displacement moves it.
    So has an isolator without memory, and a stop that does not ask how fast it was met.
    """
    mode = int(state[MODE])
    for i in range(DISTURBANCE):
        for j in range(DISTURBANCE):
            q[i * DISTURBANCE + j] = 1.0 if i == j else 0.0
    if plan[par.HYSTERETIC] == 0.0:
        q[MEMORY * DISTURBANCE + MEMORY] = 0.0
    for stop in range(2):
        at = par.stop_at(stop)
        if mode >> stop & 1:
            own = plan[at + par.DISSIPATION] < 0.0
            q[2 + stop] = 1.0 if plan[at + par.KIND] <= par.RIGID else 0.0
            q[(2 + stop) * DISTURBANCE + 2 + stop] = 1.0 if own else 0.0


@kernel
def tangent(
    plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector, q: Vector
) -> None:
    """Carry a disturbance of each component, the rows of q, through one stretch."""
    stretch = stretch_of(before, ended, after)
    notes[DAMPING] += carry(plan, stretch, q, DISTURBANCE)
    if begins_contact(stretch.event):
        notes[HITS + stop_of(stretch.event)] += 1.0
