"""Units that files state: after the word "units", in brackets, or at the end of a name."""

from __future__ import annotations

import re
import unicodedata
from typing import NamedTuple

_ENDS = {
    "hz": "Hz", "khz": "kHz", "rpm": "rpm", "radps": "rad/s", "mm": "mm", "cm": "cm", "um": "µm",
    "m": "m", "ms2": "m/s^2", "cms2": "cm/s^2", "mms2": "mm/s^2", "g": "g", "mg": "mg",
    "gal": "gal",
    "mps2": "m/s^2", "cmps2": "cm/s^2", "mmps2": "mm/s^2",
    "mps": "m/s", "cmps": "cm/s", "mmps": "mm/s", "mms": "mm/s", "s": "s",
    "ms": "ms", "n": "N", "kn": "kN", "mv": "mV", "volt": "V", "volts": "V",
}  # fmt: skip
"""Units at the end of a name, such as mm in ``u_mm``, with their usual spelling."""
_CASES = {
    one.lower(): one
    for one in ("Hz", "kHz", "N", "kN", "m", "cm", "mm", "um", "g", "mg", "s", "ms", "rad", "rpm",
                "in", "inch", "ft", "hertz", "gal", "mgal")
} | {"sec": "s", "secs": "s", "second": "s", "seconds": "s", "msec": "ms", "usec": "us",
     "sek": "s", "gals": "gal", "meter": "m", "meters": "m", "millisecond": "ms",
     "milliseconds": "ms", "microsecond": "us", "microseconds": "us", "nsec": "ns",
     "nanosecond": "ns", "nanoseconds": "ns"}  # fmt: skip
"""Units that may be written in upper or lower case. MN and mN, for example, are different units."""

_POWER = r"(?:(?:\^|\*\*)?-?[1-9]|[²³]|⁻[¹²³])?"
_FACTOR = rf"[A-Za-zµμ%]+{_POWER}"
_PER_SQUARE = r"[ .·*]+s(?:ec)?(?:(?:\^|\*\*)?-[1-9]|⁻[¹²])"
_UNIT = rf"{_FACTOR}(?: ?[/*·] ?\(?{_FACTOR}\)?)*(?:{_PER_SQUARE})?"
_AFTER = re.compile(
    r"(?:(?<![A-Za-z])|(?<=[a-z])(?=U))(?i:units?|einheit(?:en)?)(?![A-Za-z])(?:_\w+)?\s*"
    r"(?i:of\s+(?:measure(?:ment)?|accel\w*|data|times?)\s*)?"
    r"(?P<mark>(?:(?i:(?:are|is|of|ist)\b|in(?=\s+[A-Za-z(])|[:=;,])\s*)+|(?=[\[(]))(?P<stated>.*)"
)
_WHOLE = re.compile(rf"[\[(\"']?\s*({_UNIT})(?:'s)?\s*(?:[\[(\])\"'.,;:]|\s|$)")
_BRACKETS = re.compile(r"[\[(（]\s*([^\[\]()（）]*?)\s*[\])）]")
_AT_END = re.compile(_BRACKETS.pattern + r"\s*$")
_IN = re.compile(rf"\bin\s+({_UNIT})(?=\s|$|[.,;])", re.IGNORECASE)
_ACCELERATIONS = re.compile(r"m?g|m?gal|(?:[cm]?m|in|inch|ft)/s\^2", re.IGNORECASE)
_SHOWN = 30
_TIME_UNIT = re.compile(
    r"(?P<name>(?:.*[a-z])?(?:time(?:[ _]?stamps?)?|timestamps?|zeit|elapsed|clock|(?<![a-z])t)"
    r"(?:[ _.,/-]+(?:in )?|))?"
    r"(?:(?P<ms>ms|msecs?|millis|milliseconds?)|(?P<us>[uµμ]s|[uµμ]secs?|micros|microseconds?)"
    r"|(?P<ns>ns|nsecs?|nanos|nanoseconds?))",
    re.IGNORECASE,
)
"""Name of a time with its unit at the end, or the unit alone."""


def spelled(unit: str) -> str:
    """Return a unit in the spelling of this package: cm/s^2 for ``CM/SEC/SEC``, kN for ``KN``."""
    clean = re.sub(r"[A-Za-z]+", lambda m: _CASES.get(m[0].lower(), m[0]), unit.strip())
    clean = re.sub(r"\s*/\s*", "/", clean)
    clean = re.sub(r"/s[/*]s\b|/\(s[*/]s\)|(?<=/s)\^?2$|(?<=/s)(?:\*\*2|²)$", _squared, clean)
    clean = re.sub(r"[ .·*]+s(?:\^|\*\*)?(?:-2|⁻²)$", "/s^2", clean)
    return "m/s^2" if re.fullmatch(r"ms(?:\^?-2|2|⁻²)", clean) else clean


def _squared(match: re.Match[str]) -> str:
    return "/s^2" if match[0].startswith("/") else "^2"


def stated_unit(line: str) -> str | None:
    """Return the unit that a line states after the word "unit", or None if there is none.

    A text that is not a unit is returned unchanged. The caller raises the error.
    """
    match = _AFTER.search(line.replace(" per ", "/"))
    if match is None:
        return None
    text = match["stated"].strip()
    whole = _WHOLE.match(text)
    if match["mark"].strip() in (",", ";"):  # of a sentence, unless what follows is a unit
        return spelled(whole[1]) if whole and are_units([whole[1]]) else None
    return spelled(whole[1]) if whole else text[:_SHOWN] or None


