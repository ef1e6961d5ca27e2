"""Sensitivity of a response to uncertain parameters: Sobol indices of the variance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Annotated, Any

import numpy as np
import scipy
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.arguments import check_name
from vibroimpact.datasets.description import describe
from vibroimpact.datasets.stops import over_parts
from vibroimpact.datasets.stops import quantities as quantities_of
from vibroimpact.datasets.stops import quantity as of_quantity
from vibroimpact.model.argument_types import (
    MOST_RESAMPLES,
    Draws,
    NonNegativeInt,
    PositiveInt,
    whole,
)
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import RigOrSystem
from vibroimpact.tasks.threads import Progress
from vibroimpact.uncertainty.distributions import Distribution
from vibroimpact.uncertainty.ensemble import Response, responded
from vibroimpact.uncertainty.random_rigs import check_power, uncertain

_Array = NDArray[np.float64]

CREATED_BY = "vibroimpact.sensitivity"
CONFIDENCE = 0.95
_RESAMPLES = 100
"""Number of bootstrap samples for the intervals of `peak_sensitivity`."""


@public
def sensitivity(
    rig: RigOrSystem,
    distributions: Mapping[str, Distribution | str],
    response: Response,
    quantity: str,
    draws: Draws = 256,
    *,
    seed: NonNegativeInt = 0,
    resamples: Annotated[int, partial(whole, least=0, most=MOST_RESAMPLES)] = 0,
    block: PositiveInt | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute Sobol indices: the share of a response's variance that is due to each parameter.

    The estimators are those of Saltelli et al. (2010). They require ``draws`` × (number of
    parameters + 2) rigs.

    Parameters
    ----------
    rig, distributions, response, block
        As in `ensemble`.
    quantity
        Name of a variable of the response, also of one stop, mass or link, such as
        ``"peak_force.right"``. The result has the dims of this variable, except the dim of the
        rigs.
    draws
        Number of points in each of the two sets of random rigs. It must be a power of 2.
    seed
        Seed of the random rigs. The same seed gives the same indices.
    resamples
        Number of bootstrap samples from which 95 % intervals of the indices are computed. If it is
        0, there are no intervals.
    progress
        A `progress_bar`, or a function that is called with the completed and the total number of
        rigs.

    Returns
    -------
    xarray.Dataset
        The dims are ``uncertain_parameter`` and the dims of the quantity. The variables are:

        - ``first_order``, the share of the variance that is due to the parameter alone;
        - ``total_order``, the share that also includes its interactions with other parameters;
        - ``first_order_interval`` and ``total_order_interval`` (dim ``bound``), if ``resamples`` is
          not 0;
        - ``mean`` and ``variance`` of the quantity, over the first two sets of rigs.

        An index is NaN if a response is NaN, or if the response does not vary.

    Raises
    ------
    InputError
        As in `ensemble`. Also if the response does not contain the quantity.
    """
    drawn = uncertain(rig, distributions)
    check_power(draws)
    columns = len(drawn.names)
    points = scipy.stats.qmc.Sobol(2 * columns, rng=seed).random(draws)
    a, b = points[:, :columns], points[:, columns:]
    # Of each parameter the first set with that column of the second one.
    sets = [a, b, *(np.where(np.arange(columns) == i, b, a) for i in range(columns))]
    data = responded(drawn, drawn.values(np.concatenate(sets)), response, block, progress)
    known = [one for one in quantities_of(data) if "sample" in of_quantity(data, one).dims]
    check_name(quantity, [*known, *drawn.names], "quantity")
    held = data[quantity] if quantity in data else of_quantity(data, quantity)
    values = held.transpose(..., "sample").astype(float)
    one = values.isel(sample=0, drop=True)
    samples = values.values.reshape(*one.shape, columns + 2, draws)

    dims = (*(str(dim) for dim in one.dims), "uncertain_parameter")
    first, total = _orders(samples)
    variables: dict[str, Any] = {
        "first_order": (dims, first),
        "total_order": (dims, total),
        "mean": (dims[:-1], samples[..., :2, :].mean(axis=(-2, -1))),
        "variance": (dims[:-1], samples[..., :2, :].var(axis=(-2, -1))),
    }
    if resamples:
        again = np.random.default_rng(seed).integers(draws, size=(resamples, draws))
        resampled = np.array([_orders(samples[..., chosen]) for chosen in again])
        tails = 0.5 * np.array([1.0 - CONFIDENCE, 1.0 + CONFIDENCE])
        intervals = np.moveaxis(np.quantile(resampled, tails, axis=0), 0, -1)
        variables["first_order_interval"] = ((*dims, "bound"), intervals[0])
        variables["total_order_interval"] = ((*dims, "bound"), intervals[1])
    coords = {name: coord for name, coord in one.coords.items() if name not in drawn.names}
    made = xr.Dataset(variables, {**coords, "uncertain_parameter": drawn.names})
    made.attrs["quantity"] = quantity
    about = {**drawn.about(), "quantity": quantity, "draws": draws, "seed": seed}
    made = describe(made, CREATED_BY, about)
    units = str(one.attrs.get("units", "1"))
    made["mean"].attrs["units"] = units
    made["variance"].attrs["units"] = "1" if units == "1" else f"({units})2"
    return made


def _orders(samples: _Array) -> tuple[_Array, _Array]:
    """Compute first and total orders: (b) and (f) of Table 2 of Saltelli et al. (2010).

    The axis before the last holds the values of both sets and of the mixed ones. An index is NaN if
    a value is NaN, or if nothing varies.
    """
    both, mixed = samples[..., :2, :], samples[..., 2:, :]
    a, b = (both[..., i : i + 1, :] - both.mean(axis=(-2, -1))[..., None, None] for i in (0, 1))
    mixed = mixed - both.mean(axis=(-2, -1))[..., None, None]
    variance = both.var(axis=(-2, -1))[..., None]
    variance = np.where(variance > 0.0, variance, np.nan)
    first = (b * (mixed - a)).mean(axis=-1) / variance
    total = 0.5 * ((a - mixed) ** 2).mean(axis=-1) / variance
    return first, total


def peak_sensitivity(
    rig: RigOrSystem,
    distributions: Mapping[str, Distribution | str],
    response: Response,
    quantities: Sequence[str],
    *,
    draws: int,
    seed: int = 0,
    progress: Progress | None = None,
) -> dict[str, xr.Dataset]:
    """Compute `sensitivity` of the peaks of resonance curves, for each quantity, with intervals.

    Of an assembly, a peak is the largest one of all masses or stops.
    """

    def peaks(rigs: list[Any]) -> xr.Dataset:
        data = response(rigs)[list(quantities)].map(over_parts, keep_attrs=True)
        return data.max(("direction", "frequency"), keep_attrs=True)

    return {
        name: sensitivity(
            rig,
            distributions,
            peaks,
            name,
            draws,
            seed=seed,
            resamples=_RESAMPLES,
            progress=progress,
        )
        for name in quantities
    }
