"""Fragility curves: the probability that a peak exceeds a limit, over the level of shaking."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.earthquakes.credible_curves import begin_to_exceed, credible_curves
from vibroimpact.earthquakes.suites import described, exceedance, exceeds, known, limit_of
from vibroimpact.errors import InputError, warn_of_result
from vibroimpact.model.argument_types import Share
from vibroimpact.model.parameters import in_units, usual
from vibroimpact.model.public import public
from vibroimpact.model.quantities import ACCELERATION, DIMENSIONLESS
from vibroimpact.model.units import pretty

_Array = NDArray[np.float64]

_TOLD = 5
"""Largest number of curves without an interval, or without a fit, that a warning lists by name."""
_IN_ERROR = 2
"""The same for an error, which is one short line."""


class LognormalFit(NamedTuple):
    """A lognormal curve Φ((ln s − ln θ)/β)."""

    log_median: float
    """ln θ."""
    log_dispersion: float
    """ln β."""

    def reached(self, logarithms: _Array) -> _Array:
        """Return (ln s − ln θ)/β."""
        return (logarithms - self.log_median) / math.exp(self.log_dispersion)


@public
def fragility(
    demands: xr.Dataset,
    quantity: str,
    limit: float | str | None = None,
    *,
    confidence: Share = 0.9,
) -> xr.Dataset:
    """Fit a lognormal fragility curve to the numbers of records that exceed a limit at each scale.

    The curve is P(scale) = Φ((ln scale − ln θ)/β), where Φ is the standard normal distribution
    function. The median θ and the dispersion β maximise the binomial likelihood of the numbers of
    records above the limit (Baker 2015, Earthquake Spectra 31(1)).

    The same records are used at all scales. Therefore the numbers at two scales are not
    independent, and the intervals count each record only once. For each record they use the two
    scales between which the record begins to exceed the limit. The intervals and the confidence
    band belong to a set of lognormal curves that rise with the scale. The intervals and the band
    are also valid for few records. In that case the fitted β is too small on average, and it lies
    in the lower part of its interval.

    Parameters
    ----------
    demands
        Dataset of `demands`.
    quantity
        Name of a peak in the dataset, as in `fractiles`. Use ``"impact_count"`` for the probability
        that an impact occurs, and ``"impact_count.right"`` for that on the right stop.
    limit
        Limit of the quantity, as in `exceedance`. Default: 0 for counts; for other quantities the
        limit is required.
    confidence
        Confidence level of the intervals, between 0 and 1.

    Returns
    -------
    xarray.Dataset
        ``median_capacity`` is θ, in the units of the scale. ``dispersion`` is β.
        ``fitted_probability`` is the curve at the scales. The interval of each of these three
        variables has the same name with ``_bound`` (dim ``bound``: lower, upper). ``exceeding`` and
        ``probability`` are defined as in `exceedance`.

        A curve is NaN if the records do not determine it, for example because fewer than two scales
        have records both above and below the limit. A warning and the attribute ``undetermined``
        then list the rigs. The intervals of a curve are unbounded if fewer than two records begin
        to exceed the limit within the scales. A warning and the attribute ``unbounded`` then list
        the curves. Both attributes also state which scales would be needed.

    Raises
    ------
    InputError
        As in `exceedance`. Also if no rig has a curve, or if there are fewer than 3 records.
    """
    values = known(demands, quantity)
    least = limit_of(demands, quantity, limit)
    if values.sizes["record"] < 3:
        raise InputError(
            f"demands: a fragility curve requires at least 3 records, not "
            f"{values.sizes['record']}; compute demands for more records"
        )
    order = ("record", "scale", *_others(values))
    above = exceeds(values, quantity, least).transpose(*order).values
    logarithms = np.log(values["scale"].values)
    shape = above.shape[2:]
    variables = {
        name: np.full((*extra, *shape), np.nan)
        for name, extra in (
            ("median_capacity", ()),
            ("dispersion", ()),
            ("fitted_probability", (len(logarithms),)),
            ("median_capacity_bound", (2,)),
            ("dispersion_bound", (2,)),
            ("fitted_probability_bound", (2, len(logarithms))),
        )
    }
    for at in np.ndindex(*shape):
        one = _curve(above[(slice(None), slice(None), *at)], logarithms, confidence)
        if one is not None:
            for name, value in one.items():
                variables[name][(..., *at)] = value
    none = np.isnan(variables["median_capacity"])
    what = "above the limit" if limit is not None else f"above 0 in {quantity}"
    undetermined = _undetermined(none, values, above, what, _IN_ERROR if none.all() else _TOLD)
    if none.all():
        beginning = "demands:" if limit is None else f"limit: {limit!r};"
        raise InputError(f"{beginning} {undetermined}")
    if undetermined:
        warn_of_result(f"fragility: {undetermined}")
    others = order[2:]
    unbounded = _unbounded(variables["median_capacity_bound"], values, above)
    if unbounded:
        warn_of_result(f"fragility: {unbounded}")
    dims = {
        "fitted_probability": ("scale", *others),
        "fitted_probability_bound": ("bound", "scale", *others),
    }
    data = exceedance(demands, quantity, least).assign(
        {
            name: (dims.get(name, (*(("bound",) if "bound" in name else ()), *others)), value)
            for name, value in variables.items()
        }
    )
    data = data.assign_coords(bound=["lower", "upper"])
    data.attrs.clear()
    about = {"quantity": quantity, "limit": least, "confidence": confidence}
    data = described(data, "vibroimpact.fragility", demands, about)
    data.attrs.update(
        {
            name: message
            for name, message in (("undetermined", undetermined), ("unbounded", unbounded))
            if message
        }
    )
    for name in ("median_capacity", "median_capacity_bound"):
        data[name].attrs["units"] = demands["scale"].attrs["units"]
    return data


def _undetermined(
    none: NDArray[np.bool_], values: xr.DataArray, above: NDArray[np.bool_], what: str, most: int
) -> str:
    """Describe which rigs have no curve, and which levels would give one; "" if all have one."""
    reasons = []
    for at in np.argwhere(none):
        why = _why(above[(slice(None), slice(None), *at)], values["scale"], what)
        whose = _whose(values, at)
        reasons.append(f"no curve {whose}: {why}" if whose else why)
    return _listed(reasons, most)


def _why(above: NDArray[np.bool_], scale: xr.DataArray, what: str) -> str:
    """Explain why a rig has no curve, and which levels would give one."""
    match lacking(above.mean(axis=0)):
        case "higher scales":
            return f"no record is {what} at any scale, so pass higher scales to demands"
        case "lower scales":
            return f"all records are {what} at every scale, so pass lower scales to demands"
        case "finer scales":
            return (
                f"at fewer than two scales, some records are {what} and others are not, "
                f"so pass {_finer(above, scale)} to demands"
            )
    return (
        f"the share of the records that are {what} does not rise with the scale, so pass other "
        "scales to demands"
    )


def lacking(shares: _Array) -> str:
    """Return which levels would determine a curve, from the share that exceeds at each level."""
    if not shares.any():
        return "higher scales"
    if (shares == 1.0).all():
        return "lower scales"
    separate = np.flatnonzero(shares < 1.0)[-1] <= np.flatnonzero(shares > 0.0)[0]
    return "finer scales" if separate else "other scales"


def _finer(above: NDArray[np.bool_], scale: xr.DataArray) -> str:
    """Return the levels between which the records begin to exceed."""
    none, every = ~above.any(axis=0), above.all(axis=0)
    low = float(scale[np.flatnonzero(none)[-1] if none.any() else 0])
    high = float(scale[np.flatnonzero(every)[0] if every.any() else -1])
    quantity = DIMENSIONLESS if scale.attrs["units"] == "1" else ACCELERATION
    beyond = " and ".join(
        word for word, there in (("lower", none.any()), ("higher", every.any())) if not there
    )
    if low == high:
        return f"{beyond} scales"
    finer = f"finer scales between {pretty(low, quantity)} and {pretty(high, quantity)}"
    return f"{finer}, and {beyond} scales" if beyond else finer


def _unbounded(bounds: _Array, values: xr.DataArray, above: NDArray[np.bool_]) -> str:
    """Describe curves without an interval, and levels that would give one; "" if all have one."""
    needs = []
    for at in np.argwhere(np.isinf(bounds[1])):
        one = above[(slice(None), slice(None), *at)]
        begin = begin_to_exceed(one.sum(axis=0), len(one))
        beyond = (word for word, n in (("lower", begin[0]), ("higher", begin[-1])) if n > 0.0)
        needs.append(f"{' and '.join(beyond)} scales {_whose(values, at)}".rstrip())
    if not needs:
        return ""
    return (
        "there is no interval, because fewer than two records begin to exceed the limit within "
        f"the scales; to get an interval, pass to demands: {_listed(needs)}"
    )


def _listed(texts: list[str], most: int = _TOLD) -> str:
    left = len(texts) - most
    more = [f"and {left} more curve{'s' if left > 1 else ''}"] if left > 0 else []
    return "; ".join([*texts[:most], *more])


def _whose(values: xr.DataArray, at: NDArray[np.int64]) -> str:
    """Return the rig of a curve in words, such as "for gap 200 mm"; "" for a single rig."""
    names = [_named(values[dim], i) for dim, i in zip(_others(values), at, strict=True)]
    return f"for {', '.join(names)}" if names else ""


def _others(values: xr.DataArray) -> list[str]:
    return [str(dim) for dim in values.dims if dim not in ("record", "scale")]


def _named(coordinate: xr.DataArray, at: int) -> str:
    """Return one value of a varied parameter in words, such as gap 200 mm."""
    name, value = str(coordinate.name), coordinate.values[at]
    words = name.replace("_", " ")
    if coordinate.dtype.kind == "U":
        return f"{words} {value}"
    try:
        quantity = in_units(str(coordinate.attrs.get("units", usual(name).units)))
    except StopIteration:  # the unit depends on an exponent
        return f"{words} {value}"
    return f"{words} {pretty(float(value), quantity)}"


def _curve(
    above: NDArray[np.bool_], logarithms: _Array, confidence: float
) -> dict[str, float | _Array] | None:
    """Fit the curve of one rig with its uncertainty; None if it is not determined."""
    from scipy.special import ndtr

    exceeding, count = above.sum(axis=0), len(above)
    whole = fit(exceeding, count, logarithms)
    if whole is None:
        return None
    values = {
        "median_capacity": math.exp(whole.log_median),
        "dispersion": math.exp(whole.log_dispersion),
        "fitted_probability": ndtr(whole.reached(logarithms)),
        "median_capacity_bound": np.array([0.0, np.inf]),
        "dispersion_bound": np.array([0.0, np.inf]),
        "fitted_probability_bound": np.array([[0.0], [1.0]]) + 0.0 * logarithms,
    }
    curves = credible_curves(exceeding, count, logarithms)
    if curves is not None:
        values["median_capacity_bound"] = curves.median_range(confidence)
        values["dispersion_bound"] = curves.dispersion_range(confidence)
        values["fitted_probability_bound"] = curves.probability_range(logarithms, confidence)
    return values


def fit(exceeding: NDArray[np.int64], count: int, logarithms: _Array) -> LognormalFit | None:
    """Fit the curve of the largest binomial likelihood.

    `exceeding` is the number of records, of `count`, that exceed at each scale.

    Returns
    -------
    Fit or None
        None if no curve is determined: all records that exceed do so at scales above all those at
        which a record does not, or the curve falls.
    """
    from scipy.optimize import minimize
    from scipy.special import log_ndtr

    some, others = np.flatnonzero(exceeding > 0), np.flatnonzero(exceeding < count)
    if not len(some) or not len(others) or logarithms[others[-1]] <= logarithms[some[0]]:
        return None
    middle, size = logarithms.mean(), np.ptp(logarithms)
    x = (logarithms - middle) / size

    def unlikely(line: _Array) -> tuple[float, _Array]:
        """Return minus the log-likelihood of Φ(a + b x), which is convex, and its slope."""
        z = line[0] + line[1] * x
        up, down = log_ndtr(z), log_ndtr(-z)
        density = -0.5 * z * z - 0.5 * math.log(math.tau)
        slope = exceeding * np.exp(density - up) - (count - exceeding) * np.exp(density - down)
        return (
            -float((exceeding * up + (count - exceeding) * down).sum()),
            -np.array([slope.sum(), (slope * x).sum()]),
        )

    first = np.array([0.0, 2.0])
    optimum = minimize(unlikely, first, jac=True, method="BFGS", options={"gtol": 1e-9 * count})
    a, b = optimum.x
    if not b > 0.0:
        return None
    return LognormalFit(middle - a / b * size, math.log(size / b))
