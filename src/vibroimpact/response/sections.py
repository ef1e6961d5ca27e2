"""Poincaré sections of a motion: once per forcing cycle, or at the start of each contact."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, motion_parameters, noted
from vibroimpact.datasets.stops import by_stop, stops_of
from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.errors import warn_of_result
from vibroimpact.model import Oscillator, to_si
from vibroimpact.model.argument_types import PositiveInt, check_samples
from vibroimpact.model.public import public
from vibroimpact.model.quantities import ANGLE
from vibroimpact.model.rig import Rig
from vibroimpact.response.contacts import contacts
from vibroimpact.response.motion_phases import beginning, recorded
from vibroimpact.response.prepared_rig import prepare

_MAX_EVENTS = 10_000
_COLUMNS = 4
"""Displacement, velocity, and the deformations of both sides, the left one < 0 if compressed."""


@public
def stroboscopic_section(
    motion: xr.Dataset, phase: float | str = 0.0, cycles: PositiveInt | None = None
) -> xr.Dataset:
    """Compute the stroboscopic section of a motion: its state once per forcing cycle.

    Parameters
    ----------
    motion
        Dataset of `steady`, or of `simulate` with samples. The motion is simulated again from its
        initial state.
    phase
        Phase θ of the forcing at the section (rad). At this phase the base acceleration is A sin θ.
    cycles
        Number of points. Default: the number of whole forcing cycles of the motion.

    Returns
    -------
    xarray.Dataset
        The dim ``section_point`` counts the points. The variables are ``section_displacement``,
        ``section_velocity``, and the deformations of the stops, ``section_deformation``. If one
        forcing cycle has too many contacts, the simulation stops. In that case there are fewer
        points than requested, and a warning is issued.

    Raises
    ------
    InputError
        If the dataset does not hold a motion with samples, or if a value is invalid.
    """
    origin = recorded(motion)
    angle = to_si(phase, ANGLE, "phase")
    count = max(1, math.floor(origin.cycles)) if cycles is None else cycles
    check_samples(count, 1, "cycles")
    start = beginning(motion)
    engine = prepare(Rig(origin.oscillator, origin.excitation))
    state = engine.state(start)
    shaken = origin.excitation
    ahead = ((angle - shaken.phase) / (2.0 * math.pi)) % 1.0
    first = np.array([*state[2:5], -state[5]])
    status = Status.DONE
    if ahead > 0.0:
        status, state = engine.propagate(state, ahead, _MAX_EVENTS)
        first = np.array([*state[2:5], -state[5]])
    points = np.empty((0, _COLUMNS))
    if status is Status.DONE:
        status, rows = engine.at_phase(angle).sections(state, count, _MAX_EVENTS)
        known = rows[:, lyapunov.SECTION :][:, :_COLUMNS]
        points = np.vstack([first, known])[:count]
    if len(points) < count:
        warn_of_result(
            f"stroboscopic_section stopped after {len(points)} of {count} points: {status.advice}"
        )
    data = xr.Dataset(section_variables(origin.oscillator, points, ("section_point",)))
    data = data.assign_coords(stop=stops_of(origin.oscillator))
    return describe(
        data,
        "vibroimpact.stroboscopic_section",
        {**motion_parameters(motion), "section": angle},
        noted(motion),
    )


def section_variables(
    oscillator: Oscillator, points: NDArray[np.float64], dims: tuple[str, ...]
) -> dict[str, Any]:
    """Return points of a section of an oscillator as variables.

    Parameters
    ----------
    oscillator
        The oscillator.
    points : ndarray, shape (..., 4)
        As the engine writes them: displacement, velocity and the deformations of both sides, the
        left one negative when compressed.
    dims
        Names of the dims of the points.
    """
    deformation = by_stop(oscillator, points[..., 2:4] * [1.0, -1.0] + 0.0)
    return {
        "section_displacement": (dims, points[..., 0]),
        "section_velocity": (dims, points[..., 1]),
        "section_deformation": ((*dims, "stop"), deformation),
    }


def impact_section(motion: xr.Dataset) -> xr.Dataset:
    """Compute the impact section: forcing phase and velocity at the start of each contact.

    Parameters
    ----------
    motion
        Dataset of `steady`, or of `simulate` with samples. One sample per cycle is enough.

    Returns
    -------
    xarray.Dataset
        The dim ``contact_number`` counts the contacts. The variables are the stop of the contact,
        and the time, the phase and the relative velocity at its start.

    Raises
    ------
    InputError
        If the dataset does not hold a motion with samples.
    """
    recorded(motion)  # its phases are asked for
    log = contacts(motion)
    chosen = log[["contact_stop", "contact_start", "contact_start_phase", "contact_start_velocity"]]
    chosen.attrs["created_by"] = "vibroimpact.impact_section"
    return chosen
