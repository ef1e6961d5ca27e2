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
from vibroimpact.engine.memory import stack
from vibroimpact.engine.state import DAMPING as NOTED_DAMPING
from vibroimpact.engine.state import (
    FLIGHT,
    HITS,
    LARGEST,
    finite,
    notes_room,
    parts_room,
    room,
    wind,
)
from vibroimpact.engine.state import MODE as STATE_MODE
from vibroimpact.engine.status import DONE, NOT_FINITE, TOO_MANY_EVENTS, TOO_MUCH_WORK

# The system vector: the rig's, so many `flow.numbers`, then the forcing. Here that of one mass:
AMPLITUDE = par.SIZE
FREQUENCY = par.SIZE + 1
SYSTEM = par.SIZE + 2

# A point is the parts of a state (`state.Parts.of_point`), signed as in the paper, then the
# parameter.

# What an orbit shows besides: its mode at the section, the largest residual over the scale, the
# Newton steps taken, the integral of the damping, and the contacts begun at each stop.
MODE, RESIDUAL, STEPS, DAMPING, CONTACTS = range(5)

facts_room = stack(CONTACTS + LARGEST)
point_room = stack(LARGEST + 1)


@kernel
def system_plan(base: Vector, direction: Vector, p: float, plan: Vector) -> tuple[float, float]:
    """Put the system at a parameter into the plan, with its tables: its amplitude and frequency."""
    n = flow.numbers(plan)
    for i in range(n):
        # 0 · ∞ must not make a NaN of an absent bumper.
        plan[i] = base[i] + p * direction[i] if direction[i] != 0.0 else base[i]
    flow.complete(plan)
    amplitude = base[n] + p * direction[n]
    frequency = base[n + 1] + p * direction[n + 1]
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    return amplitude, frequency


@kernel
def begin_at(plan: Vector, state: Vector, mode: float, phase: float, point: Vector) -> None:
    """Put a state at a point of the section, or where it can be."""
    state[STATE_MODE] = mode
    wind(plan, state, math.sin(phase), math.cos(phase))
    flow.at_point(plan, state, point)


@kernel
def section_map(
    plan: Vector,
    frequency: float,
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
    parts, stops = flow.parts(plan), flow.stops(plan)
    for i in range(parts):
        if not abs(point[i]) < 1e200:
            return NOT_FINITE
    s, c = math.sin(phase), math.cos(phase)
    state, here, notes = room(), parts_room(), notes_room()
    begin_at(plan, state, facts[MODE], phase, point)
    # The deformations and what the isolator remembers, where they can be.
    flow.point(plan, state, here)
    for i in range(flow.coordinates(plan), parts):
        point[i] = here[i]
    facts[MODE] = state[STATE_MODE]
    period = (0.5 if mirror else 1.0) / frequency
    if flow.too_much_work(plan, period) != 0:
        return TOO_MUCH_WORK
    flow.unit_disturbances(plan, state, q)
    facts[DAMPING] = 0.0
    for f in range(stops):
        facts[CONTACTS + f] = 0.0
    for _ in range(count):
        start_notes(plan, notes)
        if event_loop.tangent(plan, state, s, c, period, max_events, notes, q) > max_events:
            return TOO_MANY_EVENTS
        facts[DAMPING] += notes[NOTED_DAMPING]
        for f in range(stops):
            facts[CONTACTS + f] += notes[HITS + f]
        if mirror:
            flow.mirror(plan, state, q)
    if not finite(plan, state):
        return NOT_FINITE
    flow.point(plan, state, image)
    if state[STATE_MODE] != FLIGHT:
        facts[MODE] = state[STATE_MODE]
    return DONE


@kernel
def start_notes(plan: Vector, notes: Vector) -> None:
    """Begin the notes of `flow.tangent`."""
    for i in range(HITS + flow.stops(plan)):
        notes[i] = 0.0
