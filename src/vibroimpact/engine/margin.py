"""How far an orbit is from grazing: the least clearance it leaves, or depth it reaches."""

from __future__ import annotations

import math

import numpy as np

from vibroimpact.engine import parameters as par
from vibroimpact.engine.evaluate import expand, horner, moved, node, relaxed
from vibroimpact.engine.jit import Vector, entry, kernel
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.phase import (
    FLIGHT,
    LEFT,
    LIMIT,
    MIDDLE,
    NODE,
    NODES,
    PLAN,
    RATE,
    RIGHT,
    SIZE,
    TABLES,
    TAYLOR,
    VALID_FROM,
    WIDTH,
    H,
)
from vibroimpact.engine.section_map import FREQUENCY, MODE, SYSTEM, placed, system_plan
from vibroimpact.engine.trajectory import advance, too_much_work


@kernel
def turning_point(plan: Vector, high: float) -> float:
    """Where the series in the scratch turns, on [−1/2, high], at whose ends its slope differs."""
    low = -0.5
    _, first = horner(plan, low)
    for _ in range(60):
        middle = 0.5 * (low + high)
        _, slope = horner(plan, middle)
        if slope * first > 0.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@kernel
def phase_margin(
    plan: Vector,
    mode: int,
    x: float,
    v: float,
    s: float,
    c: float,
    right: float,
    left: float,
    length: float,
    best: float,
) -> float:
    """Take into account the turning points of one phase; a contact's is given mirrored.

    Where the mass turns back in flight before a bumper, its clearance there; where it turns back
    in contact, minus the bumper's deformation: the one with the least size.
    """
    gap_r, rate_r = plan[par.BUMPER + par.GAP], plan[par.BUMPER + par.RATE]
    gap_l, rate_l = plan[par.BUMPER + par.WIDTH + par.GAP], plan[par.BUMPER + par.WIDTH + par.RATE]
    table = TABLES + SIZE * mode
    t = 0.0
    while t < length:
        late = table + 3 * SIZE
        now = late if t >= plan[late + VALID_FROM] else table
        span = (length - t) * plan[now + RATE]
        h = plan[now + H]
        for i in range(NODES):
            if i >= span:
                break
            nx, nv, ns, nc = node(plan, now, i, x, v, s, c)
            mx, mv, ms, mc = moved(plan, now + MIDDLE, nx, nv, ns, nc)
            expand(plan, now + TAYLOR, mx, mv, ms, mc)
            high = min(0.5, span - i - 0.5)
            _, first = horner(plan, -0.5)
            _, last = horner(plan, high)
            if first * last >= 0.0:
                continue
            y = turning_point(plan, high)
            value, _ = horner(plan, y)
            at = t + (i + 0.5 + y) * h
            if mode != FLIGHT:
                margin = -value
            elif first > 0.0:
                margin = gap_r + relaxed(right, rate_r, at) - value
            else:
                margin = gap_l + relaxed(left, rate_l, at) + value
            if abs(margin) < abs(best):
                best = margin
        x, v, s, c = moved(plan, now + NODE + (NODES - 1) * WIDTH, x, v, s, c)
        t += NODES * h
    return best


@kernel
def _margin(
    plan: Vector,
    system: Vector,
    phase: float,
    cycles: int,
    max_events: int,
    point: Vector,
    facts: Vector,
) -> float:
    period = 1.0 / system[FREQUENCY]
    if too_much_work(plan, period):
        return math.nan
    mode, u, v, right, left = placed(
        plan, int(facts[MODE]), point[0], point[1], point[2], -point[3]
    )
    fresh = 1 if mode != FLIGHT else 0
    age = 0.0
    best = math.inf
    for _ in range(cycles):
        t = 0.0
        events = 0
        s, c = math.sin(phase), math.cos(phase)
        while True:
            was, u0, v0, s0, c0, right0, left0 = mode, u, v, s, c, right, left
            event, step, mode, fresh, u, v, s, c, right, left, age = advance(
                plan, mode, fresh, u, v, s, c, right, left, period - t, age
            )
            sign = -1.0 if was == LEFT else 1.0
            x0 = right0 if was == RIGHT else (left0 if was == LEFT else u0)
            best = phase_margin(
                plan, was, x0, sign * v0, sign * s0, sign * c0, right0, left0, step, best
            )
            if event == LIMIT:
                break
            t += step
            events += 1
            if events > max_events:
                return math.nan
            if t >= period:
                break
    return best


@entry("f8(f8[::1], f8, i8, i8, f8[::1], f8[::1])")
def grazing_margin(
    system: Vector, phase: float, cycles: int, max_events: int, point: Vector, facts: Vector
) -> float:
    """Signed distance of a motion from grazing (m).

    Parameters
    ----------
    system : ndarray, shape (section_map.SYSTEM,)
        The rig and its forcing.
    phase : float
        Of the section, rad.
    cycles : int
        Forcing cycles to look at.
    max_events : int
        Contacts and detachments in a cycle at which it gives up.
    point, facts : ndarray
        The state at the section and its mode, as in `orbit.correct`.

    Returns
    -------
    float
        Positive: the least clearance at which the mass turns back in flight. Negative: the least
        depth at which it turns back in a contact. The one of least size; NaN if given up.
    """
    memory = np.zeros(PLAN)
    plan = pointer(memory)
    used = np.empty(SYSTEM)
    system_plan(system, np.zeros(SYSTEM), 0.0, plan, used)
    found = _margin(plan, used, phase, cycles, max_events, point, facts)
    memory[0] = 0.0  # keeps the memory alive until here
    return found
