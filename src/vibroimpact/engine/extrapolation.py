"""Closing in on a steady motion faster than by following it: extrapolation, and following again.

Near a fixed point the map P of the stroboscopic state is affine, and in the plane of u and u̇,
where all else has been forgotten, two secants determine it. With f = P(x) − x and differences Δ
over the last three states, the next guess is P(x) − ΔP θ, θ = argmin ‖f − Δf θ‖ (Anderson's
acceleration with two secants). While the motion is only followed this is the limit of the two
geometric series in which it approaches.

It extrapolates only where the motion contracts, touches the stops as often in each cycle, where two
successive guesses agree, and where the way is short; it is taken back where following does not bear
it out, and the orbit found must attract (docs/decisions/0014-settling.md).
"""

from __future__ import annotations

import math

from vibroimpact.engine import flow
from vibroimpact.engine.chaos_indicator import runs_away
from vibroimpact.engine.fixed_point import DYING, newton_iterate
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import stack
from vibroimpact.engine.sections import advance
from vibroimpact.engine.state import FIRST, LARGEST, put, room
from vibroimpact.engine.status import DONE

_HELD = 3
"""States that are held, the newest first: x and f of each."""

ROOM = (_HELD * 2 + 1) * LARGEST
"""They stand one behind the other, and then the guess."""

_NEAR = 0.05
"""Of the motion's size: the longest way that is gone at once."""
_AGREE = 0.1
"""Of the way: by how much two successive guesses may differ."""
_CLOSE = 1e-6
"""Of the motion's size: a way as short as this is left to Newton's method."""
_PARALLEL = 1e-4
"""Two secants with a determinant below this share of their squares are one."""

_PURSUED = 48
"""Cycles in which the changes must become less, or the motion is only followed."""
_WAITS = 8
"""Cycles that a motion is followed behind a way that led nowhere."""

pursuit_room = stack(ROOM)


@kernel
def remember_change(held: Vector, before: Vector, after: Vector, parts: int) -> None:
    """Enter a state and what the map has made of it."""
    for n in range(_HELD - 1, 0, -1):
        for i in range(2 * parts):
            held[n * 2 * parts + i] = held[(n - 1) * 2 * parts + i]
    for i in range(parts):
        x = before[FIRST + i]
        held[i] = x
        held[parts + i] = after[FIRST + i] - x


@kernel
def change_of(held: Vector, units: Vector, parts: int) -> float:
    """The size of the newest change, as a velocity."""
    largest = 0.0
    for i in range(parts):
        largest = max(largest, abs(held[parts + i]) * units[i])
    return largest


@kernel
def guess(held: Vector, units: Vector, parts: int) -> tuple[float, float, bool]:
    """Where the three states that are held lead.

    Returns
    -------
    way, moved, contracts
        From the newest state's image to the guess, and from the former guess; whether the map, by
        its secants, contracts.
    """
    one, two, goal = 2 * parts, 4 * parts, _HELD * 2 * parts
    a11, a12, a22, b1, b2 = 0.0, 0.0, 0.0, 0.0, 0.0
    # Of the secants of x, in which those of P are expressed: eigenvalues of P.
    x11, x12, x22, p11, p12, p21, p22 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(parts):
        w = units[i] * units[i]
        f = held[parts + i]
        df1, df2 = f - held[one + parts + i], held[one + parts + i] - held[two + parts + i]
        dx1, dx2 = held[i] - held[one + i], held[one + i] - held[two + i]
        a11 += w * df1 * df1
        a12 += w * df1 * df2
        a22 += w * df2 * df2
        b1 += w * df1 * f
        b2 += w * df2 * f
        x11 += w * dx1 * dx1
        x12 += w * dx1 * dx2
        x22 += w * dx2 * dx2
        p11 += w * dx1 * (dx1 + df1)
        p12 += w * dx1 * (dx2 + df2)
        p21 += w * dx2 * (dx1 + df1)
        p22 += w * dx2 * (dx2 + df2)
    if not a11 > 0.0:
        return 0.0, 0.0, True
    first, second = b1 / a11, 0.0
    det = a11 * a22 - a12 * a12
    if det > _PARALLEL * a11 * a22:
        first, second = (b1 * a22 - b2 * a12) / det, (b2 * a11 - b1 * a12) / det
    radius = p11 / x11 if x11 > 0.0 else 0.0
    det = x11 * x22 - x12 * x12
    if det > _PARALLEL * x11 * x22:
        trace = (p11 * x22 - p21 * x12 + p22 * x11 - p12 * x12) / det
        product = (p11 * p22 - p12 * p21) / det
        inside = trace * trace - 4.0 * product
        radius = math.sqrt(abs(product))
        if inside > 0.0:
            radius = 0.5 * (abs(trace) + math.sqrt(inside))
    way, moved = 0.0, 0.0
    for i in range(parts):
        w = units[i]
        f, x = held[parts + i], held[i]
        f1, x1 = held[one + parts + i], held[one + i]
        back = first * (f - f1 + x - x1)
        back += second * (f1 - held[two + parts + i] + x1 - held[two + i])
        new = x + f - back
        way = max(way, w * abs(back))
        moved = max(moved, w * abs(new - held[goal + i]))
        held[goal + i] = new
    return way, moved, abs(radius) < DYING


