"""A measured motion of the base: an acceleration at equal times, with straight lines between."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact.errors import InputError
from vibroimpact.model.quantities import ACCELERATION, LENGTH, TIME, Quantity
from vibroimpact.model.table import table
from vibroimpact.model.units import pretty, shown, to_si

_RESOLVED = 1.5
"""By how much the peak of a second derivative may grow when the samples left out are used."""


class Record:
    """A measured base acceleration A_t, linear between its samples and zero behind them.

    Parameters
    ----------
    acceleration
        The samples in m/s², at least 2; or a pint quantity.
    step
        Time between them in s, greater than 0; or text such as ``"10 ms"``.

    Raises
    ------
    InputError
        If a sample is no finite number, there are fewer than 2, or the step cannot be used.
    """

    __slots__ = ("_acceleration", "_step")

    def __init__(self, acceleration: ArrayLike, step: float | str) -> None:
        self._acceleration = _samples(acceleration, ACCELERATION, "acceleration")
        self._step = to_si(step, TIME, "step", above=0.0)

    @classmethod
    def from_displacement(cls, displacement: ArrayLike, step: float | str) -> Record:
        """Return the record of a base whose displacement was measured.

        The displacement is taken as the cubic spline through the samples (with the ends of de
        Boor's "not-a-knot"): the smoothest curve whose acceleration is linear between them. Its
        second derivative is right to the second order of the step. The base's velocity at the
        first sample is that of the spline; a motion from rest is at rest relative to the base.

        Parameters
        ----------
        displacement
            The samples in m, at least 8; or a pint quantity.
        step
            Time between them in s, greater than 0; or text such as ``"10 ms"``.

        Raises
        ------
        InputError
            If it cannot be used, or cannot be differentiated twice: if it jumps, or is so rough
            that the peak acceleration grows by more than half when all samples
            are used instead of every other one.
        """
        from scipy.interpolate import CubicSpline

        values = _samples(displacement, LENGTH, "displacement", 8)
        spacing = to_si(step, TIME, "step", above=0.0)

        def differentiated(every: int) -> NDArray[np.float64]:
            some = values[::every]
            times = np.arange(len(some)) * (spacing * every)
            return np.asarray(CubicSpline(times, some)(times, 2))

        fine, coarse = differentiated(1), differentiated(2)
        peaks = [float(np.abs(one).max()) for one in (fine, coarse)]
        if peaks[0] > _RESOLVED * peaks[1]:
            worst = int(np.abs(fine).argmax())
            raise InputError(
                f"displacement[{worst}]: it jumps or is too rough there to be differentiated "
                f"twice, for the peak acceleration is {peaks[0]:.3g} m/s² with all samples and "
                f"{peaks[1]:.3g} m/s² with every other one; a smooth displacement is accepted, or "
                "the acceleration itself"
            )
        return cls(fine, spacing)

    @property
    def acceleration(self) -> NDArray[np.float64]:
        """The samples of the base acceleration, m/s²."""
        return self._acceleration

    @property
    def step(self) -> float:
        """Time between two samples, s."""
        return self._step

    @property
    def duration(self) -> float:
        """From the first to the last sample, s."""
        return (len(self._acceleration) - 1) * self._step

    @property
    def time(self) -> NDArray[np.float64]:
        """Times of the samples, s."""
        return np.asarray(np.arange(len(self._acceleration)) * self._step, dtype=np.float64)

    @property
    def peak(self) -> float:
        """The largest size of the acceleration, m/s²."""
        return float(np.abs(self._acceleration).max())

    def at(self, time: ArrayLike) -> NDArray[np.float64]:
        """Base acceleration (m/s²) at any times (s); zero before and behind the record."""
        return np.asarray(
            np.interp(np.asarray(time), self.time, self._acceleration, left=0.0, right=0.0)
        )

    def __eq__(self, other: object) -> bool:
        """Whether all samples and the step are the same."""
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
        """What it is, in words."""
        return [
            ("samples", str(len(self._acceleration))),
            ("step", pretty(self._step, TIME)),
            ("peak", pretty(self.peak, ACCELERATION)),
        ]


def _samples(values: Any, quantity: Quantity, field: str, least: int = 2) -> NDArray[np.float64]:
    """Numbers in SI units that nobody can change.

    Raises
    ------
    InputError
        If one is not finite, or there are too few.
    """
    if hasattr(values, "magnitude"):
        unit = to_si(1.0 * values.units, quantity, field)
        values = np.asarray(values.magnitude, dtype=float) * unit
    try:
        found = np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(
            f"{field}: {shown(values)} is not a list of numbers; samples in "
            f"{quantity.symbol} are accepted"
        ) from None
    if found.ndim != 1 or len(found) < least:
        raise InputError(
            f"{field}: {len(found) if found.ndim == 1 else f'shape {found.shape}'}; at least "
            f"{least} samples in {quantity.symbol}, one after the other, are accepted"
        )
    for i in np.flatnonzero(~np.isfinite(found))[:1]:
        raise InputError(f"{field}[{i}]: {found[i]} is not finite; finite samples are accepted")
    found.setflags(write=False)
    return found
