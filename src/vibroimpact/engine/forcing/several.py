"""Several harmonics of one frequency: A_t = Σ A_n sin(nθ + φ_n).

The clock is that of the fundamental, (sin θ, cos θ); those of the others are its powers. Each
harmonic has a *plane* of its own, tables laid out as those of the fundamental, of which only the
columns of the forcing are read: motions of linear modes add up.

In the mirror the clock is (−sin θ, −cos θ), and the power of an even harmonic has lost the sign:
its plane has it back.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing import harmonic
from vibroimpact.engine.forcing.wave import Wave
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import (
    AMPLITUDE,
    MOST,
    OMEGA,
    ORDER,
    RATE,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SCALED_W,
    STEEPEST,
    TABLES,
    WAVE_C,
    WAVE_S,
    H,
    Row,
)
from vibroimpact.engine.linear.roots import NONE, Clearance, first_root
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.yielding.layout import PLAN

turned_clock = harmonic.turned_clock
turn = harmonic.turn
nudged = harmonic.nudged
turned = harmonic.turned
stepped = harmonic.stepped

WEIGHTS = PLAN
"""Where the weights of sin nθ and cos nθ begin in a plan, two for each n from 1 on."""


def room(count: int) -> int:
    """Length of the plan of so many harmonics."""
    return PLAN + 2 * count + (count - 1) * (PLAN - TABLES)


@kernel
def plane(plan: Vector, n: int) -> int:
    """How far behind the fundamental's tables those of harmonic n lie."""
    if n == 1:
        return 0
    return PLAN + 2 * int(plan[par.HARMONICS]) + (n - 2) * (PLAN - TABLES) - TABLES


@kernel
def raised(s: float, c: float, sn: float, cn: float) -> tuple[float, float]:
    """The next power of the phasor."""
    return sn * c + cn * s, cn * c - sn * s


@kernel
def count(plan: Vector) -> int:
    """How many."""
    return int(plan[par.HARMONICS])


@kernel
def begin(plan: Vector, amplitude: float, omega: float) -> None:
    """Each harmonic counts by its amplitude."""
    plan[AMPLITUDE], plan[OMEGA] = amplitude * plan[par.SCALE], omega
    plan[MOST], plan[STEEPEST] = 0.0, 0.0
    for n in range(1, int(plan[par.HARMONICS]) + 1):
        size, rate, _, sine, cosine = wave(plan, n, False)
        size = abs(size) * math.hypot(sine, cosine)
        plan[MOST] += size
        plan[STEEPEST] += size * rate


@kernel
def pace(plan: Vector) -> float:
    """That of the highest."""
    rate: float = plan[par.HARMONICS] * plan[OMEGA]
    return rate


@kernel
def wave(plan: Vector, n: int, mirrored: bool) -> Wave:
    """Harmonic n."""
    rate = n * plan[OMEGA]
    size = plan[AMPLITUDE]
    if plan[par.POWER] == 2.0:
        size *= rate * rate
    sign = -1.0 if mirrored and n % 2 == 0 else 1.0
    at = WEIGHTS + 2 * (n - 1)
    return Wave(size, rate, 1.0, sign * plan[at], sign * plan[at + 1])


@kernel
def value(plan: Vector, s: float, c: float) -> float:
    """A_t."""
    total = 0.0
    sn, cn = s, c
    for n in range(1, int(plan[par.HARMONICS]) + 1):
        size, _, _, sine, cosine = wave(plan, n, False)
        total += size * (sine * sn + cosine * cn)
        sn, cn = raised(s, c, sn, cn)
    return total


@kernel
def release_time(
    plan: Vector, sign: float, level: float, s: float, c: float, limit: float
) -> tuple[float, float, float]:
    """When sign A_t first exceeds the level, within the limit: t, or infinity, and the clock.

    The clearance is searched as that of a stop, with the series of flight's tables.
    """
    if sign * value(plan, s, c) > level:
        return 0.0, s, c
    series = workspace()
    rate = plan[TABLES + RATE]
    h = plan[TABLES + H]
    t = 0.0
    while t < limit:
        ms, mc = turned(plan, s, c, t + 0.5 * h)
        pull_series(plan, TABLES, ms, mc, series)
        for i in range(ORDER):  # `first_root` bounds the series itself: a factor would be lost
            series[i] *= rate * rate
        high = min(0.5, (limit - t) * rate - 0.5)
        clearance = Clearance(level, -sign, 0.0, 0.0, False)
        y = first_root(series, clearance, -0.5, high)
        if y != NONE:
            t += (y + 0.5) * h
            s, c = turned(plan, s, c, t)
            return t, s, c
        t += h
    return math.inf, s, c


