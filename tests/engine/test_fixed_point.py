"""The last steps to a fixed point nearby: to rounding, and only where it attracts."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi


@pytest.mark.parametrize("tolerance", [1e-9, 1e-12, 1e-14])
def test_free_flight_is_reached_to_rounding(tolerance: float) -> None:
    """Closed form: u = A (cos θ …) / … at the section."""
    omega_0, xi, amplitude = 7.0, 0.05, 0.8
    rig = vi.Oscillator(1.0, vi.Isolator(omega_0**2, 2 * xi * omega_0))
    for ratio in (0.3, 0.9, 1.0, 1.1, 2.5):
        omega = ratio * omega_0
        swept = vi.sweep(
            vi.Rig(rig, amplitude), [omega / math.tau], "forward", tolerance=tolerance
        ).isel(direction=0, frequency=0)
        response = -amplitude / (omega_0**2 - omega**2 + 2j * xi * omega_0 * omega)
        size = abs(response)
        assert swept["section"][0] == pytest.approx(response.imag, abs=3e-14 * size)
        assert swept["section"][1] == pytest.approx(
            (1j * omega * response).imag, abs=3e-14 * size * omega
        )


def test_a_torus_is_no_orbit() -> None:
    """Nothing dies out without damping: the free oscillation goes on beside the forced one."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0))
    start = vi.State(0.3, 0.1)
    one = vi.sweep(vi.Rig(rig, 0.1), [0.05], "forward", start=start).isel(direction=0, frequency=0)
    assert one["motion"] != "periodic"


def test_what_a_bumper_remembers_counts() -> None:
    """A bumper that has not come back within a cycle is a third part of the state."""
    slow = vi.Bumper(4.0, 6.0, 0.2)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.2), slow, slow)
    one = vi.sweep(vi.Rig(rig, 1.0), [0.3], "forward").isel(direction=0, frequency=0)
    assert one["motion"] == "periodic"
    assert one["impacts"].sel(stop="right") > 0
    later = vi.simulate(vi.Rig(rig, vi.Harmonic(1.0, 0.3)), 200, one["section"], samples=0)[
        "final_state"
    ]
    np.testing.assert_allclose(later[:4], one["section"][:4], rtol=0.0, atol=1e-12)
    patient = vi.simulate(vi.Rig(rig, vi.Harmonic(1.0, 0.3)), 400, samples=0)["final_state"]
    np.testing.assert_allclose(patient[:4], one["section"][:4], rtol=0.0, atol=1e-12)
