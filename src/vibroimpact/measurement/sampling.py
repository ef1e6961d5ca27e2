"""Time of channels that say only how fast they were sampled."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np

from vibroimpact.measurement.columns import Column, Columns
from vibroimpact.measurement.names import meaning
from vibroimpact.model.quantities import FREQUENCY, TIME
from vibroimpact.model.units import to_si

_RATES = {"fs", "samplerate", "samplingrate", "samplefrequency", "samplingfrequency", "fsample"}
_STEPS = {"dt", "ts", "deltat", "timestep", "samplinginterval", "sampleinterval",
          "samplingperiod", "timeincrement", "increment", "wfincrement"}  # fmt: skip


def timed(table: Columns, notes: list[str]) -> Columns:
    """A table with a time, made of the sampling rate that stands beside it where it has none.

    Raises
    ------
    InputError
        If that rate cannot be read, or is not above 0.
    """
    axes = {said.variable for c in table.columns if (said := meaning(c.name))}
    if not table.columns or axes & {"time", "frequency"}:
        return table
    found = _step(table.said)
    if found is None:
        return table
    name, step = found
    notes.append(f"the time is made of {name} = {table.said[name]}, from 0 s on")
    time = step * np.arange(len(table.columns[0].values))
    return table._replace(columns=(Column("time", "s", time), *table.columns))


def is_sampling(name: str) -> bool:
    """Whether a name is that of a sampling rate, or of its step."""
    return re.sub(r"[^a-z]", "", name.lower()) in _RATES | _STEPS


def _step(said: Mapping[str, str]) -> tuple[str, float] | None:
    """What a file calls its sampling, and the seconds between two samples."""
    for name, value in said.items():
        key = re.sub(r"[^a-z]", "", name.lower())
        if key in _RATES:
            return name, 1.0 / to_si(_number(value), FREQUENCY, name, above=0.0)
        if key in _STEPS:
            return name, to_si(_number(value), TIME, name, above=0.0)
    return None


def _number(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text
