"""Closing in on a steady motion faster than by following it: extrapolation, and following again.

Near a fixed point the map P of the stroboscopic state is affine, and in the plane of u and u̇,
where all else has been forgotten, two secants tell all of it. With f = P(x) − x and differences Δ
over the last three states, the next guess is P(x) − ΔP θ, θ = argmin ‖f − Δf θ‖ (Anderson's
acceleration with two secants). While the motion is only followed this is the limit of the two
geometric series in which it approaches.

It goes ahead only where the motion contracts, touches the stops as often in each cycle, where two
successive guesses agree, and where the way is short; it is taken back where following does not bear
it out, and what is found must attract (docs/decisions/0014-settling.md).
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import stack
from vibroimpact.engine.motion import LEFT, RIGHT, Motion
from vibroimpact.engine.section_map import placed

PARTS = 5
"""Of a stroboscopic state: u, u̇, u_R, u_L, z."""

_HELD = 3
"""States that are held, the newest first: x and f of each."""

ROOM = _HELD * 2 * PARTS + PARTS
_GUESS = _HELD * 2 * PARTS

_NEAR = 0.05
"""Of the motion's size: the longest way that is gone at once."""
_AGREE = 0.1
"""Of the way: by how much two successive guesses may differ."""
_PARALLEL = 1e-4
"""Two secants with a determinant below this share of their squares are one."""

_FORGOTTEN = 9.0
"""What relaxes by more powers of e in a cycle is another's memory no more."""
_SQUARED = 8
"""Times that a matrix is squared: its size to the power of 1/256 is its radius to a hundredth."""

pursuit_room = stack(ROOM)
matrix_room = stack(PARTS * PARTS)


@kernel
def parts_of(motion: Motion, i: int) -> float:
    """A part of the stroboscopic state."""
    if i == 0:
        return motion.u
    if i == 1:
        return motion.v
    if i == 2:
        return motion.right
    if i == 3:
        return motion.left
    return motion.z


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
    return way, moved, abs(radius) < 1.0


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
def disturbed(plan: Vector, motion: Motion, i: int, by: float) -> Motion:
    """A motion whose part i is another by so much, or by as little less, if only that can be."""
    mode, _, u, v, right, left, z, _, clock = motion
    if i == 0:
        u += by
    elif i == 1:
        v += by
    elif i == 2:
        right += by
    elif i == 3:
        left += by
    else:
        z += by if z <= 0.0 else -by
    return placed(plan, mode, u, v, right, left, z, clock)


@kernel
def counts(plan: Vector, motion: Motion, i: int, period: float) -> bool:
    """Whether a part of the state outlives a cycle by itself."""
    if i < 2:
        return True
    if i == 4:
        return bool(plan[par.HYSTERETIC] != 0.0)
    side = RIGHT if i == 2 else LEFT
    at = par.BUMPER + par.WIDTH * (side - 1)
    if motion.mode & side or plan[at + par.KIND] != par.KELVIN_VOIGT:
        return False
    return bool(plan[at + par.RATE] * period < _FORGOTTEN)


@kernel
def radius(matrix: Vector, other: Vector) -> float:
    """The spectral radius of a matrix (PARTS x PARTS, overwritten), by squaring it."""
    total = 0.0
    power = 1.0
    for _ in range(_SQUARED):
        size = 0.0
        for i in range(PARTS * PARTS):
            size = max(size, abs(matrix[i]))
        if size == 0.0:
            return 0.0
        total += math.log(size) * power
        for i in range(PARTS):
            for j in range(PARTS):
                summed = 0.0
                for k in range(PARTS):
                    summed += (matrix[PARTS * i + k] / size) * (matrix[PARTS * k + j] / size)
                other[PARTS * i + j] = summed
        for i in range(PARTS * PARTS):
            matrix[i] = other[i]
        power *= 0.5
    return math.exp(total)
