"""`simulate` of assemblies: one mass as an oscillator, several against other computations."""

from __future__ import annotations

import json
import math
import warnings
from typing import Any

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import solve_ivp

import vibroimpact as vi
from engine.assembly.exact import Exact
from vibroimpact.engine.assembly.plan import GROUND, Forcing, Stop, base_motion, record_motion

SPRING = vi.Isolator(26_290.0, 1_140.0)
BUMPER = vi.Bumper(510e3, 737.66, 7.5e-3)
ELASTIC = vi.Bumper(510e3, 0.0, 7.5e-3)
WALL = vi.RigidStop(0.6, 5e-3)


def one_mass(right: Any, left: Any, force: float = 0.0) -> tuple[vi.Oscillator, vi.Assembly]:
    stops = {}
    if right is not None:
        stops["right"] = vi.Link("m", "ground", right)
    if left is not None:
        stops["left"] = vi.Link("ground", "m", left)
    return (
        vi.Oscillator(550.0, SPRING, right, left, force=force),
        vi.Assembly({"m": 550.0}, {"k": vi.Link("ground", "m", SPRING)}, stops, {"m": force}),
    )


def near(found: xr.DataArray, expected: xr.DataArray, tolerance: float = 1e-12) -> None:
    assert found.shape == expected.shape
    size = float(abs(expected).max()) or 1.0
    assert float(abs(found.values - expected.values).max()) <= tolerance * size


QUAKE = vi.Record(2.0 * np.sin(np.arange(300) * 0.21) * np.sin(np.arange(300) * 0.013), 0.02)

SHAKING = {
    "acceleration": vi.Harmonic("0.05 g", 1.1, 0.4),
    "displacement": vi.Periodic(1.3, ["6 mm", "2 mm"], [0.2, 0.5], 0.3),
    "force": vi.Periodic(1.2, ["400 N", "0 N", "90 N"], [0.2, 0.5, 1.0]),
    "unbalance": vi.Periodic(1.4, ["5 kg m", "0.6 kg m"]),
    "record": QUAKE,
}


@pytest.mark.parametrize("stops", ["bumpers", "elastic", "walls", "one wall"])
@pytest.mark.parametrize("what", SHAKING)
def test_one_mass_is_an_oscillator(what: str, stops: str) -> None:
    right, left = {
        "bumpers": (BUMPER, BUMPER.replace(gap=4e-3)),
        "elastic": (ELASTIC, BUMPER),
        "walls": (WALL, WALL),
        "one wall": (None, vi.RigidStop(0.8, 4e-3)),
    }[stops]
    oscillator, assembly = one_mass(right, left, 20.0)
    given = {"samples": 3, "tail": 0.313} if what == "record" else {"cycles": 12.3}
    plain = vi.simulate(vi.Rig(oscillator, SHAKING[what]), **given)
    found = vi.simulate(vi.Rig(assembly, SHAKING[what]), **given)
    assert len(plain["event_time"]) >= 8
    np.testing.assert_array_equal(found["time"], plain["time"])
    for name in ("displacement", "velocity", "acceleration"):
        near(found[name].sel(mass="m"), plain[name])
        assert found[name].attrs == plain[name].attrs
    near(found["transmitted_force"], plain["transmitted_force"])
    shaken = "applied_force" if what in ("force", "unbalance") else "base_acceleration"
    near(found[shaken], plain[shaken], 1e-15)
    for side in assembly.stops:
        near(found["clearance"].sel(stop=side), plain[f"{side}_clearance"])
        sign = 1.0 if side == "right" else -1.0
        deformation = np.maximum(sign * plain[f"{side}_bumper"], 0.0)
        near(found["deformation"].sel(stop=side), deformation)
    assert found["event_contact"].values.tolist() == plain["event_contact"].values.tolist()
    sides = [{1: "right", -1: "left"}[one] for one in plain["event_side"].values]
    assert found["event_stop"].values.tolist() == sides
    near(found["event_time"], plain["event_time"])
    near(found["event_displacement"].sel(mass="m"), plain["event_displacement"])
    near(found["event_velocity"].sel(mass="m"), plain["event_velocity"])
    assert found["status"] == 0
    assert found["simultaneous_impacts"] == 0


def neighbours() -> vi.Assembly:
    """Two buildings with a bumper between them, one of them at a wall."""
    return vi.Assembly(
        {"low": 1.2, "high": 0.9},
        {
            "low": vi.Link("ground", "low", vi.Isolator(130.0, 0.9)),
            "high": vi.Link("ground", "high", vi.Isolator(222.0, 1.1)),
        },
        {
            "between": vi.Link("low", "high", vi.Bumper(2.5e4, 25.0, 0.012)),
            "wall": vi.Link("ground", "low", vi.RigidStop(0.7, 0.02)),
        },
        {"high": 0.4},
    )


MASS, DAMPING, STIFFNESS = np.diag([1.2, 0.9]), np.diag([0.9, 1.1]), np.diag([130.0, 222.0])
STOPS = [Stop(0, 1, 0.012, 2.5e4, 25.0), Stop(GROUND, 0, 0.02, restitution=0.7)]
DRIVEN = {
    "base": (vi.Harmonic(3.0, 1.9, 0.3), base_motion(MASS, np.ones(2)), 3.0),
    "force": (
        vi.Harmonic("3 N", 1.9, 0.3, on="high"),
        Forcing(np.array([[0.0, 0.0], [1.0, 0.0]])),
        3.0,
    ),
    "unbalance": (
        vi.Harmonic("20 g m", 1.9, 0.3, on="low"),
        Forcing(np.array([[1.0, 0.0], [0.0, 0.0]]), 2),
        0.02,
    ),
}


