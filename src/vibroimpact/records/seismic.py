"""SAC and miniSEED files, which are read by obspy if it is installed.

Neither format states the unit of its values. A miniSEED file contains the values of a digitiser. A
SAC file states a quantity. According to the manual its unit is based on nm, but this is not usual.
"""

from __future__ import annotations

import io
import struct
import warnings
from typing import Any

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.records.channel import Channel, Format
from vibroimpact.tables.file import File

_VERSION = slice(304, 308)
"""Place of the version of a SAC file, which is 6, or 7 for the newest files."""
_HEAD = 48
"""Number of bytes of the header of a miniSEED record."""
_GAP = 1.5
"""Number of steps between two parts from which on obspy inserts samples."""
_KINDS = {6: "displacements", 7: "velocities", 50: "volts"}
"""Quantities in SAC files that are not accelerations."""


def is_sac(file: File) -> bool:
    """Return whether a file has the version number of SAC, in either byte order."""
    version = file.data[_VERSION]
    return len(file.data) > 632 and any(struct.unpack(f"{o}i", version)[0] in (6, 7) for o in "<>")


def is_miniseed(file: File) -> bool:
    """Return whether a file starts with the header of a miniSEED record."""
    head = file.data[:8]
    numbered = head[:6].replace(b" ", b"0").isdigit() and head[6:7] in (b"D", b"R", b"Q", b"M")
    # Six blanks and an R begin many a text, which has no zeros.
    binary = len(file.data) >= 48 and b"\0" in file.data[:64]
    return binary and (numbered or head[:3] == b"MS\x03")


def _read(file: File, kind: str) -> list[Channel]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of obspy about itself
            import obspy
    except ImportError:
        raise InputError(
            f"record: {file.path!r} is a {kind} file, which requires obspy; install obspy "
            "with: pip install obspy"
        ) from None
    try:
        with warnings.catch_warnings():
            # What is left out of a miniSEED file is only warned of.
            warnings.simplefilter("error" if kind == "MSEED" else "ignore")
            stream: Any = obspy.read(io.BytesIO(file.data), format=kind)
            if kind == "MSEED":
                _whole(file)
            return [_channel(file, trace) for trace in _merged(file, stream)]
    except InputError:
        raise
    except Exception as error:  # obspy raises whatever it meets in a damaged file
        why = " ".join(str(error).split())
        raise InputError(
            f"record: {file.path!r} is a damaged {kind} file ({why}); pass an undamaged copy"
        ) from None


def _whole(file: File) -> None:
    """Refuse a miniSEED file that ends within a record."""
    from obspy.io.mseed.util import get_record_information

    at, size = 0, len(file.data)
    while size - at >= _HEAD:
        if file.data[at : at + 3] == b"MS\x03":
            extra, payload = struct.unpack_from("<HI", file.data, at + 34)
            length = 40 + file.data[at + 33] + extra + payload
        else:
            length = int(get_record_information(io.BytesIO(file.data), at)["record_length"])
        at += length
        if at > size or length < _HEAD:
            raise InputError(
                f"record: {file.path!r} is incomplete: it ends within a miniSEED record of "
                f"{length} bytes; pass a complete file"
            )


def _merged(file: File, stream: Any) -> Any:
    """Return traces of one channel as one; they have no gaps, and agree where they overlap."""
    for trace in [one for one in stream if not len(one.data)]:
        stream.remove(trace)
    if not len(stream):
        raise InputError(f"record: {file.path!r} has no samples; pass at least two samples")
    ends: dict[str, Any] = {}
    for trace in sorted(stream, key=lambda one: one.stats.starttime):
        about, end = trace.stats, ends.get(trace.id)
        # A gap is refused before parts are joined: one damaged date makes it billions of samples.
        if end is not None and (about.starttime - end) * about.sampling_rate >= _GAP:
            raise _scale_of_sac(file, trace, "gaps")
        ends[trace.id] = about.endtime if end is None else max(end, about.endtime)
    stream.merge()
    for trace in stream:
        if np.ma.is_masked(trace.data):
            raise _scale_of_sac(file, trace, "overlapping parts that differ")
    return stream


def _scale_of_sac(file: File, trace: Any, what: str) -> InputError:
    return InputError(f"record: {file.path!r}: {trace.id} has {what}; pass a record without {what}")


def _scale(file: File, trace: Any) -> tuple[float, tuple[str, ...]]:
    """The scale of a SAC file, and what is noted of it.

    SAC itself does not use its SCALE; files of ground motions have that of the digitiser beside
    values that are scaled already, so that it is used of counts, which are whole numbers.

    Raises
    ------
    InputError
        If it cannot be used.
    """
    scale = float(trace.stats.sac.get("scale", 1.0)) if "sac" in trace.stats else 1.0
    if scale == 1.0:
        return 1.0, ()
    if (trace.data != np.round(trace.data)).any():
        return 1.0, (
            f"the scale in the header, {scale:g}, is not used because the values are not counts",
        )
    if not 0.0 < abs(scale) < np.inf:
        raise InputError(
            f"record: {file.path!r}: its header has the scale {scale:g}; set SCALE to a finite "
            "number other than 0"
        )
    return scale, (f"the values were multiplied by {scale:g}, the scale in the header",)


def _channel(file: File, trace: Any) -> Channel:
    about = trace.stats
    unclear = _KINDS.get(about.sac.get("idep", 0), "") if "sac" in about else ""
    scale, notes = _scale(file, trace)
    if np.issubdtype(trace.data.dtype, np.integer):
        unclear = "counts"
    return Channel(
        np.asarray(trace.data, dtype=np.float64) * scale,
        float(about.delta) if about.delta > 0.0 else None,
        None,
        ".".join(part for part in (about.network, about.station, about.location) if part),
        about.channel,
        (trace.id,),
        "header",
        unclear=unclear,
        notes=notes,
    )


SAC = Format("SAC", is_sac, lambda file: _read(file, "SAC"))
MINISEED = Format("miniSEED", is_miniseed, lambda file: _read(file, "MSEED"))
