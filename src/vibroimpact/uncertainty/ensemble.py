"""Ensembles: the responses of a rig whose parameters are uncertain."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from functools import partial
from typing import Annotated, Any, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import origin
from vibroimpact.errors import InputError, shown
from vibroimpact.model import Rig
from vibroimpact.model.argument_types import Draws, NonNegativeInt, PositiveInt, function_of
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import RigOrSystem
from vibroimpact.tasks.threads import Progress, each
from vibroimpact.uncertainty.distributions import Distribution
from vibroimpact.uncertainty.random_rigs import Method, Uncertain, shares, uncertain

_Array = NDArray[np.float64]

Response = Callable[[list[Any]], xr.Dataset]
"""A function of a list of rigs that returns a dataset with the dim ``rig``, such as `sweeps`."""

CREATED_BY = "vibroimpact.ensemble"

_FIRST = 64
"""Number of rigs of the first call of the response, and the least number."""
_LASTS = 2.0
"""Target duration (s) of a call of a fast response: often enough for `progress`, and rarely enough
that many workers seldom wait for the last one."""
_GROWS = 8
"""Largest factor between the numbers of rigs of consecutive calls: the first call may compile."""


@public
def ensemble(
    rig: RigOrSystem,
    distributions: Mapping[str, Distribution | str],
    response: Response,
    draws: Draws = 128,
    *,
    method: Method = "sobol",
    seed: NonNegativeInt = 0,
    block: PositiveInt | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Draw random rigs from distributions of their parameters, and compute their responses.

    The response is any function of a list of rigs that returns a dataset with the dim ``rig``.
    `sweeps`, `demands` and `lyapunov_exponents` are such functions, if ``functools.partial`` fixes
    their other arguments. To use a function of a single rig, convert it with `for_each_rig`.
    Example::

        vi.ensemble(case, {"gap": "normal:5%"}, functools.partial(vi.sweeps, frequencies=grid))

    Parameters
    ----------
    rig
        The rig with the nominal values: a `Rig`, a published case or its code such as
        ``"B2-G1-A3"``, or the path of a study file. For a response to records, it may be an
        `Oscillator` or an `Assembly` alone.
    distributions
        Distributions of the uncertain parameters, as a mapping from names to distributions. The
        names are those of `branch`. A distribution is a frozen distribution of ``scipy.stats`` in
        SI units, or a string such as ``"normal:7.5 mm:0.5 mm"``, ``"lognormal:0.2"`` or
        ``"uniform:10%"``. A percentage refers to the value of the rig. The number of a lognormal
        distribution is the standard deviation of the logarithm, and the median is the value of the
        rig. The parameters are drawn independently of each other.
    response
        Function that computes the responses. It is called with a list of several rigs at a time.
    draws
        Number of random rigs. For the method ``"sobol"`` it must be a power of 2.
    method
        Sampling method: ``"sobol"`` (scrambled Sobol sequence), ``"latin"`` (Latin hypercube) or
        ``"random"``.
    seed
        Seed of the random rigs. The same seed gives the same rigs.
    block
        Number of rigs in each call of ``response``. Default: as many as can be computed in two
        seconds, but at least 64.
    progress
        A `progress_bar`, or a function that is called with the completed and the total number of
        rigs.

    Returns
    -------
    xarray.Dataset
        The response, with the dim ``sample`` in place of ``rig``. The drawn values of each
        parameter are a coordinate with the name of the parameter.

    Raises
    ------
    InputError
        If a value is invalid, or if a drawn value is outside the accepted range of its parameter.
        Also if the response does not return a dataset with the dim ``rig``.
    """
    drawn = uncertain(rig, distributions)
    values = drawn.values(shares(draws, len(drawn.names), method, seed))
    data = responded(drawn, values, response, block, progress)
    about = {**drawn.about(), "draws": len(values), "method": method, "seed": seed}
    # It says of itself something else than the response of its first rigs.
    data.attrs = {**data.attrs, **origin(CREATED_BY, about)}
    return labelled(data, drawn, values)


def responded(
    drawn: Uncertain,
    values: _Array,
    response: Response,
    block: int | None,
    progress: Progress | None,
) -> xr.Dataset:
    """Compute the response of the rigs at rows of values, block by block, along ``sample``."""
    if not callable(response) or isinstance(response, type):
        raise InputError(
            f"response: {shown(response)} is not a function; pass a function of a list of rigs, "
            "such as functools.partial(vibroimpact.sweeps, frequencies=...)"
        )
    rigs = drawn.rigs(values)
    parts: list[xr.Dataset] = []
    size, first = _FIRST if block is None else block, 0
    while first < len(rigs):
        some = rigs[first : first + size]
        begin = time.monotonic()
        parts.append(_part(response(some), len(some), drawn.names))
        first += len(some)
        if progress:
            progress(first, len(rigs))
        if block is None:
            taken = max(time.monotonic() - begin, 1e-9)
            size = max(_FIRST, int(size * min(_LASTS / taken, _GROWS)))
    return xr.concat(
        parts,
        "sample",
        data_vars="minimal",
        coords="minimal",
        compat="override",
        join="exact",
        combine_attrs="override",
    )


def _part(data: Any, count: int, names: list[str]) -> xr.Dataset:
    """Return the checked response of some rigs."""
    if not isinstance(data, xr.Dataset) or data.sizes.get("rig") != count:
        got = shown(data)
        if isinstance(data, xr.Dataset):
            got = f"a dataset with the dimensions {dict(data.sizes)}"
        raise InputError(
            f"response: the function returns {got} for {count} rigs; let it return a dataset with "
            "a dimension 'rig' and one entry per rig"
        )
    for name in names:
        if name in data.variables:
            raise InputError(
                f"distributions: {name!r} is also the name of a variable of the response; rename "
                "this variable in the response, or remove the parameter"
            )
    return data.drop_vars("rig", errors="ignore").rename_dims(rig="sample")


def labelled(data: xr.Dataset, drawn: Uncertain, values: _Array) -> xr.Dataset:
    """Add the drawn values of each parameter, with their units."""
    for i, varied in enumerate(drawn.parameters):
        meaning = {"units": varied.units, "long_name": varied.long_name}
        data = data.assign_coords({varied.name: ("sample", values[:, i], meaning)})
    return data


ResponseOfOne: TypeAlias = Annotated[
    Callable[[Rig], xr.Dataset],
    partial(function_of, what="a function of one rig that returns a dataset"),
]
"""Function of one rig that returns a dataset."""


@public
def for_each_rig(
    function: ResponseOfOne, threads: PositiveInt | None = None
) -> Callable[[list[Rig]], xr.Dataset]:
    """Convert a function of one rig to a function of many rigs, for `ensemble` and `sensitivity`.

    Parameters
    ----------
    function
        Function of one rig that returns a dataset. The dims of this dataset must have the same
        sizes for all rigs. An example is ``lambda rig: vi.steady(rig)[["displacement_max",
        "period"]]``.
    threads
        Number of threads (default: one per processor).
    """

    def responses(rigs: list[Rig]) -> xr.Dataset:
        def one(rig: Rig, _: Any) -> xr.Dataset:
            return function(rig)

        return xr.concat(each(one, rigs, threads=threads), "rig", combine_attrs="override")

    return responses
