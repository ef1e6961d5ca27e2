"""Between which bounds a motion lies on each interval of a window, for far less than its series.

Over a step a curve with |q″| ≤ M keeps within M h²/8 of its chord, and a curve whose slope keeps
its sign, which its own chord shows, between its ends; so the values at the nodes of a window
enclose all of it. Whoever asks for extremes needs the series of those intervals only
whose bounds reach beyond what was seen.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import pull
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import band, node
from vibroimpact.engine.linear.layout import (
    FOURTH,
    FOURTH_0,
    LATE,
    NODES,
    RATE,
    REST,
    RESTING,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    THIRD_0,
    THIRD_V,
    THIRD_X,
    H,
)
from vibroimpact.engine.linear.pieces import Cursor
from vibroimpact.engine.memory import stack
from vibroimpact.engine.motion import BOTH, Motion, main_stop

_ROW = 6
"""A node's numbers: coordinate, acceleration in space and force, and their slopes, per step."""
_OFF = _ROW * (NODES + 1)
"""After them: how far each of them may be off its chord."""

chords = stack(_OFF + _ROW)
"""Room for a window's nodes."""


class Enclosed(NamedTuple):
    """Bounds between which a motion lies, in its mode's own direction.

    Its coordinate, the acceleration in space, and what the pressed stop pushes with at most, per
    unit mass.
    """

    x_least: float
    x_most: float
    a_least: float
    a_most: float
    force: float


ANYWHERE = Enclosed(-math.inf, math.inf, -math.inf, math.inf, math.inf)
NOWHERE = Enclosed(math.inf, -math.inf, math.inf, -math.inf, -math.inf)


@kernel
def bound_window(
    plan: Vector, cursor: Cursor, before: Motion, seen: Enclosed, buffer: Vector
) -> tuple[bool, Enclosed]:
    """Check the nodes of a window, at whose first piece the cursor is.

    Where a stop holds the mass, the base stands still or both stops are pressed, nothing follows.

    Parameters
    ----------
    before
        The motion at the stretch's start.
    seen
        What was seen before.
    buffer
        `chords`, written for `enclosed`.

    Returns
    -------
    within, seen
        Whether all of it lies within what was seen; if not, that is widened by the values at the
        nodes that the stretch reaches.
    """
    table, mode = cursor.table, before.mode
    if mode == BOTH or plan[table + RESTING] != 0.0 or plan[par.BASE] == 0.0:
        buffer[_OFF] = math.inf
        return False, seen
    h, unit = plan[table + H], plan[table + RATE] * plan[table + RATE]
    d, k, c = plan[table + SCALED_D], plan[table + SCALED_K], plan[table + SCALED_C]
    stiffness, damping = 0.0, 0.0
    if mode:
        stop = par.stop_at(main_stop(mode))
        stiffness = plan[stop + par.BUMPER_STIFFNESS]
        damping = plan[stop + par.BUMPER_DAMPING] * plan[table + RATE]
    x, v, _, _ = cursor.start
    second = 8.0 * band(plan, table, x, v)
    third = plan[table + THIRD_X] * abs(x - plan[table + REST])
    third += plan[table + THIRD_V] * abs(v) + plan[table + THIRD_0]
    early = plan[table + LATE] == 0.0
    fourth = plan[table + FOURTH] * second + plan[table + FOURTH_0] if early else math.inf
    off, off_a = 0.125 * second, 0.125 * (k * second + c * third) * unit
    off_f = 0.125 * (stiffness * second + damping * third)
    x_least, x_most, a_least, a_most, force = NOWHERE
    last = min(NODES, math.ceil(cursor.span))
    for i in range(last + 1):
        x, v, s, co = node(plan, table, i, cursor.start)
        v *= h
        w = d - k * x - c * v
        a, f, bent = w * unit, stiffness * x + damping * v, w - pull(plan, table, s, co)
        at = _ROW * i
        buffer[at], buffer[at + 1], buffer[at + 2] = x, a, f
        buffer[at + 3], buffer[at + 4] = v, -(k * v + c * bent) * unit
        buffer[at + 5] = stiffness * v + damping * bent
        x_least, x_most = min(x_least, x), max(x_most, x)
        a_least, a_most = min(a_least, a), max(a_most, a)
        force = max(force, f)
    within = seen.x_least <= x_least - off and x_most + off <= seen.x_most
    within &= seen.a_least <= a_least - off_a and a_most + off_a <= seen.a_most
    if within and force + off_f <= seen.force:
        return True, seen
    buffer[_OFF], buffer[_OFF + 1], buffer[_OFF + 2] = off, off_a, off_f
    buffer[_OFF + 3], buffer[_OFF + 4] = 0.125 * third, 0.125 * (k * third + c * fourth) * unit
    buffer[_OFF + 5] = 0.125 * (stiffness * third + damping * fourth)
    x_least, x_most, a_least, a_most, force = seen
    for i in range(min(NODES, int(cursor.span)) + 1):
        x, a, f = buffer[_ROW * i], buffer[_ROW * i + 1], buffer[_ROW * i + 2]
        x_least, x_most = min(x_least, x), max(x_most, x)
        a_least, a_most = min(a_least, a), max(a_most, a)
        force = max(force, f)
    return False, Enclosed(x_least, x_most, a_least, a_most, force)


@kernel
def _off(buffer: Vector, i: int, which: int) -> float:
    """How far one of the numbers may be off its chord on an interval: not where it only rises."""
    one, other = buffer[_ROW * i + which + 3], buffer[_ROW * (i + 1) + which + 3]
    if one * other > 0.0 and min(abs(one), abs(other)) > buffer[_OFF + which + 3]:
        return 0.0
    off: float = buffer[_OFF + which]
    return off


@kernel
def enclosed(plan: Vector, cursor: Cursor, buffer: Vector) -> Enclosed:
    """Bounds on the piece at which the cursor is, by what `bound_window` has noted."""
    if not buffer[_OFF] < math.inf:
        return ANYWHERE
    i, here, there = cursor.i, _ROW * cursor.i, _ROW * (cursor.i + 1)
    off, off_a, off_f = _off(buffer, i, 0), _off(buffer, i, 1), _off(buffer, i, 2)
    return Enclosed(
        min(buffer[here], buffer[there]) - off,
        max(buffer[here], buffer[there]) + off,
        min(buffer[here + 1], buffer[there + 1]) - off_a,
        max(buffer[here + 1], buffer[there + 1]) + off_a,
        max(buffer[here + 2], buffer[there + 2]) + off_f,
    )
