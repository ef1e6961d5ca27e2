"""Extremes and contacts of random motions against a multitude of samples.

Between two samples h apart, a displacement whose rate vanishes inside is at most
max |ü| (h/2)²/2 beyond the nearer one. The largest sample can thus be no larger than the maximum,
nor smaller by more than that.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from samples import sample

MASS, STIFFNESS = 64.0, 7e3
ROUNDING = 1e-12

Stop = vi.Bumper | vi.PowerBumper | vi.JankowskiBumper | vi.RigidStop


def hard(rng: np.random.Generator) -> tuple[float, float]:
    """Stiffness, 1e7 to 3e8 N/m^1.5, and gap, 0.5 to 10 mm, of a hard stop."""
    return 10.0 ** rng.uniform(7.0, math.log10(3e8)), 10.0 ** rng.uniform(-3.3, -2.0)


def restitution(rng: np.random.Generator) -> Stop:
    stiffness, gap = hard(rng)
    return vi.PowerBumper(stiffness, gap, restitution=0.7)


def preloaded(rng: np.random.Generator) -> Stop:
    stiffness, gap = hard(rng)
    return vi.PowerBumper(stiffness, -gap, restitution=0.7)


def dissipation(rng: np.random.Generator) -> Stop:
    stiffness, gap = hard(rng)
    return vi.PowerBumper(stiffness, gap, dissipation=rng.uniform(0.0, 3.0))


def jankowski(rng: np.random.Generator) -> Stop:
    stiffness, gap = hard(rng)
    return vi.JankowskiBumper(stiffness, gap, 0.7, MASS)


def dashpot(rng: np.random.Generator) -> Stop:
    _, gap = hard(rng)
    return vi.Bumper(10.0 ** rng.uniform(4.0, 6.0), rng.uniform(0.0, 2e3), gap)


def rigid(rng: np.random.Generator) -> Stop:
    _, gap = hard(rng)
    return vi.RigidStop(rng.uniform(0.3, 0.9), gap)


FAMILIES = [restitution, preloaded, dissipation, jankowski, dashpot, rigid]


def rig_of(
    family: Callable[[np.random.Generator], Stop], sides: str, rng: np.random.Generator
) -> tuple[vi.Oscillator, float]:
    """A rig on a drag or, of every third one, on friction; and the size of its gaps (m)."""
    one, other = family(rng), family(rng)
    size = abs(one.gap)
    if sides == "both" and one.gap < 0.0:
        other = other.replace(gap=size + 2e-3)
    isolator = vi.Isolator(STIFFNESS, 50.0, damping_exponent=2)
    if rng.random() < 1.0 / 3.0:
        isolator = vi.FrictionIsolator(STIFFNESS, 50.0, 0.1 * STIFFNESS * size)
    right, left = (None, one) if sides == "left" else (one, other if sides == "both" else None)
    return vi.Oscillator(MASS, isolator, right, left), size


def within(value: float, seen: float, most: float, size: float) -> None:
    """Assert that an extreme is above its samples, by no more than can lie between them."""
    assert -ROUNDING * size <= value - seen <= most + ROUNDING * size, (value, seen, most)


def check_extremes(exact: xr.Dataset, motion: xr.Dataset, base: float) -> float:
    """Compare extremes with samples; return a bound on |ü| of a base that moves by so much."""
    seen = np.concatenate([motion["displacement"].values, motion["event_displacement"].values])
    names = ("acceleration", "event_acceleration_before", "event_acceleration_after")
    felt = np.concatenate([motion[name].values for name in names])
    high, low = (float(exact[f"acceleration_{end}"]) for end in ("max", "min"))
    sharpest = max(abs(high), abs(low)) + base
    most = 0.125 * sharpest * float(motion["time"][1]) ** 2
    size = float(np.abs(seen).max())
    within(float(exact["displacement_max"]), seen.max(), most, size)
    within(-float(exact["displacement_min"]), -seen.min(), most, size)
    assert float(exact["eccentricity"]) == pytest.approx(
        0.5 * (seen.max() + seen.min()), abs=most + ROUNDING * size
    )
    slack = 1e-9 * float(np.abs(felt).max())
    assert high >= felt.max() - slack
    assert low <= felt.min() + slack
    return sharpest


def check_contacts(log: xr.Dataset, motion: xr.Dataset, rig: vi.Oscillator, sharpest: float) -> int:
    """Compare the penetration of each contact with its samples; return how many there are."""
    time, u = motion["time"].values, motion["displacement"].values
    event_time, event_u = motion["event_time"].values, motion["event_displacement"].values
    step, size = time[1], float(np.abs(u).max())
    columns = ("stop", "start", "end", "penetration")
    rows = zip(*(log[f"contact_{name}"].values for name in columns), strict=True)
    count = 0
    stops = {"right": (1.0, rig.right), "left": (-1.0, rig.left)}
    for name, start, end, penetration in rows:
        side, stop = stops[name]
        if isinstance(stop, vi.RigidStop):
            continue
        inside = slice(*np.searchsorted(time, [start, end]))
        ends = [event_u[np.argmin(np.abs(event_time - one))] for one in (start, end)]
        seen = side * np.concatenate([u[inside], ends]) - stop.gap
        between = 0.125 * sharpest * min(step, end - start) ** 2
        within(penetration, max(seen.max(), 0.0), between, size)
        count += 1
    begun = motion["event_contact"].values == 1
    for name, (_, stop) in stops.items():
        if stop is not None and not isinstance(stop, vi.RigidStop):
            begins = motion["event_time"].values[begun & (motion["event_stop"].values == name)]
            listed = log["contact_start"].values[log["contact_stop"].values == name]
            assert len(begins) - 1 <= len(listed) <= len(begins)  # the end may cut the last one
            np.testing.assert_allclose(listed, begins[: len(listed)], rtol=1e-13, atol=1e-15)
    return count


@pytest.mark.parametrize("sides", sample(["right", "left", "both"], ["both"]))
@pytest.mark.parametrize("family", FAMILIES, ids=lambda one: one.__name__)
def test_extremes_and_contacts_of_random_motions(family, sides: str) -> None:
    rng = np.random.default_rng(7)
    contacts = 0
    for _ in range(6):
        rig, size = rig_of(family, sides, rng)
        frequency = rig.angular_frequency / math.tau * rng.uniform(0.25, 1.1)
        force = STIFFNESS * size * rng.uniform(0.9, 1.3)
        start = None
        if family is preloaded and sides != "both":
            start = vi.State((-2.0 if sides == "right" else 2.0) * size)  # off the stop
        motion = vi.simulate(
            vi.Rig(rig, vi.Harmonic(force, frequency, of="force")), 40, start, samples=1024
        )
        assert motion["status"] == 0
        sharpest = check_extremes(vi.totals(motion), motion, 0.0)
        contacts += check_contacts(vi.contacts(motion), motion, rig, sharpest)
    assert contacts > 150 or family is rigid


def test_extremes_after_a_turn_in_contact() -> None:
    """A drag turns where the stop is pressed most, and the way back takes the phase to its end."""
    rng = np.random.default_rng(3)
    for _ in range(sample(140, 20)):
        stiffness = 10.0 ** rng.uniform(7.0, math.log10(3e8))
        gap = 10.0 ** rng.uniform(math.log10(0.5e-3), -2.0)
        isolator = vi.Isolator(STIFFNESS, 50.0, damping_exponent=2)
        rig = vi.Oscillator(MASS, isolator, vi.PowerBumper(stiffness, gap, restitution=0.7))
        force = STIFFNESS * gap * rng.uniform(0.9, 1.3)
        frequency = rig.angular_frequency / math.tau * rng.uniform(0.3, 0.9)
        shaken = vi.Harmonic(force, frequency, of="force")
        motion = vi.simulate(vi.Rig(rig, shaken), 40, samples=1024)
        sharpest = check_extremes(vi.totals(motion), motion, 0.0)
        check_contacts(vi.contacts(motion), motion, rig, sharpest)


@pytest.mark.parametrize("sides", ["right", "left", "both"])
def test_extremes_of_steady_motions(sides: str) -> None:
    rng = np.random.default_rng(11)
    for _ in range(6):
        rig, size = rig_of(restitution, sides, rng)
        frequency = rig.angular_frequency / math.tau * rng.uniform(0.3, 0.9)
        shaken = vi.Harmonic(STIFFNESS * size * rng.uniform(0.9, 1.3), frequency, of="force")
        motion = vi.steady(vi.Rig(rig, shaken), samples=1024)
        check_extremes(motion, motion, 0.0)


@pytest.mark.parametrize("sides", ["right", "left", "both"])
@pytest.mark.parametrize("family", [restitution, jankowski, dissipation], ids=lambda f: f.__name__)
def test_extremes_through_a_record(family, sides: str) -> None:
    rng = np.random.default_rng(5)
    for _ in range(4):
        rig, size = rig_of(family, sides, rng)
        step = 0.1 / rig.angular_frequency
        pull = STIFFNESS * size / MASS * np.cumsum(rng.normal(0.0, 0.3, 200))
        shaken = vi.Rig(rig, vi.Record(pull - pull.mean(), step))
        motion = vi.simulate(shaken, tail=1.0, samples=64)
        exact, log = vi.totals(motion), vi.contacts(motion)
        sharpest = check_extremes(exact, motion, float(np.abs(pull - pull.mean()).max()))
        check_contacts(log, motion, rig, sharpest)
        response = vi.seismic_response(shaken, tail=1.0)
        peak = max(float(exact["displacement_max"]), -float(exact["displacement_min"]))
        assert float(response["peak_displacement"]) == pytest.approx(peak, rel=1e-9)
        felt = max(float(exact["acceleration_max"]), -float(exact["acceleration_min"]))
        assert float(response["peak_acceleration"]) == pytest.approx(felt, rel=1e-9)
        lost = float(exact["total_bumpers"])
        assert float(response["total_bumpers"]) == pytest.approx(lost, rel=1e-8, abs=1e-12)
