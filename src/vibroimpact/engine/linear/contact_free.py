"""Free flight that no stop can disturb any more: known without following it.

A deviation e from the steady free flight obeys e″ + c e′ + k e = 0, whose energy k e² + e′² never
grows. Where the steady flight and √(e² + e′²/k) together stay within the gaps, nothing is touched
again, and what the motion settles on is the closed form (docs/decisions/0014-settling.md).
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import count, wave
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.table_rows import swing_of
from vibroimpact.engine.motion import Motion, facing
from vibroimpact.engine.state import FLIGHT, Clock

_WITHIN = 1.0 - 1e-9
"""Share of a gap that a motion may use: a graze is followed."""


@kernel
def undisturbed(
    plan: Vector, motion: Motion, clock: Clock, dying: float
) -> tuple[bool, float, float, float, Motion]:
    """The steady free flight, if a motion leads there and touches nothing on its way.

    Parameters
    ----------
    plan
        With its forcing; the tables need not be built.
    clock
        At the section.
    dying
        By at least this factor a disturbance must become less in a cycle.

    Returns
    -------
    found, displacement, acceleration, transmitted, motion
        Half the excursions (m, m/s²) of displacement, of the mass's absolute acceleration and of
        the transmitted force per unit mass, and the motion at the section.
    """
    k, c = plan[par.STIFFNESS], plan[par.DAMPING]
    if motion.mode != FLIGHT or count(plan) != 1 or not (k > 0.0 and c > 0.0):
        return False, 0.0, 0.0, 0.0, motion
    part = wave(plan, 1, False)
    period = 2.0 * math.pi / part.rate
    square = 0.25 * c * c - k
    slowest = k / (0.5 * c + math.sqrt(square)) if square > 0.0 else 0.5 * c
    if not math.exp(-slowest * period) < dying:
        return False, 0.0, 0.0, 0.0, motion
    p, q = swing_of(c, k, part)
    s, co = clock
    pulled, quarter = part.sine * s + part.cosine * co, part.sine * co - part.cosine * s
    rest = plan[par.LOAD] / k
    u, v = rest + p * pulled + q * quarter, part.rate * (p * quarter - q * pulled)
    swing = math.hypot(p, q) * math.hypot(part.sine, part.cosine)
    reach = swing + math.sqrt((u - motion.u) ** 2 + (v - motion.v) ** 2 / k)
    for stop in range(2):
        at = par.stop_at(stop)
        if plan[at + par.KIND] == par.ABSENT:
            continue
        sign = facing(stop)
        deformation = motion.faces[stop]
        if not sign * rest + reach < _WITHIN * plan[at + par.GAP]:
            return False, 0.0, 0.0, 0.0, motion
        if deformation > 0.0 and not math.exp(-plan[at + par.RATE] * period) < dying:
            return False, 0.0, 0.0, 0.0, motion
    carried = math.hypot(k, c * part.rate)
    # Of a force on the mass it is ü itself.
    felt = carried if plan[par.BASE] != 0.0 else part.rate * part.rate
    flight = Motion(FLIGHT, 0, u, v, (0.0, 0.0), motion.z, 0.0, clock)
    return True, swing, felt * swing, carried * swing, flight
