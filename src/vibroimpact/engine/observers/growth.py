"""How disturbances of a motion grow: carried on by `flow.tangent`, and kept orthogonal.

The rows of q are carried through a cycle and then made orthonormal, each with those before it
(modified Gram–Schmidt; G. Benettin et al., Meccanica 15 (1980) 9). What is left of a row is the
factor by which it grows beside those before it.

A row that has become nearly a combination of those before it has lost its digits to them. Where a
stretch between two events would do that, the rows are made orthonormal before it and after it. If
that is not enough, it is carried in pieces, each so short that enough is left of every row. An
event takes no time: an impact of little restitution or little speed makes all rows nearly parallel
at once. There the combinations of rows whose images are orthogonal are carried through the event
again, so that nothing cancels. A row of which that leaves nothing has vanished: its logarithm is
−∞, and a new direction takes its place, after those that are left.
"""

from __future__ import annotations

import math

from vibroimpact.engine import flow
from vibroimpact.engine.jit import Vector, apart, kernel
from vibroimpact.engine.memory import beyond, stack
from vibroimpact.engine.motion import LIMIT, PASSED
from vibroimpact.engine.state import EVENT, LARGEST, STEP, T, copy, parts_room, put, room
from vibroimpact.engine.state import stretch_room as ended_room

_rows_room = stack(LARGEST * LARGEST)
work_room = stack(4 * LARGEST * LARGEST)
"""Room for `grow`: for the rows that a stretch begins with, for what is left of them, and for both
of a piece of it. It is filled with zeros wherever a function asks for it, and so is made once."""

LEAST = 1e-4
"""Share of a row that must be left of it: rounding enters its logarithm by 2e-12."""
_APART, _TINY = 1.0 - LEAST**2, 1e-200
"""Square of the cosine between two rows of which as much is left; and of numbers near underflow."""
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


@kernel
def weigh(plan: Vector, weights: Vector) -> None:
    """Write the weights of the squares of the parts in the norm."""
    flow.units(plan, weights)
    for i in range(flow.parts(plan)):
        weights[i] *= weights[i]


@apart
def weigh_section(plan: Vector, state: Vector, weights: Vector) -> None:
    """The same of a section: what only follows others, as a pressed bumper does, counts nothing."""
    parts = flow.parts(plan)
    units = _rows_room()
    weigh(plan, weights)
    flow.unit_disturbances(plan, state, units)
    for i in range(parts):
        if units[i * parts + i] == 0.0:
            weights[i] = 0.0


@kernel
def _product(q: Vector, i: int, j: int, weights: Vector, parts: int) -> float:
    total = 0.0
    for k in range(parts):
        total += weights[k] * q[i * parts + k] * q[j * parts + k]
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
def orthonormalise(
    q: Vector,
    count: int,
    weights: Vector,
    parts: int,
    shares: Vector,
    least: float,
    nothing: float,
) -> int:
    """Make rows orthonormal, each with those before it.

    Parameters
    ----------
    weights
        Of the squares of the parts, in the norm.
    shares
        Written, a row of `parts` for each of q: of what it was made of the new rows, up to itself.
        The last of these is what is left of it: negative if that is less than the share `least`.
        It is −inf if that is at most the share `nothing`, and inf if it is no number; then the row
        becomes 0.

    Returns
    -------
    unsure
        The number of rows of which too little is left.
    """
    unsure = 0
    for i in range(count):
        whole = _product(q, i, i, weights, parts)
        for j in range(i):
            share = _product(q, i, j, weights, parts)
            _add(q, i, -share, j, parts)
            shares[i * parts + j] = share
        left = _product(q, i, i, weights, parts)
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
        shares[i * parts + i] = size
    return unsure


@apart
def begin_rows(
    plan: Vector, state: Vector, q: Vector, first: int, count: int, weights: Vector
) -> None:
    """Let rows begin, from number `first` on: each in a direction that those before it leave."""
    parts = flow.parts(plan)
    units = _rows_room()
    flow.unit_disturbances(plan, state, units)
    for i in range(first, count):
        size = 0.0
        part = 0
        while part < parts and not size > 0.0:
            copy(beyond(units, (i + part) % parts * parts), beyond(q, i * parts), parts)
            whole = math.sqrt(_product(q, i, i, weights, parts))
            size = _placed(q, i, weights, parts)
            if not size > 0.1 * whole:
                size = 0.0
            part += 1
        if not size > 0.0:
            _clear(q, i, parts)


@kernel
def _placed(q: Vector, i: int, weights: Vector, parts: int) -> float:
    """Make a new row orthonormal with those before it; return what is left of it."""
    for _ in range(2):  # the second time removes what rounding leaves
        for j in range(i):
            _add(q, i, -_product(q, i, j, weights, parts), j, parts)
    size = math.sqrt(_product(q, i, i, weights, parts))
    if size > 0.0:
        _scale(q, i, 1.0 / size, parts)
    return size


