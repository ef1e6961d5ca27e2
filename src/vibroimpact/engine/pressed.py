"""What the stops bear in steady motions that a sweep has found."""

from __future__ import annotations

import math
from typing import Any

from numpy.typing import NDArray

from vibroimpact.engine.dispatch import build
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flows import planned
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.loop import cycle
from vibroimpact.engine.motion import unpacked
from vibroimpact.engine.observers.demand import unseen


@entry("void(f8[::1], f8[::1], f8[::1], f8, f8[:, ::1], i8[::1], i8, f8[:, ::1])")
def forces(
    given: Any,
    rig: Vector,
    amplitudes: Vector,
    frequencies: Vector,
    phase: float,
    states: Vector,
    cycles: NDArray[Any],
    max_events: int,
    out: Vector,
) -> None:
    """Find the largest contact force of either stop over some cycles of each of many motions.

    Parameters
    ----------
    rig, amplitudes, frequencies, phase, max_events
        As in `batch.sweep`; the frequencies in any order.
    states : ndarray, shape (frequency, motion.STATE)
        At the end of each hold.
    cycles : ndarray
        Forcing cycles that each is followed.
    out : ndarray, shape (frequency, 2)
        Written: on the right and on the left, per unit mass.
    """
    plan = planned(given, rig)
    clock = (math.sin(phase), math.cos(phase))
    for i in range(len(frequencies)):
        build(plan, amplitudes[i], 2.0 * math.pi * frequencies[i])
        motion = unpacked(states[i], clock)
        notes = unseen(0)
        period = 1.0 / frequencies[i]
        for _ in range(cycles[i]):
            events, motion, notes = cycle(plan, motion, clock, period, max_events, notes)
            if events > max_events:
                break
        out[i, 0], out[i, 1] = notes.force_right, notes.force_left
