"""Closing in on a steady motion faster than by following it: extrapolation, and following again.

Near a fixed point the map P of the stroboscopic state is affine, and in the plane of u and u̇,
where all else has been forgotten, two secants tell all of it. With f = P(x) − x and differences Δ
over the last three states, the next guess is P(x) − ΔP θ, θ = argmin ‖f − Δf θ‖ (Anderson's
acceleration with two secants). While the motion is only followed this is the limit of the two
geometric series in which it approaches.

It extrapolates only where the motion contracts, touches the stops as often in each cycle, where two
successive guesses agree, and where the way is short; it is taken back where following does not bear
it out, and the orbit found must attract (docs/decisions/0014-settling.md).
"""

from __future__ import annotations

import math

from vibroimpact.engine.chaos_indicator import runs_away
from vibroimpact.engine.event_loop import cycle
from vibroimpact.engine.fixed_point import DYING, PARTS, close_in, parts_of
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import stack
from vibroimpact.engine.motion import Clock, Motion, finite
from vibroimpact.engine.observe import UNOBSERVED
from vibroimpact.engine.section_map import placed

_HELD = 3
"""States that are held, the newest first: x and f of each."""

ROOM = _HELD * 2 * PARTS + PARTS
_GUESS = _HELD * 2 * PARTS

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
def hold_on(room: Vector, before: Motion, after: Motion) -> None:
    """Enter a state and what the map has made of it."""
    for n in range(_HELD - 1, 0, -1):
        for i in range(2 * PARTS):
            room[n * 2 * PARTS + i] = room[(n - 1) * 2 * PARTS + i]
    for i in range(PARTS):
        x = parts_of(before, i)
        room[i] = x
        room[PARTS + i] = parts_of(after, i) - x


@kernel
def size_of(room: Vector, at: int, weight: float) -> float:
    """The size of a difference, as a velocity."""
    largest = 0.0
    for i in range(PARTS):
        largest = max(largest, abs(room[at + i]) * (1.0 if i == 1 else weight))
    return largest


@kernel
def guess(room: Vector, weight: float) -> tuple[float, float, bool]:
    """Where the three states that are held lead.

    Returns
    -------
    way, moved, contracts
        From the newest state's image to the guess, and from the former guess; whether the map, as
        its secants tell it, contracts.
    """
    one, two = 2 * PARTS, 4 * PARTS
    a11, a12, a22, b1, b2 = 0.0, 0.0, 0.0, 0.0, 0.0
    # Of the secants of x, by which those of P are told: P's eigenvalues.
    x11, x12, x22, p11, p12, p21, p22 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(PARTS):
        w = 1.0 if i == 1 else weight * weight
        f = room[PARTS + i]
        df1, df2 = f - room[one + PARTS + i], room[one + PARTS + i] - room[two + PARTS + i]
        dx1, dx2 = room[i] - room[one + i], room[one + i] - room[two + i]
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
    for i in range(PARTS):
        w = 1.0 if i == 1 else weight
        f, x = room[PARTS + i], room[i]
        f1, x1 = room[one + PARTS + i], room[one + i]
        back = first * (f - f1 + x - x1)
        back += second * (f1 - room[two + PARTS + i] + x1 - room[two + i])
        new = x + f - back
        way = max(way, w * abs(back))
        moved = max(moved, w * abs(new - room[_GUESS + i]))
        room[_GUESS + i] = new
    return way, moved, abs(radius) < DYING


@kernel
def trusted(way: float, moved: float, contracts: bool, scale: float) -> bool:
    """Whether a guess is worth following."""
    return contracts and way <= _NEAR * scale and moved <= _AGREE * way


@kernel
def guessed(plan: Vector, room: Vector, motion: Motion) -> Motion:
    """The guess as a motion that can be."""
    u, v, right = room[_GUESS], room[_GUESS + 1], room[_GUESS + 2]
    left, z = room[_GUESS + 3], room[_GUESS + 4]
    return placed(plan, motion.mode, u, v, right, left, z, motion.clock)


@kernel
def pursue(
    plan: Vector,
    motion: Motion,
    clock: Clock,
    period: float,
    weight: float,
    tolerance: float,
    max_cycles: int,
    max_events: int,
    asked: float,
) -> tuple[bool, bool, int, Motion]:
    """Follow a motion of one cycle, and go ahead where it is seen where it leads.

    Behind `asked` cycles it is asked whether it is plainly chaotic.

    Returns
    -------
    found, plain, cycles, motion
        Whether it was reached to the tolerance, and whether it is plainly chaotic; if not found,
        the motion is one that following gave.
    """
    room = pursuit_room()
    kept = motion  # what following gave, before going ahead
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
            plain, beside, motion = runs_away(plan, motion, clock, period, weight, max_events)
            k += beside
            if plain:
                return False, True, k, motion
            stepped, alike, filled, last = False, 0, 0, math.inf
        section = motion
        events, motion, _ = cycle(plan, section, clock, period, max_events, UNOBSERVED)
        k += 1
        if events > max_events or not finite(motion):
            return False, False, k, kept if ahead else section
        alike = alike + 1 if events == former else 0
        former = events
        scale = max(0.5 * scale, weight * abs(motion.u), abs(motion.v))
        hold_on(room, section, motion)
        filled += 1
        change = size_of(room, PARTS, weight)
        most = max(most, change)
        if ahead and (alike == 0 or change > 0.5 * left):
            motion, ahead, stepped, alike, filled, last = kept, False, False, 0, 0, math.inf
            waits = k + _WAITS
            continue
        if stepped and change > 0.5 * before:  # there is more to it than the secants tell
            stepped, filled = False, 1
        before = change
        if alike < 2 or filled < 3:
            stepped = False
            continue
        way = 0.0
        if not ahead:
            kept, left = motion, change
        if change > tolerance * scale:
            way, moved, contracts = guess(room, weight)
            if stepped:
                stepped = way <= 0.5 * last
            elif ahead:
                stepped = contracts and way <= last
            else:
                stepped = filled > 3 and k >= waits and trusted(way, moved, contracts, scale)
            if not stepped:
                continue
            ahead, last = True, way
            motion = guessed(plan, room, motion)
        if way <= _CLOSE * scale:
            used, found, motion = close_in(
                plan, motion, clock, period, weight, tolerance, scale, max_events
            )
            return found, False, k + used, motion if found else kept
    return False, False, k, kept if ahead else motion
