"""Coulomb friction against closed forms: Den Hartog's motion without stops, sticking, no creep."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample


def rig(friction: float, damping: float = 0.0) -> vi.Oscillator:
    return vi.Oscillator(1.0, vi.FrictionIsolator(1.0, damping, friction))


def den_hartog(ratio: float, friction: float) -> tuple[float, float]:
    """Amplitude of the motion without stops, force and stiffness 1, and the phase of its maximum.

    Den Hartog, Trans. ASME 53 (1931): X² = V² − (F U)², and the force is ahead of the motion.
    """
    v = 1.0 / (1.0 - ratio**2)
    u = math.sin(math.pi / ratio) / (ratio * (1.0 + math.cos(math.pi / ratio)))
    amplitude = math.sqrt(v**2 - (friction * u) ** 2)
    # The mass feels −sin θ, which is cos φ = X/V where the displacement is largest.
    return amplitude, math.atan2(-amplitude / v, friction * abs(u / v))


@pytest.mark.parametrize("ratio", [0.7, 0.9, 1.3, 1.7])
@pytest.mark.parametrize("friction", [0.05, 0.2, 0.4])
def test_den_hartog(ratio: float, friction: float) -> None:
    amplitude, phase = den_hartog(ratio, friction)
    shaken = vi.Harmonic(1.0, ratio / math.tau, phase)
    start = vi.State(amplitude, 0.0)
    for cycles, sign in ((0.5, -1.0), (1.0, 1.0), (3.0, 1.0)):
        end = vi.simulate(vi.Rig(rig(friction), shaken), cycles, start, samples=0)[
            "final_state"
        ].values
        np.testing.assert_allclose(end[:2], [sign * amplitude, 0.0], atol=2e-13 * amplitude)
    data = vi.simulate(vi.Rig(rig(friction), shaken), 1, start, samples=500)
    assert abs(data["displacement"]).max() == pytest.approx(amplitude, rel=1e-12)


@pytest.mark.parametrize("ratio", [0.7, 1.3])
def test_it_is_where_a_motion_from_rest_goes(ratio: float) -> None:
    amplitude, phase = den_hartog(ratio, 0.4)
    shaken = vi.Harmonic(1.0, ratio / math.tau, phase)
    end = vi.simulate(vi.Rig(rig(0.4), shaken), 1000, samples=0)["final_state"].values
    np.testing.assert_allclose(end[:2], [amplitude, 0.0], atol=1e-11 * amplitude)


def test_held_until_the_force_exceeds_friction() -> None:
    """At rest up to sin θ = F/A to the last bit, and then as a free oscillator from there."""
    ratio, friction = 0.3, 0.5
    shaken = vi.Harmonic(1.0, ratio / math.tau)
    data = vi.simulate(vi.Rig(rig(friction), shaken), 0.25, samples=3000)
    t, u = data["time"].values, data["displacement"].values
    release = math.asin(friction) / ratio
    held = t < release
    assert 200 < held.sum() < 300
    assert not u[held].any()
    assert not data["velocity"].values[held].any()
    size = 1.0 / (1.0 - ratio**2)
    # −sin θ + F + its own vibration, from u = u′ = 0 where sin θ = F.
    s, c = math.sin(ratio * release), math.cos(ratio * release)
    tau = t - release
    expected = friction - size * np.sin(ratio * t)
    expected += (size * s - friction) * np.cos(tau) + size * ratio * c * np.sin(tau)
    sliding = (t > release) & (data["velocity"].values < 0.0)
    assert sliding.sum() > 200
    np.testing.assert_allclose(u[sliding], expected[sliding], atol=1e-14)


def test_what_is_held_never_moves() -> None:
    """Nowhere between where the spring and the shaking together exceed friction."""
    shaken = vi.Harmonic(0.3, 0.2)
    start = vi.State(0.19)
    end = vi.simulate(vi.Rig(rig(0.5), shaken), 50, start, samples=0)["final_state"].values
    assert list(end[:2]) == [0.19, 0.0]
    ends = [
        float(
            vi.simulate(vi.Rig(rig(0.5), shaken), cycles, vi.State(0.25), samples=0)["final_state"][
                0
            ]
        )
        for cycles in (1, 10, 100, 1000)
    ]
    assert ends == sorted(ends, reverse=True)  # to where the two are friction, ever slower
    assert 0.2 < ends[-1] < 0.2003 < ends[-2] < 0.25


def test_no_creep() -> None:
    """A motion of slips and stops is the same after many cycles."""
    shaken = vi.Harmonic(1.0, 0.3 / math.tau, 0.7)
    cycles = sample(100_000, 10_000)
    short = vi.simulate(vi.Rig(rig(0.75), shaken), 100, samples=0)["final_state"]
    long = vi.simulate(vi.Rig(rig(0.75), shaken), cycles, samples=0)["final_state"]
    np.testing.assert_allclose(long.values[:2], short.values[:2], atol=1e-14)
    data = vi.simulate(vi.Rig(rig(0.75), shaken), 1, short, samples=400)
    assert 20 < (data["velocity"] == 0.0).sum() < 380
