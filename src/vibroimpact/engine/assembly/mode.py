"""What a contact mode changes: which stops press, which hold, and how fast the state may change."""

from __future__ import annotations

import math

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond, stack
from vibroimpact.engine.state import MOST_PARTS

RATES_KEPT = 8
"""Modes whose rates are kept, each with its rate."""

_DEPENDENT = 1e-12
"""A stop whose constraint is this close to those of others adds none (both walls touch a mass)."""

_leaders = stack(MOST_PARTS)


@not_inlined
def enter_mode(plan: Vector, mode: int) -> None:
    """List the pressed and the resting stops of a mode, and bound its rate."""
    if int(plan[at.MODE]) == mode:
        return
    plan[at.MODE], plan[at.TABLE_NOW], plan[at.RATES_NOW] = float(mode), -1.0, -1.0
    count, stops = int(plan[at.STOPS]), int(plan[at.STOP])
    pressed, resting = int(plan[at.PRESSED_LIST]), int(plan[at.RESTING_LIST])
    p, r = 0, 0
    for f in range(count):
        if mode >> f & 1:
            kind = plan[stops + f * at.STOP_WIDTH + at.KIND]
            if kind == at.KELVIN_VOIGT:
                plan[pressed + p] = float(f)
                p += 1
            elif kind != at.PUSHING:
                plan[resting + r] = float(f)
                r += 1
    plan[at.PRESSED], plan[at.RESTING] = float(p), float(r)
    _factorize(plan)
    kept = int(plan[at.RATE_OF]) + 2 * ((mode ^ mode >> 3 ^ mode >> 6) & (RATES_KEPT - 1))
    if plan[kept] != float(mode):
        plan[kept], plan[kept + 1] = float(mode), _rate(plan)
    plan[at.RATE] = plan[kept + 1]


@kernel
def _rate(plan: Vector) -> float:
    """The least ρ for which |A x| ≤ ρ |x| in the norm max(ρ |u|, |v|), from row sums (1/s)."""
    n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
    sums, response = int(plan[at.ROW_SUMS]), int(plan[at.RESPONSE])
    pressed, stops = int(plan[at.PRESSED_LIST]), int(plan[at.STOP])
    rest = 1.0
    for i in range(int(plan[at.RESTING])):
        f = int(plan[int(plan[at.RESTING_LIST]) + i])
        most = 0.0
        for q in range(n):
            most = max(most, abs(plan[response + f * n + q]))
        rest += 2.0 * most / plan[int(plan[at.COUPLING]) + f * count + f]
    rate = 0.0
    for i in range(n):
        k, c = plan[sums + i], plan[sums + n + i]
        for p in range(int(plan[at.PRESSED])):
            f = int(plan[pressed + p])
            one = stops + f * at.STOP_WIDTH
            ends = (plan[one + at.LEFT] < n) + (plan[one + at.RIGHT] < n)
            size = ends * abs(plan[response + f * n + i])
            k += size * plan[one + at.STOP_STIFFNESS]
            c += size * plan[one + at.STOP_DAMPING]
        k *= rest
        c *= rest
        rate = max(rate, 0.5 * (c + math.sqrt(c * c + 4.0 * k)))
    bound: float = max(rate, plan[at.HIGHEST])
    return bound


@kernel
def _factorize(plan: Vector) -> None:
    """Cholesky's factor of W M⁻¹ Wᵀ of the resting stops; rows of dependent ones are zero."""
    count, r = int(plan[at.STOPS]), int(plan[at.RESTING])
    listed, coupling = int(plan[at.RESTING_LIST]), int(plan[at.COUPLING])
    factor = int(plan[at.FACTOR])
    for i in range(r):
        f = int(plan[listed + i])
        for j in range(i + 1):
            value = plan[coupling + f * count + int(plan[listed + j])]
            for k in range(j):
                value -= plan[factor + i * count + k] * plan[factor + j * count + k]
            if i == j:
                enough = value > _DEPENDENT * plan[coupling + f * count + f]
                value = math.sqrt(value) if enough else 0.0
            else:
                pivot = plan[factor + j * count + j]
                value = value / pivot if pivot > 0.0 else 0.0
            plan[factor + i * count + j] = value


@kernel
def hold(plan: Vector, closing: Vector) -> None:
    """Make of the resting stops' closing accelerations the forces that prevent them, in place."""
    count, r, factor = int(plan[at.STOPS]), int(plan[at.RESTING]), int(plan[at.FACTOR])
    rows = beyond(plan, factor)
    for i in range(r):
        value = closing[i]
        for j in range(i):
            value -= rows[i * count + j] * closing[j]
        pivot = rows[i * count + i]
        closing[i] = value / pivot if pivot > 0.0 else 0.0
    for i in range(r - 1, -1, -1):
        value = closing[i]
        for j in range(i + 1, r):
            value -= rows[j * count + i] * closing[j]
        pivot = rows[i * count + i]
        closing[i] = value / pivot if pivot > 0.0 else 0.0


@kernel
def move_alike(plan: Vector, values: Vector) -> None:
    """Give bodies that rest on each other the same velocity or acceleration, to the last digit.

    It is that of the ground, or of the first mass among them.
    """
    n, r = int(plan[at.MASSES]), int(plan[at.RESTING])
    if r == 0:
        return
    leaders, changed = _leaders(), True
    for i in range(n):
        leaders[i] = float(i)
    leaders[n] = -1.0
    while changed:
        changed = False
        for j in range(r):
            f = int(plan[int(plan[at.RESTING_LIST]) + j])
            one = int(plan[at.STOP]) + f * at.STOP_WIDTH
            a, b = int(plan[one + at.LEFT]), int(plan[one + at.RIGHT])
            if leaders[a] == leaders[b]:
                continue
            first, second = (a, b) if leaders[a] < leaders[b] else (b, a)
            leaders[second], changed = leaders[first], True
            values[second] = values[first] if leaders[first] >= 0.0 else 0.0
