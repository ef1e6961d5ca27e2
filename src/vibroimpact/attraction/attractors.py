"""A motion that others lead to: what it is, where it is at the section, and what catches others."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.attraction.absorbing_ellipsoids import ellipsoids
from vibroimpact.attraction.label_states import PLACES, SectionSetup
from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.response.engine_input import as_state, engine_state
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.prepared_rig import prepare
from vibroimpact.stability.settled_motion import Settled, reach
from vibroimpact.stability.steady import describe_motion

_Array = NDArray[np.float64]

_SAMPLES, _WINDOW, _EXPONENTS = 64, 200, 20_000
_VISITS = 20_000
"""Cycles of a motion that wanders, by which the cells that it visits are known."""
_LOSES = 1e-9
"""Least share of an area, or of a volume, that dies out in a cycle."""


class Attractor(NamedTuple):
    """A steady motion that states of its own lead to."""

    settled_motion: Settled
    motion: xr.Dataset
    """What `steady` says of it."""
    points: _Array
    """u, u̇, u_R, u_L, z at the sections of one period, or of many cycles; the deformations away
    from the mass."""
    traps: _Array
    """Rows of `engine.absorption`; none of a motion that wanders."""

    @property
    def visited(self) -> _Array:
        """Displacements at the section, sorted (m)."""
        return np.sort(self.points[:, 0])

    @property
    def size(self) -> float:
        """As a displacement (m)."""
        return reach(self.settled_motion, self.settled_motion.state)


def attractor(
    stage: SectionSetup, state: _Array, steady_motion: Settled, owner: int
) -> Attractor | Status:
    """Describe what a state of the engine settles on; why it is given up if that cannot be.

    Raises
    ------
    InputError
        If nothing dies out there, so that there is no end.
    """
    max_events = stage.max_events
    motion = described(steady_motion, max_events)
    period = int(motion["period"])
    if str(motion["motion"].values) == "undecided" and not math.isfinite(
        float(motion["effective_damping"])
    ):
        return Status.TOO_MANY_EVENTS
    begin = f"oscillator: the motion from {state[2]:.6g} m and {state[3]:.6g} m/s"
    check_loses(motion, steady_motion, begin, "give the isolator damping")
    if period and not steady_motion.period:  # it settles slowly, and was found by Newton's method
        there = engine_state(stage.oscillator, as_state(motion["final_state"]))
        steady_motion = steady_motion._replace(state=there, period=period, status=Status.DONE)
    points = _points(steady_motion, stage)
    if points is None:
        return Status.TOO_MANY_EVENTS
    size = reach(steady_motion, steady_motion.state)
    rows = ellipsoids(stage, points if steady_motion.period else points[:0], size, owner)
    return Attractor(steady_motion, motion, points, rows)


def described(steady_motion: Settled, max_events: int) -> xr.Dataset:
    """Return what `steady` says of a motion."""
    return describe_motion(steady_motion, _SAMPLES, _WINDOW, _EXPONENTS, max_events)


def check_loses(motion: xr.Dataset, steady_motion: Settled, which: str, remedy: str) -> None:
    """Raise an error if a motion loses no energy."""
    lost = float(motion["effective_damping"]) / steady_motion.excitation.frequency
    if abs(lost) < _LOSES:
        raise InputError(
            f"{which} loses no energy, so neighbouring states do not lead to a common motion and "
            f"there are no basins; {remedy}"
        )


def _points(steady_motion: Settled, stage: SectionSetup) -> _Array | None:
    """Where it is at the section; None if a limit is met."""
    if not steady_motion.period:
        state = steady_motion.state.copy()
        status, rows = prepare(stage.rig).sections(state, _VISITS, stage.max_events)
        if status is not Status.DONE:
            return None
        states = engine_system(stage.oscillator)
        points: _Array = rows[:, lyapunov.SECTION : lyapunov.SECTION + states.parts]
        return points * states.signs
    passed, state = [], steady_motion.state
    for _ in range(steady_motion.period):
        passed.append(state[PLACES])
        status, state = steady_motion.engine.propagate(state, 1.0, stage.max_events)
        if status is not Status.DONE:
            return None
    return np.array(passed)
