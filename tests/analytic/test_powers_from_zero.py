"""Powers that begin at zero: a Taylor series does not show them until they are large.

From rest z, u̇ or a deformation is zero, and its n-th power has no coefficient below the n-th, so
that the last terms of a step's series (up to 22) say nothing of it. Every law that has a power is
compared with a closed form, or with its energy, for exponents from 1 to 100.

Under y′ = 1 − yⁿ, y(0) = 0, the variable is y ₂F₁(1, 1/n; 1 + 1/n; yⁿ).
"""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mp, mpf

import vibroimpact as vi
from samples import sample

EXPONENTS = (1, 2, 3, 10, 15, 20, 21, 22, 23, 30, 50, 100)
TOLERANCE = 1e-13
LONG = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0)
"""s, of a record that is one line."""


def pushed(push: float, seconds: float) -> vi.Record:
    """A constant acceleration of the base that pushes the mass to the right."""
    return vi.Record([-push, -push], seconds)


def missing(y: float, x: float, n: float) -> float:
    """How far y is from the solution of dy/dx = 1 − yⁿ at x."""
    with mp.workdps(40):
        power = mpf(n)
        known = mpf(y) * mp.hyp2f1(1, 1 / power, 1 + 1 / power, mpf(y) ** power)
        return float(abs(known - mpf(x)) * (1 - mpf(y) ** power))


@pytest.mark.parametrize("n", sample(EXPONENTS, EXPONENTS[1::3]))
def test_bouc_wens_memory_while_it_loads(n: int) -> None:
    """While the mass goes one way y is z/u_y and x is u/u_y."""
    isolator = vi.BoucWenIsolator(1.0, 0.1, 0.1, 0.05, exponent=n)
    limit = isolator.yield_displacement
    for seconds in LONG:
        end = vi.simulate(vi.Rig(vi.Oscillator(1.0, isolator), pushed(0.1, seconds)))
        u, v, *_, z = end["final_state"].values.tolist()
        assert v > 0.0
        if z < limit:
            assert missing(z / limit, u / limit, n) <= TOLERANCE
        assert z <= limit * (1.0 + TOLERANCE)
    assert u > 2.5 * limit


@pytest.mark.parametrize("alpha", [0.3, 0.5, *EXPONENTS, 1.5, 21.5, 40.25])
def test_a_dashpot_of_any_power_from_rest(alpha: float) -> None:
    """Pushed by a constant acceleration g, y is u̇/u̇_end and x is g t/u̇_end."""
    g, damping = 2.0, 3.0
    fastest = (g / damping) ** (1.0 / alpha)
    # A mass without a spring needs stops, which are never met.
    far = vi.RigidStop(0.5, 1e3)
    rig = vi.Oscillator(1.0, vi.Isolator(0.0, damping, alpha), far, far)
    for seconds in LONG:
        end = vi.simulate(vi.Rig(rig, pushed(g, seconds * fastest / g)), start=vi.State())
        speed = float(end["velocity"][-1]) / fastest
        assert speed <= 1.0 + TOLERANCE
        if speed < 1.0:
            assert missing(speed, seconds, alpha) <= TOLERANCE


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("exponent", [1, 1.5, 2.2, *EXPONENTS[1:]])
def test_a_stop_pressed_from_rest_keeps_the_energy(exponent: float, side: int) -> None:
    """u̇²/2 + δⁿ⁺¹/(n + 1) − g δ, without an isolator, until it is pressed most and back again."""
    stop = vi.PowerBumper(1.0, 0.0, exponent)
    rig = vi.Oscillator(1.0, vi.Isolator(0.0, 0.0), **{"right" if side == 1 else "left": stop})
    g = 0.5
    most = (g * (exponent + 1.0)) ** (1.0 / exponent)
    record = vi.Record([-side * g] * 5, 1.0)
    motion = vi.simulate(vi.Rig(rig, record), samples=40, start=vi.State())
    u, v = side * motion["displacement"].values, motion["velocity"].values
    pressed = np.maximum(u, 0.0)
    energy = 0.5 * v**2 + pressed ** (exponent + 1.0) / (exponent + 1.0) - g * u
    np.testing.assert_allclose(energy, 0.0, atol=TOLERANCE * (exponent + 1.0))
    assert u.max() > 0.98 * most


@pytest.mark.parametrize(
    ("stiffness", "cubic", "quintic"),
    [(0.0, 3.0, 0.0), (0.0, 0.0, 40.0), (0.0, 3.0, 40.0), (1e-9, 5.0, 50.0)],
)
def test_cubic_and_quintic_springs_from_rest_keep_the_energy(
    stiffness: float, cubic: float, quintic: float
) -> None:
    """A spring that has no stiffness at rest, under a record that is a straight line."""
    g = 1.0
    rig = vi.Oscillator(1.0, vi.PolynomialIsolator(stiffness, 0.0, cubic, quintic))
    motion = vi.simulate(vi.Rig(rig, vi.Record([-g] * 4, 1.5)), samples=50)
    u, v = motion["displacement"].values, motion["velocity"].values
    energy = 0.5 * v**2 + cubic * u**4 / 4.0 + quintic * u**6 / 6.0 + stiffness * u**2 / 2.0 - g * u
    np.testing.assert_allclose(energy, 0.0, atol=TOLERANCE)
    assert (v[1:] < 0.0).any()
