"""The dim ``stop`` of results: the stops of a rig by name, as its last dim."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.variable import PARTS
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.model import Oscillator

SIDES = ("right", "left")
"""Names of the stops of an oscillator, in the order of the dim ``stop``."""
_SUMS = ("impacts", "impact_count", "impulse")
"""Variables whose value for all stops is their sum; for others it is the largest."""


def has_stops(name: str) -> bool:
    """Return whether a variable has a value for each stop."""
    return name in VARIABLES and VARIABLES[name].part == "stop"


def stops_of(*oscillators: Oscillator) -> NDArray[np.str_]:
    """Return the names of the stops that at least one of the oscillators has."""
    found = [s for s in SIDES if any(getattr(one, s) is not None for one in oscillators)]
    return np.array(found, dtype="<U5")


def stop_names(numbers: NDArray[Any]) -> NDArray[np.str_]:
    """Return the names of an oscillator's stops from the engine's numbers of them."""
    return np.where(numbers == 0, *SIDES)


def by_stop(
    oscillator: Oscillator, both: NDArray[Any], names: NDArray[np.str_] | None = None
) -> NDArray[Any]:
    """Return the values of the stops that an oscillator has, of an array for both sides.

    Parameters
    ----------
    oscillator
        The oscillator.
    both : ndarray, shape (..., 2)
        Values of the right and of the left side, such as columns of the engine.
    names
        Stops of the result; those that this oscillator lacks are NaN. Default: the stops that it
        has.

    Returns
    -------
    ndarray, shape (..., stop)
    """
    names = stops_of(oscillator) if names is None else names
    lacking = [getattr(oscillator, name) is None for name in names.tolist()]
    at = [SIDES.index(name) for name in names.tolist()]
    found = both[..., at[0] : at[-1] + 1] if at else both[..., :0]  # without a copy
    if any(lacking):
        found = found.astype(np.float64)
        found[..., lacking] = np.nan
    return found


def each_by_stop(oscillators: Sequence[Oscillator], both: NDArray[Any]) -> NDArray[Any]:
    """Return `by_stop` of several oscillators, with the stops that at least one of them has.

    `both` has the oscillators along its first axis.
    """
    names = stops_of(*oscillators)
    each = [by_stop(one, values, names) for one, values in zip(oscillators, both, strict=True)]
    return np.array(each).reshape(*both.shape[:-1], len(names))


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
    found = over_stops(values)
    for dim in ("mass", "link"):
        if dim in found.dims:
            lowest = str(values.name).endswith("_min")
            found = (found.min if lowest else found.max)(dim, keep_attrs=True)
    return found


def quantities(data: xr.Dataset) -> list[str]:
    """Return the names that `quantity` accepts: of variables, and of each of their parts."""
    found = []
    for name, one in data.data_vars.items():
        found.append(str(name))
        for dim in PARTS:
            if dim in one.dims:
                found += [f"{name}.{part}" for part in data[dim].values]
    return found


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
