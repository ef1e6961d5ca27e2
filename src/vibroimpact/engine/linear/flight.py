"""Flight up to the first contact or a time limit.

The walk goes over windows of NODES table intervals. An interval on which the node values and a
bound on the second derivative leave no room for a root costs a few products; a clean crossing is
solved by `crossing.quick_root`; any other interval is searched by `crossing.first_root`.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.crossing import NONE, crossing_guess, first_root, quick_root
from vibroimpact.engine.linear.evaluate import expand, moved, node, relaxed, row, travel
from vibroimpact.engine.linear.tables import (
    BAND_0,
    BAND_V,
    BAND_X,
    LATE,
    LEFT,
    LIMIT,
    MIDDLE,
    NODE,
    NODES,
    RATE,
    RIGHT,
    SIZE,
    TABLES,
    TAYLOR,
    VALID_FROM,
    WIDTH,
    H,
)
from vibroimpact.engine.memory import workspace

_WEAK_PULL = 0.45  # theory, section 3.3


@kernel
def search_flight(
    series: Vector,
    gap_r: float,
    gap_l: float,
    right: float,
    left: float,
    rate_r: float,
    rate_l: float,
    low_r: float,
    low_l: float,
    high: float,
) -> tuple[float, int]:
    """First contact on an interval with this series: (y, side), or (NONE, LIMIT).

    The deformations are those at `low` of their side; rates are per step.
    """
    y_r = NONE
    y_l = NONE
    if low_r < high and gap_r < math.inf:
        y_r = first_root(series, gap_r, -1.0, right, rate_r, False, low_r, high)
    if low_l < high and gap_l < math.inf:
        y_l = first_root(series, gap_l, 1.0, left, rate_l, False, low_l, high)
    if y_r == NONE and y_l == NONE:
        return NONE, LIMIT
    if y_r <= y_l:
        return y_r, RIGHT
    return y_l, LEFT


@kernel
def leave(series: Vector, side: int, memory: float, rate: float, high: float) -> float:
    """Re-contact within [0, high] of a detachment at y = 0, or NONE.

    The series is that of the displacement from the detachment, where the
    clearance vanishes by construction, and where its slope does too if the bumper has a dashpot.
    """
    series[0] = 0.0
    sign = -1.0 if side == RIGHT else 1.0
    if memory > 0.0:
        series[1] = 0.0
    return first_root(series, 0.0, sign, memory, rate, memory > 0.0, 0.0, high)


@kernel
def flight(
    plan: Vector,
    u: float,
    v: float,
    s: float,
    c: float,
    right: float,
    left: float,
    launched: int,
    limit: float,
    age: float,
) -> tuple[int, float, float, float, float, float, float, float]:
    """Fly until the first contact or the limit.

    Parameters
    ----------
    plan : ndarray
        From `phase.build`.
    u, v, s, c : float
        Displacement (m), velocity (m/s), sin θ and cos θ at the start.
    right, left : float
        Deformation of each free bumper, away from the mass (m, ≥ 0).
    launched : int
        RIGHT or LEFT if the mass has just left that bumper, else 0.
    limit : float
        How long to go at most (s).
    age : float
        How long this flight has lasted already (s).

    Returns
    -------
    event, t, u, v, s, c, right, left
        LIMIT, RIGHT or LEFT, the elapsed time (s), and the state there.
    """
    gap_r, rate_r = plan[par.BUMPER + par.GAP], plan[par.BUMPER + par.RATE]
    bumper_l = par.BUMPER + par.WIDTH
    gap_l, rate_l = plan[bumper_l + par.GAP], plan[bumper_l + par.RATE]
    series = workspace()
    t = 0.0
    clear_r = 0.0  # proven free of contact for so many steps from the window's start
    clear_l = 0.0
    while True:
        table = TABLES + 3 * SIZE if age + t >= plan[TABLES + 3 * SIZE + VALID_FROM] else TABLES
        h = plan[table + H]
        band = plan[table + BAND_X] * abs(u) + plan[table + BAND_V] * abs(v) + plan[table + BAND_0]
        second = 8.0 * band  # per step squared
        span = (limit - t) * plan[table + RATE]
        top = gap_r - band
        bottom = band - gap_l
        if not launched and t == 0.0 and (u > top or u < bottom):
            # The mass may touch a bumper: about the start itself the series is exact there,
            # and the signs of its coefficients tell a contact from a parting.
            high = min(0.5, span)
            expand(plan, table + TAYLOR, u, v, s, c, series)
            y, side = search_flight(
                series, gap_r, gap_l, right, left, rate_r * h, rate_l * h, 0.0, 0.0, high
            )
            if y != NONE:
                u, v, s, c = travel(plan, table, y, u, v, s, c)
                t = h * y
                right, left = relaxed(right, rate_r, t), relaxed(left, rate_l, t)
                u = gap_r + right if side == RIGHT else -(gap_l + left)
                return side, t, u, v, s, c, right, left
            clear_r = clear_l = high
        if launched:
            # A lower bound of the clearance just after detachment (theory, section 3.3).
            memory = right if launched == RIGHT else left
            rate = (rate_r if launched == RIGHT else rate_l) * h
            clear = 0.0
            if memory > 0.0:
                q = second / (rate * rate * memory)
                if q <= _WEAK_PULL:
                    clear = 2.0 * rate * memory * (1.0 - q) / second
            else:
                clear = 2.0 * max(-v if launched == RIGHT else v, 0.0) * h / second
            if clear < 1.0:
                high = min(0.5, span)
                expand(plan, table + TAYLOR, u, v, s, c, series)
                # The other bumper may be as near: where both gaps are zero it is.
                if launched == RIGHT:
                    y, side = search_flight(
                        series, math.inf, gap_l, 0.0, left, rate_r * h, rate_l * h, 0.0, 0.0, high
                    )
                else:
                    y, side = search_flight(
                        series, gap_r, math.inf, right, 0.0, rate_r * h, rate_l * h, 0.0, 0.0, high
                    )
                again = leave(series, launched, memory, rate, high)
                if again < y:
                    y, side = again, launched
                if y != NONE:
                    u, v, s, c = travel(plan, table, y, u, v, s, c)
                    t = h * y
                    right, left = relaxed(right, rate_r, t), relaxed(left, rate_l, t)
                    u = gap_r + right if side == RIGHT else -(gap_l + left)
                    return side, t, u, v, s, c, right, left
                clear_r = clear_l = high
                clear = max(clear, high)
            # The bound on u″ holds for this window only.
            if launched == RIGHT:
                clear_r = min(clear, NODES)
            else:
                clear_l = min(clear, NODES)
            launched = 0
        x = u
        before = u
        earlier = u  # at the node before that, for the guess
        j = 0
        done = -1
        while True:
            # Find the next node next to which a contact cannot be excluded.
            while True:
                if (x > top and j + 1.0 > clear_r) or (x < bottom and j + 1.0 > clear_l):
                    break
                if j >= span or j == NODES:
                    j = -1
                    break
                earlier = before
                before = x
                x = row(plan, table + NODE + j * WIDTH, u, v, s, c)
                j += 1
            if j < 0:
                break
            i = j - 1 if j - 1 > done else j
            if i >= span or i == NODES:
                break
            nu, nv, ns, nc = node(plan, table, i, u, v, s, c)
            memory_r = relaxed(right, rate_r, i * h)
            memory_l = relaxed(left, rate_l, i * h)
            y = NONE
            side = LIMIT
            if i == j - 1 and plan[table + LATE] == 0.0 and i >= clear_r and i >= clear_l:
                # The usual case: a clean crossing, no memory left on that side.
                if x > gap_r and memory_r == 0.0:
                    side = RIGHT
                    guess = crossing_guess(earlier, before, x, gap_r, j)
                    y, eu, ev, es, ec = quick_root(
                        plan, table, 1.0, 0.0, gap_r, guess, second, nu, nv, ns, nc
                    )
                elif -x > gap_l and memory_l == 0.0:
                    side = LEFT
                    guess = crossing_guess(earlier, before, x, -gap_l, j)
                    y, eu, ev, es, ec = quick_root(
                        plan, table, -1.0, 0.0, gap_l, guess, second, nu, nv, ns, nc
                    )
                if y != NONE and i + y > span:
                    break
            if y == NONE:
                mu, mv, ms, mc = moved(plan, table + MIDDLE, nu, nv, ns, nc)
                expand(plan, table + TAYLOR, mu, mv, ms, mc, series)
                low_r = max(0.0, clear_r - i)
                low_l = max(0.0, clear_l - i)
                # A side is left out where both ends of the interval clear it.
                near = before if i == j - 1 else row(plan, table + NODE + i * WIDTH, u, v, s, c)
                y, side = search_flight(
                    series,
                    gap_r if max(x, near) > top else math.inf,
                    gap_l if min(x, near) < bottom else math.inf,
                    relaxed(memory_r, rate_r, low_r * h),
                    relaxed(memory_l, rate_l, low_l * h),
                    rate_r * h,
                    rate_l * h,
                    low_r - 0.5,
                    low_l - 0.5,
                    min(0.5, span - i - 0.5),
                )
                if y != NONE:
                    y += 0.5
                    eu, ev, es, ec = travel(plan, table, y, nu, nv, ns, nc)
            if y != NONE:
                right, left = relaxed(memory_r, rate_r, y * h), relaxed(memory_l, rate_l, y * h)
                eu = gap_r + right if side == RIGHT else -(gap_l + left)
                return side, t + (i + y) * h, eu, ev, es, ec, right, left
            done = i
            if i == j:
                if j == NODES:
                    break
                earlier = before
                before = x
                x = row(plan, table + NODE + j * WIDTH, u, v, s, c)
                j += 1
        if span <= NODES:
            i = min(int(span), NODES - 1)
            nu, nv, ns, nc = node(plan, table, i, u, v, s, c)
            u, v, s, c = travel(plan, table, span - i, nu, nv, ns, nc)
            left_over = limit - t
            return (
                LIMIT,
                limit,
                u,
                v,
                s,
                c,
                relaxed(right, rate_r, left_over),
                relaxed(left, rate_l, left_over),
            )
        u, v, s, c = moved(plan, table + NODE + (NODES - 1) * WIDTH, u, v, s, c)
        right, left = relaxed(right, rate_r, NODES * h), relaxed(left, rate_l, NODES * h)
        clear_r = clear_l = 0.0
        t += NODES * h
