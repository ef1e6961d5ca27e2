"""The lines of a text table: those above its numbers, and its rows, cut into cells."""

from __future__ import annotations

import csv
import re
from collections import Counter
from typing import NamedTuple

from vibroimpact.errors import InputError
from vibroimpact.tables.decimal_mark import Decimal, decimal_mark
from vibroimpact.tables.file import TOUCHING, File
from vibroimpact.tables.times import STAMPS, stamp

ABSENT = {"", "nan", "na", "n/a", "none", "null", "-", "--", "#n/a", "missing"}
"""Cells of missing values."""
_COMMENT = ("#", "%", "//", "!")
_MARK = re.compile(r"(?<!\d\.)#(?!n/a)|!", re.IGNORECASE)
"""The mark of a comment after the values of a row. Windows writes ``1.#QNAN`` for NaN."""
_NOT_FINITE = re.compile(
    r"[-+]?(?:1\.#(?:[qs]?nan|ind|(?P<inf>inf))\d*|nan\((?:ind|snan)\))", re.IGNORECASE
)
_END = re.compile(r"\W*end\W+(?:of\W+)?(?:the\W+)?(?:data|file|record)\W*|\s*/&\s*", re.IGNORECASE)
_NUMBER = re.compile(
    r"[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?|inf(?:inity)?)", re.IGNORECASE
)
_SOME = 400
"""Number of lines that show the separator."""
_UNEVEN = 0.3
"""Largest deviation of times of the first rows, as a share of their step."""
_LONGEST = 60
"""Largest number of characters of a number."""


class Heading(NamedTuple):
    """A line that is not a row of values."""

    at: int
    """Number of the line, starting from 0."""
    text: str
    """Its text, without a mark of a comment."""
    is_comment: bool


class Rows(NamedTuple):
    """The lines of a text table."""

    above: list[Heading]
    """Lines above the rows."""
    comments: list[Heading]
    """Comments between and below the rows."""
    cells: list[list[str]]
    """Cells of each row. Missing values are empty or another word of `ABSENT`."""
    lines: list[int]
    """The line of each row, starting from 0."""
    delimiter: str | None
    """None if blanks separate the cells."""
    decimal: Decimal

    def number(self, cell: str) -> float | None:
        """Return the number in a cell, NaN for a missing value, or None for a word."""
        return number_in(cell, self.decimal)


def number_in(cell: str, decimal: Decimal) -> float | None:
    """Return the number in a cell, NaN for a missing value, or None for a word."""
    try:  # as nearly always
        value = float(cell)
    except ValueError:
        pass
    else:
        if "_" not in cell:
            return value
    cell = cell.strip()
    if cell.lower() in ABSENT:
        return float("nan")
    if of_windows := _NOT_FINITE.fullmatch(cell):
        return float("inf" if of_windows["inf"] else "nan")
    if decimal == ",":
        cell = cell.replace(",", ".")
    cell = cell.replace("−", "-")
    if len(cell) > _LONGEST or not _NUMBER.fullmatch(cell):
        return None
    return (
        float(re.sub("[dD]", "E", cell)) if cell[-1].isdigit() or cell[-1] == "." else float(cell)
    )


def split_rows(file: File) -> Rows:
    """Find the rows of the table in a text file.

    Raises
    ------
    InputError
        If the file is not text or has no numbers, if a line within the rows is not a row, if
        numbers follow the end of the data, or if the commas of the table are ambiguous.
    """
    where = f"{file.what}: {file.path!r}"
    if not file.lines:
        raise InputError(f"{where} is not text; pass a text file with columns of numbers")
    texts = [(at, line) for at, line in enumerate(file.lines) if line.strip()]
    if not texts:
        raise InputError(f"{where} is empty and has no numbers; pass a file with number columns")
    plain = [line for _, line in texts if not line.lstrip().startswith(_COMMENT)]
    mark = file.decimal or decimal_mark((STAMPS.sub("0", line) for line in plain), where)
    delimiter = _delimiter([STAMPS.sub("0", line) for line in plain[-_SOME:]], mark)
    # Between semicolons or tabs, a comma in a number is a decimal comma.
    decimal: Decimal = file.decimal or ("," if delimiter in (";", "\t") else mark)
    # With semicolons between columns, the first cell of a line may be empty.
    comment = _COMMENT if delimiter == ";" else (*_COMMENT, ";")
    headings: list[Heading] = []
    lines: list[tuple[int, list[str]]] = []
    ends: list[int] = []
    for at, line in texts:
        bare = line.strip()
        if bare.startswith(comment):
            headings.append(Heading(at, bare.lstrip("#%/!; \t"), True))
        elif _END.fullmatch(bare):
            ends.append(at)
        else:
            if "#" in line or "!" in line:
                line = _without_comment(line, delimiter, decimal)
            lines.append((at, _cells(line, delimiter, decimal)))
    rows = _rows(lines, decimal)
    if not rows:
        raise InputError(
            f"{where} has no numbers (no row of numbers); pass a file with number columns"
        )
    kept = {at for at, _ in rows}
    headings += [Heading(at, file.lines[at].strip(), False) for at, _ in lines if at not in kept]
    return _body(file, headings, rows, ends, delimiter, decimal)