def against_exact(motion: xr.Dataset, exact: Exact, period: float) -> None:
    assert len(exact.events) >= 10
    assert len({event[2] for event in exact.events}) == 2
    assert len(exact.events) == motion.sizes["event"]
    for i, (section, since, stop, what) in enumerate(exact.events):
        assert motion["event_stop"][i] == ("between", "wall")[stop]
        kind = 0 if what == "free" else 2 - (stop == 0)
        assert motion["event_contact"][i] == kind
        assert motion["event_time"][i] == pytest.approx(section * period + since, abs=1e-11)
    end = motion.isel(time=-1)
    np.testing.assert_allclose(end["displacement"], np.array(exact.y[:2], float), rtol=1e-10)
    np.testing.assert_allclose(end["velocity"], np.array(exact.y[2:4], float), rtol=1e-10)
    found = float(end["deformation"].sel(stop="between"))
    assert found == pytest.approx(float(exact.deformation(0)), rel=1e-9, abs=1e-20)


@pytest.mark.parametrize("what", DRIVEN)
def test_neighbours_in_fifty_digits(what: str) -> None:
    shaking, forcing, amplitude = DRIVEN[what]
    still = vi.State({"low": 0.0, "high": 0.0})
    motion = vi.simulate(vi.Rig(neighbours(), shaking), 8, still, samples=4)
    omega = shaking.angular_frequency
    exact = Exact(
        *(MASS, DAMPING, STIFFNESS, STOPS, forcing, amplitude, omega),
        constant=np.array([0.0, 0.4]),
        grid=2e-3,
    )
    for k in range(8):
        exact.advance(shaking.period, k, (math.sin(0.3), math.cos(0.3)))
    against_exact(motion, exact, shaking.period)


def test_neighbours_under_a_record_in_fifty_digits() -> None:
    values = QUAKE.acceleration[:160] * 2.0
    record = vi.Record(values, 0.02)
    still = vi.State({"low": 0.0})
    motion = vi.simulate(vi.Rig(neighbours(), record), start=still, tail=0.1)
    exact = Exact(
        *(MASS, DAMPING, STIFFNESS, STOPS, record_motion(MASS, np.ones(2), 0.02), 1.0, 0.0),
        constant=np.array([0.0, 0.4]),
        grid=2e-3,
    )
    slopes = np.append(np.diff(values), np.zeros(6)) / 0.02
    for k, slope in enumerate(slopes):
        exact.advance(
            0.02 if k < 164 else 0.1 - 5 * 0.02 or 0.02, k, (values[k] if k < 159 else 0.0, slope)
        )
    against_exact(motion, exact, 0.02)


def test_samples_obey_the_equations() -> None:
    rig = vi.Rig(neighbours(), vi.Harmonic(3.0, 1.9, 0.3))
    motion = vi.simulate(rig, 6)
    force = motion["contact_force"]
    between, wall = (force.sel(stop=name).values for name in ("between", "wall"))
    u, v, a = (motion[x].values for x in ("displacement", "velocity", "acceleration"))
    pushed = np.array([wall - between, between + 0.4])
    wanted = (pushed - STIFFNESS @ u - DAMPING @ v) / np.diag(MASS)[:, None]
    np.testing.assert_allclose(a, wanted, atol=1e-10 * abs(a).max())
    carried = STIFFNESS @ u + DAMPING @ v
    total = carried.sum(0) - wall
    np.testing.assert_allclose(motion["transmitted_force"], total, atol=1e-10 * abs(total).max())
    pressed = between > 0.0
    assert 10 < pressed.sum() < len(pressed)
    d = motion["deformation"].sel(stop="between").values
    law = 2.5e4 * d + 25.0 * (v[0] - v[1])
    np.testing.assert_allclose(between[pressed], law[pressed], atol=1e-10 * law.max())
    clearance = motion["clearance"].sel(stop="between").values
    np.testing.assert_allclose(clearance, 0.012 - (u[0] - u[1]) + d, atol=1e-15)
    assert (clearance >= -1e-16).all()
    assert (clearance[pressed] == 0.0).all()


def test_neighbours_between_events_of_a_general_integrator() -> None:
    """With springs as bumpers, DOP853 needs no memory."""
    assembly = neighbours()
    stops = {
        "between": vi.Link("low", "high", vi.Bumper(2.5e4, 0.0, 0.012)),
        "wall": vi.Link("ground", "low", vi.Bumper(3e4, 0.0, 0.02)),
    }
    assembly = assembly.replace(stops=stops, forces={})
    motion = vi.simulate(vi.Rig(assembly, vi.Harmonic(3.0, 1.9)), 4, samples=64)

    def force(y: Any) -> tuple[float, float]:
        return 2.5e4 * max(y[0] - y[1] - 0.012, 0.0), 3e4 * max(-y[0] - 0.02, 0.0)

    def rate(t: float, y: Any) -> Any:
        p, w = force(y)
        base = 3.0 * math.sin(2 * math.pi * 1.9 * t)
        return [
            *y[2:],
            (-130.0 * y[0] - 0.9 * y[2] - p + w) / 1.2 - base,
            (-222.0 * y[1] - 1.1 * y[3] + p) / 0.9 - base,
        ]

    time = motion["time"].values
    found = solve_ivp(rate, (0, time[-1]), [0.0] * 4, "DOP853", time, rtol=1e-12, atol=1e-14)
    p, w = np.array([force(y) for y in found.y.T]).T
    assert p.max() > 0.0
    assert w.max() > 0.0
    np.testing.assert_allclose(motion["displacement"], found.y[:2], atol=1e-8)
    np.testing.assert_allclose(motion["velocity"], found.y[2:], atol=1e-6)