def stated_acceleration(line: str) -> str | None:
    """Return a unit of acceleration that is in brackets or after the word "in", or None."""
    for match in (*_BRACKETS.finditer(line), *_IN.finditer(line)):
        if _ACCELERATIONS.fullmatch(unit := spelled(match[1])):
            return unit
    return None


def is_acceleration(unit: str) -> bool:
    """Return whether a text is a usual unit of acceleration."""
    return _ACCELERATIONS.fullmatch(spelled(unit)) is not None


def parted(name: str) -> tuple[str, str | None]:
    """Return a name without the unit in brackets at its end, and this unit or None."""
    name = name.strip().strip('"').strip()
    match = _AT_END.search(name)
    if not match:
        return name, None
    return name[: match.start()].strip(), match[1]


def ended(name: str) -> tuple[str, str | None]:
    """Return a name without the unit at its end, as in ``amplitude_g``, and this unit or None."""
    words = words_of(name)
    if len(words) > 1 and words[-1] in _ENDS:
        return "_".join(words[:-1]), _ENDS[words[-1]]
    return "_".join(words), None


def ending(words: list[str], *, sure: bool) -> str | None:
    """Return the unit at the end of words, or None.

    Unless `sure` is true, the g of ``ag``, the n of a number of items and the S of ``N-S`` are not
    units.
    """
    if len(words) < 2 or words[-1] not in _ENDS:
        return None
    a_word = (
        words == ["a", "g"]
        or words[-2:] == ["n", "s"]
        or (words[-1] == "n" and "force" not in words)
    )
    return None if a_word and not sure else _ENDS[words[-1]]


def words_of(name: str) -> list[str]:
    """Return the words of a name in lower case."""
    return [word for word in re.split(r"[^a-z0-9]+", plain(name).lower()) if word]


_PEAK = re.compile(
    r"(?<![a-z])(?:(?:peak|pk|p)[ _-]?(?:to|2)?[ _-]?(?:peak|pk|p)|spitze[ -](?:zu[ -])?spitze)"
    r"(?![a-z])",
    re.IGNORECASE,
)


def plain(name: str) -> str:
    """Return a name in ASCII letters with separated words, and with short forms of units."""
    joined = re.sub("[µμ]", "u", name.strip().replace("η", "eta"))
    joined = re.sub(r"(?<![^\W_])ü(?![^\W\d_])", "acc", joined).replace("ß", "ss")
    joined = "".join(  # é is e
        sign for sign in unicodedata.normalize("NFKD", joined) if not unicodedata.combining(sign)
    )
    joined = re.sub(r"(?:\^|\*\*)2$|²$", "2", joined)
    joined = re.sub(r"/ *s(?:ec)? */ *s(?:ec)?$", "/s2", joined, flags=re.IGNORECASE)
    joined = re.sub(r"(?<![a-z])([cm]?m) */ *s(?:ec)?2$", r"\1s2", joined, flags=re.IGNORECASE)
    joined = re.sub(r"(?<![a-z])([cm]?m|rad) */ *s$", r"\1ps", joined, flags=re.IGNORECASE)
    # kHz, kN and mV are one word.
    joined = re.sub(r"(?<=[a-z])(?<![^A-Za-z][km])(?=[A-Z])", " ", joined)
    return _PEAK.sub("pp", joined)


def unit_of(name: str) -> str | None:
    """Return the unit in the name of a column, in brackets or at its end, or None."""
    bare, unit = parted(name)
    if unit is not None:
        return spelled(unit)
    if unit := time_unit(bare):
        return unit
    sure = re.search(r"/ *[A-Za-z0-9]+$", plain(bare)) is not None
    return ending(words_of(bare), sure=sure)


def time_unit(name: str) -> str | None:
    """Return the unit below 1 s in a name such as ``time_us`` or ``millis``, or None."""
    match = _TIME_UNIT.fullmatch(name.strip())
    if match is None or (match["name"] is None and name.strip().lower() == "ns"):  # north-south
        return None
    return next(unit for unit in ("ms", "us", "ns") if match[unit])


class Units(NamedTuple):
    """The units of a column that a file states, which may be at several places."""

    unit: str | None
    other: str | None = None
    """Unit that is stated at another place. If it differs, an error is raised."""
    of_name: str | None = None
    """Unit at the end of the name (``acc_g``), if another place states the unit."""


def units_of(name: str, stated: str | None) -> Units:
    """Return the units of a column: in brackets, at another place, and at the end of its name."""
    elsewhere = spelled(stated) if stated and stated.strip() else None
    bracketed = parted(name)[1]
    if bracketed:
        return Units(spelled(bracketed), elsewhere)
    return Units(elsewhere, of_name=unit_of(name)) if elsewhere else Units(unit_of(name))


_LIKE = re.compile(
    r"[\[(]?\s*(?:k?hz|s|secs?|seconds?|ms|msec|us|mm|m|cm|µm|um|g|mg|m?gals?|kn|n|m?v|%|-|–|1"
    r"|rad/s|rpm|[cm]?m/s\S*|[cm]?m ?s-\d|in|inch|ts|rn)?\s*[\])]?",
    re.IGNORECASE,
)


def are_units(cells: list[str]) -> bool:
    """Return whether a line below the names of columns contains their units.

    Campbell's loggers write TS and RN for times and numbers of rows.
    """
    return any(cells) and all(_LIKE.fullmatch(cell) for cell in cells)
