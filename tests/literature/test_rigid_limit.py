"""Ever stiffer bumpers approach rigid stops with a coefficient of restitution.

**Restitution of a Kelvin-Voigt contact that cannot pull.** A mass m meets the bumper with velocity
v, and nothing else acts: m x″ + c x′ + k x = 0, x(0) = 0, x′(0) = v. With ω = √(k/m), the damping
ratio z = c / (2 m ω) = sin β and ω_d = ω cos β,

    x′ = v exp(-z ω t) cos(ω_d t + β) / cos β,

since at t = 0 both x′ = v and x″ = -2 z ω v hold: differentiating multiplies by ω and turns by
β + π/2. The contact force is k x + c x′ = -m x″, and

    x″ = -v ω exp(-z ω t) sin(ω_d t + 2β) / cos β

vanishes first at ω_d t = π - 2β - before x does, which would be at π. There the mass returns with

    e = exp(-z ω t) = exp(-tan β (π - 2β)) = exp(-2 z arccos z / √(1 - z²)),

continued to z > 1 by arcosh; the bumper is left deformed by e v c / k. A contact that lasts until
x = 0, and so pulls, would give exp(-π tan β): the "usual formula" z = -ln e / √(π² + ln² e) is its
inverse, and so it falls short of what it is meant for: nominal 0.5 becomes 0.550.

**Impact orbits** (S. W. Shaw and P. J. Holmes, J. Sound Vib. 90 (1983) 129-155). Between impacts
u = h + p, with p = X cos ψ the steady free flight and h decaying freely. One impact a period T
of n forcing cycles on the stop at G, at ψ: h returns to the same value q = G - X cos ψ, while its
velocity rises from s to s + (1 + e) v. The free decay over T is linear, so s = σ q and
v = κ q; with s = -e v - p′ this leaves X ω sin ψ + Λ X cos ψ = Λ G, Λ = σ + e κ. An orbit with
one impact on each of two stops is antisymmetric: the same with T/2, n odd, and signs changed.

Contacts take a time of order λ^(-1/2), and so the orbits differ from the rigid ones by that.
"""

from __future__ import annotations

import cmath
import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import pytest

import vibroimpact as vi

ISOLATOR_DAMPING = 0.05


def restitution(z: float) -> float:
    if z < 1.0:
        return math.exp(-2.0 * z * math.acos(z) / math.sqrt(1.0 - z * z))
    return math.exp(-2.0 * z * math.acosh(z) / math.sqrt(z * z - 1.0))


def usual_damping_ratio(e: float) -> float:
    return -math.log(e) / math.hypot(math.pi, math.log(e))


def bumper(ratio: float, z: float, gap: float = 0.0) -> vi.Bumper:
    """With M = K = 1; the damping ratio is that of the contact with the mass."""
    return vi.Bumper(ratio, 2.0 * z * math.sqrt(ratio), gap)


@pytest.mark.parametrize(("nominal", "true"), [(0.5, 0.550), (0.65, 0.675), (0.8, 0.808)])
def test_the_usual_formula_falls_short(nominal: float, true: float) -> None:
    assert restitution(usual_damping_ratio(nominal)) == pytest.approx(true, abs=5e-4)


@pytest.mark.parametrize("z", [0.001, 0.05, 0.2154537, 0.7, 0.95, 1.05, 3.0])
@pytest.mark.parametrize("ratio", [1e4, 1e6, 1e8])
def test_one_impact(z: float, ratio: float) -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), bumper(ratio, z))
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(0.0, 1.0)), 0.5, vi.State(0.0, 2.0), samples=1)
    assert data["event_contact"].values[:2].tolist() == [1, 0]  # at the start, and its end
    e = restitution(z)
    # The isolator's spring shifts z by a share of 1/λ, and e with it.
    allowed = 1.0 / ratio  # 0.9 at z = 3, less below
    assert -data["event_velocity"].values[1] == pytest.approx(2.0 * e, rel=allowed)
    left = 2.0 * e * 2.0 * z / math.sqrt(ratio)
    assert data["event_deformation"].sel(stop="right").values[1] == pytest.approx(left, rel=allowed)


class Orbit(NamedTuple):
    """Where a rigid orbit strikes the right stop: gap, phase of the base, velocity."""

    gap: float
    phase: float
    velocity: float


