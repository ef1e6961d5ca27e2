"""Harmonics against dense quadrature and closed forms; windowed lines against known ones."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

import vibroimpact as vi
from reference.linear_phases import phases

QUANTITIES = ("displacement", "velocity", "acceleration")


@cache
def steady(code: str, frequency: float, start: vi.State | None = None):
    case = vi.laboratory.case(code)
    return vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, frequency, 0.3)), start)


def lines(data, name):
    return data[f"{name}_amplitude"].values * np.exp(1j * data[f"{name}_phase"].values)


@pytest.mark.parametrize(
    ("code", "frequency"), [("B2-G1-A3", 2.0), ("B3-10mm-A3", 1.12), ("B3-10mm-A3", 0.5)]
)
def test_harmonics_against_quadrature(code, frequency):
    """Of the motion by matrix exponentials, phase by phase, at Gauss-Legendre nodes."""
    motion = steady(code, frequency=frequency)
    spectrum = vi.fourier_spectrum(motion, 20)
    case = vi.laboratory.case(code)
    rig, shaken = case.oscillator, vi.Harmonic(case.amplitude, frequency, 0.3)
    omega = shaken.angular_frequency
    expected = {name: np.zeros(21, dtype=complex) for name in QUANTITIES}
    time = 0.0
    for phase in phases(rig, shaken, motion):
        # Nodes repeat on equal pieces; their times follow from the weights' own abscissae.
        pieces = len(phase.weights) // 16
        nodes = (np.polynomial.legendre.leggauss(16)[0] + 1) / 2
        at = time + phase.length / pieces * (np.arange(pieces)[:, None] + nodes).ravel()
        bumper = {0: None, 1: rig.right, -1: rig.left}[phase.contact]
        deformation = phase.motion.right if phase.contact == 1 else phase.motion.left
        a = -(rig.isolator.stiffness * phase.motion.u + rig.isolator.damping * phase.motion.v)
        if bumper:
            a = a - (bumper.stiffness * deformation + bumper.damping * phase.motion.v)
        values = (phase.motion.u, phase.motion.v, a / rig.mass)
        kernel = phase.weights * np.exp(-1j * omega * np.arange(21)[:, None] * at)
        for name, value in zip(QUANTITIES, values, strict=True):
            expected[name] += kernel @ value * 2.0 / shaken.period
        time += phase.length
    for name in QUANTITIES:
        expected[name][0] /= 2.0
        size = np.abs(expected[name]).max()
        np.testing.assert_allclose(lines(spectrum, name), expected[name], atol=1e-10 * size, rtol=0)
    assert "exact" in spectrum.attrs["method"]


def test_the_sum_of_the_lines_is_the_motion():
    motion = steady("B2-G1-A3", frequency=2.0)
    spectrum = vi.fourier_spectrum(motion, 400)
    phase = 2.0 * np.pi * np.outer(motion["cycle"].values, spectrum["order"].values)
    for name, tolerance in (("displacement", 1e-7), ("velocity", 1e-5)):
        sums = (
            spectrum[f"{name}_amplitude"].values * np.cos(phase + spectrum[f"{name}_phase"].values)
        ).sum(axis=1)
        size = float(np.abs(motion[name]).max())
        np.testing.assert_allclose(sums, motion[name], atol=tolerance * size)


def test_free_flight_has_a_single_line():
    """Amplitudes and phases of the closed form, everything else rounding."""
    rig = vi.laboratory.case("B2-Ginf-A3").oscillator
    shaken = vi.Harmonic(0.5, 1.3, 0.7)
    spectrum = vi.fourier_spectrum(vi.steady(vi.Rig(rig, shaken)), 10)
    omega = shaken.angular_frequency
    k, c = rig.isolator.stiffness / rig.mass, rig.isolator.damping / rig.mass
    # −A sin(ωt + φ) = Re(i A exp(i(ωt + φ)))
    u = 1j * 0.5 * np.exp(0.7j) / (k - omega**2 + 1j * omega * c)
    expected = {
        "displacement": u,
        "velocity": 1j * omega * u,
        "acceleration": -(k + 1j * c * omega) * u,
    }
    for name, value in expected.items():
        z = lines(spectrum, name)
        assert abs(z[1] - value) < 1e-13 * abs(value)
        assert np.abs(np.delete(z, 1)).max() < 1e-13 * abs(value)


def test_a_line_at_an_undamped_resonance_of_a_phase():
    """Order 2 falls on the undamped isolator's own frequency: 0/0 in the closed form."""
    bumper = vi.Bumper(4.0, 0.5, 0.4)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), bumper, bumper.replace(gap=0.6))
    frequency = 0.5 / (2.0 * math.pi)
    motion = vi.steady(vi.Rig(rig, vi.Harmonic(1.0, frequency)))
    assert int(motion["period"]) == 1
    spectrum = vi.fourier_spectrum(motion, 4)
    # Dense samples of one period: the trapezoidal rule, its error bounded by u‴'s jumps.
    dense = vi.simulate(
        vi.Rig(rig, vi.Harmonic(1.0, frequency)), 1, motion["final_state"], samples=4096
    )
    fft = np.fft.rfft(dense["displacement"].values[:-1]) * 2.0 / 4096
    np.testing.assert_allclose(np.abs(fft[1:5]), spectrum["displacement_amplitude"][1:], rtol=1e-6)


