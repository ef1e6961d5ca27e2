"""A motion written down: samples at equal times, and every contact and detachment."""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.evaluate import absolute_acceleration, horner, relaxed
from vibroimpact.engine.linear.pieces import (
    acceleration,
    acceleration_in,
    begin,
    displacement,
    expanded_at_node,
    following_window,
)
from vibroimpact.engine.linear.tables import AMPLITUDE, NODES, OMEGA, RATE, resting
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import BOTH, DETACHED, LEFT, LIMIT, RIGHT, Motion, Stretch
from vibroimpact.engine.observe import observer

# Columns of a sample.
DISPLACEMENT, VELOCITY, ACCELERATION, RIGHT_FACE, LEFT_FACE, CONTACT = range(6)
SAMPLE = 6

TOUCHING = (0.0, 1.0, -1.0, 2.0)
"""The column CONTACT by mode: none, right, left, both."""

DETACHMENT, CONTACT_BEGINS, IMPACT = 0.0, 1.0, 2.0
"""The column E_KIND."""

# Columns of an event: the state there, and the absolute acceleration just before and behind.
E_CYCLE, E_TIME, E_KIND, E_SIDE, E_U, E_V, E_RIGHT, E_LEFT, E_BEFORE, E_BEHIND = range(10)
EVENT = 10


class Record(NamedTuple):
    """Where to write.

    Row i of `samples` is the next, of n in this cycle, `step` seconds apart; row `written` of
    `events` is the next, in cycle `number`, and `last` the first that must not be written.
    """

    samples: Vector
    step: float
    n: int
    i: int
    events: Vector
    written: int
    last: int
    number: int


@inlined
def write_sample(plan: Vector, motion: Motion, x: float, v: float, t: float, out: Vector) -> None:
    """Write the sample t seconds behind the start of a stretch, x and v as its pieces give them."""
    mode = motion.mode
    sign = -1.0 if mode == LEFT else 1.0
    out[DISPLACEMENT] = displacement(plan, mode, x)
    out[VELOCITY] = sign * v
    if resting(plan, mode):
        turned = plan[OMEGA] * t
        s, c = motion.clock
        out[ACCELERATION] = plan[AMPLITUDE] * (s * math.cos(turned) + c * math.sin(turned))
    else:
        out[ACCELERATION] = sign * absolute_acceleration(plan, mode, x, v, 0.0)
    rate_r = plan[par.BUMPER + par.RATE]
    rate_l = plan[par.BUMPER + par.WIDTH + par.RATE]
    out[CONTACT] = TOUCHING[mode]
    if mode == BOTH:
        gaps = plan[par.BUMPER + par.GAP] + plan[par.BUMPER + par.WIDTH + par.GAP]
        out[RIGHT_FACE], out[LEFT_FACE] = x, x + gaps
        return
    out[RIGHT_FACE] = x if mode == RIGHT else relaxed(motion.right, rate_r, t)
    out[LEFT_FACE] = -x if mode == LEFT else -relaxed(motion.left, rate_l, t)


@kernel
def sample(plan: Vector, notes: Record, before: Motion, t: float, reach: float) -> int:
    """Fill the samples that fall within one stretch; return the next one.

    The motion itself is not interrupted: what is sampled has no influence.
    """
    i, n, step = notes.i, notes.n, notes.step
    if not (i < n and i * step < t + reach):
        return i
    series = workspace()
    cursor = begin(plan, before, reach)
    about = -1  # the node that the series is about
    while i < n and i * step < t + reach:
        tau = max(i * step - t, 0.0)
        y = (tau - cursor.t) * plan[cursor.table + RATE]
        if y >= NODES:
            cursor = following_window(plan, cursor)
            about = -1
            continue
        j = int(y + 0.5)
        if j != about:
            expanded_at_node(plan, cursor, j, series)
            about = j
        x, v = horner(series, y - j)
        write_sample(plan, before, x, v * plan[cursor.table + RATE], tau, notes.samples[i])
        i += 1
    return i


@observer(Record)
def record(plan: Vector, notes: Record, stretch: Stretch) -> Record:
    """Write down one stretch and the event that ends it."""
    before, t, event, step, arrival, after = stretch
    samples, spacing, n, i, events, written, last, number = notes
    if n:
        i = sample(plan, notes, before, t, math.inf if event == LIMIT else step)
    if event != LIMIT and written < last:
        row = events[written]
        row[E_CYCLE], row[E_TIME] = number, t + step
        side = after.fresh & BOTH
        row[E_KIND] = DETACHMENT
        if event != DETACHED:
            row[E_KIND] = CONTACT_BEGINS if after.mode & side else IMPACT
        row[E_SIDE] = 1.0 if side == RIGHT else -1.0
        row[E_U], row[E_V] = after.u, arrival
        row[E_RIGHT], row[E_LEFT] = after.right, -after.left
        row[E_BEFORE] = acceleration_in(plan, before.mode, after, arrival)
        row[E_BEHIND] = acceleration(plan, after)
        written += 1
    return Record(samples, spacing, n, i, events, written, last, number)
