"""Largest sizes of files and tables, which are checked before data are decompressed."""

from __future__ import annotations

import zlib
from pathlib import Path

from vibroimpact.arguments import check_path
from vibroimpact.errors import InputError

MOST_BYTES = 2**28
"""Largest number of bytes of a file, compressed or decompressed."""
MOST_COLUMNS = 10_000


def regular(path: Path | str, field: str) -> None:
    """Raise an error for a file that is not regular, such as a pipe, or is too large.

    Raises
    ------
    InputError
        If the file exists, but is not a regular file or is too large.
    """
    file = check_path(path, field)
    if file.exists() and not file.is_file():
        kind = "a folder" if file.is_dir() else "not a regular file"
        raise InputError(f"{field}: {str(path)!r} is {kind}; pass the path of a file")
    if file.is_file():
        within(file.stat().st_size, path, field)


def within(size: int, path: Path | str, field: str) -> None:
    """Check a number of bytes.

    Raises
    ------
    InputError
        If there are more than `MOST_BYTES`.
    """
    if size > MOST_BYTES:
        raise InputError(
            f"{field}: {str(path)!r} has more than {MOST_BYTES // 2**20} MiB of data; shorten it, "
            "or reduce its number of samples"
        )


def few_columns(count: int, path: Path | str, field: str) -> None:
    """Check the number of columns of a table.

    Raises
    ------
    InputError
        If there are more than `MOST_COLUMNS`.
    """
    if count > MOST_COLUMNS:
        raise InputError(
            f"{field}: {str(path)!r} has {count} columns; pass at most {MOST_COLUMNS} columns"
        )


def unpacked(data: bytes, path: Path | str, field: str, *, gzip: bool) -> bytes:
    """Decompress data of gzip or zlib, and stop if the result becomes too large.

    Raises
    ------
    InputError
        If the result has more than `MOST_BYTES`.
    zlib.error, EOFError
        If the data are damaged, or if they end too early.
    """
    parts: list[bytes] = []
    size = 0
    while data:
        packed = zlib.decompressobj(31 if gzip else 15)
        part = packed.decompress(data, MOST_BYTES + 1 - size)
        size += len(part)
        within(size, path, field)
        parts.append(part)
        if not packed.eof:
            raise EOFError("the file ends too early")
        data = packed.unused_data.lstrip(b"\0") if gzip else b""
    return b"".join(parts)
