"""The map from one stroboscopic section to the next, along a parameter, with its derivative.

P goes over whole forcing cycles, or, for motions that are their own mirror image, over half
cycles, each followed by the mirror. A rig with its forcing is one *system vector*, and a parameter
p moves it along a straight line, system = base + p · direction.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.dispatch import build, too_much_work
from vibroimpact.engine.event_loop import cycle
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import FLIGHT, RIGHT, Clock, Motion, finite, mirrored
from vibroimpact.engine.observers.tangent import DISTURBANCE, Tangent, unit_disturbances
from vibroimpact.engine.status import DONE, NOT_FINITE, TOO_MANY_EVENTS, TOO_MUCH_WORK

# The system vector: the rig (`parameters`), then the forcing.
AMPLITUDE = par.SIZE
FREQUENCY = par.SIZE + 1
SYSTEM = par.SIZE + 2

# A point: the state u, u̇, u_R, u_L (signed as in the paper), z, then the parameter.
PARAMETER = DISTURBANCE
POINT = DISTURBANCE + 1

# What an orbit shows besides: its mode at the section, contacts begun on each side, the largest
# residual over the scale, the Newton steps taken, and the integral of the damping.
MODE, CONTACTS_RIGHT, CONTACTS_LEFT, RESIDUAL, STEPS, DAMPING = range(6)
FACTS = 6


@kernel
def system_plan(base: Vector, direction: Vector, p: float, plan: Vector, system: Vector) -> None:
    """Put the system at a parameter into `system`, and its tables into the plan."""
    for i in range(SYSTEM):
        # 0 · ∞ must not make a NaN of an absent bumper.
        system[i] = base[i] + p * direction[i] if direction[i] != 0.0 else base[i]
    for side in range(2):
        at = par.BUMPER + par.WIDTH * side
        if system[at + par.KIND] == par.KELVIN_VOIGT and system[at + par.BUMPER_DAMPING] > 0.0:
            system[at + par.RATE] = (
                system[at + par.BUMPER_STIFFNESS] / system[at + par.BUMPER_DAMPING]
            )

        # Newton's method may look beyond what can be; above 1 the mass bounces all the same.
        system[at + par.RESTITUTION] = max(system[at + par.RESTITUTION], 0.0)
    for i in range(par.SIZE):
        plan[i] = system[i]
    build(plan, system[AMPLITUDE], 2.0 * math.pi * system[FREQUENCY])


@kernel
def placed(
    plan: Vector,
    mode: int,
    u: float,
    v: float,
    right: float,
    left: float,
    z: float,
    clock: Clock,
) -> Motion:
    """The nearest state that can be: no mass inside a bumper, no bumper that pulls.

    Deformations are measured away from the mass.
    """
    right, left = max(right, 0.0), max(left, 0.0)
    found = FLIGHT
    for side in range(1, 3):
        at = par.BUMPER + par.WIDTH * (side - 1)
        kind = plan[at + par.KIND]
        if kind == par.ABSENT:
            continue
        sign = 1.0 if side == RIGHT else -1.0
        deformation = right if side == RIGHT else left
        reach = sign * u - plan[at + par.GAP]
        if kind == par.RIGID:
            deformation = 0.0
            if reach > 0.0:
                u = sign * plan[at + par.GAP]
            if mode & side and reach >= 0.0 and v == 0.0:
                found |= side
        elif kind != par.KELVIN_VOIGT:
            if reach > 0.0 or (reach == 0.0 and mode & side):
                found |= side
            else:
                deformation = 0.0
        else:
            if mode & side or reach > deformation:
                force = plan[at + par.BUMPER_STIFFNESS] * reach
                force += plan[at + par.BUMPER_DAMPING] * sign * v
                deformation = max(reach, 0.0)
                if reach >= 0.0 and force >= 0.0:
                    found |= side
            if plan[at + par.BUMPER_DAMPING] == 0.0 and not found & side:
                deformation = 0.0
        if side == RIGHT:
            right = deformation
        else:
            left = deformation
    z = min(max(z, -plan[par.YIELD]), plan[par.YIELD])
    return Motion(found, found, u, v, right, left, z, 0.0, clock)


@kernel
def section_map(
    plan: Vector,
    system: Vector,
    phase: float,
    count: int,
    mirror: bool,
    max_events: int,
    point: Vector,
    facts: Vector,
    image: Vector,
    q: Vector,
) -> int:
    """Evaluate P and its derivative at a point, whose state is put where it can be.

    `q` receives what becomes of unit disturbances, a row each; the result is a `Status`.
    """
    for i in range(DISTURBANCE):
        if not abs(point[i]) < 1e200:
            return NOT_FINITE
    clock = (math.sin(phase), math.cos(phase))
    motion = placed(
        plan, int(facts[MODE]), point[0], point[1], point[2], -point[3], point[4], clock
    )
    point[2], point[3], point[4] = motion.right, -motion.left, motion.z
    facts[MODE] = motion.mode
    period = (0.5 if mirror else 1.0) / system[FREQUENCY]
    if too_much_work(plan, period):
        return TOO_MUCH_WORK
    unit_disturbances(plan, motion.mode, q)
    facts[CONTACTS_RIGHT], facts[CONTACTS_LEFT], facts[DAMPING] = 0.0, 0.0, 0.0
    for _ in range(count):
        notes = Tangent(q, 0.0, 0, 0)
        events, motion, notes = cycle(plan, motion, clock, period, max_events, notes)
        if events > max_events:
            return TOO_MANY_EVENTS
        facts[DAMPING] += notes.damping
        facts[CONTACTS_RIGHT] += notes.hits_right
        facts[CONTACTS_LEFT] += notes.hits_left
        if mirror:
            motion = mirrored(motion)
            for i in range(DISTURBANCE):
                at = i * DISTURBANCE
                q[at], q[at + 1] = -q[at], -q[at + 1]
                q[at + 2], q[at + 3] = -q[at + 3], -q[at + 2]
                q[at + 4] = -q[at + 4]
    if not finite(motion):
        return NOT_FINITE
    image[0], image[1], image[2], image[3] = motion.u, motion.v, motion.right, -motion.left
    image[4] = motion.z
    if motion.mode != FLIGHT:
        facts[MODE] = motion.mode
    return DONE
