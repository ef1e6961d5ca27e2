"""A constant force: the same as shifted gaps on a linear spring; and a bouncing mass.

With w = u - F/K the equation of motion has no force, and the gaps are G_R - F/K and G_L + F/K.
Without a spring a force is a weight. Above a floor the mass then flies in parabolas: dropped from h
it hits at √(2h/g) with v = √(2gh), comes back after 2 e v/g, then after 2 e² v/g, and rests from

    √(2h/g) + 2 e v / (g (1 - e))

on. On a floor shaken with A sin θ it may hit once a cycle: it leaves with w = e g T/(1 + e), so
that it loses as much in an impact as it gains, where cos θ = -(π g/A) (1 - e)/(1 + e).
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from reference.paper_signs import start as start_at
from reference.public_motion import events

MASS, STIFFNESS, FORCE = 2.0, 8.0, 1.0
SHIFT = FORCE / STIFFNESS
BUMPERS = (vi.Bumper(160.0, 3.0, 0.3), vi.Bumper(120.0, 2.0, 0.4))
WALLS = (vi.RigidStop(0.7, 0.3), vi.RigidStop(0.5, 0.4))
SHAKEN = vi.Harmonic(1.2, 0.4, 0.2)


def pair(stops) -> tuple[vi.Oscillator, vi.Oscillator]:
    """A rig with the force, and one with shifted gaps."""
    right, left = stops
    isolator = vi.Isolator(STIFFNESS, 0.8)
    moved = (
        right and right.replace(gap=right.gap - SHIFT),
        left and left.replace(gap=left.gap + SHIFT),
    )
    return vi.Oscillator(MASS, isolator, *stops, force=FORCE), vi.Oscillator(MASS, isolator, *moved)


STOPS = {"bumpers": BUMPERS, "walls": WALLS, "one": (BUMPERS[0], None)}


@pytest.mark.parametrize("name", STOPS)
@pytest.mark.parametrize("shaken", [SHAKEN, vi.Periodic(0.3, (1.0, 0.4), (0.0, 1.0))])
def test_it_shifts_the_gaps(name: str, shaken) -> None:
    forced, shifted = pair(STOPS[name])
    one = vi.simulate(vi.Rig(forced, shaken), 6, samples=16)
    other = vi.simulate(vi.Rig(shifted, shaken), 6, samples=16)
    assert one.sizes["event"] == other.sizes["event"] > 5
    size, speed = (float(np.abs(other[n]).max()) for n in ("displacement", "velocity"))
    np.testing.assert_allclose(
        one["displacement"] - SHIFT, other["displacement"], rtol=0.0, atol=1e-13 * size
    )
    for variable in ("velocity", "acceleration"):
        unit = float(np.abs(other[variable]).max())
        np.testing.assert_allclose(one[variable], other[variable], rtol=0.0, atol=1e-12 * unit)
    np.testing.assert_allclose(one["event_time"], other["event_time"], atol=1e-12)
    np.testing.assert_allclose(
        one["event_velocity"], other["event_velocity"], rtol=0.0, atol=1e-12 * speed
    )


def test_a_record_sees_it_likewise() -> None:
    record = vi.Record(np.random.default_rng(2).uniform(-6.0, 6.0, 80), 0.1)
    one, other = (vi.simulate(vi.Rig(rig, record)) for rig in pair(WALLS))
    np.testing.assert_allclose(one["displacement"] - SHIFT, other["displacement"], atol=1e-13)
    assert one.sizes["event"] == other.sizes["event"] > 5


def test_a_sweep_and_orbits_see_it_likewise() -> None:
    forced, shifted = pair(BUMPERS)
    grid = np.linspace(0.25, 0.55, 7)
    one, other = (vi.sweep(vi.Rig(rig, 1.2), grid) for rig in (forced, shifted))
    assert float(one["impacts"].sel(stop="right").max()) >= 1
    for name in ("displacement_excursion", "acceleration_excursion", "eta_d", "eta_a"):
        np.testing.assert_allclose(one[name], other[name], rtol=1e-11)
    np.testing.assert_allclose(one["eccentricity"] - SHIFT, other["eccentricity"], atol=1e-11)
    np.testing.assert_array_equal(one["motion"], other["motion"])
    orbits = [vi.orbit(vi.Rig(rig, SHAKEN)) for rig in (forced, shifted)]
    for part in ("real", "imag"):
        np.testing.assert_allclose(*(one[f"multiplier_{part}"] for one in orbits), atol=1e-11)
    np.testing.assert_allclose(
        orbits[0]["final_state"].values[:4] - [SHIFT, 0, 0, 0],
        orbits[1]["final_state"].values[:4],
        atol=1e-12,
    )


def test_a_branch_over_the_force_is_one_over_the_gap() -> None:
    """It grazes where the free flight is pushed against the bumper."""
    rig = vi.Oscillator(MASS, vi.Isolator(STIFFNESS, 0.4), vi.Bumper(160.0, 3.0, 0.5), force=-0.4)
    turn = SHAKEN.angular_frequency
    swing = SHAKEN.amplitude / abs(complex(STIFFNESS / MASS - turn**2, 0.2 * turn))
    free = vi.simulate(vi.Rig(rig.without_bumpers(), SHAKEN), 400, samples=0)["final_state"].values
    start = vi.State(free[0], free[1], phase=free[4])
    over = vi.branch(vi.Rig(rig, SHAKEN), start, vary={"force": (-0.8, 1.2)})
    kinds = over["bifurcation_kind"].values
    grazings = over["bifurcation_value"].values[kinds == "grazing"]
    assert np.abs(grazings - STIFFNESS * (0.5 - swing)).min() < 1e-11

    u, v, phase = start.displacement, start.velocity, start.phase
    bare = rig.replace(force=0.0, right=rig.right.replace(gap=0.5 + 0.4 / STIFFNESS))
    moved = vi.State(u + 0.4 / STIFFNESS, v, phase=phase)
    low, high = 0.5 - 1.2 / STIFFNESS, 0.5 + 0.8 / STIFFNESS
    gap = vi.branch(vi.Rig(bare, SHAKEN), moved, vary={"gap": (low, high)})
    for kind in set(kinds.tolist()):
        values = np.sort(over["bifurcation_value"].values[kinds == kind])
        same = gap["bifurcation_value"].values[gap["bifurcation_kind"].values == kind]
        np.testing.assert_allclose(
            values, np.sort((0.5 - same) * STIFFNESS), rtol=0.0, atol=1e-9, err_msg=kind
        )
    assert over["impacts"].sel(stop="right").values.max() >= 1
    # Any orbit of it closes.
    for i in range(0, over.sizes["point"], max(1, over.sizes["point"] // 5)):
        here = rig.replace(force=float(over["force"][i]))
        section = over["section"].values[i]
        begin = start_at(section)
        end = vi.simulate(vi.Rig(here, SHAKEN), 1, begin, samples=0)["final_state"].values
        np.testing.assert_allclose(end[:4], section[:4], atol=1e-10)


G = 9.80665
FLOOR = vi.Oscillator(MASS, vi.Isolator(0.0, 0.0), None, vi.RigidStop(0.6, 0.0), force=-MASS * G)


@pytest.mark.parametrize("e", [0.0, 0.3, 0.6, 0.95])
def test_a_dropped_mass_bounces_to_rest(e: float) -> None:
    rig, h = FLOOR.replace(left=vi.RigidStop(e, 0.0)), 1.3
    first, v = math.sqrt(2 * h / G), math.sqrt(2 * h * G)
    total = first + 2 * e * v / (G * (1 - e))
    data = vi.simulate(
        vi.Rig(rig, vi.Harmonic(0.0, 1 / (1.5 * total))), 1, vi.State(h), samples=1000
    )
    seen = events(data)
    assert [one.kind for one in seen[:-1]] == ["impact_left"] * (len(seen) - 1)
    assert seen[-1].kind == "contact_left"
    assert seen[-1].time == pytest.approx(total, rel=1e-12)
    hits = [first + 2 * v / G * sum(e**k for k in range(1, n + 1)) for n in range(len(seen) - 1)]
    for n, (one, at) in enumerate(zip(seen[:-1], hits, strict=True)):
        assert one.time == pytest.approx(at, rel=1e-12)
        assert one.v == pytest.approx(-v * e**n, rel=1e-9)
    assert len(hits) >= (1 if e == 0.0 else 5)
    time = data["time"].values
    flown = time < hits[-1]
    last = np.searchsorted(hits, time[flown], side="right") - 1
    since = time[flown] - np.array([0.0, *hits])[last + 1]
    up = np.array([0.0, *(v * e ** (n + 1) for n in range(len(hits)))])[last + 1]
    high = np.where(last < 0, h, 0.0)
    np.testing.assert_allclose(
        data["displacement"].values[flown], high + up * since - G * since**2 / 2, atol=1e-12
    )
    still = time > total
    assert still.sum() > 100
    for name, value in (("displacement", 0.0), ("velocity", 0.0), ("acceleration", 0.0)):
        np.testing.assert_array_equal(data[name].values[still], value)
    assert data["touching"].sel(stop="left").values[still].all()


@pytest.mark.parametrize("of", ["acceleration", "displacement"])
def test_a_mass_bounces_once_a_cycle_on_a_shaken_floor(of: str) -> None:
    e, frequency, amplitude = 0.6, 2.0, 8.0
    omega, period = math.tau * frequency, 1 / frequency
    # Of the two the one with the base moving up ever more slowly is stable.
    angle = -math.acos(-math.pi * G / amplitude * (1 - e) / (1 + e))
    up = e * G * period / (1 + e)
    shaken = vi.Harmonic(amplitude, frequency, angle)
    if of == "displacement":  # the acceleration of X sin θ is -X ω² sin θ
        shaken = vi.Harmonic(amplitude / omega**2, frequency, angle + math.pi, of="displacement")

    def flight(t):
        sine, cosine = np.sin(angle + omega * t), np.cos(angle + omega * t)
        u = up * t - G * t**2 / 2 + amplitude * (sine - math.sin(angle)) / omega**2
        u -= amplitude * math.cos(angle) / omega * t
        return u, up - G * t + amplitude * (cosine - math.cos(angle)) / omega

    data = vi.simulate(vi.Rig(FLOOR, shaken), 10, vi.State(0.0, up), samples=50)
    impacts = events(data)
    assert [one.kind for one in impacts[:9]] == ["impact_left"] * 9
    np.testing.assert_allclose(
        [one.time for one in impacts[:9]], period * np.arange(1, 10), rtol=1e-12
    )
    np.testing.assert_allclose([one.v for one in impacts[:9]], -up / e, rtol=1e-11)
    u, v = flight(data["time"].values[:50])
    np.testing.assert_allclose(data["displacement"][:50], u, atol=1e-14)
    np.testing.assert_allclose(data["velocity"][1:50], v[1:], atol=1e-13)
    # As a fixed point of the map, seen a third of a cycle behind the impact.
    u, v = flight(period / 3)
    later = shaken.replace(phase=shaken.phase + math.tau / 3)
    orbit = vi.orbit(vi.Rig(FLOOR, later), vi.State(u, v))
    np.testing.assert_allclose(orbit["final_state"].values[:2], [u, v], atol=1e-12)
    moduli = np.hypot(orbit["multiplier_real"], orbit["multiplier_imag"]).values[:2]
    assert moduli.prod() == pytest.approx(e**2, rel=1e-10)
    # Trace of the saltation matrix times the flight (1 T; 0 1): the jump of acceleration over v.
    jump = (1 + e) * (-G - amplitude * math.sin(angle)) / (-up / e)
    trace = complex(*(orbit[f"multiplier_{part}"].values.sum() for part in ("real", "imag")))
    assert trace == pytest.approx(-2 * e + jump * period, rel=1e-9)


def test_a_fall_through_a_thick_fluid_on_a_weak_spring_keeps_its_digits():
    """Slower than its dashpot's rate the spring's rest, 10⁸ m away, is not felt by what is near."""
    k, c, g, t = 1e-7, 5.0, 9.81, 25.0
    fast = 0.5 * c + math.sqrt(0.25 * c * c - k)
    slow = k / fast
    expected = -g * (-math.expm1(-slow * t) / k - math.exp(-slow * t) / (fast * (fast - slow)))
    rig = vi.Oscillator(1.0, vi.Isolator(k, c), force=-g)
    fallen = vi.simulate(vi.Rig(rig, vi.Harmonic(0.0, 1.0 / t)), 1, vi.State(0.0), samples=0)
    end = float(fallen["final_state"].sel(component="displacement"))
    assert end == pytest.approx(expected, rel=1e-13)