def _without_comment(line: str, delimiter: str | None, decimal: Decimal) -> str:
    """A row without the comment after its values. A mark may also belong to a cell: ``Run #2``."""
    for mark in _MARK.finditer(line):
        before = line[: mark.start()]
        is_last = delimiter is None or delimiter not in line[mark.start() :]
        if is_last or _words(_cells(before, delimiter, decimal), decimal) == 0:
            return before
    return line


def _rows(lines: list[tuple[int, list[str]]], decimal: Decimal) -> list[tuple[int, list[str]]]:
    """The lines that are rows: of numbers alone or, where the table has such columns, of words."""
    kinds = [_words(cells, decimal) for _, cells in lines]
    strict = [line for line, words in zip(lines, kinds, strict=True) if words == 0]
    some = [line for line, words in zip(lines, kinds, strict=True) if words is not None]
    if not some:
        return []
    width = Counter(len(cells) for _, cells in some).most_common(1)[0][0]
    first = some[0][0]
    if 2 * len(strict) >= len(some):
        first = _first_row(lines, [line[0] for line in lines].index(strict[0][0]), decimal)
    rows = []
    for (at, cells), words in zip(lines, kinds, strict=True):
        is_empty = all(cell.lower() in ABSENT for cell in cells)
        among = at >= first and len(cells) == width
        if words == 0 or (among and (words is not None or is_empty)):
            rows.append((at, cells))
    return rows


def _first_row(lines: list[tuple[int, list[str]]], at: int, decimal: Decimal) -> int:
    """The line of the first row: of numbers alone, or a row of the same times with words above."""
    even = [row for row in lines[at : at + 3] if len(row[1]) == len(lines[at][1])]
    if len(even) < 3:
        return lines[at][0]
    for column in range(len(even[0][1])):
        first, *later = (_along(cells[column], decimal) for _, cells in even)
        steps = [one - first for one in later]
        if not steps[0] > 0.0 or abs(steps[1] - 2.0 * steps[0]) > _UNEVEN * steps[0]:
            continue
        while at > 0 and len(lines[at - 1][1]) == len(even[0][1]):
            before = _along(lines[at - 1][1][column], decimal)
            if not abs(first - before - steps[0]) <= _UNEVEN * steps[0]:
                break
            at, first = at - 1, before
    return lines[at][0]


def _along(cell: str, decimal: Decimal) -> float:
    """The number or the time of day in a cell, NaN if there is neither."""
    number = number_in(cell, decimal)
    if number is None and (clock := stamp(cell)) and clock.seconds is not None:
        return clock.seconds + clock.fraction
    return float("nan") if number is None else number


def _words(cells: list[str], decimal: Decimal) -> int | None:
    """How many words a row has; None if it has no number, or fewer numbers than words but one."""
    known = words = 0
    for cell in cells:
        number = number_in(cell, decimal)
        if number is not None and number == number:
            known += 1
        elif number is None:
            if stamp(cell):
                known += 1
            else:
                words += 1
    return words if known >= max(1, words - 1) else None


