"""What the attributes of a channel state of it: its unit, its scale, its step, what is absent.

One reader for all formats: HDF5's attributes, TDMS's properties, fields of MATLAB's structures.
What looks like a unit or a scale and is not understood is an error.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError, shown
from vibroimpact.measurements.sampling import is_sampling, step_of

_UNIT = re.compile(r"unit|einheit", re.IGNORECASE)
_NO_UNITS = {"niexpectsunit", "unitsystem", "unitsystems", "displayunit"}
_OF_TIMES = re.compile(r"^(?:t|x|time|wf_?x|abscissa|zeit)_?(?:axis_?)?unit", re.IGNORECASE)
_SCALES = {"scalefactor", "scale", "scaling", "scalingfactor", "multiplier", "slope"}
_OFFSETS = {"addoffset", "scaleoffset", "intercept"}
_ABSENT = {"fillvalue", "missingvalue"}
_STARTS = {"wfstartoffset", "tstart", "starttime", "xstart"}


class Stated(NamedTuple):
    """What is stated of a channel."""

    unit: str | None = None
    time_unit: str | None = None
    scale: float = 1.0
    offset: float = 0.0
    absent: tuple[float, ...] = ()
    step: float | None = None
    """In s."""
    start: float = 0.0
    """In s."""
    others: Mapping[str, str] = {}
    """What is not one of these."""

    @property
    def changes(self) -> bool:
        """Whether values are not as they stand in the file."""
        return self.scale != 1.0 or self.offset != 0.0 or bool(self.absent)

    def applied(self, values: NDArray[Any], where: str) -> NDArray[Any]:
        """The values with scale and offset, NaN where they are absent.

        Raises
        ------
        InputError
            If they are words or complex numbers.
        """
        if not self.changes:
            return values
        if values.dtype.kind not in "fiub":
            raise InputError(f"{where}: it has a scale, and is no list of numbers")
        gone = np.isin(values, self.absent)
        found = values.astype(float) * self.scale + self.offset
        found[gone] = np.nan
        return np.asarray(found)


def stated(attributes: Mapping[str, Any], where: str) -> Stated:
    """Read the attributes of a channel.

    Parameters
    ----------
    attributes
        By name; texts, numbers or lists of one.
    where
        The channel, as a message names it.

    Raises
    ------
    InputError
        If one looks like a unit or a scale and is not understood.
    """
    found: dict[str, Any] = {}
    others: dict[str, str] = {}
    for name, given in attributes.items():
        value = _single(given)
        key = re.sub(r"[^a-z]", "", name.lower())
        if _UNIT.search(name) and key not in _NO_UNITS:
            text = "" if value is None and np.size(given) == 0 else value
            if not isinstance(text, str):
                raise InputError(
                    f"{where}: its {name!r} is {shown(given)}, which is no unit; a text such as "
                    "'m/s^2' is accepted"
                )
            if text.strip().upper() not in ("", "NONE"):
                found["time_unit" if _OF_TIMES.match(name) else "unit"] = text.strip()
        elif key in _SCALES | _OFFSETS:
            number = _number(value)
            if number is None or (key in _SCALES and number == 0.0):
                raise InputError(
                    f"{where}: its {name!r} is {shown(given)}, which is no scale or offset; a "
                    "number is accepted"
                )
            found["scale" if key in _SCALES else "offset"] = number
        elif key in _ABSENT:
            numbers = [_number(one) for one in np.ravel(np.asarray(given))]
            found["absent"] = (*found.get("absent", ()), *(n for n in numbers if n is not None))
        elif key in _STARTS and _number(value) is not None:
            found["start"] = _number(value)
        elif is_sampling(name) and value is not None and np.size(given) == 1:
            found["step"] = step_of(name, str(value))
        elif value is not None:
            others[name] = str(value)
    return Stated(**found, others=others)


def _single(value: Any) -> Any:
    """A text or a number; None of lists."""
    if isinstance(value, bytes):
        return value.decode("utf-8", "replace")
    if isinstance(value, str):
        return value
    array = np.asarray(value)
    if array.size != 1:
        return None
    one = array.ravel()[0]
    return one.decode("utf-8", "replace") if isinstance(one, bytes) else one


def _number(value: Any) -> float | None:
    try:
        number = float(value)
    except (TypeError, ValueError):
        return None
    return number if np.isfinite(number) else None
