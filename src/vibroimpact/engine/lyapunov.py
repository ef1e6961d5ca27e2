"""Growth of disturbances: over an orbit (monodromy matrix) and on average (Lyapunov exponents)."""

from __future__ import annotations

import math

import numpy as np

from vibroimpact.engine import parameters as par
from vibroimpact.engine.hold import (
    AGE,
    DONE,
    FRESH,
    LEFT_BUMPER,
    MODE,
    NOT_FINITE,
    RIGHT_BUMPER,
    TOO_MANY_EVENTS,
    TOO_MUCH_WORK,
    U,
    V,
)
from vibroimpact.engine.jit import Vector, entry, kernel
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.phase import FLIGHT, LEFT, LIMIT, PLAN, RIGHT, build
from vibroimpact.engine.tangent import (
    DISTURBANCE,
    disturb,
    disturb_area,
    disturbed_cycle,
    press_area,
)
from vibroimpact.engine.trajectory import advance, cycle, too_much_work

# Columns of what one cycle shows: logarithms of the growth of two disturbances, the integral of
# the damping, and the state at the section behind the cycle.
FIRST, SECOND, DISSIPATION, SECTION = range(4)
GROWTH = SECTION + 4

AREA = 6
"""Components of the area that two disturbances span, see `tangent.disturb_area`."""

_RANGE = 150.0  # twice this may pass between two looks; the square of exp(−300) is a number


@kernel
def normalise(q: Vector, w: Vector, weight: float, mode: int) -> tuple[float, float]:
    """Bring a disturbance and an area to unit size; return the logarithms of their sizes.

    The norm of a disturbance is weight² (u² + u_R² + u_L²) + v², that of an area the one that
    belongs to it. A pressed bumper moves with the mass and is left out.
    """
    w2 = weight * weight
    right = 0.0 if mode == RIGHT else 1.0
    left = 0.0 if mode == LEFT else 1.0
    length = math.sqrt(
        (w2 * q[0, 0] ** 2 + q[0, 1] ** 2) + w2 * (right * q[0, 2] ** 2 + left * q[0, 3] ** 2)
    )
    area = weight * math.sqrt(
        (w[0] ** 2 + right * w[3] ** 2 + left * w[4] ** 2)
        + w2 * (right * w[1] ** 2 + left * w[2] ** 2 + right * left * w[5] ** 2)
    )
    for j in range(DISTURBANCE):
        q[0, j] /= length
    for j in range(AREA):
        w[j] /= area
    return math.log(length), math.log(area)


@kernel
def _growth(
    plan: Vector,
    amplitude: float,
    frequency: float,
    phase: float,
    state: Vector,
    transient: int,
    discard: int,
    max_events: int,
    out: Vector,
) -> tuple[int, int]:
    period = 1.0 / frequency
    build(plan, amplitude, 2.0 * math.pi * frequency)
    if too_much_work(plan, period):
        return TOO_MUCH_WORK, 0
    s0, c0 = math.sin(phase), math.cos(phase)
    mode, fresh = int(state[MODE]), int(state[FRESH])
    u, v = state[U], state[V]
    right, left, age = state[RIGHT_BUMPER], state[LEFT_BUMPER], state[AGE]
    weight = math.sqrt(plan[par.STIFFNESS])
    q = np.zeros((1, DISTURBANCE))
    w = np.zeros(AREA)
    q[0, 0], q[0, 1], w[0] = 1.0, weight, 1.0
    if mode != FLIGHT:
        q[0, 1 + mode] = 1.0
    press_area(mode, w)
    normalise(q, w, weight, mode)
    outcome = DONE
    number = -transient - discard
    while outcome == DONE and number < len(out):
        # A cycle that is given up leaves the state of its section.
        section = (mode, fresh, u, v, right, left, age)
        events = 0
        if number < -discard:
            events, mode, fresh, u, v, right, left, age, _, _ = cycle(
                plan, mode, fresh, u, v, right, left, age, s0, c0, period, max_events
            )
        else:
            t = 0.0
            first = 0.0
            both = 0.0
            damping = 0.0
            shrunk = 0.0
            s, c = s0, c0
            while True:
                was = mode
                event, step, mode, fresh, u, v, s, c, right, left, age = advance(
                    plan, mode, fresh, u, v, s, c, right, left, period - t, age
                )
                here = plan[par.DAMPING]
                if was != FLIGHT:
                    here += plan[par.BUMPER + par.WIDTH * (was - 1) + par.BUMPER_DAMPING]
                damping += here * step
                # In pieces over which nothing shrinks below the range of numbers.
                pieces = 1 + int((here + weight) * step / _RANGE)
                for piece in range(1, pieces + 1):
                    last = piece == pieces
                    end, behind = (event, mode) if last else (LIMIT, was)
                    disturb(plan, was, end, behind, step / pieces, q)
                    disturb_area(plan, was, end, behind, step / pieces, w)
                    shrunk += (here + weight) * step / pieces
                    if shrunk > _RANGE or (last and (event == LIMIT or t + step >= period)):
                        more, more_both = normalise(q, w, weight, behind)
                        first += more
                        both += more_both
                        shrunk = 0.0
                if event == LIMIT:
                    break
                t += step
                events += 1
                if events > max_events or t >= period:
                    break
            if number >= 0 and events <= max_events:
                row = out[number]
                row[FIRST], row[SECOND], row[DISSIPATION] = first, both - first, damping
                row[SECTION], row[SECTION + 1] = u, v
                row[SECTION + 2], row[SECTION + 3] = right, -left
        if events > max_events:
            outcome = TOO_MANY_EVENTS
        elif not (abs(u) < 1e200 and abs(v) < 1e200):
            outcome = NOT_FINITE
        if outcome != DONE:
            mode, fresh, u, v, right, left, age = section
            break
        number += 1
    state[MODE], state[FRESH], state[U], state[V] = mode, fresh, u, v
    state[RIGHT_BUMPER], state[LEFT_BUMPER], state[AGE] = right, left, age
    return outcome, max(number, 0)