@kernel
def grow(
    plan: Vector,
    before: Vector,
    ended: Vector,
    after: Vector,
    notes: Vector,
    q: Vector,
    work: Vector,
    count: int,
    weights: Vector,
    logarithms: Vector,
) -> None:
    """Carry disturbances through a stretch: an observer (see `event_loop.observed`).

    Parameters
    ----------
    notes
        Those of `observers.tangent`.
    q
        Rows, one for each part; those from `count` on are 0. They are orthonormal at the section,
        and left as they are carried for as long as they do not lose digits.
    work
        See `work_room`.
    weights
        Of the squares of the parts, in the norm.
    logarithms
        Of how much each row has grown beside those before it since the section, where rows have
        been made orthonormal: added to.
    """
    parts = flow.parts(plan)
    copy(q, work, count * parts)
    flow.tangent(plan, before, ended, after, notes, q)
    if not _are_apart(q, count, weights, parts) and _vanished(count, logarithms) < count:
        _grow_apart(plan, before, ended, after, q, work, count, weights, logarithms)


@kernel
def _are_apart(q: Vector, count: int, weights: Vector, parts: int) -> bool:
    """Whether more than the share `LEAST` is left of each of one or two rows, seen at a glance."""
    one, other, common = 0.0, 0.0, 0.0
    for k in range(parts):
        one += weights[k] * q[k] * q[k]
        if count > 1:
            other += weights[k] * q[parts + k] * q[parts + k]
            common += weights[k] * q[k] * q[parts + k]
    if count == 1:
        return _TINY < one < 1.0 / _TINY
    return count == 2 and one * other > _TINY and common * common < _APART * one * other < math.inf


@apart
def _grow_apart(
    plan: Vector,
    before: Vector,
    ended: Vector,
    after: Vector,
    q: Vector,
    work: Vector,
    count: int,
    weights: Vector,
    logarithms: Vector,
) -> None:
    """As `grow`, with rows that are made orthonormal before the stretch and after it."""
    parts = flow.parts(plan)
    start, shares, notes = work, beyond(work, parts * parts), parts_room()
    for i in range(count, parts):
        _clear(start, i, parts)
    orthonormalise(start, count, weights, parts, shares, 0.0, 0.0)
    add_up(plan, before, start, count, weights, shares, logarithms)
    copy(start, q, parts * parts)
    flow.tangent(plan, before, ended, after, notes, q)
    unsure = orthonormalise(q, count, weights, parts, shares, LEAST, NOTHING)
    if unsure > _vanished(count, logarithms):
        _grow_in_pieces(plan, before, ended, after, q, work, count, weights, logarithms)
    else:
        add_up(plan, after, q, count, weights, shares, logarithms)


@kernel
def _vanished(count: int, logarithms: Vector) -> int:
    """How many rows have vanished since the section; as many others are taken as vanished, too."""
    gone = 0
    for i in range(count):
        if logarithms[i] == -math.inf:
            gone += 1
    return gone


@kernel
def add_up(
    plan: Vector,
    after: Vector,
    q: Vector,
    count: int,
    weights: Vector,
    shares: Vector,
    logarithms: Vector,
) -> None:
    """Add the logarithms of what is left; what has vanished begins anew after the other rows."""
    parts = flow.parts(plan)
    at = 0
    for i in range(count):
        size = shares[i * parts + i]
        if size > -math.inf:
            logarithms[at] += math.log(abs(size))
            if size == math.inf:  # a rigid stop is met without speed
                begin_rows(plan, after, q, at, at + 1, weights)
            elif at < i:
                copy(beyond(q, i * parts), beyond(q, at * parts), parts)
            at += 1
    if at < count:
        for i in range(at, count):
            logarithms[i] = -math.inf
        begin_rows(plan, after, q, at, count, weights)


@apart
def _grow_in_pieces(
    plan: Vector,
    before: Vector,
    ended: Vector,
    after: Vector,
    q: Vector,
    work: Vector,
    count: int,
    weights: Vector,
    logarithms: Vector,
) -> None:
    """As `grow`; q and what `work` has of it are what the whole stretch leaves."""
    parts = flow.parts(plan)
    start, shares, rest = work, beyond(work, parts * parts), beyond(work, 2 * parts * parts)
    here, sums = room(), parts_room()
    put(plan, before, here)
    copy(logarithms, sums, count)
    event, length = int(ended[EVENT]), ended[STEP]
    if event == PASSED:
        event = LIMIT
    span = length if event == LIMIT else _BEFORE_EVENT * length
    done = _pass_time(plan, here, span, start, rest, count, weights, sums)
    if done and event != LIMIT:
        limit = 2.0 * (length - span)
        done = _pass_event(plan, here, event, limit, start, rest, count, weights, sums)
    if done:
        copy(start, q, count * parts)
        copy(sums, logarithms, count)
    else:  # in pieces, rounding makes it another stretch
        add_up(plan, after, q, count, weights, shares, logarithms)


