"""Periodic orbits as solutions of P(z; p) = z, by Newton's method with the exact derivative."""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.matrix import solve
from vibroimpact.engine.memory import pointer, stack
from vibroimpact.engine.section_map import (
    CONTACTS,
    MODE,
    RESIDUAL,
    STEPS,
    begin_at,
    facts_buffer,
    point_buffer,
    section_map,
    system_plan,
)
from vibroimpact.engine.state import LARGEST, copy, notes_buffer, square_buffer, state_buffer
from vibroimpact.engine.status import DONE, NOT_FINITE, NOT_SETTLED
from vibroimpact.engine.steady_response import measure

_NEWTON_STEPS = 16
_GOOD = 1e-14  # residual over the scale at which nothing is left to gain
_ROUNDING = 2.0**-51
_DIFFERENCE = 1e-7  # of the parameter's scale; less where impacts make the map steep
_FARTHEST = 0.5  # scaled length of a Newton step

matrix_buffer = stack((LARGEST + 1) * (LARGEST + 1))


Line = tuple[Vector, Vector, float, int, bool, int, Vector]
"""base, direction, phase, count, mirror, max_events and scale, as in `correct`."""


@kernel
def _newton(
    plan: Vector,
    line: Line,
    tangent: Vector,
    point: Vector,
    facts: Vector,
    columns: Vector,
    slope: Vector,
) -> int:
    base, direction, phase, count, mirror, max_events, scale = line
    matrix = matrix_buffer()
    image, right = point_buffer(), point_buffer()
    aim, best_point = point_buffer(), point_buffer()
    parts = flow.parts(plan)  # behind which a point has its parameter
    size = parts + 1
    copy(point, aim, size)
    best = math.inf
    facts[STEPS] = 0.0
    last = False
    while True:
        amplitude, frequency = system_plan(base, direction, point[parts], plan)
        if not (frequency > 0.0 and amplitude > 0.0):
            return NOT_FINITE
        outcome = section_map(
            plan, frequency, phase, count, mirror, max_events, point, facts, image, columns
        )
        if outcome != DONE:
            return outcome
        residual = 0.0
        for i in range(parts):
            residual = max(residual, abs(image[i] - point[i]) / scale[i])
        if residual < best:
            best = residual
            copy(point, best_point, size)
        elif last:
            # Rounding lets it come no closer.
            copy(best_point, point, size)
        if last or residual <= _GOOD:
            break
        idle = facts[STEPS] >= 4 and residual > 0.25 * best and best < 1e-12
        if idle or facts[STEPS] >= _NEWTON_STEPS:
            last = True
            copy(best_point, point, size)
            continue
        _slope(plan, line, point, facts, image, columns, slope)
        for i in range(parts):
            for j in range(parts):
                matrix[i * size + j] = columns[j * parts + i] * scale[j] / scale[i]
            matrix[i * size + i] -= 1.0
            matrix[i * size + parts] = slope[i] * scale[parts] / scale[i]
            right[i] = -(image[i] - point[i]) / scale[i]
        right[parts] = 0.0
        for j in range(size):
            matrix[parts * size + j] = tangent[j]
            right[parts] -= tangent[j] * (point[j] - aim[j]) / scale[j]
        if not solve(matrix, right, size):
            return NOT_SETTLED
        longest = 0.0
        for j in range(size):
            longest = max(longest, abs(right[j]))
        if not longest < math.inf:
            return NOT_FINITE
        share = min(1.0, _FARTHEST / longest) if longest > 0.0 else 1.0
        for j in range(size):
            point[j] += share * right[j] * scale[j]
        facts[STEPS] += 1.0
    facts[RESIDUAL] = min(best, residual)
    _slope(plan, line, point, facts, image, columns, slope)
    return (
        DONE
        if facts[RESIDUAL] <= 1e-12 + _rounding(parts, point, columns, slope, scale)
        else NOT_SETTLED
    )


