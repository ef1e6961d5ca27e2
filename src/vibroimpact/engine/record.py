"""A trajectory written down: samples at equal times, and every contact and detachment."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.evaluate import absolute_acceleration, moved, node, relaxed, travel
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.phase import (
    FLIGHT,
    LEFT,
    LIMIT,
    NODE,
    NODES,
    RATE,
    RIGHT,
    SIZE,
    TABLES,
    VALID_FROM,
    WIDTH,
    H,
)
from vibroimpact.engine.trajectory import advance

# Columns of a sample.
DISPLACEMENT, VELOCITY, ACCELERATION, RIGHT_FACE, LEFT_FACE, CONTACT = range(6)
SAMPLE = 6

# Columns of an event: the state there, and the absolute acceleration just before and behind.
E_CYCLE, E_TIME, E_KIND, E_SIDE, E_U, E_V, E_RIGHT, E_LEFT, E_BEFORE, E_BEHIND = range(10)
EVENT = 10


@kernel
def seen(plan: Vector, mode: int, u: float, v: float, right: float, left: float) -> float:
    """Absolute acceleration in the direction of u, from a full state."""
    if mode == FLIGHT:
        return absolute_acceleration(plan, mode, u, v)
    if mode == RIGHT:
        return absolute_acceleration(plan, mode, right, v)
    return -absolute_acceleration(plan, mode, left, -v)


@kernel
def sample_stretch(
    plan: Vector,
    mode: int,
    u: float,
    v: float,
    s: float,
    c: float,
    right: float,
    left: float,
    age: float,
    begin: float,
    length: float,
    step: float,
    first: int,
    n: int,
    out: Vector,
) -> int:
    """Fill samples first, first+1, … that fall within one stretch; return the next one.

    Sample i is at i·step from the cycle's start, the stretch lasts from `begin` to
    `begin + length`. The motion itself is not interrupted: what is sampled has no influence.
    """
    rate_r = plan[par.BUMPER + par.RATE]
    rate_l = plan[par.BUMPER + par.WIDTH + par.RATE]
    sign = -1.0 if mode == LEFT else 1.0
    x, v, s, c = (
        right if mode == RIGHT else (left if mode == LEFT else u),
        sign * v,
        sign * s,
        sign * c,
    )
    table = TABLES + SIZE * mode
    late = table + 3 * SIZE
    t = 0.0
    i = first
    while i < n and i * step < begin + length:
        tau = max(i * step - begin, 0.0)
        while True:
            now = late if age + t >= plan[late + VALID_FROM] else table
            if (tau - t) * plan[now + RATE] < NODES:
                break
            x, v, s, c = moved(plan, now + NODE + (NODES - 1) * WIDTH, x, v, s, c)
            t += NODES * plan[now + H]
        y = (tau - t) * plan[now + RATE]
        j = int(y)
        sx, sv, ss, sc = node(plan, now, j, x, v, s, c)
        sx, sv, ss, sc = travel(plan, now, y - j, sx, sv, ss, sc)
        out[i, ACCELERATION] = sign * absolute_acceleration(plan, mode, sx, sv)
        out[i, VELOCITY] = sign * sv
        out[i, CONTACT] = 0.0
        if mode == FLIGHT:
            out[i, DISPLACEMENT] = sx
            out[i, RIGHT_FACE] = relaxed(right, rate_r, tau)
            out[i, LEFT_FACE] = -relaxed(left, rate_l, tau)
        elif mode == RIGHT:
            out[i, DISPLACEMENT] = plan[par.BUMPER + par.GAP] + sx
            out[i, RIGHT_FACE] = sx
            out[i, LEFT_FACE] = -relaxed(left, rate_l, tau)
            out[i, CONTACT] = 1.0
        else:
            out[i, DISPLACEMENT] = -(plan[par.BUMPER + par.WIDTH + par.GAP] + sx)
            out[i, RIGHT_FACE] = relaxed(right, rate_r, tau)
            out[i, LEFT_FACE] = -sx
            out[i, CONTACT] = -1.0
        i += 1
    return i


@kernel
def record_cycle(
    plan: Vector,
    mode: int,
    fresh: int,
    u: float,
    v: float,
    right: float,
    left: float,
    age: float,
    s: float,
    c: float,
    length: float,
    step: float,
    n: int,
    number: int,
    max_events: int,
    out: Vector,
    events: Vector,
    count: int,
) -> tuple[bool, int, int, float, float, float, float, float, int]:
    """One forcing cycle, or its first `length` seconds, written down.

    Returns
    -------
    complete, mode, fresh, u, v, right, left, age, count
        Whether the cycle was finished within `max_events` and the space for events.
    """
    t = 0.0
    i = 0
    here = 0
    while True:
        m0, u0, v0, s0, c0, r0, l0, age0 = mode, u, v, s, c, right, left, age
        event, dt, mode, fresh, u, v, s, c, right, left, age = advance(
            plan, mode, fresh, u, v, s, c, right, left, length - t, age
        )
        if n:
            # The last stretch takes what rounding left over.
            reach = math.inf if event == LIMIT else dt
            i = sample_stretch(plan, m0, u0, v0, s0, c0, r0, l0, age0, t, reach, step, i, n, out)
        if event == LIMIT:
            return True, mode, fresh, u, v, right, left, age, count
        t += dt
        here += 1
        if here > max_events or count == len(events):
            return False, mode, fresh, u, v, right, left, age, count
        row = events[count]
        row[E_CYCLE], row[E_TIME] = number, t
        row[E_KIND] = 1.0 if mode != FLIGHT else 0.0
        row[E_SIDE] = 1.0 if RIGHT in (mode, m0) else -1.0
        row[E_U], row[E_V], row[E_RIGHT], row[E_LEFT] = u, v, right, -left
        row[E_BEFORE] = seen(plan, m0, u, v, right, left)
        row[E_BEHIND] = seen(plan, mode, u, v, right, left)
        count += 1
        if t >= length:
            return True, mode, fresh, u, v, right, left, age, count
