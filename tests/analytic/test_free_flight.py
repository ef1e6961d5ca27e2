"""Free flight: the amplification curve, decaying vibration, and resonance without damping."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import mp, mpf
from numpy.typing import NDArray

import vibroimpact as vi
from samples import sample

MASS, STIFFNESS, AMPLITUDE = 550.0, 26.29e3, 0.49
RATIOS = [0.02, 0.1, 0.5, 0.9, 0.99, 1.0, 1.01, 1.1, 1.5, 2.0, 5.0]


def rig(damping_ratio: float) -> vi.Oscillator:
    damping = 2.0 * damping_ratio * math.sqrt(STIFFNESS * MASS)
    return vi.Oscillator(MASS, vi.Isolator(STIFFNESS, damping))


def excursions(oscillator: vi.Oscillator, frequency: float) -> tuple[float, float]:
    """Of displacement and absolute acceleration, from the complex amplitude."""
    with mp.workdps(40):
        turning = mp.mpc(0, 2 * mp.pi * mpf(frequency))
        k, c = mpf(oscillator.isolator.stiffness), mpf(oscillator.isolator.damping)
        u = -MASS * mpf(AMPLITUDE) / (k + c * turning + MASS * turning**2)
        return float(2 * abs(u)), float(2 * abs(u * turning**2 + mpf(AMPLITUDE)))


def vibration(
    oscillator: vi.Oscillator, shaken: vi.Harmonic, start: vi.State, cycles: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Displacement and velocity after so many forcing cycles, in fifty digits."""
    with mp.workdps(50):
        k, c = (mpf(x) / MASS for x in (oscillator.isolator.stiffness, oscillator.isolator.damping))
        omega, phase = 2 * mp.pi * mpf(shaken.frequency), mpf(shaken.phase)
        swing = -mpf(shaken.amplitude) / mp.mpc(k - omega**2, c * omega)
        root = mp.sqrt(mp.mpc(c**2 / 4 - k))
        roots = [-c / 2 + root, -c / 2 - root]

        def steady(t: mpf) -> tuple[mpf, mpf]:
            turning = swing * mp.expj(omega * t + phase)
            return mp.im(turning), omega * mp.re(turning)

        began = mpf(start.displacement), mpf(start.velocity)
        du, dv = (a - b for a, b in zip(began, steady(mpf(0)), strict=True))
        weights = [(dv - roots[1] * du) / (2 * root), (roots[0] * du - dv) / (2 * root)]
        rows = []
        for cycle in cycles.tolist():
            t = cycle / mpf(shaken.frequency)
            modes = [w * mp.exp(r * t) for w, r in zip(weights, roots, strict=True)]
            here = steady(t)
            free = mp.re(modes[0] + modes[1]), mp.re(modes[0] * roots[0] + modes[1] * roots[1])
            rows.append([float(here[0] + free[0]), float(here[1] + free[1])])
        return np.array(rows).T


def largest(oscillator: vi.Oscillator, which: int) -> float:
    """The largest excursion at any frequency, closed in on by ever finer grids."""
    low, high = 1e-9, 3.0
    for _ in range(12):
        ratios = np.linspace(low, high, 201)
        values = [excursions(oscillator, r * oscillator.natural_frequency)[which] for r in ratios]
        top = int(np.argmax(values))
        low, high = ratios[max(top - 1, 0)], ratios[min(top + 1, 200)]
    return float(max(values))


@pytest.mark.parametrize("damping_ratio", sample([0.02, 0.05, 0.15, 1.0, 4.0], [0.02, 4.0]))
def test_amplification_curve(damping_ratio: float) -> None:
    """Measured: 4e-14 at worst; the closed form that η is based on, 5e-16."""
    oscillator = rig(damping_ratio)
    grid = [r * oscillator.natural_frequency for r in RATIOS]
    data = vi.sweep(vi.Rig(oscillator, AMPLITUDE), grid, tolerance=1e-14)
    assert (data["motion"] == "periodic").all()
    assert (data["period"] == 1).all()
    exact = np.array([excursions(oscillator, f) for f in grid]).T
    for i, (kind, eta, curve) in enumerate(
        zip(("displacement", "acceleration"), "da", exact, strict=True)
    ):
        free = data[f"free_{kind}_excursion"].values
        np.testing.assert_allclose(free, curve, rtol=2e-15)
        for direction in data["direction"]:
            swept = data.sel(direction=direction)
            np.testing.assert_allclose(swept[f"{kind}_excursion"], curve, rtol=1e-12)
            np.testing.assert_allclose(
                swept[f"eta_{eta}"], curve / largest(oscillator, i), rtol=1e-12
            )
    np.testing.assert_allclose(data["eccentricity"] / data["displacement_excursion"], 0, atol=1e-12)


