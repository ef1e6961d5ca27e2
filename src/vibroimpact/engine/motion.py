"""Motion within one phase up to its first event or a time limit.

`flight` ends at the first contact, `contact` at the detachment. Both walk over windows of
NODES table intervals. An interval on which the node values and a bound on the second
derivative leave no room for a root costs a few products; a clean crossing is solved by
`quick_root`; any other interval is searched by `crossing.first_root`.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.crossing import NONE, first_root
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.phase import (
    BAND_0,
    BAND_V,
    BAND_X,
    COSINE,
    FINE,
    FINE_NODE,
    FORCE,
    FORCE_0,
    FORCE_V,
    FORCE_X,
    FORGOTTEN,
    LATE,
    MIDDLE,
    NODE,
    NODES,
    ORDER,
    RATE,
    REST,
    ROW_V,
    SCALED_A,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SCALED_W,
    SCRATCH,
    SINE,
    SIZE,
    TABLES,
    TAYLOR,
    TAYLOR_F,
    VALID_FROM,
    WIDTH,
    H,
)

LIMIT, RIGHT, LEFT, DETACHED = 0, 1, 2, 3
"""What ended the phase: the time limit, a contact on a side, or the detachment."""

_WEAK_PULL = 0.45  # theory, section 3.3
_RADIUS = 1.0 / 40.0


@kernel
def relaxed(deformation: float, rate: float, t: float) -> float:
    """A free bumper's deformation after the time t."""
    if deformation > 0.0:
        x = rate * t
        return deformation * math.exp(-x) if x < FORGOTTEN else 0.0
    return 0.0


@kernel
def turn(s: float, c: float, angle: float) -> tuple[float, float]:
    """The phasor (sin θ, cos θ) turned by a small angle (at most half a step)."""
    q = angle * angle
    sine = angle * (
        1 - q * (1 / 6 - q * (1 / 120 - q * (1 / 5040 - q * (1 / 362880 - q / 39916800))))
    )
    cosine = 1 - q * (
        1 / 2 - q * (1 / 24 - q * (1 / 720 - q * (1 / 40320 - q * (1 / 3628800 - q / 479001600))))
    )
    return s * cosine + c * sine, c * cosine - s * sine


@kernel
def row(plan: Vector, at: int, x: float, v: float, s: float, c: float) -> float:
    """One linear function of the state row."""
    pairs: float = (plan[at] * x + plan[at + 1] * v) + (plan[at + 2] * s + plan[at + 3] * c)
    total: float = pairs + plan[at + 4]
    return total


@kernel
def moved(
    plan: Vector, at: int, x: float, v: float, s: float, c: float
) -> tuple[float, float, float, float]:
    """The state at a node or fine point from the state at its origin."""
    cosine = plan[at + COSINE]
    sine = plan[at + SINE]
    return (
        row(plan, at, x, v, s, c),
        row(plan, at + ROW_V, x, v, s, c),
        s * cosine + c * sine,
        c * cosine - s * sine,
    )


@kernel
def node(
    plan: Vector, table: int, i: int, x: float, v: float, s: float, c: float
) -> tuple[float, float, float, float]:
    """The state at node i of the window."""
    if i == 0:
        return x, v, s, c
    return moved(plan, table + NODE + (i - 1) * WIDTH, x, v, s, c)


@kernel
def expand(plan: Vector, at: int, x: float, v: float, s: float, c: float) -> None:
    """Write the long series about a state to the scratch.

    `at` is where TAYLOR (for x) or TAYLOR_F (for the contact force) of a table begins.
    """
    for n in range(ORDER):
        plan[SCRATCH + n] = (
            (plan[at + n] * x + plan[at + ORDER + n] * v)
            + (plan[at + 2 * ORDER + n] * s + plan[at + 3 * ORDER + n] * c)
        ) + plan[at + 4 * ORDER + n]


@kernel
def horner(plan: Vector, y: float) -> tuple[float, float]:
    """Value and slope of the long series in the scratch at y."""
    p = plan[SCRATCH + ORDER - 1]
    p1 = 0.0
    for n in range(ORDER - 2, -1, -1):
        p1 = p1 * y + p
        p = p * y + plan[SCRATCH + n]
    return p, p1