@kernel
def trusted(way: float, moved: float, contracts: bool, scale: float) -> bool:
    """Whether a guess is worth following."""
    return contracts and way <= _NEAR * scale and moved <= _AGREE * way


@kernel
def extrapolate(
    plan: Vector,
    state: Vector,
    s: float,
    c: float,
    period: float,
    units: Vector,
    tolerance: float,
    max_cycles: int,
    max_events: int,
    asked: float,
) -> tuple[bool, bool, int]:
    """Follow a motion of one cycle, and go ahead where it is seen where it leads.

    Behind `asked` cycles it is asked whether it is plainly chaotic.

    Returns
    -------
    found, plain, cycles
        Whether it was reached to the tolerance, and whether it is plainly chaotic; if not found,
        the state is one that following gave.
    """
    held, kept, section = pursuit_room(), room(), room()
    parts = flow.parts(plan)
    put(plan, state, kept)  # what following gave, before going ahead
    left = math.inf  # size of the last change then
    alike, former = 0, -1  # cycles with as many events as the one before
    filled = 0  # cycles behind the last fresh start
    ahead = False  # what is followed is not what following gave
    stepped = False  # the cycle before ended with a guess
    last, before = math.inf, math.inf  # the last way, and size of the change before
    scale = 0.0
    waits, k = 0, 0
    most, was_most = 0.0, math.inf  # largest change in this block of cycles, and in the one before
    while k < max_cycles:
        if k % _PURSUED == 0:
            if most > 0.9 * was_most:
                break
            most, was_most = 0.0, most if k else math.inf
        if k >= asked and not ahead:
            asked = math.inf
            plain, beside = runs_away(plan, state, s, c, period, units, max_events)
            k += beside
            if plain:
                return False, True, k
            stepped, alike, filled, last = False, 0, 0, math.inf
        events, outcome = advance(plan, state, section, s, c, period, max_events)
        k += 1
        if outcome != DONE:
            put(plan, kept if ahead else section, state)
            return False, False, k
        alike = alike + 1 if events == former else 0
        former = events
        scale = max(0.5 * scale, flow.size(plan, state))
        remember_change(held, section, state, parts)
        filled += 1
        change = change_of(held, units, parts)
        most = max(most, change)
        if ahead and (alike == 0 or change > 0.5 * left):
            put(plan, kept, state)
            ahead, stepped, alike, filled, last = False, False, 0, 0, math.inf
            waits = k + _WAITS
            continue
        if stepped and change > 0.5 * before:  # the secants do not describe all of it
            stepped, filled = False, 1
        before = change
        if alike < 2 or filled < 3:
            stepped = False
            continue
        way = 0.0
        if not ahead:
            put(plan, state, kept)
            left = change
        if change > tolerance * scale:
            way, moved, contracts = guess(held, units, parts)
            if stepped:
                stepped = way <= 0.5 * last
            elif ahead:
                stepped = contracts and way <= last
            else:
                stepped = filled > 3 and k >= waits and trusted(way, moved, contracts, scale)
            if not stepped:
                continue
            ahead, last = True, way
            for i in range(parts):
                state[FIRST + i] = held[_HELD * 2 * parts + i]
            flow.place(plan, state)
        if way <= _CLOSE * scale:
            used, found = newton_iterate(
                plan, state, s, c, period, units, tolerance, scale, max_events
            )
            if not found:
                put(plan, kept, state)
            return found, False, k + used
    if ahead:
        put(plan, kept, state)
    return False, False, k
