"""The channels of several masses (see `engine.channels`).

event = next_stretch(plan, left)
open_stretch(plan)
for i in range(pieces(plan)):
    open_piece(plan, i)                           # in this order
    order = series(plan, FORCE, stop, out)        # or value(plan, FORCE, stop, tau)
close_stretch(plan)
"""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.mode import enter_mode
from vibroimpact.engine.assembly.series import (
    expand_start,
    expand_state,
    travel_by_series,
    watched_series,
)
from vibroimpact.engine.channels import (
    ABSOLUTE_ACCELERATION,
    ACCELERATION,
    CLEARANCE,
    DEFORMATION,
    DISPLACEMENT,
    FORCE,
    LENGTH,
    OWN,
    SINCE,
    VELOCITY,
    evaluate,
)
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond


@not_inlined
def open_stretch(plan: Vector) -> None:
    """Go back to where the last stretch begins."""
    plan[at.ACTUAL_MODE] = plan[at.MODE]
    enter_mode(plan, int(plan[at.STRETCH_MODE]))
    n, w, count = int(plan[at.MASSES]), int(plan[at.WAVES]), int(plan[at.STOPS])
    for i in range(2 * n + w + 1):
        plan[int(plan[at.PIECE_Y]) + i] = plan[int(plan[at.START]) + i]
    for f in range(count):
        plan[int(plan[at.PIECE_DEFORMATION]) + f] = plan[int(plan[at.START_DEFORMATION]) + f]


@kernel
def close_stretch(plan: Vector) -> None:
    """Return to the present."""
    enter_mode(plan, int(plan[at.ACTUAL_MODE]))


@kernel
def pieces(plan: Vector) -> int:
    """How many pieces the last stretch has, all of the same length."""
    return int(plan[at.PIECES])


@kernel
def piece_length(plan: Vector) -> float:
    """Their length (s)."""
    length: float = plan[at.LENGTH] / plan[at.PIECES]
    return length


@kernel
def fade(plan: Vector, deformation: Vector, t: float) -> None:
    """Let the free stops' numbers decay, in the mode that was entered."""
    stops, mode = int(plan[at.STOP]), int(plan[at.MODE])
    for f in range(int(plan[at.STOPS])):
        if deformation[f] != 0.0 and not mode >> f & 1:
            deformation[f] *= math.exp(-plan[stops + f * at.STOP_WIDTH + at.RELAXATION] * t)


@not_inlined
def open_piece(plan: Vector, i: int) -> None:
    """Make the series of a piece; one after the other."""
    y = beyond(plan, int(plan[at.PIECE_Y]))
    deformation = beyond(plan, int(plan[at.PIECE_DEFORMATION]))
    length = piece_length(plan)
    if i > 0:
        travel_by_series(plan, y, deformation, 1.0)
        fade(plan, deformation, length)
    expand_state(plan, y, deformation, length)


@not_inlined
def open_instant(plan: Vector) -> bool:
    """Make the first terms of the series of the present, as a piece.

    Returns whether nothing happens at this instant: where nothing is zero by construction, and
    nothing that is watched has fallen to zero.
    """
    y = beyond(plan, int(plan[at.Y]))
    deformation = beyond(plan, int(plan[at.DEFORMATION]))
    mode, first = int(plan[at.MODE]), beyond(plan, int(plan[at.COEFFICIENTS]))
    expand_start(plan, y, deformation, 1.0 / max(plan[at.RATE], 1e-200))
    for f in range(int(plan[at.STOPS])):
        plan[int(plan[at.PIECE_DEFORMATION]) + f] = deformation[f]
        watched_series(plan, f, mode, first)
        if plan[int(plan[at.ZEROS]) + f] != 0.0 or not first[0] > 0.0:
            return False
    return True


