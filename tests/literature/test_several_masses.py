"""Published numbers of systems of two masses, and of a ball in a cavity."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from literature.comparisons import assemblies as known

TURN = 2.0 * math.pi


def bifurcations(branch: xr.Dataset) -> list[tuple[str, float]]:
    """Kinds and values, in their order along the branch."""
    kinds, values = branch["bifurcation_kind"].values, branch["bifurcation_value"].values
    return [(str(kind), float(value)) for kind, value in zip(kinds, values, strict=True)]


def test_where_a_ball_in_a_shaken_cavity_gains_and_loses_stability() -> None:
    """Walls at ±b, restitution e: stable between a fold and a breaking of the symmetry.

    With σ = 2 (1 − e)/(π (1 + e)) and A² = (y − b)² + σ² y² these are at y = b/(1 + σ²) and at
    y = π² b/(π² − 4).
    """
    e, b = 0.6, 1.0
    sigma = 2.0 * (1.0 - e) / (math.pi * (1.0 + e))

    def amplitude(y: float) -> float:
        return math.hypot(y - b, sigma * y)

    (fold, lowest), (breaking, highest) = bifurcations(known.cavity())
    assert (fold, breaking) == ("fold", "symmetry breaking")
    assert lowest == pytest.approx(0.157177, abs=6e-7)
    assert highest == pytest.approx(0.732140, abs=6e-7)
    assert lowest == pytest.approx(amplitude(b / (1.0 + sigma**2)), rel=1e-9)
    assert highest == pytest.approx(amplitude(math.pi**2 * b / (math.pi**2 - 4.0)), rel=1e-9)


def test_two_masses_with_mutual_stops_of_pwsdde_cont() -> None:
    """PWSDDE-cont's impact Duffing system without its cubic terms, at ω = 1.5."""
    mu, r = 0.05, 0.9
    orbit = known.absorber()
    assert int(orbit["stable"]) == 1
    assert orbit.sizes["event"] == 2
    (at,) = np.flatnonzero(orbit["event_stop"].values == "up")
    start = orbit["event_displacement"].isel(event=at)
    one, two = (float(start.sel(mass=name)) for name in ("one", "two"))
    assert one == pytest.approx(0.63811168, abs=1e-8)
    assert two - one == pytest.approx(1.0, abs=1e-12)
    # The velocities before the impact, with its own law after it.
    before = orbit["event_velocity"].isel(event=at).sel(mass=["one", "two"]).values
    common = (before[0] + mu * before[1]) / (1.0 + mu)
    after = (1.0 + r) * common - r * before
    assert after == pytest.approx([-0.20442210, -1.45956553], abs=1e-8)


def test_an_unstable_orbit_of_an_impact_damper() -> None:
    """Two impacts a period, each half a period after the other, known in closed form: V."""
    zeta, mu, e, d, speed = 0.05, 0.1, 0.6, 8.0, 5.59418674
    wall = vi.RigidStop(e, d / 2.0)
    damper = vi.Assembly(
        {"host": 1.0, "ball": mu},
        links={"spring": vi.Link("ground", "host", vi.Isolator(1.0, 2.0 * zeta))},
        stops={"right": vi.Link("ball", "host", wall), "left": vi.Link("host", "ball", wall)},
        units="none",
    )
    h, omega = math.pi, math.sqrt(1.0 - zeta**2)
    decay, turn = math.exp(-zeta * h), omega * h
    q = 1.0 + 2.0 * decay * math.cos(turn) + decay**2
    g0 = -decay * math.sin(turn) / (omega * q)
    g1 = (1.0 + decay * math.cos(turn) + zeta / omega * decay * math.sin(turn)) / q
    size = 1.0 / (2.0 * zeta)  # of the host alone, a quarter of a period late
    a = math.pi / 2.0 - 2.0 * mu * g0
    b = (1.0 - e * (1.0 + 2.0 * mu)) / (1.0 + e) + 2.0 * mu * g1
    assert (a * speed - d / 2) ** 2 + (b * speed) ** 2 == pytest.approx(size**2, rel=1e-8)
    alpha = math.atan2(a * speed - d / 2, -b * speed)
    x = size * math.sin(alpha) + 2.0 * mu * speed * g0
    v = size * math.cos(alpha) + 2.0 * mu * speed * g1
    # The section is a little after the impact on the right, where the ball flies on.
    later = 1e-3
    force = vi.Harmonic(1.0, 1.0 / TURN, alpha + math.pi / 2, of="force", on="host")
    start = vi.State(
        displacement={"host": x, "ball": x + d / 2},
        velocity={"host": v, "ball": -speed},
    )
    rig = vi.Rig(damper, force)
    flown = vi.simulate(rig, later, start, samples=0)
    orbit = vi.orbit(rig, flown)
    assert int(orbit["stable"]) == 0
    right = orbit["event_stop"].values == "right"
    assert orbit.sizes["event"] == 2
    ball = orbit["event_velocity"].sel(mass="ball").values[right]
    assert ball == pytest.approx([speed], abs=1e-8)


def test_bifurcations_of_nlvibs_unilateral_spring() -> None:
    """NLvib's example 03: stable near Ω = 0.635, Neimark–Sacker near 0.62, doubling near 0.74."""
    rig, branch = known.rig_at_one_sided_spring(), known.one_sided_spring()
    places = [(kind, TURN * value) for kind, value in bifurcations(branch)]
    (torus,) = (value for kind, value in places if kind == "Neimark-Sacker")
    doubling = min(value for kind, value in places if kind == "period doubling")
    assert torus == pytest.approx(0.62, abs=0.005)
    assert doubling == pytest.approx(0.74, abs=0.005)
    beside = vi.orbit(rig, frequency=0.635 / TURN)
    assert int(beside["stable"]) == 1
    assert beside.sizes["event"] == 2
