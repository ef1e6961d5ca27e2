"""Detect the format of a record file from its content, and read one of its components."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from vibroimpact.errors import InputError, in_one_line
from vibroimpact.records import (
    columns,
    cosmos,
    csmip,
    csmnc,
    cwb,
    esm,
    geonet,
    knet,
    lvm,
    nsmn,
    peer,
    seismic,
    smc,
    unam,
)
from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.plausibility import of_last_line
from vibroimpact.tables.decimal_mark import Decimal
from vibroimpact.tables.file import File

FORMATS: tuple[Format, ...] = (
    seismic.MINISEED,
    seismic.SAC,
    geonet.FORMAT,
    cosmos.FORMAT,
    csmip.FORMAT,
    csmip.RENADIC,
    smc.FORMAT,
    knet.FORMAT,
    knet.CSV,
    cwb.FORMAT,
    nsmn.FORMAT,
    csmnc.FORMAT,
    unam.FORMAT,
    esm.FORMAT,
    lvm.FORMAT,
    peer.FORMAT,
    columns.FORMAT,
)
"""Formats in the order in which they are tried. The last one, columns, accepts any file."""


class Component(NamedTuple):
    """A component of a file."""

    format: str
    channel: Channel
    others: tuple[str, ...]
    """Names of all components of the file."""


def read_channel(
    path: Path | str, component: str | int | None = None, decimal: Decimal | None = None
) -> Component:
    """Read one component of a file.

    Parameters
    ----------
    path
        The file, which may be compressed with gzip.
    component
        Name of the component in the file, such as ``"90"``, ``"Up"`` or ``"HNE"``, or its number,
        starting from 1. Default: the only component of the file.
    decimal
        Decimal mark of the numbers, if the file is a text table. Default: detected from the table.

    Raises
    ------
    InputError
        If the file cannot be read. Also if it has several components, and none of them is chosen.
    """
    file = File(path, decimal)
    form = next(form for form in FORMATS if form.recognises(file))
    channels = form.read(file)
    last = tuple(of_last_line(file))
    channels = [_cleaned(one)._replace(notes=one.notes + last) for one in channels]
    names = tuple(channel.component for channel in channels)
    if component is None and len(channels) == 1:
        return Component(form.name, _undamaged(file, channels[0]), names)
    if len(set(names)) < len(names):  # of several stations
        names = tuple(f"{one.station} {one.component}".strip() for one in channels)
        channels = [
            one._replace(also=(*one.also, name)) for one, name in zip(channels, names, strict=True)
        ]
    listed = ", ".join(f"{name!r}" for name in names)
    numbered = f"pass {listed}, or a number from 1 to {len(names)}"
    if component is None:
        raise InputError(
            f"component: missing, but {file.path!r} has {len(channels)} components; {numbered}"
        )
    wanted = in_one_line(str(component))
    chosen = [channel for channel in channels if channel.called(wanted)]
    if not chosen and wanted.isdecimal() and 1 <= int(wanted) <= len(channels):
        chosen = [channels[int(wanted) - 1]]
    if len(chosen) != 1:
        how = "is not a component" if not chosen else f"matches {len(chosen)} components"
        raise InputError(f"component: {component!r} {how} of {file.path!r}; {numbered}")
    return Component(form.name, _undamaged(file, chosen[0]), names)


def _undamaged(file: File, channel: Channel) -> Channel:
    """Return a channel that can be used."""
    if channel.damage:
        raise InputError(f"record: {file.path!r}, {channel.damage}")
    return channel


def _cleaned(channel: Channel) -> Channel:
    """A channel whose names and units are each one line, without control characters."""
    return channel._replace(
        station=in_one_line(channel.station),
        component=in_one_line(channel.component),
        also=tuple(map(in_one_line, channel.also)),
        unit=channel.unit and in_one_line(channel.unit),
        others=tuple(map(in_one_line, channel.others)),
    )
