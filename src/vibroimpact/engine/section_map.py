"""The map from one stroboscopic section to the next, along a parameter, with its derivative.

P goes over whole forcing cycles, or, for motions that are their own mirror image, over half
cycles, each followed by the mirror. A rig with its forcing is one *system vector*, and a parameter
p moves it along a straight line, system = base + p · direction.
"""

from __future__ import annotations

import math

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import FLIGHT
from vibroimpact.engine.observers.tangent import DISTURBANCE
from vibroimpact.engine.state import MODE as STATE_MODE
from vibroimpact.engine.state import finite, parts_room, room, wind
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
    flow.build(plan, system[AMPLITUDE], 2.0 * math.pi * system[FREQUENCY])


@kernel
def begin_at(plan: Vector, state: Vector, mode: float, phase: float, point: Vector) -> None:
    """Put a state at a point of the section, or where it can be."""
    state[STATE_MODE] = mode
    wind(plan, state, math.sin(phase), math.cos(phase))
    flow.at_point(plan, state, point)


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
    s, c = math.sin(phase), math.cos(phase)
    state, notes = room(), parts_room()
    begin_at(plan, state, facts[MODE], phase, point)
    # The deformations and what the isolator remembers, where they can be.
    flow.point(plan, state, notes)
    for i in range(2, DISTURBANCE):
        point[i] = notes[i]
    facts[MODE] = state[STATE_MODE]
    period = (0.5 if mirror else 1.0) / system[FREQUENCY]
    if flow.too_much_work(plan, period) != 0:
        return TOO_MUCH_WORK
    flow.unit_disturbances(plan, state, q)
    facts[CONTACTS_RIGHT], facts[CONTACTS_LEFT], facts[DAMPING] = 0.0, 0.0, 0.0
    for _ in range(count):
        notes[0], notes[1], notes[2] = 0.0, 0.0, 0.0
        if event_loop.tangent(plan, state, s, c, period, max_events, notes, q) > max_events:
            return TOO_MANY_EVENTS
        facts[DAMPING] += notes[0]
        facts[CONTACTS_RIGHT] += notes[1]
        facts[CONTACTS_LEFT] += notes[2]
        if mirror:
            flow.mirror(plan, state, q)
    if not finite(plan, state):
        return NOT_FINITE
    flow.point(plan, state, image)
    if state[STATE_MODE] != FLIGHT:
        facts[MODE] = state[STATE_MODE]
    return DONE
