"""What becomes of small disturbances: the exact tangent flow.

A disturbance is a row (δu, δv, δ of each stop's deformation) at a fixed forcing phase. Within a
mode it obeys the homogeneous equations. At an event, the disturbed motion is late by
δt = −δg/ġ, where g is the watched function:

- A Kelvin–Voigt stop is met: (δu, δv) += (f⁻ − f⁺) δt. As the force begins with −c ġ, the closing
  speed cancels: δv += M⁻¹w c δg. Then δ of the pressed deformation is w·δu.
- It is left: both vector fields agree, nothing happens. The same where a rest ends.
- Impact: R(δy + f⁻ δt) − f⁺ δt, R x = x − (1 + r′) M⁻¹w (w·x)/(wᵀM⁻¹w) on velocities, r(ġ) the
  speed with which the bodies part.
- Rest begins: the same with the projection onto what all resting stops allow.
"""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.channels import (
    close_stretch,
    fade,
    open_stretch,
    piece_length,
    pieces,
)
from vibroimpact.engine.assembly.events import accelerations, closing, halt
from vibroimpact.engine.assembly.mode import enter_mode
from vibroimpact.engine.assembly.series import expand_state, travel_by_series
from vibroimpact.engine.event import (
    CONTACT,
    GIVEN_UP,
    IMPACT,
    LIMIT,
    begins_contact,
    kind_of,
    stop_of,
)
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.state import DAMPING, HITS, MODE
from vibroimpact.engine.stops.rebound import Rebound, rebound


@kernel
def tie(plan: Vector, row: Vector) -> None:
    """A pressed stop's disturbance is that of its closing displacement; a resting one has none."""
    n, mode = int(plan[at.MASSES]), int(plan[at.MODE])
    for f in range(int(plan[at.STOPS])):
        one = int(plan[at.STOP]) + f * at.STOP_WIDTH
        if plan[one + at.KIND] == at.RIGID:
            row[2 * n + f] = 0.0
        elif mode >> f & 1:
            row[2 * n + f] = closing(plan, f, row)
        elif plan[one + at.STOP_DAMPING] == 0.0:
            row[2 * n + f] = 0.0


def disturbing(tie: Any) -> Any:
    """Make `flow.unit_disturbances` of a flow, of what ties the parts of a disturbance."""

    def unit_disturbances(plan: Vector, state: Vector, q: Vector) -> None:
        enter_mode(plan, int(state[MODE]))
        n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
        width = 2 * n + count
        for i in range(width):
            row = beyond(q, i * width)
            for j in range(width):
                row[j] = 1.0 if i == j else 0.0
            tie(plan, row)

    return kernel(unit_disturbances)


unit_disturbances = disturbing(tie)


@not_inlined
def carry_disturbances(plan: Vector, q: Vector, rows: int) -> None:
    """Carry the rows of q through the last stretch and its event."""
    n, w, count = int(plan[at.MASSES]), int(plan[at.WAVES]), int(plan[at.STOPS])
    width = 2 * n + count
    kind = kind_of(int(plan[at.EVENT]))
    open_stretch(plan)
    y = beyond(plan, int(plan[at.PIECE_Y]))
    length = piece_length(plan)
    if length > 0.0:
        for i in range(rows):
            row = beyond(q, i * width)
            deformation = beyond(row, 2 * n)
            for k in range(2 * n):
                y[k] = row[k]
            for k in range(w + 1):
                y[2 * n + k] = 0.0
            for _ in range(pieces(plan)):
                expand_state(plan, y, deformation, length)
                travel_by_series(plan, y, deformation, 1.0)
                fade(plan, deformation, length)
            for k in range(2 * n):
                row[k] = y[k]
    if kind == IMPACT:
        accelerations_at(plan, at.END, at.END_DEFORMATION, int(plan[at.ROOM]))
    close_stretch(plan)
    if kind in (LIMIT, GIVEN_UP):
        return
    before = int(plan[at.ROOM])
    after = before + 2 * (n + 1 + count)
    if kind == IMPACT:
        accelerations_at(plan, at.Y, at.DEFORMATION, after)
    for i in range(rows):
        row = beyond(q, i * width)
        if kind == IMPACT:
            reflect(plan, row, beyond(plan, before), beyond(plan, after))
        elif kind == CONTACT:
            meet(plan, row)
        tie(plan, row)


