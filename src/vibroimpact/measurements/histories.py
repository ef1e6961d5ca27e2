"""Time histories from a table, with the variable names of `vibroimpact.simulate`."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.errors import InputError
from vibroimpact.measurements.columns import Columns
from vibroimpact.measurements.curves import Known
from vibroimpact.measurements.names import HISTORIES
from vibroimpact.tables.times import spacing


def history(table: Columns, known: Known, notes: list[str], facts: list[str]) -> xr.Dataset:
    """Return the channels over time, in SI units.

    Parameters
    ----------
    notes
        List to which notes on assumptions, and on what was left out, are added.
    facts
        List to which facts are added: what the file does not contain, and what was computed
        instead.

    Returns
    -------
    xarray.Dataset
        The dim is ``time`` (s, rising). ``displacement`` is relative to the base. If the
        displacements of mass and base were measured, it is their difference.

    Raises
    ------
    InputError
        If no channel is left, or if two samples have the same time.
    """
    time = next(values for meaning, values in known.values() if meaning.variable == "time")
    usable = np.isfinite(time)
    channels = {
        meaning.variable: values
        for meaning, values in known.values()
        if meaning.variable in HISTORIES and np.isfinite(values[usable]).any()
    }
    if not channels:
        named = [
            table.columns[i].name for i, (meaning, _) in known.items() if meaning.variable != "time"
        ]
        raise InputError(
            f"measurement: {table.path!r}: no row has both a time and a value of "
            f"{' or '.join(map(repr, named))}; pass a file with at least one such row"
        )
    if (lost := int((~usable).sum())) > 0:
        notes.append(f"rows without a time were left out: {lost}")
    order = np.flatnonzero(usable)[np.argsort(time[usable], kind="stable")]
    if (np.diff(order) < 0).any():
        notes.append("the times were not in order, and were sorted")
    twice = np.flatnonzero(np.diff(time[order]) == 0.0)
    if len(twice):
        raise InputError(
            f"measurement: {table.path!r}, {table.row(int(order[twice[0] + 1]))}: the time "
            f"{time[order[twice[0]]]:g} s occurs twice; correct the time, or remove one of the rows"
        )
    data = xr.Dataset(coords={"time": time[order]})
    for name, values in channels.items():
        data[name] = ("time", values[order])
        if (gaps := int(np.isnan(values[order]).sum())) > 0:
            facts.append(f"{name} is missing at {gaps} of {len(order)} times")
    if "displacement" not in data and {"mass_displacement", "base_displacement"} <= set(data):
        data["displacement"] = data["mass_displacement"] - data["base_displacement"]
        facts.append("displacement is the displacement of the mass minus that of the base")
    elif "mass_displacement" in data and "displacement" not in data:
        notes.append(
            "the displacement of the mass is absolute, so it cannot be used without the "
            "displacement of the base"
        )
    step = np.diff(data["time"].values)
    if len(step) > 1 and not spacing(data["time"].values).is_exact:
        notes.append(
            f"times are unevenly spaced, in steps of {step.min():.4g} to {step.max():.4g} s"
        )
    return data