@kernel
def short_series(
    plan: Vector, table: int, x: float, v: float, s: float, c: float
) -> tuple[float, float, float, float, float, float, float]:
    """Taylor coefficients a₀…a₆ of x in steps, from the equation of motion (early tables).

    Written so that each coefficient waits for one product only.
    """
    sc = plan[table + SCALED_C]
    sk = plan[table + SCALED_K]
    wh = plan[table + SCALED_W]
    ww = wh * wh
    force = plan[table + SCALED_A] * s
    force1 = plan[table + SCALED_A] * wh * c
    a1 = v * plan[table + H]
    a2 = ((plan[table + SCALED_D] - force) * (1 / 2) - (sk * (1 / 2)) * x) - (sc * (1 / 2)) * a1
    a3 = (-force1 * (1 / 6) - (sk * (1 / 6)) * a1) - (sc * (1 / 3)) * a2
    a4 = (force * (ww * (1 / 24)) - (sk * (1 / 12)) * a2) - (sc * (1 / 4)) * a3
    a5 = (force1 * (ww * (1 / 120)) - (sk * (1 / 20)) * a3) - (sc * (1 / 5)) * a4
    a6 = (-force * (ww * ww * (1 / 720)) - (sk * (1 / 30)) * a4) - (sc * (1 / 6)) * a5
    return x, a1, a2, a3, a4, a5, a6


@kernel
def absolute_acceleration(plan: Vector, mode: int, x: float, v: float) -> float:
    """ü + A_t from the state (mirrored for a left contact, as in `contact`)."""
    table = TABLES + SIZE * mode
    rate = plan[table + RATE]
    scaled: float = (plan[table + SCALED_D] - plan[table + SCALED_K] * x) - plan[
        table + SCALED_C
    ] * (v * plan[table + H])
    acceleration: float = scaled * (rate * rate)
    return acceleration


