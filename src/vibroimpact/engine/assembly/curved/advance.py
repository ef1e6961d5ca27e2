"""A motion with curved laws from event to event."""

from __future__ import annotations

from vibroimpact.engine.assembly import advance as linear
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.advance import relax, remember
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved.event_functions import first_of
from vibroimpact.engine.assembly.curved.happen import decide, switch
from vibroimpact.engine.assembly.curved.numbers import enter, size_of
from vibroimpact.engine.assembly.curved.step import take_end, take_step, travel
from vibroimpact.engine.assembly.curved.terms import expand_over
from vibroimpact.engine.assembly.mode import enter_mode, move_alike
from vibroimpact.engine.event import GIVEN_UP, LIMIT, TURN, event_of
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond

_SAME = 1e-12
"""Share of a step within which events are simultaneous, so that the row's number decides."""

_MOMENT = 2.0**-60
"""Share of the time in which the motion changes."""

_SHORT, _MOST = 1e-3, 200_000
"""Steps below this share of that time, so many without a longer one between, lead nowhere."""


begin, build = linear.begin, linear.build


@kernel
def _gone(plan: Vector, y: Vector) -> bool:
    total = 0.0
    for i in range(2 * int(plan[at.MASSES])):
        total += abs(y[i])
    return not total < 1e200


@not_inlined
def next_curved_stretch(plan: Vector, left: float) -> int:
    """Go on to the next event, at most for a step and for the time that is left.

    As `assembly.advance.next_stretch`.
    """
    count = int(plan[at.STOPS])
    y, deformation = beyond(plan, int(plan[at.Y])), beyond(plan, int(plan[at.DEFORMATION]))
    plan[at.STEPS] += 1.0
    plan[at.PIECES], plan[at.PIECE] = 1.0, 0.0
    plan[at.EVENT], plan[at.LENGTH] = float(GIVEN_UP), 0.0
    if _gone(plan, y):
        remember(plan, int(plan[at.START]), int(plan[at.START_DEFORMATION]))
        plan[at.STRETCH_MODE] = plan[at.MODE]
        return GIVEN_UP
    if plan[at.LEVEL] == of.NEW:
        decide(plan, int(plan[at.MODE]), y, deformation)
        plan[at.LEVEL] = 0.0
    mode = int(plan[at.MODE])
    remember(plan, int(plan[at.START]), int(plan[at.START_DEFORMATION]))
    for f in range(count):  # `reopen` needs what was fresh
        plan[int(plan[at.START_DEFORMATION]) + count + f] = plan[int(plan[at.ZEROS]) + f]
    plan[at.STRETCH_MODE] = plan[at.MODE]
    size = size_of(plan, y)
    longest = enter(plan, y, deformation, size)
    h = take_step(plan, y, deformation, left, longest, size)
    short = h * plan[at.STIFF_RATE] < _SHORT and h < left
    plan[at.SHORT] = plan[at.SHORT] + 1.0 if short else 0.0
    if (h == 0.0 and left > 0.0) or plan[at.SHORT] > _MOST:
        return GIVEN_UP
    hit, which, end = -1, 0, 1.0
    for f in range(count):
        limit = end if hit < 0 else end - _SAME
        if limit < 0.0:
            break
        tau, one = first_of(plan, f, mode, h, size, limit)
        if tau <= limit:
            hit, which, end = f, one, tau
    if hit < 0:
        take_end(plan, y, deformation)
    elif end > 0.0:
        travel(plan, y, deformation, end * plan[at.SHARE])
    if hit < 0 or end > 0.0:
        relax(plan, mode, deformation, end * h)
        move_alike(plan, beyond(y, int(plan[at.MASSES])))
    length = h if hit < 0 else end * h
    if end > _SAME:
        for f in range(count):
            plan[int(plan[at.ZEROS]) + f] = 0.0
    plan[at.LENGTH], plan[at.AT_ONCE] = length, 1.0 if end <= _SAME else 0.0
    plan[at.AGE] += length
    event = LIMIT
    if hit >= 0:
        remember(plan, int(plan[at.END]), int(plan[at.END_DEFORMATION]))
        mode, kind = switch(plan, mode, hit, which, y, deformation)
        enter_mode(plan, mode)
        if kind != TURN:
            plan[at.AGE] = 0.0
        event = event_of(kind, hit)
    plan[at.EVENT] = float(event)
    return event


@not_inlined
def reopen(plan: Vector) -> None:
    """Write the series of the last stretch again, on its whole length.

    As `channels.open_stretch` and `open_piece`, for the stretch is one piece.
    """
    plan[at.ACTUAL_MODE] = plan[at.MODE]
    enter_mode(plan, int(plan[at.STRETCH_MODE]))
    n, w, count = int(plan[at.MASSES]), int(plan[at.WAVES]), int(plan[at.STOPS])
    y, deformation = (
        beyond(plan, int(plan[at.START])),
        beyond(plan, int(plan[at.START_DEFORMATION])),
    )
    for i in range(2 * n + w + 1):
        plan[int(plan[at.PIECE_Y]) + i] = y[i]
    for f in range(count):
        plan[int(plan[at.PIECE_DEFORMATION]) + f] = deformation[f]
    zeros, kept = int(plan[at.ZEROS]), int(plan[at.SCRATCH]) + 4 * (2 * n + w + 1 + count)
    for f in range(count):
        plan[kept + f] = plan[zeros + f]
        plan[zeros + f] = deformation[count + f]
    enter(plan, y, deformation, size_of(plan, y))
    for f in range(count):
        plan[zeros + f] = plan[kept + f]
    length = plan[at.LENGTH]
    # A stretch of no length shows what is at its end: on such a moment nothing changes.
    moment = length if length > 0.0 else _MOMENT / plan[at.STIFF_RATE]
    expand_over(plan, y, deformation, moment)


next_stretch = next_curved_stretch
advance = linear.advancing(next_stretch)
