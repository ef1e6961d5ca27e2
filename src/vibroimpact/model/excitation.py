"""The motion of the base that drives the oscillator."""

from __future__ import annotations

import math
from typing import Annotated

from vibroimpact.model.units import ACCELERATION, ANGLE, FREQUENCY
from vibroimpact.model.validation import Accepts, Model, constructor


class Harmonic(Model):
    """Harmonic base acceleration, A_t(t) = A sin(2π f t + φ).

    Parameters
    ----------
    amplitude
        Peak acceleration A in m/s², at least 0; or text such as ``"0.05 g"``, where g is
        gravity.
    frequency
        f in Hz, greater than 0; or text such as ``"2.5 Hz"``. An angle over a time, such as
        ``"15.7 rad/s"``, is converted to cycles per second.
    phase
        φ in rad; or text such as ``"90 deg"``.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    amplitude: Annotated[float, Accepts(ACCELERATION, minimum=0.0)]
    frequency: Annotated[float, Accepts(FREQUENCY, above=0.0)]
    phase: Annotated[float, Accepts(ANGLE)] = 0.0

    @constructor
    def __init__(
        self, amplitude: float | str, frequency: float | str, phase: float | str = 0.0
    ) -> None:
        super().__init__(amplitude=amplitude, frequency=frequency, phase=phase)

    @property
    def angular_frequency(self) -> float:
        """Forcing angular frequency, ω = 2π f, in rad/s."""
        return math.tau * self.frequency

    @property
    def period(self) -> float:
        """Forcing period, 1/f, in s."""
        return 1.0 / self.frequency
