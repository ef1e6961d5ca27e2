"""Distributions of uncertain parameters: frozen distributions of scipy.stats, or strings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Protocol

import numpy as np
import scipy
from numpy.typing import NDArray

from vibroimpact.errors import InputError, shown
from vibroimpact.model.parameters import Parameter
from vibroimpact.model.quantities import DIMENSIONLESS
from vibroimpact.model.quantity_lists import check_stated_units
from vibroimpact.model.units import pretty, to_si

_Array = NDArray[np.float64]


class Distribution(Protocol):
    """Interface of a distribution, which every frozen distribution of `scipy.stats` has."""

    def ppf(self, q: _Array) -> _Array:
        """Return the quantiles at the shares q (the inverse of the distribution function)."""


KINDS = (
    "normal:MEAN:DEVIATION[:LOW:HIGH], lognormal:MEDIAN:SIGMA, uniform:LOW:HIGH, "
    "triangular:LOW:MODE:HIGH; or, around the rig's value, normal:5%, lognormal:0.2, uniform:5%"
)


def distribution(
    spec: Any, varied: Parameter, own: Callable[[], float], field: str
) -> Distribution:
    """Read a distribution.

    Parameters
    ----------
    spec
        A frozen distribution of `scipy.stats`, in SI units; or a string as in `KINDS`, such as
        ``"normal:7.5 mm:0.5 mm"`` or ``"uniform:5%"``. SIGMA is the standard deviation of the
        logarithm.
    own
        Function that returns the rig's own value, to which shares refer.

    Raises
    ------
    InputError
        If it is not a distribution.
    """
    if not isinstance(spec, str):
        if not callable(getattr(spec, "ppf", None)) or not hasattr(spec, "args"):
            raise InputError(
                f"{field}: {shown(spec)} is not a distribution; pass a frozen distribution of "
                f"scipy.stats, or a string: {KINDS}"
            )
        frozen: Distribution = spec
        return frozen
    kind, *texts = (part.strip() for part in spec.split(":"))
    try:
        return _made(kind.lower(), texts, varied, own, field)
    except _Unknown:
        raise InputError(f"{field}: {spec!r} is not a distribution; use {KINDS}") from None


class _Unknown(Exception):  # noqa: N818 - turned into words
    """Raised for an unknown kind, or a wrong count of numbers."""


def _made(
    kind: str, texts: list[str], varied: Parameter, own: Callable[[], float], field: str
) -> Distribution:
    def value(text: str) -> float:
        return to_si(text, varied.quantity, field)

    def number(text: str) -> float:
        return to_si(text, DIMENSIONLESS, field, above=0.0)

    def pair(low: str, high: str) -> tuple[float, float]:
        ends = value(low), value(high)
        if not ends[0] < ends[1]:
            raise InputError(f"{field}: {low!r} is not below {high!r}; put the lower value first")
        return ends

    made: Distribution
    if kind in ("normal", "uniform", "triangular") and len(texts) > 1:
        check_stated_units(texts, varied.quantity, field)
    match kind, texts:
        case "normal", [share]:
            made = scipy.stats.norm(own(), number(share) * abs(own()))
        case "normal", [mean, deviation]:
            made = scipy.stats.norm(
                value(mean), to_si(deviation, varied.quantity, field, above=0.0)
            )
        case "normal", [mean, deviation, *bounds] if len(bounds) == 2:
            at = value(mean)
            wide = to_si(deviation, varied.quantity, field, above=0.0)
            low, high = pair(*bounds)
            made = scipy.stats.truncnorm((low - at) / wide, (high - at) / wide, at, wide)
        case "lognormal", [share]:
            made = scipy.stats.lognorm(number(share), scale=_positive(own(), field))
        case "lognormal", [median, sigma]:
            made = scipy.stats.lognorm(number(sigma), scale=_positive(value(median), field))
        case "uniform", [share]:
            half = number(share) * abs(own())
            made = scipy.stats.uniform(own() - half, 2.0 * half)
        case "uniform", [low, high]:
            first, last = pair(low, high)
            made = scipy.stats.uniform(first, last - first)
        case "triangular", [low, mode, high]:
            first, last = pair(low, high)
            middle = value(mode)
            if not first <= middle <= last:
                raise InputError(
                    f"{field}: the mode {mode!r} is not between {low!r} and {high!r}; use a mode "
                    "between them"
                )
            made = scipy.stats.triang((middle - first) / (last - first), first, last - first)
        case _:
            raise _Unknown
    return made


def _positive(value: float, field: str) -> float:
    if not value > 0.0:
        raise InputError(
            f"{field}: a lognormal distribution cannot have a median of {value:g}; use a median "
            "above 0, or a normal or uniform distribution"
        )
    return value


def text_of(spec: Any) -> str:
    """Describe a distribution as text, for the attributes of a dataset."""
    if isinstance(spec, str):
        return spec
    kept = [f"{number:.12g}" for number in spec.args]
    kept += [f"{name}={number:.12g}" for name, number in spec.kwds.items()]
    return f"{spec.dist.name}({', '.join(kept)})"


def check_values(values: _Array, varied: Parameter, field: str) -> None:
    """Raise an error for draws that the parameter does not accept.

    The message has the worst one.
    """
    least, most = varied.least, varied.most
    short = np.zeros(values.shape, dtype=bool) if least is None else values < least
    if not varied.zero:
        short |= values <= 0.0
    wrong = short | ~np.isfinite(values)
    if most is not None:
        wrong |= values > most
    if not wrong.any():
        return
    low = f"at least {least:g}" if varied.zero and least is not None else "more than 0"
    accepted = "finite values" if varied.zero and least is None else f"values of {low}"
    if most is not None:
        accepted += f" and at most {most:g}"
    worst = pretty(float(values[wrong][0]), varied.quantity)
    raise InputError(
        f"{field}: this distribution gives the value {worst}, but only {accepted} are "
        "possible; use a lognormal distribution, or a normal one with bounds"
    )


def check_names(distributions: Any) -> dict[str, Any]:
    """Read the distributions by parameter, a mapping that is not empty."""
    if not isinstance(distributions, Mapping) or not distributions:
        raise InputError(
            f"distributions: {shown(distributions)}; pass a mapping from parameters to "
            'distributions, such as {"gap": "normal:5%"}'
        )
    return {str(name): one for name, one in distributions.items()}
