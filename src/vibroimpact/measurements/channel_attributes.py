"""Statements in the attributes of a channel: unit, scale, step, and marks of missing values.

The same functions read the attributes of HDF5, the properties of TDMS and the fields of MATLAB
structures. If an attribute looks like a unit or a scale, but is not understood, the channel gets a
doubt. The doubt becomes an error if the channel is used.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import shown
from vibroimpact.measurements.names import alike
from vibroimpact.measurements.sampling import is_sampling, one_step, step_of
from vibroimpact.tables.headings import is_number
from vibroimpact.tables.units import spelled

Kind = Literal["unit", "time_unit", "scale", "offset", "unclear"]

_OF_UNITS = re.compile(
    r"([^\W\d_]*?)(?:units?|einheit(?:en)?)(?:string|text|label|lab|name|desc(?:ription)?)?"
)
_NO_UNITS = {"under", "id", "serial", "number", "system", "systems", "expects", "display", "code"}
"""Words next to which ``unit`` does not mean a physical unit, as in ``unit_under_test``."""
_OF_TIMES = {"t", "x", "time", "wf x", "x axis", "abscissa", "zeit"}
_SCALES = {"scalefactor", "scale", "scaling", "scalingfactor", "multiplier"}
_OFFSETS = {"addoffset", "scaleoffset"}
_OF_SCALES = re.compile(
    r"\b(?:full ?)?(?:scales?|scaling|gains?|sensitivity|calibration|cal|conversion|multiplier"
    r"|slope|intercept|(?:dc|zero|add|scale) ?offset|lsb)(?: ?factors?)?\b"
)
_NO_SCALES = {"date", "due", "year", "time", "start"}
_ONLY_OFFSET = {"offset", "bias"}
_BESIDE_UNITS = {
    "string",
    "text",
    "label",
    "lab",
    "name",
    "desc",
    "description",
    "wf",
    "ni",
    "axis",
}
_ABSENT = {"fillvalue", "missingvalue"}
_STARTS = {"wfstartoffset", "tstart", "starttime", "xstart"}
_APPLIED_BY_READERS = ("ni scale", "ni scaling", "ni number of scales")
"""Properties of TDMS files that npTDMS applies itself."""


class Stated(NamedTuple):
    """Statements about a channel."""

    unit: str | None = None
    scale: float | None = None
    offset: float | None = None
    doubt: str = ""
    """Description of attributes that look like a unit or a scale, but are not understood."""
    absent: tuple[float, ...] = ()
    step: float | None = None
    """In s."""
    start: float = 0.0
    """In s."""
    others: Mapping[str, str] = {}
    """All other attributes."""

    def holes(self, values: NDArray[Any]) -> NDArray[Any]:
        """Return the values, with NaN in place of missing values."""
        if not self.absent or values.dtype.kind not in "fiub":
            return values
        return np.where(np.isin(values, self.absent), np.nan, values.astype(float))


def words_in(name: str) -> list[str]:
    """Return the words of an attribute name in lower case: ``NI_UnitDescription`` has three."""
    parted = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name)
    return [word.lower() for word in re.findall(r"[^\W\d_]+|\d+", parted)]


def kind_of(name: str) -> tuple[Kind | None, str]:
    """Return the kind of an attribute from its name, and the channel in its name, if any.

    For example, ``t_unit`` is the unit of times and names the channel ``t``. ``gain`` is unclear,
    because it may already have been applied to the values.
    """
    words = words_in(name)
    text, key = " ".join(words), "".join(words)
    if text.startswith(_APPLIED_BY_READERS) or key in _STARTS | _ABSENT:
        return None, ""
    units = [match for word in words if (match := _OF_UNITS.fullmatch(word))]
    if units and not _NO_UNITS & set(words):
        kept = [match[1] if (match := _OF_UNITS.fullmatch(word)) else word for word in words]
        about = [word for word in kept if word and word not in _BESIDE_UNITS]
        spoken = " ".join(word for word in kept if word)
        timed = " ".join(about) in _OF_TIMES or spoken in _OF_TIMES
        return ("time_unit" if timed else "unit"), "".join(about)
    if key in _SCALES:
        return "scale", ""
    if key in _OFFSETS:
        return "offset", ""
    if _NO_SCALES & set(words):
        return None, ""
    if match := _OF_SCALES.search(text):
        own = match[0].replace(" ", "")
        rest = "".join((text[: match.start()] + text[match.end() :]).split())
        return ("scale" if own in _SCALES else "offset" if own in _OFFSETS else "unclear"), rest
    if words and words[-1] in _ONLY_OFFSET:
        return "unclear", "".join(words[:-1])
    return None, ""


def stated(attributes: Mapping[str, Any]) -> Stated:
    """Read the attributes of a channel.

    Values are texts, numbers, or lists with one entry.

    Raises
    ------
    InputError
        If the step cannot be read.
    """
    fields: dict[str, Any] = {}
    others: dict[str, str] = {}
    steps: dict[str, str] = {}
    time_unit: tuple[str, str] | None = None
    doubts = []
    for name, raw in attributes.items():
        value = single(raw)
        kind, _ = kind_of(name)
        key = "".join(words_in(name))
        if kind == "time_unit":
            if known(value):
                time_unit = name, str(value)
        elif kind is not None:
            read, doubt = one(kind, value, raw)
            field = str(kind)
            seen = shown(np.ravel(np.asarray(raw)).tolist() if value is None else value)
            if doubt:
                doubts.append(f"{name} = {seen}, which {doubt}")
            elif read is not None and not _agree(fields.setdefault(field, read), read):
                doubts.append(f"{name} = {seen} in addition to the {field} {fields[field]!r}")
        elif key in _ABSENT:
            numbers = [number(one) for one in np.ravel(np.asarray(raw))]
            fields["absent"] = (*fields.get("absent", ()), *(n for n in numbers if n is not None))
        elif key in _STARTS and number(value) is not None:
            fields["start"] = number(value)
        elif is_sampling(name) and value is not None:
            steps[name] = str(value)
        elif value is not None:
            others[name] = str(value)
    if steps:
        unit = spelled(time_unit[1]) if time_unit else None
        fields["step"] = one_step(steps, unit)
        if unit and "start" in fields:
            fields["start"] *= step_of("dt", f"1 {unit}")
    elif time_unit:
        others[time_unit[0]] = time_unit[1]
    return Stated(**fields, doubt="; ".join(doubts), others=others)


def _agree(first: str | float, other: str | float) -> bool:
    if isinstance(first, str) and isinstance(other, str):
        return alike(first, other)
    return first == other


def one(kind: Kind, value: Any, raw: Any) -> tuple[str | float | None, str]:
    """Return the unit, scale or offset in an attribute, or the reason why it is not one."""
    if kind in ("unit", "time_unit"):
        text = "" if value is None and np.size(raw) == 0 else value
        if not isinstance(text, str):
            return None, "is not a unit; use a string such as 'm/s^2'"
        return known(text), ""
    size = number(value)
    if kind == "unclear":
        # A gain of 1, an offset or decibels of 0, and words such as a date change nothing.
        nothing = size in (0.0, 1.0) or (isinstance(value, str) and not is_number(value))
        return None, "" if nothing else "may have been applied to the values or not"
    if size is None or (kind == "scale" and size == 0.0):
        return None, "is not a scale or an offset; use a number"
    return size, ""


def known(value: Any) -> str | None:
    """Return a text, or None if it is empty or "none"."""
    text = "" if value is None else as_text(value).strip()
    return None if text.upper() in ("", "NONE") else text


def as_text(value: Any) -> str:
    """Return a value as text. Bytes are decoded as UTF-8 or, if that fails, as Latin-1."""
    if not isinstance(value, bytes):
        return str(value)
    try:
        return value.decode()
    except UnicodeDecodeError:
        return value.decode("latin-1")


def single(value: Any) -> Any:
    """Return a text or a number, or None for a list of several values."""
    if isinstance(value, str | bytes):
        return as_text(value)
    array = np.asarray(value)
    if array.size != 1:
        return None
    own = array.ravel()[0]
    if isinstance(own, bytes):
        return as_text(own)
    return own.item() if isinstance(own, np.number | np.str_) else own


def number(value: Any) -> float | None:
    """Return a finite number, also from a text, or None for any other value."""
    try:
        size = float(value)
    except (TypeError, ValueError, OverflowError):
        return None
    return size if np.isfinite(size) else None
