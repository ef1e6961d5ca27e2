"""Exponents under curved laws: their sum is what the damping says, and the tangent map."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from engine.taylor.rigs import HYSTERETIC, ISOLATORS, between
from engine.taylor.test_carry import carried
from samples import sample
from vibroimpact.response.engine_input import engine_state

FREQUENCY = 0.9 / math.tau


PLAIN = [name for name in ISOLATORS if name not in (*HYSTERETIC, "friction")]


@pytest.mark.parametrize("stop", [None, "spring", "rigid", "hunt-crossley"])
@pytest.mark.parametrize("isolator", sample(PLAIN, PLAIN[::3]))
def test_two_exponents_sum_up_to_the_divergence(isolator: str, stop: str | None) -> None:
    """Where only displacement and velocity are remembered."""
    data = vi.lyapunov_exponents(vi.Rig(between(isolator, stop), 0.6), [FREQUENCY], 200)
    damping = float(data["effective_damping"].squeeze())
    assert damping > 0.05
    assert float(data["exponents"].sum()) == pytest.approx(-damping, rel=1e-6)


@pytest.mark.parametrize("stop", ["spring", "rigid", "hunt-crossley", "flores"])
@pytest.mark.parametrize("isolator", sample(PLAIN, PLAIN[::3]))
def test_the_exponents_of_an_orbit_are_those_of_its_determinant(isolator: str, stop: str) -> None:
    """What a cycle leaves of an area of displacement and velocity, by the tangent map."""
    rig = between(isolator, stop)
    held = vi.sweep(vi.Rig(rig, 0.6), [FREQUENCY]).isel(direction=0, frequency=0)
    period, state = int(held["period"]), held["section"]
    assert period > 0
    assert not state.sel(component=["touching.right", "touching.left"]).any()
    start = engine_state(rig, vi.State(*state.values[:2]))
    rows, _, _ = carried(rig, start, period, vi.Harmonic(0.6, FREQUENCY))
    area = math.log(abs(np.linalg.det(rows[:2, :2]))) / period * FREQUENCY
    data = vi.lyapunov_exponents(vi.Rig(rig, 0.6), [FREQUENCY], 200, start=state)
    assert float(data["exponents"].sum()) == pytest.approx(area, rel=1e-5)


@pytest.mark.parametrize("isolator", ["linear", "drag"])
def test_free_flight(isolator: str) -> None:
    """Both exponents are half of the damping's mean where the motion turns."""
    rig = between(isolator, None)
    data = vi.lyapunov_exponents(vi.Rig(rig, 0.6), [FREQUENCY], 1000)
    damping = float(data["effective_damping"].squeeze())
    np.testing.assert_allclose(np.ravel(data["exponents"]), -0.5 * damping, rtol=5e-3)
