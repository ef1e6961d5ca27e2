"""Coefficient of restitution of a Kelvin-Voigt contact, which can push, but not pull.

A mass M hits a bumper K_j, C_j with the velocity v, without other forces. With z = C_j/(2√(K_j M)),
the contact force falls to zero and the contact ends when the mass returns with the velocity e v.
The coefficient of restitution e follows from

    -ln e = 2 z arccos z/√(1 - z²),    z < 1,
    -ln e = 2 s coth s, z = cosh s,    z > 1,

and -ln e = 2 at z = 1 (Schwager and Pöschel, Granular Matter 9 (2007) 465-469). The usual formula
z = -ln e/√(π² + ln² e) is for another contact, which lasts until the bumper is undeformed again.
That contact pulls at its end, and its rebound velocity is lower.
"""

from __future__ import annotations

import math
from collections.abc import Callable


def damping_ratio(restitution: float) -> float:
    """Return z for a coefficient of restitution e, greater than 0 and at most 1.

    -ln e increases with z, so that bisection finds z.
    """
    loss = -math.log(restitution)
    if loss == 0.0:
        return 0.0
    if loss < 2.0:
        # arccos z/√(1 - z²) falls from π/2 to 1.
        return _halved(lambda z: 2.0 * z * _over_sine(z), loss, loss / math.pi, 0.5 * loss)
    # s - less than 1 below s coth s.
    half = 0.5 * loss
    return math.cosh(_halved(lambda s: s / math.tanh(s) if s else 1.0, half, half - 1.0, half))


def _over_sine(z: float) -> float:
    """Arccos z/√(1 - z²)."""
    return math.acos(z) / math.sqrt((1.0 - z) * (1.0 + z)) if z < 1.0 else 1.0


def _halved(rising: Callable[[float], float], value: float, low: float, high: float) -> float:
    """Where a rising function has a value, to the last digit."""
    while True:
        middle = 0.5 * (low + high)
        if not low < middle < high:
            return middle
        if rising(middle) < value:
            low = middle
        else:
            high = middle
