"""Every output variable once: its units and its meaning; and what each dataset says of itself."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

import xarray as xr

from vibroimpact._version import __version__
from vibroimpact.engine.status import Status
from vibroimpact.model import Oscillator


class Variable(NamedTuple):
    """What a variable is measured in, and what it means."""

    units: str
    long_name: str
    comment: str = ""


VARIABLES: dict[str, Variable] = {
    # coordinates
    "frequency": Variable("Hz", "excitation frequency"),
    "direction": Variable("1", "sweep direction"),
    "rig": Variable("1", "rig"),
    "time": Variable("s", "time"),
    "cycle": Variable("1", "time in forcing cycles"),
    "component": Variable("1", "component of the state"),
    # sweep
    "displacement_excursion": Variable(
        "m", "excursion of relative displacement", "maximum less minimum, exact extremes"
    ),
    "acceleration_excursion": Variable(
        "m s-2",
        "excursion of absolute acceleration",
        "maximum less minimum, exact extremes, one-sided values at contact and detachment included",
    ),
    "eta_d": Variable(
        "1",
        "normalised excursion of relative displacement",
        "over the maximum of the free-flight sweep of the same isolator and amplitude",
    ),
    "eta_a": Variable(
        "1",
        "normalised excursion of absolute acceleration",
        "over the maximum of the free-flight sweep of the same isolator and amplitude",
    ),
    "displacement_max": Variable("m", "largest relative displacement"),
    "displacement_min": Variable("m", "smallest relative displacement"),
    "acceleration_max": Variable("m s-2", "largest absolute acceleration"),
    "acceleration_min": Variable("m s-2", "smallest absolute acceleration"),
    "eccentricity": Variable("m", "eccentricity", "half the sum of the displacement's extremes"),
    "impacts_right": Variable("1", "contacts with the right bumper per forcing cycle"),
    "impacts_left": Variable("1", "contacts with the left bumper per forcing cycle"),
    "motion": Variable(
        "1",
        "kind of motion",
        "periodic, quasi-periodic, chaotic or undecided; a sweep tells periodic from undecided",
    ),
    "period": Variable("1", "period in forcing cycles", "0 where the motion did not settle"),
    "cycles": Variable("1", "forcing cycles used, measured ones included"),
    "status": Variable("1", "how the computation ended"),
    "free_displacement_excursion": Variable(
        "m", "excursion of relative displacement in steady free flight"
    ),
    "free_acceleration_excursion": Variable(
        "m s-2", "excursion of absolute acceleration in steady free flight"
    ),
    "section": Variable(
        "1",
        "state at the stroboscopic section at the end of each hold",
        "components in m, m/s, m, m, rad and 1",
    ),
    # simulation
    "displacement": Variable("m", "relative displacement"),
    "velocity": Variable("m s-1", "relative velocity"),
    "acceleration": Variable(
        "m s-2", "absolute acceleration", "value behind the event where it jumps"
    ),
    "base_acceleration": Variable("m s-2", "base acceleration"),
    "right_bumper": Variable("m", "deformation of the right bumper"),
    "left_bumper": Variable("m", "deformation of the left bumper, negative when pressed"),
    "right_clearance": Variable("m", "clearance between mass and right bumper"),
    "left_clearance": Variable("m", "clearance between mass and left bumper"),
    "contact": Variable("1", "bumper in contact: -1 left, 0 none, 1 right"),
    "final_state": Variable("1", "state at the end", "components in m, m/s, m, m, rad and 1"),
    "event_time": Variable("s", "time of the event"),
    "event_cycle": Variable("1", "forcing cycle of the event, counted from 0"),
    "event_cycle_time": Variable("s", "time of the event since the beginning of its cycle"),
    "event_contact": Variable("1", "1 where a contact begins, 0 where one ends"),
    "event_side": Variable("1", "bumper of the event: -1 left, 1 right"),
    "event_displacement": Variable("m", "relative displacement at the event"),
    "event_velocity": Variable("m s-1", "relative velocity at the event"),
    "event_right_bumper": Variable("m", "deformation of the right bumper at the event"),
    "event_left_bumper": Variable("m", "deformation of the left bumper at the event"),
    "event_acceleration_before": Variable("m s-2", "absolute acceleration just before the event"),
    "event_acceleration_behind": Variable("m s-2", "absolute acceleration just after the event"),
}

COMPONENTS = ["displacement", "velocity", "right_bumper", "left_bumper", "phase", "contact"]
"""Components of a state in a dataset, in the order of `State`'s fields."""


def describe(dataset: xr.Dataset, created_by: str, parameters: dict[str, Any]) -> xr.Dataset:
    """Give every variable its units and meaning, and the dataset its parameters and origin.

    Raises
    ------
    KeyError
        If a variable is not in the registry.
    """
    for name in dataset.variables:
        variable = VARIABLES[str(name)]
        attributes = {"units": variable.units, "long_name": variable.long_name}
        if variable.comment:
            attributes["comment"] = variable.comment
        dataset[name].attrs.update(attributes)
    if "status" in dataset.variables:
        dataset["status"].attrs["flag_values"] = [int(status) for status in Status]
        dataset["status"].attrs["flag_meanings"] = " ".join(s.name.lower() for s in Status)
    dataset.attrs = {
        "created_by": created_by,
        "vibroimpact_version": __version__,
        "parameters": json.dumps(parameters),
        **dataset.attrs,
    }
    return dataset


def oscillator_parameters(oscillator: Oscillator) -> dict[str, Any]:
    """The oscillator as plain nested numbers (SI units), for a dataset's attributes."""
    return oscillator.model_dump()
