"""One phase measured: extremes, force, impulse and work, exact to rounding.

On a table's interval the motion is a series of 12 terms; Gauss–Legendre quadrature with 12
points integrates a product of two such series without error.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from vibroimpact.engine import parameters as par
from vibroimpact.engine.dispatch import build
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flows import planned
from vibroimpact.engine.forcing.dispatch import pull_series
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import absolute_acceleration, horner
from vibroimpact.engine.linear.layout import RATE, RESTING, SIZE, TABLES, H
from vibroimpact.engine.linear.pieces import (
    accelerated,
    expanded,
    expanded_force,
    following,
    more,
    window,
)
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import BOTH, FLIGHT, LEFT, RIGHT, SEEN_LEFT, Row
from vibroimpact.engine.observers.extremes import series_extremes

_X, _W = np.polynomial.legendre.leggauss(12)
_ABSCISSAE = tuple(float(x) for x in 0.5 * _X + 0.5)
_WEIGHTS = tuple(float(w) for w in 0.5 * _W)

# Columns of a phase to be measured: mode, x, x′, the forcing's clock, the length (s). In contact
# x is the bumper's deformation and x′ its rate, both towards the bumper; the clock is not mirrored.
P_MODE, P_X, P_V, P_S, P_C, P_LENGTH = range(6)
PHASE = 6

# Columns of what is found; forces and energies per unit mass. A left contact's are mirrored
# back: all but x, force and impulse are as seen in the direction of u.
X_LEAST, X_MOST, A_LEAST, A_MOST, A_TIME, FORCE, IMPULSE, SQUARES, WORK = range(9)
MEASURES = 9


@kernel
def rest_level(plan: Vector, mode: int) -> float:
    """What presses a resting mass on its rigid stop but for the base: the force per unit mass."""
    side = LEFT if mode in (LEFT, SEEN_LEFT) else RIGHT
    at = par.BUMPER + par.WIDTH * (side - 1)
    load = plan[par.LOAD] if side == RIGHT else -plan[par.LOAD]
    level: float = load - plan[par.STIFFNESS] * plan[at + par.GAP]
    if mode in (BOTH, SEEN_LEFT):
        other = par.BUMPER + par.WIDTH * (2 - side)
        level -= plan[other + par.BUMPER_STIFFNESS] * (plan[at + par.GAP] + plan[other + par.GAP])
    return level


@kernel
def measure_phase(plan: Vector, mode: int, row: Row, length: float, out: Vector) -> None:
    """Measure one phase from its start, which is mirrored for a left contact."""
    series, shaking = workspace(), workspace()
    x_least, x_most = row.x, row.x
    a = absolute_acceleration(plan, mode, row)
    a_least, a_most, a_time = a, a, 0.0
    force = 0.0
    impulse = 0.0
    squares = 0.0
    work = 0.0
    level = rest_level(plan, mode)
    cursor = window(plan, TABLES + SIZE * mode, length, 0.0, 0.0, row)
    while more(plan, cursor):
        h = plan[cursor.table + H]
        rate = plan[cursor.table + RATE]
        high, ms, mc = expanded(plan, cursor, series)
        width = high + 0.5
        pull_series(plan, cursor.table, ms, mc, shaking)
        for n in range(len(_WEIGHTS)):
            y = width * _ABSCISSAE[n] - 0.5
            _, slope = horner(series, y)
            v = slope * rate
            drive, _ = horner(shaking, y)
            squares += _WEIGHTS[n] * width * h * v * v
            work += _WEIGHTS[n] * width * h * v * drive * rate * rate
        x_least, x_most, _, _ = series_extremes(series, -0.5, high, x_least, x_most)
        unit = accelerated(plan, cursor, ms, mc, series)
        was_least, was_most = a_least / unit, a_most / unit
        least, most, at_least, at_most = series_extremes(series, -0.5, high, was_least, was_most)
        a_least, a_most = least * unit, most * unit
        if least < was_least and -least > most:
            a_time = cursor.t + (cursor.i + 0.5 + at_least) * h
        if most > was_most and most >= -least:
            a_time = cursor.t + (cursor.i + 0.5 + at_most) * h
        if plan[cursor.table + RESTING] != 0.0:
            for n in range(len(_WEIGHTS)):
                drive, _ = horner(shaking, width * _ABSCISSAE[n] - 0.5)
                push = level - drive * rate * rate
                impulse += _WEIGHTS[n] * width * h * push
            least, _, _, _ = series_extremes(shaking, -0.5, high, math.inf, -math.inf)
            force = max(force, level - least * rate * rate)
        elif mode != FLIGHT:
            expanded_force(plan, cursor, series)
            for n in range(len(_WEIGHTS)):
                value, _ = horner(series, width * _ABSCISSAE[n] - 0.5)
                impulse += _WEIGHTS[n] * width * h * value
            _, force, _, _ = series_extremes(series, -0.5, high, 0.0, force)
        cursor = following(plan, cursor)
    if mode in (LEFT, SEEN_LEFT):
        a_least, a_most = -a_most, -a_least
    out[X_LEAST], out[X_MOST] = x_least, x_most
    out[A_LEAST], out[A_MOST], out[A_TIME] = a_least, a_most, a_time
    out[FORCE], out[IMPULSE], out[SQUARES] = force, impulse, squares
    out[WORK] = work  # ∫ v A_t dt keeps its sign where both are mirrored


@entry("void(f8[::1], f8, f8, f8[:, ::1], f8[:, ::1])")
def measure_phases(
    given: Any, rig: Vector, amplitude: float, frequency: float, phases: Vector, out: Vector
) -> None:
    """Measure phases of a motion.

    Parameters
    ----------
    rig, amplitude, frequency
        As in `batch.trajectory`.
    phases : ndarray, shape (phase, PHASE)
        The phases.
    out : ndarray, shape (phase, MEASURES)
        Written.
    """
    plan = planned(given, rig)
    build(plan, amplitude, 2.0 * math.pi * frequency)
    for i in range(len(phases)):
        phase = phases[i]
        mode = int(phase[P_MODE])
        sign = -1.0 if mode in (LEFT, SEEN_LEFT) else 1.0
        row = Row(phase[P_X], phase[P_V], sign * phase[P_S], sign * phase[P_C])
        measure_phase(plan, mode, row, phase[P_LENGTH], out[i])
