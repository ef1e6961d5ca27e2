"""Exact extremes of a motion: of each mass, of each stop's force, and of the force on the base."""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine.assembly import channels
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.channels import close_stretch, observed, piece_length, pieces
from vibroimpact.engine.assembly.events import closing
from vibroimpact.engine.assembly.series import to_bernstein
from vibroimpact.engine.assembly.tables import table_of_flight, travel_by_tables
from vibroimpact.engine.assembly.vectors import combine
from vibroimpact.engine.channels import FORCE, series_buffer
from vibroimpact.engine.event import IMPACT, begins_contact, kind_of, stop_of
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond, stack

U_LEAST, U_MOST, A_LEAST, A_MOST = range(4)
OF_MASS = 4
"""Of the notes first those of each mass: displacement (m), absolute acceleration (m/s²)."""
T_LEAST, T_MOST, ORDERED, UNDECIDED = range(4)
OF_BASE = 4
"""Then the least and the largest force on the base (N), and how many impacts were ordered by a rule
and how many searches were given up."""
HITS, PUSHED, STRUCK = range(3)
OF_STOP = 3
"""Then of each stop: contacts begun, the largest force (N; infinite of a rigid one that is hit),
and the largest impulse of an impact (N s)."""

_DEGREE = at.DEGREE
_DEEPEST = 40
"""Halvings of a piece, after which its ends are all that counts."""
_ROUNDING = 1e-15
"""Of a series: an extreme that stands out by less is rounding."""

_range_buffer = stack(2)
_bernstein_buffer = stack(_DEGREE + 1)
_parts_buffer = stack((_DEEPEST + 2) * (_DEGREE + 4))


def count(masses: int, stops: int) -> int:
    """How many notes there are."""
    return OF_MASS * masses + OF_BASE + OF_STOP * stops


@kernel
def stops_of(plan: Vector) -> int:
    """How many stops there are, curved parts of links left out."""
    return int(plan[at.STOPS]) - int(plan[at.LINKS])


@kernel
def start(plan: Vector, notes: Vector) -> None:
    """Before anything is seen."""
    base = OF_MASS * int(plan[at.MASSES])
    for i in range(0, base + 2, 2):
        notes[i], notes[i + 1] = math.inf, -math.inf
    notes[base + ORDERED], notes[base + UNDECIDED] = plan[at.ORDERED], plan[at.UNDECIDED]
    for i in range(OF_STOP * stops_of(plan)):
        notes[base + OF_BASE + i] = 0.0


@kernel
def _value(a: Vector, order: int, x: float) -> tuple[float, float, float]:
    """A power series, its slope and its curvature."""
    f, f1, f2 = 0.0, 0.0, 0.0
    for j in range(order, -1, -1):
        f2 = f2 * x + f1
        f1 = f1 * x + f
        f = f * x + a[j]
    return f, f1, 2.0 * f2


@kernel
def _turn(a: Vector, order: int, low: float, high: float) -> float:
    """The value where a series turns, which it does once in between."""
    _, begins, _ = _value(a, order, low)
    x = 0.5 * (low + high)
    value = 0.0
    for _ in range(60):
        value, slope, curve = _value(a, order, x)
        if slope == 0.0:
            break
        if (slope > 0.0) == (begins > 0.0):
            low = x
        else:
            high = x
        new = x - slope / curve if curve != 0.0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - x) < 1e-10:  # the value is then right to 1e-20
            break
        x = new
    return value


