"""A stretch of motion as a sequence of polynomials.

What a motion does between two events — extremes, integrals, samples, turning points — is
computed from these: on each interval of a table the displacement is a series of TERMS coefficients
about the interval's middle, in y = (t − t_middle) / step, right to rounding.

    cursor = begin(plan, motion, length)
    while has_piece(plan, cursor):
        high, s, c = expanded(plan, cursor, series)     # the piece covers −1/2 ≤ y ≤ high
        ...
        cursor = next_piece(plan, cursor)
"""

from __future__ import annotations

from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import expand, pull_series, turned, value
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import absolute_acceleration, horner, moved, node
from vibroimpact.engine.linear.layout import (
    LATE_TABLES,
    MIDDLE,
    NODE,
    NODES,
    ORDER,
    RATE,
    RESTING,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SIZE,
    TABLES,
    TAYLOR,
    TAYLOR_F,
    VALID_FROM,
    WIDTH,
    H,
    Row,
)
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import BOTH, Motion, changed, coordinates, direction, main_stop
from vibroimpact.engine.one_mass.record_layout import ACCELERATION, BLOCK, VELOCITY
from vibroimpact.engine.stops.places import place_at, total_gap
from vibroimpact.engine.stops.rigid import rigid


class Cursor(NamedTuple):
    """Where on a stretch a piece lies.

    A window of NODES intervals of `table` begins `t` seconds behind the stretch's start, with
    the state `start` in the mode's own coordinates; the piece is its interval `i`; `span` is
    how many intervals are left from the window's start.
    """

    early: int
    table: int
    i: int
    length: float
    age: float
    t: float
    span: float
    start: Row


@kernel
def window(plan: Vector, early: int, length: float, age: float, t: float, start: Row) -> Cursor:
    """The first piece of a window that begins t seconds behind the stretch's start."""
    late = early + LATE_TABLES
    table = late if age + t >= plan[late + VALID_FROM] else early
    span = (length - t) * plan[table + RATE]
    return Cursor(early, table, 0, length, age, t, span, start)


@kernel
def begin(plan: Vector, motion: Motion, length: float) -> Cursor:
    """The first piece of the stretch of so many seconds that starts with this motion."""
    _, row = coordinates(motion)
    return window(plan, TABLES + SIZE * motion.mode, length, motion.age, 0.0, row)


@kernel
def has_piece(plan: Vector, cursor: Cursor) -> bool:
    """Whether there is a piece here."""
    return cursor.i < cursor.span


@kernel
def following_window(plan: Vector, cursor: Cursor) -> Cursor:
    """The first piece of the next window."""
    early, table, _, length, age, t, _, start = cursor
    start = moved(plan, table + NODE + (NODES - 1) * WIDTH, start)
    return window(plan, early, length, age, t + NODES * plan[table + H], start)


@kernel
def next_piece(plan: Vector, cursor: Cursor) -> Cursor:
    """The next piece."""
    early, table, i, length, age, t, span, start = cursor
    if i + 1 < NODES:
        return Cursor(early, table, i + 1, length, age, t, span, start)
    return following_window(plan, cursor)


@kernel
def write_cursor(plan: Vector, cursor: Cursor, buffer: Vector) -> None:
    """Write a cursor into memory, of at most `channels.CURSOR_SIZE` numbers."""
    early, table, i, length, age, t, span, start = cursor
    buffer[0], buffer[1], buffer[2], buffer[3] = early, table, i, length
    buffer[4], buffer[5], buffer[6] = age, t, span
    buffer[7], buffer[8], buffer[9], buffer[10] = start


@kernel
def read_cursor(plan: Vector, buffer: Vector) -> Cursor:
    """The cursor that was written."""
    start = Row(buffer[7], buffer[8], buffer[9], buffer[10])
    early, table, i = int(buffer[0]), int(buffer[1]), int(buffer[2])
    return Cursor(early, table, i, buffer[3], buffer[4], buffer[5], buffer[6], start)


@kernel
def middle(plan: Vector, cursor: Cursor) -> Row:
    """The state in the middle of a piece, in the mode's own coordinates."""
    here = node(plan, cursor.table, cursor.i, cursor.start)
    return moved(plan, cursor.table + MIDDLE, here)


@kernel
def expanded(plan: Vector, cursor: Cursor, series: Vector) -> tuple[float, float, float]:
    """Write the series of x; return how far the piece reaches, and the phasor in its middle."""
    row = middle(plan, cursor)
    expand(plan, cursor.table + TAYLOR, row, series)
    return min(0.5, cursor.span - cursor.i - 0.5), row.s, row.c


@kernel
def expanded_at_node(plan: Vector, cursor: Cursor, j: int, series: Vector) -> None:
    """Write the series of x about node j of the window, good for |y| ≤ 1/2.

    Samples need it: just behind an event the coordinate is tiny, and from there it has no noise.
    """
    expand(plan, cursor.table + TAYLOR, node(plan, cursor.table, j, cursor.start), series)


