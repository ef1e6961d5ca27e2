"""Numbers of a column or a row, in one unit that fits the largest of them."""

from __future__ import annotations

import math
from collections.abc import Iterable

from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.model.parameters import in_units
from vibroimpact.model.quantities import FREQUENCY, Scale, fitting
from vibroimpact.model.units import plain
from vibroimpact.model.written_units import unit, unitless


def shown_in(units: str, values: Iterable[float]) -> Scale:
    """The unit in which values of a dataset's units are written."""
    try:
        return fitting(values, in_units(units).scales)
    except StopIteration:  # of a law with another exponent
        return Scale(0.0, 1.0, units)


def heading(words: str, units: str, values: Iterable[float]) -> tuple[Scale, str]:
    """The unit of a column, and its heading with this unit: ω if it is a frequency without one."""
    if words == "frequency" and unitless():
        return fitting(values, FREQUENCY.scales), "ω"
    scale = shown_in(units, values)
    symbol = f" ({scale.symbol})" if scale.symbol else ""
    return scale, f"{words}{unit(symbol)}"


def written(of: str, *values: float, digits: int = 4, like: Iterable[float] = ()) -> str:
    """Write values of a variable with one unit, such as ``"0.5 to 2 mm"``.

    Parameters
    ----------
    of
        Name of the variable.
    *values
        A value, or the ends of a range, in SI units.
    digits
        Number of significant digits.
    like
        Values that choose the unit; what is only rounding beside them is 0. Default: the values.
    """
    rounded = [float(f"{value:.{digits}g}") for value in like or values]
    scale = shown_in(VARIABLES[of].units, rounded)
    least = 1e-9 * max(map(abs, rounded)) if like else 0.0
    texts = [
        plain(value / scale.size if abs(value) > least else 0.0, digits)
        if math.isfinite(value)
        else "infinite"
        for value in values
    ]
    symbol = scale.symbol if any(map(math.isfinite, values)) else ""
    return f"{' to '.join(texts)} {symbol}".rstrip()
