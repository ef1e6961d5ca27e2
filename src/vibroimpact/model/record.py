"""A measured motion of the base: equally spaced samples of acceleration, linear between them."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact.errors import InputError, errors_at, shown, warn_of_input
from vibroimpact.model.argument_types import MOST_SAMPLES
from vibroimpact.model.html_table import table
from vibroimpact.model.quantities import ACCELERATION, DIMENSIONLESS, LENGTH, TIME, Quantity
from vibroimpact.model.record_source import About, read_values
from vibroimpact.model.units import pretty, to_si
from vibroimpact.model.written_units import NONE
from vibroimpact.records.plausibility import of_size
from vibroimpact.tables.decimal_mark import checked

_RESOLVED = 1.5
"""Largest ratio of the peaks of the second derivative from all and from every second sample."""


_OFF = 0.05
"""Share of the peak above which a remaining mean is reported."""
_DEGREES = {"mean": 0, "line": 1}

LEAST_STEP, MOST_STEP = 1e-12, 1e9
"""Time between two samples, in s."""


class Record:
    """A measured base acceleration A_t, linear between its samples and zero after the last one.

    Parameters
    ----------
    acceleration
        At least 2 samples of the acceleration in m/s², or a pint quantity.
    step
        Time between samples in s, greater than 0; or a string such as ``"10 ms"``.

    Raises
    ------
    InputError
        If a sample is not finite, if there are fewer than 2 samples, or if the step is invalid.
    """

    __slots__ = ("_about", "_acceleration", "_step")

    def __init__(self, acceleration: ArrayLike, step: float | str) -> None:
        self._acceleration = _samples(acceleration, ACCELERATION, "acceleration")
        self._step = to_si(step, TIME, "step", minimum=LEAST_STEP, maximum=MOST_STEP)
        self._about = About()

    @classmethod
    def read(
        cls,
        path: Path | str,
        component: str | int | None = None,
        *,
        unit: str | None = None,
        step: float | str | None = None,
        station: str | None = None,
        label: str | None = None,
        decimal: str | None = None,
    ) -> Record:
        """Read a record from a file. The format is detected from the content of the file.

        The accepted formats are PEER AT2, COSMOS V0, V1 and V2, CSMIP V1 and V2, USGS SMC, GeoNet
        V1A and V2A, K-NET and KiK-net (ASCII and CSV), ESM, CWB, CSMNC, NSMN, RENADIC, UNAM, and
        columns of numbers. SAC and miniSEED are accepted if obspy is installed. A file may be
        compressed with gzip. The samples are not filtered, cut or shifted. If something is assumed
        or doubtful, such as a peak of 30 g, an `InputWarning` is issued. It is also listed in
        ``about.notes``.

        Parameters
        ----------
        path
            The file.
        component
            Component that is read. It is required if the file has several components. It is the
            name in the file, such as ``"90"``, ``"Up"`` or ``"HNE"``, or the number of the
            component, starting from 1.
        unit
            Unit of the values, such as ``"g"``. It replaces the unit in the file. If it is a unit
            of length, such as ``"mm"``, the values are displacements of the base, and the
            acceleration is computed from them (see `from_displacement`). ``"none"`` reads the
            numbers as they are, for a rig without units. Default: the unit in the file. It is
            required if the file states none.
        step
            Time between samples (s, or a string with a unit). It replaces the step or the times in
            the file. The values of a file of digitised film, whose times are uneven, are
            interpolated at this step.
        station, label
            Names of the station and of the component. They replace the names in the file.
        decimal
            Decimal mark of the numbers, ``"."`` or ``","``, if the file is a text table. Default:
            detected from the table. If the table is ambiguous, the mark is required.

        Raises
        ------
        InputError
            If the file cannot be read; the message then states the line. If the file has several
            components and none is chosen. If the values do not form a record.
        """
        values, spacing, quantity, about = read_values(
            path, component, unit, step, checked(decimal)
        )
        made = cls if quantity is ACCELERATION else cls.from_displacement
        with errors_at(f"record: {str(path)!r}: "):
            record = made(values, spacing)
        notes = list(about.notes)
        if quantity is LENGTH:
            notes.append("the values are displacements, which were differentiated twice")
        mean = float(record.acceleration.mean())
        if abs(mean) > _OFF * record.peak:
            share = 100.0 * abs(mean) / record.peak
            note = (
                f"the mean, {pretty(mean, ACCELERATION)} or {share:.3g} % of the peak, was not "
                "subtracted"
            )
            notes.append(note)
        if about.unit != NONE:
            notes += of_size(record.peak, about.unit if quantity is ACCELERATION else "")
        record._about = about._replace(
            station=station or about.station, component=label or about.component, notes=tuple(notes)
        )
        warn_of_input(f"record {str(path)!r}", notes)
        return record

    @classmethod
    def from_displacement(cls, displacement: ArrayLike, step: float | str) -> Record:
        """Return the record of a base whose displacement was measured.

        The displacement is interpolated by a cubic spline (with de Boor's "not-a-knot" ends). The
        acceleration of this spline is linear between the samples. It is accurate to the second
        order of the step. At the first sample the base has the velocity of the spline. A motion
        "from rest" starts at rest relative to the base.

        Parameters
        ----------
        displacement
            At least 8 samples of the displacement in m, or a pint quantity.
        step
            Time between samples in s, greater than 0; or a string such as ``"10 ms"``.

        Raises
        ------
        InputError
            If a value is invalid, or if the displacement cannot be differentiated twice. This is
            the case if it jumps or is very rough: with all samples, the peak acceleration is larger
            by more than half than with every second sample.
        """
        from scipy.interpolate import CubicSpline

        values = _samples(displacement, LENGTH, "displacement", 8)
        spacing = to_si(step, TIME, "step", minimum=LEAST_STEP, maximum=MOST_STEP)

        def differentiated(every: int) -> NDArray[np.float64]:
            some = values[::every]
            times = np.arange(len(some)) * (spacing * every)
            return np.asarray(CubicSpline(times, some)(times, 2))

        fine, coarse = differentiated(1), differentiated(2)
        peaks = [float(np.abs(one).max()) for one in (fine, coarse)]
        if peaks[0] > _RESOLVED * peaks[1]:
            worst = int(np.abs(fine).argmax())
            raise InputError(
                f"displacement[{worst}]: the displacement jumps or is too rough at this sample to "
                f"be differentiated twice: the peak acceleration is {peaks[0]:.3g} m/s² with all "
                f"samples and {peaks[1]:.3g} m/s² with every other sample; smooth the "
                "displacement, or pass the acceleration itself"
            )
        return cls(fine, spacing)

    @property
    def acceleration(self) -> NDArray[np.float64]:
        """Samples of the base acceleration (m/s²)."""
        return self._acceleration

    @property
    def step(self) -> float:
        """Time between two samples (s)."""
        return self._step

    @property
    def about(self) -> About:
        """Source of the record (file, format, station, component, unit), and its changes."""
        return self._about

    @property
    def duration(self) -> float:
        """Time from the first to the last sample (s)."""
        return (len(self._acceleration) - 1) * self._step

    @property
    def time(self) -> NDArray[np.float64]:
        """Times of the samples (s)."""
        return np.asarray(np.arange(len(self._acceleration)) * self._step, dtype=np.float64)

    @property
    def peak(self) -> float:
        """Largest absolute acceleration (m/s²)."""
        return float(np.abs(self._acceleration).max())

    @property
    def peak_time(self) -> float:
        """Time at which the absolute acceleration first reaches its peak (s)."""
        return float(np.abs(self._acceleration).argmax()) * self._step

    def scaled(self, scale: float | str = 1.0, *, peak: float | str | None = None) -> Record:
        """Return the record multiplied by a factor, or scaled to a peak.

        Parameters
        ----------
        scale
            Factor by which the record is multiplied. It must not be 0.
        peak
            Peak of the scaled record in m/s², or a string such as ``"0.3 g"``. Pass it instead of
            ``scale``.

        Raises
        ------
        InputError
            If a value is invalid. Also if a peak is passed and all samples of the record are 0.
        """
        factor = to_si(scale, DIMENSIONLESS, "scale")
        if peak is not None:
            if factor != 1.0:
                raise InputError(
                    f"peak: {shown(peak)} is given together with scale = {scale}; remove one of "
                    "the two"
                )
            wanted = to_si(peak, ACCELERATION, "peak", above=0.0)
            if self.peak == 0.0:
                raise InputError(
                    f"peak: {shown(peak)} cannot be reached, because all samples of the record are "
                    "0; use a record with other samples"
                )
            factor = wanted / self.peak
        if factor == 0.0:
            raise InputError(f"scale: {scale}; use a number other than 0")
        return self._changed(self._acceleration * factor, f"scaled by {factor:.6g}")

    def cut(self, start: float | str = 0.0, end: float | str | None = None) -> Record:
        """Return the part of the record between two times. The new record starts at time 0.

        Parameters
        ----------
        start, end
            Start and end of the part, in s or as text with a unit. They are rounded to the nearest
            samples. Default: the start and the end of the record.

        Raises
        ------
        InputError
            If the times are outside the record, or if fewer than 2 samples are left.
        """
        last = len(self._acceleration) - 1
        whole = (last + 0.5) * self._step
        begins = to_si(start, TIME, "start", minimum=0.0, maximum=whole)
        ends = self.duration if end is None else to_si(end, TIME, "end", above=0.0, maximum=whole)
        first, behind = round(begins / self._step), min(round(ends / self._step), last) + 1
        if behind - first < 2:
            raise InputError(
                f"end: {ends:g} s leaves fewer than 2 samples after the start, {begins:g} s; move "
                f"the end or the start, so that the part lasts at least one step, {self._step:g} s"
            )
        note = f"cut to the part from {first * self._step:g} to {(behind - 1) * self._step:g} s"
        return self._changed(self._acceleration[first:behind], note)

    def levelled(self, baseline: Literal["mean", "line"] = "mean") -> Record:
        """Return the record minus its mean, or minus the straight line that fits it best.

        Raises
        ------
        InputError
            If ``baseline`` is not ``"mean"`` or ``"line"``.
        """
        degree = _DEGREES.get(baseline)
        if degree is None:
            raise InputError(f"baseline: {baseline!r}; use 'mean' or 'line'")
        time = np.linspace(-1.0, 1.0, len(self._acceleration))
        fitted = np.polynomial.polynomial.polyfit(time, self._acceleration, degree)
        line = np.polynomial.polynomial.polyval(time, fitted)
        note = f"{baseline} subtracted: {line[0]:.6g} m/s²"
        if degree:
            note += f" at the beginning and {line[-1]:.6g} m/s² at the end"
        return self._changed(self._acceleration - line, note)

    def _changed(self, values: NDArray[np.float64], note: str) -> Record:
        """Return a copy with other samples; the change is noted."""
        made = Record(values, self._step)
        made._about = self._about._replace(notes=(*self._about.notes, note))
        return made

    def at(self, time: ArrayLike) -> NDArray[np.float64]:
        """Return the base acceleration (m/s²) at any times (s). It is 0 outside the record."""
        return np.asarray(
            np.interp(np.asarray(time), self.time, self._acceleration, left=0.0, right=0.0)
        )

    def __eq__(self, other: object) -> bool:
        """Return whether both records have the same samples and the same step."""
        if not isinstance(other, Record):
            return NotImplemented
        return self._step == other._step and np.array_equal(self._acceleration, other._acceleration)

    def __hash__(self) -> int:
        """By value."""
        return hash((self._step, self._acceleration.tobytes()))

    def __repr__(self) -> str:
        return f"<{self}>"

    def __str__(self) -> str:
        rows = ", ".join(f"{name}={text}" for name, text in self.rows())
        return f"Record({rows})"

    def _repr_html_(self) -> str:
        return table("Record", self.rows())

    def rows(self) -> list[tuple[str, str]]:
        """Return pairs of name and text that describe the record, and its source if it was read."""
        about = self._about
        return [
            *(
                (name, text)
                for name in ("source", "format", "station", "component", "unit")
                if (text := getattr(about, name))
            ),
            ("samples", str(len(self._acceleration))),
            ("step", pretty(self._step, TIME)),
            ("peak", pretty(self.peak, ACCELERATION)),
            *([("notes", "; ".join(about.notes))] if about.notes else []),
        ]


def _samples(values: Any, quantity: Quantity, field: str, least: int = 2) -> NDArray[np.float64]:
    """Return read-only numbers in SI units, which must be finite, and at least so many."""
    if hasattr(values, "magnitude"):
        unit = to_si(1.0 * values.units, quantity, field)
        values = np.asarray(values.magnitude, dtype=float) * unit
    if hasattr(values, "__len__") and getattr(values, "ndim", 1) > 0 and len(values) > MOST_SAMPLES:
        raise InputError(f"{field}: {len(values)} samples; pass at most {MOST_SAMPLES}")
    try:
        array = np.array(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError(
            f"{field}: {shown(values)} is not a list of numbers; pass the samples in "
            f"{quantity.symbol} as a list or an array"
        ) from None
    if array.ndim != 1 or len(array) < least:
        raise InputError(
            f"{field}: {f'{len(array)} given' if array.ndim == 1 else f'shape {array.shape}'}; "
            f"pass one sequence of at least {least} samples in {quantity.symbol}"
        )
    for i in np.flatnonzero(~np.isfinite(array))[:1]:
        raise InputError(f"{field}[{i}]: {array[i]} is not finite; replace it by a finite number")
    array.setflags(write=False)
    return array
