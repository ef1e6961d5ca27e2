"""The functions of the flows of one mass, between two stops at most (see `flow`).

Inside, a motion is a value that the compiler keeps in registers; here it is unpacked from a state
and packed again, once for a call. Which flow answers is known by the type of the plan.
"""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine import parameters as par
from vibroimpact.engine.compiler import overload
from vibroimpact.engine.forcing import dispatch as forcing
from vibroimpact.engine.jit import CHOSEN, Vector, kernel
from vibroimpact.engine.motion import FACES, STATE, Motion, changed, pack, swapped, unpacked
from vibroimpact.engine.motion import ISOLATOR as MEMORY
from vibroimpact.engine.motion import U as DISPLACEMENT
from vibroimpact.engine.motion import V as VELOCITY
from vibroimpact.engine.one_mass import channels, forces, motions
from vibroimpact.engine.one_mass import demand as demands
from vibroimpact.engine.one_mass import extremes as ranges
from vibroimpact.engine.one_mass import margin as margins
from vibroimpact.engine.one_mass import measure as phases
from vibroimpact.engine.one_mass import record as recording
from vibroimpact.engine.one_mass import tangent as disturbances
from vibroimpact.engine.one_mass.advance import advance as advanced
from vibroimpact.engine.one_mass.extremes import (
    A_LEAST,
    A_MOST,
    HITS,
    MEASURES,
    NOTES,
    T_LEAST,
    T_MOST,
    U_LEAST,
    U_MOST,
)
from vibroimpact.engine.state import ARRIVAL, FIRST, FRESH, MODE, ONE_MASS, STEP, copy
from vibroimpact.engine.stops import curved, kelvin_voigt, rigid

nothing, extremes, margin = ranges.nothing, ranges.extremes, margins.margin
record, write, measure = recording.record, recording.write, phases.measure
start_demand, demand = demands.start_demand, demands.demand
unit_disturbances, tangent, mirror = (
    disturbances.unit_disturbances,
    disturbances.tangent,
    disturbances.mirror,
)
first_piece, next_piece, series = (
    channels.first_piece,
    channels.next_piece,
    channels.series,
)

PARTS = ONE_MASS.total
"""u, u̇, u_R, u_L, z."""

_FORGOTTEN = 9.0
"""What relaxes by more powers of e in a cycle is another's memory no more."""


@kernel
def begin(plan: Vector, amplitude: float, omega: float) -> None:
    forcing.begin(plan, amplitude, omega)


@kernel
def build(plan: Vector, amplitude: float, omega: float) -> None:
    motions.build(plan, amplitude, omega)


@kernel
def too_much_work(plan: Vector, period: float) -> int:
    return 1 if motions.too_much_work(plan, period) else 0


@kernel
def stiff_rate(plan: Vector) -> float:
    return forces.stiff_rate(plan)


@kernel
def parts(plan: Vector) -> int:
    return PARTS


@kernel
def coordinates(plan: Vector) -> int:
    return 2 * ONE_MASS.masses


@kernel
def stops(plan: Vector) -> int:
    return ONE_MASS.stops


@kernel
def numbers(plan: Vector) -> int:
    return par.SIZE


@kernel
def complete(plan: Vector) -> None:
    for stop in range(2):
        at = par.stop_at(stop)
        kelvin_voigt.complete(plan, stop)
        # Newton's method may look beyond what can be; above 1 the mass bounces all the same.
        plan[at + par.RESTITUTION] = max(plan[at + par.RESTITUTION], 0.0)


@kernel
def units(plan: Vector, units: Vector) -> None:
    rate = forces.stiff_rate(plan)
    for i in range(PARTS):
        units[i] = rate
    units[VELOCITY - FIRST] = 1.0


@kernel
def size(plan: Vector, state: Vector) -> float:
    rate: float = forces.stiff_rate(plan)
    size: float = max(rate * abs(state[DISPLACEMENT]), abs(state[VELOCITY]))
    return size


@kernel
def _outlives(plan: Vector, state: Vector, at: int, period: float) -> bool:
    if at == MEMORY:
        return bool(plan[par.HYSTERETIC] != 0.0)
    if at in (DISPLACEMENT, VELOCITY):
        return True
    stop = at - FACES
    numbers = par.stop_at(stop)
    if int(state[MODE]) >> stop & 1 or plan[numbers + par.KIND] != par.KELVIN_VOIGT:
        return False
    return bool(plan[numbers + par.RATE] * period < _FORGOTTEN)


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
    faces = max(state[FACES], 0.0), max(state[FACES + 1], 0.0)
    new_mode = 0
    for stop in range(2):
        kind = plan[par.stop_at(stop) + par.KIND]
        if kind == par.ABSENT:
            continue
        deformation = faces[stop]
        if kind == par.RIGID:
            u, touches = rigid.nearest_possible(plan, stop, mode, u, v)
            deformation = 0.0
        elif kind == par.KELVIN_VOIGT:
            deformation, touches = kelvin_voigt.nearest_possible(
                plan, stop, mode, u, v, deformation
            )
        else:
            deformation, touches = curved.nearest_possible(plan, stop, mode, u, deformation)
        if touches:
            new_mode |= 1 << stop
        faces = changed(faces, stop, deformation)
    z = min(max(state[MEMORY], -plan[par.YIELD]), plan[par.YIELD])
    pack(Motion(new_mode, new_mode, u, v, faces, z, 0.0, unpacked(state).clock), state)