@kernel
def _pass_time(
    plan: Vector,
    here: Vector,
    span: float,
    rows: Vector,
    work: Vector,
    count: int,
    weights: Vector,
    logarithms: Vector,
) -> bool:
    """Carry a state and rows over a time without events; return whether there was none."""
    parts = flow.parts(plan)
    there, ended, notes, last = room(), ended_room(), parts_room(), parts_room()
    q, shares = work, beyond(work, parts * parts)
    for i in range(count):
        last[i] = math.nan
    done, pieces = 0.0, 0
    piece, alike = _INSTANT * span, 1.0
    number = 1.0
    while done < span:
        length = min(number * piece, span - done)
        event = flow.advance(plan, here, length, ended, there)
        if event == PASSED:
            length, number = ended[STEP], 1.0
        elif event != LIMIT:
            return False
        ended[EVENT], ended[T] = LIMIT, 0.0
        copy(rows, q, parts * parts)
        flow.tangent(plan, here, ended, there, notes, q)
        unsure = orthonormalise(q, count, weights, parts, shares, LEAST, NOTHING)
        if number == 1.0 and pieces > 0 and unsure > _vanished(count, logarithms):
            piece = 0.5 * length
            if not done + piece > done:
                return False
            continue
        if number > 1.0:
            _extrapolate(q, rows, number, count, weights, parts, shares, last, logarithms)
            number = 1.0
        else:
            alike = 2.0 * alike if _is_alike(count, parts, shares, last) else 1.0
            add_up(plan, there, q, count, weights, shares, logarithms)
            if pieces > _MANY:
                number = max(min(alike, math.floor((span - done - length) / piece)), 1.0)
        copy(q, rows, count * parts)
        put(plan, there, here)
        done += length
        pieces += 1
        if pieces == 1:
            piece = span
    return True


@kernel
def _is_alike(count: int, parts: int, shares: Vector, last: Vector) -> bool:
    """Whether a piece does what the last one did; it becomes the last one."""
    most = 0.0
    for i in range(count):
        most = max(most, abs(math.log(abs(shares[i * parts + i]))))
    alike = most < math.inf
    for i in range(count):
        here = math.log(abs(shares[i * parts + i]))
        alike = alike and abs(here - last[i]) <= _ALIKE * most  # and no NaN
        last[i] = here
    return alike


@kernel
def _extrapolate(
    q: Vector,
    rows: Vector,
    number: float,
    count: int,
    weights: Vector,
    parts: int,
    shares: Vector,
    last: Vector,
    logarithms: Vector,
) -> None:
    """What many pieces do that do alike; what they leave too little of, by the last one."""
    for i in range(count):
        if 0.0 < shares[i * parts + i] < math.inf:
            logarithms[i] += math.log(shares[i * parts + i])
        else:
            logarithms[i] += number * last[i]
            copy(beyond(rows, i * parts), beyond(q, i * parts), parts)
            _placed(q, i, weights, parts)


@kernel
def _pass_event(
    plan: Vector,
    here: Vector,
    event: int,
    limit: float,
    rows: Vector,
    work: Vector,
    count: int,
    weights: Vector,
    logarithms: Vector,
) -> bool:
    """Carry rows through an event that comes at once; return whether it does."""
    parts = flow.parts(plan)
    there, ended, notes = room(), ended_room(), parts_room()
    q, shares = work, beyond(work, parts * parts)
    if flow.advance(plan, here, limit, ended, there) != event:
        return False
    ended[EVENT], ended[T] = event, 0.0
    again = 0
    while True:
        copy(rows, q, parts * parts)
        flow.tangent(plan, here, ended, there, notes, q)
        again += 1
        unsure = orthonormalise(q, count, weights, parts, shares, _CLEAN, 0.0)
        if unsure == 0 or again == _AGAIN:
            break
        for i in range(count):
            size = abs(shares[i * parts + i])
            if size < math.inf:
                logarithms[i] += math.log(size)
                for j in range(i):
                    _add(rows, i, -shares[i * parts + j], j, parts)
                _scale(rows, i, 1.0 / size, parts)
    for i in range(count):
        whole = 0.0
        for j in range(i + 1):
            whole += shares[i * parts + j] ** 2
        if whole < math.inf and shares[i * parts + i] ** 2 <= LEAST * LEAST * whole:
            shares[i * parts + i] = -math.inf
    add_up(plan, there, q, count, weights, shares, logarithms)
    copy(q, rows, count * parts)
    return True
