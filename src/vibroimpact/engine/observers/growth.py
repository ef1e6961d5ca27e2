"""How disturbances of a motion grow: carried on by `flow.tangent`, and kept orthogonal.

After each stretch between two events, the rows of q are made orthonormal, each with those before it
(modified Gram–Schmidt; G. Benettin et al., Meccanica 15 (1980) 9). What is left of a row is the
factor by which it grows beside those before it.

A row that has become nearly a combination of those before it has lost its digits to them. Where a
stretch would do that, it is carried in pieces, each so short that enough is left of every row. An
event takes no time: an impact of little restitution or little speed makes all rows nearly parallel
at once. There the combinations of rows whose images are orthogonal are carried through the event
again, so that nothing cancels. A row of which that leaves nothing has vanished: its logarithm is
−∞, and a new direction takes its place, after those that are left.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import flow
from vibroimpact.engine.event import LIMIT, PASSED, kind_of
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond, stack
from vibroimpact.engine.state import (
    EVENT,
    FRESH,
    LARGEST,
    SETTLING,
    STEP,
    T,
    copy,
    parts_buffer,
    put,
    square_buffer,
    state_buffer,
    stretch_buffer,
)

work_buffer = stack(2 * LARGEST * LARGEST)
"""Room for what `rows_of` keeps besides the rows."""

LEAST = 1e-4
"""Share of a row that must be left of it: rounding enters its logarithm by 2e-12."""
NOTHING = 1e-13
"""Share of a row that is no more than rounding."""
_CLEAN, _AGAIN = 0.5, 5
"""Share that is left where rows have been carried through an event until nothing cancels; and how
often at most."""
_BEFORE_EVENT = 1.0 - 2.0**-20
"""Share of a stretch that is carried without its event."""
_INSTANT = 2.0**-60
"""Share of a stretch so short that what vanishes within it vanishes at once."""
_MANY, _ALIKE = 100, 1e-9
"""Pieces of a stretch after which, as long as they do alike, more and more are passed at once; and
by how much of the largest their logarithms may differ."""


class Disturbances(NamedTuple):
    """Disturbances and their growth."""

    q: Vector
    """A row for each part of a state; those from `n` on are 0."""
    start: Vector
    """The rows with which a stretch begins."""
    shares: Vector
    """Of what each row was made of the orthonormal rows, up to itself (`orthonormalise`)."""
    weights: Vector
    """Of the squares of the parts, in the norm."""
    logarithms: Vector
    """Of how much each row has grown beside those before it since the section."""
    n: int
    parts: int


@kernel
def rows_of(
    plan: Vector, q: Vector, work: Vector, weights: Vector, logarithms: Vector, count: int
) -> Disturbances:
    """Gather the memory of so many disturbances."""
    parts = flow.parts(plan)
    return Disturbances(q, work, beyond(work, parts * parts), weights, logarithms, count, parts)


@kernel
def weigh(plan: Vector, weights: Vector) -> None:
    """Write the weights of the squares of the parts in the norm."""
    flow.units(plan, weights)
    for i in range(flow.parts(plan)):
        weights[i] *= weights[i]


@not_inlined
def weigh_section(plan: Vector, state: Vector, weights: Vector) -> None:
    """The same of a section: what only follows others, as a pressed bumper does, counts nothing."""
    parts = flow.parts(plan)
    units = square_buffer()
    weigh(plan, weights)
    flow.unit_disturbances(plan, state, units)
    for i in range(parts):
        if units[i * parts + i] == 0.0:
            weights[i] = 0.0


@kernel
def _product(rows: Disturbances, i: int, j: int) -> float:
    total = 0.0
    for k in range(rows.parts):
        total += rows.weights[k] * rows.q[i * rows.parts + k] * rows.q[j * rows.parts + k]
    return total


@kernel
def _add(q: Vector, i: int, share: float, j: int, parts: int) -> None:
    for k in range(parts):
        q[i * parts + k] += share * q[j * parts + k]


@kernel
def _scale(q: Vector, i: int, factor: float, parts: int) -> None:
    for k in range(parts):
        q[i * parts + k] *= factor


@kernel
def _clear(q: Vector, i: int, parts: int) -> None:
    for k in range(parts):
        q[i * parts + k] = 0.0


@kernel
def orthonormalise(rows: Disturbances, least: float, nothing: float) -> int:
    """Make rows orthonormal, each with those before it, and write their `shares`.

    The last share of a row is what is left of it, with a minus sign if that is less than the share
    `least` of the row. A row of which no more than the share `nothing` is left becomes 0, with a
    last share of −∞; so does one that is not finite, with +∞.

    Returns
    -------
    unsure
        The number of rows of which too little is left.
    """
    q, parts, unsure = rows.q, rows.parts, 0
    for i in range(rows.n):
        whole = _product(rows, i, i)
        for j in range(i):
            share = _product(rows, i, j)
            _add(q, i, -share, j, parts)
            rows.shares[i * parts + j] = share
        left = _product(rows, i, i)
        size = math.sqrt(left)
        if nothing * nothing * whole < left < math.inf:
            _scale(q, i, 1.0 / size, parts)
            if not left > least * least * whole:
                size = -size
        else:
            _clear(q, i, parts)
            size = -math.inf if left < math.inf else math.inf
        if not 0.0 < size < math.inf:
            unsure += 1
        rows.shares[i * parts + i] = size
    return unsure


@not_inlined
def begin_rows(plan: Vector, state: Vector, rows: Disturbances, first: int, last: int) -> None:
    """Let rows begin, from `first` to before `last`: each in a direction that the others leave."""
    q, parts = rows.q, rows.parts
    units = square_buffer()
    flow.unit_disturbances(plan, state, units)
    for i in range(first, last):
        size = 0.0
        part = 0
        while part < parts and not size > 0.0:
            copy(beyond(units, (i + part) % parts * parts), beyond(q, i * parts), parts)
            whole = math.sqrt(_product(rows, i, i))
            size = _join(rows, i)
            if not size > 0.1 * whole:
                size = 0.0
            part += 1
        if not size > 0.0:
            _clear(q, i, parts)


@kernel
def _join(rows: Disturbances, i: int) -> float:
    """Make a new row orthonormal with those before it; return what is left of it."""
    for _ in range(2):  # the second time removes what rounding leaves
        for j in range(i):
            _add(rows.q, i, -_product(rows, i, j), j, rows.parts)
    size = math.sqrt(_product(rows, i, i))
    if size > 0.0:
        _scale(rows.q, i, 1.0 / size, rows.parts)
    return size


@kernel
def grow(
    plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector, rows: Disturbances
) -> None:
    """Carry disturbances through a stretch: an observer (see `event_loop.observed`).

    The notes are those of `flow.tangent`. Rows that are orthonormal stay so. Where a
    stretch ends otherwise when it is carried in pieces, as rounding may decide at a grazing, a row
    that has lost its digits to others has an unknown growth: its logarithm becomes NaN.
    """
    copy(rows.q, rows.start, rows.n * rows.parts)
    flow.tangent(plan, before, ended, after, notes, rows.q)
    if orthonormalise(rows, LEAST, NOTHING) <= _vanished(rows):
        add_up(plan, after, rows)
    elif int(before[FRESH]) & SETTLING:  # a chatter is completed at once
        _pass_event(plan, before, ended, after, rows)
    else:
        _grow_finely(plan, before, ended, after, rows)


@not_inlined
def _grow_finely(
    plan: Vector, before: Vector, ended: Vector, after: Vector, rows: Disturbances
) -> None:
    """As `grow`; the rows and their shares are what the whole stretch leaves."""
    size, n = rows.n * rows.parts, rows.n
    q, shares, logarithms = square_buffer(), square_buffer(), parts_buffer()
    copy(rows.q, q, size)
    copy(rows.shares, shares, size)
    copy(rows.logarithms, logarithms, n)
    if _grow_in_pieces(plan, before, ended, rows):
        return
    copy(q, rows.q, size)
    copy(shares, rows.shares, size)
    copy(logarithms, rows.logarithms, n)
    for i in range(n):
        if -math.inf < shares[i * rows.parts + i] < 0.0:
            rows.logarithms[i] = math.nan
    add_up(plan, after, rows)


@kernel
def _vanished(rows: Disturbances) -> int:
    """How many rows have vanished since the section; as many others are taken as vanished, too."""
    gone = 0
    for i in range(rows.n):
        if rows.logarithms[i] == -math.inf:
            gone += 1
    return gone


@kernel
def add_up(plan: Vector, after: Vector, rows: Disturbances) -> None:
    """Add the logarithms of what is left; what has vanished begins anew after the other rows."""
    q, parts, at = rows.q, rows.parts, 0
    for i in range(rows.n):
        size = rows.shares[i * parts + i]
        if size > -math.inf:
            rows.logarithms[at] += math.log(abs(size))
            if size == math.inf:  # a rigid stop is met without speed
                begin_rows(plan, after, rows, at, at + 1)
            elif at < i:
                copy(beyond(q, i * parts), beyond(q, at * parts), parts)
            at += 1
    if at < rows.n:
        for i in range(at, rows.n):
            rows.logarithms[i] = -math.inf
        begin_rows(plan, after, rows, at, rows.n)


@not_inlined
def _grow_in_pieces(plan: Vector, before: Vector, ended: Vector, rows: Disturbances) -> bool:
    """As `grow`, from the `start` of the rows on; return whether the pieces end as the stretch."""
    q, start, shares, _, logarithms, count, parts = rows
    here, there, part = state_buffer(), state_buffer(), stretch_buffer()
    notes, last = parts_buffer(), parts_buffer()
    put(plan, before, here)
    for i in range(count):
        last[i] = math.nan
    timed = kind_of(int(ended[EVENT])) in (LIMIT, PASSED)
    span = ended[STEP] if timed else _BEFORE_EVENT * ended[STEP]
    done, pieces, number, alike = 0.0, 0, 1.0, 1.0
    piece = _INSTANT * span
    while done < span:
        length = min(number * piece, span - done)
        event = flow.advance(plan, here, length, part, there)
        kind = kind_of(event)
        if kind == PASSED:
            length, number = part[STEP], 1.0
        elif kind != LIMIT:
            return False
        part[EVENT], part[T] = LIMIT, 0.0
        copy(start, q, count * parts)
        flow.tangent(plan, here, part, there, notes, q)
        unsure = orthonormalise(rows, LEAST, NOTHING) > _vanished(rows)
        if number > 1.0:
            # Of many pieces that do alike, what too little is left of does as in the last one.
            for i in range(count):
                if 0.0 < shares[i * parts + i] < math.inf:
                    logarithms[i] += math.log(shares[i * parts + i])
                else:
                    logarithms[i] += number * last[i]
                    copy(beyond(start, i * parts), beyond(q, i * parts), parts)
                    _join(rows, i)
            number = 1.0
        elif unsure and pieces > 0 and done + 0.5 * length > done:
            piece = 0.5 * length
            continue
        else:
            alike = 2.0 * alike if _is_alike(rows, last) else 1.0
            add_up(plan, there, rows)
            if pieces > _MANY:
                number = max(min(alike, math.floor((span - done - length) / piece)), 1.0)
        copy(q, start, count * parts)
        put(plan, there, here)
        done += length
        pieces += 1
        if pieces == 1:
            piece = span
    if timed:
        return True
    event = flow.advance(plan, here, 2.0 * (ended[STEP] - span), part, there)
    part[EVENT], part[T] = event, 0.0
    _pass_event(plan, here, part, there, rows)
    return event == int(ended[EVENT])


@kernel
def _is_alike(rows: Disturbances, last: Vector) -> bool:
    """Whether a piece does what the last one did; it becomes the last one."""
    most, alike = 0.0, True
    for i in range(rows.n):
        most = max(most, abs(math.log(abs(rows.shares[i * rows.parts + i]))))
    for i in range(rows.n):
        here = math.log(abs(rows.shares[i * rows.parts + i]))
        alike = alike and abs(here - last[i]) <= _ALIKE * most < math.inf  # and no NaN
        last[i] = here
    return alike


@not_inlined
def _pass_event(
    plan: Vector, here: Vector, ended: Vector, there: Vector, rows: Disturbances
) -> None:
    """Carry rows through an event that comes at once."""
    q, start, shares, _, logarithms, count, parts = rows
    notes = parts_buffer()
    for again in range(_AGAIN):
        copy(start, q, count * parts)
        flow.tangent(plan, here, ended, there, notes, q)
        if orthonormalise(rows, _CLEAN, 0.0) == 0 or again == _AGAIN - 1:
            break
        for i in range(count):
            size = abs(shares[i * parts + i])
            if size < math.inf:
                logarithms[i] += math.log(size)
                for j in range(i):
                    _add(start, i, -shares[i * parts + j], j, parts)
                _scale(start, i, 1.0 / size, parts)
    for i in range(count):
        whole = 0.0
        for j in range(i + 1):
            whole += shares[i * parts + j] ** 2
        if whole < math.inf and shares[i * parts + i] ** 2 <= LEAST * LEAST * whole:
            shares[i * parts + i] = -math.inf
    add_up(plan, there, rows)
