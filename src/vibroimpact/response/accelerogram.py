"""A record as a dataset, with where it comes from and what was done to it."""

from __future__ import annotations

from typing import Any

import xarray as xr

from vibroimpact.model import Record
from vibroimpact.response.variables import describe


def accelerogram(record: Record) -> xr.Dataset:
    """Return a record with dim ``time`` (s) and ``base_acceleration`` (m/s²)."""
    data = xr.Dataset(
        {"base_acceleration": ("time", record.acceleration)}, {"time": ("time", record.time)}
    )
    return describe(data, "vibroimpact.Record", {"record": record_parameters(record)})


def record_parameters(record: Record) -> dict[str, Any]:
    """A record as plain values, for a dataset's attributes, what is not known left out."""
    about = {name: value for name, value in record.about._asdict().items() if value}
    samples = len(record.acceleration)
    return {"samples": samples, "step": record.step, "peak": record.peak, **about}
