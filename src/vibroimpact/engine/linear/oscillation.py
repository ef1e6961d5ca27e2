"""The free oscillation x″ = −c x′ − k x after some time, in closed form, energy kept.

Rows that are composed of one another err by the sum of all the roundings that they are made of,
always the same way: a mass that loses nothing would gain or lose ten roundings of its energy at
every window of a table. The rounding of a closed form by itself still makes half a one, so that
where nothing is lost it is returned, too.
"""

from __future__ import annotations

import math

from numpy import float32, float64  # single numbers: nothing is allocated

from vibroimpact.engine.jit import kernel


@kernel
def excess(a: float, b: float, product: float) -> float:
    """What a b − product is, to twice the digits, where they agree to single precision."""
    high_a, high_b = float64(float32(a)), float64(float32(b))
    low_a, low_b = a - high_a, b - high_b
    delta: float = ((high_a * high_b - product) + high_a * low_b) + (low_a * high_b + low_a * low_b)
    return delta


@kernel
def oscillation(
    t: float, c: float, k: float
) -> tuple[float, float, float, float, float, float, float]:
    """The matrix of (x, x′) after the time t (s) where k > c²/4, and what its rounding left out.

    Returns
    -------
    x_of_x, x_of_v, v_of_x, v_of_v, out, swing, pull
        What has been left out of x_of_x and of v_of_v is `out`, of x_of_v `swing`, of v_of_x
        `pull`; they keep the energy x′² + k x² to twice the digits, and are 0 where c is not.
    """
    rate = math.sqrt(k - 0.25 * c * c)
    sine, cosine = math.sin(rate * t), math.cos(rate * t)
    x_of_v = sine / rate
    if c > 0.0:
        faded = math.exp(-0.5 * c * t)
        half = 0.5 * c * x_of_v
        x_of_x, v_of_v = faded * (cosine + half), faded * (cosine - half)
        return x_of_x, faded * x_of_v, -faded * k * x_of_v, v_of_v, 0.0, 0.0, 0.0
    v_of_x = -k * x_of_v
    # By how much cos² + sin² exceeds 1, and √k the rate as a share of it.
    large, small = max(abs(cosine), abs(sine)), min(abs(cosine), abs(sine))
    high, less = float64(float32(large)), float64(float32(small))
    long = (high * high - 1.0) + less * less  # without rounding
    long += excess(large, large, high * high) + excess(small, small, less * less)
    fast = -0.5 * excess(rate, rate, k) / k
    out: float = -0.5 * long * cosine
    swing: float = -excess(x_of_v, rate, sine) / rate - x_of_v * (0.5 * long + fast)
    pull: float = -excess(k, x_of_v, -v_of_x) - k * swing
    # Outside the range of single precision there are no such digits.
    known = abs(out) < 1e-15 and abs(swing) <= 1e-15 * abs(x_of_v)
    if not (known and abs(pull) <= 1e-15 * abs(v_of_x)):
        out, swing, pull = 0.0, 0.0, 0.0
    return cosine, x_of_v, v_of_x, cosine, out, swing, pull
