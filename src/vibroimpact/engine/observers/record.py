"""A motion written down: samples at equal times, and every contact and detachment."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.dispatch import (
    acceleration,
    begin,
    displacement,
    face,
    look,
)
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.evaluate import relaxed
from vibroimpact.engine.memory import beyond, stack, workspace
from vibroimpact.engine.motion import BOTH, DETACHED, LEFT, LIMIT, RIGHT, TURNED, Motion, Stretch

# Rows of the samples: a row a variable, so that each is one piece of memory.
DISPLACEMENT, VELOCITY, ACCELERATION, RIGHT_FACE, LEFT_FACE = range(5)
RIGHT_CLEARANCE, LEFT_CLEARANCE, CONTACT, MEMORY = range(5, 9)
SAMPLE = 9

BLOCK = 64
"""Samples that are computed together."""
U = SAMPLE
"""Behind the rows of a block: the displacement, where the mode's own coordinate is still needed."""
samples = stack((SAMPLE + 1) * BLOCK)
"""Room for a block."""

TOUCHING = (0.0, 1.0, -1.0, 2.0)
"""The row CONTACT by mode: none, right, left, both."""

DETACHMENT, CONTACT_BEGINS, IMPACT = 0.0, 1.0, 2.0
"""The column E_KIND."""

# Columns of an event: the state there, and the absolute acceleration just before and behind.
E_CYCLE, E_TIME, E_KIND, E_SIDE, E_U, E_V, E_RIGHT, E_LEFT, E_BEFORE, E_BEHIND = range(10)
E_MEMORY = 10
EVENT = 11


# What is kept of a record between calls.
COLUMNS, BEGIN, STEP, COUNT, NEXT, WRITTEN, LAST, NUMBER = range(8)
note_room = stack(8)
"""Room for it."""


@kernel
def start_notes(
    notes: Vector,
    columns: int,
    begin: int,
    step: float,
    count: int,
    i: int,
    written: int,
    max_events: int,
    number: int,
) -> None:
    """Begin a cycle, `number`.

    Column `begin` + i of the `columns` of the samples is the next, of `count` in this cycle, `step`
    seconds apart; row `written` of the events is the next.
    """
    notes[COLUMNS], notes[BEGIN], notes[STEP], notes[COUNT] = columns, begin, step, count
    notes[NEXT], notes[WRITTEN], notes[LAST] = i, written, written + max_events
    notes[NUMBER] = number


@kernel
def seen(plan: Vector, side: int, mode: int, face: float, distance: float) -> float:
    """Clearance of one side (the paper's eq. 4); zero in contact, NaN where there is no stop."""
    at = par.BUMPER + par.WIDTH * (side - 1)
    if plan[at + par.KIND] == par.ABSENT:
        return math.nan
    return 0.0 if mode & side else plan[at + par.GAP] + (face - distance)


@kernel
def write(plan: Vector, motion: Motion, out: Vector, columns: int, k: int) -> None:
    """Write the motion at this instant as sample k of so many columns."""
    mode, u = motion.mode, motion.u
    right, left = face(plan, motion, RIGHT), face(plan, motion, LEFT)
    # Adding zero leaves no negative one.
    out[DISPLACEMENT * columns + k], out[VELOCITY * columns + k] = u + 0.0, motion.v + 0.0
    out[ACCELERATION * columns + k] = acceleration(plan, motion) + 0.0
    out[RIGHT_FACE * columns + k], out[LEFT_FACE * columns + k] = right + 0.0, 0.0 - left
    out[RIGHT_CLEARANCE * columns + k] = seen(plan, RIGHT, mode, right, u) + 0.0
    out[LEFT_CLEARANCE * columns + k] = seen(plan, LEFT, mode, left, -u) + 0.0
    out[CONTACT * columns + k] = TOUCHING[mode]
    out[MEMORY * columns + k] = motion.z + 0.0


@kernel
def before_end(i: int, n: int, step: float, end: float) -> int:
    """The first of the samples from i to n that does not come before a time."""
    last = n
    if end < n * step:
        last = max(i, int(end / step))
        while last > i and (last - 1) * step >= end:
            last -= 1
        while last < n and last * step < end:
            last += 1
    return last