@kernel
def _rounding(parts: int, point: Vector, columns: Vector, slope: Vector, scale: Vector) -> float:
    """What rounding a point and the events on its way makes of P, over the scale.

    Behind the grazing of a very stiff stop P is so steep that no point comes closer to its image.
    """
    most = 0.0
    for i in range(parts):
        change = abs(slope[i] * point[parts])
        for j in range(parts):
            change += abs(columns[j * parts + i] * point[j])
        most = max(most, _ROUNDING * change / scale[i])
    return most


@kernel
def _slope(
    plan: Vector,
    line: Line,
    point: Vector,
    facts: Vector,
    image: Vector,
    columns: Vector,
    slope: Vector,
) -> None:
    """∂P/∂p by a difference, on the side on which the contacts are the same.

    At a grazing the derivative may jump; beside that of a rigid or a very stiff stop P is a square
    root, whose second derivative is the square of its first. It only steers: a step's end is judged
    by P alone.
    """
    base, direction, phase, count, mirror, max_events, scale = line
    # Of its derivative's elements those that no section within a contact makes large.
    parts, steep = flow.parts(plan), 1.0
    for i in range(flow.coordinates(plan)):
        steep = max(steep, abs(columns[i * parts + i]))
    size, shown = parts + 1, CONTACTS + flow.stops(plan)
    ignored = square_buffer()
    other, trial, seen = point_buffer(), point_buffer(), facts_buffer()
    for sign in range(2):
        copy(point, trial, size)
        copy(facts, seen, shown)
        step = (1.0 if sign == 0 else -1.0) * _DIFFERENCE * scale[parts] / steep
        _, frequency = system_plan(base, direction, point[parts] + step, plan)
        outcome = section_map(
            plan, frequency, phase, count, mirror, max_events, trial, seen, other, ignored
        )
        same = outcome == DONE
        for f in range(CONTACTS, shown):
            same = same and seen[f] == facts[f]
        if sign == 0 or same:
            for i in range(parts):
                slope[i] = (other[i] - image[i]) / step if outcome == DONE else 0.0
        if same:
            break


@entry(
    "i8(f8[::1], f8[::1], f8[::1], f8, i8, boolean, i8, f8[::1], f8[::1], f8[::1], f8[::1],"
    " f8[:, ::1], f8[::1])",
    "disturbed",
)
def correct(
    memory: Any,
    rig: Vector,
    base: Vector,
    direction: Vector,
    phase: float,
    count: int,
    mirror: bool,
    max_events: int,
    scale: Vector,
    tangent: Vector,
    point: Vector,
    facts: Vector,
    columns: Vector,
    slope: Vector,
) -> int:
    """Newton's method for P(z; p) = z on the plane through `point` normal to `tangent`.

    Parameters
    ----------
    rig : ndarray
        The rig near the solution, which chooses the flow.
    base, direction : ndarray, shape (numbers of the rig + 2,)
        The system at p = 0, and how it moves with p.
    phase : float
        Forcing phase of the section, rad.
    count, mirror : int, bool
        Cycles that P goes over; or half cycles, each followed by the mirror.
    max_events : int
        Events in one of them at which it gives up.
    scale : ndarray, shape (parts + 1,)
        Sizes by which the components are compared.
    tangent : ndarray, shape (parts + 1,)
        Normal of the plane, in scaled components; (0, …, 0, 1) holds the parameter.
    point : ndarray, shape (parts + 1,)
        Where to begin; the solution.
    facts : ndarray, shape (section_map.CONTACTS + stops,)
        The mode at the section, on entry; written.
    columns : ndarray, shape (parts, parts)
        Written: row i is what becomes of a unit disturbance of component i.
    slope : ndarray, shape (parts,)
        Written: ∂P/∂p.

    Returns
    -------
    outcome
        DONE, NOT_SETTLED (the residual stays above 1e-12 of the scale and what rounding explains),
        or what went wrong.
    """
    plan = planned(memory, rig)
    line = (pointer(base), pointer(direction), phase, count, mirror, max_events, pointer(scale))
    return _newton(
        plan,
        line,
        pointer(tangent),
        pointer(point),
        pointer(facts),
        pointer(columns),
        pointer(slope),
    )


