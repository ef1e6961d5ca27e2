"""Which forces act at a moment that are not linear, and for how long they are these.

A power of a deformation or of a velocity has a singularity where it begins, which no series passes.
Where such a force is nothing beside the others it is left out; beside that a step is short.
"""

from __future__ import annotations

import math

import numpy as np

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.linear.layout import MOST, STEEPEST
from vibroimpact.engine.motion import BOTH, Motion, facing, main_stop
from vibroimpact.engine.series.kernels import drags_any_power
from vibroimpact.engine.series.step_control import ROUNDING
from vibroimpact.engine.series.values import NO_PUSH, Frame, Laws
from vibroimpact.engine.stops.curved import (
    NO_TRACE,
    beyond,
    curved_stop,
    depth_of,
    own_pressing,
    own_push,
    pressing,
    push_of,
    shallow,
)
from vibroimpact.engine.stops.places import total_gap
from vibroimpact.engine.taylor.mode_forces import acceleration_of, branch_of
from vibroimpact.engine.taylor.plan import motion_rate

_STABLE = 8.0
"""Times that in which a drag decays: a series of a step's degree grows with a longer one."""

_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(10)


@kernel
def slowness(
    v: float, a: float, most: float, unit: float, drag: float, exponent: float, grain: float
) -> tuple[float, float, float]:
    """As `slow`, of a speed and an acceleration; `most` is that which the shaking makes (m/s²).

    `unit` is the motion's own time (s), `grain` the rounding of a speed that is a difference.
    """
    force = max(a, most) + 1e-300
    if drag == 0.0:
        return 0.0, math.inf, math.inf
    time = (NO_TRACE * force * unit / (2.0 * drag * force**exponent * math.sqrt(unit))) ** (
        1.0 / (exponent + 0.5)
    )
    little = force * min(time, unit)
    if v <= grain and little < grain:
        little, a = grain, a + drag * grain**exponent
    # The velocity grows with the acceleration or, where that vanishes, with its rate.
    if v <= little:
        most = 2.0 * little
        if exponent > 4.0:
            most = beyond(exponent) * little - v
        longest = most / (a + math.sqrt(little * force / unit))
        return little, longest, longest
    turning = 0.5 * v / (a + math.sqrt(v * force / unit))
    stable = _STABLE / (drag * exponent * v ** (exponent - 1.0))
    # Where a weak drag changes nothing a mass that creeps is not stopped at each of these times.
    longest = stable if exponent > 1.0 else min(turning, stable)
    return little, longest, min(turning, stable)


@kernel
def slow(plan: Vector, motion: Motion, exponent: float) -> tuple[float, float, float]:
    """Below which velocity the drag is left out; how long a step may be, and a scale of time (s).

    A power of the velocity has a singularity where the mass turns. What the drag would do while it
    is left out is a share ε of the velocities that the forces make in the motion's own time. The
    scale is half the time in which the mass may turn: in longer units coefficients would overflow.
    """
    v, a = abs(motion.v), abs(acceleration_of(plan, motion))
    unit = 1.0 / motion_rate(plan)
    limits: tuple[float, float, float] = slowness(
        v, a, plan[MOST], unit, plan[par.DAMPING], exponent, 0.0
    )
    return limits


@not_inlined
def laws_of(
    plan: Vector, motion: Motion, frame: Frame, x: float, longest: float
) -> tuple[Laws, float, float]:
    """The forces of this moment that are not linear; how long they are these at most (s).

    The third is the scale of time that `slow` gives (s).
    """
    mode = motion.mode
    v = frame.sign * motion.v
    branch = branch_of(plan, motion, frame.sign)
    if v == 0.0:
        v = math.copysign(0.0, branch.way)  # by which |v| has its slope
    push, other, distance_between = NO_PUSH, NO_PUSH, 0.0
    if mode:
        grain = 16.0 * ROUNDING * (abs(x) + abs(frame.offset))
        stop = main_stop(mode)
        memory = motion.faces[stop]
        if curved_stop(plan, stop):
            push = push_of(plan, stop, branch.way if v == 0.0 else v, memory)
            gains = frame.sign * acceleration_of(plan, motion)
            if plan[par.stop_at(stop) + par.KIND] == par.FORMULA:
                push = own_pressing(plan, stop, x, v, gains, grain)
            else:
                push = pressing(push, v, gains)
                push, longest = shallow(push, x, v, gains, plan[STEEPEST], grain, longest)
        if mode == BOTH and curved_stop(plan, 1):
            distance_between = -total_gap(plan)
            other = push_of(plan, 1, -(branch.way if v == 0.0 else v), motion.faces[1])
            gains = -frame.sign * acceleration_of(plan, motion)
            if plan[par.stop_at(1) + par.KIND] == par.FORMULA:
                other = own_pressing(plan, 1, distance_between - x, -v, gains, grain)
            else:
                other = pressing(other, -v, gains)
                other, longest = shallow(
                    other, distance_between - x, -v, gains, plan[STEEPEST], grain, longest
                )
    drag, turning = 0.0, math.inf
    exponent = plan[par.DRAG]
    if exponent != 1.0:
        drag = plan[par.DAMPING]
        if drags_any_power(plan):
            little, most, turning = slow(plan, motion, exponent)
            longest = min(longest, most)
            if abs(motion.v) <= little:
                drag = 0.0
    return Laws(branch, push, other, distance_between, drag), longest, min(turning, longest)


@kernel
def unreturned_energy(plan: Vector, before: Motion, after: Motion, stop: int) -> float:
    """What a stop loses between two moments that would pull and does not push: of its spring's."""
    if not (before.mode >> stop & 1 and curved_stop(plan, stop)):
        return 0.0
    sign = facing(stop)
    memory = before.faces[stop]
    closing = sign * before.v
    push = push_of(plan, stop, closing, memory)
    gains = sign * acceleration_of(plan, before)
    begun, ended = depth_of(plan, before, stop), depth_of(plan, after, stop)
    if plan[par.stop_at(stop) + par.KIND] == par.FORMULA:
        gap = plan[par.stop_at(stop) + par.GAP]
        grain = 16.0 * ROUNDING * (abs(begun) + abs(gap))
        if own_pressing(plan, stop, begun, closing, gains, grain).stiffness != 0.0:
            return 0.0
        middle, half, kept = 0.5 * (begun + ended), 0.5 * (begun - ended), 0.0
        for i in range(len(_PLACES)):
            depth = middle + half * _PLACES[i]
            kept += half * _WEIGHTS[i] * own_push(plan, stop, depth, 0.0)[0]
        return kept
    if pressing(push, closing, gains).stiffness != 0.0:
        return 0.0
    power = push.exponent + 1.0
    return push.stiffness / power * (begun**power - ended**power)  # type: ignore[no-any-return]
