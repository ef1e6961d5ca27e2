"""Steady free flight in closed form, and what η is taken over."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact.response.analytic_free_response import (
    check_bounded,
    free_flight_excursions,
    reference_excursions,
)


def rig(ratio: float) -> vi.Oscillator:
    return vi.Oscillator(3.0, vi.Isolator(12.0, 2.0 * ratio * 6.0))


def test_it_is_where_a_simulation_settles():
    one = vi.steady(vi.Rig(rig(0.1), vi.Harmonic(0.7, 0.5)), samples=8)
    excursions = free_flight_excursions(vi.Rig(rig(0.1), vi.Harmonic(0.7, 1.0)), np.array([0.5]))
    assert float(one["displacement_excursion"]) == pytest.approx(excursions[0][0], rel=1e-11)
    assert float(one["acceleration_excursion"]) == pytest.approx(excursions[1][0], rel=1e-11)


@pytest.mark.parametrize("ratio", [1e-3, 0.15, 0.5, 0.70, 0.72, 1.0, 5.0])
def test_the_reference_is_the_largest_at_any_frequency(ratio):
    """Found on a fine grid; from 1/√2 on the displacement's is the limit at low frequencies."""
    natural = rig(ratio).natural_frequency
    near = 1.0 + np.linspace(-5.0, 5.0, 20_001) * min(ratio, 0.1)
    grid = natural * np.concatenate([np.geomspace(1e-6, 20.0, 20_000), near[near > 0.0]])
    most = [
        values.max()
        for values in free_flight_excursions(vi.Rig(rig(ratio), vi.Harmonic(0.7, 1.0)), grid)
    ]
    reference = reference_excursions(vi.Rig(rig(ratio), vi.Harmonic(0.7, 1.0)))
    np.testing.assert_allclose(most, reference, rtol=1e-6)
    assert (np.array(most) <= np.array(reference) * (1 + 1e-12)).all()


def test_an_undamped_isolator_has_no_largest():
    still = vi.Oscillator(1.0, vi.Isolator(4.0, 0.0))
    assert reference_excursions(vi.Rig(still, vi.Harmonic(0.7, 1.0))) == (0.35, 1.4)


def test_unbounded_motions_are_refused():
    free = rig(0.0)
    with pytest.raises(vi.InputError, match=r"frequency: .* grows without bound"):
        check_bounded(vi.Rig(free, vi.Harmonic(1.0, free.natural_frequency)))
    with pytest.raises(vi.InputError, match=r"frequencies\[1\]: .* grows without bound"):
        free_flight_excursions(
            vi.Rig(free, vi.Harmonic(1.0, 1.0)), np.array([0.1, free.natural_frequency])
        )
    check_bounded(vi.Rig(free, vi.Harmonic(1.0, 0.9 * free.natural_frequency)))
    check_bounded(vi.Rig(rig(0.1), vi.Harmonic(1.0, free.natural_frequency)))


SHAKEN = {
    "acceleration": vi.Harmonic(0.7, 1.0),
    "displacement": vi.Harmonic("70 mm", 1.0),
    "force": vi.Harmonic("2.1 N", 1.0),
    "unbalance": vi.Harmonic("0.4 kg m", 1.0),
    "harmonics": vi.Periodic(1.0, (0.7, 0.3, 0.0, 0.2), (0.1, 1.0, 0.0, -2.0)),
    "harmonics of displacement": vi.Periodic(1.0, ("70 mm", "10 mm"), (0.0, 2.0)),
    "harmonics of force": vi.Periodic(1.0, ("2 N", "0 N", "1 N")),
    "harmonics of unbalance": vi.Periodic(1.0, ("0.4 kg m", "0.06 kg m"), (0.0, 2.0)),
}


def swings(one: vi.Oscillator, shaken, frequency: float, count: int) -> tuple[float, float]:
    """Excursions in steady free flight, from samples of a sum of sines."""
    omega = 2.0 * np.pi * frequency
    several = isinstance(shaken, vi.Periodic)
    sizes = shaken.amplitudes if several else (shaken.amplitude,)
    angles = shaken.phases if several else (0.0,)
    theta = 2.0 * np.pi * np.arange(count) / count
    u, a = np.zeros(count), np.zeros(count)
    k, c, m = one.isolator.stiffness, one.isolator.damping, one.mass
    for n, (size, angle) in enumerate(zip(sizes, angles, strict=True), start=1):
        w = n * omega
        wave = np.exp(1j * (n * theta + angle))
        base = {"acceleration": size, "displacement": -size * w**2}.get(shaken.of, 0.0) * wave
        force = {"force": size, "unbalance": size * w**2}.get(shaken.of, 0.0) * wave
        push = force - m * base
        swing = push / (k - m * w**2 + 1j * c * w)
        u += swing.imag
        a += (base - w**2 * swing).imag
    return float(np.ptp(u)), float(np.ptp(a))


