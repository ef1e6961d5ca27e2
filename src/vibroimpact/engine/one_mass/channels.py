"""The channels of one mass, which is mass 0 between the stops 0 and 1 (see `channels`)."""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine import parameters as par
from vibroimpact.engine.channels import (
    ABSOLUTE_ACCELERATION,
    CLEARANCE,
    DEFORMATION,
    DISPLACEMENT,
    FADING,
    FORCE,
    LENGTH,
    OWN,
    SINCE,
    VELOCITY,
)
from vibroimpact.engine.channels import RATE as FADING_RATE
from vibroimpact.engine.forcing.dispatch import pull_series
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import ORDER, RATE, H
from vibroimpact.engine.memory import beyond, workspace
from vibroimpact.engine.motion import Motion, direction, facing, main_stop, unpacked
from vibroimpact.engine.one_mass.forces import rest_level
from vibroimpact.engine.one_mass.motions import (
    accelerated,
    begin,
    displacement,
    expanded,
    expanded_force,
    has_piece,
    read_cursor,
    write_cursor,
)
from vibroimpact.engine.one_mass.motions import next_piece as following
from vibroimpact.engine.state import STEP
from vibroimpact.engine.stops.kelvin_voigt import rate_of, relaxed
from vibroimpact.engine.stops.places import gap_of, total_gap
from vibroimpact.engine.stops.rigid import rigid

# What is kept of a piece: its width in steps, the clock in its middle, the series of the mode's own
# coordinate about that, in steps, and the cursor.
WIDTH, SINE, COSINE, X = range(OWN, OWN + 4)
CURSOR = X + ORDER


@kernel
def _opened(plan: Vector, cursor: Any, piece: Vector) -> int:
    if not has_piece(plan, cursor):
        return 0
    write_cursor(plan, cursor, beyond(piece, CURSOR))
    high, piece[SINE], piece[COSINE] = expanded(plan, cursor, beyond(piece, X))
    h = plan[cursor.table + H]
    piece[WIDTH] = high + 0.5
    piece[SINCE], piece[LENGTH] = cursor.t + cursor.i * h, piece[WIDTH] * h
    return 1


@kernel
def first_piece(plan: Vector, before: Vector, ended: Vector, piece: Vector) -> int:
    """See `flow.first_piece`."""
    return _opened(plan, begin(plan, unpacked(before), ended[STEP]), piece)


@kernel
def next_piece(plan: Vector, before: Vector, piece: Vector) -> int:
    """See `flow.next_piece`."""
    return _opened(plan, following(plan, read_cursor(plan, beyond(piece, CURSOR))), piece)


@kernel
def _from_middle(plan: Vector, before: Motion, piece: Vector, channel: int, a: Vector) -> None:
    """Write the series of a channel of the mass about the piece's middle, in steps."""
    cursor, sign = read_cursor(plan, beyond(piece, CURSOR)), direction(before.mode)
    rate = plan[cursor.table + RATE]
    s, c = piece[SINE], piece[COSINE]
    for n in range(ORDER):
        a[n] = piece[X + n]
    if channel == DISPLACEMENT:
        first = displacement(plan, before.mode, a[0])
        for n in range(ORDER):
            a[n] *= sign
        a[0] = first
    elif channel == VELOCITY:
        for n in range(ORDER - 1):
            a[n] = sign * rate * ((n + 1) * a[n + 1])
        a[ORDER - 1] = 0.0
    else:
        unit = sign * accelerated(plan, cursor, s, c, a)
        for n in range(ORDER):
            a[n] *= unit
        if channel != ABSOLUTE_ACCELERATION and plan[par.BASE] != 0.0:
            base = workspace()
            pull_series(plan, cursor.table, s, c, base)
            for n in range(ORDER):
                a[n] -= sign * rate * rate * base[n]


@kernel
def _of_stop(
    plan: Vector, before: Motion, piece: Vector, channel: int, stop: int, a: Vector
) -> None:
    """Write that of a channel of a stop; what fades of it is left out."""
    touched, main = before.mode >> stop & 1 == 1, main_stop(before.mode)
    for n in range(ORDER):
        a[n] = 0.0
    if channel == CLEARANCE:
        if plan[par.stop_at(stop) + par.KIND] == par.ABSENT:
            a[0] = math.inf
        elif not touched:
            _from_middle(plan, before, piece, DISPLACEMENT, a)
            for n in range(ORDER):
                a[n] *= -facing(stop)
            a[0] += gap_of(plan, stop)
    elif not touched:
        return
    elif channel == DEFORMATION:
        if not rigid(plan, stop):
            for n in range(ORDER):
                a[n] = piece[X + n] if stop == main else -piece[X + n]
            if stop != main:
                a[0] -= total_gap(plan)
    else:
        cursor = read_cursor(plan, beyond(piece, CURSOR))
        if not rigid(plan, stop):
            expanded_force(plan, cursor, before.mode, stop, a)
            return
        way, rate = direction(before.mode) * facing(stop), plan[cursor.table + RATE]
        pull_series(plan, cursor.table, piece[SINE], piece[COSINE], a)
        for n in range(ORDER):
            a[n] *= -way * rate * rate
        a[0] += rest_level(plan, before, stop)


@kernel
def series(
    plan: Vector, before: Vector, piece: Vector, channel: int, index: int, out: Vector
) -> int:
    """See `flow.series`."""
    motion = unpacked(before)
    out[FADING], out[FADING_RATE] = 0.0, 0.0
    if channel >= CLEARANCE:
        _of_stop(plan, motion, piece, channel, index, out)
        if channel != FORCE and not motion.mode >> index & 1:
            rate = rate_of(plan, index)
            out[FADING] = relaxed(motion.faces[index], rate, piece[SINCE])
            out[FADING_RATE] = rate * piece[LENGTH] if out[FADING] > 0.0 else 0.0
    else:
        _from_middle(plan, motion, piece, channel, out)
    # About the piece's beginning, over its length.
    for i in range(ORDER - 1):
        for n in range(ORDER - 2, i - 1, -1):
            out[n] -= 0.5 * out[n + 1]
    power = 1.0
    for n in range(1, ORDER):
        power *= piece[WIDTH]
        out[n] *= power
    return ORDER - 1
