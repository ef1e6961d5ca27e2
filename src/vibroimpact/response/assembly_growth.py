"""Growth of disturbances of an assembly's motion, cycle by cycle."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.tasks.interruptible import Calls
from vibroimpact.tasks.threads import Progress

if TYPE_CHECKING:
    from vibroimpact.response.prepared_rig import PreparedRig

_Array = NDArray[np.float64]

_ROWS = 1024
"""Cycles whose rows are kept together."""


def grow_several(
    engine: PreparedRig,
    state: _Array,
    cycles: int,
    keep: Callable[[_Array], None],
    max_events: int,
    transient: int,
    discard: int,
    progress: Progress | None,
) -> Status:
    """Do what `PreparedRig.grow` does, for an assembly.

    The derivative of each cycle carries orthogonal disturbances, which are made orthogonal again
    after it (Benettin, Galgani, Giorgilli and Strelcyn 1980).
    """
    states, shaking = engine.states, engine.shaking
    parts = states.parts
    size = np.ones(parts)
    size[states.velocities()] = 1.0 / shaking.angular_frequency
    carried, damping = np.empty((parts, parts)), np.empty(1)
    directions: _Array = np.eye(parts)
    rows: list[_Array] = []
    first = -transient - discard
    calls = Calls(cycles - first, progress, _ROWS)
    number, status = first, Status.DONE
    while number < cycles and status is Status.DONE:
        for number in range(number, first + int(calls.end(number - first))):  # noqa: B020
            before = state.copy()
            if number < -discard:
                status, state[:] = engine.propagate(state, 1.0, max_events)
            else:
                status = Status(
                    lyapunov.monodromy(
                        engine.vector,
                        shaking.amplitude,
                        shaking.frequency,
                        shaking.phase,
                        state,
                        1,
                        max_events,
                        carried,
                        damping,
                    )
                )
            if status is not Status.DONE:
                state[:] = before
                break
            if number >= -discard:
                map_ = carried.T * size[:, np.newaxis] / size
                directions, grown = np.linalg.qr(map_ @ directions)
                if number >= 0:
                    with np.errstate(divide="ignore"):
                        logarithms = np.log(np.abs(np.diag(grown)[:2]))
                    rows.append(np.concatenate([logarithms, damping, states.point(state)]))
        if rows:
            keep(np.array(rows))
            rows.clear()
        number += 1
    if progress and status is Status.DONE:
        progress(cycles - first, cycles - first)
    return status
