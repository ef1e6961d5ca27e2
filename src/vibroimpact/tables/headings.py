"""Names and units of columns, and entries ``key: value``, from the lines above a table."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from vibroimpact.tables.rows import Heading, cut_heading, number_in
from vibroimpact.tables.statements import COMPONENT, read_statements
from vibroimpact.tables.units import Units, are_units, parted, spelled, time_unit, unit_of, units_of

_WORD = re.compile(r"[^\s(\[;,]+(?:\s*(?:\([^)]*\)|\[[^\]]*\]))?")
"""A name between blanks, which may be followed by a unit in brackets."""
_LISTED = re.compile(
    r"^(?:data|channels?|columns?|components?|fields?)[ _]*(?:sequence|order|names?)?\s*[:=]\s*"
    r"|^headers?\s*[:=,]\s*",
    re.IGNORECASE,
)
"""A key before names of columns, such as ``DataSequence:`` or ``Headers,``."""
_PROCESSES = {"", "smp", "avg", "max", "min", "std", "tot", "med"}
"""How Campbell's loggers computed each column, in a line under the units."""
_TIME = re.compile(
    r"(?:rel(?:ative)?[ _]|elapsed[ _])?(?:time|zeit|t|sec|secs|seconds)(?:[ _]?stamps?)?"
    r"|date(?:[ _/]?time)?|timestamps?|datum|uhrzeit|clock",
    re.IGNORECASE,
)
_INDEX = re.compile(
    r"no|nr|num|number|n|i|index|idx|sample|samples|row|record|scan|point|#", re.IGNORECASE
)
_USUAL = re.compile(
    r"(?:comp(?:onent)?|ch(?:annel|an)?|acc(?:el(?:eration)?)?|a|disp(?:lacement)?|vel(?:ocity)?)?"
    rf"[ _.-]?{COMPONENT}(?: ?\([+-]\))?"
    r"|acc(?:el(?:eration)?)?|disp(?:lacement)?|vel(?:ocity)?|a|u|v|force",
    re.IGNORECASE,
)
"""Names that a line without separators has only if it names columns."""
_SIGN = re.compile(r"\s*[(\[]\s*[+-]\s*[)\]]\s*$")
"""A mark of the positive direction, as in ``U(+)``."""
_ENTRY = re.compile(r"^\s*([A-Za-z][\w ()\[\]/^²]*?)\s*([=:;])\s*(.+?)\s*$")

BARE = re.compile(r"[+-]?(\d+[.,]?\d*|[.,]\d+)(e[+-]?\d+)?", re.IGNORECASE)
"""A number without a unit."""


class Headings(NamedTuple):
    """Names and units of the columns of a table."""

    names: list[str]
    """Names as they are written, without marks of directions."""
    units: list[Units]
    lines: frozenset[int]
    """Lines of the names and of the units below them."""


def column_headings(above: Sequence[Heading], width: int, delimiter: str | None) -> Headings | None:
    """Return the names of columns and their units, or None if no line names so many.

    The last line above the table that has as many names as the table has columns is used; lines of
    comments only if no other line is. A line below the names may contain their units. Without a
    delimiter, blanks separate the names.
    """
    under: tuple[list[str], int] | None = None
    for line in [
        *(one for one in reversed(above) if not one.is_comment),
        *(one for one in reversed(above) if one.is_comment),
    ]:
        names = _names(line.text, width, delimiter)
        if names is None:
            continue
        if under is None and not names[0] and {name.lower() for name in names} <= _PROCESSES:
            continue
        if under is None and width > 1 and are_units(names):
            stated = [name.strip("[]() ") for name in names]
            under = ["" if unit in ("TS", "RN") else unit for unit in stated], line.at
            continue
        beneath: list[str | None] = [*under[0]] if under else [None] * width
        lines = frozenset({line.at} | ({under[1]} if under else set()))
        return Headings(names, list(map(units_of, names, beneath)), lines)
    if under:
        units = [units_of("", unit) for unit in under[0]]
        return Headings([""] * width, units, frozenset({under[1]}))
    return None


