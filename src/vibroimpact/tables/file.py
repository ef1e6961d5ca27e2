"""A file: its bytes, its lines, and numbers in its lines, in free or fixed columns."""

from __future__ import annotations

import math
import re
import zlib
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.tables.decimal_mark import Decimal
from vibroimpact.tables.limits import regular, unpacked

_TEXT = re.compile(r"[A-Za-z]{4}")
"""Text that cannot be a damaged number. NaN and inf have three letters."""
TOUCHING = re.compile(r"(?<=\d)(?=[-+]\d*\.\d)")
"""Place between two numbers of fixed width, the second of which fills its width with its sign."""
_HEADER = 120
"""Largest number of lines of a header."""
_PACKED = b"\x1f\x8b"


class File:
    """A file that was read into memory. If gzip has compressed it, it is decompressed.

    Lines are counted from 0 in the code, and from 1 in messages. ``decimal`` is the decimal mark
    that the caller passed, or None. ``what`` is the name of the file in messages, such as
    ``"record"``.
    """

    def __init__(
        self, path: Path | str, decimal: Decimal | None = None, what: str = "record"
    ) -> None:
        self.path = str(path)
        self.decimal = decimal
        self.what = what
        try:
            regular(path, what)
            self.data = Path(path).read_bytes()
            if self.data.startswith(_PACKED):
                self.data = unpacked(self.data, path, what, gzip=True)
        except (EOFError, zlib.error) as error:
            raise InputError(
                f"{what}: {self.path!r} is a damaged gzip file ({error}); pass an undamaged copy"
            ) from None
        except OSError as error:
            raise InputError(
                f"{what}: {self.path!r} cannot be read ({error.strerror or error}); pass the path "
                "of a readable file"
            ) from None

    @cached_property
    def lines(self) -> list[str]:
        """The lines of the file. A file that is not text has no lines."""
        text = ""
        if self.data.startswith((b"\xff\xfe", b"\xfe\xff")):  # as spreadsheets write it
            text = self.data.decode("utf-16", errors="replace")
        if "\n" not in text:
            if b"\0" in self.data[:4096]:
                return []
            try:
                text = self.data.decode("utf-8-sig")
            except UnicodeDecodeError:
                text = self.data.decode("latin-1")  # older files; only names have such letters
        # str.splitlines would also break at form feeds and at line separators of Unicode.
        text = text.partition("\x1a")[0]  # the end of a file under CP/M and DOS
        return text.replace("\r\n", "\n").replace("\r", "\n").removesuffix("\n").split("\n")

    @cached_property
    def ends_whole(self) -> bool:
        """Whether the file ends with a line break, or with an end-of-file character."""
        return self.data.rstrip(b" \t\0")[-1:] in (b"\n", b"\r", b"\x1a", b"")

    def line(self, at: int) -> str:
        """Return a line.

        Raises
        ------
        InputError
            If the file has no such line.
        """
        if at >= len(self.lines):
            raise self.refused(
                len(self.lines) - 1, "the file ends within the header; pass a complete file"
            )
        return self.lines[at]

    def refused(self, at: int, why: str) -> InputError:
        """Return an error that states a line of the file."""
        return InputError(f"{self.what}: {self.path!r}, line {at + 1}: {why}")

    def numbers(
        self, first: int, count: int, width: int | None = None, each: int = 1
    ) -> tuple[NDArray[np.float64], int]:
        """Read a given number of values, which may be spread over several lines.

        Parameters
        ----------
        first
            The first line.
        count
            Number of values.
        width
            Number of characters of a value. None if blanks separate the values.
        each
            Count in units of so many values in messages, such as 2 for pairs of a time and a value.

        Returns
        -------
        values, next
            The values, and the line after them.

        Raises
        ------
        InputError
            If the file or its numbers end too early, if a line contains anything but finite
            numbers, or if the last line contains too many values.
        """
        parts: list[str] = []
        at = first
        while len(parts) < count:
            read = f"{len(parts) // each} of {count // each}"
            if at >= len(self.lines):
                message = f"the file ends after {read} values; pass a complete file"
                raise self._damaged(first, at, width) or self.refused(len(self.lines) - 1, message)
            if _TEXT.search(self.lines[at]):
                message = f"the values end here after {read}; pass a complete file, or correct the "
                raise self._damaged(first, at, width) or self.refused(at, f"{message}header")
            parts += self._split_line(at, width)
            at += 1
        try:
            values = np.array(parts, dtype=np.float64)
        except ValueError:
            values = np.array([np.nan])
        if not np.isfinite(values).all() and (error := self._damaged(first, at, width)):
            raise error
        if len(parts) > count:
            raise self.refused(
                at - 1,
                f"the file has {len(parts) // each} values up to this line, but its header "
                f"announces {count // each}; remove the extra values, or correct the header",
            )
        return values, at

    def _split_line(self, at: int, width: int | None) -> list[str]:
        line = self.lines[at].rstrip()
        if not width:  # numbers touch each other where they are negative
            return TOUCHING.sub(" ", line).split()
        return [line[i : i + width].strip() for i in range(0, len(line), width)]

    def _damaged(self, first: int, behind: int, width: int | None) -> InputError | None:
        """Find a value that is not finite, and where; None if all are finite."""
        for at in range(first, behind):
            for part in self._split_line(at, width):
                try:
                    self._finite(at, part)
                except InputError as error:
                    return error
        return None

    def _finite(self, at: int, part: str) -> float:
        try:
            value = float(part)
        except ValueError:
            why = "is not a number; replace it by a number"
            if "," in part:
                why = "has a comma; use decimal points, and blanks between numbers"
            raise self.refused(at, f"{part[:40]!r} {why}") from None
        if not math.isfinite(value):
            raise self.refused(at, f"{part!r} is not finite; replace it by a finite number")
        return value

    def behind(self, at: int, count: int, width: int | None = None, each: int = 1) -> None:
        """Check that no number follows the values that the header announces.

        Parameters
        ----------
        at
            The line after the values.
        count, width, each
            As in `numbers`.

        Raises
        ------
        InputError
            If a number follows.
        """
        while at < len(self.lines) and not self.lines[at].strip():
            at += 1
        more = 0
        for line in range(at, len(self.lines)):
            line_count = self._leading(line, width)
            if not line_count and self.lines[line].strip():
                break
            more += line_count
        if more:
            raise self.refused(
                at,
                f"the header announces {count // each} values, but {(count + more) // each} "
                "follow it; remove the extra values, or correct the header",
            )

    def _leading(self, at: int, width: int | None) -> int:
        """How many numbers a line begins with."""
        cells = self._split_line(at, width)
        for number, cell in enumerate(cells):
            try:
                float(cell)
            except ValueError:
                return number
        return len(cells)

    def rows(
        self,
        first: int,
        columns: int,
        separator: str | None = None,
        skip: int = 0,
        width: int | None = None,
    ) -> NDArray[np.float64]:
        """Read all rows of numbers from a line to the end of the file.

        Parameters
        ----------
        first
            The first row.
        columns
            Number of columns, including those that are skipped.
        separator
            Separator of the columns. None for blanks.
        skip
            Number of columns before the numbers, such as a date.
        width
            Number of characters of a column, if no separator stands between columns.

        Returns
        -------
        rows
            An array of shape (rows, columns - skip).

        Raises
        ------
        InputError
            If a row has another number of columns, or contains anything but finite numbers.
        """
        values: list[list[float]] = []
        last = len(self.lines)
        while last > first and not self.lines[last - 1].strip():
            last -= 1
        for at in range(first, last):
            cells = (
                self._split_line(at, width) if width else self.lines[at].strip().split(separator)
            )
            if len(cells) != columns:
                message = f"the row has {len(cells)} columns, but the header announces {columns}; "
                raise self.refused(at, f"{message}pass a complete file")
            values.append([self._finite(at, cell) for cell in cells[skip:]])
        return np.array(values, dtype=np.float64).reshape(-1, columns - skip)

    def check_count(self, at: int, stated: int, count: int) -> None:
        """Compare a number of values that a line states with the number in the file.

        Raises
        ------
        InputError
            If they differ, or if there is no value.
        """
        if stated < 1:
            raise self.refused(at, f"the header states {stated} values; pass at least 2 values")
        if stated != count:
            do = "pass a complete file" if count < stated else "remove the extra values"
            raise self.refused(
                at,
                f"the header announces {stated} values, but {count} follow it; {do}, or correct "
                "the header",
            )

    def find_line(self, pattern: str, last: int = _HEADER) -> tuple[int, re.Match[str]] | None:
        """Return the first of the first lines that matches a pattern, and the match, or None."""
        for at, line in enumerate(self.lines[:last]):
            if match := re.match(pattern, line, re.IGNORECASE):
                return at, match
        return None

    def require_line(
        self, pattern: str, what: str, last: int = _HEADER
    ) -> tuple[int, re.Match[str]]:
        """Return what `find_line` returns.

        Raises
        ------
        InputError
            If no line matches. The message names the entry, `what`.
        """
        entry = self.find_line(pattern, last)
        if entry is None:
            at = min(last, len(self.lines)) - 1
            raise self.refused(at, f"the header does not state {what}; pass a complete file")
        return entry