def _body(
    file: File,
    headings: list[Heading],
    rows: list[tuple[int, list[str]]],
    ends: list[int],
    delimiter: str | None,
    decimal: Decimal,
) -> Rows:
    """Separate the rows of the table from rows of numbers in the lines above it."""
    words = sorted(one.at for one in headings if not one.is_comment)
    runs: list[list[tuple[int, list[str]]]] = [[]]
    left = iter(words)
    barrier = next(left, None)
    for at, cells in rows:
        crossed = False
        while barrier is not None and barrier < at:
            crossed, barrier = True, next(left, None)
        if crossed and runs[-1]:
            runs.append([])
        runs[-1].append((at, cells))
    longest = max(range(len(runs)), key=lambda i: (len(runs[i]), -i))
    body = runs[longest]
    before = [row for run in runs[:longest] for row in run]
    width = Counter(len(cells) for _, cells in body).most_common(1)[0][0]
    for _, cells in before:
        # As wide as the rows: the table is interrupted there, and its first part would be lost.
        if len(cells) == width and all(number_in(c, decimal) is not None for c in cells):
            body, before = [*before, *body], []
            break
    first, last = body[0][0], body[-1][0]
    for at in [one for one in words if one > first]:
        shown = file.lines[at].strip()[:40]
        raise file.refused(
            at,
            f"{shown!r} is not a row of numbers; after the first row of numbers, write only "
            "numbers",
        )
    for end in ends:
        if first < end < last:
            behind = next(at for at, _ in body if at > end)
            raise file.refused(
                behind, "numbers follow the end of the data; use a file with one record"
            )
    above = [one for one in headings if one.at < first]
    above += [Heading(at, file.lines[at].strip(), False) for at, _ in before]
    return Rows(
        sorted(above),
        [one for one in headings if one.at > first],
        [cells for _, cells in body],
        [at for at, _ in body],
        delimiter,
        decimal,
    )


def _delimiter(lines: list[str], decimal: Decimal) -> str | None:
    """Return the separator of most lines with numbers, or None for blanks."""
    some = [line for line in lines if re.search(r"\d", line)]
    for mark in (";", "\t"):
        if 2 * sum(mark in line.strip() for line in some) > len(some):
            return mark
    commas = sum("," in line for line in some)
    # A decimal comma separates columns only if the numbers are in quotes.
    quoted = any('"' in line for line in some)
    return "," if 2 * commas > len(some) and (decimal == "." or quoted) else None


def _cells(line: str, delimiter: str | None, decimal: Decimal) -> list[str]:
    """The cells of a line. Blanks within a cell separate numbers, too."""
    if delimiter is None:
        bare = line.replace('"', " ").replace("'", " ").strip(" \t,")
        if ":" not in bare:  # numbers of fixed width touch each other where they are negative
            bare = TOUCHING.sub(" ", bare)
        return _joined(re.split(r"\s*,\s*|\s+" if decimal == "." else r"\s+", bare))
    if '"' in line or "'" in line:
        try:
            quote = '"' if '"' in line else "'"
            cells = next(csv.reader([line.strip("\r\n")], delimiter=delimiter, quotechar=quote))
        except csv.Error:  # a cell with more letters than any number has
            cells = line.split(delimiter)
    else:
        cells = line.split(delimiter)
    split_cells: list[str] = []
    for cell in cells:
        bare = cell.strip()
        if " " in bare or "\t" in bare:
            parts = bare.split()
            if all(number_in(part, decimal) is not None for part in parts):
                split_cells += parts
                continue
        split_cells.append(bare)
    return split_cells


def _joined(parts: list[str]) -> list[str]:
    """Parts between blanks. A date and the time of day after it are one cell."""
    cells: list[str] = []
    for part in parts:
        both = f"{cells[-1]} {part}" if cells else ""
        read = stamp(both) if ":" in part else None
        half = part.lower().strip(".") in ("am", "pm", "a.m", "p.m") and stamp(both)
        if half or (read and read.date and read.seconds is not None):
            cells[-1] = both
        else:
            cells.append(part)
    return cells


def cut_heading(text: str, delimiter: str | None) -> list[str]:
    """Return the cells of a line above the rows, which the delimiter of the rows separates."""
    if delimiter is None:
        return text.split()
    try:
        return [cell.strip() for cell in next(csv.reader([text], delimiter=delimiter))]
    except csv.Error:
        return [cell.strip() for cell in text.split(delimiter)]
