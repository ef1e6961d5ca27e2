"""Ensembles: the response of a rig whose parameters are uncertain."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.arguments import check_progress
from vibroimpact.datasets.description import origin
from vibroimpact.errors import InputError, shown
from vibroimpact.model import Oscillator, Rig
from vibroimpact.model.count_checks import whole
from vibroimpact.model.read_rig import AnyRig
from vibroimpact.tasks.threads import Progress, each
from vibroimpact.uncertainty.distributions import Distribution
from vibroimpact.uncertainty.random_rigs import Method, Uncertain, shares, uncertain

_Array = NDArray[np.float64]

Response = Callable[[list[Any]], xr.Dataset]
"""A function of a list of rigs that gives a dataset with the dim ``rig``, such as `sweeps`."""

CREATED_BY = "vibroimpact.ensemble"

_FIRST = 64
"""Rigs that the response is asked for at first, and at least."""
_LASTS = 2.0
"""Seconds that it then takes at a time, if it is quick: often enough to tell `progress`, and
seldom enough to wait for the last of many workers."""
_GROWS = 8
"""By how much more rigs are asked for than before, at most: the first time it may compile."""


def ensemble(
    rig: AnyRig | Oscillator,
    distributions: Mapping[str, Distribution | str],
    response: Response,
    draws: int = 128,
    *,
    method: Method = "sobol",
    seed: int = 0,
    block: int | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Draw rigs from the distributions of their parameters, and ask what each responds.

    The response is any function of a list of rigs that returns a dataset with the dim ``rig``:
    `sweeps`, `demands` and `lyapunov_exponents` are such functions, their other arguments given
    beforehand, and `for_each_rig` makes one of a function of a single rig::

        vi.ensemble(case, {"gap": "normal:5%"}, functools.partial(vi.sweeps, frequencies=grid))

    Parameters
    ----------
    rig
        The rig: a `Rig`, a laboratory case, its code, or the path of a study file; or an
        `Oscillator` alone, for a response to records.
    distributions
        By parameter, as of `branch`: frozen distributions of ``scipy.stats`` in SI units, or texts
        such as ``"normal:7.5 mm:0.5 mm"``, ``"lognormal:0.2"`` or ``"uniform:10%"`` (of the rig's
        own value). They are independent of each other.
    response
        Called with a list of some rigs at a time.
    draws
        Number of random rigs; a power of 2 for the method sobol.
    method
        Sampling method: ``"sobol"`` (scrambled Sobol sequence), ``"latin"`` (Latin hypercube) or
        ``"random"``.
    seed
        Random seed. The same seed gives the same rigs.
    block
        How many rigs the response is asked for at a time; None for 64 or as many as take two
        seconds, whichever is more.
    progress
        Called with the rigs done and all.

    Returns
    -------
    xarray.Dataset
        What the response is, with dim ``sample`` in the place of ``rig``, along which the drawn
        values of each parameter stand by its name.

    Raises
    ------
    InputError
        If a value cannot be used, a draw is one that the parameter cannot have, or the response
        gives no dataset over rigs.
    """
    check_progress(progress)
    drawn = uncertain(rig, distributions)
    values = drawn.values(shares(draws, len(drawn.names), method, whole(seed, "seed", 0)))
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
    """The response of the rigs at rows of values, block by block, along ``sample``."""
    if not callable(response) or isinstance(response, type):
        raise InputError(
            f"response: {shown(response)} is no function; one of a list of rigs is accepted, such "
            "as functools.partial(vibroimpact.sweeps, frequencies=...)"
        )
    rigs = drawn.rigs(values)
    parts: list[xr.Dataset] = []
    size, first = _FIRST if block is None else whole(block, "block"), 0
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
    """What a response gives of some rigs, checked."""
    if not isinstance(data, xr.Dataset) or data.sizes.get("rig") != count:
        got = dict(data.sizes) if isinstance(data, xr.Dataset) else shown(data)
        raise InputError(
            f"response: it gives {got} for {count} rigs; a dataset with the dim rig, one for each "
            "of them, is accepted"
        )
    for name in names:
        if name in data.variables:
            raise InputError(
                f"distributions: {name!r} is a variable of the response itself; other parameters "
                "are accepted beside it"
            )
    return data.drop_vars("rig", errors="ignore").rename_dims(rig="sample")


def labelled(data: xr.Dataset, drawn: Uncertain, values: _Array) -> xr.Dataset:
    """With the drawn values of each parameter, and their units."""
    for i, varied in enumerate(drawn.parameters):
        meaning = {"units": varied.units, "long_name": varied.long_name}
        data = data.assign_coords({varied.name: ("sample", values[:, i], meaning)})
    return data


def for_each_rig(
    function: Callable[[Rig], xr.Dataset], threads: int | None = None
) -> Callable[[list[Rig]], xr.Dataset]:
    """Make a function of many rigs from a function of one, for `ensemble` and `sensitivity`.

    Parameters
    ----------
    function
        Called with a rig; it returns a dataset whose dims have the same sizes for all rigs. For
        example ``lambda rig: vi.steady(rig)[["displacement_max", "period"]]``.
    threads
        How many run at once; None for one a processor.
    """

    def responses(rigs: list[Rig]) -> xr.Dataset:
        def one(rig: Rig, _: Any) -> xr.Dataset:
            return function(rig)

        return xr.concat(each(one, rigs, threads=threads), "rig", combine_attrs="override")

    return responses
