"""Text tables: CSV and similar formats.

Columns are separated by commas, semicolons, tabs or blanks. Decimal commas are accepted if commas
do not separate the columns. Lines that begin with ``#`` may contain ``amplitude = 0.05 g`` or
``amplitude; 0.05 g``. The last line of words before the numbers contains the names of the columns.
A line of units may follow it.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.measurements.beside import is_number, with_unit
from vibroimpact.measurements.columns import Column, Columns
from vibroimpact.measurements.scaling import agreed
from vibroimpact.tables.decimal_mark import Decimal, decimal_mark
from vibroimpact.tables.limits import few_columns
from vibroimpact.tables.units import are_units, parted

_SAID = re.compile(r"^\s*([A-Za-z][\w ()\[\]/^²]*?)\s*([=:;])\s*(.+?)\s*$")
_COMMA = re.compile(r"[+-]?\d+,\d+(?![\d,.])")
_ABSENT = {"", "nan", "na", "n/a", "none", "null", "-", "--", "#n/a", "missing"}


def read(path: Path, decimal: Decimal | None = None) -> list[Columns]:
    """Read the table of a text file.

    Parameters
    ----------
    path
        The file.
    decimal
        The decimal mark. Default: detected from the table.

    Raises
    ------
    InputError
        If the file has no table of numbers, or if a row has another number of columns.
    """
    lines = _decoded(path).splitlines()
    said: dict[str, str] = {}
    kept: list[tuple[int, str]] = []
    for number, line in enumerate(lines, 1):
        bare = line.strip()
        if bare.startswith(("#", "%", "//")):
            if pair := _said(bare.lstrip("#%/ ")):
                said[pair[0]] = pair[1]
        elif bare:
            kept.append((number, line))
    if not kept:
        raise InputError(
            f"measurement: {str(path)!r} is empty; pass a file with column names and numbers"
        )
    texts = [line for _, line in kept]
    found = decimal or decimal_mark(texts, f"measurement: {str(path)!r}")
    mark = _delimiter(texts, found)
    few_columns(texts[-1].count(mark or " ") + 1, path, "measurement")
    rows = [(number, _parts(line, mark)) for number, line in kept]
    decimal = "," if mark != "," else found
    said = {key: _pointed(value, decimal) for key, value in said.items()}
    first = next((i for i, (_, cells) in enumerate(rows) if _is_data(cells, decimal)), None)
    if first is None:
        raise InputError(
            f"measurement: {str(path)!r} has no row of numbers; pass a file with a table of numbers"
        )
    head = [cells for _, cells in rows[:first]]
    for cells in head:
        if len(cells) <= 2 and (pair := _said("; ".join(c for c in cells if c))):
            said.setdefault(pair[0], _pointed(pair[1], decimal))
    width = len(rows[first][1])
    named = [cells for cells in head if len(cells) == width and any(cells)]
    units: list[str] = []
    if len(named) > 1 and are_units(named[-1]):
        units = [cell.strip("[]() ") for cell in named.pop()]
    if not named:
        raise InputError(
            f"measurement: {str(path)!r} does not name its {width} columns; add a first line such "
            "as 'frequency (Hz), direction, displacement excursion (mm)'"
        )
    body = rows[first:]
    for number, cells in body:
        if len(cells) != width:
            raise InputError(
                f"measurement: {str(path)!r}, line {number}: {len(cells)} values, but the first "
                f"row of numbers has {width}; write the same number of values in every row"
            )
    columns = []
    for j, name in enumerate(named[-1]):
        cells = [row[j] for _, row in body]
        bare, own = parted(name)
        unit, doubt = agreed(own, units[j] if units else None)
        values = _values(str(path), bare, cells, [number for number, _ in body], decimal)
        columns.append(Column(bare, unit, values, doubt=doubt))
    numbers = np.array([number for number, _ in body])
    return [Columns(str(path), tuple(columns), said, numbers)]


def _pointed(text: str, decimal: str) -> str:
    """Return a number with a decimal point. With comma-separated columns, 1,000 is kept."""
    found = _COMMA.match(text)
    if not found or (decimal == "." and re.fullmatch(r"[+-]?[1-9]\d*,\d{3}", found[0])):
        return text
    return found[0].replace(",", ".") + text[found.end() :]


def _said(text: str) -> tuple[str, str] | None:
    """Return the name and the value of an entry. After a semicolon the value must be a number."""
    found = _SAID.match(text)
    if found is None or (found[2] == ";" and not is_number(found[3])):
        return None
    if found[2] == ":" and found[1][-1].isdigit():  # a time of day
        return None
    name, unit = parted(found[1])
    return name, with_unit(found[3].strip().strip('"'), unit)


def _decoded(path: Path) -> str:
    data = path.read_bytes()
    for encoding in ("utf-8-sig", "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8"):
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    return data.decode("latin-1")


def _delimiter(lines: list[str], decimal: Decimal) -> str | None:
    """Return the separator of the columns, or None for blanks."""
    last = lines[-1]
    for mark in (";", "\t"):
        if mark in last:
            return mark
    # A decimal comma parts columns only where the numbers stand in quotes.
    return "," if "," in last and (decimal == "." or '"' in last) else None


def _parts(line: str, mark: str | None) -> list[str]:
    if mark is None:
        return line.split()
    try:
        return [cell.strip() for cell in next(csv.reader([line.strip("\r\n")], delimiter=mark))]
    except csv.Error:  # a cell of more letters than any number has
        return line.split(mark)


def _number(cell: str, decimal: str) -> float | None:
    if cell.strip().lower() in _ABSENT:
        return float("nan")
    try:
        return float(cell.replace(",", ".") if decimal == "," else cell)
    except ValueError:
        return None


def _is_data(cells: list[str], decimal: str) -> bool:
    """Return whether a line has at least one number, and at least as many numbers as words."""
    numbers = [_number(cell, decimal) for cell in cells if cell.lower() not in _ABSENT]
    known = [number for number in numbers if number is not None]
    return len(known) >= max(1, len(numbers) - 1 - len(known))


def _values(
    path: str, name: str, cells: list[str], lines: list[int], decimal: str
) -> NDArray[np.float64] | NDArray[np.str_]:
    found = [_number(cell, decimal) for cell in cells]
    words = [i for i, number in enumerate(found) if number is None]
    if not words:
        return np.array(found, dtype=float)
    if len(words) >= 0.5 * len(cells):
        return np.array(cells)
    i = words[0]
    raise InputError(
        f"measurement: {path!r}, line {lines[i]}, column {name!r}: {cells[i][:40]!r} is not a "
        "number; correct it, or leave the cell empty if the value is missing"
    )
