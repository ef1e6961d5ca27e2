"""TDMS files: each group is a table; each channel has its own unit, step and start."""

from __future__ import annotations

import logging
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.measurements.channel_attributes import kind_of, stated
from vibroimpact.measurements.columns import ChannelColumn, Columns
from vibroimpact.measurements.tables import damaged, described, key_and_text, library
from vibroimpact.tables.limits import within
from vibroimpact.tables.units import parted

_LEAD = 28
"""Lead-in of each segment: its signature, and the distance to the next segment."""
_STARTED, _SCALES = "wf_start_time", "NI_Number_Of_Scales"


def read(path: Path) -> list[Columns]:
    """Read the tables of a file.

    Raises
    ------
    InputError
        If the file is damaged, truncated or too large.
    """
    nptdms = library("nptdms", path)
    _whole(path)
    try:
        with _strict(nptdms), nptdms.TdmsFile.open(str(path)) as file:
            size = sum(8 * len(channel) for group in file.groups() for channel in group.channels())
            within(size, path, "measurement")
            said = dict(
                key_and_text(str(key), str(value)) for key, value in file.properties.items()
            )
            tables = [_table(path, group, said) for group in file.groups()]
    except InputError:
        raise
    except Exception as error:  # npTDMS raises whatever it meets in a damaged file
        raise damaged(path, "TDMS", error) from None
    return [table for table in tables if table.columns]


@contextmanager
def _strict(nptdms: Any) -> Iterator[None]:
    """Turn log messages of npTDMS into errors, such as cropped data or an omitted scale.

    Text of older programs that is not UTF-8 is accepted.
    """

    def refuse(record: logging.LogRecord) -> bool:
        if record.name != nptdms.types.__name__:
            raise ValueError(record.getMessage())
        return False

    loggers = list(nptdms.log.log_manager.loggers.values())
    for logger in loggers:
        logger.addFilter(refuse)
    try:
        yield
    finally:
        for logger in loggers:
            logger.removeFilter(refuse)


def _whole(path: Path) -> None:
    """Check that the file ends where its last segment ends."""
    at, size = 0, path.stat().st_size
    with path.open("rb") as file:
        while at < size:
            file.seek(at)
            head = file.read(_LEAD)
            if head[:4] != b"TDSm"[: len(head)]:
                return  # damaged, or another format: npTDMS says so
            if len(head) == _LEAD:
                at += _LEAD + int(struct.unpack_from("<Q", head, 12)[0])
            if len(head) < _LEAD or at > size:
                raise InputError(
                    f"measurement: {str(path)!r} ends within a segment, so it is incomplete; copy "
                    "or export the file again"
                )


def _table(path: Path, group: Any, said: dict[str, str]) -> Columns:
    """Return the channels of a group."""
    channels = group.channels()
    begun = [c.properties[_STARTED] for c in channels if _STARTED in c.properties]
    first = min((np.datetime64(at) for at in begun), default=None)
    columns: list[ChannelColumn] = []
    beside = dict(key_and_text(str(key), str(value)) for key, value in group.properties.items())
    for channel in channels:
        bare, unit = parted(channel.name)
        about = stated(channel.properties)
        if channel.properties.get(_SCALES, 0) > len(channel.properties):
            raise ValueError(f"{_SCALES} = {channel.properties[_SCALES]}")  # npTDMS counts to it
        values = np.asarray(channel[:])
        if values.dtype.kind not in "fiubc":
            values = values.astype(str)
        elif values.dtype.kind != "c":
            values = about.holes(values.astype(float))
        start = about.start
        if about.step is not None and first is not None and _STARTED in channel.properties:
            start += (np.datetime64(channel.properties[_STARTED]) - first) / np.timedelta64(1, "s")
        columns.append(described(bare, values, about._replace(start=start), unit))
        beside |= {key: text for key, text in about.others.items() if kind_of(key)[0]}
    own = {**said, **beside, "group": group.name}
    return Columns(str(path), tuple(columns), own)