def rigid_orbit(ratio: float, n: int, share: float, e: float, two_stops: bool) -> Orbit:
    """The only orbit with one impact (a stop) in n cycles that keeps between the stops.

    `ratio` is ω/ω0, ω0 = 1; the gap is a share of the amplitude of free flight.
    """
    xi = ISOLATOR_DAMPING
    turning = -1.0 / complex(1.0 - ratio**2, 2.0 * xi * ratio)
    swing = abs(turning)
    gap = share * swing
    span = math.tau * n / ratio / (2.0 if two_stops else 1.0)
    sign = -1.0 if two_stops else 1.0
    quick = math.sqrt(1.0 - xi**2)
    decay, cosine, sine = math.exp(-xi * span), math.cos(quick * span), math.sin(quick * span)
    (a, b), (c, d) = (
        (decay * (cosine + xi / quick * sine), decay * sine / quick),
        (-decay * sine / quick, decay * (cosine - xi / quick * sine)),
    )
    sigma = (sign - a) / b
    kappa = sign * (c + (d - sign) * sigma) / (1.0 + e)
    both = sigma + e * kappa
    middle, spread = math.atan2(ratio, both), math.acos(both * share / math.hypot(ratio, both))
    orbits = []
    for psi in (middle + spread, middle - spread):
        q = gap - swing * math.cos(psi)
        t = np.linspace(0.0, span, 2000)[1:-1]
        waving = q * np.cos(quick * t) + (sigma + xi) * q / quick * np.sin(quick * t)
        u = np.exp(-xi * t) * waving + swing * np.cos(psi + ratio * t)
        if kappa * q > 0.0 and u.max() < gap and (not two_stops or u.min() > -gap):
            phase = psi + math.pi / 2 - cmath.phase(turning)
            orbits.append(Orbit(gap, phase % math.tau, kappa * q))
    (orbit,) = orbits
    return orbit


def error(
    orbit: Orbit,
    ratio: float,
    nominal: float,
    stiffness: float,
    cycles: int,
    two_stops: bool,
    from_rest: bool = False,
) -> float:
    """Of phase (rad) and relative velocity at the last impact on the right.

    The motion starts on the rigid orbit just behind an impact, the bumper back at rest as a
    rigid stop is; or from rest.
    """
    z = usual_damping_ratio(nominal)
    stop = bumper(stiffness, z, orbit.gap)
    isolator = vi.Isolator(1.0, 2.0 * ISOLATOR_DAMPING)
    rig = vi.Oscillator(1.0, isolator, stop, stop if two_stops else None)
    shaken = vi.Harmonic(1.0, ratio / math.tau, orbit.phase)
    behind = vi.State(orbit.gap, -restitution(z) * orbit.velocity, {"right": 0.0}, contact=0)
    start = vi.State() if from_rest else behind
    data = vi.simulate(vi.Rig(rig, shaken), cycles + 0.5, start, samples=1)
    struck = (data["event_contact"] == 1) & (data["event_stop"] == "right")
    last = int(np.flatnonzero(struck)[-1])
    turn = math.tau * float(data["event_cycle_time"][last]) * shaken.frequency
    quicker = float(data["event_velocity"][last]) / orbit.velocity - 1.0
    return math.hypot(math.remainder(turn, math.tau), quicker)


ORBITS = [  # ω/ω0, n, gap as a share of the free swing, two stops
    (2.0, 1, 0.0, False),
    (2.2, 1, 0.3, False),
    (1.5, 1, 0.5, False),
    (4.2, 2, 0.2, False),
    (6.0, 3, 0.0, False),
    (1.0, 1, 0.3, True),
]


@pytest.mark.parametrize("nominal", [0.5, 0.65, 0.8])
@pytest.mark.parametrize(("ratio", "n", "share", "two_stops"), ORBITS)
def test_stiff_bumpers_settle_near_the_rigid_orbit(
    ratio: float, n: int, share: float, two_stops: bool, nominal: float
) -> None:
    orbit = rigid_orbit(ratio, n, share, restitution(usual_damping_ratio(nominal)), two_stops)
    sizes = [
        error(orbit, ratio, nominal, stiffness, 150 * n, two_stops) for stiffness in (1e4, 1e6, 1e8)
    ]
    assert sizes[0] < 0.5
    for coarse, fine in pairwise(sizes):
        assert 8.0 < coarse / fine < 11.0  # 10 in the limit


@pytest.mark.parametrize("case", ORBITS[:2])
def test_they_settle_there_from_rest(case: tuple[float, int, float, bool]) -> None:
    ratio, n, share, two_stops = case
    orbit = rigid_orbit(ratio, n, share, restitution(usual_damping_ratio(0.65)), two_stops)
    sizes = [
        error(orbit, ratio, 0.65, 1e8, 150, two_stops, from_rest) for from_rest in (True, False)
    ]
    assert sizes[0] == pytest.approx(sizes[1], rel=1e-6)


@pytest.mark.parametrize(("ratio", "share"), [(1.5, 0.2), (2.5, 0.5)])
def test_after_one_cycle_even_unstable_orbits_are_near(ratio: float, share: float) -> None:
    orbit = rigid_orbit(ratio, 1, share, restitution(usual_damping_ratio(0.65)), True)
    coarse, fine = (error(orbit, ratio, 0.65, stiffness, 1, True) for stiffness in (1e6, 1e8))
    assert 8.0 < coarse / fine < 11.0
