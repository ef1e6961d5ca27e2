"""Units as files state them: after the word "units", in brackets, or at the end of a name."""

from __future__ import annotations

import re
from typing import NamedTuple

_ENDS = {
    "hz": "Hz", "khz": "kHz", "rpm": "rpm", "radps": "rad/s", "mm": "mm", "cm": "cm", "um": "µm",
    "m": "m", "ms2": "m/s^2", "cms2": "cm/s^2", "mms2": "mm/s^2", "g": "g", "mg": "mg",
    "gal": "gal",
    "mps2": "m/s^2", "cmps2": "cm/s^2", "mmps2": "mm/s^2",
    "mps": "m/s", "cmps": "cm/s", "mmps": "mm/s", "mms": "mm/s", "s": "s",
    "ms": "ms", "n": "N", "kn": "kN", "mv": "mV", "volt": "V", "volts": "V",
}  # fmt: skip
"""What a name may end in, such as ``u_mm``, and the unit that it is."""
_CASES = {
    one.lower(): one
    for one in ("Hz", "kHz", "N", "kN", "m", "cm", "mm", "um", "g", "mg", "s", "ms", "rad", "rpm",
                "in", "inch", "ft", "hertz", "gal", "mgal")
} | {"sec": "s", "secs": "s", "second": "s", "seconds": "s", "msec": "ms", "usec": "us",
     "sek": "s", "gals": "gal", "meter": "m", "meters": "m"}  # fmt: skip
"""Units that are one and the same in capitals and small letters, as MN and mN are not."""

_POWER = r"(?:(?:\^|\*\*)?-?[1-9]|[²³]|⁻[¹²³])?"
_FACTOR = rf"[A-Za-zµμ%]+{_POWER}"
_PER_SQUARE = r"[ .·*]+s(?:ec)?(?:(?:\^|\*\*)?-[1-9]|⁻[¹²])"
_UNIT = rf"{_FACTOR}(?: ?[/*·] ?\(?{_FACTOR}\)?)*(?:{_PER_SQUARE})?"
_AFTER = re.compile(
    r"\b(?:units?|einheit(?:en)?)\b\s*(?:of\s+(?:measure(?:ment)?|accel\w*|data)\s*)?"
    r"(?:(?:are|is|of|in|ist|[:=])\s*|(?=[\[(]))(?P<stated>[\[(\"']?.*)",
    re.IGNORECASE,
)
_WHOLE = re.compile(rf"[\[(\"']?\s*({_UNIT})(?:'s)?\s*(?:[\])\"'.,;:]|\s|$)")
_BRACKETS = re.compile(r"[\[(]\s*([^\[\]()]*?)\s*[\])]")
_AT_END = re.compile(_BRACKETS.pattern + r"\s*$")
_IN = re.compile(rf"\bin\s+({_UNIT})(?=\s|$|[.,;])", re.IGNORECASE)
_ACCELERATIONS = re.compile(r"m?g|m?gal|(?:[cm]?m|in|inch|ft)/s\^2", re.IGNORECASE)
_SHOWN = 30


def spelled(unit: str) -> str:
    """A unit in the spelling that the package reads: cm/s^2 of ``CM/SEC/SEC``, kN of ``KN``."""
    clean = re.sub(r"[A-Za-z]+", lambda m: _CASES.get(m[0].lower(), m[0]), unit.strip())
    clean = re.sub(r"\s*/\s*", "/", clean)
    clean = re.sub(r"/s[/*]s\b|/\(s[*/]s\)|(?<=/s)\^?2$|(?<=/s)(?:\*\*2|²)$", _squared, clean)
    clean = re.sub(r"[ .·*]+s(?:\^|\*\*)?(?:-2|⁻²)$", "/s^2", clean)
    return "m/s^2" if re.fullmatch(r"ms(?:\^?-2|2|⁻²)", clean) else clean


def _squared(found: re.Match[str]) -> str:
    return "/s^2" if found[0].startswith("/") else "^2"


def stated_unit(line: str) -> str | None:
    """The unit that a line states after the word "unit"; None if it states none.

    What cannot be read as a unit is returned as it stands, to be refused by whoever needs it.
    """
    found = _AFTER.search(line.replace(" per ", "/"))
    if found is None:
        return None
    text = found["stated"].strip()
    whole = _WHOLE.match(text)
    return spelled(whole[1]) if whole else text[:_SHOWN] or None


