"""The Fourier integrals of a motion, phase by phase, by the quadrature of its pieces."""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine.dispatch import (
    accelerated,
    begin,
    build,
    displacement,
    expanded,
    following,
    more,
    smooth,
)
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import horner
from vibroimpact.engine.linear.layout import ORDER, RATE, H
from vibroimpact.engine.measure import ABSCISSAE, P_C, P_LENGTH, P_S, WEIGHTS
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import LEFT, Motion, unpacked

_TURN = 8.0
"""What a line may turn (rad) over the points of one quadrature, for 12 points to be exact to
rounding."""

# Rows of what is found, a row a real number for each line: the integrals of u, u̇ and the absolute
# acceleration times cos and −sin νt.
QUANTITIES = 6


@kernel
def _stretch(
    plan: Vector, before: Motion, length: float, begun: float, lines: Vector, out: Vector
) -> None:
    """Add a stretch that begins `begun` seconds behind the motion's beginning."""
    series, forces = workspace(), workspace()
    sign = -1.0 if before.mode == LEFT else 1.0
    fastest = lines[len(lines) - 1]
    cursor = begin(plan, before, length)
    while more(plan, cursor):
        h = plan[cursor.table + H]
        rate = plan[cursor.table + RATE]
        high, s, c = expanded(plan, cursor, series)
        for n in range(ORDER):
            forces[n] = series[n]
        unit = accelerated(plan, cursor, s, c, forces)
        parts = 1 + int(fastest * h / _TURN)
        width = (high + 0.5) / parts
        for part in range(parts):
            for n in range(len(WEIGHTS)):
                y = width * (part + ABSCISSAE[n]) - 0.5
                x, slope = horner(series, y)
                a, _ = horner(forces, y)
                u, v = displacement(plan, before.mode, x), sign * slope * rate
                a *= sign * unit
                share = WEIGHTS[n] * width * h
                t = begun + cursor.t + (cursor.i + 0.5 + y) * h
                for k in range(len(lines)):
                    angle = lines[k] * t
                    cosine, sine = share * math.cos(angle), share * math.sin(angle)
                    out[0, k] += u * cosine
                    out[1, k] -= u * sine
                    out[2, k] += v * cosine
                    out[3, k] -= v * sine
                    out[4, k] += a * cosine
                    out[5, k] -= a * sine
        cursor = following(plan, cursor)


@entry("void(f8[::1], f8, f8, f8[:, ::1], f8[::1], f8[::1], f8[:, ::1])")
def integrate(
    given: Any,
    rig: Vector,
    amplitude: float,
    frequency: float,
    phases: Vector,
    begins: Vector,
    lines: Vector,
    out: Vector,
) -> None:
    """Integrate a motion times exp(−iνt).

    Parameters
    ----------
    rig, amplitude, frequency
        As in `batch.trajectory`.
    phases : ndarray, shape (phase, measure.PHASE)
        The phases.
    begins : ndarray, shape (phase,)
        When each begins (s).
    lines : ndarray, shape (line,)
        ν in rad/s, rising.
    out : ndarray, shape (QUANTITIES, line)
        Added to.
    """
    plan = planned(given, rig)
    build(plan, amplitude, 2.0 * math.pi * frequency)
    for i in range(len(phases)):
        phase = phases[i]
        here = unpacked(phase, (phase[P_S], phase[P_C]))
        length = phase[P_LENGTH]
        t = 0.0
        while t < length:
            step, behind = smooth(plan, here, length - t)
            _stretch(plan, here, step, begins[i] + t, lines, out)
            if step >= length - t:
                break  # what comes behind may be in another mode (as in `measure`)
            here = behind
            t += step
