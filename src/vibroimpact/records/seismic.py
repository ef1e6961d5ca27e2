"""SAC and miniSEED, read by obspy where it is installed.

Neither says what its values are in: miniSEED holds whatever a digitiser gave, SAC has a kind of
quantity, whose units by its manual are nm, which nobody follows.
"""

from __future__ import annotations

import io
import struct
import warnings
from typing import Any

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.file import File

_VERSION = slice(304, 308)
"""Of a SAC file: 6, or 7 of the newest."""
_KINDS = {6: "displacements", 7: "velocities", 50: "volts"}
"""SAC's kinds of quantities that are no acceleration."""


def is_sac(file: File) -> bool:
    """Whether the version of the header is one of SAC, in either order of bytes."""
    version = file.data[_VERSION]
    return len(file.data) > 632 and any(struct.unpack(f"{o}i", version)[0] in (6, 7) for o in "<>")


def is_miniseed(file: File) -> bool:
    """Whether it begins with the header of a record of data."""
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
            f"record: {file.path!r} is a {kind} file, and obspy, which reads it, is not "
            "installed; pip install 'vibroimpact[seismic]' installs it"
        ) from None
    try:
        with warnings.catch_warnings():
            # What is left out of a miniSEED file is only warned of.
            warnings.simplefilter("error" if kind == "MSEED" else "ignore")
            stream: Any = obspy.read(io.BytesIO(file.data), format=kind)
            stream.merge()
            return [_channel(file, trace) for trace in stream]
    except InputError:
        raise
    except Exception as error:  # obspy raises whatever it meets in a damaged file
        why = " ".join(str(error).split())
        raise InputError(f"record: {file.path!r} is a damaged {kind} file ({why})") from None


def _channel(file: File, trace: Any) -> Channel:
    if np.ma.is_masked(trace.data):
        raise InputError(
            f"record: {file.path!r}: {trace.id} has gaps; a record without gaps is accepted"
        )
    about = trace.stats
    unclear = _KINDS.get(about.sac.get("idep", 0), "") if "sac" in about else ""
    if np.issubdtype(trace.data.dtype, np.integer):
        unclear = "counts"
    return Channel(
        np.asarray(trace.data, dtype=np.float64),
        float(about.delta) if about.delta > 0.0 else None,
        None,
        ".".join(part for part in (about.network, about.station, about.location) if part),
        about.channel,
        (trace.id,),
        "header",
        unclear=unclear,
    )


SAC = Format("SAC", is_sac, lambda file: _read(file, "SAC"))
MINISEED = Format("miniSEED", is_miniseed, lambda file: _read(file, "MSEED"))
