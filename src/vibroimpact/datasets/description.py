"""Attributes of each dataset, and functions that read a rig and its shaking back from them."""

from __future__ import annotations

import json
from collections.abc import Hashable, Iterable, Iterator, Mapping
from typing import Any

import xarray as xr

from vibroimpact._version import __version__
from vibroimpact.datasets.variable import Described, Variable
from vibroimpact.datasets.vocabulary import NAMED_DIMS, VARIABLES
from vibroimpact.engine.status import Status
from vibroimpact.model import Assembly, Harmonic, Oscillator, Periodic, Repeated, Rig
from vibroimpact.model.excitation import ON_THE_MASS, amplitude_of
from vibroimpact.model.stops import STOPS, WallLaw
from vibroimpact.model.system import System
from vibroimpact.model.written_units import ATTRIBUTE, NONE, parameters_without_units

CHECKS_DIMS = False
"""Whether `describe` checks dims, which tests do: users get what was computed."""
COMPONENTS = [
    "displacement",
    "velocity",
    "deformation.right",
    "deformation.left",
    "phase",
    "touching.right",
    "touching.left",
    "isolator",
]
"""Components of the state of an oscillator in a dataset, of both sides, with or without stops."""


def describe(
    dataset: xr.Dataset,
    created_by: str,
    parameters: dict[str, Any] | None = None,
    notes: Iterable[str] = (),
    varied: Iterable[Described] = (),
) -> xr.Dataset:
    """Give every variable its units and meaning, and the dataset its parameters and origin.

    Attributes that the dataset already has are kept. Pass None for the parameters if they are among
    these attributes. Assumptions about the input, and doubts about it, become the attribute
    ``notes``, one per line. The variables of parameters that were varied have the units that these
    have in the rig. An own output is described by itself. If no rig has units, the variables have
    the units ``1``, and the attribute ``unit_system`` is ``none``.

    Raises
    ------
    KeyError
        If a variable is not in the registry.
    ValueError
        In tests: if it has other dims than the registry states.
    """
    known = {one.name: Variable(one.units, one.long_name) for one in varied}
    still = base_at_rest(dataset) if parameters is None else _stands(parameters)
    for name in dataset.variables:
        variable = VARIABLES.get(str(name)) or known[str(name)]
        if CHECKS_DIMS and name not in known:
            _check_dims(str(name), dataset.variables[name].dims)
        long_name = variable.long_name
        if still:  # what is relative to a base at rest is absolute
            long_name = long_name.replace("relative ", "absolute ")
        attributes = {"units": variable.units, "long_name": long_name}
        if variable.comment:
            attributes["comment"] = variable.comment
        dataset.variables[name].attrs.update(attributes)  # as of dataset[name], sooner
    for name, which in (("amplitude", ""), ("candidate_amplitude", " of the next test")):
        if name in dataset.variables and parameters and "of" in parameters:
            of = amplitude_of(parameters["of"])
            units = of.quantity.units
            dataset[name].attrs.update(units=units, long_name=f"{of.meaning}{which}")
    for name, variable in known.items():
        dataset[name].attrs.update(units=variable.units, long_name=variable.long_name)
    if "status" in dataset.variables:
        dataset["status"].attrs["flag_values"] = [int(status) for status in Status]
        dataset["status"].attrs["flag_meanings"] = " ".join(s.name.lower() for s in Status)
    if text := "\n".join(dict.fromkeys([*_assumptions(dataset, parameters), *notes])):
        dataset.attrs["notes"] = text
    dataset.attrs = {**origin(created_by, parameters), **dataset.attrs}
    # The rigs of a fit are an attribute of their own.
    if parameters_without_units(dataset.attrs.get("rigs", dataset.attrs.get("parameters", "{}"))):
        remove_units(dataset)
    return dataset


def _assumptions(dataset: xr.Dataset, parameters: dict[str, Any] | None) -> Iterator[str]:
    """Yield what was assumed to read the rigs of a dataset."""
    if parameters is None:
        text = dataset.attrs.get("parameters", "")
        parameters = json.loads(text) if '"assumptions"' in text else {}
    for one in parameters.get("rigs", [parameters]):
        yield from one.get("assumptions", ())


def _check_dims(name: str, dims: tuple[Hashable, ...]) -> None:
    """Raise an error if a variable may not have these dims."""
    words = [str(one) for one in dims]
    if words != [name] and not VARIABLES[name].has_dims(words, NAMED_DIMS):
        raise ValueError(f"{name}: its dims {words} are none of {VARIABLES[name].dims}")


def base_at_rest(data: xr.Dataset) -> bool:
    """Return whether the base is at rest: a force on the mass or nothing shakes all rigs.

    It is False if the dataset does not say what shakes them.
    """
    text = data.attrs.get("parameters")
    return text is not None and _stands(json.loads(text))