@kernel
def travel(
    plan: Vector, table: int, y: float, x: float, v: float, s: float, c: float
) -> tuple[float, float, float, float]:
    """The state y steps after a node, 0 ≤ y ≤ 1."""
    if plan[table + LATE] == 0.0:
        k = min(int(y * FINE + 0.5), FINE - 1)
        x, v, s, c = moved(plan, table + FINE_NODE + k * WIDTH, x, v, s, c)
        d = y - k * (1.0 / FINE)
        # The last fine point serves up to the end of the interval: d is 1/FINE at most.
        if d > _RADIUS:
            x, v, s, c = moved(plan, table + FINE_NODE + WIDTH, x, v, s, c)
            d -= 1.0 / FINE
        a0, a1, a2, a3, a4, a5, a6 = short_series(plan, table, x, v, s, c)
        x = a0 + d * (a1 + d * (a2 + d * (a3 + d * (a4 + d * (a5 + d * a6)))))
        v = a1 + d * (2 * a2 + d * (3 * a3 + d * (4 * a4 + d * (5 * a5 + d * (6 * a6)))))
        s, c = turn(s, c, plan[table + SCALED_W] * d)
    else:
        x, v, s, c = moved(plan, table + FINE_NODE + FINE // 2 * WIDTH, x, v, s, c)
        expand(plan, table + TAYLOR, x, v, s, c)
        x, v = horner(plan, y - 0.5)
        s, c = turn(s, c, plan[table + SCALED_W] * (y - 0.5))
    return x, v * plan[table + RATE], s, c


@kernel
def crossing_guess(earlier: float, before: float, now: float, level: float, j: int) -> float:
    """Where between nodes j − 1 and j the parabola through the last three meets the level."""
    rise = now - before
    y = (level - before) / rise
    if j > 1:
        y += 0.5 * (rise - (before - earlier)) * y * (1.0 - y) / rise
    return y


@kernel
def quick_root(
    plan: Vector,
    table: int,
    weight_x: float,
    weight_v: float,
    level: float,
    y: float,
    second: float,
    x: float,
    v: float,
    s: float,
    c: float,
) -> tuple[float, float, float, float, float]:
    """The first time at which weight_x·x + weight_v·x′ rises through `level`, if beyond doubt.

    Parameters
    ----------
    weight_x, weight_v : float
        The latter per step.
    y : float
        A guess, in steps after the node whose state (x, v, s, c) is given; at the node the
        function is known to be below the level.
    second : float
        Bound on the second derivative, per step squared.

    Returns
    -------
    y, x, v, s, c
        The root and the state there; y = NONE where the root that is found is not certainly
        the first one. At a root with slope m the function stays below the level for
        2 m / second before it.
    """
    for _ in range(4):
        k = min(max(int(y * FINE + 0.5), 0), FINE - 1)
        fx, fv, fs, fc = moved(plan, table + FINE_NODE + k * WIDTH, x, v, s, c)
        a0, a1, a2, a3, a4, a5, a6 = short_series(plan, table, fx, fv, fs, fc)
        f0 = weight_x * a0 + weight_v * a1
        f1 = weight_x * a1 + weight_v * 2 * a2
        f2 = weight_x * a2 + weight_v * 3 * a3
        f3 = weight_x * a3 + weight_v * 4 * a4
        f4 = weight_x * a4 + weight_v * 5 * a5
        f5 = weight_x * a5 + weight_v * 6 * a6
        f6 = weight_x * a6
        inverse = 1.0 / f1
        e = (level - f0) * inverse
        b = f2 * inverse
        d = e * (1.0 - e * (b - e * (2.0 * b * b - f3 * inverse)))
        if not (f1 > 0.0 and abs(d) <= _RADIUS):
            # The guess was too far: go to the fine point nearest to the better one.
            new = min(max(k / FINE + d, 0.0), 1.0)
            if not (f1 > 0.0 and abs(d) < 1.0) or new == y:
                break
            y = new
            continue
        # Polynomials in pairs of terms: they wait for one another less than nested ones.
        dd = d * d
        dddd = dd * dd
        f = ((f0 + d * f1) + dd * (f2 + d * f3)) + dddd * ((f4 + d * f5) + dd * f6)
        slope = ((f1 + d * (2 * f2)) + dd * (3 * f3 + d * (4 * f4))) + dddd * (
            5 * f5 + d * (6 * f6)
        )
        fx = ((a0 + d * a1) + dd * (a2 + d * a3)) + dddd * ((a4 + d * a5) + dd * a6)
        fv = ((a1 + d * (2 * a2)) + dd * (3 * a3 + d * (4 * a4))) + dddd * (5 * a5 + d * (6 * a6))
        fs, fc = turn(fs, fc, plan[table + SCALED_W] * d)
        # What is left is below 1e-8 steps. Not to wait for another division: 1 / slope to
        # second order, where that is as good.
        q = d * (2.0 * b + 3.0 * d * (f3 * inverse))
        e = (level - f) * inverse * (1.0 - q * (1.0 - q)) if abs(q) < 0.01 else (level - f) / slope
        y = k * (1.0 / FINE) + d + e
        if not abs(e) < 1e-8 or y < 0.0 or y > 1.0 or not 2.0 * slope > second * y:
            break
        fx += e * fv
        fv += e * (2 * a2 + d * (6 * a3 + d * 12 * a4))
        e *= plan[table + SCALED_W]
        fs, fc = fs + e * fc, fc - e * fs
        return y, fx, fv * plan[table + RATE], fs, fc
    return NONE, x, v, s, c


@kernel
def search_flight(
    plan: Vector,
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
    """First contact on an interval whose series is in the scratch: (y, side), or (NONE, LIMIT).

    The deformations are those at `low` of their side; rates are per step.
    """
    y_r = NONE
    y_l = NONE
    if low_r < high and gap_r < math.inf:
        y_r = first_root(plan, gap_r, -1.0, right, rate_r, False, low_r, high)
    if low_l < high and gap_l < math.inf:
        y_l = first_root(plan, gap_l, 1.0, left, rate_l, False, low_l, high)
    if y_r == NONE and y_l == NONE:
        return NONE, LIMIT
    if y_r <= y_l:
        return y_r, RIGHT
    return y_l, LEFT


@kernel
def leave(plan: Vector, side: int, memory: float, rate: float, high: float) -> float:
    """Re-contact within [0, high] of a detachment at y = 0, or NONE.

    The series in the scratch is that of the displacement from the detachment, where the
    clearance vanishes by construction, and where its slope does too if the bumper has a dashpot.
    """
    plan[SCRATCH] = 0.0
    sign = -1.0 if side == RIGHT else 1.0
    if memory > 0.0:
        plan[SCRATCH + 1] = 0.0
    return first_root(plan, 0.0, sign, memory, rate, memory > 0.0, 0.0, high)


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
    t = 0.0
    clear_r = 0.0  # proven free of contact for so many steps from the window's start
    clear_l = 0.0
    while True:
        table = TABLES + 3 * SIZE if age + t >= plan[TABLES + 3 * SIZE + VALID_FROM] else TABLES
        h = plan[table + H]
        band = plan[table + BAND_X] * abs(u) + plan[table + BAND_V] * abs(v) + plan[table + BAND_0]
        second = 8.0 * band  # per step squared
        span = (limit - t) * plan[table + RATE]
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
                clear = 2.0 * abs(v) * h / second
            if clear < 1.0:
                high = min(0.5, span)
                expand(plan, table + TAYLOR, u, v, s, c)
                # The other bumper may be as near: where both gaps are zero it is.
                if launched == RIGHT:
                    y, side = search_flight(
                        plan, math.inf, gap_l, 0.0, left, rate_r * h, rate_l * h, 0.0, 0.0, high
                    )
                else:
                    y, side = search_flight(
                        plan, gap_r, math.inf, right, 0.0, rate_r * h, rate_l * h, 0.0, 0.0, high
                    )
                again = leave(plan, launched, memory, rate, high)
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
        top = gap_r - band
        bottom = band - gap_l
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
                expand(plan, table + TAYLOR, mu, mv, ms, mc)
                low_r = max(0.0, clear_r - i)
                low_l = max(0.0, clear_l - i)
                # A side is left out where both ends of the interval clear it.
                near = before if i == j - 1 else row(plan, table + NODE + i * WIDTH, u, v, s, c)
                y, side = search_flight(
                    plan,
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
        clear_r -= NODES
        clear_l -= NODES
        t += NODES * h


@kernel
def contact(
    plan: Vector,
    side: int,
    x: float,
    v: float,
    s: float,
    c: float,
    fresh: bool,
    limit: float,
    age: float,
) -> tuple[int, float, float, float, float, float]:
    """Stay in contact until the force stops pressing, or until the limit.

    Parameters
    ----------
    side : int
        RIGHT or LEFT.
    x, v, s, c : float
        Deformation of the bumper (m), its rate (m/s), sin θ and cos θ, all measured towards
        the bumper: a left contact is given as its mirror image.
    fresh : bool
        The contact begins here, so that its force is not negative by construction.
    plan, limit, age
        As in `flight`.

    Returns
    -------
    event, t, x, v, s, c
        DETACHED or LIMIT, the elapsed time (s), and the state there, mirrored as given.
    """
    at = par.BUMPER + par.WIDTH * (side - 1)
    stiffness = plan[at + par.BUMPER_STIFFNESS]
    damping = plan[at + par.BUMPER_DAMPING]
    early = TABLES + SIZE * side
    late = early + 3 * SIZE
    t = 0.0
    while True:
        table = late if age + t >= plan[late + VALID_FROM] else early
        h = plan[table + H]
        band = (
            plan[table + FORCE_X] * abs(x - plan[table + REST])
            + plan[table + FORCE_V] * abs(v)
            + plan[table + FORCE_0]
        )
        second = 8.0 * band
        span = (limit - t) * plan[table + RATE]
        clear = 0.0
        f = stiffness * x + damping * v
        if fresh and plan[table + LATE] == 0.0:
            # F(t) ≥ F + F′ t − second t²/2 keeps the first steps positive.
            pull = (
                (plan[table + SCALED_D] - plan[table + SCALED_A] * s)
                - plan[table + SCALED_K] * x
                - plan[table + SCALED_C] * (v * h)
            )
            slope = stiffness * (v * h) + damping * plan[table + RATE] * pull
            clear = 2.0 * slope / second
        fresh = False
        before = f
        earlier = f
        j = 0
        done = -1
        while True:
            while True:
                if f < band and j + 1.0 > clear:
                    break
                if j >= span or j == NODES:
                    j = -1
                    break
                earlier = before
                before = f
                f = row(plan, table + FORCE + j * 5, x, v, s, c)
                j += 1
            if j < 0:
                break
            i = j - 1 if j - 1 > done else j
            if i >= span or i == NODES:
                break
            nx, nv, ns, nc = node(plan, table, i, x, v, s, c)
            y = NONE
            if i == j - 1 and f < 0.0 and plan[table + LATE] == 0.0 and before > 0.0:
                guess = crossing_guess(earlier, before, f, 0.0, j)
                y, ex, ev, es, ec = quick_root(
                    plan,
                    table,
                    -stiffness,
                    -damping * plan[table + RATE],
                    0.0,
                    guess,
                    second,
                    nx,
                    nv,
                    ns,
                    nc,
                )
                if y != NONE and i + y > span:
                    break
            if y == NONE:
                mx, mv, ms, mc = moved(plan, table + MIDDLE, nx, nv, ns, nc)
                expand(plan, table + TAYLOR_F, mx, mv, ms, mc)
                low = max(-0.5, min(clear - i - 0.5, 0.5))
                y = first_root(plan, 0.0, 1.0, 0.0, 0.0, False, low, min(0.5, span - i - 0.5))
                if y != NONE:
                    y += 0.5
                    ex, ev, es, ec = travel(plan, table, y, nx, nv, ns, nc)
            if y != NONE:
                if damping == 0.0:
                    ex = 0.0
                return DETACHED, t + (i + y) * h, ex, ev, es, ec
            done = i
            if i == j:
                if j == NODES:
                    break
                earlier = before
                before = f
                f = row(plan, table + FORCE + j * 5, x, v, s, c)
                j += 1
        if span <= NODES:
            i = min(int(span), NODES - 1)
            nx, nv, ns, nc = node(plan, table, i, x, v, s, c)
            x, v, s, c = travel(plan, table, span - i, nx, nv, ns, nc)
            return LIMIT, limit, x, v, s, c
        x, v, s, c = moved(plan, table + NODE + (NODES - 1) * WIDTH, x, v, s, c)
        t += NODES * h
