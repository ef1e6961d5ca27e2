"""Which uncertain parameter matters: Sobol's indices of the variance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.stats import qmc

from vibroimpact.arguments import check_name, check_progress
from vibroimpact.datasets.description import describe
from vibroimpact.model import Oscillator
from vibroimpact.model.count_checks import MOST_DRAWS, MOST_RESAMPLES, whole
from vibroimpact.model.read_rig import AnyRig
from vibroimpact.tasks.threads import Progress
from vibroimpact.uncertainty.distributions import Distribution
from vibroimpact.uncertainty.ensemble import Response, responded
from vibroimpact.uncertainty.random_rigs import check_power, uncertain

_Array = NDArray[np.float64]

CREATED_BY = "vibroimpact.sensitivity"
CONFIDENCE = 0.95
_RESAMPLES = 100
"""Bootstrap samples of the intervals of `peak_sensitivity`."""


def sensitivity(
    rig: AnyRig | Oscillator,
    distributions: Mapping[str, Distribution | str],
    response: Response,
    quantity: str,
    draws: int = 256,
    *,
    seed: int = 0,
    resamples: int = 0,
    block: int | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Return how much of the variance of a response each uncertain parameter makes.

    By the estimators of Saltelli et al. (2010), from ``draws`` × (parameters + 2) rigs.

    Parameters
    ----------
    rig, distributions, response, block
        As of `ensemble`.
    quantity
        A variable of the response; a dataset of it has its other dims.
    draws
        Points of each of the two sets, a power of 2.
    seed
        The same one gives the same indices.
    resamples
        Of the points, for 95 % intervals of the indices by bootstrapping; 0 for none.
    progress
        Called with the rigs done and all.

    Returns
    -------
    xarray.Dataset
        Dim ``uncertain_parameter``, and those of the quantity: ``first_order``, the share of the
        variance that the parameter makes by itself, and ``total_order``, with all that it makes
        together with others; their ``first_order_interval`` and ``total_order_interval`` (dim
        ``bound``) if asked for; ``mean`` and ``variance`` of the quantity, over the first two
        sets. An index is NaN where a response is, or where nothing varies.

    Raises
    ------
    InputError
        As of `ensemble`; or if the response has no such quantity.
    """
    check_progress(progress)
    drawn = uncertain(rig, distributions)
    count = whole(draws, "draws", most=MOST_DRAWS)
    resampled_sets = whole(resamples, "resamples", 0, MOST_RESAMPLES)
    check_power(count, "draws", "Sobol's points")
    seed = whole(seed, "seed", 0)
    columns = len(drawn.names)
    points = qmc.Sobol(2 * columns, rng=seed).random(count)
    a, b = points[:, :columns], points[:, columns:]
    # Of each parameter the first set with that column of the second one.
    sets = [a, b, *(np.where(np.arange(columns) == i, b, a) for i in range(columns))]
    data = responded(drawn, drawn.values(np.concatenate(sets)), response, block, progress)
    check_name(
        quantity,
        [str(key) for key, one in data.variables.items() if "sample" in one.dims],
        "quantity",
    )
    values = data[quantity].transpose(..., "sample").astype(float)
    one = values.isel(sample=0, drop=True)
    found = values.values.reshape(*one.shape, columns + 2, count)

    dims = (*(str(dim) for dim in one.dims), "uncertain_parameter")
    first, total = _orders(found)
    variables: dict[str, Any] = {
        "first_order": (dims, first),
        "total_order": (dims, total),
        "mean": (dims[:-1], found[..., :2, :].mean(axis=(-2, -1))),
        "variance": (dims[:-1], found[..., :2, :].var(axis=(-2, -1))),
    }
    if resampled_sets:
        again = np.random.default_rng(seed).integers(count, size=(resampled_sets, count))
        resampled = np.array([_orders(found[..., chosen]) for chosen in again])
        tails = 0.5 * np.array([1.0 - CONFIDENCE, 1.0 + CONFIDENCE])
        intervals = np.moveaxis(np.quantile(resampled, tails, axis=0), 0, -1)
        variables["first_order_interval"] = ((*dims, "bound"), intervals[0])
        variables["total_order_interval"] = ((*dims, "bound"), intervals[1])
    coords = {name: coord for name, coord in one.coords.items() if name not in drawn.names}
    made = xr.Dataset(variables, {**coords, "uncertain_parameter": drawn.names})
    made.attrs["quantity"] = quantity
    about = {**drawn.about(), "quantity": quantity, "draws": count, "seed": seed}
    made = describe(made, CREATED_BY, about)
    units = str(one.attrs.get("units", "1"))
    made["mean"].attrs["units"] = units
    made["variance"].attrs["units"] = "1" if units == "1" else f"({units})2"
    return made


def _orders(found: _Array) -> tuple[_Array, _Array]:
    """First and total orders: (b) and (f) of Table 2 of Saltelli et al. (2010).

    Of values of the two sets and of the mixed ones, on the axis before the last; NaN where a value
    is, or where nothing varies.
    """
    both, mixed = found[..., :2, :], found[..., 2:, :]
    a, b = (both[..., i : i + 1, :] - both.mean(axis=(-2, -1))[..., None, None] for i in (0, 1))
    mixed = mixed - both.mean(axis=(-2, -1))[..., None, None]
    variance = both.var(axis=(-2, -1))[..., None]
    variance = np.where(variance > 0.0, variance, np.nan)
    first = (b * (mixed - a)).mean(axis=-1) / variance
    total = 0.5 * ((a - mixed) ** 2).mean(axis=-1) / variance
    return first, total


def peak_sensitivity(
    rig: AnyRig | Oscillator,
    distributions: Mapping[str, Distribution | str],
    response: Response,
    quantities: Sequence[str],
    *,
    draws: int,
    seed: int = 0,
    progress: Progress | None = None,
) -> dict[str, xr.Dataset]:
    """Compute `sensitivity` of the peaks of resonance curves, for each quantity, with intervals."""

    def peaks(rigs: list[Any]) -> xr.Dataset:
        data = response(rigs)[list(quantities)]
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
