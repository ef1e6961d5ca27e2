"""A record as a dataset, with where it comes from and what was done to it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import xarray as xr

from vibroimpact.datasets.description import describe
from vibroimpact.model import Record


def accelerogram(record: Record) -> xr.Dataset:
    """Return a record with dim ``time`` (s) and ``base_acceleration`` (m/s²)."""
    data = xr.Dataset(
        {"base_acceleration": ("time", record.acceleration)}, {"time": ("time", record.time)}
    )
    parameters = {"record": record_parameters(record)}
    return describe(data, "vibroimpact.Record", parameters, record.about.notes)


def record_notes(records: Mapping[str, Record]) -> list[str]:
    """What was noted of several records, a line each, for a dataset's attributes."""
    return [f"{name}: {note}" for name, one in records.items() for note in one.about.notes]


def record_parameters(record: Record) -> dict[str, Any]:
    """A record as plain values, for a dataset's attributes, what is not known left out."""
    about = {name: value for name, value in record.about._asdict().items() if value}
    samples = len(record.acceleration)
    return {"samples": samples, "step": record.step, "peak": record.peak, **about}