@pytest.mark.parametrize("kind", SHAKEN)
@pytest.mark.parametrize("isolator", [(12.0, 1.2), (12.0, 20.0), (0.0, 1.5), (12.0, 0.0)])
def test_excursions_are_those_of_dense_samples(kind, isolator):
    stop = vi.Bumper(1.0, 1.0, 1e3)
    one = vi.Oscillator(3.0, vi.Isolator(*isolator), stop, stop)
    grid = np.array([0.04, 0.17, 0.33, 0.9, 2.0])
    excursions = np.array(free_flight_excursions(vi.Rig(one, SHAKEN[kind]), grid))
    dense = np.array([swings(one, SHAKEN[kind], f, 20_000) for f in grid]).T
    assert (excursions >= dense * (1 - 1e-13)).all()
    np.testing.assert_allclose(excursions, dense, rtol=2e-6)


@pytest.mark.parametrize("kind", SHAKEN)
@pytest.mark.parametrize("ratio", sample([0.02, 0.15, 0.6], [0.15]))
def test_the_reference_is_the_largest_of_any_kind(kind, ratio):
    """Of displacement; of acceleration too, but where what is given grows with the frequency."""
    one, shaken = rig(ratio), SHAKEN[kind]
    grid = one.natural_frequency * np.concatenate(
        [np.linspace(0.1, 3.0, 16_001), np.geomspace(1e-3, 30.0, 500)]
    )
    curves = free_flight_excursions(vi.Rig(one, shaken), grid)
    swing, acceleration = reference_excursions(vi.Rig(one, shaken))
    assert curves[0].max() <= swing * (1 + 1e-12)
    assert curves[0].max() == pytest.approx(swing, rel=1e-4)
    if shaken.of in ("displacement", "unbalance"):
        at = curves[1][np.argmax(curves[0])]
        assert acceleration == pytest.approx(at, rel=2e-3)
    else:
        assert curves[1].max() == pytest.approx(acceleration, rel=1e-4)


@pytest.mark.parametrize("ratio", [0.05, 0.3, 1.2])
def test_transmissibility(ratio):
    """|u + X sin θ|/X = √((1 + (2ξr)²)/((1 − r²)² + (2ξr)²)), and ω² X times that accelerates."""
    one = rig(ratio)
    for r in (0.3, 0.9, 1.0, 1.7, 4.0):
        shaken = vi.Harmonic("20 mm", r * one.natural_frequency, 0.4)
        gain = np.sqrt(
            (1 + (2 * ratio * r) ** 2) / ((1 - r) ** 2 * (1 + r) ** 2 + (2 * ratio * r) ** 2)
        )
        omega = shaken.angular_frequency
        data = vi.orbit(vi.Rig(one, shaken), samples=64)
        angle = 2.0 * np.pi * data["cycle"].values[:64] + 0.4
        absolute = data["displacement"].values[:64] + 0.02 * np.sin(angle)
        line = 2.0 / 64 * np.abs(np.sum(absolute * np.exp(-1j * angle)))
        assert line / 0.02 == pytest.approx(gain, rel=1e-12)
        np.testing.assert_allclose(
            data["base_acceleration"].values[:64], -0.02 * omega**2 * np.sin(angle), atol=1e-13
        )
        excursion = float(data["acceleration_excursion"])
        assert excursion / (2 * omega**2 * 0.02) == pytest.approx(gain, rel=1e-12)
        excursions = free_flight_excursions(vi.Rig(one, shaken), np.array([shaken.frequency]))
        assert excursions[1][0] / (2 * omega**2 * 0.02) == pytest.approx(gain, rel=1e-12)


@pytest.mark.parametrize(
    "kind", ["displacement", "force", "unbalance", "harmonics of displacement"]
)
def test_a_sweep_takes_its_share_of_them(kind):
    one, shaken = rig(0.1), SHAKEN[kind]
    grid = np.linspace(0.15, 0.5, 6)
    data = vi.sweep(vi.Rig(one, shaken), grid)
    free = free_flight_excursions(vi.Rig(one, shaken), grid)
    swing, acceleration = reference_excursions(vi.Rig(one, shaken))
    for d in range(2):
        np.testing.assert_allclose(data["displacement_excursion"][d], free[0], rtol=1e-9)
        np.testing.assert_allclose(data["eta_d"][d], free[0] / swing, rtol=1e-9)
        np.testing.assert_allclose(data["eta_a"][d], free[1] / acceleration, rtol=1e-9)
