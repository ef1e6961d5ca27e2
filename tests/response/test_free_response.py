"""Free flight swept backward: the closed form where there is one, folds from above elsewhere."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact.response.free_response import largest_flight, resonance, swept_flight

SHAKEN = vi.Harmonic(0.3, 0.2)


def test_a_vanishing_cubic_is_a_linear_isolator() -> None:
    rig = vi.Oscillator(1.0, vi.PolynomialIsolator(1.0, 0.2, 1e-12))
    frequencies = np.linspace(0.08, 0.3, 12)
    excursions = swept_flight(vi.Rig(rig, SHAKEN), frequencies, np.full(12, 0.3))
    b = math.tau * frequencies
    gain = 1.0 / np.hypot(1.0 - b**2, 0.2 * b)
    np.testing.assert_allclose(excursions[0], 0.6 * gain, rtol=1e-7)
    np.testing.assert_allclose(excursions[1], 0.6 * gain * np.hypot(1.0, 0.2 * b), rtol=1e-7)
    swing, _ = largest_flight(vi.Rig(rig, SHAKEN))
    peak = 0.6 / (0.2 * math.sqrt(1.0 - 0.2**2 / 4.0))
    assert swing == pytest.approx(peak, rel=1e-4)
    assert swing <= peak * (1.0 + 1e-7)


def test_a_softening_fold_is_swept_from_above() -> None:
    """Backward, a softening resonance is climbed to its top, below the natural frequency."""
    rig = vi.Oscillator(1.0, vi.PolynomialIsolator(1.0, 0.1, -0.02), vi.Bumper(10.0, 0.0, 9.0))
    frequencies = np.linspace(0.1, 0.2, 41)
    excursions = swept_flight(vi.Rig(rig, vi.Harmonic(0.2, 0.2)), frequencies, np.full(41, 0.2))
    top = frequencies[np.nanargmax(excursions[0])]
    assert top < 0.155 < 1.0 / math.tau
    swing, acceleration = largest_flight(vi.Rig(rig, vi.Harmonic(0.2, 0.2)))
    assert swing >= np.nanmax(excursions[0]) * (1.0 - 1e-6)
    assert acceleration > 0.0


@pytest.mark.parametrize(
    ("damping", "cubic", "amplitude", "reach"),
    [(0.02, 0.3, 0.3, (0.15, 0.3)), (2e-5, 0.1, 1e-3, (0.155, 0.17))],
)
def test_a_jump_stands_at_the_fold_of_the_branch(damping, cubic, amplitude, reach) -> None:
    """Backward, a hardening resonance is largest where the motion jumps up."""
    rig = vi.Oscillator(1.0, vi.PolynomialIsolator(1.0, damping, cubic))
    branch = vi.branch(vi.Rig(rig, vi.Harmonic(amplitude, reach[1])), vary={"frequency": reach})
    (fold,) = branch["bifurcation_value"].values
    jump = resonance(vi.Rig(rig, vi.Harmonic(amplitude, 0.2)))
    assert jump == pytest.approx(fold, abs=1e-6 * rig.natural_frequency)


def test_what_friction_holds_does_not_fly() -> None:
    rig = vi.Oscillator(1.0, vi.FrictionIsolator(1.0, 0.1, 5.0))
    assert np.isnan(largest_flight(vi.Rig(rig, SHAKEN))).all()


def test_a_narrow_peak_between_the_samples_of_a_sweep_is_found() -> None:
    """ξ = 1e-4: a motion settles in 50,000 cycles, and the peak is 2e-4 of its frequency wide."""
    damping = 2e-4
    rig = vi.Oscillator(1.0, vi.PolynomialIsolator(1.0, damping, 1e-18))
    swing, acceleration = largest_flight(vi.Rig(rig, SHAKEN))
    xi = 0.5 * damping
    peak = 0.6 / (2.0 * xi * math.sqrt(1.0 - xi**2))
    assert swing == pytest.approx(peak, rel=1e-5)
    assert acceleration == pytest.approx(peak * math.hypot(1.0, 2.0 * xi), rel=1e-5)


@pytest.mark.parametrize(
    "isolator",
    [
        vi.FrictionIsolator(1.0, 0.005, 0.2),
        *sample([vi.BilinearIsolator(2.0, 1.0, 0.3, 0.02)], []),
        vi.PolynomialIsolator(1.0, 0.02, 0.3),
        *sample([vi.Isolator(1.0, 0.05, damping_exponent=3.0)], []),
    ],
)
def test_no_sweep_reaches_beyond_the_largest_free_flight(isolator: vi.IsolatorLaw) -> None:
    rig = vi.Oscillator(1.0, isolator)
    largest, _ = largest_flight(vi.Rig(rig, SHAKEN))
    about = rig.natural_frequency * np.linspace(0.6, 1.4, 400)
    swept = swept_flight(vi.Rig(rig, SHAKEN), about, np.full(len(about), SHAKEN.amplitude))
    assert largest >= np.nanmax(swept[0]) * (1.0 - 1e-7)
    assert largest <= np.nanmax(swept[0]) * 1.02


def test_what_settles_slowly_is_found_without_the_wait() -> None:
    """A damping of |v|³ fades with the motion: from rest it takes longer than any patience."""
    rig = vi.Oscillator(1.0, vi.Isolator(6.0, 0.03, damping_exponent=3.0))
    shaken = vi.Harmonic(1.0, 0.3)
    frequency = 4.0 * rig.natural_frequency
    excursions = swept_flight(vi.Rig(rig, shaken), np.array([frequency]), np.array([1.0]))
    orbit = vi.orbit(vi.Rig(rig, shaken.replace(frequency=frequency)))
    expected = float(orbit["displacement_max"] - orbit["displacement_min"])
    assert excursions[0, 0] == pytest.approx(expected, rel=1e-9)