def test_the_default_tolerance_is_good_enough_for_a_damped_rig() -> None:
    oscillator = rig(0.15)
    grid = [r * oscillator.natural_frequency for r in RATIOS]
    data = vi.sweep(vi.Rig(oscillator, AMPLITUDE), grid)
    curve = [excursions(oscillator, f)[0] for f in grid]
    for direction in data["direction"]:
        swept = data["displacement_excursion"].sel(direction=direction)
        np.testing.assert_allclose(swept, curve, rtol=1e-12)


@pytest.mark.parametrize(("damping_ratio", "ratio"), [(0.005, 5.0), (0.02, 20.0)])
def test_a_slow_transient_is_waited_for(damping_ratio: float, ratio: float) -> None:
    oscillator = rig(damping_ratio)
    frequency = ratio * oscillator.natural_frequency
    data = vi.sweep(vi.Rig(oscillator, AMPLITUDE), [frequency], tolerance=1e-14, max_cycles=50_000)
    assert (data["period"] == 1).all()
    curve, _ = excursions(oscillator, frequency)
    np.testing.assert_allclose(data["displacement_excursion"], curve, rtol=1e-12)


def error(oscillator: vi.Oscillator, shaken: vi.Harmonic, start: vi.State, cycles: int) -> float:
    """Largest error of displacement or velocity over a run, as a share of their sizes in it."""
    data = vi.simulate(vi.Rig(oscillator, shaken), cycles, start, samples=7)
    exact = vibration(oscillator, shaken, start, data["cycle"].values)
    states = np.stack([data["displacement"], data["velocity"]])
    return float((np.abs(states - exact).max(axis=1) / np.abs(exact).max(axis=1)).max())


@pytest.mark.parametrize("damping_ratio", [0.0, 0.02, 0.9999, 1.0, 1.0001, 3.0, 40.0])
def test_decaying_vibration(damping_ratio: float) -> None:
    oscillator = rig(damping_ratio)
    shaken = vi.Harmonic(0.0, 0.37 * oscillator.natural_frequency)
    assert error(oscillator, shaken, vi.State(0.01, -0.3), 20) < 1e-12


@pytest.mark.parametrize("damping_ratio", [0.0, 0.001, 0.15, 2.0])
@pytest.mark.parametrize("ratio", [1.0 + 1e-8, 1.0 - 1e-4, 0.9, 0.1, 7.3])
def test_transient(ratio: float, damping_ratio: float) -> None:
    """Over 100 cycles; 1e-8 off undamped resonance the swing goes on growing, to 225 A/ω0².

    Measured: 1.4e-13 at worst, but 1.4e-12 over the 1000 undamped natural periods of ratio 0.1.
    """
    oscillator = rig(damping_ratio)
    shaken = vi.Harmonic(AMPLITUDE, ratio * oscillator.natural_frequency, 0.8)
    assert error(oscillator, shaken, vi.State(), 100) < 3e-12


@pytest.mark.parametrize("scale", [1.0, 1.0 + 2.0**-52, 1.0 - 2.0**-53])
def test_undamped_resonance_is_refused(scale: float) -> None:
    free = rig(0.0)
    frequency = free.natural_frequency * scale
    message = r"^frequency: .* grows without bound; .* add isolator damping$"
    with pytest.raises(vi.InputError, match=message):
        vi.simulate(vi.Rig(free, vi.Harmonic(AMPLITUDE, frequency)), 10)
    for oscillator in (free, free.replace(right=vi.Bumper(1e5, 1e3, 0.01))):
        # With bumpers the motion is bounded, but not the reference of η.
        with pytest.raises(vi.InputError, match=r"^frequencies\[1\]: .* grows without bound; "):
            vi.sweep(vi.Rig(oscillator, AMPLITUDE), [0.5 * frequency, frequency])


def test_a_bumper_bounds_undamped_resonance() -> None:
    oscillator = rig(0.0).replace(right=vi.Bumper(1e5, 1e3, 0.01))
    shaken = vi.Harmonic(AMPLITUDE, oscillator.natural_frequency)
    data = vi.simulate(vi.Rig(oscillator, shaken), 1000)
    assert np.abs(data["displacement"]).max() < 0.1
