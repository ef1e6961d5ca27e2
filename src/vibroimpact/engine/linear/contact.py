"""Contact up to the detachment or a time limit, by the same walk as in `flight`."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.crossing import NONE, crossing_guess, first_root, quick_root
from vibroimpact.engine.linear.evaluate import expand, moved, node, row, travel
from vibroimpact.engine.linear.tables import (
    DETACHED,
    FORCE,
    FORCE_0,
    FORCE_V,
    FORCE_X,
    LATE,
    LIMIT,
    MIDDLE,
    NODE,
    NODES,
    RATE,
    REST,
    SCALED_A,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SIZE,
    TABLES,
    TAYLOR_F,
    VALID_FROM,
    WIDTH,
    H,
)
from vibroimpact.engine.memory import workspace


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
    series = workspace()
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
            if not clear >= 1.0:
                # Slow landing: search about the contact point itself, where the force is not
                # negative by construction and the series has no rounding noise.
                high = min(0.5, span)
                expand(plan, table + TAYLOR_F, x, v, s, c, series)
                series[0] = max(series[0], 0.0)
                y = first_root(series, 0.0, 1.0, 0.0, 0.0, False, 0.0, high)
                if y != NONE:
                    x, v, s, c = travel(plan, table, y, x, v, s, c)
                    return DETACHED, h * y, 0.0 if damping == 0.0 else x, v, s, c
                clear = max(clear, high)
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
                expand(plan, table + TAYLOR_F, mx, mv, ms, mc, series)
                low = max(-0.5, min(clear - i - 0.5, 0.5))
                y = first_root(series, 0.0, 1.0, 0.0, 0.0, False, low, min(0.5, span - i - 0.5))
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
