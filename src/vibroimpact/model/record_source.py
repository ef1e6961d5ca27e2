"""The source of a record, and values of the caller that replace statements in its file."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError, in_one_line
from vibroimpact.model.argument_types import MOST_SAMPLES
from vibroimpact.model.quantities import ACCELERATION, LENGTH, TIME, Quantity
from vibroimpact.model.units import one_of, pretty, to_si
from vibroimpact.model.written_units import NONE
from vibroimpact.records.channel import Channel
from vibroimpact.records.plausibility import of_end, of_times
from vibroimpact.records.read import read_channel
from vibroimpact.tables.decimal_mark import Decimal
from vibroimpact.tables.statements import StatedPeak

_SAME_PEAK = 0.01
"""Largest relative difference of a stated peak and the peak of the values."""


class About(NamedTuple):
    """The source of a record, and its changes."""

    source: str = ""
    """The file."""
    format: str = ""
    station: str = ""
    component: str = ""
    unit: str = ""
    """Unit of the values in the file."""
    notes: tuple[str, ...] = ()
    """Assumptions, doubts and changes, in their order."""


class _MissingError(InputError):
    """What a file does not state has to be passed."""


def read_values(
    path: Path | str,
    component: str | int | None,
    unit: str | None,
    step: float | str | None,
    decimal: Decimal | None,
) -> tuple[NDArray[np.float64], float, Quantity, About]:
    """Return the values in a file (SI units), their step (s), their quantity and their source.

    Raises
    ------
    InputError
        As in `vibroimpact.Record.read`.
    """
    form, channel, _ = read_channel(path, component, decimal)
    notes = list(channel.notes)
    try:
        spacing = _spacing(channel, step, str(path), notes)
    except _MissingError as error:
        try:
            _unit(channel, unit, str(path), [])
        except _MissingError:
            both = f'{error}; unit: missing, too; pass that of the values: unit="g" (--unit g)'
            raise InputError(both) from None
        raise
    taken, factor, quantity = _unit(channel, unit, str(path), notes)
    _check_peaks(channel, taken, factor, quantity, str(path))
    if channel.times is not None:
        channel = channel._replace(values=_interpolated(channel, spacing, notes))
    notes += of_end(channel.values)
    notes += of_times(spacing, len(channel.values))
    about = About(
        in_one_line(str(path)), form, channel.station, channel.component, taken, tuple(notes)
    )
    return channel.values * factor, spacing, quantity, about


def _spacing(channel: Channel, step: Any, path: str, notes: list[str]) -> float:
    """The time between samples (s): the argument, or the value in the file."""
    if step is None:
        if channel.no_step:
            raise InputError(f"record: {path!r}, {channel.no_step}")
        if channel.step is None:
            none = f"has no step in {channel.where}" if channel.where else "has no times"
            raise _MissingError(
                f"step: missing, but {path!r} {none}; pass the time between two samples, such as "
                'step="10 ms" (--step 10ms)'
            )
        return channel.step
    spacing = to_si(step, TIME, "step", above=0.0)
    if channel.times is not None:
        return spacing
    if channel.step is None and channel.no_step:
        notes.append(f"the step {pretty(spacing, TIME)} replaces the uneven times in the file")
    elif channel.step is not None and not math.isclose(channel.step, spacing, rel_tol=1e-9):
        notes.append(
            f"the step {pretty(spacing, TIME)} replaces the step in the file, {channel.step:g} s"
        )
    return spacing


def _interpolated(channel: Channel, step: float, notes: list[str]) -> NDArray[np.float64]:
    """Values at uneven times, interpolated at equal steps from the first time on."""
    times = channel.times
    assert times is not None
    lasts = float(times[-1] - times[0])
    if not step <= lasts < step * MOST_SAMPLES:
        raise InputError(
            f"step: {pretty(step, TIME)} is outside [{pretty(lasts / MOST_SAMPLES, TIME)}, "
            f"{pretty(lasts, TIME)}], which the times of the record allow; pass a step in this "
            "range"
        )
    even = times[0] + step * np.arange(int(lasts / step * (1.0 + 1e-12)) + 1)
    values: NDArray[np.float64] = np.interp(even, times, channel.values)
    peak = float(np.abs(channel.values).max())
    lost = 100.0 * (1.0 - float(np.abs(values).max()) / peak) if peak else 0.0
    notes.append(
        f"the {len(times)} values at uneven times were interpolated at steps of "
        f"{pretty(step, TIME)}, which lowers the peak by {lost:.2f} %"
    )
    return values


def _unit(
    channel: Channel, unit: str | None, path: str, notes: list[str]
) -> tuple[str, float, Quantity]:
    """The unit of the values, its size in SI units and its quantity."""
    taken = unit or channel.unit
    if taken is None:
        if channel.unclear:
            raise _MissingError(
                f"unit: missing, and the values in {path!r} are {channel.unclear}, not "
                "accelerations; pass the unit of displacements, or convert velocities to "
                'accelerations; for counts or volts, pass unit="m/s^2" (--unit) and the factor to '
                "Record.scaled (--scale)"
            )
        taken = _of_peak(channel)
        if taken is None:
            largest = float(np.abs(channel.values).max())
            raise _MissingError(
                f"unit: missing, because {path!r} states no unit of its values, the largest of "
                f'which is {largest:g}; pass it, such as unit="g" (--unit g)'
            )
    if unit == NONE:  # of a dimensionless record, whatever the file states
        if channel.unit is not None:
            notes.append(
                f"the values are read as numbers without the unit in the file, {channel.unit}"
            )
        return NONE, 1.0, ACCELERATION
    try:
        factor, quantity = one_of(f"1 {taken}", [ACCELERATION, LENGTH], "unit")
    except InputError as error:
        if unit is not None:
            raise
        advice = "if the file states a wrong unit, pass the right one as unit= (--unit)"
        raise InputError(f"record: {path!r}: {error}; {advice}") from None
    for other in () if unit else channel.others:
        if not _same(other, factor, quantity):
            of = f" of {channel.component!r}" if channel.component else ""
            raise InputError(
                f"record: {path!r} states two units{of}, {taken!r} and {other!r}; pass the unit of "
                "the values as unit= (--unit)"
            )
    if unit is None and channel.of_name and not _same(channel.of_name, factor, quantity):
        notes.append(
            f"the values are read in {taken}, although the name of the column states "
            f"{channel.of_name}"
        )
    if unit is not None and channel.unit is not None and not _same(channel.unit, factor, quantity):
        notes.append(f"the unit {unit} replaces the unit in the file, {channel.unit}")
    return taken, factor, quantity


def _of_peak(channel: Channel) -> str | None:
    """The unit of a stated peak, if the values have this peak and nothing else states a unit."""
    for peak in channel.peaks:
        if peak.unit and any(_near(peak, size, 1.0) for size in _peaks(channel.values)):
            return peak.unit
    return None


def _check_peaks(channel: Channel, unit: str, factor: float, quantity: Quantity, path: str) -> None:
    """Compare the stated peaks with the values, as they are and without their mean.

    They may differ by rounding.
    """
    if quantity is not ACCELERATION or unit == NONE:
        return
    for peak in channel.peaks:
        size = to_si(f"1 {peak.unit}", quantity, "unit") / factor if peak.unit else 1.0
        sizes = _peaks(channel.values)
        if not any(_near(peak, one, size) for one in sizes):
            also = ", or pass the unit of the values as unit= (--unit)" if peak.unit else ""
            raise InputError(
                f"record: {path!r}, line {peak.line + 1}: {peak.text!r} states a peak of "
                f"{peak.value * size:.6g} {unit}, but the largest value is {sizes[0]:.6g} {unit}; "
                f"correct this line{also}"
            )


def _peaks(values: NDArray[np.float64]) -> list[float]:
    """What may be stated as the peak, the largest absolute value first.

    Some headers state the largest and the least value; networks subtract the mean.
    """
    peaks = [float(np.abs(values).max())]
    for part in (values, values - values.mean()):
        peaks += [float(part.max()), float(-part.min())]
    return peaks


def _near(peak: StatedPeak, size: float, factor: float) -> bool:
    """Whether a stated peak is a peak of values, in whose unit its own unit has this size."""
    stated = peak.value * factor
    return abs(stated - size) <= max(_SAME_PEAK * stated, 1.01 * peak.digit * factor)


def _same(unit: str, factor: float, quantity: Quantity) -> bool:
    """Whether a unit of a file has this size."""
    try:
        return to_si(f"1 {unit}", quantity, "unit") == factor
    except InputError:
        return False
