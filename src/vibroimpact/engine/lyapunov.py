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
from vibroimpact.engine.phase import FLIGHT, LEFT, PLAN, RIGHT, build
from vibroimpact.engine.tangent import DISTURBANCE, disturbed_cycle
from vibroimpact.engine.trajectory import cycle, too_much_work

# Columns of what one cycle shows: logarithms of the growth of two disturbances, the integral of
# the damping, and the state at the section behind the cycle.
FIRST, SECOND, DISSIPATION, SECTION = range(4)
GROWTH = SECTION + 4


@kernel
def orthonormalise(q: Vector, weight: float, mode: int) -> None:
    """Gram–Schmidt on the rows of q[1:], in the norm weight² (u² + u_R² + u_L²) + v².

    A pressed bumper moves with the mass and is left out. q[0] receives the logarithms of the
    lengths.
    """
    w2 = weight * weight
    right = 0.0 if mode == RIGHT else w2
    left = 0.0 if mode == LEFT else w2
    for i in range(1, len(q)):
        for other in range(1, i):
            dot = (w2 * q[i, 0] * q[other, 0] + q[i, 1] * q[other, 1]) + (
                right * q[i, 2] * q[other, 2] + left * q[i, 3] * q[other, 3]
            )
            for j in range(DISTURBANCE):
                q[i, j] -= dot * q[other, j]
        length = math.sqrt(
            (w2 * q[i, 0] ** 2 + q[i, 1] ** 2) + (right * q[i, 2] ** 2 + left * q[i, 3] ** 2)
        )
        q[0, i - 1] = math.log(length)
        for j in range(DISTURBANCE):
            q[i, j] /= length


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
    s, c = math.sin(phase), math.cos(phase)
    mode, fresh = int(state[MODE]), int(state[FRESH])
    u, v = state[U], state[V]
    right, left, age = state[RIGHT_BUMPER], state[LEFT_BUMPER], state[AGE]
    outcome = DONE
    for _ in range(transient):
        events, mode, fresh, u, v, right, left, age, _, _ = cycle(
            plan, mode, fresh, u, v, right, left, age, s, c, period, max_events
        )
        if events > max_events:
            outcome = TOO_MANY_EVENTS
            break
    weight = math.sqrt(plan[par.STIFFNESS])
    q = np.zeros((3, DISTURBANCE))
    q[1, 0], q[2, 1] = 1.0, 1.0
    if mode != FLIGHT:
        q[1, 1 + mode] = 1.0
    orthonormalise(q, weight, mode)
    done = -discard
    while outcome == DONE and done < len(out):
        events, mode, fresh, u, v, right, left, age, damping, _, _ = disturbed_cycle(
            plan, mode, fresh, u, v, right, left, age, s, c, period, max_events, q[1:]
        )
        if events > max_events:
            outcome = TOO_MANY_EVENTS
            break
        if not (abs(u) < 1e200 and abs(v) < 1e200):
            outcome = NOT_FINITE
            break
        orthonormalise(q, weight, mode)
        if done >= 0:
            row = out[done]
            row[FIRST], row[SECOND], row[DISSIPATION] = q[0, 0], q[0, 1], damping
            row[SECTION], row[SECTION + 1] = u, v
            row[SECTION + 2], row[SECTION + 3] = right, -left
        done += 1
    state[MODE], state[FRESH], state[U], state[V] = mode, fresh, u, v
    state[RIGHT_BUMPER], state[LEFT_BUMPER], state[AGE] = right, left, age
    return outcome, max(done, 0)


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
