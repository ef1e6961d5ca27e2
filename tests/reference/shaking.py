"""What shakes the mass, to fifty digits: sums of sines, and records of straight lines.

Either gives, in a *span* (a forcing period, or the line between two samples), the Taylor series of
the acceleration -A_t that it pushes the mass with, and what a bound on the series needs.

A forcing of several parts enlarges the linear system z' = B z of a phase by a pair for each part,
scaled so that its part of the norm of B is small: 8 A_n / omega_n (sin, cos) adds omega_n / 8 to
the row of the velocity, and omega_n is the norm of its own rows. A line (a, a') with a scale s is
(8 a / s, 8 a' / s^2), which adds s / 8, and s is the norm of its own row.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from mpmath import mp, mpf


class Push(NamedTuple):
    """The push within a step, as the bounds see it."""

    series: list[mpf]
    """Taylor coefficients of -A_t in x = time / step."""
    size: mpf
    """Of the scaled pairs (m/s)."""
    last: mpf
    """Of their last coefficients."""


class Sines:
    """A_t = sum of A_n sin(n (2 pi f t + phase) + phi_n), n = 1, 2, ...; a span is a period."""

    def __init__(
        self,
        amplitudes: Sequence[float | mpf],
        frequency: float,
        phase: float,
        phases: Sequence[float] | None = None,
    ) -> None:
        if not frequency > 0:
            raise ValueError(f"impossible frequency: {frequency} Hz")
        self.omega = 2 * mp.pi * mpf(frequency)
        self.period, self.phase = 1 / mpf(frequency), mpf(phase)
        turned = phases or [0.0] * len(amplitudes)
        self.parts = [
            (n, mpf(size), mpf(angle))
            for n, (size, angle) in enumerate(zip(amplitudes, turned, strict=True), start=1)
            if size
        ] or [(1, mpf(0), mpf(0))]
        self.rate = max(n for n, _, _ in self.parts) * self.omega
        self.weight = sum(n for n, _, _ in self.parts) * self.omega / 8
        self.steepest = sum(abs(size) * n for n, size, _ in self.parts) * self.omega

    def span(self, number: int) -> mpf:
        """How long a span lasts."""
        return self.period

    def value(self, number: int, elapsed: mpf) -> mpf:
        """A_t."""
        angle = self.omega * elapsed + self.phase
        return sum(size * mp.sin(n * angle + turned) for n, size, turned in self.parts)

    def push(self, number: int, elapsed: mpf, step: mpf, order: int, factorial: mpf) -> Push:
        """Of a step from a time in a span."""
        series, whole, last = [mpf(0)] * (order + 1), mpf(0), mpf(0)
        angle = self.omega * elapsed + self.phase
        for n, size, turned in self.parts:
            here, turn = n * angle + turned, n * self.omega * step
            # The sine's from its own recurrence.
            terms = [-size * mp.sin(here), -size * turn * mp.cos(here)]
            for i in range(order - 1):
                terms.append(-(turn**2) * terms[i] / ((i + 1) * (i + 2)))
            series = [one + other for one, other in zip(series, terms, strict=True)]
            part = 8 * abs(size) / (n * self.omega)
            whole, last = whole + part, last + part * turn**order / factorial
        return Push(series, whole, last)


class Lines:
    """A record of A_t, linear between its samples and zero behind them; a span is a step."""

    def __init__(self, samples: Sequence[float], step: float) -> None:
        self.step = mpf(step)
        self.samples = [mpf(one) for one in samples]
        self.rate = 1 / self.step
        self.weight = self.rate / 8
        self.phase = mpf(0)
        self.steepest = max(abs(self._line(n)[1]) for n in range(len(self.samples) - 1))

    def _line(self, number: int) -> tuple[mpf, mpf]:
        if number + 1 >= len(self.samples):
            return mpf(0), mpf(0)
        here, there = self.samples[number : number + 2]
        return here, (there - here) / self.step

    def span(self, number: int) -> mpf:
        """How long a span lasts."""
        return self.step

    def slope(self, number: int) -> mpf:
        """Of A_t."""
        return self._line(number)[1]

    def value(self, number: int, elapsed: mpf) -> mpf:
        """A_t."""
        here, slope = self._line(number)
        return here + slope * elapsed

    def push(self, number: int, elapsed: mpf, step: mpf, order: int, factorial: mpf) -> Push:
        """Of a step from a time in a span."""
        _, slope = self._line(number)
        here = self.value(number, elapsed)
        size = 8 * max(abs(here), abs(here + slope * step)) / self.rate
        return Push(
            [-here, -slope * step, *([mpf(0)] * (order - 1))],
            size + 8 * abs(slope) / self.rate**2,
            mpf(0),
        )


Shaking = Sines | Lines
