"""Published impact oscillators with rigid stops.

C. Budd and F. Dux, Chattering and related behaviour in impact oscillators, Phil. Trans. R. Soc. A
347 (1994) 365-389: x″ + x = cos ωt with a stop at x = σ and restitution r. Of the (1, n) orbits -
one impact in n cycles - the impact velocity is known in closed form: with γ = cos(2πn/ω) and so on
as derived here in `reference.impact_orbits`; chattering motions end in rest on the stop while
σ < 1 and the force presses, and leave it where cos ωt = σ. What is compared number by number, and
the orbit of Dankowicz and Schilder, is in `comparisons/impact_oscillators.py`.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr
from mpmath import mp

import vibroimpact as vi
from literature.comparisons.impact_oscillators import (
    COSINE,
    budd_dux_doubling,
    budd_dux_doubling_found,
    budd_dux_rig,
    budd_dux_start,
    fastest,
)
from reference.impact_orbits import Oscillator, doubling, possible_orbits
from reference.public_motion import events
from samples import sample

BUDD_DUX = [  # ω, r, σ, n
    (2.8, 0.8, 0.0, 1),
    (2.2, 0.9, 0.0, 1),
    (2.6, 0.9, 0.05, 1),
    (4.3, 0.8, 0.0, 2),
    (6.3, 0.8, 0.0, 3),
    (2.1, 0.5, 0.1, 1),
    # the stop beyond the place of rest: the mass is held away
    (2.8, 0.8, -0.1, 1),
    (2.6, 0.9, -0.3, 1),
    (4.3, 0.8, -0.05, 2),
    (1.9, 0.7, -0.2, 1),
]


@pytest.mark.parametrize(("omega", "r", "sigma", "n"), sample(BUDD_DUX, BUDD_DUX[::3]))
def test_budd_and_dux_orbits(omega: float, r: float, sigma: float, n: int) -> None:
    one = Oscillator(omega / math.tau, 0.0, r, sigma, n)
    with mp.workdps(30):
        orbits = possible_orbits(one)
        assert orbits
        for orbit in orbits:
            shaking, start = budd_dux_start(orbit)
            shown = vi.orbit(vi.Rig(budd_dux_rig(one), shaking), start, n)
            (impact,) = events(shown)
            assert impact.v == pytest.approx(float(orbit.velocity), rel=1e-10)
            assert int(shown["stable"]) == int(max(map(abs, orbit.multipliers)) < 1)
            product = np.hypot(shown["multiplier_real"], shown["multiplier_imag"]).values[:2].prod()
            assert product == pytest.approx(r**2, rel=1e-9)


@pytest.mark.parametrize(
    ("r", "sigma"), [(0.8, 0.0), (0.7, 0.0), (0.8, 0.05), (0.8, -0.05), (0.7, -0.1)]
)
def test_budd_and_dux_period_doubling(r: float, sigma: float) -> None:
    one = Oscillator(2.3 / math.tau, 0.0, r, sigma)
    assert abs(budd_dux_doubling_found(one) - budd_dux_doubling(one)) < 1e-10


@pytest.mark.parametrize("other", ["gap", "stops.restitution", "amplitude", "isolator.damping"])
def test_budd_and_dux_curves_of_period_doublings(other: str) -> None:
    one = Oscillator(2.3 / math.tau, 0.0, 0.8, 0.05)
    rig, shaken, data = _followed(one, (0.9 * one.frequency, 1.2 * one.frequency))
    curve = _curve(rig, shaken, data, "period doubling", other, (0.5, 1.2))
    for hertz, value in zip(curve["frequency"].values[::5], curve[other].values[::5], strict=True):
        beside = _with(one, other, value)
        assert float(doubling(beside, 0.98 * hertz, 1.02 * hertz)) == pytest.approx(
            hertz, rel=1e-11
        )


@pytest.mark.parametrize("other", ["gap", "stops.restitution", "amplitude", "isolator.damping"])
def test_curves_of_folds_in_closed_form(other: str) -> None:
    """Where the two (1, 1) orbits meet."""
    one = Oscillator(1.49 / math.tau, 0.1, 0.8, 2.5)
    rig, shaken, data = _followed(one, (0.8 * one.frequency, 1.2 * one.frequency))
    curve = _curve(rig, shaken, data, "fold", other, (0.5, 1.2))
    for hertz, value in zip(curve["frequency"].values, curve[other].values, strict=True):
        beside = _with(one, other, value)._replace(frequency=hertz)
        assert float(beside.fold) == pytest.approx(beside.gap, rel=1e-8)


def _followed(
    one: Oscillator, span: tuple[float, float]
) -> tuple[vi.Oscillator, vi.Harmonic, xr.Dataset]:
    """The branch of the faster of its orbits."""
    rig, (shaken, start) = budd_dux_rig(one), budd_dux_start(fastest(one))
    return rig, shaken, vi.branch(vi.Rig(rig, shaken), start, vary={"frequency": span})


def _curve(
    rig: vi.Oscillator,
    shaken: vi.Harmonic,
    data: xr.Dataset,
    kind: str,
    other: str,
    shares: tuple[float, float],
) -> xr.Dataset:
    """One bifurcation followed over the frequency and another parameter, to both ends of it."""
    values = {
        "gap": rig.right.gap,
        "stops.restitution": 0.8,
        "amplitude": 1.0,
        "isolator.damping": 0.1,
    }
    low, high = (share * values[other] for share in shares)
    if other == "isolator.damping":
        low, high = 0.0, 0.2
    i = int(np.flatnonzero(data["bifurcation_kind"].values == kind)[0])
    curve = vi.bifurcation_curve(
        vi.Rig(rig, shaken),
        data.isel(bifurcation=i),
        vary={"frequency": (0.1, 1.0), other: (low, high)},
    )
    assert float(curve[other].min()) == pytest.approx(low, abs=1e-12)
    assert float(curve[other].max()) == pytest.approx(high, rel=1e-12)
    return curve


def _with(one: Oscillator, other: str, value: float) -> Oscillator:
    if other == "amplitude":  # the gap over it is what counts
        return one._replace(gap=one.gap / value)
    return one._replace(**{other.rpartition(".")[2]: value})


def test_budd_and_dux_chatter_ends_in_rest() -> None:
    """It sticks for part of each cycle at low ω, and leaves the stop where cos ωt = σ."""
    r, sigma, omega = 0.7, -0.3, 0.45
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), vi.RigidStop(r, sigma))
    shaken = vi.Harmonic(1.0, omega / math.tau, COSINE)
    data = vi.simulate(vi.Rig(rig, shaken), 8, samples=1)
    left = [one for one in events(data) if one.kind == "detach_right"]
    assert len(left) == 8
    for one in left:
        angle = omega * one.time
        assert math.cos(angle) == pytest.approx(sigma, abs=1e-10)
        assert math.sin(angle) > 0  # the force falls


@pytest.mark.parametrize("sigma", [-0.6, -0.2, 0.0, 0.4])
def test_a_shifted_stop_is_a_constant_force(sigma: float) -> None:
    """x″ + x = cos ωt + σ with the stop at the place where the spring is slack."""
    r, omega = 0.8, 2.8
    shaken = vi.Harmonic(1.0, omega / math.tau, COSINE)
    held = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), vi.RigidStop(r, sigma))
    pushed = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), vi.RigidStop(r, 0.0), force=-sigma)
    one = vi.simulate(vi.Rig(held, shaken), 12, vi.State(-1.0), samples=8)
    other = vi.simulate(vi.Rig(pushed, shaken), 12, vi.State(-1.0 - sigma), samples=8)
    assert one.sizes["event"] == other.sizes["event"] > 4
    np.testing.assert_allclose(one["displacement"] - sigma, other["displacement"], atol=1e-11)
    np.testing.assert_allclose(one["event_time"], other["event_time"], atol=1e-10)