@kernel
def product(plan: Vector, at: int, row: Row) -> float:
    """One linear function of the state row."""
    total = harmonic.product(plan, at, row)
    _, _, s, c = row
    sn, cn = s, c
    for n in range(2, int(plan[par.HARMONICS]) + 1):
        sn, cn = raised(s, c, sn, cn)
        there = at + plane(plan, n)
        total += plan[there + 2] * sn + plan[there + 3] * cn
    return total


@kernel
def expand(plan: Vector, at: int, row: Row, series: Vector) -> None:
    """Write the long series about a state."""
    harmonic.expand(plan, at, row, series)
    _, _, s, c = row
    sn, cn = s, c
    for n in range(2, int(plan[par.HARMONICS]) + 1):
        sn, cn = raised(s, c, sn, cn)
        there = at + plane(plan, n)
        for i in range(ORDER):
            series[i] += plan[there + 2 * ORDER + i] * sn + plan[there + 3 * ORDER + i] * cn


@kernel
def short_series(
    plan: Vector, table: int, row: Row
) -> tuple[float, float, float, float, float, float, float]:
    """Taylor coefficients a₀…a₆ of x in steps, from the equation of motion (early tables)."""
    x, v, s, c = row
    sc = plan[table + SCALED_C]
    sk = plan[table + SCALED_K]
    f0, f1, f2, f3, f4 = 0.0, 0.0, 0.0, 0.0, 0.0
    sn, cn = s, c
    for n in range(1, int(plan[par.HARMONICS]) + 1):
        there = table + plane(plan, n)
        wh = plan[there + SCALED_W]
        now = plan[there + WAVE_S] * sn + plan[there + WAVE_C] * cn
        after = wh * (plan[there + WAVE_S] * cn - plan[there + WAVE_C] * sn)
        ww = wh * wh
        f0 += now
        f1 += after
        f2 -= ww * now
        f3 -= ww * after
        f4 += ww * ww * now
        sn, cn = raised(s, c, sn, cn)
    a1 = v * plan[table + H]
    a2 = (plan[table + SCALED_D] - f0 - sk * x - sc * a1) / 2
    a3 = (-f1 - sk * a1 - 2 * sc * a2) / 6
    a4 = (-f2 - 2 * sk * a2 - 6 * sc * a3) / 24
    a5 = (-f3 - 6 * sk * a3 - 24 * sc * a4) / 120
    a6 = (-f4 - 24 * sk * a4 - 120 * sc * a5) / 720
    return x, a1, a2, a3, a4, a5, a6


@kernel
def pull(plan: Vector, table: int, s: float, c: float) -> float:
    """A_t h² of a mode, mirrored as it is."""
    total = 0.0
    sn, cn = s, c
    for n in range(1, int(plan[par.HARMONICS]) + 1):
        there = table + plane(plan, n)
        total += plan[there + WAVE_S] * sn + plan[there + WAVE_C] * cn
        sn, cn = raised(s, c, sn, cn)
    return total


@kernel
def pull_series(plan: Vector, table: int, s: float, c: float, series: Vector) -> None:
    """Its long series."""
    for i in range(ORDER):
        series[i] = 0.0
    sn, cn = s, c
    for n in range(1, int(plan[par.HARMONICS]) + 1):
        there = table + plane(plan, n)
        wh = plan[there + SCALED_W]
        now = plan[there + WAVE_S] * sn + plan[there + WAVE_C] * cn
        after = wh * (plan[there + WAVE_S] * cn - plan[there + WAVE_C] * sn)
        for i in range(ORDER):
            series[i] += now
            now, after = after, -wh * wh * now / ((i + 1) * (i + 2))
        sn, cn = raised(s, c, sn, cn)
