"""The largest contact force of a hold, where closed forms tell it."""

from __future__ import annotations

import math

import pytest

import vibroimpact as vi

MASS, STIFFNESS, DAMPING = 550.0, 26.8e3, 1.1e3


@pytest.mark.parametrize("frequency", [0.7, 2.5, 6.0])
def test_bumpers_that_are_never_left(frequency: float) -> None:
    """Between two preloaded bumpers all is linear: F = K_j (p ± u) ± C_j u' of a known sine."""
    right, left = (4.0e5, 800.0), (3.0e5, 500.0)
    pressed = 0.01
    # Both push alike at u = 0, so that it is at rest there.
    preloads = (pressed, pressed * right[0] / left[0])
    rig = vi.Oscillator(
        MASS,
        vi.Isolator(STIFFNESS, DAMPING),
        vi.Bumper(*right, gap=-preloads[0]),
        vi.Bumper(*left, gap=-preloads[1]),
    )
    amplitude, omega = 0.5, math.tau * frequency
    stiffness = STIFFNESS + right[0] + left[0]
    damping = DAMPING + right[1] + left[1]
    swing = MASS * amplitude / abs(stiffness - MASS * omega**2 + 1j * omega * damping)
    held = vi.sweep(vi.Rig(rig, amplitude), [frequency], "forward").isel(direction=0, frequency=0)
    assert float(held["peak_displacement"]) == pytest.approx(swing, rel=1e-10)
    for side, (k, c), preload in (("right", right, preloads[0]), ("left", left, preloads[1])):
        force = k * preload + abs(k + 1j * omega * c) * swing
        assert float(held["peak_force"].sel(stop=side)) == pytest.approx(force, rel=1e-10)
        assert float(held["peak_impulse"].sel(stop=side)) == 0.0


def test_a_mass_pressed_by_its_weight_and_hardly_shaken() -> None:
    """The bumper bears what the isolator does not, and K/M-th of the shaking comes on top."""
    k, weight = 5.1e5, -3000.0
    rig = vi.Oscillator(MASS, vi.Isolator(STIFFNESS, DAMPING), None, vi.Bumper(k, 900, 0.0), weight)
    held = vi.sweep(vi.Rig(rig, 1e-9), [0.01], "forward").isel(direction=0, frequency=0)
    share = k / (k + STIFFNESS)
    assert float(held["peak_force"].sel(stop="left")) == pytest.approx(-weight * share, rel=1e-8)
    assert held["stop"].values.tolist() == ["left"]


def test_a_mass_at_rest_on_a_wall() -> None:
    """The wall bears the weight, and the base's acceleration on top of it."""
    weight, amplitude = 3000.0, 0.1
    wall = vi.RigidStop(0.5, 0.0)
    for side, sign in (("right", 1.0), ("left", -1.0)):
        rig = vi.Oscillator(MASS, vi.Isolator(STIFFNESS, DAMPING), force=sign * weight)
        held = vi.sweep(vi.Rig(rig.replace(**{side: wall}), amplitude), [1.3], "forward")
        force = float(held["peak_force"].sel(stop=side).item())
        assert force == pytest.approx(weight + MASS * amplitude, rel=1e-12)
        assert held["peak_impulse"].sel(stop=side).item() == 0.0
