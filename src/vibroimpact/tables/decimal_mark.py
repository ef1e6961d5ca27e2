"""Find out whether the commas of a table separate its columns or are decimal commas."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Literal

from vibroimpact.errors import InputError, shown

Decimal = Literal[".", ","]

_ROW = re.compile(r"[\s\d+\-.,;eEdD\"']*\d[\s\d+\-.,;eEdD\"']*")
_WITH_COMMA = re.compile(r"[+-]?\d*,\d+(?:[eE][+-]?\d+)?")
_WITHOUT = re.compile(r"[+-]?\d+(?:[eE][+-]?\d+)?")
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+")
_QUOTED = re.compile(r"[\"']\s*([^\"']*)\s*[\"']")


def checked(decimal: object) -> Decimal | None:
    """Check the decimal mark that a caller passes, and return it.

    Raises
    ------
    InputError
        If it is neither a point nor a comma.
    """
    if decimal is None:
        return None
    if not isinstance(decimal, str) or decimal not in (".", ","):
        raise InputError(f"decimal: {shown(decimal)} is not a decimal mark; pass '.' or ','")
    return decimal  # type: ignore[return-value]


def decimal_mark(lines: Iterable[str], where: str) -> Decimal:
    """Return the decimal mark of a table.

    A comma is a decimal mark if it is within quotes, or within numbers that are separated by
    semicolons, tabs or blanks.

    Raises
    ------
    InputError
        If each comma may separate thousands, and neither semicolons nor tabs separate the numbers.
    """
    numbers: list[str] = []
    parted = False
    for line in lines:
        if "," not in line or not _ROW.fullmatch(line):
            continue
        if "." in line:
            return "."
        cells = _QUOTED.findall(line) or re.split(r"[;\s]+", line.strip(" ;\t"))
        if len(cells) < 2 and '"' not in line and ";" not in line:
            return "."
        if not all(_WITH_COMMA.fullmatch(c) or _WITHOUT.fullmatch(c) for c in cells if c):
            return "."
        numbers += [cell for cell in cells if "," in cell]
        parted = parted or ";" in line or "\t" in line
    if numbers and not parted and all(map(_THOUSANDS.fullmatch, numbers)):
        raise InputError(
            f"{where}: the comma in {numbers[0]!r} may be a decimal comma or a thousands "
            "separator; if it is a decimal comma, pass decimal=',' (--decimal ,); if not, remove "
            "the thousands separators from the file"
        )
    return "," if numbers else "."
