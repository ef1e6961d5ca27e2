"""A plan for Taylor steps: there is nothing to prepare but the forcing."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import begin, change_rate, pace
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.advance import WORK_LIMIT
from vibroimpact.engine.linear.layout import OMEGA
from vibroimpact.engine.motion import Motion
from vibroimpact.engine.series.step_control import prepare
from vibroimpact.engine.state import Clock


@kernel
def build(plan: Vector, amplitude: float, omega: float) -> None:
    """Take a forcing, as passed to `parameters.rig_vector`: its size (m/s², m or N), and ω."""
    begin(plan, amplitude, omega)
    prepare(plan, stiff_rate(plan) + plan[par.DAMPING] + change_rate(plan))


@kernel
def undisturbed(
    plan: Vector, motion: Motion, clock: Clock, dying: float
) -> tuple[bool, float, float, float, Motion]:
    """Free flight has no closed form here."""
    return False, 0.0, 0.0, 0.0, motion


@kernel
def stiff_rate(plan: Vector) -> float:
    """What makes a velocity of a displacement: ω0 of small motions, or ω without a spring."""
    k = plan[par.STIFFNESS] + plan[par.HYSTERETIC]
    k += 2.0 * plan[par.SINH] * plan[par.SINH_RATE]
    k += plan[par.OWN + par.OWN_STIFFNESS]
    return math.sqrt(k) if k > 0.0 else plan[OMEGA]


@kernel
def too_much_work(plan: Vector, period: float) -> bool:
    """Whether one cycle could take too many steps."""
    rate = stiff_rate(plan) + plan[par.DAMPING] + pace(plan)
    for stop in range(2):
        at = par.stop_at(stop)
        if plan[at + par.KIND] == par.KELVIN_VOIGT:
            rate += math.sqrt(plan[at + par.BUMPER_STIFFNESS]) + plan[at + par.BUMPER_DAMPING]
    return not rate * period < WORK_LIMIT


@kernel
def motion_rate(plan: Vector) -> float:
    """How fast motions change (1/s): the rig's own rate and that of the shaking, above 0.

    An acceleration over it is the velocity that the acceleration makes.
    """
    return stiff_rate(plan) + change_rate(plan) + 1e-300
