"""Poincaré sections of a motion: once per forcing cycle, or at the start of each contact."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from vibroimpact.datasets.description import describe, motion_parameters, noted
from vibroimpact.datasets.stops import part_names
from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.errors import warn_of_result
from vibroimpact.model import to_si
from vibroimpact.model.argument_types import PositiveInt, check_samples
from vibroimpact.model.public import public
from vibroimpact.model.quantities import ANGLE
from vibroimpact.model.rig import Rig
from vibroimpact.response.contacts import contacts
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.motion_phases import recorded
from vibroimpact.response.prepared_rig import prepare

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
    engine_system(origin.system).check_size()
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
    data = xr.Dataset(states.section_variables(points, ("section_point",)))
    data = data.assign_coords(part_names(origin.system, "mass", "stop"))
    return describe(
        data,
        "vibroimpact.stroboscopic_section",
        {**motion_parameters(motion), "section": angle},
        noted(motion),
    )


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
