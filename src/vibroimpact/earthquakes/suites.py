"""Statistics of a suite of records at each level: fractiles, and shares above a limit."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.arguments import check_list, check_name
from vibroimpact.datasets.description import describe, motion_parameters, noted
from vibroimpact.datasets.stops import quantities
from vibroimpact.datasets.stops import quantity as of_quantity
from vibroimpact.datasets.variable import PARTS
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, shown, warn_of_result
from vibroimpact.model import to_si
from vibroimpact.model.public import public
from vibroimpact.model.quantities import (
    ACCELERATION,
    DIMENSIONLESS,
    FORCE,
    LENGTH,
    Quantity,
)

_Array = NDArray[np.float64]

_QUANTITIES = {"m": LENGTH, "m s-2": ACCELERATION, "N": FORCE, "1": DIMENSIONLESS}
UNSTABLE = (int(Status.NOT_FINITE), int(Status.REVERSED))
"""Statuses of runs that exceeded all limits. Nothing is known of other runs that were given up."""
_VAST = 1e300
"""Finite stand-in for infinity, for the interpolation of quantiles."""


@public
def fractiles(
    demands: xr.Dataset,
    quantity: str = "peak_displacement",
    shares: Sequence[float] = (0.16, 0.5, 0.84),
) -> xr.Dataset:
    """Compute fractiles over the records at each scale, or over the rigs of an ensemble.

    Fractiles over the records, drawn over the scale, are the curves of incremental dynamic analysis
    (IDA). They are interpolated between the sorted values of the sample (Hyndman and Fan's seventh
    definition of quantiles). If the motion of a run grew without bound, its value counts as
    infinite (Vamvatsikos and Cornell, 2002).

    Parameters
    ----------
    demands
        Dataset of `demands`, or of `ensemble` for any response.
    quantity
        Name of a variable of the dataset, such as ``"peak_acceleration"``; of one stop
        ``"peak_force.right"``, and ``"peak_force"`` of all (the largest force, the sum of impulses
        and counts).
    shares
        Shares of the records or rigs whose value is below the fractile, from 0 to 1. For
        ``"displacement_min"``: above it, so that a larger share goes farther to the left.

    Returns
    -------
    xarray.Dataset
        The quantity, with the dim ``fractile`` in place of ``record`` or ``sample``.

    Raises
    ------
    InputError
        If ``demands`` is not a dataset of `demands` or `ensemble`, or if a value is invalid. Also
        if runs were given up because they had too many contacts or steps.
    """
    over = "sample" if "sample" in getattr(demands, "dims", ()) else "record"
    values = (_drawn if over == "sample" else known)(demands, quantity)
    chosen = [
        to_si(share, DIMENSIONLESS, f"shares[{i}]", minimum=0.0, maximum=1.0)
        for i, share in enumerate(check_list(shares, "shares", 1000, "a list of shares"))
    ]
    if not chosen:
        raise InputError("shares: the list is empty; pass at least one share from 0 to 1")
    sense = _sense(quantity)
    quantile_values = sense * quantiles(sense * values.values, chosen, values.dims.index(over))
    dims = ("fractile", *(dim for dim in values.dims if dim != over))
    made = {str(values.name): (dims, quantile_values)}
    data = xr.Dataset(made, {"fractile": chosen, **_coords(values)})
    return described(data, "vibroimpact.fractiles", demands, {"quantity": quantity})


def _sense(quantity: str) -> float:
    """Return -1 for the end of the motion on the left, which is worse the lower it is, else 1."""
    return -1.0 if quantity == "displacement_min" else 1.0


def quantiles(values: _Array, shares: Sequence[float], axis: int) -> _Array:
    """Compute quantiles along the first axis; values may be infinite, and NaN is left out."""
    known = np.minimum(values, _VAST)
    # Where nothing is known the quantile is NaN as well, which is no surprise.
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "All-NaN slice", RuntimeWarning)
        pick = np.nanquantile if np.isnan(known).any() else np.quantile
        quantile_values: _Array = pick(known, shares, axis=axis)
    quantile_values[quantile_values > 1e-3 * _VAST] = np.inf
    return quantile_values


def _drawn(data: xr.Dataset, quantity: str) -> xr.DataArray:
    """Return a variable of an ensemble, infinite where a motion exceeded all limits."""
    held = data[[name for name, one in data.data_vars.items() if "sample" in one.dims]]
    names = quantities(held)
    if quantity not in names:
        raise InputError(f"quantity: {shown(quantity)}; pass one of {', '.join(names)}")
    values = of_quantity(held, quantity)
    if "status" in data and data["status"].dims == values.dims:
        values = _unbounded(values, data["status"], quantity)
    unknown = int(values.isnull().sum())
    if unknown:
        why = "; the variable status gives the reasons" if "status" in data else ""
        warn_of_result(
            f"fractiles: {unknown} of {values.size} values of {quantity} are missing (NaN) and "
            f"were left out{why}"
        )
    return values


@public
def exceedance(demands: xr.Dataset, quantity: str, limit: float | str | None = None) -> xr.Dataset:
    """Compute the share of the records whose peak exceeds a limit, at each scale.

    For example, ``exceedance(demands, "impact_count")`` computes the probability of impact.

    Parameters
    ----------
    demands
        Dataset of `demands`.
    quantity
        Name of a peak in the dataset, as in `fractiles`.
    limit
        Limit of the quantity, in SI units or as a string with a unit. A greater value exceeds the
        limit; for ``"displacement_min"`` a lower one. Default: 0 for counts; for other quantities
        the limit is required.

    Returns
    -------
    xarray.Dataset
        ``exceeding``, the number of records whose peak exceeds the limit, and ``probability``,
        their share. Both depend on the scale and, if there are several, on the rig.

    Raises
    ------
    InputError
        As in `fractiles`.
    """
    values = known(demands, quantity)
    least = limit_of(demands, quantity, limit)
    above = exceeds(values, quantity, least)
    data = xr.Dataset(
        {"exceeding": above.sum("record"), "probability": above.mean("record")}, _coords(values)
    )
    about = {"quantity": quantity, "limit": least}
    return described(data, "vibroimpact.exceedance", demands, about)


def exceeds(values: xr.DataArray, quantity: str, limit: float) -> xr.DataArray:
    """Return whether values of a quantity exceed a limit."""
    sense = _sense(quantity)
    return sense * values > sense * limit


def _unbounded(values: xr.DataArray, status: xr.DataArray, quantity: str) -> xr.DataArray:
    """Return values of a quantity, infinite where a run exceeded all limits."""
    all_values = values.where(~status.isin(UNSTABLE), _sense(quantity) * math.inf)
    return all_values.transpose(*values.dims)


def limit_of(demands: xr.Dataset, quantity: str, limit: float | str | None) -> float:
    """Read a limit of one of the peaks; None is 0 for counts.

    Another quantity is refused, and a missing limit of one that is not a count.
    """
    expected: Quantity = (
        _QUANTITIES.get(of_quantity(demands, quantity).attrs["units"]) or DIMENSIONLESS
    )
    if limit is None:
        if expected is DIMENSIONLESS:
            return 0.0
        raise InputError(
            f"limit: missing; pass the limit of {quantity}, such as {expected.example!r}"
        )
    return to_si(limit, expected, "limit")


def known(demands: Any, quantity: str) -> xr.DataArray:
    """Return one of the peaks, infinite where a run exceeded all limits.

    Raises
    ------
    InputError
        If it is not a dataset of demands, has no such peak, or runs were given up for other
        reasons.
    """
    held = isinstance(demands, xr.Dataset) and {"record", "scale"} <= set(demands.dims)
    if not held or "status" not in demands:
        raise InputError(f"demands: {shown(demands)}; pass the result of the function demands")
    runs = {*demands["status"].dims}
    peaks = demands[
        [
            name
            for name, one in demands.data_vars.items()
            if {*one.dims} - {*PARTS} == runs and name != "status"
        ]
    ]
    check_name(quantity, quantities(peaks), "quantity")
    status = demands["status"].values
    for code in np.unique(status[(status != Status.DONE) & ~np.isin(status, UNSTABLE)]):
        raise InputError(
            f"demands: {int((status == code).sum())} of {status.size} runs could not be computed: "
            f"{Status(int(code)).advice}"
        )
    return _unbounded(of_quantity(peaks, quantity), demands["status"], quantity)


def _coords(values: xr.DataArray) -> dict[str, Any]:
    return {
        str(dim): values[dim]
        for dim in values.dims
        if dim in values.coords and dim not in ("record", "sample")
    }


def described(
    data: xr.Dataset, created_by: str, demands: xr.Dataset, about: dict[str, Any]
) -> xr.Dataset:
    """Add units and meanings; keep those of the scale and of the varied parameters."""
    kept = {name: dict(demands[name].attrs) for name in data.coords if name in demands.coords}
    # A response of an ensemble may have names of its own.
    own = [name for name in data.data_vars if name not in VARIABLES]
    parameters = {**about, "of": motion_parameters(demands)}
    made = describe(data.drop_vars(own), created_by, parameters, noted(demands))
    for name, attributes in kept.items():
        made[name].attrs.update(attributes)
    return made.assign({name: data[name].assign_attrs(demands[name].attrs) for name in own})