@entry(
    "i8(f8[::1], f8[::1], f8[::1], f8, i8, boolean, i8, f8[::1], f8[::1], f8[::1], f8[:, ::1],"
    " f8[::1], f8[::1])",
    "disturbed",
)
def evaluate(
    memory: Any,
    rig: Vector,
    base: Vector,
    direction: Vector,
    phase: float,
    count: int,
    mirror: bool,
    max_events: int,
    scale: Vector,
    point: Vector,
    facts: Vector,
    columns: Vector,
    slope: Vector,
    image: Vector,
) -> int:
    """P and its derivative at a point that need not be an orbit; see `correct`.

    The state is moved to where it can be; `image`, shape (parts,), receives P.
    """
    plan = planned(memory, rig)
    line = (pointer(base), pointer(direction), phase, count, mirror, max_events, pointer(scale))
    at, seen, end_point, q = pointer(point), pointer(facts), pointer(image), pointer(columns)
    parts = flow.parts(plan)
    _, frequency = system_plan(line[0], line[1], at[parts], plan)
    outcome = section_map(plan, frequency, phase, count, mirror, max_events, at, seen, end_point, q)
    for i in range(parts):
        seen[RESIDUAL] = max(seen[RESIDUAL], abs(end_point[i] - at[i]) / scale[i])
    if outcome == DONE:
        _slope(plan, line, at, seen, end_point, q, pointer(slope))
    return outcome


@entry("i8(f8[::1], f8, f8[::1], f8[::1], i8, i8, f8[::1])")
def measure_orbit(
    memory: Any,
    system: Vector,
    phase: float,
    point: Vector,
    facts: Vector,
    cycles: int,
    max_events: int,
    result: Vector,
) -> int:
    """Exact extremes and contact counts of an orbit, as `steady_response.measure` writes them."""
    plan = planned(memory, system)
    frequency = system[flow.numbers(plan) + 1]
    flow.build(plan, system[flow.numbers(plan)], 2.0 * math.pi * frequency)
    state = state_buffer()
    begin_at(plan, state, facts[MODE], phase, pointer(point))
    s, c = math.sin(phase), math.cos(phase)
    period = 1.0 / frequency
    return measure(plan, state, s, c, period, cycles, max_events, pointer(result), None)


@entry("f8(f8[::1], f8, i8, i8, f8[::1], f8[::1])", "disturbed")
def grazing_margin(
    memory: Any,
    system: Vector,
    phase: float,
    cycles: int,
    max_events: int,
    point: Vector,
    facts: Vector,
) -> float:
    """Signed distance of a motion from grazing (m).

    Parameters
    ----------
    system : ndarray, shape (numbers of the rig + 2,)
        The rig and its forcing.
    phase : float
        Of the section, rad.
    cycles : int
        Forcing cycles to follow.
    max_events : int
        Events in a cycle at which it gives up.
    point, facts : ndarray
        The state at the section and its mode, as in `orbit.correct`.

    Returns
    -------
    float
        Positive: the least clearance at which the mass turns back in flight. Negative: the least
        depth at which it turns back in a contact, or would without a rigid stop. The one of least
        size; NaN if given up.
    """
    plan = planned(memory, system)
    frequency = system[flow.numbers(plan) + 1]
    flow.build(plan, system[flow.numbers(plan)], 2.0 * math.pi * frequency)
    period = 1.0 / frequency
    if flow.too_much_work(plan, period) != 0:
        return math.nan
    state, notes = state_buffer(), notes_buffer()
    begin_at(plan, state, facts[MODE], phase, pointer(point))
    s, c = math.sin(phase), math.cos(phase)
    notes[0] = math.inf
    for _ in range(cycles):
        if event_loop.margin(plan, state, s, c, period, max_events, notes) > max_events:
            return math.nan
    least: float = notes[0]
    return least
