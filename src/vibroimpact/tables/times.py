"""Times of a table: whether they are even, their unit, and stamps with dates."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime, timedelta
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

_EVEN = 0.01
"""Largest deviation of a time, as a share of the step, that is not noted."""
_UNEVEN = 0.1
"""Largest deviation of times, as a share of the step, that count as even. It is noted."""
_ROUNDED = 0.25
"""Largest deviation of rounded times. A missing sample gives a deviation of 0.5."""
_RISING = 0.9
"""Least share of rising steps of a column of times, of which some may be rounded or damaged."""
IN_A_SECOND = {
    "s": 1.0, "ms": 1e3, "us": 1e6, "µs": 1e6, "ns": 1e9, "min": 1.0 / 60.0, "-": 1.0, "": 1.0,
}  # fmt: skip
"""How many of a unit of time make a second."""
_SINCE_1970 = {"ms": 1e12, "us": 1e15, "ns": 1e18}
"""Times since 1970 are 1 to 4 times this number in the years from 2001 to 2096."""

_Array = NDArray[np.float64]


class Spacing(NamedTuple):
    """The step of times, in their own unit."""

    step: float | None
    """None if no step fits all times."""
    mean: float
    """Average step."""
    worst: int
    """Number of the time that is farthest from even times."""
    off: float
    """How far it is."""

    @property
    def is_exact(self) -> bool:
        """Whether the times are even without rounding or jitter."""
        return self.step is not None and self.off <= _EVEN * self.step


def spacing(times: _Array) -> Spacing:
    """Return the step of at least two times, or the place where they are uneven."""
    step = float((times[-1] - times[0]) / (len(times) - 1))
    off = times - (times[0] + step * np.arange(len(times)))
    if not step > 0.0 or not np.isfinite(off).all():
        return Spacing(None, step, 0, 0.0)
    worst = int(np.abs(off).argmax())
    far = float(abs(off[worst]))
    within = max(_UNEVEN * step, min(0.8 * _digit(times), _ROUNDED * step))
    # A sample that is missing shifts those after it by a whole step, wherever it is.
    even = far <= _EVEN * step or 0.5 * np.ptp(off) <= within
    return Spacing(step if even else None, step, worst, far)


def rises(values: _Array) -> bool:
    """Return whether values can be times, although some may be rounded, missing or damaged."""
    if len(values) < 2 or not np.isfinite(values).all() or not values[-1] > values[0]:
        return False
    return float(np.mean(np.diff(values) > 0.0)) >= _RISING or bool((np.diff(values) >= 0.0).all())


def counts_samples(values: _Array) -> bool:
    """Return whether values are consecutive integers from 0 or 1 on, as the numbers of rows are."""
    return values[0] in (0.0, 1.0) and bool((np.diff(values) == 1.0).all())


def unit_since_1970(times: _Array) -> str | None:
    """Return the unit below 1 s of times that can only be times since 1970, or None."""
    within = (unit for unit, size in _SINCE_1970.items() if size <= times[0] < 4.0 * size)
    return next(within, None)


def _digit(times: _Array) -> float:
    """The size of the last digit that the times are written with."""
    for decimals in range(7):
        if np.abs(np.round(times, decimals) - times).max() < 1e-9 * max(1.0, abs(times[-1])):
            return float(10.0**-decimals)
    return 0.0


_CLOCK = (
    r"(?:(?P<h>\d{1,2}):)?(?P<m>\d{1,3}):(?P<s>\d{2})(?:(?:[.,]|(?<=\d:\d\d:\d\d):)(?P<f>\d{1,9}))?"
    r"\s*(?P<half>[AaPp]\.?[Mm]\.?)?"
)
_DATE = r"(?P<a>\d{1,4})(?P<mark>[-/.])(?P<b>\d{1,2})(?P=mark)(?P<c>\d{1,4})"
_ZONE = r"(?:\s*(?P<zone>Z|UTC|[+-]\d{2}:?\d{2}))?"
_STAMP = re.compile(rf"\s*(?:{_DATE})?(?:[T_,;-]|\s+|(?<=\d)\.(?=\d+:))?\s*(?:{_CLOCK})?{_ZONE}\s*")
STAMPS = re.compile(
    r"(?<![\d.,:-])(?:\d{1,4}([-/.])\d{1,2}\1\d{1,4}(?:[T_ -]+\d{1,2}:\d{2}:\d{2}(?:[.,]\d+)?)?"
    r"|\d{1,3}:\d{2}(?::\d{2})?(?:[.,]\d+)?)"
)
"""Dates and times of day within a line."""
_LONGEST = 60
"""Largest number of characters of a stamp."""
_MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
_MONTH = rf"(?P<month>{'|'.join(_MONTHS)})[a-z]*\.?"
_NAMED = (
    re.compile(rf"(?P<day>\d{{1,2}})[ .-]{_MONTH}[ -](?P<year>\d{{4}})(?!\d)", re.IGNORECASE),
    re.compile(rf"{_MONTH} (?P<day>\d{{1,2}}),? (?P<year>\d{{4}})(?!\d)", re.IGNORECASE),
)
"""Dates with the name of a month."""
_COMPACT = re.compile(r"(\d{4})(\d\d)(\d\d)T(\d\d)(\d\d)(\d\d)")
"""A date and a time of day without marks."""
_ORDERS = {"ymd": (0, 1, 2), "dmy": (2, 1, 0), "mdy": (2, 0, 1)}
"""Where year, month and day stand in a date."""
_STATED = re.compile(r"\b(?:(?P<dmy>dd?([-/.])mm?\2y+)|(?P<mdy>mm?([-/.])dd?\4y+))", re.IGNORECASE)


class Stamp(NamedTuple):
    """A date, a time of day or both, as they are written."""

    date: tuple[int, int, int] | None
    seconds: float | None
    """Whole seconds since midnight. None if there is no time of day."""
    fraction: float
    """The part below a second."""
    zone: int
    """Minutes ahead of UTC."""
    year_first: bool


def stamp(text: str) -> Stamp | None:
    """Read a date, a time of day or both, or return None."""
    if len(text) > _LONGEST:
        return None
    match = _STAMP.fullmatch(text) or _STAMP.fullmatch(_with_marks(text))
    if match is None or not (match["a"] or match["m"]):
        return None
    date = None
    if match["a"]:
        date = int(match["a"]), int(match["b"]), int(match["c"])
        if (len(match["a"]) == 4) == (len(match["c"]) == 4):
            if len(match["a"]) != 2 or len(match["c"]) != 2:
                return None
            date = date[0], date[1], 2000 + date[2]
        elif {len(match["a"]), len(match["c"])} - {1, 2, 4}:
            return None
    seconds = None
    if match["m"]:
        if not match["h"] and (date or not match["f"]):
            return None  # 12:30 may be hours and minutes, or minutes and seconds
        hours, minutes, secs = int(match["h"] or 0), int(match["m"]), int(match["s"])
        if half := match["half"]:
            hours = hours % 12 + (12 if half.lower().startswith("p") else 0)
        if hours > 23 or (minutes > 59 and match["h"]) or secs > 60:
            return None
        seconds = 3600.0 * hours + 60.0 * minutes + secs
    zone = 0
    if match["zone"] and match["zone"][0] in "+-":
        sign = -1 if match["zone"][0] == "-" else 1
        zone = sign * (60 * int(match["zone"][1:3]) + int(match["zone"][-2:]))
    fraction = float(f"0.{match['f']}") if match["f"] else 0.0
    return Stamp(date, seconds, fraction, zone, bool(match["a"]) and len(match["a"]) == 4)


def _with_marks(text: str) -> str:
    """Write a date with the name of a month, or one without marks, as 2024-05-31."""
    for form in _NAMED:
        if match := form.search(text):
            month = 1 + _MONTHS.index(match["month"].lower())
            date = f"{match['year']}-{month:02d}-{match['day']}"
            return text[: match.start()] + date + text[match.end() :]
    return _COMPACT.sub(r"\1-\2-\3T\4:\5:\6", text)


def stated_order(lines: Iterable[str]) -> str | None:
    """Return ``"dmy"`` or ``"mdy"`` if a line states the order of dates, or None."""
    for line in lines:
        if match := _STATED.search(line):
            return "dmy" if match["dmy"] else "mdy"
    return None


def seconds_since_start(stamps: Sequence[Stamp], order: str | None = None) -> _Array | None:
    """Return the times of stamps in s from the first one on.

    Parameters
    ----------
    stamps
        All with a time of day. Without dates, a fall by more than half a day is a midnight.
    order
        Order of the dates that the file states. Default: the order in which the times are even. If
        all stamps have one date, the order does not matter.

    Returns
    -------
    numpy.ndarray or None
        None if a date does not exist.
    """
    clock = np.array([one.seconds or 0.0 for one in stamps])
    if stamps[0].date is None:
        days = np.cumsum(np.r_[0.0, np.diff(clock) < -43200.0])
        return _relative(days, clock, stamps)
    years = stamps[0].year_first
    candidates = []
    for each in ("ymd",) if years else ((order,) if order else ("dmy", "mdy")):
        try:
            dates = [_day(one, each) for one in stamps]
        except ValueError:
            continue
        candidates.append(_relative(np.array(dates), clock, stamps))
    even = [times for times in candidates if spacing(times).step is not None]
    return next(iter(even or candidates), None)


def _day(one: Stamp, order: str) -> float:
    """The day of a stamp, and how much its zone shifts it."""
    assert one.date is not None
    year, month, day = (one.date[place] for place in _ORDERS[order])
    when = datetime(year, month, day, tzinfo=UTC) - timedelta(minutes=one.zone)
    return when.timestamp() / 86400.0


def _relative(days: _Array, clock: _Array, stamps: Sequence[Stamp]) -> _Array:
    fraction = np.array([one.fraction for one in stamps])
    whole = 86400.0 * (days - days[0]) + (clock - clock[0])
    # Rounded: a difference of fractions has digits that the stamps have not.
    return np.asarray(np.round(whole, 6) + np.round(fraction - fraction[0], 9))
