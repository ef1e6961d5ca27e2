"""A file: its bytes, its lines, and numbers in its lines, in free or fixed columns."""

from __future__ import annotations

import zlib
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.tables.decimal_mark import Decimal
from vibroimpact.tables.limits import regular, unpacked

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
        self, first: int, count: int, width: int | None = None
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

        Returns
        -------
        values, next
            The values, and the line after them.

        Raises
        ------
        InputError
            If the file ends too early, if a line contains anything but finite numbers, or if the
            last line contains too many values.
        """
        parts: list[str] = []
        at = first
        while len(parts) < count:
            if at >= len(self.lines):
                told = f"the file ends after {len(parts)} of {count} values; pass a complete file"
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
                at - 1,
                f"the file has {len(parts)} values up to this line, but its header announces "
                f"{count}; remove the extra values, or correct the header",
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
                    why = "is not a number; replace it by a number"
                    if "," in part:
                        why = "has a comma; use decimal points, and blanks between numbers"
                    return self.refused(at, f"{part[:40]!r} {why}")
                if not np.isfinite(found):
                    why = f"{part!r} is not finite; replace it by a finite number"
                    return self.refused(at, why)
        return None

    def behind(self, at: int, count: int, width: int | None = None) -> None:
        """Check that no number follows the values that the header announces.

        Raises
        ------
        InputError
            If a number follows.
        """
        while at < len(self.lines) and not self.lines[at].strip():
            at += 1
        if at >= len(self.lines):
            return
        try:
            float(self._cut(at, width)[0])
        except ValueError:
            return
        raise self.refused(
            at,
            f"there are values after the {count} that the header announces; remove them, or "
            "correct the header",
        )
