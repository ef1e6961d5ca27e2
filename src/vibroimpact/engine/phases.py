"""Phases of a motion, each begun from its state: measured, and integrated against sines."""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine import flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.measure import P_C, P_LENGTH, P_S, P_SIDE
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.state import load, room


@entry("void(f8[::1], f8, f8, f8[:, ::1], f8[:, ::1])", "measured")
def measure_phases(
    given: Any, rig: Vector, amplitude: float, frequency: float, phases: Vector, out: Vector
) -> None:
    """Measure phases of a motion.

    Parameters
    ----------
    rig, amplitude, frequency
        As in `batch.trajectory`.
    phases : ndarray, shape (phase, measure.PHASE)
        The phases.
    out : ndarray, shape (phase, measure.MEASURES)
        Written.
    """
    plan = planned(given, rig)
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    here = room()
    for i in range(len(phases)):
        phase = phases[i]
        load(plan, pointer(phase), here, phase[P_S], phase[P_C])
        flow.measure_phase(plan, here, phase[P_LENGTH], int(phase[P_SIDE]), pointer(out[i]))


@entry("void(f8[::1], f8, f8, f8[:, ::1], f8[::1], f8[::1], f8[:, ::1])", "measured")
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
    out : ndarray, shape (fourier.QUANTITIES, line)
        Added to.
    """
    plan = planned(given, rig)
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    here = room()
    for i in range(len(phases)):
        phase = phases[i]
        load(plan, pointer(phase), here, phase[P_S], phase[P_C])
        flow.integrate_phase(
            plan, here, phase[P_LENGTH], begins[i], pointer(lines), len(lines), pointer(out)
        )
