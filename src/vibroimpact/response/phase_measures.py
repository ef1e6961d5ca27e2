"""The phases of a motion as the engine reads them, and measured by it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import measure
from vibroimpact.engine import motion as layout
from vibroimpact.engine import parameters as par
from vibroimpact.engine.motion import LEFT, RIGHT
from vibroimpact.engine.phases import measure_phases
from vibroimpact.model import Bumper, Record
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import engine_rig
from vibroimpact.response.motion_phases import MEMORY, SIDES, Phases, Recorded, touches

_Array = NDArray[np.float64]


def view(parts: Phases) -> NDArray[np.int64]:
    """The side from which each phase is measured by itself: of both that of the right stop."""
    return np.where(parts.contact == 2, 1, parts.contact)


def measured(origin: Recorded[Any], parts: Phases, side: NDArray[np.int64] | None = None) -> _Array:
    """Measure phases: rows of `engine.measure`, per unit mass, as the stop on a side sees them."""
    return _measured(origin, parts, view(parts) if side is None else side, *asked(origin))


def transmitted_extremes(origin: Recorded[Any], parts: Phases, rows: _Array) -> tuple[float, float]:
    """Return the smallest and the largest force of isolator and stops on the base (N).

    It is F_0 − M (ü + A_t), F_0 the constant force and A_t the acceleration of the base, or what
    stands for a force on the mass. Under such a force the phases are measured once more, as if the
    base moved.

    Parameters
    ----------
    rows
        What `measured` found of the phases.
    """
    if not (isinstance(origin.excitation, Record) or origin.excitation.moves_base):
        rig, size, frequency = asked(origin)
        rig[par.BASE] = 1.0
        rows = _measured(origin, parts, view(parts), rig, size, frequency)
    mass, load = origin.oscillator.mass, origin.oscillator.force
    low, high = float(rows[:, measure.A_LEAST].min()), float(rows[:, measure.A_MOST].max())
    return load - mass * high, load - mass * low


def _measured(
    origin: Recorded[Any],
    parts: Phases,
    side: NDArray[np.int64],
    rig: _Array,
    size: float,
    frequency: float,
) -> _Array:
    found = np.zeros((len(side), measure.MEASURES))
    measure_phases(rig, size, frequency, table(origin, parts, side), found)
    return found


def asked(origin: Recorded[Any]) -> tuple[_Array, float, float]:
    """The rig, size and frequency that the engine receives for phases of a motion."""
    shaken = origin.excitation
    size, frequency = 0.0, 0.0
    if isinstance(shaken, Record):
        size = shaken.peak
        if size:
            steepest = float(np.abs(np.diff(shaken.acceleration)).max()) / shaken.step
            frequency = steepest / size / math.tau
    else:
        size, frequency = shaken.amplitude, shaken.frequency
    return engine_rig(Rig(origin.oscillator, shaken)), size, frequency


def table(origin: Recorded[Any], parts: Phases, side: NDArray[np.int64]) -> _Array:
    """Phases as the engine reads them, for the stops on a side."""
    rows = np.zeros((len(side), measure.PHASE))
    right, left = (touches(parts.contact, one) for one in SIDES)
    rows[:, layout.MODE] = np.where(right, RIGHT, 0) + np.where(left, LEFT, 0)
    rows[:, layout.FRESH] = parts.fresh
    rows[:, [layout.U, layout.V, layout.RIGHT_BUMPER]] = parts.first[:, :3]
    rows[:, layout.LEFT_BUMPER] = -parts.first[:, 3]
    rows[:, layout.ISOLATOR] = parts.first[:, MEMORY]
    stops = (origin.oscillator.right, origin.oscillator.left)
    for i, (stop, pressed) in enumerate(zip(stops, (right, left), strict=True)):
        if not isinstance(stop, Bumper):
            rows[:, layout.RIGHT_BUMPER + i] = np.where(pressed, parts.met[:, i], 0.0)
    rows[:, [measure.P_S, measure.P_C]] = parts.clock
    rows[:, measure.P_LENGTH] = parts.length
    rows[:, measure.P_SIDE] = np.select([side == 1, side == -1], [RIGHT, LEFT], 0)
    return rows
