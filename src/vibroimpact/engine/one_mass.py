"""The functions of the flows of one mass, between two stops at most (see `flow`).

Inside, a motion is a value that the compiler keeps in registers; here it is unpacked from a state
and packed again, once for a call. Which flow answers is known by the type of the plan.
"""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import dispatch, event_loop, fourier, measure
from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing import dispatch as forcing
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import ISOLATOR as MEMORY
from vibroimpact.engine.motion import (
    LEFT,
    LEFT_BUMPER,
    MODE,
    RIGHT,
    RIGHT_BUMPER,
    STATE,
    Motion,
    mirrored,
    pack,
    unpacked,
)
from vibroimpact.engine.motion import U as DISPLACEMENT
from vibroimpact.engine.motion import V as VELOCITY
from vibroimpact.engine.observe import UNOBSERVED
from vibroimpact.engine.observers import record as recording
from vibroimpact.engine.observers import tangent as disturbances
from vibroimpact.engine.observers.demand import Demand
from vibroimpact.engine.observers.extremes import Extremes
from vibroimpact.engine.observers.growth import Growth
from vibroimpact.engine.observers.margin import Margin
from vibroimpact.engine.observers.record import Record
from vibroimpact.engine.observers.tangent import DISTURBANCE, Tangent
from vibroimpact.engine.state import FIRST

PARTS = DISTURBANCE
"""u, u̇, u_R, u_L, z."""

_FORGOTTEN = 9.0
"""What relaxes by more powers of e in a cycle is another's memory no more."""


@kernel
def _motion(state: Vector) -> Motion:
    return unpacked(state, (state[STATE], state[STATE + 1]))


@kernel
def _keep(motion: Motion, state: Vector) -> None:
    pack(motion, state)
    state[STATE], state[STATE + 1] = motion.clock


@kernel
def begin(plan: Vector, amplitude: float, omega: float) -> None:
    forcing.begin(plan, amplitude, omega)


@kernel
def build(plan: Vector, amplitude: float, omega: float) -> None:
    dispatch.build(plan, amplitude, omega)


@kernel
def too_much_work(plan: Vector, period: float) -> int:
    return 1 if dispatch.too_much_work(plan, period) else 0


@kernel
def stiff_rate(plan: Vector) -> float:
    return dispatch.stiff_rate(plan)  # type: ignore[no-any-return]


@kernel
def parts(plan: Vector) -> int:
    return PARTS


@kernel
def units(plan: Vector, units: Vector) -> None:
    rate = dispatch.stiff_rate(plan)
    for i in range(PARTS):
        units[i] = rate
    units[VELOCITY - FIRST] = 1.0


@kernel
def size(plan: Vector, state: Vector) -> float:
    rate: float = dispatch.stiff_rate(plan)
    size: float = max(rate * abs(state[DISPLACEMENT]), abs(state[VELOCITY]))
    return size


@kernel
def _outlives(plan: Vector, state: Vector, at: int, period: float) -> bool:
    if at == MEMORY:
        return bool(plan[par.HYSTERETIC] != 0.0)
    if at in (DISPLACEMENT, VELOCITY):
        return True
    side = RIGHT if at == RIGHT_BUMPER else LEFT
    stop = par.BUMPER + par.WIDTH * (side - 1)
    if int(state[MODE]) & side or plan[stop + par.KIND] != par.KELVIN_VOIGT:
        return False
    return bool(plan[stop + par.RATE] * period < _FORGOTTEN)


@kernel
def disturb(plan: Vector, state: Vector, part: int, by: float, period: float) -> float:
    at = FIRST + part
    if not _outlives(plan, state, at, period):
        return 0.0
    before = state[at]
    # What yields can be stretched no farther.
    state[at] += -by if at == MEMORY and before > 0.0 else by
    place(plan, state)
    by = state[at] - before
    return by


@kernel
def place(plan: Vector, state: Vector) -> None:
    mode = int(state[MODE])
    u, v = state[DISPLACEMENT], state[VELOCITY]
    right, left = max(state[RIGHT_BUMPER], 0.0), max(state[LEFT_BUMPER], 0.0)
    found = 0
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
    z = min(max(state[MEMORY], -plan[par.YIELD]), plan[par.YIELD])
    clock = state[STATE], state[STATE + 1]
    _keep(Motion(found, found, u, v, right, left, z, 0.0, clock), state)


@kernel
def point(plan: Vector, state: Vector, point: Vector) -> None:
    for i in range(PARTS):
        point[i] = state[FIRST + i]
    point[LEFT_BUMPER - FIRST] = -point[LEFT_BUMPER - FIRST]


@kernel
def at_point(plan: Vector, state: Vector, point: Vector) -> None:
    for i in range(PARTS):
        state[FIRST + i] = point[i]
    state[LEFT_BUMPER] = -state[LEFT_BUMPER]
    place(plan, state)


@kernel
def undisturbed(plan: Vector, state: Vector, dying: float, found: Vector) -> int:
    motion = _motion(state)
    free, swing, felt, carried, motion = dispatch.undisturbed(plan, motion, motion.clock, dying)
    if not free:
        return 0
    found[0], found[1], found[2] = swing, felt, carried
    _keep(motion, state)
    return 1


@kernel
def _followed(
    plan: Vector, state: Vector, s: float, c: float, length: float, max_events: int, notes: Any
) -> tuple[int, Any]:
    clock = (s, c)
    motion = unpacked(state, clock)
    events, motion, notes = event_loop.cycle(plan, motion, clock, length, max_events, notes)
    _keep(motion, state)
    return events, notes


