"""Numbers that are sent to a page: rounded, and only numbers that JSON can contain."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from vibroimpact.figures.finish import without_unit
from vibroimpact.model.frequency_text import forcing_heading
from vibroimpact.model.written_units import unitless


def short(values: Iterable[Any], digits: int = 5) -> list[float | None]:
    """Return numbers rounded to `digits` significant digits. Infinity and NaN become None."""
    return [one(value, digits) for value in values]


def one(value: Any, digits: int = 5) -> float | None:
    """Return a number rounded to `digits` significant digits, or None if it is not finite."""
    number = float(value)
    return float(f"{number:.{digits}g}") if math.isfinite(number) else None


def forcings(values: Iterable[Any], digits: int = 7) -> list[float | None]:
    """Return frequencies (Hz) as the page shows them: of a rig without units ω = 2π f."""
    turn, _ = forcing_heading()
    return short((turn * value for value in values), digits)


def forcing(value: Any, digits: int = 7) -> float | None:
    """Return a frequency (Hz) as the page shows it; see `forcings`."""
    turn, _ = forcing_heading()
    return one(turn * value, digits)


def axis(label: str) -> str:
    """Return the label of an axis, without its unit if the rig has none."""
    whole = without_unit(label) if unitless() else label
    return whole.replace("\\omega", "ω").replace("\\eta", "η").replace("$", "")
