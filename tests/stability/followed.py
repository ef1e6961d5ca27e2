"""Rigs and diagrams that several tests of branches look at."""

from __future__ import annotations

from functools import cache

import numpy as np

import vibroimpact as vi


@cache
def diagram(code: str, low: float = 0.3, high: float = 4.0, phase: float = 0.0):
    case = vi.laboratory.case(code)
    return vi.resonance_diagram(
        vi.Rig(case.oscillator, case.amplitude), {"frequency": (low, high)}, phase=phase
    )


def values(data, kind: str) -> np.ndarray:
    return np.sort(data["bifurcation_value"].values[data["bifurcation_kind"].values == kind])


def near(data, kind: str, value: float, tolerance: float) -> bool:
    return bool(np.any(np.abs(values(data, kind) - value) <= tolerance))


def remembering() -> vi.Oscillator:
    """Bumpers that relax more slowly than they are struck."""
    bumper = vi.Bumper(0.01, 0.2, 0.6)
    return vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), bumper, bumper)


def between_stops(damping: float) -> vi.Oscillator:
    stop = vi.Bumper(10.0, damping, 1.0)
    return vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), stop, stop)
