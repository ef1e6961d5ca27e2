"""Response spectra: the largest response of many oscillators to a record of straight lines.

Exact for the record, between its samples and in the free vibration after it.
"""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.ramp_response import largest, moved, responses
from vibroimpact.engine.rigless_entry import rigless_entry

# What is found of an oscillator: the largest |u|, |u′|/ω and |u″ + A_t|/ω².
DISPLACEMENT, VELOCITY, ACCELERATION = range(3)
FOUND = 3

_LOOK = 4096
"""Lines between two checks whether to stop."""
_SHORT = 1.4
"""Up to how many 1/ω a line is bounded by its ends, and by the bend between them."""

Three = tuple[float, float, float]


@inlined
def _bounds(
    u: float, v: float, after_u: float, after_v: float, a: float, b: float, x: float, zeta: float
) -> Three:
    """What |u|, |v| and |q| do not exceed on a line; of two components, of the longest vector.

    On a short line f exceeds its ends by at most x²/8 of the largest |f″|; on a long one it is a
    line and a free oscillation, whose energy bounds it.
    """
    if x < _SHORT:
        bend = -2.0 * zeta * v - u - a
        change = -2.0 * zeta * bend - v - b
        more = 0.125 * x * x * math.sqrt(bend * bend + change * change)
        q, after_q = u + 2.0 * zeta * v, after_u + 2.0 * zeta * after_v
        return (
            max(abs(u), abs(after_u)) + more,
            max(abs(v), abs(after_v)) + more,
            max(abs(q), abs(after_q)) + (1.0 + 2.0 * zeta) * more,
        )
    level = -a + 2.0 * zeta * b
    swing = math.sqrt((u - level) * (u - level) + (v + b) * (v + b))
    return (
        max(abs(level), abs(level - b * x)) + swing,
        abs(b) + swing,
        max(abs(a), abs(a + b * x)) + (1.0 + 2.0 * zeta) * swing,
    )


@kernel
def _searched(
    u: float,
    v: float,
    after_u: float,
    after_v: float,
    a: float,
    b: float,
    x: float,
    zeta: float,
    bounds: Three,
    most: Three,
) -> Three:
    """The largest until now and on a line, which is searched where its bounds are larger."""
    most_u, most_v, most_q = most
    bend, after_bend = -2.0 * zeta * v - u - a, -2.0 * zeta * after_v - after_u - a - b * x
    if bounds[0] > most_u:
        most_u = max(most_u, largest(u, v, a, b, zeta, x, after_u, after_v))
    if bounds[1] > most_v:
        most_v = max(most_v, largest(v, bend, b, 0.0, zeta, x, after_v, after_bend))
    if bounds[2] > most_q:
        q, slope = -2.0 * zeta * v - u, -2.0 * zeta * bend - v
        after_q, after_slope = -2.0 * zeta * after_v - after_u, -2.0 * zeta * after_bend - after_v
        level = -a - 2.0 * zeta * b
        most_q = max(most_q, largest(q, slope, level, -b, zeta, x, after_q, after_slope))
    return most_u, most_v, most_q


@kernel
def _freely(u: float, v: float, zeta: float, most: Three) -> Three:
    """The largest until now and after the record, where it only decays after one cycle."""
    size = math.sqrt(u * u + v * v)
    bounds = size, size, (1.0 + 2.0 * zeta) * size
    if bounds[0] <= most[0] and bounds[1] <= most[1] and bounds[2] <= most[2]:
        return most
    whole = math.tau / math.sqrt((1.0 - zeta) * (1.0 + zeta))
    after_u, after_v = moved(u, v, 0.0, 0.0, zeta, responses(whole, zeta))
    return _searched(u, v, after_u, after_v, 0.0, 0.0, whole, zeta, bounds, most)


@kernel
def _peaks(record: Vector, step: float, omega: float, zeta: float, counter: Any) -> Three:
    """The largest responses of one oscillator from rest; of no use if it is to stop.

    First those at the samples; then the lines are searched on which more is possible.
    """
    x = omega * step
    reach = responses(x, zeta)
    scale = 1.0 / (omega * omega)
    rise = scale / x
    u, v = 0.0, 0.0
    most_u, most_v, most_q = 0.0, 0.0, 0.0
    for i in range(len(record) - 1):
        if i % _LOOK == 0 and counter[1] != 0:
            break
        a, b = scale * record[i], rise * (record[i + 1] - record[i])
        u, v = moved(u, v, a, b, zeta, reach)
        most_u, most_v = max(most_u, abs(u)), max(most_v, abs(v))
        most_q = max(most_q, abs(u + 2.0 * zeta * v))
    most = _freely(u, v, zeta, (most_u, most_v, most_q))
    u, v = 0.0, 0.0
    for i in range(len(record) - 1):
        if i % _LOOK == 0 and counter[1] != 0:
            break
        a, b = scale * record[i], rise * (record[i + 1] - record[i])
        after_u, after_v = moved(u, v, a, b, zeta, reach)
        bounds = _bounds(u, v, after_u, after_v, a, b, x, zeta)
        if bounds[0] > most[0] or bounds[1] > most[1] or bounds[2] > most[2]:
            most = _searched(u, v, after_u, after_v, a, b, x, zeta, bounds, most)
        u, v = after_u, after_v
    return most


@rigless_entry("void(f8[::1], f8, f8[::1], f8[::1], i8[::1], f8[:, ::1])")
def respond(
    placeholder: Any,
    record: Vector,
    step: float,
    omega: Vector,
    zeta: Vector,
    counter: Vector,
    out: Vector,
) -> None:
    """Find the largest responses of oscillators from rest.

    Parameters
    ----------
    record : ndarray
        Base acceleration (m/s²), linear between its samples and 0 after them.
    step : float
        Between samples (s).
    omega, zeta : ndarray
        Natural angular frequencies (rad/s, greater than 0) and damping ratios (0 ≤ ζ < 1).
    counter : ndarray
        [0] counts the oscillators; not 0 in [1] stops.
    out : ndarray, shape (oscillator, FOUND)
        Written: the largest |u|, |u′|/ω and |u″ + A_t|/ω², in m.
    """
    for i in range(len(omega)):
        if counter[1] != 0:
            return
        most = _peaks(record, step, omega[i], zeta[i], counter)
        out[i, DISPLACEMENT], out[i, VELOCITY], out[i, ACCELERATION] = most
        counter[0] += 1