@kernel
def expanded_force(plan: Vector, cursor: Cursor, mode: int, stop: int, series: Vector) -> None:
    """Write the series of what the pressed stop on a side pushes with, per unit mass."""
    at = par.stop_at(stop)
    row = middle(plan, cursor)
    if plan[cursor.table + RESTING] == 0.0 and stop == main_stop(mode):
        expand(plan, cursor.table + TAYLOR_F, row, series)
        return
    # Seen from the right, or held where it is.
    sign = 1.0 if stop == main_stop(mode) else -1.0
    expand(plan, cursor.table + TAYLOR, row, series)
    k, c = plan[at + par.BUMPER_STIFFNESS], plan[at + par.BUMPER_DAMPING]
    c *= plan[cursor.table + RATE]
    for n in range(ORDER):
        behind = series[n + 1] * (n + 1) if n + 1 < ORDER else 0.0
        series[n] = sign * (k * series[n] + c * behind)
    if sign < 0.0:
        series[0] -= k * total_gap(plan)


@kernel
def moment(plan: Vector, cursor: Cursor, before: Motion, x: float, v: float, y: float) -> Motion:
    """The motion at y of a piece, whose coordinate is x and whose velocity is v; not its clock."""
    mode = before.mode
    u = displacement(plan, mode, x)
    faces = before.faces
    if mode:
        faces = changed(faces, main_stop(mode), x)
    if mode == BOTH:
        faces = (x, -x - total_gap(plan))
    return Motion(mode, 0, u, v, faces, before.z, before.age, before.clock)


@kernel
def accelerated(plan: Vector, cursor: Cursor, s: float, c: float, series: Vector) -> float:
    """Turn the series of x into that of the absolute acceleration; return its unit, 1/step².

    ü + A_t = d − k x − c x′ on a base that moves, ü on one that stands still; at rest it is that
    of the base. The clock s, c is that in the piece's middle.
    """
    table = cursor.table
    base: float = plan[par.BASE]
    if plan[table + RESTING] != 0.0:
        pull_series(plan, table, s, c, series)
        for n in range(ORDER):
            series[n] *= base
    else:
        for n in range(ORDER):
            behind = series[n + 1] * (n + 1) if n + 1 < ORDER else 0.0
            series[n] = -plan[table + SCALED_K] * series[n] - plan[table + SCALED_C] * behind
        series[0] += plan[table + SCALED_D]
        if base == 0.0:
            shaking = workspace()
            pull_series(plan, table, s, c, shaking)
            for n in range(ORDER):
                series[n] -= shaking[n]
    rate: float = plan[table + RATE]
    return rate * rate


@kernel
def coordinate(plan: Vector, motion: Motion) -> float:
    """The mode's own coordinate."""
    _, row = coordinates(motion)
    return row.x


@kernel
def displacement(plan: Vector, mode: int, x: float) -> float:
    """The displacement of the mass from the mode's own coordinate."""
    if mode == BOTH and rigid(plan, 1):
        # At rest on the left, exactly there, whatever the right one's face rounds to.
        return place_at(plan, 1, 0.0)
    return place_at(plan, main_stop(mode), x) if mode else x


@kernel
def acceleration(plan: Vector, motion: Motion) -> float:
    """Absolute acceleration of the mass, in the direction of u."""
    sign, row = coordinates(motion)
    return sign * absolute_acceleration(plan, motion.mode, row)


@kernel
def sample_stretch(
    plan: Vector,
    cursor: Cursor,
    before: Motion,
    t: float,
    step: float,
    i: int,
    n: int,
    series: Vector,
    buffer: Vector,
) -> Cursor:
    """See `motions.sample_stretch`."""
    speeds, accelerations = VELOCITY * BLOCK, ACCELERATION * BLOCK
    rate = plan[cursor.table + RATE]
    about = -1  # the node that the series is about
    for j in range(n):
        y = (max((i + j) * step - t, 0.0) - cursor.t) * rate
        while y >= NODES:
            cursor = following_window(plan, cursor)
            about = -1
            rate = plan[cursor.table + RATE]
            y = (max((i + j) * step - t, 0.0) - cursor.t) * rate
        here = int(y + 0.5)
        if here != about:
            expanded_at_node(plan, cursor, here, series)
            about = here
        x, v = horner(series, y - here)
        buffer[j], buffer[speeds + j] = x, v * rate
    sign = direction(before.mode)
    table, base = TABLES + SIZE * before.mode, plan[par.BASE]
    held = plan[cursor.table + RESTING] != 0.0
    if held or base == 0.0:
        for j in range(n):
            tau = max((i + j) * step - t, 0.0)
            s, c = turned(plan, before.clock[0], before.clock[1], tau)
            if held:
                buffer[accelerations + j] = sign * (base * value(plan, s, c))
            else:
                row = Row(buffer[j], buffer[speeds + j], sign * s, sign * c)
                buffer[accelerations + j] = absolute_acceleration(plan, before.mode, row)
        return cursor
    h, unit = plan[table + H], plan[table + RATE] * plan[table + RATE]
    d, k, c = plan[table + SCALED_D], plan[table + SCALED_K], plan[table + SCALED_C]
    for j in range(n):
        buffer[accelerations + j] = ((d - k * buffer[j]) - c * (buffer[speeds + j] * h)) * unit
    return cursor
