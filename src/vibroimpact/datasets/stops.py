"""The dim ``stop`` of results: the stops of a rig by name, as its last dim."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.variable import PARTS
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.system import PartNames, System

_SUMS = ("impacts", "impact_count", "impulse")
"""Variables whose value for all stops is their sum; for others it is the largest."""


def has_stops(name: str) -> bool:
    """Return whether a variable has a value for each stop."""
    return name in VARIABLES and VARIABLES[name].part == "stop"


def part_names(system: System, *dims: str) -> PartNames:
    """Return the names of the parts of a system as coordinates, of those dims that it has."""
    return {dim: names for dim, names in system.part_names.items() if dim in dims}


def shared_part_names(systems: Sequence[System]) -> PartNames:
    """Return the names of the parts of several systems as coordinates of one dataset.

    Of oscillators, these are the stops that at least one of them has. The parts of assemblies have
    the same names.
    """
    first = systems[0]
    names = first.part_names
    stops = [s for s in first.counted_stops if any(s in one.stops for one in systems)]
    return names | {"stop": np.array(stops, dtype=names["stop"].dtype)}


def stop_names(numbers: NDArray[Any]) -> NDArray[np.str_]:
    """Return the names of an oscillator's stops from the engine's numbers of them."""
    return np.where(numbers == 0, *SIDES)


def by_stop(
    system: System, values: NDArray[Any], names: NDArray[np.str_] | None = None
) -> NDArray[Any]:
    """Return the values of the stops that a system has, of an array for all counted stops.

    Parameters
    ----------
    system
        The oscillator or the assembly.
    values : ndarray, shape (..., counted stop)
        Values such as columns of the engine: of an oscillator those of the right and the left side.
    names
        Stops of the result; those that this system lacks are NaN. Default: the stops that it has.

    Returns
    -------
    ndarray, shape (..., stop)
    """
    of = (system.part_names["stop"] if names is None else names).tolist()
    lacking = [name not in system.stops for name in of]
    at = [system.counted_stops.index(name) for name in of]
    columns = values[..., at[0] : at[-1] + 1] if at else values[..., :0]  # without a copy
    if any(lacking):
        columns = columns.astype(np.float64)
        columns[..., lacking] = np.nan
    return columns


def each_by_stop(
    systems: Sequence[System], values: NDArray[Any], names: NDArray[np.str_]
) -> NDArray[Any]:
    """Return `by_stop` of several systems, which `values` has along its first axis."""
    each = [by_stop(one, of, names) for one, of in zip(systems, values, strict=True)]
    return np.array(each).reshape(*values.shape[:-1], len(names))


def plain_values(values: xr.DataArray) -> Any:
    """Return a number or a text as Python has it; of the parts of a rig a mapping from names."""
    if len(values.dims) == 1 and values.dims[0] in PARTS:
        names = values[values.dims[0]].values.tolist()
        return dict(zip(names, values.values.tolist(), strict=True))
    return values.item()


def of_stop(data: xr.Dataset, name: str, stop: str, absent: float = 0.0) -> xr.DataArray:
    """Return a variable at one stop; `absent` if the rig does not have this stop."""
    values = data[name]
    if stop in values["stop"].values.tolist():
        return values.sel(stop=stop, drop=True)
    return xr.full_like(values.isel(stop=[]).sum("stop"), absent)


def over_stops(values: xr.DataArray) -> xr.DataArray:
    """Return the value for all stops: the sum of counts and impulses, the largest of others.

    It is 0 for a rig without stops, and a variable without the dim ``stop`` is returned as it is.
    """
    if "stop" not in values.dims:
        return values
    if not values.sizes["stop"]:
        return values.sum("stop", keep_attrs=True)
    if str(values.name).removeprefix("contact_") in _SUMS:
        return values.sum("stop", min_count=1, keep_attrs=True)
    return values.max("stop", keep_attrs=True)


def over_parts(values: xr.DataArray) -> xr.DataArray:
    """Return `over_stops`; of masses and links the largest value, of a lowest one the lowest."""
    array = over_stops(values)
    for dim in ("mass", "link"):
        if dim in array.dims:
            lowest = str(values.name).endswith("_min")
            array = (array.min if lowest else array.max)(dim, keep_attrs=True)
    return array


def quantities(data: xr.Dataset) -> list[str]:
    """Return the names that `quantity` accepts: of variables, and of each of their parts."""
    names = []
    for name, one in data.data_vars.items():
        names.append(str(name))
        for dim in PARTS:
            if dim in one.dims:
                names += [f"{name}.{part}" for part in data[dim].values]
    return names


def quantity(data: xr.Dataset, name: str) -> xr.DataArray:
    """Return a variable without the dim ``stop``, or of one part.

    Parameters
    ----------
    data
        The dataset.
    name
        One of `quantities`: ``"peak_force.right"`` is the force of one stop, and ``"peak_force"``
        that of all stops (`over_stops`). ``"peak_drift.storey"`` is that of one link of an
        assembly, and ``"peak_drift"`` keeps the dim ``link``; so do masses.
    """
    variable, _, part = name.partition(".")
    if part and variable in data:
        for dim in PARTS:
            if dim in data[variable].dims:
                return data[variable].sel({dim: part}, drop=True)
    return over_stops(data[name])