def stated_acceleration(line: str) -> str | None:
    """The unit of an acceleration that stands in brackets, or after the word "in"."""
    for found in (*_BRACKETS.finditer(line), *_IN.finditer(line)):
        if _ACCELERATIONS.fullmatch(unit := spelled(found[1])):
            return unit
    return None


def is_acceleration(unit: str) -> bool:
    """Whether a text is a usual unit of accelerations."""
    return _ACCELERATIONS.fullmatch(spelled(unit)) is not None


def parted(name: str) -> tuple[str, str | None]:
    """A name, and the unit in brackets at its end."""
    name = name.strip().strip('"').strip()
    found = _AT_END.search(name)
    if not found:
        return name, None
    return name[: found.start()].strip(), found[1]


def ended(name: str) -> tuple[str, str | None]:
    """The words of a name, joined by low lines, and the unit that it ends in: ``amplitude_g``."""
    words = words_of(name)
    if len(words) > 1 and words[-1] in _ENDS:
        return "_".join(words[:-1]), _ENDS[words[-1]]
    return "_".join(words), None


def ending(words: list[str], *, sure: bool) -> str | None:
    """The unit that words end in; unless it is sure, not the g of ag nor the n of a count."""
    if len(words) < 2 or words[-1] not in _ENDS:
        return None
    a_word = words == ["a", "g"] or (words[-1] == "n" and "force" not in words)
    return None if a_word and not sure else _ENDS[words[-1]]


def words_of(name: str) -> list[str]:
    """The words of a name, in small letters."""
    return [word for word in re.split(r"[^a-z0-9]+", plain(name).lower()) if word]


_PEAK = re.compile(
    r"(?<![a-z])(?:peak|pk|p)[ _-]?(?:to|2)?[ _-]?(?:peak|pk|p)(?![a-z])", re.IGNORECASE
)


def plain(name: str) -> str:
    """A name in plain letters, its words apart, with short words for what takes several."""
    joined = re.sub("[µμ]", "u", name.strip().replace("η", "eta").replace("ü", "acc"))
    joined = re.sub(r"(?:\^|\*\*)2$|²$", "2", joined)
    joined = re.sub(r"/ *s(?:ec)? */ *s(?:ec)?$", "/s2", joined, flags=re.IGNORECASE)
    joined = re.sub(r"(?<![a-z])([cm]?m) */ *s(?:ec)?2$", r"\1s2", joined, flags=re.IGNORECASE)
    joined = re.sub(r"(?<![a-z])([cm]?m|rad) */ *s$", r"\1ps", joined, flags=re.IGNORECASE)
    # kHz, kN and mV are one word.
    joined = re.sub(r"(?<=[a-z])(?<![^A-Za-z][km])(?=[A-Z])", " ", joined)
    return _PEAK.sub("pp", joined)


def unit_of(name: str) -> str | None:
    """The unit of a column by its name: in brackets, or at its end."""
    bare, unit = parted(name)
    if unit is not None:
        return spelled(unit)
    sure = re.search(r"/ *[A-Za-z0-9]+$", plain(bare)) is not None
    return ending(words_of(bare), sure=sure)


class Units(NamedTuple):
    """The units that a file states of a column, in more than one place."""

    unit: str | None
    other: str | None = None
    """Stated elsewhere; an error where it is not the same."""
    of_name: str | None = None
    """What the name ends in (``acc_g``), where the unit is stated elsewhere."""


def units_of(name: str, stated: str | None) -> Units:
    """The units of a column: in brackets in its name, as stated elsewhere, and as its name ends."""
    elsewhere = spelled(stated) if stated and stated.strip() else None
    bracketed = parted(name)[1]
    if bracketed:
        return Units(spelled(bracketed), elsewhere)
    return Units(elsewhere, of_name=unit_of(name)) if elsewhere else Units(unit_of(name))


_LIKE = re.compile(
    r"[\[(]?\s*(?:k?hz|s|secs?|seconds?|ms|msec|us|mm|m|cm|µm|um|g|mg|m?gals?|kn|n|m?v|%|-|–|1"
    r"|rad/s|rpm|[cm]?m/s\S*|[cm]?m ?s-\d|in|inch)?\s*[\])]?",
    re.IGNORECASE,
)


def are_units(cells: list[str]) -> bool:
    """Whether a line under the names of columns holds their units."""
    return any(cells) and all(_LIKE.fullmatch(cell) for cell in cells)
