"""A motion written down: samples at equal times, and every contact and detachment."""

from __future__ import annotations

import math
from typing import NamedTuple

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
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import BOTH, DETACHED, LEFT, LIMIT, RIGHT, TURNED, Motion, Stretch
from vibroimpact.engine.observe import observer

# Rows of the samples: a row a variable, so that each is one piece of memory.
DISPLACEMENT, VELOCITY, ACCELERATION, RIGHT_FACE, LEFT_FACE = range(5)
RIGHT_CLEARANCE, LEFT_CLEARANCE, CONTACT, MEMORY = range(5, 9)
SAMPLE = 9

TOUCHING = (0.0, 1.0, -1.0, 2.0)
"""The row CONTACT by mode: none, right, left, both."""

DETACHMENT, CONTACT_BEGINS, IMPACT = 0.0, 1.0, 2.0
"""The column E_KIND."""

# Columns of an event: the state there, and the absolute acceleration just before and behind.
E_CYCLE, E_TIME, E_KIND, E_SIDE, E_U, E_V, E_RIGHT, E_LEFT, E_BEFORE, E_BEHIND = range(10)
E_MEMORY = 10
EVENT = 11


class Record(NamedTuple):
    """Where to write.

    Column `begin` + i of `samples` is the next, of n in this cycle, `step` seconds apart; row
    `written` of `events` is the next, in cycle `number`, and `last` the first that must not be
    written.
    """

    samples: Vector
    begin: int
    step: float
    n: int
    i: int
    events: Vector
    written: int
    last: int
    number: int


@kernel
def seen(plan: Vector, side: int, mode: int, face: float, distance: float) -> float:
    """Clearance of one side (the paper's eq. 4); zero in contact, NaN where there is no stop."""
    at = par.BUMPER + par.WIDTH * (side - 1)
    if plan[at + par.KIND] == par.ABSENT:
        return math.nan
    return 0.0 if mode & side else plan[at + par.GAP] + (face - distance)


@inlined
def write_sample(
    plan: Vector,
    mode: int,
    contact: float,
    u: float,
    v: float,
    acceleration: float,
    right: float,
    left: float,
    z: float,
    out: Vector,
    k: int,
) -> None:
    """Write sample k; `contact` is that of the mode, deformations are given away from the mass."""
    # Adding zero leaves no negative one.
    out[DISPLACEMENT, k], out[VELOCITY, k] = u + 0.0, v + 0.0
    out[ACCELERATION, k] = acceleration + 0.0
    out[RIGHT_FACE, k], out[LEFT_FACE, k] = right + 0.0, 0.0 - left
    out[RIGHT_CLEARANCE, k] = seen(plan, RIGHT, mode, right, u) + 0.0
    out[LEFT_CLEARANCE, k] = seen(plan, LEFT, mode, left, -u) + 0.0
    out[CONTACT, k] = contact
    out[MEMORY, k] = z + 0.0


@kernel
def write(plan: Vector, motion: Motion, out: Vector, k: int) -> None:
    """Write the motion at this instant as sample k."""
    mode, u, v = motion.mode, motion.u, motion.v
    right, left = face(plan, motion, RIGHT), face(plan, motion, LEFT)
    a = acceleration(plan, motion)
    write_sample(plan, mode, TOUCHING[mode], u, v, a, right, left, motion.z, out, k)


@kernel
def sample(plan: Vector, notes: Record, before: Motion, t: float, reach: float) -> int:
    """Fill the samples that fall within one stretch; return the next one.

    The motion itself is not interrupted: what is sampled has no influence.
    """
    i, n, step = notes.i, notes.n, notes.step
    if not (i < n and i * step < t + reach):
        return i
    series = workspace()
    mode = before.mode
    sign = -1.0 if mode == LEFT else 1.0
    contact = TOUCHING[mode]
    gap_r, rate_r = plan[par.BUMPER + par.GAP], plan[par.BUMPER + par.RATE]
    gap_l, rate_l = plan[par.BUMPER + par.WIDTH + par.GAP], plan[par.BUMPER + par.WIDTH + par.RATE]
    cursor = begin(plan, before, reach)
    about = -1  # the node that the series is about
    while i < n and i * step < t + reach:
        tau = max(i * step - t, 0.0)
        cursor, about, x, v, a, z = look(plan, cursor, before, tau, about, series)
        a *= sign
        right = x if mode & RIGHT else relaxed(before.right, rate_r, tau)
        left = x if mode == LEFT else relaxed(before.left, rate_l, tau)
        if mode == BOTH:
            left = -x - (gap_r + gap_l)
        u = displacement(plan, mode, x)
        k = notes.begin + i
        write_sample(plan, mode, contact, u, sign * v, a, right, left, z, notes.samples, k)
        i += 1
    return i


@observer(Record)
def record(plan: Vector, notes: Record, stretch: Stretch) -> Record:
    """Write down one stretch and the event that ends it."""
    before, t, event, step, arrival, after = stretch
    samples, first, spacing, n, i, events, written, last, number = notes
    if n:
        i = sample(plan, notes, before, t, math.inf if event == LIMIT else step)
    if event not in (LIMIT, TURNED) and written < last:
        row = events[written]
        row[E_CYCLE], row[E_TIME] = number, t + step
        side = after.fresh & BOTH
        row[E_KIND] = DETACHMENT
        if event != DETACHED:
            row[E_KIND] = CONTACT_BEGINS if after.mode & side else IMPACT
        row[E_SIDE] = 1.0 if side == RIGHT else -1.0
        row[E_U], row[E_V] = after.u, arrival
        row[E_RIGHT], row[E_LEFT] = face(plan, after, RIGHT), -face(plan, after, LEFT)
        _, fresh, u, _, right, left, z, age, clock = after
        arrived = Motion(before.mode, fresh, u, arrival, right, left, z, age, clock)
        row[E_BEFORE] = acceleration(plan, arrived)
        row[E_BEHIND] = acceleration(plan, after)
        row[E_MEMORY] = after.z
        written += 1
    return Record(samples, first, spacing, n, i, events, written, last, number)