@kernel
def cycle(plan: Vector, state: Vector, s: float, c: float, length: float, max_events: int) -> int:
    events, _ = _followed(plan, state, s, c, length, max_events, UNOBSERVED)
    return events


@kernel
def extremes(
    plan: Vector, state: Vector, s: float, c: float, length: float, max_events: int, notes: Vector
) -> int:
    seen = Extremes(
        notes[0],
        notes[1],
        notes[2],
        notes[3],
        int(notes[4]),
        int(notes[5]),
        notes[6],
        notes[7],
        notes[8],
        notes[9],
    )
    events, seen = _followed(plan, state, s, c, length, max_events, seen)
    notes[0], notes[1], notes[2], notes[3] = seen.u_least, seen.u_most, seen.a_least, seen.a_most
    notes[4], notes[5] = seen.hits_right, seen.hits_left
    notes[6], notes[7] = seen.force_right, seen.force_left
    notes[8], notes[9] = seen.impulse_right, seen.impulse_left
    return events


@kernel
def demand(
    plan: Vector, state: Vector, s: float, c: float, length: float, max_events: int, notes: Vector
) -> int:
    seen = Demand(
        notes[0],
        notes[1],
        notes[2],
        notes[3],
        notes[4],
        notes[5],
        notes[6],
        notes[7],
        int(notes[8]),
        int(notes[9]),
        notes[10],
        notes[11],
        notes[12],
        int(notes[13]),
    )
    events, seen = _followed(plan, state, s, c, length, max_events, seen)
    notes[0], notes[1], notes[2], notes[3] = seen.u_least, seen.u_most, seen.a_least, seen.a_most
    notes[4], notes[5] = seen.force_right, seen.force_left
    notes[6], notes[7] = seen.impulse_right, seen.impulse_left
    notes[8], notes[9] = seen.hits_right, seen.hits_left
    notes[10], notes[11], notes[12] = seen.work, seen.lost, seen.lost_stops
    return events


@kernel
def margin(
    plan: Vector, state: Vector, s: float, c: float, length: float, max_events: int, notes: Vector
) -> int:
    events, seen = _followed(plan, state, s, c, length, max_events, Margin(notes[0]))
    notes[0] = seen.least
    return events


@kernel
def record(
    plan: Vector,
    state: Vector,
    s: float,
    c: float,
    length: float,
    max_events: int,
    notes: Vector,
    samples: Vector,
    events: Vector,
) -> int:
    seen = Record(
        samples,
        int(notes[recording.COLUMNS]),
        int(notes[recording.BEGIN]),
        notes[recording.STEP],
        int(notes[recording.COUNT]),
        int(notes[recording.NEXT]),
        events,
        int(notes[recording.WRITTEN]),
        int(notes[recording.LAST]),
        int(notes[recording.NUMBER]),
    )
    here, seen = _followed(plan, state, s, c, length, max_events, seen)
    notes[recording.WRITTEN] = seen.written
    return here


@kernel
def write(plan: Vector, state: Vector, samples: Vector, columns: int, at: int) -> None:
    recording.write(plan, _motion(state), samples, columns, at)


@kernel
def unit_disturbances(plan: Vector, state: Vector, q: Vector) -> None:
    disturbances.unit_disturbances(plan, int(state[MODE]), q)


@kernel
def tangent(
    plan: Vector,
    state: Vector,
    s: float,
    c: float,
    length: float,
    max_events: int,
    q: Vector,
    notes: Vector,
) -> int:
    seen = Tangent(q, notes[0], int(notes[1]), int(notes[2]))
    events, seen = _followed(plan, state, s, c, length, max_events, seen)
    notes[0], notes[1], notes[2] = seen.damping, seen.hits_right, seen.hits_left
    return events


@kernel
def mirror(plan: Vector, state: Vector, q: Vector) -> None:
    _keep(mirrored(_motion(state)), state)
    for i in range(DISTURBANCE):
        at = i * DISTURBANCE
        q[at], q[at + 1] = -q[at], -q[at + 1]
        q[at + 2], q[at + 3] = -q[at + 3], -q[at + 2]
        q[at + 4] = -q[at + 4]


@kernel
def start_growth(plan: Vector, state: Vector, q: Vector, w: Vector) -> None:
    dispatch.start_growth(plan, q, w, dispatch.stiff_rate(plan), int(state[MODE]))


@kernel
def growth(
    plan: Vector,
    state: Vector,
    s: float,
    c: float,
    length: float,
    max_events: int,
    q: Vector,
    w: Vector,
    notes: Vector,
) -> int:
    seen = Growth(q, w, dispatch.stiff_rate(plan), length, 0.0, 0.0, 0.0, 0.0)
    events, seen = _followed(plan, state, s, c, length, max_events, seen)
    notes[0], notes[1], notes[2] = seen.first, seen.both, seen.dissipation
    return events


@kernel
def measure_phase(plan: Vector, state: Vector, length: float, side: int, out: Vector) -> None:
    measure.measure_phase(plan, _motion(state), length, side, out)


@kernel
def integrate_phase(
    plan: Vector,
    state: Vector,
    length: float,
    begins: float,
    lines: Vector,
    count: int,
    out: Vector,
) -> None:
    fourier.integrate_phase(plan, _motion(state), length, begins, lines, count, out)


MOTION = (
    begin,
    build,
    too_much_work,
    stiff_rate,
    parts,
    units,
    size,
    disturb,
    place,
    point,
    at_point,
    undisturbed,
    cycle,
    extremes,
)
"""What a sweep asks for."""
RECORDED = (record, write)
DISTURBED = (unit_disturbances, tangent, mirror, start_growth, growth, margin)
MEASURED = (demand, measure_phase, integrate_phase)
