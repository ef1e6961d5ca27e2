"""Two curved stops that are pressed at once, one of them 1e8 times as stiff as the isolator.

The mass is held so fast that it follows the shaking as if it had no inertia: the forces of isolator
and stops balance that of the base at each moment.
"""

from __future__ import annotations

import math

import pytest
from scipy.optimize import brentq

import vibroimpact as vi
from samples import sample

SHAKEN = vi.Harmonic(18.4087, 3.33011)


def pressed(damping: float, damping_exponent: float) -> vi.Oscillator:
    return vi.Oscillator(
        10562.25,
        vi.Isolator(194441191.0, damping, damping_exponent),
        right=vi.PowerBumper(
            144839414.0, -0.000546019, 1.5, relation="hunt-crossley", restitution=0.532464
        ),
        left=vi.JankowskiBumper(2.6469e16, -0.00779594, 0.272852, 25447.5),
    )


def held(rig: vi.Oscillator, shaking: float, v: float = 0.0) -> float:
    """Where the mass stays against the acceleration of the base while it creeps, m."""
    stiff = rig.left
    viscous = 2.0 * stiff.damping_ratio * math.sqrt(stiff.stiffness * stiff.mass)

    def force(u: float) -> float:
        depth = -u - stiff.gap
        stops = stiff.stiffness * depth**1.5 + viscous * depth**0.25 * max(-v, 0.0)
        stops -= rig.right.stiffness * (u - rig.right.gap) ** 1.5
        return float(stops - rig.isolator.stiffness * u - rig.mass * shaking)

    return float(brentq(force, 0.0, -stiff.gap, xtol=1e-300, rtol=1e-15))


@pytest.mark.parametrize("damping", sample([0.0, 772.108], [772.108]))
@pytest.mark.parametrize("exponent", sample([1.0, 1.5, 2.0], [1.5]))
def test_a_mass_held_fast_follows_the_shaking(damping: float, exponent: float) -> None:
    """From its equilibrium, where the rounding of u is a force on the mass."""
    rig = pressed(damping, exponent)
    motion = vi.simulate(vi.Rig(rig, SHAKEN), 2, samples=32)
    assert motion["status"] == 0
    assert (motion["deformation"] > 0.0).all()
    assert motion["stop"].values.tolist() == ["right", "left"]
    late = motion.isel(time=slice(32, None))
    swing = held(rig, -SHAKEN.amplitude) - held(rig, SHAKEN.amplitude)
    names = ("displacement", "velocity", "base_acceleration")
    for u, v, shaking in zip(*(late[name].values for name in names), strict=True):
        assert u == pytest.approx(held(rig, shaking, v), abs=1e-6 * swing)