@not_inlined
def series(plan: Vector, channel: int, index: int, out: Vector) -> int:
    """Write a channel's power series in τ, 0 to 1 on the piece; returns its order."""
    n, w, row = int(plan[at.MASSES]), int(plan[at.WAVES]), int(plan[at.ROW])
    order, states = int(plan[at.ORDER]), int(plan[at.SERIES])
    waves = states + 2 * (n + 1)
    length = plan[at.PIECE_LENGTH]
    mode, one = int(plan[at.MODE]), int(plan[at.STOP]) + index * at.STOP_WIDTH
    pressed = channel >= CLEARANCE and mode >> index & 1 == 1
    out[at.TERMS], out[at.TERMS + 1] = 0.0, 0.0
    if channel in (ACCELERATION, ABSOLUTE_ACCELERATION):
        order -= 1
        push = int(plan[at.PUSH]) + index * w
        for j in range(order + 1):
            a = (j + 1) / length * plan[states + (j + 1) * row + n + 1 + index]
            if channel == ABSOLUTE_ACCELERATION and plan[at.SHAKEN] != 0.0:
                for q in range(w):
                    a -= plan[push + q] * plan[waves + j * row + q]
            out[j] = a
        return order
    if (channel == FORCE and pressed) or (channel == CLEARANCE and not pressed):
        watched_series(plan, index, mode, out)
    for j in range(order + 1):
        here = states + j * row
        if channel == DISPLACEMENT:
            out[j] = plan[here + index]
        elif channel == VELOCITY:
            out[j] = plan[here + n + 1 + index]
        elif channel == FORCE:
            if not pressed:
                out[j] = 0.0
        elif channel == CLEARANCE:
            if pressed:
                out[j] = 0.0
        elif plan[one + at.KIND] == at.RIGID or not pressed:
            out[j] = 0.0
        elif j == 0:
            out[j] = plan[int(plan[at.PIECE_DEFORMATION]) + index]
        else:
            out[j] = plan[here + int(plan[one + at.LEFT])] - plan[here + int(plan[one + at.RIGHT])]
    if not pressed and channel in (CLEARANCE, DEFORMATION):
        d = plan[int(plan[at.PIECE_DEFORMATION]) + index]
        if d > 0.0:
            out[at.TERMS], out[at.TERMS + 1] = d, plan[one + at.RELAXATION] * length
    return order


@kernel
def value(plan: Vector, channel: int, index: int, tau: float) -> float:
    """A channel's value on the piece."""
    out = beyond(plan, int(plan[at.ROOM]))
    order = series(plan, channel, index, out)
    return evaluate(out, order, tau)


@kernel
def _force_on_base(plan: Vector, a: Vector, b: Vector) -> int:
    """Write the series of ι · (f + p − M a) with absolute accelerations; returns its order."""
    n, w, carried = int(plan[at.MASSES]), int(plan[at.WAVES]), int(plan[at.CARRIED])
    push, waves = int(plan[at.PUSH]), int(plan[at.SERIES]) + 2 * (n + 1)
    order, row = int(plan[at.ORDER]) - 1, int(plan[at.ROW])
    for j in range(order + 1):
        b[j] = 0.0
    for i in range(n):
        series(plan, ACCELERATION, i, a)
        for j in range(order + 1):
            value = -a[j]
            for q in range(w):
                value += plan[push + i * w + q] * plan[waves + j * row + q]
            b[j] += plan[carried + i] * value
    b[0] += plan[at.LOAD] * plan[at.MOVED]
    return order


@kernel
def drift_ends(plan: Vector, k: int) -> tuple[int, int]:
    """The bodies of a drift; n is the ground."""
    one = int(plan[at.DRIFT]) + k * at.DRIFT_WIDTH
    return int(plan[one + at.DRIFT_LEFT]), int(plan[one + at.DRIFT_RIGHT])


@kernel
def observed(plan: Vector, c: int, a: Vector, b: Vector) -> int:
    """Write the series of what is observed whether anything is touched or not; its order.

    Of 2 n + 1 + drifts channels: the displacements, the absolute accelerations, the force on the
    base, the drifts. `a` is room.
    """
    n = int(plan[at.MASSES])
    if c < n:
        order: int = series(plan, DISPLACEMENT, c, b)
    elif c < 2 * n:
        order = series(plan, ABSOLUTE_ACCELERATION, c - n, b)
    elif c == 2 * n:
        order = _force_on_base(plan, a, b)
    else:
        left, right = drift_ends(plan, c - 2 * n - 1)
        row, states, order = int(plan[at.ROW]), int(plan[at.SERIES]), int(plan[at.ORDER])
        for j in range(order + 1):
            b[j] = plan[states + j * row + right] - plan[states + j * row + left]
    return order


def walking(channels: Any) -> tuple[Any, Any, Any]:
    """Make `flow.first_piece`, `flow.next_piece` and `flow.series` of a flow's channels."""
    open_stretch, open_piece, one_series = (
        channels.open_stretch,
        channels.open_piece,
        channels.series,
    )

    def first_piece(plan: Vector, before: Vector, ended: Vector, piece: Vector) -> int:
        if not plan[at.LENGTH] > 0.0:
            return 0
        open_stretch(plan)
        open_piece(plan, 0)
        piece[SINCE], piece[LENGTH], piece[OWN] = 0.0, piece_length(plan), 0.0
        return 1

    def next_piece(plan: Vector, before: Vector, piece: Vector) -> int:
        i = int(piece[OWN]) + 1
        if i == pieces(plan):
            close_stretch(plan)
            return 0
        open_piece(plan, i)
        piece[SINCE], piece[OWN] = i * piece[LENGTH], float(i)
        return 1

    def series(
        plan: Vector, before: Vector, piece: Vector, channel: int, index: int, out: Vector
    ) -> int:
        order: int = one_series(plan, channel, index, out)
        return order

    return kernel(first_piece), kernel(next_piece), kernel(series)
