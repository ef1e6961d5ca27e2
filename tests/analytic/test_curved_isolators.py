"""Hysteretic and polynomial isolators against what is known of them in closed form."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scipy.special import ellipk

import vibroimpact as vi

SHAKEN = vi.Harmonic(0.6, 0.9 / math.tau, 0.3)
LARGE = SHAKEN.replace(amplitude=1.5)


def held(isolator, shaken=SHAKEN, cycles=1.0, start=None) -> np.ndarray:
    """Displacement, velocity and the isolator's memory after so many cycles."""
    rig = vi.Oscillator(1.0, isolator)
    state = vi.simulate(vi.Rig(rig, shaken), cycles, start, samples=0)["final_state"]
    return state.sel(component=["displacement", "velocity", "isolator"]).values


def settled(isolator, shaken):
    rig = vi.Oscillator(1.0, isolator)
    return rig, vi.simulate(vi.Rig(rig, shaken), 300, samples=0)["final_state"]


def test_area_of_a_bilinear_loop() -> None:
    """4 (k_e − k_p) u_y (X − u_y) a cycle, which is what the base works on the mass."""
    law = vi.BilinearIsolator(3.5, 0.5, 0.7, 0.0)
    rig, state = settled(law, LARGE)
    data = vi.simulate(vi.Rig(rig, LARGE), 1, state, samples=2**13)
    v, t = data["velocity"].values[:-1], data["time"].values[:-1]
    work = float(np.mean(-1.5 * np.sin(0.9 * t + 0.3) * v)) * LARGE.period
    swing = np.abs(data["displacement"].values).max()
    assert swing > 2.0 * law.yield_displacement
    area = 4.0 * 3.0 * law.yield_displacement * (swing - law.yield_displacement)
    assert work == pytest.approx(area, rel=2e-7)  # the swing is that of the samples


def test_masing() -> None:
    """From a reversal on, the force follows the first loading's curve at twice the scale."""
    law = vi.BilinearIsolator(3.5, 0.5, 0.7, 0.0)
    rig, state = settled(law, LARGE)
    data = vi.simulate(vi.Rig(rig, LARGE), 1, state, samples=4000)
    u = data["displacement"].values
    top = int(np.argmax(u[:2500]))
    swing = u[top]
    seen = 0
    for k in range(top + 20, top + 400, 20):
        now, _, z = held(law, LARGE, k / 4000, state)
        down = swing - now
        virgin = min(down / 2.0, law.yield_displacement)
        assert law.yield_displacement - z == pytest.approx(2.0 * virgin, abs=1e-6)
        seen += 0.01 < virgin < law.yield_displacement
    assert seen > 2


@pytest.mark.parametrize(
    ("exponent", "beta", "gamma"),
    [(1, 0.5, 0.5), (1, 0.9, 0.1), (1, 0.3, 0.7), (2, 0.5, 0.5), (2, 0.8, 0.2), (3, 0.6, 0.6),
     (4, 0.5, 0.5), (5, 0.5, 0.5), (8, 0.5, 0.5)],
)  # fmt: skip
def test_a_bouc_wen_memory_is_bounded(exponent: int, beta: float, gamma: float) -> None:
    """By u_y (β + γ)^(−1/n), which large motions come near."""
    law = vi.BoucWenIsolator(2.5, 0.5, 0.5, 0.0, exponent, beta, gamma)
    most = law.yield_displacement * (beta + gamma) ** (-1.0 / exponent)
    shaken = SHAKEN.replace(amplitude=4.0)
    memories = [held(law, shaken, cycles=cycles)[2] for cycles in np.linspace(0.1, 8.0, 60)]
    assert np.abs(memories).max() <= most * (1 + 1e-14)
    assert np.abs(memories).max() > 0.99 * most


def test_sharp_bouc_wen_is_nearly_bilinear() -> None:
    elastic, after, force = 2.5, 0.5, 0.5
    times = np.linspace(0.2, 3.0, 15)
    sharp = [held(vi.BilinearIsolator(elastic, after, force, 0.1), cycles=t) for t in times]
    errors = []
    for exponent in (1, 2, 4, 8):
        law = vi.BoucWenIsolator(elastic, after, force, 0.1, exponent)
        errors.append(np.abs(np.array([held(law, cycles=t) for t in times]) - sharp).max())
    assert all(later < 0.7 * before for before, later in itertools.pairwise(errors))
    assert errors[-1] < 0.03


@pytest.mark.parametrize(("cubic", "swing"), [(3.0, 0.2), (3.0, 2.0), (100.0, 5.0), (-0.3, 1.2)])
def test_period_of_a_free_duffing(cubic: float, swing: float) -> None:
    """4 K(m)/√(k + k₃ X²), m = k₃ X²/(2 (k + k₃ X²))."""
    stiff = 1.0 + cubic * swing**2
    m = cubic * swing**2 / (2.0 * stiff)
    period = 4.0 * float(ellipk(m)) / math.sqrt(stiff)
    law = vi.PolynomialIsolator(1.0, 0.0, cubic)
    still = vi.Harmonic(1e-300, 1.0 / period)
    speed = swing * math.tau / period
    for cycles in (1.0, 20.0):
        u, v, _ = held(law, still, cycles, vi.State(swing))
        assert u == pytest.approx(swing, rel=3e-14 * cycles)
        assert abs(v) < 3e-14 * cycles * speed
    u, _, _ = held(law, still, 0.5, vi.State(swing))
    assert u == pytest.approx(-swing, rel=1e-13)


@pytest.mark.parametrize("exponent", [0.5, 0.8, 1.5, 2.0])
def test_free_mass_against_drag(exponent: float) -> None:
    """Only the dashpot c v^α acts: v^(1−α) = v₀^(1−α) − (1 − α) c t."""
    law = vi.Isolator(1e-30, 0.7, damping_exponent=exponent)
    for t in (0.1, 1.0, 2.0):
        still = vi.Harmonic(1e-300, 1.0 / t)
        _, v, _ = held(law, still, 1.0, vi.State(0.0, 1.3))
        left = 1.3 ** (1.0 - exponent) - (1.0 - exponent) * 0.7 * t
        assert v == pytest.approx(left ** (1.0 / (1.0 - exponent)), rel=1e-13)
