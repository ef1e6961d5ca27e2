"""One sine: A_t = A sin θ, θ′ = ω; the clock is (sin θ, cos θ)."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.wave import Wave
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import (
    AMPLITUDE,
    COSINE,
    MOST,
    OMEGA,
    ORDER,
    SCALED_A,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SCALED_W,
    SINE,
    STEEPEST,
    H,
    Row,
)

_FAR = 1.45
"""Angle (rad) up to which the polynomials of `stepped` are right to rounding."""


@kernel
def begin(plan: Vector, amplitude: float, omega: float) -> None:
    """A = amplitude · SCALE · ω^POWER; the amplitude may be of a displacement or of a force."""
    base = amplitude * plan[par.SCALE]
    if plan[par.POWER] == 2.0:
        base *= omega * omega
    plan[AMPLITUDE], plan[OMEGA] = base, omega
    plan[MOST], plan[STEEPEST] = abs(base), abs(base) * omega


@kernel
def pace(plan: Vector) -> float:
    """ω."""
    omega: float = plan[OMEGA]
    return omega


@kernel
def count(plan: Vector) -> int:
    """One."""
    return 1


@kernel
def wave(plan: Vector, n: int, mirrored: bool) -> Wave:
    """The sine; its mirror image is its own, half a turn later."""
    return Wave(plan[AMPLITUDE], plan[OMEGA], 1.0, 1.0, 0.0)


@kernel
def plane(plan: Vector, n: int) -> int:
    """There is but one."""
    return 0


@kernel
def value(plan: Vector, s: float, c: float) -> float:
    """A sin θ."""
    base: float = plan[AMPLITUDE] * s
    return base


@kernel
def turned(plan: Vector, s: float, c: float, t: float) -> tuple[float, float]:
    """The phasor after any time."""
    sine, cosine = math.sin(plan[OMEGA] * t), math.cos(plan[OMEGA] * t)
    return s * cosine + c * sine, c * cosine - s * sine


@kernel
def stepped(plan: Vector, s: float, c: float, t: float) -> tuple[float, float]:
    """The phasor after a time of a step, which seldom turns it farther than 1.45 rad."""
    angle = plan[OMEGA] * t
    if not abs(angle) < _FAR:
        return turned(plan, s, c, t)
    q = angle * angle
    r = q * q
    sine = angle * (
        (1.0 + r * (1 / 120 + r * (1 / 362880 + r * (1 / 6227020800 + r * 2.811457254345521e-15))))
        - q
        * (
            1 / 6
            + r
            * (
                1 / 5040
                + r * (1 / 39916800 + r * (7.647163731819816e-13 + r * 8.22063524662433e-18))
            )
        )
    )
    less = r * (
        1 / 24
        + r
        * (
            1 / 40320
            + r * (1 / 479001600 + r * (4.779477332387385e-14 + r * 4.110317623312165e-19))
        )
    ) - q * (
        0.5
        + r
        * (1 / 720 + r * (1 / 3628800 + r * (1.1470745597729725e-11 + r * 1.5619206968586225e-16)))
    )
    return s + (s * less + c * sine), c + (c * less - s * sine)


@kernel
def release_time(
    plan: Vector, sign: float, level: float, s: float, c: float, limit: float
) -> tuple[float, float, float]:
    """When sign A_t first exceeds the level, within the limit: t, or infinity, and the clock."""
    amplitude = abs(plan[AMPLITUDE])
    way = -sign if plan[AMPLITUDE] < 0.0 else sign
    rising, falling = way * s, way * c
    if level - amplitude * rising < 0.0 or (level == amplitude * rising and falling >= 0.0):
        return 0.0, s, c
    if not level < amplitude:
        return math.inf, s, c
    angle = math.asin(max(level / amplitude, -1.0)) - math.atan2(rising, falling)
    if angle < 0.0:  # by rounding only, on the point of letting go, or else a turn ahead
        angle = 0.0 if angle > -1e-9 and falling > 0.0 else angle + 2.0 * math.pi
    if not angle / plan[OMEGA] < limit:
        return math.inf, s, c
    rising = level / amplitude
    falling = math.sqrt(max(1.0 - rising * rising, 0.0))
    return angle / plan[OMEGA], way * rising, way * falling


@kernel
def product(plan: Vector, at: int, row: Row) -> float:
    """One linear function of the state row."""
    x, v, s, c = row
    pairs: float = (plan[at] * x + plan[at + 1] * v) + (plan[at + 2] * s + plan[at + 3] * c)
    total: float = pairs + plan[at + 4]
    return total


@kernel
def expand(plan: Vector, at: int, row: Row, series: Vector) -> None:
    """Write the long series about a state."""
    x, v, s, c = row
    for n in range(ORDER):
        series[n] = (
            (plan[at + n] * x + plan[at + ORDER + n] * v)
            + (plan[at + 2 * ORDER + n] * s + plan[at + 3 * ORDER + n] * c)
        ) + plan[at + 4 * ORDER + n]


@kernel
def short_series(
    plan: Vector, table: int, row: Row
) -> tuple[float, float, float, float, float, float, float]:
    """Taylor coefficients a₀…a₆ of x in steps, from the equation of motion (early tables).

    Written so that each coefficient waits for one product only.
    """
    x, v, s, c = row
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
def turned_clock(plan: Vector, at: int, s: float, c: float) -> tuple[float, float]:
    """The phasor at a node or fine point."""
    cosine = plan[at + COSINE]
    sine = plan[at + SINE]
    return s * cosine + c * sine, c * cosine - s * sine


@kernel
def turn(plan: Vector, s: float, c: float, angle: float) -> tuple[float, float]:
    """The phasor turned by a small angle (at most half a step)."""
    q = angle * angle
    sine = angle * (
        1 - q * (1 / 6 - q * (1 / 120 - q * (1 / 5040 - q * (1 / 362880 - q / 39916800))))
    )
    cosine = 1 - q * (
        1 / 2 - q * (1 / 24 - q * (1 / 720 - q * (1 / 40320 - q * (1 / 3628800 - q / 479001600))))
    )
    return s * cosine + c * sine, c * cosine - s * sine


@kernel
def nudged(plan: Vector, s: float, c: float, angle: float) -> tuple[float, float]:
    """The phasor turned by next to nothing."""
    return s + angle * c, c - angle * s


@kernel
def pull(plan: Vector, table: int, s: float, c: float) -> float:
    """A_t h² of a mode."""
    scaled: float = plan[table + SCALED_A] * s
    return scaled


@kernel
def pull_series(plan: Vector, table: int, s: float, c: float, series: Vector) -> None:
    """Its long series."""
    now, after = plan[table + SCALED_A] * s, plan[table + SCALED_A] * plan[table + SCALED_W] * c
    squared = plan[table + SCALED_W] * plan[table + SCALED_W]
    for n in range(ORDER):
        series[n] = now
        now, after = after, -squared * now / ((n + 1) * (n + 2))
