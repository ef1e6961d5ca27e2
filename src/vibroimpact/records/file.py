"""A file of a record: its bytes, its lines, and numbers in lines of free or fixed columns."""

from __future__ import annotations

import zlib
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.records.commas import Decimal
from vibroimpact.records.guard import regular, unpacked

_PACKED = b"\x1f\x8b"


class File:
    """A file that was read into memory, unpacked where it was packed by gzip.

    Lines are counted from 0 here and from 1 in messages. ``decimal`` is the mark that the caller
    says its columns have.
    """

    def __init__(self, path: Path | str, decimal: Decimal | None = None) -> None:
        self.path = str(path)
        self.decimal = decimal
        try:
            regular(path, "record")
            self.data = Path(path).read_bytes()
            if self.data.startswith(_PACKED):
                self.data = unpacked(self.data, path, "record", gzip=True)
        except (EOFError, zlib.error) as error:
            raise InputError(
                f"record: {self.path!r} is a damaged gzip file ({error}); a complete file is "
                "accepted"
            ) from None
        except OSError as error:
            raise InputError(
                f"record: {self.path!r} cannot be read ({error.strerror or error}); the path of a "
                "record is accepted"
            ) from None

    @cached_property
    def lines(self) -> list[str]:
        """Its lines; none where it is not text."""
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
        """Whether a line break, or the mark of an older end, stands at its end."""
        return self.data.rstrip(b" \t\0")[-1:] in (b"\n", b"\r", b"\x1a", b"")

    def line(self, at: int) -> str:
        """A line.

        Raises
        ------
        InputError
            If the file has ended.
        """
        if at >= len(self.lines):
            raise self.refused(len(self.lines) - 1, "the file ends within the header")
        return self.lines[at]

    def refused(self, at: int, why: str) -> InputError:
        """The error that names a line."""
        return InputError(f"record: {self.path!r}, line {at + 1}: {why}")

    def numbers(
        self, first: int, count: int, width: int | None = None
    ) -> tuple[NDArray[np.float64], int]:
        """Read numbers from a line on, however many a line holds.

        Parameters
        ----------
        first
            The line.
        count
            How many.
        width
            Columns of a number; None where blanks stand between them.

        Returns
        -------
        values, next
            And the line after them.

        Raises
        ------
        InputError
            If the file ends before, a line contains something other than finite numbers, or the
            last line holds more than there should be.
        """
        parts: list[str] = []
        at = first
        while len(parts) < count:
            if at >= len(self.lines):
                told = (
                    f"the file ends after {len(parts)} of {count} values; a complete file is "
                    "accepted"
                )
                raise self._damaged(first, at, width) or self.refused(len(self.lines) - 1, told)
            parts += self._cut(at, width)
            at += 1
        try:
            values = np.array(parts, dtype=np.float64)
        except ValueError:
            values = np.array([np.nan])
        if not np.isfinite(values).all() and (error := self._damaged(first, at, width)):
            raise error
        if len(parts) > count:
            raise self.refused(
                at - 1, f"{len(parts)} values until here, and {count} should be all there are"
            )
        return values, at

    def _cut(self, at: int, width: int | None) -> list[str]:
        line = self.lines[at].rstrip()
        if not width:
            return line.split()
        return [line[i : i + width].strip() for i in range(0, len(line), width)]

    def _damaged(self, first: int, behind: int, width: int | None) -> InputError | None:
        """Find a value that is not finite, and where; None if all are finite."""
        for at in range(first, behind):
            for part in self._cut(at, width):
                try:
                    found = float(part)
                except ValueError:
                    why = "is not a number; numbers are accepted"
                    if "," in part:
                        why = (
                            "has a comma; decimal points, and blanks between numbers, are accepted"
                        )
                    return self.refused(at, f"{part[:40]!r} {why}")
                if not np.isfinite(found):
                    return self.refused(at, f"{part!r} is not finite; finite samples are accepted")
        return None

    def behind(self, at: int, count: int, width: int | None = None) -> None:
        """See to it that no number follows the last that was announced.

        Raises
        ------
        InputError
            If one does.
        """
        while at < len(self.lines) and not self.lines[at].strip():
            at += 1
        if at >= len(self.lines):
            return
        try:
            float(self._cut(at, width)[0])
        except ValueError:
            return
        raise self.refused(at, f"a further value after the {count} that the header announces")
