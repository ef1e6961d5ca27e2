"""One phase measured: extremes, force, impulse, work and losses, exact to rounding.

On a piece the motion is a series of 12 terms; Gauss–Legendre quadrature with 12 points integrates a
product of two such series without error, and a law's force of one to rounding.
"""

from __future__ import annotations

import math

import numpy as np

from vibroimpact.engine import parameters as par
from vibroimpact.engine.dispatch import (
    accelerated,
    acceleration,
    begin,
    coordinate,
    expanded,
    expanded_force,
    following,
    isolator_power,
    moment,
    more,
    rest_level,
    smooth,
    stop_power,
    stop_push,
    unkept,
)
from vibroimpact.engine.forcing.dispatch import change_rate, pull_series
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import horner
from vibroimpact.engine.linear.layout import RATE, H
from vibroimpact.engine.linear.stops import rigid
from vibroimpact.engine.linear.tables import resting
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import BOTH, LEFT, RIGHT, STATE, Motion
from vibroimpact.engine.observers.extremes import series_extremes

_X, _W = np.polynomial.legendre.leggauss(12)
ABSCISSAE = tuple(float(x) for x in 0.5 * _X + 0.5)
WEIGHTS = tuple(float(w) for w in 0.5 * _W)

# Columns of a phase to be measured: the state at its beginning, the forcing's clock, the length (s)
# and the side (RIGHT, LEFT or 0) whose stop is asked about.
P_S, P_C, P_LENGTH, P_SIDE = range(STATE, STATE + 4)
PHASE = STATE + 4

# Columns of what is found; forces and energies per unit mass. x is the displacement, or the
# deformation of the stop that is asked about, towards it; the acceleration is that in the direction
# of u. What is lost is that of the isolator and of either stop.
X_LEAST, X_MOST, A_LEAST, A_MOST, A_TIME, FORCE, IMPULSE, WORK = range(8)
LOST, LOST_RIGHT, LOST_LEFT = range(8, 11)
MEASURES = 11

_HALT = 1e-5
"""Of what is left of a phase: a step that comes no farther."""
_HALTS = 16
"""Such steps in a row, after which a phase as short as rounding is taken as one piece."""
_SHORT = 1e-9  # rad of the forcing
_TURNS = 1000
"""Such steps in a row, after which a longer phase is given up: all its measures are unknown."""


@kernel
def measure_stretch(
    plan: Vector, before: Motion, length: float, begun: float, side: int, out: Vector
) -> None:
    """Add a stretch of a phase that begins `begun` seconds behind the phase's beginning."""
    series, shaking = workspace(), workspace()
    mode = before.mode
    sign = -1.0 if mode == LEFT else 1.0
    held = side != 0 and resting(plan, mode) and rigid(plan, side)
    facing = sign if side == RIGHT else -sign
    level = rest_level(plan, before, side) if held else 0.0
    cursor = begin(plan, before, length)
    while more(plan, cursor):
        h = plan[cursor.table + H]
        rate = plan[cursor.table + RATE]
        high, s, c = expanded(plan, cursor, series)
        width = high + 0.5
        pull_series(plan, cursor.table, s, c, shaking)
        for n in range(len(WEIGHTS)):
            y = width * ABSCISSAE[n] - 0.5
            share = WEIGHTS[n] * width * h
            x, slope = horner(series, y)
            v = slope * rate
            drive, _ = horner(shaking, y)
            drive *= rate * rate
            here = moment(plan, cursor, before, x, sign * v, y)
            out[WORK] += share * v * drive
            out[LOST] += share * isolator_power(plan, here)
            if held:
                out[IMPULSE] += share * max(level - facing * drive, 0.0)
            elif side:
                out[IMPULSE] += share * stop_push(plan, here, side)
            if mode & RIGHT:
                out[LOST_RIGHT] += share * stop_power(plan, here, RIGHT)
            if mode & LEFT:
                out[LOST_LEFT] += share * stop_power(plan, here, LEFT)
        x_least, x_most, _, _ = series_extremes(series, -0.5, high, out[X_LEAST], out[X_MOST])
        out[X_LEAST], out[X_MOST] = x_least, x_most
        unit = accelerated(plan, cursor, s, c, series)
        was_least, was_most = out[A_LEAST] / unit, out[A_MOST] / unit
        least, most, at_least, at_most = series_extremes(series, -0.5, high, was_least, was_most)
        out[A_LEAST], out[A_MOST] = least * unit, most * unit
        since = begun + cursor.t + (cursor.i + 0.5) * h
        if least < was_least and -least > most:
            out[A_TIME] = since + at_least * h
        if most > was_most and most >= -least:
            out[A_TIME] = since + at_most * h
        if held:
            least, most, _, _ = series_extremes(shaking, -0.5, high, math.inf, -math.inf)
            pulled = least if facing > 0.0 else -most
            out[FORCE] = max(out[FORCE], level - pulled * rate * rate)
        elif side:
            expanded_force(plan, cursor, mode, side, series)
            _, force, _, _ = series_extremes(series, -0.5, high, 0.0, out[FORCE])
            out[FORCE] = force
        cursor = following(plan, cursor)


@kernel
def measure_phase(plan: Vector, before: Motion, length: float, side: int, out: Vector) -> None:
    """Measure one phase from its beginning, as the stop on a side sees it.

    All measures are NaN where the phase cannot be followed.
    """
    mode = before.mode
    x = coordinate(plan, before)
    a = acceleration(plan, before)
    a = -a if mode == LEFT else a
    for i in range(MEASURES):
        out[i] = 0.0
    out[X_LEAST], out[X_MOST] = x, x
    out[A_LEAST], out[A_MOST] = a, a
    t = 0.0
    here = before
    halts = 0  # in a row
    while t < length:
        step, behind = smooth(plan, here, length - t)
        halts = halts + 1 if step <= _HALT * (length - t) else 0
        if halts > _TURNS:
            for i in range(MEASURES):
                out[i] = math.nan
            return
        if halts > _HALTS and (length - t) * change_rate(plan) < _SHORT:
            step, behind = length - t, here
        measure_stretch(plan, here, step, t, side, out)
        out[LOST_RIGHT] += unkept(plan, here, behind, RIGHT)
        out[LOST_LEFT] += unkept(plan, here, behind, LEFT)
        if step >= length - t:
            break  # what comes behind may be in another mode, however the sum of times is rounded
        here = behind
        t += step
    least, most = out[A_LEAST], out[A_MOST]
    if mode == LEFT:
        out[A_LEAST], out[A_MOST] = -most, -least
    if mode == BOTH and side == LEFT:
        apart = plan[par.BUMPER + par.GAP] + plan[par.BUMPER + par.WIDTH + par.GAP]
        x_least, x_most = out[X_LEAST], out[X_MOST]
        out[X_LEAST], out[X_MOST] = -x_most - apart, -x_least - apart
