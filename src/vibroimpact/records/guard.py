"""Bounds of what is read from files: sizes are known before anything is unpacked or reserved."""

from __future__ import annotations

import zlib
from pathlib import Path

from vibroimpact.arguments import check_path
from vibroimpact.errors import InputError

MOST_BYTES = 2**28
"""Of a file, packed or not."""
MOST_COLUMNS = 10_000


def regular(path: Path | str, field: str) -> None:
    """Raise an error for a file that is not regular, such as a pipe, or is too large.

    Raises
    ------
    InputError
        If it exists, and cannot be used.
    """
    file = check_path(path, field)
    if file.exists() and not file.is_file():
        kind = "a folder" if file.is_dir() else "not a regular file"
        raise InputError(f"{field}: {str(path)!r} is {kind}; a file is accepted")
    if file.is_file():
        within(file.stat().st_size, path, field)


def within(size: int, path: Path | str, field: str) -> None:
    """Refuse more bytes than are read.

    Raises
    ------
    InputError
        If there are more.
    """
    if size > MOST_BYTES:
        raise InputError(
            f"{field}: {str(path)!r} holds more than {MOST_BYTES // 2**20} MiB of data; less is "
            "accepted, such as a part of it or fewer samples"
        )


def few_columns(count: int, path: Path | str, field: str) -> None:
    """Refuse more columns than a table has.

    Raises
    ------
    InputError
        If there are more.
    """
    if count > MOST_COLUMNS:
        raise InputError(
            f"{field}: {str(path)!r} has {count} columns; at most {MOST_COLUMNS} are accepted"
        )


def unpacked(data: bytes, path: Path | str, field: str, *, gzip: bool) -> bytes:
    """Unpack data of gzip or zlib, and stop where they become too many.

    Raises
    ------
    InputError
        If they do.
    zlib.error, EOFError
        If they are damaged, or end too early.
    """
    found: list[bytes] = []
    size = 0
    while data:
        packed = zlib.decompressobj(31 if gzip else 15)
        part = packed.decompress(data, MOST_BYTES + 1 - size)
        size += len(part)
        within(size, path, field)
        found.append(part)
        if not packed.eof:
            raise EOFError("it ends too early")
        data = packed.unused_data.lstrip(b"\0") if gzip else b""
    return b"".join(found)
