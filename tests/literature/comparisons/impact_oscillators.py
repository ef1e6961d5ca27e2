"""Published oscillators between rigid stops, between springs, and behind a contact that gives."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import xarray as xr
from mpmath import mp
from scipy.optimize import brentq

import vibroimpact as vi
from literature.comparisons.comparison import Comparison
from reference.impact_orbits import Orbit, Oscillator, doubling, possible_orbits
from reference.public_motion import events

COSINE = -math.pi / 2
"""-A sin(θ + this) = A cos θ."""

# --- H. Dankowicz and F. Schilder: x″ = A cos ωt - c x′ - k x, k = A = ω = 1, c = 0.1, stop at 1

COCO = "Dankowicz and Schilder 2013"
COCO_RIG = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), vi.RigidStop(0.8, 1.0))
COCO_SHAKEN = vi.Harmonic(1.0, 0.5 / math.pi, -math.pi + COSINE)
COCO_START = vi.State(-0.98, -0.29)
"""At θ = ±π."""


@cache
def _coco_orbit() -> xr.Dataset:
    return vi.orbit(vi.Rig(COCO_RIG, COCO_SHAKEN), COCO_START)


def _coco_impact() -> tuple[float, float]:
    """θ, and the velocity after the impact."""
    (impact,) = events(_coco_orbit())
    return impact.time - math.pi, -0.8 * impact.v


@cache
def coco_grazing() -> float:
    """The amplitude at which the family of this orbit grazes."""
    data = vi.branch(vi.Rig(COCO_RIG, COCO_SHAKEN), COCO_START, vary={"amplitude": (0.05, 1.0)})
    grazings = data["bifurcation_value"].values[data["bifurcation_kind"].values == "grazing"]
    return float(grazings[np.abs(grazings - 0.1).argmin()])


_COCO = [
    Comparison(
        COCO,
        "first orbit, x at θ = π",
        "-0.98",
        lambda: float(_coco_orbit()["final_state"][0]),
    ),
    Comparison(
        COCO,
        "first orbit, x′ at θ = π",
        "-0.29",
        lambda: float(_coco_orbit()["final_state"][1]),
    ),
    Comparison(COCO, "first orbit, θ of the impact", "0.076", lambda: _coco_impact()[0]),
    Comparison(COCO, "first orbit, x′ after the impact", "-1.36", lambda: _coco_impact()[1]),
    Comparison(
        COCO,
        "its family: A at which it grazes",
        "0.1",
        coco_grazing,
        1e-9,
    ),
]

# --- C. Budd and F. Dux: x″ + x = cos ωt, a stop at σ

BUDD_DUX = "Budd and Dux 1994"


def budd_dux_rig(one: Oscillator) -> vi.Oscillator:
    """Of any gap, restitution and damping."""
    stop = vi.RigidStop(one.restitution, one.gap)
    return vi.Oscillator(1.0, vi.Isolator(1.0, one.damping), stop)


def budd_dux_start(orbit: Orbit) -> tuple[vi.Harmonic, vi.State]:
    """A third of the way from one impact to the next."""
    with mp.workdps(30):
        u, v, phase = (float(x) for x in orbit.after(orbit.oscillator.span / 3))
    return vi.Harmonic(1.0, orbit.oscillator.frequency, phase), vi.State(u, v)


@cache
def fastest(one: Oscillator) -> Orbit:
    """Of its orbits with one impact, the one that strikes hardest."""
    with mp.workdps(30):
        return max(possible_orbits(one), key=lambda orbit: orbit.velocity)


def budd_dux_velocity(orbit: Orbit) -> float:
    """Ours, of the impact on an orbit."""
    shaken, start = budd_dux_start(orbit)
    rig = vi.Rig(budd_dux_rig(orbit.oscillator), shaken)
    data = vi.orbit(rig, start, orbit.oscillator.cycles)
    (impact,) = events(data)
    return impact.v


def budd_dux_doubling(one: Oscillator) -> float:
    """The exact frequency (Hz) at which the period of the orbit at ω = 2.3 doubles."""
    with mp.workdps(30):
        return float(doubling(one, 2.2 / math.tau, 2.8 / math.tau))


def budd_dux_doubling_found(one: Oscillator) -> float:
    """The same on a branch of ours."""
    shaken, start = budd_dux_start(fastest(one))
    exact = budd_dux_doubling(one)
    data = vi.branch(
        vi.Rig(budd_dux_rig(one), shaken),
        start,
        vary={"frequency": (0.9 * one.frequency, 1.02 * exact)},
    )
    values = data["bifurcation_value"].values
    values = values[data["bifurcation_kind"].values == "period doubling"]
    return float(values[np.abs(values - exact).argmin()])


def _velocity(omega: float, r: float, sigma: float, n: int) -> Comparison:
    one = Oscillator(omega / math.tau, 0.0, r, sigma, n)
    return Comparison(
        BUDD_DUX,
        f"(1, {n}) orbit, ω = {omega:g}, r = {r:g}, σ = {sigma:g}: velocity of impact",
        lambda: float(fastest(one).velocity),
        lambda: budd_dux_velocity(fastest(one)),
        1e-9,
    )


def _doubling(r: float, sigma: float) -> Comparison:
    one = Oscillator(2.3 / math.tau, 0.0, r, sigma)
    return Comparison(
        BUDD_DUX,
        f"(1, 1) orbit, r = {r:g}, σ = {sigma:g}: ω where its period doubles",
        lambda: math.tau * budd_dux_doubling(one),
        lambda: math.tau * budd_dux_doubling_found(one),
        1e-9,
    )


_BUDD_DUX = [
    _velocity(2.8, 0.8, 0.0, 1),
    _velocity(2.6, 0.9, -0.3, 1),
    _velocity(4.3, 0.8, 0.0, 2),
    _velocity(6.3, 0.8, 0.0, 3),
    _doubling(0.8, 0.0),
    _doubling(0.7, -0.1),
]

# --- J. P. Den Hartog and S. J. Mikina: free within ±G, a spring beyond, F cos ωt on the mass

DEN_HARTOG = "Den Hartog and Mikina 1932"
MASS, STIFFNESS, GAP, FORCE = 2.0, 50.0, 0.1, 3.0
RATE = math.sqrt(STIFFNESS / MASS)
DEAD_ZONE = vi.Oscillator(
    MASS,
    vi.Isolator(0.0, 0.0),
    vi.Bumper(STIFFNESS, 0.0, GAP),
    vi.Bumper(STIFFNESS, 0.0, GAP),
)


def dead_zone_amplitude(ratio: float) -> float:
    """Of the motion in phase at ω = ratio · p; negative where it is against the force.

    With p = √(k/M), it presses the right spring while |t| < t₁,

        u - G = B cos pt + Q cos ωt,    Q = F/(k - M ω²),    B cos pt₁ + Q cos ωt₁ = 0,

    and flies through u(T/4) = 0 with

        u = -F/(M ω²) cos ωt + V (t - T/4).

    u = G and one velocity at t₁ leave one equation for t₁. The amplitude is G + B + Q.
    """
    omega = ratio * RATE
    quarter = math.pi / (2 * omega)
    swing = FORCE / (STIFFNESS - MASS * omega**2)

    def parts(t: float) -> tuple[float, float]:
        return (
            -swing * math.cos(omega * t) / math.cos(RATE * t),
            (GAP + FORCE / (MASS * omega**2) * math.cos(omega * t)) / (t - quarter),
        )

    def gap_of_velocity(t: float) -> float:
        b, v = parts(t)
        inside = -b * RATE * math.sin(RATE * t) - swing * omega * math.sin(omega * t)
        return inside - (FORCE / (MASS * omega) * math.sin(omega * t) + v)

    # The contact lasts at most to the quarter, and longer than a quarter of the spring's period.
    low, high = math.pi / (2 * RATE) * (1 + 1e-9), quarter * (1 - 1e-9)
    t = brentq(gap_of_velocity, low, high, xtol=1e-15, rtol=1e-14)
    return GAP + parts(t)[0] + swing


def dead_zone_shaken(ratio: float) -> vi.Harmonic:
    """A force F cos ωt."""
    return vi.Harmonic(FORCE, ratio * RATE / math.tau, math.pi / 2, of="force")


def dead_zone_orbit(ratio: float) -> xr.Dataset:
    """Ours, from the closed form."""
    return vi.orbit(
        vi.Rig(DEAD_ZONE, dead_zone_shaken(ratio)), vi.State(dead_zone_amplitude(ratio), 0.0)
    )


def _dead_zone(ratio: float) -> Comparison:
    return Comparison(
        DEN_HARTOG,
        f"dead zone: amplitude (m) at ω/p = {ratio:g}",
        lambda: dead_zone_amplitude(ratio),
        lambda: float(dead_zone_orbit(ratio)["displacement_max"]),
        1e-9,
    )


# --- T. Schwager and T. Pöschel: a spring and a dashpot that are left where the force is zero

SCHWAGER = "Schwager and Pöschel 2007"


def schwager_poeschel(nominal: float) -> float:
    """Restitution with a dashpot sized by z = -ln e / √(π² + ln² e) for a nominal e.

    With β = z ω₀ and ω = √(ω₀² - β²) it is exp(-β/ω (π - arctan(2 β ω/(ω² - β²)))), ω > β.
    """
    z = -math.log(nominal) / math.hypot(math.pi, math.log(nominal))
    w = math.sqrt(1.0 - z * z)
    assert w > z
    return math.exp(-z / w * (math.pi - math.atan2(2.0 * z * w, w * w - z * z)))


def bounced(nominal: float, stiffness: float = 1e10) -> float:
    """Ours: a mass that meets such a bumper, on an isolator that is softer by that factor."""
    z = -math.log(nominal) / math.hypot(math.pi, math.log(nominal))
    stop = vi.Bumper(stiffness, 2.0 * z * math.sqrt(stiffness), 0.0)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), stop)
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(0.0, 1.0)), 0.5, vi.State(0.0, 1.0), samples=1)
    left = data["event_contact"].values == 0
    return -float(data["event_velocity"].values[left][0])


def _restitution(nominal: float) -> Comparison:
    return Comparison(
        SCHWAGER,
        f"restitution of a spring and dashpot sized for {nominal:g}",
        lambda: schwager_poeschel(nominal),
        lambda: bounced(nominal),
        1e-8,
    )


COMPARISONS = [
    *_COCO,
    *_BUDD_DUX,
    *(_dead_zone(ratio) for ratio in (0.35, 0.6, 0.9)),
    *(_restitution(nominal) for nominal in (0.3, 0.5, 0.7, 0.9)),
]