@kernel
def contraction(plan: Vector, mode: int) -> float:
    """Minus the trace of what the state's derivative is of u and v in a mode (1/s)."""
    n, count, stops = int(plan[at.MASSES]), int(plan[at.STOPS]), int(plan[at.STOP])
    total = 0.0
    for i in range(n):
        total += plan[int(plan[at.DAMPING]) + i * n + i]
    for f in range(count):
        if mode >> f & 1:
            dashpot = plan[stops + f * at.STOP_WIDTH + at.STOP_DAMPING]
            total += dashpot * plan[int(plan[at.COUPLING]) + f * count + f]
    return total


@kernel
def rebound_at_end(plan: Vector, f: int) -> Rebound:
    """What a rigid stop makes of the closing speed at the end of the last stretch."""
    arrived = beyond(plan, int(plan[at.END]) + int(plan[at.MASSES]))
    place = int(plan[at.STOP]) + f * at.STOP_WIDTH + at.REBOUND
    law: Rebound = rebound(plan, place, max(closing(plan, f, arrived), 0.0))
    return law


@kernel
def note(plan: Vector, notes: Vector) -> None:
    """Note what the last stretch and its event take of a volume of (u, v), and the contact.

    An impact multiplies what is left of it by e r′, a rest leaves nothing.
    """
    event, length = int(plan[at.EVENT]), plan[at.LENGTH]
    f = stop_of(event)
    notes[DAMPING] += length * contraction(plan, int(plan[at.STRETCH_MODE]))
    if begins_contact(event):
        notes[HITS + f] += 1.0
    if kind_of(event) == IMPACT:
        e, order, _ = rebound_at_end(plan, f)
        left = e > 0.0 and not int(plan[at.MODE]) >> f & 1
        notes[DAMPING] += -2.0 * math.log(e) - math.log(order) if left else math.inf


@kernel
def tangent(
    plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector, q: Vector
) -> None:
    """See `flow.tangent`."""
    note(plan, notes)
    carry_disturbances(plan, q, 2 * int(plan[at.MASSES]) + int(plan[at.STOPS]))


@kernel
def accelerations_at(plan: Vector, state: int, deformations: int, place: int) -> None:
    """The accelerations of a state that is kept in the plan, in the mode that was entered."""
    n = int(plan[at.MASSES])
    y = beyond(plan, int(plan[state]))
    deformation = beyond(plan, int(plan[deformations]))
    accelerations(plan, y, beyond(y, n), beyond(y, 2 * n), deformation, 1.0, place)


@kernel
def meet(plan: Vector, row: Vector) -> None:
    """Let a disturbance meet a Kelvin–Voigt stop."""
    n, f = int(plan[at.MASSES]), stop_of(int(plan[at.EVENT]))
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    gap = row[2 * n + f] - closing(plan, f, row)
    push = plan[one + at.STOP_DAMPING] * gap
    response = int(plan[at.RESPONSE]) + f * n
    for k in range(int(plan[one + at.FIRST]), int(plan[one + at.BEHIND])):
        row[n + k] += plan[response + k] * push
    if plan[at.RESTING] > 0.0:
        halt(plan, row)


@kernel
def reflect(plan: Vector, row: Vector, before: Vector, after: Vector) -> None:
    """Let a disturbance through an impact; the accelerations before and after it are known."""
    n, f = int(plan[at.MASSES]), stop_of(int(plan[at.EVENT]))
    count = int(plan[at.STOPS])
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    arrived = beyond(plan, int(plan[at.END]) + n)
    left = beyond(plan, int(plan[at.Y]) + n)
    speed = closing(plan, f, arrived)
    late = -closing(plan, f, row) / speed if speed > 0.0 else 0.0
    for k in range(n):
        row[k] += (arrived[k] - left[k]) * late
        row[n + k] += before[k] * late
    if int(plan[at.MODE]) >> f & 1:
        halt(plan, row)
    else:
        e = -closing(plan, f, left) / speed if speed > 0.0 else 0.0
        coupling = plan[int(plan[at.COUPLING]) + f * count + f]
        slope = e * rebound_at_end(plan, f).order
        kick = (1.0 + slope) * closing(plan, f, beyond(row, n)) / coupling
        response = int(plan[at.RESPONSE]) + f * n
        for k in range(int(plan[one + at.FIRST]), int(plan[one + at.BEHIND])):
            row[n + k] -= plan[response + k] * kick
    for k in range(n):
        row[n + k] -= after[k] * late
