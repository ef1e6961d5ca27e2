"""Default range of states: those that steady motions reach, and more."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from vibroimpact.attraction.find_attractors import Search
from vibroimpact.attraction.label_states import SectionSetup
from vibroimpact.attraction.state_grid import lattice
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import State
from vibroimpact.model.quantities import LENGTH, VELOCITY
from vibroimpact.model.quantity_lists import read_span
from vibroimpact.stability.settled_motion import approach, reach, reach_at_rest
from vibroimpact.tasks.threads import Progress

Window = tuple[tuple[float, float], tuple[float, float]]
"""Ranges of displacement (m) and velocity (m/s)."""

WIDER = 1.6
"""Over what the steady motions take."""
FIRST = 2.0
"""Over the size of the motion from rest, and the gaps: where other motions are sought."""
LATTICE = 20
"""Starts along each axis."""


def walls(stage: SectionSetup) -> tuple[float, float]:
    """Least and largest displacement that can be (m)."""
    left, right = stage.oscillator.left, stage.oscillator.right
    return (
        -left.gap if left is not None and left.rigid else -np.inf,
        right.gap if right is not None and right.rigid else np.inf,
    )


def read_window(displacement: Any, velocity: Any, default: Callable[[], Window]) -> Window:
    """Return ranges of displacement and velocity; those that were not passed are the default's."""
    wide = None if displacement is None else read_span(displacement, LENGTH, "displacement")
    fast = None if velocity is None else read_span(velocity, VELOCITY, "velocity")
    if wide is None or fast is None:
        from_search = default()
        wide, fast = wide or from_search[0], fast or from_search[1]
    return wide, fast


def window(search: Search, progress: Progress | None = None) -> Window:
    """A window around all motions that starts in a larger one lead to.

    Progress counts these starts.

    Raises
    ------
    InputError
        If nothing moves.
    """
    stage = search.stage
    excitation = stage.excitation
    rest = approach(stage.rig, State(phase=excitation.phase))
    size = reach_at_rest(stage.rig)
    if rest.status in (Status.DONE, Status.NOT_SETTLED):
        size = max(size, reach(rest, rest.state))
    size = FIRST * max(size, *(abs(stop.gap) for stop in stage.oscillator.stops.values()), 0.0)
    if not size > 0.0:
        raise InputError(
            "displacement: there is no default range, because the mass does not move from rest; "
            "pass ranges of displacement and velocity"
        )
    low, high = walls(stage)
    fast = size * excitation.angular_frequency
    wide = max(-size, low), min(size, high)
    search.label(lattice(wide, (-fast, fast), (LATTICE, LATTICE)), progress)
    if not search.known:
        return wide, (-fast, fast)
    most = max(float(one.motion["displacement_max"]) for one in search.known)
    least = min(float(one.motion["displacement_min"]) for one in search.known)
    fast = WIDER * max(float(np.abs(one.motion["velocity"]).max()) for one in search.known)
    middle, half = 0.5 * (most + least), 0.5 * WIDER * (most - least)
    return (max(middle - half, low), min(middle + half, high)), (-fast, fast)
