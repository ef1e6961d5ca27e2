"""A free mass against stops that follow a power of their deformation: what comes back."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import vibroimpact as vi

ASKED = (0.3, 0.5, 0.7, 0.9)
RETURNED = {
    "exact": ASKED,
    "hunt-crossley": (0.581, 0.663, 0.768, 0.909),
    "lankarani-nikravesh": (0.684, 0.725, 0.796, 0.913),
    "flores": (0.256, 0.470, 0.683, 0.894),
    "gonthier": (0.304, 0.488, 0.670, 0.876),
}
"""By quadrature of v dv/(1 + χ v) = −k δⁿ dδ, whatever k and n: see `returned`."""

POUNDING = dict(zip(ASKED, (0.292, 0.495, 0.698, 0.900), strict=True))

SPRING = 1e-16  # N/m a kilogram: a mass without a spring needs stops on both sides
GAP = 0.1


def flown(stop, speed: float, side: int = 1, mass: float = 1.0, reach: float = 1.0):
    """A free mass through one impact; `reach` is a length of the contact."""
    sides = (stop, None) if side == 1 else (None, stop)
    rig = vi.Oscillator(mass, vi.Isolator(SPRING * mass, 0.0), *sides)
    time = (GAP + 20.0 * reach) / speed
    start = vi.State(0.0, side * speed)
    return vi.simulate(vi.Rig(rig, vi.Harmonic(1e-300, 1.0 / time)), 1, start, samples=64)


def returned(stop, speed: float, side: int = 1, mass: float = 1.0) -> float:
    depth = ((stop.exponent + 1.0) / 2.0 * mass * speed**2 / stop.stiffness) ** (
        1.0 / (stop.exponent + 1.0)
    )
    data = flown(stop, speed, side, mass, depth)
    assert data["status"] == 0
    kinds, sides = (
        data["event_contact"].values,
        np.where(data["event_stop"].values == "right", 1, -1),
    )
    assert list(zip(kinds, sides, strict=True)) == [(1, side), (0, side)]
    closing, parting = data["event_velocity"].values
    return float(-parting / closing)


@pytest.mark.parametrize("relation", RETURNED)
@pytest.mark.parametrize("side", [1, -1])
def test_restitution_of_each_relation(relation: str, side: int) -> None:
    for e, expected in zip(ASKED, RETURNED[relation], strict=True):
        stop = vi.PowerBumper(1e4, GAP, restitution=e, relation=relation)
        ratio = returned(stop, 1.0, side)
        assert ratio == pytest.approx(expected, abs=5.1e-4)
        # (1 + χ v) of the two sides: ln[(1 + d)/(1 − d e)] = d (1 + e).
        d = stop.dissipation_number
        assert math.log((1 + d) / (1 - d * ratio)) == pytest.approx(d * (1 + ratio), rel=1e-10)


@pytest.mark.parametrize("e", [0.05, *ASKED, 0.99])
@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.2])
def test_exact_returns_what_is_asked(e: float, exponent: float) -> None:
    for stiffness, speed, mass in ((1.0, 1.0, 1.0), (1e4, 1e-3, 30.0), (1e9, 20.0, 550.0)):
        stop = vi.PowerBumper(stiffness, GAP, exponent, restitution=e, relation="exact")
        assert returned(stop, speed, 1, mass) == pytest.approx(e, abs=1e-12)


@pytest.mark.parametrize("e", ASKED)
def test_pounding_after_jankowski(e: float) -> None:
    stop = vi.JankowskiBumper(1e4, GAP, e, 1.0)
    data = flown(stop, 1.0, reach=0.03)
    assert -float(data["final_state"].values[1]) == pytest.approx(POUNDING[e], abs=5.1e-4)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0, 3.7])
def test_depth_of_an_elastic_impact(exponent: float) -> None:
    """The energy of the mass is that of the stop, k δⁿ⁺¹/(n + 1); it comes back as it went."""
    stop = vi.PowerBumper(250.0, GAP, exponent, dissipation=0.0)
    assert returned(stop, 1.3, mass=2.0) == pytest.approx(1.0, abs=1e-13)
    depth = ((exponent + 1.0) * 0.5 * 2.0 * 1.3**2 / 250.0) ** (1.0 / (exponent + 1.0))
    data = flown(stop, 1.3, mass=2.0, reach=depth)
    v, face = data["velocity"].values, data["deformation"].sel(stop="right").values
    pressed = face > 0.0
    assert pressed.sum() > 2
    energy = 0.5 * 2.0 * v**2 + 250.0 * face ** (exponent + 1.0) / (exponent + 1.0)
    np.testing.assert_allclose(energy, energy[0], rtol=1e-12)
    assert face.max() <= depth * (1.0 + 1e-12)


def test_a_stop_does_not_pull() -> None:
    """1 + χ δ′ is held at 0: pressed and let go faster than −1/χ, it follows without a force."""
    stop = vi.PowerBumper(2.0, GAP, dissipation=3.0)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), stop, stop)
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(0.6, 0.9 / math.tau)), 20, samples=256)
    u, v = data["displacement"].values, data["velocity"].values
    a = data["acceleration"].values + u + 0.1 * v  # what stops do, seen from the ground
    right, left = u - GAP, -u - GAP
    assert (a[right > 1e-9] <= 1e-12).all()
    assert (a[left > 1e-9] >= -1e-12).all()
    let_go = (right > 1e-6) & (v < -1.0 / 3.0)
    assert let_go.sum() > 5
    np.testing.assert_allclose(a[let_go], 0.0, atol=1e-12)


@pytest.mark.parametrize("exponent", [1.5, 2.0, 2.5, 2.9])
def test_a_mass_that_is_pushed_from_rest_where_it_touches(exponent: float) -> None:
    """Without speed it is the push that presses the stop, against DOP853 in small steps."""
    stop = vi.PowerBumper(7000.0, 0.0, exponent, dissipation=0.06)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), stop)
    shaken = vi.Harmonic(0.1, 0.06, -1.2)

    def slope(t: float, state: np.ndarray) -> list[float]:
        u, v = state
        push = max(7000.0 * max(u, 0.0) ** exponent * (1.0 + 0.06 * v), 0.0)
        return [v, -u - push - 0.1 * math.sin(shaken.angular_frequency * t - 1.2)]

    exact = solve_ivp(
        slope, (0.0, 1.0), [0.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-14, max_step=1e-3
    ).y[:, -1]
    end = vi.simulate(vi.Rig(rig, shaken), 0.06, samples=0)["final_state"].values[:2]
    np.testing.assert_allclose(end, exact, atol=1e-9)


@pytest.mark.parametrize("exponent", [1.5, 2.0, 3.0])
@pytest.mark.parametrize("dissipation", [0.0, 0.5])
def test_a_contact_that_is_looked_at_just_before_it_ends(
    exponent: float, dissipation: float
) -> None:
    """A mass on its way out, followed up to some time before it parts, against DOP853."""
    stop = vi.PowerBumper(2e7 * 2e-3 ** (1.5 - exponent), 6e-3, exponent, dissipation=dissipation)
    rig = vi.Oscillator(550.0, vi.Isolator(26e3, 1.1e3), stop)
    shaken, start = vi.Harmonic(1e-9, 1.0), vi.State(7.8e-3, -0.06)
    parts = float(vi.simulate(vi.Rig(rig, shaken), 0.5, start)["event_time"][0])

    def slope(_: float, state: np.ndarray) -> list[float]:
        u, v = state
        depth = max(u - 6e-3, 0.0)
        push = stop.stiffness * depth**exponent * (1.0 + dissipation * v)
        return [v, -(26e3 * u + 1.1e3 * v + push) / 550.0]

    times = parts * np.linspace(0.1, 0.999, 40)
    begin = [start.displacement, start.velocity]
    exact = solve_ivp(
        slope, (0.0, parts), begin, "DOP853", times, rtol=1e-12, atol=1e-15, max_step=1e-4
    ).y.T
    for time, state in zip(times, exact, strict=True):
        end = vi.simulate(vi.Rig(rig, shaken), time, start, samples=0)["final_state"].values[:2]
        np.testing.assert_allclose(end, state, atol=1e-9)