def test_subharmonic_orders():
    """A motion of period 5 has lines at fifths of the excitation's frequency."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), vi.Bumper(29.0, 0.0, 1.26), None)
    omega = 0.81
    shaken = vi.Harmonic(0.7 * omega**2, omega / (2.0 * math.pi), math.pi)
    motion = vi.steady(vi.Rig(rig, shaken))
    assert int(motion["period"]) == 5
    spectrum = vi.fourier_spectrum(motion, 3)
    np.testing.assert_allclose(spectrum["order"], np.arange(16) / 5)
    assert float(spectrum["displacement_amplitude"][1]) > 1e-3
    np.testing.assert_allclose(spectrum["line_frequency"], spectrum["order"] * shaken.frequency)


def test_windowed_lines():
    """A record that is not periodic: two lines of known height, within a Hann window's reach."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), None, None)
    shaken = vi.Harmonic(1.0, math.sqrt(2.0) / (2.0 * math.pi))
    motion = vi.simulate(vi.Rig(rig, shaken), 400, vi.State(0.0, 0.0), samples=32)
    spectrum = vi.fourier_spectrum(motion, 3)
    assert "Hann" in spectrum.attrs["method"]
    # u = a sin ωt + b sin t: a = −1/(1 − 2) = 1, b = −√2.
    forced = spectrum.sel(order=1.0)
    own = spectrum["displacement_amplitude"].sel(order=slice(0.6, 0.8))
    assert float(forced["displacement_amplitude"]) == pytest.approx(1.0, rel=1e-3)
    assert float(own.max()) == pytest.approx(math.sqrt(2.0), rel=0.16)  # scalloping, at most 15 %
    assert float(own.order[own.values.argmax()]) == pytest.approx(1.0 / math.sqrt(2.0), abs=2.5e-3)
    rest = spectrum["displacement_amplitude"].where(
        (abs(spectrum.order - 1.0) > 0.03) & (abs(spectrum.order - 0.7071) > 0.03)
    )
    assert float(rest.max()) < 2e-3


@pytest.mark.parametrize("highest", [0.0, -1.0, math.inf, "a"])
def test_refused(highest):
    with pytest.raises(vi.InputError, match="highest"):
        vi.fourier_spectrum(steady("B2-G1-A3", frequency=2.0), highest)


def test_too_short_a_record():
    case = vi.laboratory.case("B2-G1-A3")
    short = vi.simulate(vi.Rig(case.oscillator, vi.Harmonic(0.5, 2.0)), 0.3)
    with pytest.raises(vi.InputError, match="at least one whole cycle"):
        vi.fourier_spectrum(short)
    with pytest.raises(vi.InputError, match="highest"):
        vi.fourier_spectrum(steady("B2-G1-A3", frequency=2.0), 1e9)
