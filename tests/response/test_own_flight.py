"""Free flight swept backward: the closed form where there is one, folds from above elsewhere."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.response.own_flight import largest_flight, swept_flight

SHAKEN = vi.Harmonic(0.3, 0.2)


def test_a_vanishing_cubic_is_a_linear_isolator() -> None:
    rig = vi.Oscillator(1.0, vi.PolynomialIsolator(1.0, 0.2, 1e-12))
    frequencies = np.linspace(0.08, 0.3, 12)
    found = swept_flight(rig, SHAKEN, frequencies, np.full(12, 0.3))
    b = math.tau * frequencies
    gain = 1.0 / np.hypot(1.0 - b**2, 0.2 * b)
    np.testing.assert_allclose(found[0], 0.6 * gain, rtol=1e-7)
    np.testing.assert_allclose(found[1], 0.6 * gain * np.hypot(1.0, 0.2 * b), rtol=1e-7)
    swing, _ = largest_flight(rig, SHAKEN)
    peak = 0.6 / (0.2 * math.sqrt(1.0 - 0.2**2 / 4.0))
    assert swing == pytest.approx(peak, rel=1e-4)
    assert swing <= peak * (1.0 + 1e-7)


def test_a_softening_fold_is_swept_from_above() -> None:
    """Backward, a softening resonance is climbed to its top, below the natural frequency."""
    rig = vi.Oscillator(1.0, vi.PolynomialIsolator(1.0, 0.1, -0.02), vi.Bumper(10.0, 0.0, 9.0))
    frequencies = np.linspace(0.1, 0.2, 41)
    found = swept_flight(rig, vi.Harmonic(0.2, 0.2), frequencies, np.full(41, 0.2))
    top = frequencies[np.nanargmax(found[0])]
    assert top < 0.155 < 1.0 / math.tau
    swing, acceleration = largest_flight(rig, vi.Harmonic(0.2, 0.2))
    assert swing >= np.nanmax(found[0]) * (1.0 - 1e-6)
    assert acceleration > 0.0


def test_what_friction_holds_does_not_fly() -> None:
    rig = vi.Oscillator(1.0, vi.FrictionIsolator(1.0, 0.1, 5.0))
    assert np.isnan(largest_flight(rig, SHAKEN)).all()