@kernel
def faces(
    plan: Vector, before: Motion, side: int, t: float, step: float, i: int, n: int, room: Vector
) -> None:
    """Write the face of a side at n samples and its clearance; what the mass does is there."""
    mode, facing = before.mode, 1.0 if side == RIGHT else -1.0
    row, clear = (RIGHT_FACE, RIGHT_CLEARANCE) if side == RIGHT else (LEFT_FACE, LEFT_CLEARANCE)
    row, clear = row * BLOCK, clear * BLOCK
    at = par.BUMPER + par.WIDTH * (side - 1)
    other = par.BUMPER + par.WIDTH * (2 - side)
    gap, rate = plan[at + par.GAP], plan[at + par.RATE]
    if mode & side:
        # The mode's own coordinate is the deformation of the right stop where both are pressed.
        apart = gap + plan[other + par.GAP] if mode == BOTH and side == LEFT else 0.0
        sign = facing if mode == BOTH else 1.0
        for j in range(n):
            room[row + j] = facing * (sign * room[j] - apart)
            room[clear + j] = 0.0
        return
    deformation = before.right if side == RIGHT else before.left
    for j in range(n):
        room[row + j] = 0.0
    if deformation > 0.0:
        for j in range(n):
            tau = max((i + j) * step - t, 0.0)
            room[row + j] = facing * relaxed(deformation, rate, tau)
    if plan[at + par.KIND] == par.ABSENT:
        gap = math.nan
    for j in range(n):
        room[clear + j] = gap + facing * (room[row + j] - room[U * BLOCK + j])


@inlined
def put(out: Vector, to: int, room: Vector, start: int, n: int, sign: float) -> None:
    """Write n numbers of a block to the samples; adding zero leaves no negative one."""
    for j in range(n):
        out[to + j] = sign * room[start + j] + 0.0


@kernel
def sample(
    plan: Vector, notes: Vector, flat: Vector, before: Motion, t: float, reach: float
) -> None:
    """Fill the samples that fall within one stretch.

    The motion itself is not interrupted: what is sampled has no influence.
    """
    i, step = int(notes[NEXT]), notes[STEP]
    end = before_end(i, int(notes[COUNT]), step, t + reach)
    if i >= end:
        return
    series, room = workspace(), samples()
    mode = before.mode
    sign = -1.0 if mode == LEFT else 1.0
    contact = TOUCHING[mode]
    count = int(notes[COLUMNS])
    remembers = plan[par.HYSTERETIC] != 0.0  # else nobody looks at that row
    cursor = begin(plan, before, reach)
    while i < end:
        n = min(end - i, BLOCK)
        cursor = look(plan, cursor, before, t, step, i, n, series, room)
        for j in range(n):
            room[U * BLOCK + j] = displacement(plan, mode, room[j])
        faces(plan, before, RIGHT, t, step, i, n, room)
        faces(plan, before, LEFT, t, step, i, n, room)
        k = int(notes[BEGIN]) + i
        put(flat, DISPLACEMENT * count + k, room, U * BLOCK, n, 1.0)
        put(flat, VELOCITY * count + k, room, VELOCITY * BLOCK, n, sign)
        put(flat, ACCELERATION * count + k, room, ACCELERATION * BLOCK, n, sign)
        for row in range(RIGHT_FACE, CONTACT):
            put(flat, row * count + k, room, row * BLOCK, n, 1.0)
        for j in range(n):
            flat[CONTACT * count + k + j] = contact
        if remembers:
            put(flat, MEMORY * count + k, room, MEMORY * BLOCK, n, 1.0)
        i += n
    notes[NEXT] = i


@kernel
def kind_of(event: int, after: Motion) -> tuple[float, int]:
    """What happens at the end of a stretch, and at the stop of which side."""
    side = after.fresh & BOTH
    if event == DETACHED:
        return DETACHMENT, side
    return (CONTACT_BEGINS if after.mode & side else IMPACT), side


@kernel
def arrived(mode: int, arrival: float, after: Motion) -> Motion:
    """The motion just before an event, from that just after it."""
    _, fresh, u, _, right, left, z, age, clock = after
    return Motion(mode, fresh, u, arrival, right, left, z, age, clock)


@kernel
def write_down(
    plan: Vector, notes: Vector, samples: Vector, events: Vector, stretch: Stretch
) -> None:
    """Write down one stretch and the event that ends it."""
    before, t, event, step, arrival, after = stretch
    if notes[COUNT]:
        sample(plan, notes, samples, before, t, math.inf if event == LIMIT else step)
    if event not in (LIMIT, TURNED) and notes[WRITTEN] < notes[LAST]:
        row = beyond(events, EVENT * int(notes[WRITTEN]))
        row[E_CYCLE], row[E_TIME] = notes[NUMBER], t + step
        kind, side = kind_of(event, after)
        row[E_KIND] = kind
        row[E_SIDE] = 1.0 if side == RIGHT else -1.0
        row[E_U], row[E_V] = after.u, arrival
        row[E_RIGHT], row[E_LEFT] = face(plan, after, RIGHT), -face(plan, after, LEFT)
        row[E_BEFORE] = acceleration(plan, arrived(before.mode, arrival, after))
        row[E_BEHIND] = acceleration(plan, after)
        row[E_MEMORY] = after.z
        notes[WRITTEN] += 1.0