@entry("UniTuple(i8, 2)(f8[::1], f8, f8, f8, f8[::1], i8, i8, i8, f8[:, ::1])")
def growth(
    rig: Vector,
    amplitude: float,
    frequency: float,
    phase: float,
    state: Vector,
    transient: int,
    discard: int,
    max_events: int,
    out: Vector,
) -> tuple[int, int]:
    """Follow a motion and the growth of its two fastest disturbances, cycle by cycle.

    Parameters
    ----------
    rig, amplitude, frequency, phase, state, max_events
        As in `batch.trajectory`; the state is carried on.
    transient : int
        Forcing cycles before anything is watched.
    discard : int
        Cycles in which the disturbances turn into their directions.
    out : ndarray, shape (cycles, GROWTH)
        Written, a row a cycle.

    Returns
    -------
    outcome, done
        A `Status`, and the number of rows written.
    """
    memory = np.zeros(PLAN)
    memory[: par.SIZE] = rig
    ended = _growth(
        pointer(memory), amplitude, frequency, phase, state, transient, discard, max_events, out
    )
    memory[0] = 0.0  # keeps it alive until here
    return ended


@entry("i8(f8[::1], f8, f8, f8, f8[::1], i8, i8, f8[:, ::1], f8[::1])")
def monodromy(
    rig: Vector,
    amplitude: float,
    frequency: float,
    phase: float,
    state: Vector,
    cycles: int,
    max_events: int,
    columns: Vector,
    damping: Vector,
) -> int:
    """Derivative of the state after some cycles with respect to the state now.

    Parameters
    ----------
    columns : ndarray, shape (DISTURBANCE, DISTURBANCE)
        Written: row i is what becomes of a unit disturbance of component i. Where the section
        lies in a contact, the pressed bumper has no disturbance of its own: its row is zero,
        and that of the displacement moves it along.
    damping : ndarray, shape (1,)
        Written: the integral of the damping per unit mass, pressed bumpers included.
    rig, amplitude, frequency, phase, state, max_events
        As in `growth`.

    Returns
    -------
    outcome
        A `Status`.
    """
    memory = np.zeros(PLAN)
    memory[: par.SIZE] = rig
    plan = pointer(memory)
    period = 1.0 / frequency
    build(plan, amplitude, 2.0 * math.pi * frequency)
    outcome = DONE
    if too_much_work(plan, period):
        outcome = TOO_MUCH_WORK
    s, c = math.sin(phase), math.cos(phase)
    mode, fresh = int(state[MODE]), int(state[FRESH])
    u, v = state[U], state[V]
    right, left, age = state[RIGHT_BUMPER], state[LEFT_BUMPER], state[AGE]
    columns[:] = 0.0
    for i in range(DISTURBANCE):
        columns[i, i] = 1.0
    if mode != FLIGHT:
        columns[0, 1 + mode] = 1.0
        columns[1 + mode] = 0.0
    damping[0] = 0.0
    done = 0
    while outcome == DONE and done < cycles:
        events, mode, fresh, u, v, right, left, age, more, _, _ = disturbed_cycle(
            plan, mode, fresh, u, v, right, left, age, s, c, period, max_events, columns
        )
        damping[0] += more
        done += 1
        if events > max_events:
            outcome = TOO_MANY_EVENTS
    state[MODE], state[FRESH], state[U], state[V] = mode, fresh, u, v
    state[RIGHT_BUMPER], state[LEFT_BUMPER], state[AGE] = right, left, age
    memory[0] = 0.0  # keeps the memory alive until here
    return outcome
