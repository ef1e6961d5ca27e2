"""Poincaré sections of a motion: once per forcing cycle, or at the start of each contact."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, motion_parameters, noted
from vibroimpact.datasets.stops import by_stop
from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.errors import warn_of_result
from vibroimpact.model import Assembly, Oscillator, to_si
from vibroimpact.model.argument_types import PositiveInt, check_samples
from vibroimpact.model.public import public
from vibroimpact.model.quantities import ANGLE
from vibroimpact.model.rig import Rig, System
from vibroimpact.response.assembly_rig import check_size
from vibroimpact.response.assembly_rows import names_of_parts
from vibroimpact.response.contacts import contacts
from vibroimpact.response.motion_phases import recorded
from vibroimpact.response.prepared_rig import prepare
from vibroimpact.response.section_states import SectionStates

_MAX_EVENTS = 10_000


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
        ``section_velocity``, and the deformations of the stops, ``section_deformation``; of an
        assembly, the first two have the last dim ``mass``. If one
        forcing cycle has too many contacts, the simulation stops. In that case there are fewer
        points than requested, and a warning is issued.

    Raises
    ------
    InputError
        If the dataset does not hold a motion with samples, or if a value is invalid.
    """
    origin = recorded(motion, masses=True)
    if isinstance(origin.system, Assembly):
        check_size(origin.system)
    angle = to_si(phase, ANGLE, "phase")
    count = max(1, math.floor(origin.cycles)) if cycles is None else cycles
    check_samples(count, 1, "cycles")
    engine = prepare(Rig(origin.system, origin.shaking))
    states = engine.states
    state = engine.state(states.read(motion["initial_state"]))
    ahead = ((angle - origin.repeated.phase) / (2.0 * math.pi)) % 1.0
    status = Status.DONE
    if ahead > 0.0:
        status, state = engine.propagate(state, ahead, _MAX_EVENTS)
    first = states.point(state)
    points = np.empty((0, states.parts))
    if status is Status.DONE:
        status, rows = engine.at_phase(angle).sections(state, count, _MAX_EVENTS)
        points = np.vstack([first, rows[:, lyapunov.SECTION :]])[:count]
    if len(points) < count:
        warn_of_result(
            f"stroboscopic_section stopped after {len(points)} of {count} points: {status.advice}"
        )
    data = xr.Dataset(section_variables(origin.system, points, ("section_point",)))
    data = data.assign_coords(names_of_parts(origin.system))
    return describe(
        data,
        "vibroimpact.stroboscopic_section",
        {**motion_parameters(motion), "section": angle},
        noted(motion),
    )


def section_variables(
    system: System, points: NDArray[np.float64], dims: tuple[str, ...]
) -> dict[str, Any]:
    """Return points of a section as variables.

    Parameters
    ----------
    system
        The oscillator or the assembly.
    points : ndarray, shape (..., part)
        As `SectionStates` has them. Of an oscillator, the deformation of the left stop is negative
        if it is compressed.
    dims
        Names of the dims of the points.
    """
    states = SectionStates(system)
    n, stops = states.masses, states.stops
    u, v, d = points[..., :n], points[..., n : 2 * n], points[..., 2 * n : 2 * n + stops]
    by_mass, of_stops = (*dims, "mass"), (*dims, "stop")
    if isinstance(system, Oscillator):
        by_mass, u, v = dims, u[..., 0], v[..., 0]
        d = by_stop(system, d * [1.0, -1.0] + 0.0)
    else:
        d = np.maximum(d, 0.0)
    return {
        "section_displacement": (by_mass, u),
        "section_velocity": (by_mass, v),
        "section_deformation": (of_stops, d),
    }


@public
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
        and the time, the phase and the relative velocity (for an assembly, of each mass) at its
        start.

    Raises
    ------
    InputError
        If the dataset does not hold a motion with samples.
    """
    recorded(motion, masses=True)  # its phases are asked for
    log = contacts(motion)
    chosen = log[["contact_stop", "contact_start", "contact_start_phase", "contact_start_velocity"]]
    chosen.attrs["created_by"] = "vibroimpact.impact_section"
    return chosen