def _stands(parameters: Mapping[str, Any]) -> bool:
    rigs = parameters.get("rigs", [parameters])
    return bool(rigs) and all(
        one.get("of") in ON_THE_MASS or one.get("amplitude") == 0.0 for one in rigs
    )


def stop_word(data: xr.Dataset) -> str:
    """Return "stop" if a stop of a dataset's rigs is rigid, and "bumper" if all deform."""
    rigs = parameters_of_rigs(data)
    stops = [rig["oscillator"][side] or {} for rig in rigs for side in ("right", "left")]
    kinds = [STOPS.classes.get(stop.get("kind", "")) for stop in stops]
    return "stop" if any(law and issubclass(law, WallLaw) for law in kinds) else "bumper"


def remove_units(dataset: xr.Dataset) -> xr.Dataset:
    """Mark a dataset of rigs without units, whose numbers are dimensionless, and return it."""
    dataset.attrs[ATTRIBUTE] = NONE
    for variable in dataset.variables.values():
        units = variable.attrs["units"]
        if units == "Hz":
            variable.attrs["comment"] = "f = ω / 2π, in cycles per unit of time"
        if units != "rad":
            variable.attrs["units"] = "1"
        if "m/s" in str(variable.attrs.get("comment")):
            del variable.attrs["comment"]  # which lists the units of components
    return dataset


def origin(created_by: str, parameters: dict[str, Any] | None) -> dict[str, str]:
    """Return the attributes that describe the origin of a dataset."""
    return {
        "created_by": created_by,
        "vibroimpact_version": __version__,
        **({} if parameters is None else {"parameters": json.dumps(parameters)}),
    }


def own_outputs(data: xr.Dataset) -> list[str]:
    """Return the names of the own outputs in a dataset."""
    return [str(name) for name in data.data_vars if "output" in data[name].attrs]


def noted(data: xr.Dataset) -> list[str]:
    """Return the notes of a dataset, as a list of lines."""
    return str(data.attrs.get("notes", "")).splitlines()


def status_facts(data: xr.Dataset) -> dict[str, str]:
    """Return the name of the status of one computation, and its message with advice."""
    name = Status(data["status"].item()).name.lower()
    return {"status": name, "message": data.attrs["message"]}


def motion_parameters(motion: xr.Dataset) -> dict[str, Any]:
    """Return the parameters in the attributes of a motion."""
    parameters: dict[str, Any] = json.loads(motion.attrs["parameters"])
    return parameters


def parameters_of_rigs(data: xr.Dataset) -> list[dict[str, Any]]:
    """Return the parameters of each rig in the attributes of a dataset of one or several rigs."""
    parameters = motion_parameters(data)
    rigs: list[dict[str, Any]] = parameters.get("rigs", [parameters])
    return rigs


def excitation_parameters(shaken: Repeated, *left_out: str) -> dict[str, Any]:
    """Return the shaking as plain numbers (SI units), for the attributes of a dataset.

    The quantity of the amplitude is included, unless it is a base acceleration.
    """
    numbers = {k: v for k, v in shaken.model_dump().items() if k not in left_out}
    if shaken.of == "acceleration":
        del numbers["of"]
    return numbers


def rig_parameters(rig: Rig, *left_out: str) -> dict[str, Any]:
    """Return a rig as plain numbers (SI units), for the attributes of a dataset.

    The amplitude of a rig with one amplitude per frequency of a sweep is a list. The entry
    ``published`` is True for a published rig, and otherwise left out.
    """
    numbers = excitation_parameters(rig.hardest.periodic, *left_out)
    if rig.amplitudes is not None:
        numbers["amplitude"] = list(rig.amplitudes)
    if rig.published:
        numbers["published"] = True
    return {**system_parameters(rig.system), **numbers}


def system_parameters(system: System) -> dict[str, Any]:
    """Return an oscillator or an assembly by its kind, for the attributes of a dataset.

    The entry ``assumptions`` is what was assumed to read it, and left out if nothing was.
    """
    assumed = {"assumptions": list(system.assumptions)} if system.assumptions else {}
    return {system.table_name: system.model_dump(), **assumed}


def system_from(parameters: Mapping[str, Any]) -> System:
    """Return the system in the parameters of a dataset."""
    if "assembly" in parameters:
        return Assembly.model_validate(parameters["assembly"])
    return Oscillator.model_validate(parameters["oscillator"])


def excitation_from(parameters: Mapping[str, Any], **others: float) -> Repeated:
    """Return the shaking from the attributes of a dataset; `others` replace or add values."""
    kind = Periodic if "amplitudes" in parameters else Harmonic
    fields = {k: parameters[k] for k in kind.model_fields if k in parameters}
    return kind.model_validate({**fields, **others})