@kernel
def point(plan: Vector, state: Vector, point: Vector) -> None:
    for i in range(PARTS):
        point[i] = state[FIRST + i]
    point[FACES + 1 - FIRST] = -point[FACES + 1 - FIRST]


@kernel
def at_point(plan: Vector, state: Vector, point: Vector) -> None:
    for i in range(PARTS):
        state[FIRST + i] = point[i]
    state[FACES + 1] = -state[FACES + 1]
    place(plan, state)


@kernel
def undisturbed(plan: Vector, state: Vector, dying: float, result: Vector) -> int:
    motion = unpacked(state)
    free, swing, felt, carried, motion = motions.undisturbed(plan, motion, motion.clock, dying)
    if not free:
        return 0
    pack(motion, state)
    rest, load = plan[par.LOAD] / plan[par.STIFFNESS], plan[par.LOAD]
    for i in range(MEASURES):
        result[i] = 0.0
    result[U_LEAST], result[U_MOST] = rest - swing, rest + swing
    result[A_LEAST], result[A_MOST] = -felt, felt
    result[T_LEAST], result[T_MOST] = load - carried, load + carried
    return 1


@kernel
def advance(plan: Vector, before: Vector, limit: float, ended: Vector, after: Vector) -> int:
    event, step, arrival, motion = advanced(plan, unpacked(before), limit)
    ended[STEP], ended[ARRIVAL] = step, arrival
    pack(motion, after)
    return event


@kernel
def _load(plan: Vector, kept: Vector, state: Vector, s: float, c: float) -> None:
    copy(kept, state, STATE)
    state[STATE], state[STATE + 1] = s, c


@kernel
def _put(plan: Vector, source: Vector, target: Vector) -> None:
    copy(source, target, STATE + 2)


@kernel
def _finite(plan: Vector, state: Vector) -> bool:
    return bool(abs(state[DISPLACEMENT]) < 1e200 and abs(state[VELOCITY]) < 1e200)  # and no NaN


def _advanced(plan: Any, before: Any, limit: Any, ended: Any, after: Any) -> Any:
    return advance(plan, before, limit, ended, after)


@overload(_advanced, jit_options=CHOSEN, strict=False)  # type: ignore[arg-type]
def _advanced_by_flow(plan: Any, before: Any, limit: Any, ended: Any, after: Any) -> Any:
    # Merged into the loop, tables of closed-form motion are a fifth faster; a Taylor step does not
    # notice, and would be compiled twice.
    return _called if plan.laws == par.BENT else advance.py_func  # type: ignore[attr-defined]


def _called(plan: Any, before: Any, limit: Any, ended: Any, after: Any) -> Any:
    return flow.advance(plan, before, limit, ended, after)


_cycle = event_loop.loop(_advanced, _load, _put, _finite, None)


@kernel
def cycle(plan: Vector, state: Vector, s: float, c: float, length: float, max_events: int) -> int:
    events: int = _cycle(plan, state, s, c, length, max_events)
    return events


@kernel
def look_again(plan: Vector, again: int) -> int:
    # The force on the base is that of ü + A_t, A_t what stands for the force on the mass: the
    # absolute acceleration of the same motion if the base moved.
    if again:
        if plan[par.BASE] != 0.0:
            return 0
        plan[par.BASE] = 1.0
    else:
        plan[par.BASE] = 0.0
    return 1


@kernel
def measured(plan: Vector, notes: Vector, other: Vector, cycles: int, result: Vector) -> None:
    copy(notes, result, NOTES)
    for stop in range(2):
        result[HITS + stop] = notes[HITS + stop] / cycles
    result[T_LEAST] = plan[par.LOAD] - other[A_MOST]
    result[T_MOST] = plan[par.LOAD] - other[A_LEAST]


def mirror_image(state: Vector) -> Vector:
    """Return the mirror image of a state vector: what moves right moves left."""
    image = state.copy()
    for at in (MODE, FRESH):
        image[at] = swapped(int(state[at]))
    for at in (DISPLACEMENT, VELOCITY, MEMORY):
        image[at] = -state[at]
    image[FACES], image[FACES + 1] = state[FACES + 1], state[FACES]
    return image
