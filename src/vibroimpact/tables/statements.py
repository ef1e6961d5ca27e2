"""What the lines above a table state of its values: count, step, duration, peaks and unit.

Networks and loggers write these in any order and wording: ``NPTS= 800, DT= .005 SEC``,
``SampleRate(Hz): 50``, ``800 POINTS AT 0.005 SEC``, ``"Sampling interval";"10";"ms"``. A statement
is read by its key or, without a key, by its unit. What is not understood is left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from vibroimpact.tables.units import is_acceleration, spelled, stated_acceleration, stated_unit

SAME = 1e-3
"""Largest relative difference of two steps that are the same except for rounding."""

_NUMBER = r"[-+]?(?:\d+(?:[.,]\d+)?|[.,]\d+)(?:[eEdD][-+]?\d+)?(?![\d.]*\d)"
_SECONDS = r"(?:milliseconds?|msecs?|ms|microseconds?|usecs?|us|µs|seconds?|secs?|sek|s)"
_A_SECOND = r"(?:/|per|_per_) ?s(?:ec(?:ond)?s?)?"
_OF_TIME = re.compile(rf"{_SECONDS}\.?", re.IGNORECASE)
_ACCELERATION = (
    r"(?:m?gals?|m?g|(?:cm|mm|m|in|ft) ?/ ?\(?s(?:ec)?(?: ?[/*] ?s(?:ec)?\)?|\^2|\*\*2|2|²))"
    r"(?![A-Za-z0-9/])"
)
_IN_BRACKETS = r"(?: ?[(\[] ?(?P<bracket>[^)\]]{1,20}?) ?[)\]])?"
_MARK = r" ?(?:[:=;,]|\bis\b|\bof\b| ) ?"

_STEP_NAME = (
    r"(?:d_?t|ts|delta[ _-]?t|Δt|t(?:ime)?[ _-]*(?:step|interval|increment)|step|zeitschritt"
    r"|abtastintervall|interval|spacing|(?:sampl(?:ing|e)|digiti[sz](?:ation|ing)|recording|scan)"
    r"[ _-]*(?:interval|period|increment|step)|(?:wf_?)?increment)"
)
_UNCLEAR = ("step", "interval", "spacing")
"""Names that may be of other steps than that of times."""
_RATE_NAME = (
    r"(?:(?:sampl(?:ing|es?)|scan|data|digiti[sz](?:ation|ing)|acquisition|logging|recording)"
    r"[ _-]*(?:rate|freq(?:uency)?)|f_?s(?:ample)?|abtast(?:rate|frequenz)|(?<!\d )(?<!\d)sps"
    rf"|samples? ?{_A_SECOND})"
)
_COUNT_NAME = (
    r"(?:n_?(?:pts|points|data|samples|values)"
    r"|(?:no|nr|num|number)\.? ?(?:of)? ?(?:\w+[ _]){0,2}?(?:pts|points|samples|values|data)"
    r"(?:[ _](?:points|samples|values))?|(?:data|sample|total)[ _]*(?:points|samples|count)"
    r"|samples|points|pts|anzahl (?:der )?\w*(?:punkte|werte))"
)
_KEY = r"(?<![A-Za-z_])"
_STEP = re.compile(
    rf"{_KEY}{_STEP_NAME}(?:[ _](?P<suffix>{_SECONDS})(?![a-z]))?\.?{_IN_BRACKETS}{_MARK}"
    rf"(?P<number>{_NUMBER})(?: ?[,;]? ?(?P<unit>{_SECONDS})\b|(?! ?[A-Za-z]))",
    re.IGNORECASE,
)
_RATE = re.compile(
    rf"{_KEY}{_RATE_NAME}(?:[ _](?P<suffix>k?hz)(?![a-z]))?\.?{_IN_BRACKETS}{_MARK}"
    rf"(?P<number>{_NUMBER})"
    rf"(?: ?[,;]? ?(?P<unit>k?hz|sps|(?:samples|pts|points|scans)? ?{_A_SECOND}|1/s)(?![a-z])"
    rf"|(?! ?[A-Za-z]))",
    re.IGNORECASE,
)
_COUNT = re.compile(
    rf"{_KEY}{_COUNT_NAME}\.? ?(?:[:=;,]|\bis\b| ) ?(?P<number>\d+)"
    rf"(?![.,]?\d| ?(?:per\b|/|sps\b|k?hz\b|{_SECONDS}\b))",
    re.IGNORECASE,
)
_LASTS = re.compile(
    r"(?<!significant )(?<!bracketed )(?<!motion )"
    rf"{_KEY}(?:record(?:ing)?[ _]*(?:length|duration)|length of (?:the )?record|duration"
    rf"(?: ?time| of (?:the )?record)?|total (?:time|duration))(?:[ _](?P<suffix>{_SECONDS})\b)?\.?"
    rf"{_IN_BRACKETS}{_MARK}(?P<number>{_NUMBER})(?: ?[,;]? ?(?P<unit>{_SECONDS})\b)?",
    re.IGNORECASE,
)
_PEAK = re.compile(
    rf"(?<![A-Za-z])(?:amplitude ?)?(?:peak|max(?:imum|\.)?|pga)(?P<what>[^:=~0-9(\[]{{0,40}}?)"
    rf"{_IN_BRACKETS} ?(?P<mark>[:=;]?) ?(?P<number>{_NUMBER})(?: ?~ ?(?P<other>{_NUMBER}))?"
    rf"(?: ?(?P<unit>{_ACCELERATION}))?(?P<at> ?,? ?(?:at|t ?=) ?{_NUMBER}(?: ?{_SECONDS}\b)?)?",
    re.IGNORECASE,
)
_NO_PEAKS = re.compile(
    r"vel|disp|to",
    re.IGNORECASE,
)
_OF_PEAKS = {"acc", "accel", "acceleration", "accelerations", "value", "values", "ground", "of",
             "amplitude", "data", "abs", "absolute", "recorded", "corrected", "uncorrected",
             "horizontal", "the", "ampl"}  # fmt: skip

COMPONENT = (
    r"(?:[nsewudzxyvhlt]|n-?s|e-?w|u-?d|north|south|east|west|up|down|vert(?:ical)?"
    r"|long(?:itudinal)?|trans(?:verse|versal)?|radial|[hbe][nhl][enz12]|h?[12]|\d{1,3})"
)
"""Usual names of components, to be matched in upper or lower case."""

_POINTS = r"(?:data|acceleration|accelerogram|accel\.?|equally[ -]spaced)?"
_BARE_COUNT = re.compile(
    rf"(?<![\d.,])(?P<number>\d+) ?{_POINTS} ?(?:points|pts|samples|values)\b\.?"
    r"(?! ?(?:per\b|/|a (?:line|row)|(?:in|on) (?:a|each)))",
    re.IGNORECASE,
)
_BARE_STEP = re.compile(
    rf"(?:intervals? of|spac(?:ed at|ing of)|step of|every|(?:\d|points|pts|samples|values|data)"
    rf"\.? ?,? ?(?:at|of|@|,)(?: (?:equal(?:ly)?[ -])?(?:spaced )?(?:time )?intervals? of)?)"
    rf" ?(?P<number>{_NUMBER}) ?(?P<unit>{_SECONDS})\b",
    re.IGNORECASE,
)
_OWN_STEP = re.compile(
    rf"(?:^|[,;:]) ?(?P<number>{_NUMBER}) ?(?P<unit>{_SECONDS})\b\.? ?(?:$|[,;])", re.IGNORECASE
)
"""A time that nothing else is stated of: a step if it is as short as one."""
_LONGEST_STEP = 0.1
_LONGEST = 1000
"""Largest number of characters of a line that are read."""
_BARE_RATE = re.compile(
    rf"(?P<number>{_NUMBER}) ?(?:(?:samples|pts|points|scans|values) ?{_A_SECOND}|sps)(?![a-z])"
    rf"|(?:sampled|digiti[sz]ed|recorded|logged) at (?P<at>{_NUMBER}) ?k?hz",
    re.IGNORECASE,
)
_SLASHED = re.compile(
    r"(?<![A-Za-z/(])(?:(?:cm|mm|m|in|ft) ?/ ?\(?s(?:ec)?(?: ?[/*] ?s(?:ec)?\)?|\^2|\*\*2|2|²)"
    r"|m?gals?)(?![A-Za-z0-9/])",
    re.IGNORECASE,
)
_ABOUT_VALUES = re.compile(r"acc|ampl|data|value|motion|comp|unit|^\W*\w+\W*$", re.IGNORECASE)


class StatedNumber(NamedTuple):
    """A number that a line states."""

    value: float
    """Times in s; others as they are written."""
    line: int
    """Its line, starting from 0."""
    text: str
    """The statement as it is written."""
    digit: float = 0.0
    """Size of the last digit that is written, in the unit of the value."""


class StatedPeak(NamedTuple):
    """The largest value that a line states of a channel."""

    value: float
    """Its absolute value."""
    unit: str | None
    """None if it has the unit of the values."""
    line: int
    text: str
    digit: float
    """Size of the last digit that is written."""
    channel: str = ""
    """The component, if the line names one."""


class Statements(NamedTuple):
    """All statements above a table."""

    counts: tuple[StatedNumber, ...] = ()
    steps: tuple[StatedNumber, ...] = ()
    """Times between samples (s), from steps and from sampling rates."""
    durations: tuple[StatedNumber, ...] = ()
    """In s."""
    peaks: tuple[StatedPeak, ...] = ()
    units: tuple[str, ...] = ()
    """Units of the values after a word such as "unit", from the last line to the first."""
    hints: tuple[str, ...] = ()
    """Units of acceleration in brackets, after "in", or alone, from the last line to the first."""
    time_unit: str | None = None
    """Unit of times, if a line states it."""

    @property
    def step(self) -> StatedNumber | None:
        """The first stated step."""
        return self.steps[0] if self.steps else None

    @property
    def other_step(self) -> StatedNumber | None:
        """A step that differs from the first one, or None."""
        first = self.step
        differs = (one for one in self.steps if first and not same(one.value, first.value))
        return next(differs, None)


def same(one: float, other: float) -> bool:
    """Return whether two steps are the same except for rounding."""
    return abs(one - other) <= SAME * abs(other)


def read_statements(lines: Iterable[tuple[int, str]]) -> Statements:
    """Read the statements in lines, each with its number and without marks of comments."""
    counts: list[StatedNumber] = []
    steps: list[StatedNumber] = []
    bare_steps: list[StatedNumber] = []
    durations: list[StatedNumber] = []
    peaks: list[StatedPeak] = []
    units: list[str] = []
    hints: list[str] = []
    time_unit = None
    for at, line in lines:
        text = " ".join(re.sub(r'["\t]', " ", line[:_LONGEST]).split())
        text, line_peaks = _peaks(at, text)
        peaks += line_peaks
        unit = stated_unit(text)
        if unit and _OF_TIME.fullmatch(unit):
            time_unit = unit
        elif unit:
            units.insert(0, unit)
        for match in _STEP.finditer(text):
            _add(steps, at, match, _size(match, "s"))
        for match in _RATE.finditer(text):
            _add(steps, at, match, _size(match, "hz"), inverse=True)
        for match in _LASTS.finditer(text):
            if size := _size(match, ""):
                _add(durations, at, match, size)
        keyed = [*_COUNT.finditer(text)]
        counts += [
            StatedNumber(float(match["number"]), at, match[0].strip())
            for match in keyed or _BARE_COUNT.finditer(text)
        ]
        for match in (*_BARE_STEP.finditer(text), *_OWN_STEP.finditer(text)):
            if _value(match["number"]) * _size(match, "s") <= _LONGEST_STEP:
                _add(bare_steps, at, match, _size(match, "s"))
        for match in _BARE_RATE.finditer(text):
            number = match["number"] or match["at"]
            size = 1e3 if re.search(r"\d ?khz", match[0], re.IGNORECASE) else 1.0
            if (value := _value(number) * size) > 0.0:
                bare_steps.append(StatedNumber(1.0 / value, at, match[0]))
        if not unit and (hint := _hint(text)):
            hints.insert(0, hint)
    return Statements(
        tuple(counts),
        tuple(dict.fromkeys(steps or bare_steps)),
        tuple(durations),
        tuple(peaks),
        tuple(units),
        tuple(hints),
        time_unit,
    )


def sampling_of(name: str) -> str | None:
    """Return ``"step"`` or ``"rate"`` if a name is that of a sampling step or rate, or None."""
    bare = re.sub(r" *[(\[][^)\]]*[)\]] *$", "", name).strip()
    if bare.lower() in _UNCLEAR:
        return None
    bare = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", bare)
    for kind, pattern, suffix in (
        ("rate", _RATE_NAME, "k?hz"),
        ("step", _STEP_NAME, _SECONDS),
    ):
        if re.fullmatch(rf"{pattern}(?:[ _]{suffix})?", bare, re.IGNORECASE):
            return kind
    return None


def _peaks(at: int, text: str) -> tuple[str, list[StatedPeak]]:
    """The peaks of a line, and the line without them: their units and times are of nothing else."""
    peaks: list[StatedPeak] = []
    for match in _PEAK.finditer(text):
        words = re.findall(r"[\w+-]+", match["what"].replace(".", " "))
        unit = match["bracket"] or match["unit"]
        if unit is not None and not is_acceleration(unit):
            unit = None
        if not match["mark"] and unit is None:
            continue
        is_other = match["bracket"] and unit is None
        text = text.replace(match[0], " ")
        channel = " ".join(word for word in words if word.lower() not in _OF_PEAKS)
        named = re.fullmatch(rf"(?:{COMPONENT})?", channel, re.IGNORECASE)
        if is_other or not named or _NO_PEAKS.search(match["what"]):
            continue
        sizes = [number for number in (match["number"], match["other"]) if number]
        number = max(sizes, key=lambda one: abs(_value(one)))
        shown = match[0][: match.start("at") - match.start()] if match["at"] else match[0]
        peaks.append(
            StatedPeak(
                abs(_value(number)),
                spelled(unit) if unit else None,
                at,
                shown.strip(),
                last_digit(number),
                channel,
            )
        )
    return text, peaks


def _add(
    numbers: list[StatedNumber],
    at: int,
    match: re.Match[str],
    size: float,
    *,
    inverse: bool = False,
) -> None:
    """Add a number that is greater than 0, such as a step; a rate becomes a step."""
    value = _value(match["number"]) * size
    if value > 0.0:
        digit = 0.0 if inverse else last_digit(match["number"]) * size
        text = match[0].strip(" ,;:")
        if match.re in (_BARE_STEP, _OWN_STEP):
            text = f"{match['number']} {match['unit']}"
        numbers.append(StatedNumber(1.0 / value if inverse else value, at, text, digit))


def _size(match: re.Match[str], unit: str) -> float:
    """How many s or Hz the unit of a statement has; 0 if it states none and none is usual."""
    stated = match.groupdict()
    text = stated.get("unit") or stated.get("bracket") or stated.get("suffix") or unit
    word = text.strip().lower()
    if word.startswith(("ms", "milli")):
        return 1e-3
    if word.startswith(("us", "µs", "micro")):
        return 1e-6
    return 1e3 if word.startswith("khz") else 1.0 if word else 0.0


def _value(number: str) -> float:
    return float(number.replace(",", ".").upper().replace("D", "E"))


def last_digit(number: str) -> float:
    """Return the size of the last digit of a number: 0.01 for ``-1.25``, 0.1 for ``.125E+01``."""
    mantissa, _, exponent = number.upper().replace("D", "E").replace(",", ".").partition("E")
    return float(10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2])))


def _hint(text: str) -> str | None:
    """Return a unit of acceleration that a line contains without the word "unit"."""
    if (match := _SLASHED.search(text)) and is_acceleration(match[0]):
        return spelled(match[0])
    hint = stated_acceleration(text)
    # A g in brackets may also be a part of the name of a station.
    return None if hint in ("g", "mg") and not _ABOUT_VALUES.search(text) else hint
