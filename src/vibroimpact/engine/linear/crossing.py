"""The usual crossing: clean, with nothing else near, found from a guess in one or two steps."""

from __future__ import annotations

from vibroimpact.engine.forcing.dispatch import nudged, short_series, turn
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import moved
from vibroimpact.engine.linear.layout import FINE, FINE_NODE, RADIUS, RATE, SCALED_W, WIDTH, Row
from vibroimpact.engine.linear.roots import NONE


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
    row: Row,
) -> tuple[float, float, Row]:
    """A time at which weight_x·x + weight_v·x′ rises through `level`, if it is soon found.

    Parameters
    ----------
    weight_x, weight_v : float
        The latter per step.
    y : float
        A guess, in steps after the node whose state is given; at the node the function is known
        to be below the level.

    Returns
    -------
    y, slope, row
        The root, the function's slope per step and the state there; y = NONE where none is
        found. It is for the caller to prove that no other comes before: with a slope m and a
        second derivative of at most b the function has been below the level for 2 m / b.
    """
    for _ in range(4):
        k = min(max(int(y * FINE + 0.5), 0), FINE - 1)
        point = moved(plan, table + FINE_NODE + k * WIDTH, row)
        a0, a1, a2, a3, a4, a5, a6 = short_series(plan, table, point)
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
        if not (f1 > 0.0 and abs(d) <= RADIUS):
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
        # The change of the velocity alone, for step times rate need not be 1 to the last digit.
        change = (d * (2 * a2) + dd * (3 * a3 + d * (4 * a4))) + dddd * (5 * a5 + d * (6 * a6))
        fs, fc = turn(plan, point.s, point.c, plan[table + SCALED_W] * d)
        # What is left is below 1e-8 steps. Not to wait for another division: 1 / slope to
        # second order, where that is as good.
        q = d * (2.0 * b + 3.0 * d * (f3 * inverse))
        e = (level - f) * inverse * (1.0 - q * (1.0 - q)) if abs(q) < 0.01 else (level - f) / slope
        y = k * (1.0 / FINE) + d + e
        if not abs(e) < 1e-8 or y < 0.0 or y > 1.0:
            break
        fx += e * (a1 + change)
        change += e * (2 * a2 + d * (6 * a3 + d * 12 * a4))
        fs, fc = nudged(plan, fs, fc, e * plan[table + SCALED_W])
        return y, slope, Row(fx, point.v + change * plan[table + RATE], fs, fc)
    return NONE, 0.0, row
