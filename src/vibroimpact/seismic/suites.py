"""What a suite of records shows at each level of shaking: fractiles, shares above a limit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import to_si
from vibroimpact.model.quantities import (
    ACCELERATION,
    DIMENSIONLESS,
    FORCE,
    LENGTH,
    Quantity,
)
from vibroimpact.model.units import shown
from vibroimpact.response.variables import describe, motion_parameters

_Array = NDArray[np.float64]

_QUANTITIES = {"m": LENGTH, "m s-2": ACCELERATION, "N": FORCE, "1": DIMENSIONLESS}
UNSTABLE = (int(Status.NOT_FINITE), int(Status.REVERSED))
"""Runs that went beyond all limits; of others that were given up nothing is known."""
_VAST = 1e300
"""Stands for infinity where quantiles are interpolated."""


def fractiles(
    demands: xr.Dataset,
    quantity: str = "peak_displacement",
    shares: Sequence[float] = (0.16, 0.5, 0.84),
) -> xr.Dataset:
    """Return the curves of incremental dynamic analysis: fractiles over the records at each scale.

    Quantiles of a sample are interpolated between its sorted values (Hyndman and Fan's seventh
    definition). A run that went beyond all limits counts as infinite (Vamvatsikos and Cornell,
    2002).

    Parameters
    ----------
    demands
        Dataset of `demands`.
    quantity
        One of its peaks, such as ``"peak_acceleration"``.
    shares
        Shares of the records below, from 0 to 1.

    Returns
    -------
    xarray.Dataset
        The quantity, with dim ``fractile`` in the place of ``record``.

    Raises
    ------
    InputError
        If it is no such dataset, a value cannot be used, or runs were given up for their number of
        events or of steps.
    """
    values = known(demands, quantity)
    chosen = [
        to_si(share, DIMENSIONLESS, f"shares[{i}]", minimum=0.0, maximum=1.0)
        for i, share in enumerate(shares)
    ]
    if not chosen:
        raise InputError("shares: none given; one or more from 0 to 1 are accepted")
    found = quantiles(values.values, chosen, values.dims.index("record"))
    dims = ("fractile", *(dim for dim in values.dims if dim != "record"))
    data = xr.Dataset({quantity: (dims, found)}, {"fractile": chosen, **_coords(values)})
    return described(data, "vibroimpact.fractiles", demands, {"quantity": quantity})


def quantiles(values: _Array, shares: Sequence[float], axis: int) -> _Array:
    """Quantiles along an axis, which comes first; values may be infinite."""
    found: _Array = np.quantile(np.minimum(values, _VAST), shares, axis=axis)
    found[found > 1e-3 * _VAST] = np.inf
    return found


def exceedance(demands: xr.Dataset, quantity: str, limit: float | str | None = None) -> xr.Dataset:
    """Return the share of the records that exceed a limit at each scale.

    ``exceedance(demands, "impact_count")`` is the probability of impact.

    Parameters
    ----------
    demands
        Dataset of `demands`.
    quantity
        One of its peaks.
    limit
        In SI units or as text with units; what is greater exceeds it. None for 0, of counts.

    Returns
    -------
    xarray.Dataset
        ``exceeding``, a number of records, and ``probability``, over scales and rigs.

    Raises
    ------
    InputError
        As `fractiles`.
    """
    values = known(demands, quantity)
    least = limit_of(demands, quantity, limit)
    above = values > least
    data = xr.Dataset(
        {"exceeding": above.sum("record"), "probability": above.mean("record")}, _coords(values)
    )
    about = {"quantity": quantity, "limit": least}
    return described(data, "vibroimpact.exceedance", demands, about)


def limit_of(demands: xr.Dataset, quantity: str, limit: float | str | None) -> float:
    """Read a limit of one of the peaks; None for 0, of what is counted.

    Raises
    ------
    InputError
        If it is another quantity, or is missing where nothing is counted.
    """
    expected: Quantity = _QUANTITIES.get(demands[quantity].attrs["units"]) or DIMENSIONLESS
    if limit is None:
        if expected is DIMENSIONLESS:
            return 0.0
        raise InputError(
            f"limit: missing; a limit of {quantity} is accepted, such as {expected.example!r}"
        )
    return to_si(limit, expected, "limit")


def known(demands: Any, quantity: str) -> xr.DataArray:
    """One of the peaks, infinite where a run went beyond all limits.

    Raises
    ------
    InputError
        If it is no dataset of demands, has no such peak, or runs were given up otherwise.
    """
    held = isinstance(demands, xr.Dataset) and {"record", "scale"} <= set(demands.dims)
    if not held or "status" not in demands:
        raise InputError(f"demands: {shown(demands)}; a dataset of demands is accepted")
    peaks = [
        str(name)
        for name, one in demands.data_vars.items()
        if one.dims == demands["status"].dims and name != "status"
    ]
    if quantity not in peaks:
        raise InputError(f"quantity: {shown(quantity)}; one of {', '.join(peaks)} is accepted")
    status = demands["status"].values
    for code in np.unique(status[(status != Status.DONE) & ~np.isin(status, UNSTABLE)]):
        raise InputError(
            f"demands: {int((status == code).sum())} runs were given up, and nothing is known of "
            f"them: {Status(int(code)).advice}"
        )
    found: xr.DataArray = demands[quantity].where(~np.isin(status, UNSTABLE), math.inf)
    return found


def _coords(values: xr.DataArray) -> dict[str, Any]:
    return {str(dim): values[dim] for dim in values.dims if dim != "record"}


def described(
    data: xr.Dataset, created_by: str, demands: xr.Dataset, about: dict[str, Any]
) -> xr.Dataset:
    """With units and meanings, those of the scale and of what is varied as they were."""
    kept = {name: dict(demands[name].attrs) for name in data.coords if name in demands.coords}
    made = describe(data, created_by, {**about, "demands": motion_parameters(demands)})
    for name, attributes in kept.items():
        made[name].attrs.update(attributes)
    return made