@not_inlined
def extend_range(plan: Vector, a: Vector, order: int, buffer: Vector) -> None:
    """Widen a range, the two numbers of `buffer`, by the values of a power series on [0, 1].

    A part on which the differences of the Bernstein coefficients change their sign once has one
    extreme in between; others are halved.
    """
    spread = 0.0
    for j in range(1, order + 1):
        spread += abs(a[j])
    if buffer[0] <= a[0] - spread and a[0] + spread <= buffer[1]:
        return
    for j in range(order + 1, int(plan[at.ORDER]) + 1):
        a[j] = 0.0
    parts = _parts_buffer()
    size = _DEGREE + 4
    low_at, high_at, depth_at = _DEGREE + 1, _DEGREE + 2, _DEGREE + 3
    to_bernstein(plan, a, parts)
    parts[low_at], parts[high_at], parts[depth_at] = 0.0, 1.0, 0.0
    left = 1
    while left > 0:
        left -= 1
        b = beyond(parts, left * size)
        buffer[0] = min(buffer[0], b[0], b[_DEGREE])
        buffer[1] = max(buffer[1], b[0], b[_DEGREE])
        least, most, turns, before = b[0], b[0], 0, 0.0
        for j in range(1, _DEGREE + 1):
            least, most = min(least, b[j]), max(most, b[j])
            step = b[j] - b[j - 1]
            if step * before < 0.0:
                turns += 1
            if step != 0.0:
                before = step
        slack = _ROUNDING * max(abs(least), abs(most))
        if buffer[0] - slack <= least and most <= buffer[1] + slack:
            continue
        low, high, depth = b[low_at], b[high_at], b[depth_at]
        if turns == 0 or depth >= _DEEPEST:
            continue
        if turns == 1:
            extreme = _turn(a, order, low, high)
            buffer[0], buffer[1] = min(buffer[0], extreme), max(buffer[1], extreme)
            continue
        after = beyond(parts, (left + 1) * size)
        middle = 0.5 * (low + high)
        for j in range(_DEGREE + 1):  # de Casteljau's halves: the second one, then the first
            after[j] = b[j]
        for k in range(_DEGREE + 1):
            b[_DEGREE - k], first = after[_DEGREE - k], after[0]
            for j in range(_DEGREE - k):
                after[j] = 0.5 * (after[j] + after[j + 1])
            after[_DEGREE - k] = first
        for j in range((_DEGREE + 1) // 2):
            after[j], after[_DEGREE - j] = after[_DEGREE - j], after[j]
        b[low_at], b[high_at], b[depth_at] = middle, high, depth + 1.0
        after[low_at], after[high_at], after[depth_at] = low, middle, depth + 1.0
        left += 2


@kernel
def _range_of(plan: Vector, c: int) -> int:
    """Where in the notes the range of an observed channel stands."""
    n = int(plan[at.MASSES])
    if c < n:
        return OF_MASS * c + U_LEAST
    return OF_MASS * (c - n) + A_LEAST if c < 2 * n else OF_MASS * n


def staying(range_of: Any) -> Any:
    """Make the check whether the last stretch stays within ranges, by tables alone.

    `range_of(plan, c)` is where in the notes the range of an observed channel stands. Nothing is
    touched on such a stretch; by less than rounding a channel may leave its range.
    """

    def stays(plan: Vector, count: int, notes: Vector) -> bool:
        if plan[at.STRETCH_MODE] != 0.0 or not plan[at.SLOTS] > 0.0 or not plan[at.LENGTH] > 0.0:
            return False
        size = 2 * int(plan[at.MASSES]) + int(plan[at.WAVES]) + 1
        b, x = _bernstein_buffer(), beyond(plan, int(plan[at.PIECE_Y]))
        buffer = beyond(plan, int(plan[at.SCRATCH]))
        for i in range(size):
            x[i] = plan[int(plan[at.START]) + i]
        for piece in range(pieces(plan)):
            if piece > 0:
                travel_by_tables(plan, table_of_flight(plan), piece_length(plan), x, buffer)
            for c in range(count):
                rows = int(plan[at.SEEN]) + c * 16 * size
                combine(beyond(plan, rows), x, size, b)
                combine(beyond(plan, rows + 8 * size), x, size, beyond(b, 8))
                least, most = b[0], b[0]
                for r in range(1, _DEGREE + 1):
                    least, most = min(least, b[r]), max(most, b[r])
                slack = _ROUNDING * max(abs(least), abs(most))
                known = beyond(notes, range_of(plan, c))
                if not (known[0] - slack <= least and most <= known[1] + slack):
                    return False
        return True

    return not_inlined(stays)


_stays = staying(_range_of)


def observing(channels: Any) -> Any:
    """Make the observer of extremes of a flow, with what its stretches show."""
    open_stretch, open_piece, series = channels.open_stretch, channels.open_piece, channels.series

    def extremes(plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector) -> None:
        """Widen the ranges by the last stretch. One-sided values at both its ends count."""
        n, stops, mode = int(plan[at.MASSES]), stops_of(plan), int(plan[at.STRETCH_MODE])
        a, b = series_buffer(), series_buffer()
        of_stops = beyond(notes, OF_MASS * n + OF_BASE)
        range_ = _range_buffer()
        left = 0 if _stays(plan, 2 * n + 1, notes) else pieces(plan)
        if left > 0:
            open_stretch(plan)
        for piece in range(left):
            open_piece(plan, piece)
            for c in range(2 * n + 1):
                order = observed(plan, c, a, b)
                extend_range(plan, b, order, beyond(notes, _range_of(plan, c)))
            for f in range(stops):
                if mode >> f & 1:
                    order = series(plan, FORCE, f, a)
                    range_[0], range_[1] = -math.inf, of_stops[OF_STOP * f + PUSHED]
                    extend_range(plan, a, order, range_)
                    of_stops[OF_STOP * f + PUSHED] = range_[1]
        if left > 0:
            close_stretch(plan)
        event = int(plan[at.EVENT])
        if not begins_contact(event):
            return
        f = stop_of(event)
        stop = beyond(of_stops, OF_STOP * f)
        stop[HITS] += 1.0
        if kind_of(event) == IMPACT:
            change = closing(plan, f, beyond(plan, int(plan[at.END]) + n))
            change -= closing(plan, f, beyond(plan, int(plan[at.Y]) + n))
            impulse = change / plan[int(plan[at.COUPLING]) + f * int(plan[at.STOPS]) + f]
            if impulse > 0.0:
                stop[PUSHED], stop[STRUCK] = math.inf, max(stop[STRUCK], impulse)

    return kernel(extremes)


extremes = observing(channels)


@kernel
def write(plan: Vector, notes: Vector, other: Vector, cycles: int, result: Vector) -> None:
    """Write the notes of so many cycles: the contacts of one."""
    n, stops = int(plan[at.MASSES]), stops_of(plan)
    total = OF_MASS * n + OF_BASE
    for i in range(total):
        result[i] = notes[i]
    base = OF_MASS * n
    result[base + ORDERED] = plan[at.ORDERED] - notes[base + ORDERED]
    result[base + UNDECIDED] = plan[at.UNDECIDED] - notes[base + UNDECIDED]
    for f in range(stops):
        for i in range(OF_STOP):
            result[total + OF_STOP * f + i] = notes[total + OF_STOP * f + i]
        result[total + OF_STOP * f + HITS] /= cycles
