"""Times of channels for which the file states only a sampling rate or a step."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.measurements.columns import ChannelColumn, Columns, of_one_length
from vibroimpact.measurements.names import meaning
from vibroimpact.model.quantities import FREQUENCY, TIME
from vibroimpact.model.units import to_si
from vibroimpact.tables.statements import same, sampling_of


def timed(table: Columns) -> list[Columns]:
    """Return tables with times. If a table has none, they are computed from the sampling rate.

    Channels with another sampling rate are returned as a separate table.

    Raises
    ------
    InputError
        If a rate cannot be read, or if it is not greater than 0.
    """
    axes = {said.variable for c in table.columns if (said := meaning(c.name))}
    if not table.columns or axes & {"time", "frequency"}:
        return [table._replace(columns=of_one_length(table.path, list(table.columns)))]
    entry = _stated(table.said)
    common = entry[1] if entry else None
    groups: dict[tuple[float | None, float], list[ChannelColumn]] = {}
    for column in table.columns:
        words = column.values.dtype.kind == "U"
        step = column.step if column.step is not None or words else common
        groups.setdefault((step, column.start), []).append(column)
    tables = []
    for (step, start), columns in groups.items():
        part = table._replace(columns=of_one_length(table.path, columns))
        if step is not None:
            count = max(len(column.values) for column in columns)
            time = ChannelColumn("time", "s", start + step * np.arange(count))
            part = part._replace(columns=(time, *part.columns))
            own = any(column.step is not None for column in columns)
            if entry and not own:
                note = (
                    f"the times were computed from {entry[0]} = {table.said[entry[0]]}, and start "
                    "at 0 s"
                )
            else:
                note = (
                    f"the times were computed from the step of {step:g} s, and start at {start:g} s"
                )
            part = part._replace(notes=(*part.notes, note))
        if len(groups) > 1:
            name = table.said.get("group", "")
            how = f"{step:g} s from {start:g} s on" if step is not None else "without times"
            part = part._replace(said={**table.said, "group": f"{name} ({how})".strip()})
        tables.append(part)
    return tables


def is_sampling(name: str) -> bool:
    """Return whether a name is the name of a sampling rate or of a sampling step."""
    return sampling_of(name) is not None


def _stated(said: Mapping[str, str]) -> tuple[str, float] | None:
    """Return the name of the sampling rate or step in the file, and the step in seconds."""
    own = {name: text for name, text in said.items() if is_sampling(name)}
    return (next(iter(own)), one_step(own)) if own else None


def one_step(said: Mapping[str, str], unit: str | None = None) -> float:
    """Return the time between two samples (s) from the stated rates and steps.

    Parameters
    ----------
    said
        Rates and steps, by their names in the file.
    unit
        Unit of steps that have no unit. Default: s.

    Raises
    ------
    InputError
        If a value cannot be read or is not greater than 0, or if two values differ.
    """
    steps: dict[str, float] = {}
    for name, text in said.items():
        bare = isinstance(_number(text), float) and not is_rate(name)
        steps[name] = step_of(name, f"{text} {unit}" if bare and unit else text)
    (first, step), *others = steps.items()
    for name, other in others:
        if not same(other, step):
            raise InputError(
                f"{name}: {said[name]!r:.40} and {first} = {said[first]!r:.40} state two "
                f"different time steps; correct or remove {name} or {first}"
            )
    return step


def step_of(name: str, value: str) -> float:
    """Return the time between two samples (s) from a rate or a step.

    Raises
    ------
    InputError
        If the value cannot be read, or if it is not greater than 0.
    """
    if is_rate(name):
        return 1.0 / to_si(_number(value), FREQUENCY, name, above=0.0)
    return to_si(_number(value), TIME, name, above=0.0)


def is_rate(name: str) -> bool:
    """Return whether a name is the name of a sampling rate."""
    return sampling_of(name) == "rate"


def _number(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text