def _names(text: str, width: int, delimiter: str | None) -> list[str] | None:
    """The names of columns in a line, or None if the line does not name so many columns."""
    text = text.strip()
    bare = _LISTED.sub("", text)
    listed = bare != text
    for mark in dict.fromkeys((delimiter, ";", ",", "\t")):
        if mark is None or (mark not in bare and width > 1):
            continue
        names = [_clean(name) for name in cut_heading(bare, mark)]
        if len(names) == width + 1 and not names[-1]:
            names.pop()
        # Commas in a line above numbers between blanks may be those of a sentence.
        is_sure = listed or mark == delimiter or _are_usual(names)
        if len(names) == width and is_sure and _can_be_names(names, width):
            return names
    if width == 1:
        return None
    names = [_clean(name) for name in _WORD.findall(bare)]
    if len(names) != width or not _can_be_names(names, width):
        return None
    return names if listed or _are_usual(names) else None


def _are_usual(names: list[str]) -> bool:
    """Return whether words are names or units of columns, not those of a sentence."""
    if not names:
        return False
    usual = all(_TIME.fullmatch(parted(n)[0]) or _USUAL.fullmatch(parted(n)[0]) for n in names)
    has_unit = any(map(unit_of, names))
    return usual or are_units(names) or has_unit or bool(_TIME.fullmatch(parted(names[0])[0]))


def _clean(name: str) -> str:
    return _SIGN.sub("", name.strip().strip("\"'").strip())


def _can_be_names(names: list[str], width: int) -> bool:
    """Return whether cells are neither numbers nor an entry of a key and a value."""
    if not any(names) or (width == 1 and re.search(r"[:=]", names[0])):
        return False
    if width == 2 and names[0] and _states([": ".join(names), " ".join(names)]):
        return False
    return not any(
        number_in(name, ",") is not None or re.match(r"[-+]?\d+[.,]?\d*\s*[A-Za-z/%²^]*\d?$", name)
        for name in names
        if name and name != "-"
    )


def _states(lines: list[str]) -> bool:
    """Return whether one of some lines states a count, a step, a duration or a peak."""
    statements = read_statements(enumerate(lines))
    return bool(statements.counts or statements.steps or statements.durations or statements.peaks)


def is_time(name: str) -> bool:
    """Return whether a name is one of a time or of a date."""
    return _TIME.fullmatch(parted(name)[0]) is not None or _named_with_unit(name)


def _named_with_unit(name: str) -> bool:
    bare, _, end = parted(name)[0].rpartition("_")
    is_in_s = bool(bare) and end.lower() in ("s", "sec") and bool(_TIME.fullmatch(bare))
    return is_in_s or time_unit(parted(name)[0]) is not None


def is_index(name: str) -> bool:
    """Return whether a name is one of the numbers of rows."""
    return _INDEX.fullmatch(parted(name)[0].strip(". ")) is not None


def entry(text: str) -> tuple[str, str] | None:
    """Return the key and the value of a line, or None.

    After a semicolon the value must be a number, with or without a unit.
    """
    match = _ENTRY.match(text)
    if match is None:
        return None
    if match[2] == ";" and not is_number(match[3]):
        return None
    if match[2] == ":" and match[1][-1].isdigit():  # a time of day
        return None
    return match[1], match[3].strip().strip('"')


def is_number(text: str) -> bool:
    """Return whether a text is a number, with or without a unit. A date is not a number."""
    begin = BARE.match(text)
    return begin is not None and re.fullmatch(r" *([^\W\d_].*|%)?", text[begin.end() :]) is not None


def listed_units(above: Sequence[Heading], width: int) -> list[str] | None:
    """Return the units that a line such as ``units: s, mm, g`` lists, one for each column."""
    for line in reversed(above):
        match = re.match(r"\W*units?\s*[:=]\s*(.*)$", line.text, re.IGNORECASE)
        if match and width > 1:
            cells = [cell for cell in re.split(r"[,;\s]+", match[1].strip()) if cell]
            if len(cells) == width and are_units(cells):
                return [spelled(cell) for cell in cells]
    return None
