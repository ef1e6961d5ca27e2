"""`simulate` of assemblies: one mass as an oscillator, several against other computations."""

from __future__ import annotations

import json
import math
import warnings
from contextlib import nullcontext
from typing import Any

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import solve_ivp

import vibroimpact as vi
from engine.assembly.exact import Exact
from vibroimpact.engine.assembly.plan import GROUND, Forcing, Stop, base_motion, record_motion
from vibroimpact.response.history_variables import busiest_by_mass

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


def near(actual: xr.DataArray, expected: xr.DataArray, tolerance: float = 1e-12) -> None:
    assert actual.shape == expected.shape
    size = float(abs(expected).max()) or 1.0
    assert float(abs(actual.values - expected.values).max()) <= tolerance * size


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
    options = {"samples": 3, "tail": 0.313} if what == "record" else {"cycles": 12.3}
    plain = vi.simulate(vi.Rig(oscillator, SHAKING[what]), **options)
    motion = vi.simulate(vi.Rig(assembly, SHAKING[what]), **options)
    assert len(plain["event_time"]) >= 8
    np.testing.assert_array_equal(motion["time"], plain["time"])
    for name in ("displacement", "velocity", "acceleration"):
        near(motion[name].sel(mass="m"), plain[name])
        assert motion[name].attrs == plain[name].attrs
    near(motion["transmitted_force"], plain["transmitted_force"])
    shaken = "applied_force" if what in ("force", "unbalance") else "base_acceleration"
    near(motion[shaken], plain[shaken], 1e-15)
    for side in assembly.stops:
        near(motion["clearance"].sel(stop=side), plain["clearance"].sel(stop=side))
        near(motion["deformation"].sel(stop=side), plain["deformation"].sel(stop=side))
    assert motion["event_contact"].values.tolist() == plain["event_contact"].values.tolist()
    assert motion["event_stop"].values.tolist() == plain["event_stop"].values.tolist()
    near(motion["event_time"], plain["event_time"])
    near(motion["event_displacement"].sel(mass="m"), plain["event_displacement"])
    near(motion["event_velocity"].sel(mass="m"), plain["event_velocity"])
    assert motion["status"] == 0
    assert motion["simultaneous_impacts"] == 0


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
    deformation = float(end["deformation"].sel(stop="between"))
    assert deformation == pytest.approx(float(exact.deformation(0)), rel=1e-9, abs=1e-20)


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
    # The record is followed by 0.1 s without acceleration.
    slopes = np.append(np.diff(values), np.zeros(5)) / 0.02
    begins = np.append(values[:-1], np.zeros(5))
    for k, line in enumerate(zip(begins, slopes, strict=True)):
        exact.advance(0.02, k, line)
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
    solution = solve_ivp(rate, (0, time[-1]), [0.0] * 4, "DOP853", time, rtol=1e-12, atol=1e-14)
    p, w = np.array([force(y) for y in solution.y.T]).T
    assert p.max() > 0.0
    assert w.max() > 0.0
    np.testing.assert_allclose(motion["displacement"], solution.y[:2], atol=1e-8)
    np.testing.assert_allclose(motion["velocity"], solution.y[2:], atol=1e-6)


def test_restitution_between_free_masses() -> None:
    """Restitution between two free masses: momentum is kept, the relative speed is multiplied."""
    pair = vi.Assembly(
        {"a": 2.0, "b": 3.0},
        stops={"between": vi.Link("a", "b", vi.RigidStop(0.5, 0.1))},
    )
    start = vi.State(velocity={"a": 1.0})
    motion = vi.simulate(vi.Rig(pair), 1, start, frequency=1.0, samples=100)
    assert motion["event_time"].values == pytest.approx([0.1], rel=1e-14)
    assert motion["event_contact"].values.tolist() == [2]
    np.testing.assert_allclose(motion["velocity"].isel(time=-1), [0.1, 0.6], rtol=1e-13)
    at_impact = motion["velocity"].sel(mass="a")[10]
    assert at_impact == pytest.approx(0.1)  # just after the event


def test_rest_between_masses_is_a_contact_of_its_own() -> None:
    """Two carts that an inelastic stop joins until one of them hits a wall."""
    carts = vi.Assembly(
        {"a": 1.0, "b": 1.0},
        {"a": vi.Link("ground", "a", vi.Isolator(40.0, 0.0))},
        {
            "between": vi.Link("a", "b", vi.RigidStop(0.0, 0.0)),
            "wall": vi.Link("b", "ground", vi.RigidStop(0.5, 0.3)),
        },
        {"a": 20.0},
    )
    start = vi.State({"a": -0.4, "b": 0.1})
    with pytest.warns(
        RuntimeWarning, match="impacts at the same instant as another impact or rest"
    ):
        motion = vi.simulate(vi.Rig(carts), 1.0, start, frequency=1.0)
    names, kinds = motion["event_stop"].values.tolist(), motion["event_contact"].values.tolist()
    # a meets b (2), they rest on each other (1) and reach the wall together (0, 2).
    assert names[:4] == ["between", "between", "between", "wall"]
    assert kinds[:4] == [2, 1, 0, 2]
    together = motion["event_velocity"][1]
    assert together[0] == pytest.approx(float(together[1]), rel=1e-14)
    assert together[0] == pytest.approx(float(motion["event_velocity"][0, 0]) / 2.0, rel=1e-13)
    assert motion["event_time"][0] == motion["event_time"][1]
    resting = (motion["time"] > motion["event_time"][1]) & (
        motion["time"] < motion["event_time"][2]
    )
    pressing = motion["contact_force"].sel(stop="between")[resting.values]
    assert len(pressing) > 3
    assert (pressing > 0.0).all()


@pytest.mark.parametrize("restitution", [0.667, 0.949])
def test_a_chatter_is_completed_far_from_the_origin(restitution: float) -> None:
    """Its last flights are lower than the rounding of a displacement, 1.4e-17 m."""
    pair = vi.Assembly(
        {"a": 1.0, "b": 1.0},
        {
            "a": vi.Link("ground", "a", vi.Isolator(5.0, 0.0)),
            "b": vi.Link("ground", "b", vi.Isolator(5.0, 0.0)),
        },
        {
            "between": vi.Link("a", "b", vi.RigidStop(restitution, 0.0)),
            "quick": vi.Link("a", "ground", vi.Bumper(500.0, 0.0, 9.0)),
        },
        {"a": 0.02},
    )
    first = vi.State({"a": 0.1, "b": 0.1}, {"a": 1e-3})
    motion = vi.simulate(vi.Rig(pair), 1.0, first, frequency=0.5)
    assert motion.attrs["message"] == "done"
    # Their distance alone: it is shaken by 0.02 N, and springs back by 5 N/m.
    speed, swing, ends = 1e-3, math.sqrt(5.0), 0.0
    while speed > 1e-12:
        speed *= restitution
        ends += 2.0 * math.atan2(speed * swing, 0.02) / swing
    rests = motion["event_time"].values[motion["event_contact"].values == 1]
    assert rests == pytest.approx([ends], abs=1e-6)  # what is left of it is not followed


def test_a_rest_holds_to_the_last_digit() -> None:
    """On the ground and on each other: no velocity of rounding remains."""
    three = vi.Assembly(
        {"a": 1.7, "b": 0.9, "c": 1.3},
        {
            "a": vi.Link("ground", "a", vi.Isolator(3.0, 0.01)),
            "b": vi.Link("ground", "b", vi.Isolator(4.0, 0.02)),
            "c": vi.Link("b", "c", vi.Isolator(2.0, 0.02)),
        },
        {
            "wall": vi.Link("ground", "a", vi.RigidStop(0.0, 0.1)),
            "between": vi.Link("b", "c", vi.RigidStop(0.3, 0.0)),
        },
        {"a": -2.0, "b": 1.0},
    )
    motion = vi.simulate(vi.Rig(three, vi.Harmonic("0.3 m/s2", 0.3)), 6.0, samples=40)
    touching = motion["contact_force"] > 0.0
    on_wall, joined = touching.sel(stop="wall").values, touching.sel(stop="between").values
    assert on_wall.sum() > 20
    assert joined.sum() > 20
    v, u = motion["velocity"], motion["displacement"]
    assert (v.sel(mass="a").values[on_wall] == 0.0).all()
    assert np.ptp(u.sel(mass="a").values[on_wall]) < 1e-16
    assert (v.sel(mass="b").values[joined] == v.sel(mass="c").values[joined]).all()


def test_a_dashpot_ends_a_rest_at_once() -> None:
    """Its force begins with a jump, so that the acceleration behind the rest does, too."""
    carts = vi.Assembly(
        {"a": 1.0, "b": 1.0},
        {"a": vi.Link("ground", "a", vi.Isolator(40.0, 0.0))},
        {
            "wall": vi.Link("ground", "a", vi.RigidStop(0.0, 0.0)),
            "between": vi.Link("b", "a", vi.Bumper(100.0, 20.0, 0.1)),
        },
        {"a": -5.0},
    )
    motion = vi.simulate(vi.Rig(carts), 1.0, vi.State(velocity={"b": 1.0}), frequency=2.0)
    assert motion.attrs["message"] == "done"
    names, kinds = motion["event_stop"].values.tolist(), motion["event_contact"].values.tolist()
    assert names[:2] == ["between", "wall"]
    assert kinds[:2] == [1, 0]
    assert motion["event_time"].values[:2] == pytest.approx([0.1, 0.1], rel=1e-13)
    assert float(motion["displacement"].sel(mass="a").max()) > 1e-3


@pytest.mark.parametrize("samples", [0, 16])
@pytest.mark.parametrize("what", ["harmonic", "record"])
def test_motions_are_resumed(what: str, samples: int) -> None:
    if what == "harmonic":
        rig = vi.Rig(neighbours(), vi.Harmonic(3.0, 1.9, 0.3))
        whole = vi.simulate(rig, 12, samples=samples)
        first = vi.simulate(rig, 5.4, samples=samples)
        touched = 0
        for start in (first, first["final_state"]):
            rest = vi.simulate(rig, 6.6, start, samples=samples)
            near(rest["final_state"], whole["final_state"], 1e-11)
        # Cut within contacts, too, and at events.
        long = vi.simulate(rig, 4)
        times = long["event_time"].values * 1.9
        end = long["final_state"]
        for cycles in [*(0.5 * (times[1:] + times[:-1])), *times[:6]]:
            part = vi.simulate(rig, cycles, samples=0)
            touched += int(part["final_state"].sel(component="touching.between"))
            rest = vi.simulate(rig, 4.0 - cycles, part, samples=samples)
            near(rest["final_state"], end, 1e-11)
        assert touched > 0
    else:
        record = vi.Record(2.0 * QUAKE.acceleration, 0.02)
        whole = vi.simulate(vi.Rig(neighbours(), record), samples=samples)
        first = vi.simulate(vi.Rig(neighbours(), vi.Record(record.acceleration[:151], 0.02)))
        other = vi.Rig(neighbours(), vi.Record(record.acceleration[150:], 0.02))
        rest = vi.simulate(other, start=first, samples=samples)
        near(rest["final_state"], whole["final_state"], 1e-11)
        if samples:
            joined = first.sizes["event"] + rest.sizes["event"]
            assert joined == whole.sizes["event"] > 20


@pytest.mark.parametrize("masses", [1, 2])
def test_a_motion_that_rests_at_zero_is_resumed(masses: int) -> None:
    """A mass at rest on a stop, beside which one at zero has no size."""
    names = ["a", "b"][:masses]
    assembly = vi.Assembly(
        dict.fromkeys(names, 1.3),
        links={name: vi.Link("ground", name, vi.Isolator(2.0, 0.1)) for name in names},
        stops={"s": vi.Link("a", "ground", vi.RigidStop(0.3, 0.0))},
    )
    rig = vi.Rig(assembly, vi.Harmonic(0.7, 0.2, 3.5))
    whole, rests = vi.simulate(rig, 2, samples=0), 0
    for cut in np.linspace(0.1, 1.9, 19):
        first = vi.simulate(rig, cut, samples=0)
        end = first["final_state"].to_series()
        rests += bool(end["touching.s"])
        rest = vi.simulate(rig, 2.0 - cut, first, samples=0)
        near(rest["final_state"], whole["final_state"], 1e-11)
    assert rests > 1


def test_a_bumper_pressed_by_rounding_is_resumed() -> None:
    """Held at zero between a spring and a rigid stop, a mass presses the spring by 1e-17 m."""
    assembly = vi.Assembly(
        {"m": 1.6477785153718099},
        links={"l": vi.Link("ground", "m", vi.Isolator(0.3318077766539548, 0.0))},
        stops={
            "s": vi.Link("m", "ground", vi.Bumper(229.4763320202555, 0.0, 0.0)),
            "r": vi.Link("ground", "m", vi.RigidStop(0.32361277611579126, 0.0)),
        },
        forces={"m": 0.7059008956238293},
    )
    shaken = vi.Harmonic(1.488077922033719, 0.07191951046172541, 3.5980615733337427)
    first = vi.simulate(vi.Rig(assembly, shaken), 0.7724221865305544, samples=0)
    whole = vi.simulate(vi.Rig(assembly, shaken), 2, samples=0)
    rest = vi.simulate(vi.Rig(assembly, shaken), 2 - 0.7724221865305544, first, samples=0)
    near(rest["final_state"], whole["final_state"], 1e-9)


def test_the_first_sample_is_that_after_what_happens_at_once() -> None:
    """Bodies that rest at the beginning and are let go by rounding later than at zero."""
    wall = vi.RigidStop(0.5, 0.0)
    assembly = vi.Assembly(
        {"a": 2.663, "b": 2.4345, "c": 0.5758, "d": 1.0231},
        links={
            "c": vi.Link("ground", "c", vi.Isolator(0.92694, 0.02)),
            "d": vi.Link("a", "d", vi.Isolator(29.977, 0.0)),
        },
        stops={"s": vi.Link("a", "c", wall), "w": vi.Link("b", "ground", wall)},
    )
    motion = vi.simulate(vi.Rig(assembly, vi.Harmonic(0.281, 0.53297, 0.94506)), 1, samples=8)
    assert float(motion["contact_force"].min()) >= 0.0


def test_samples_do_not_change_the_motion() -> None:
    rig = vi.Rig(neighbours(), vi.Harmonic(3.0, 1.9))
    ends = [vi.simulate(rig, 30.3, samples=samples)["final_state"] for samples in (0, 1, 50)]
    assert (ends[0] == ends[1]).all()
    assert (ends[0] == ends[2]).all()


def test_at_rest_in_equilibrium() -> None:
    """A bumper that a constant force presses."""
    held = vi.Assembly(
        {"a": 1.0, "b": 2.0},
        {"a": vi.Link("ground", "a", vi.Isolator(50.0, 1.0))},
        {"between": vi.Link("b", "a", vi.Bumper(400.0, 2.0, 0.01))},
        {"b": 10.0},
    )
    motion = vi.simulate(vi.Rig(held), 2.0)
    u = [10.0 / 50.0, 10.0 / 50.0 + 0.01 + 10.0 / 400.0]
    np.testing.assert_allclose(motion["displacement"].values.T - u, 0.0, atol=1e-14)
    np.testing.assert_allclose(motion["contact_force"], 10.0, rtol=1e-12)
    assert motion.sizes["event"] == 0


def test_the_rule_for_simultaneous_impacts_is_reported() -> None:
    balls = vi.Assembly(
        dict.fromkeys("abc", 1.0),
        stops={
            "ab": vi.Link("a", "b", vi.RigidStop(1.0, 0.1)),
            "bc": vi.Link("b", "c", vi.RigidStop(1.0, 0.0)),
        },
    )
    start = vi.State(velocity={"a": 1.0})
    with pytest.warns(RuntimeWarning, match="at the same instant as another impact or rest"):
        motion = vi.simulate(vi.Rig(balls), 1, start, frequency=1.0)
    assert motion["simultaneous_impacts"] >= 1
    assert "their order is that of the stops" in motion.attrs["notes"]


def test_the_stop_that_causes_too_many_events_is_named() -> None:
    pressed = vi.Assembly(
        {"a": 1.0, "b": 1.0},
        links={name: vi.Link("ground", name, vi.Isolator(1.0, 0.1)) for name in "ab"},
        stops={
            "calm": vi.Link("ground", "a", vi.RigidStop(1.0, 2.0)),
            "floor": vi.Link("ground", "b", vi.RigidStop(1.0, 0.0)),
        },
        forces={"b": -3.0},
    )
    start = vi.State({"b": 1e-7})
    cause = (
        r"events are at floor; with stops\.floor\.restitution = 1, bodies that are pushed together "
        "bounce without end: use a smaller value$"
    )
    with pytest.warns(RuntimeWarning, match=cause):
        vi.simulate(vi.Rig(pressed), 20, start, frequency=1.0, max_events=200)


def test_the_link_that_causes_too_many_steps_is_named() -> None:
    blunt = vi.Assembly(
        {"a": 1.0},
        links={"x": vi.Link("ground", "a", vi.Isolator(1.0, 1.0, damping_exponent=0.5))},
        stops={"far": vi.Link("ground", "a", vi.RigidStop(1.0, 90.0))},
    )
    rows = np.zeros((0, 9))
    assert busiest_by_mass(rows, 0, blunt) == "with 0 events, check links.x.damping_exponent = 0.5"


def test_a_motion_that_is_given_up_ends_there() -> None:
    ball = vi.Assembly(
        {"ball": 1.0},
        stops={"floor": vi.Link("ground", "ball", vi.RigidStop(0.99, 0.0))},
        forces={"ball": -9.81},
    )
    start = vi.State({"ball": 0.1})
    with pytest.warns(RuntimeWarning, match="simulate stopped in cycle 10: one forcing"):
        motion = vi.simulate(vi.Rig(ball), 20, start, frequency=1.0, max_events=5)
    assert motion["status"] == 2
    assert motion.sizes["time"] == 10 * 256
    assert 9.99 < motion["time"][-1] < 10.0
    assert float(motion["final_state"].sel(component="displacement.ball")) > 0.0
    assert motion.sizes["event"] > 5
    assert json.loads(motion.attrs["parameters"])["cycles"] == 10.0
    stiff = neighbours().replace(masses={"low": 1e-30, "high": 0.9})
    with pytest.warns(RuntimeWarning, match="fastest rate"):
        motion = vi.simulate(vi.Rig(stiff, vi.Harmonic(3.0, 1.9)), 2)
    assert motion["status"] == 3
    assert motion.sizes["time"] == 0


@pytest.mark.parametrize(
    ("drag", "allowed", "status", "why"),
    [
        (1, 1, 0, None),
        (2, 10_000, 0, None),
        # The turns of a link count, and no stop is there to log.
        (2, 3, 2, "one forcing cycle or record step has"),
    ],
)
def test_why_a_motion_is_given_up(drag: int, allowed: int, status: int, why: str | None) -> None:
    isolator = vi.Isolator(1.0, 0.1, damping_exponent=drag)
    rig = vi.Assembly({"m": 1.0}, {"k": vi.Link("ground", "m", isolator)})
    shaken, start = vi.Rig(rig, vi.Harmonic(0.1, 0.01)), vi.State({"m": 1.0})
    with pytest.warns(RuntimeWarning, match=why) if why else nullcontext():
        motion = vi.simulate(shaken, 2, start, max_events=allowed)
    assert motion["status"] == status


def test_a_motion_that_leaves_the_range_of_numbers_is_given_up() -> None:
    link = {"k": vi.Link("ground", "m", vi.Isolator(1e-100, 0.0))}
    rig = vi.Rig(vi.Assembly({"m": 1e-100}, link, forces={"m": 1e100}))
    with pytest.warns(RuntimeWarning, match="exceeded the range of floating-point numbers"):
        motion = vi.simulate(rig, 30, vi.State({"m": 1.0}), frequency=0.11)
    assert motion["status"] == 4


RIG = vi.Rig(neighbours(), vi.Harmonic(3.0, 1.9))


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"start": vi.State(0.01)}, "is the state of one mass; pass values by name"),
        ({"start": 3}, "start: 3 is not a state"),
        ({"start": vi.State({"roof": 0.01})}, "start.displacement.*'roof'"),
        ({"start": vi.State({"low": 0.05})}, "start.deformation.between|passed"),
        (
            {"start": vi.State({"low": 0.05}, deformation={"between": 0.01})},
            r"start.deformation.between: 0.01 m, but the displacements compress this bumper by",
        ),
        ({"start": vi.State({"low": -0.05})}, "overlap by"),
        (
            {"start": vi.State({"low": 0.0}, deformation={"wall": 0.01})},
            "start.deformation.wall: 0.01 m, but a rigid stop does not deform",
        ),
        (
            {"start": vi.State({"low": 0.0}, touching=["wall"])},
            "start.touching: 'wall', but ground and low are 0.02 m apart",
        ),
        (
            {"start": vi.State({"low": 0.0}, touching=["between"])},
            "start.touching: 'between', but low and high do not press it",
        ),
        ({"tail": 1.0}, "tail: 1.0, but no Record shakes this rig"),
    ],
)
def test_bad_starts_are_refused(options: dict[str, Any], says: str) -> None:
    if says.endswith("passed"):
        vi.simulate(RIG, 1, **options)  # a bumper is compressed as far as its bodies overlap
        return
    with pytest.raises(vi.InputError, match=says) as error:
        vi.simulate(RIG, 1, **options)
    assert "\n" not in str(error.value)


def test_states_of_other_rigs_are_refused() -> None:
    other = vi.simulate(vi.Rig(one_mass(BUMPER, None)[1]), 1, samples=0)
    with pytest.raises(vi.InputError, match=r"'displacement.m', which this assembly has not"):
        vi.simulate(RIG, 1, other)
    with pytest.raises(vi.InputError, match="is not a state"):
        vi.simulate(vi.Rig(one_mass(BUMPER, None)[0], SHAKING["force"]), 1, other)


def test_a_motion_is_saved_and_resumed(tmp_path: Any) -> None:
    motion = vi.simulate(RIG, 3)
    vi.save(motion, tmp_path / "motion.nc")
    again = vi.load(tmp_path / "motion.nc")
    xr.testing.assert_identical(again["displacement"], motion["displacement"])
    ends = [vi.simulate(RIG, 3, one, samples=0)["final_state"] for one in (motion, again)]
    xr.testing.assert_identical(*ends)


@pytest.mark.parametrize("cycles", [1, 5])
def test_a_motion_in_parts_of_whole_cycles_has_the_same_digits(cycles: int) -> None:
    whole = vi.simulate(RIG, 12, samples=0)
    part = vi.simulate(RIG, cycles, samples=0)
    rest = vi.simulate(RIG, 12 - cycles, part, samples=0)
    np.testing.assert_array_equal(rest["final_state"], whole["final_state"])


def test_a_study_file_and_a_rig_without_units(tmp_path: Any) -> None:
    path = tmp_path / "rig.toml"
    path.write_text(
        "[assembly.masses]\na = 1.0\nb = 2.0\n"
        '[assembly.links.k]\nleft = "ground"\nright = "a"\nstiffness = 5.0\ndamping = 0.1\n'
        '[assembly.links.l]\nleft = "a"\nright = "b"\nstiffness = 5.0\ndamping = 0.1\n'
        "[excitation]\namplitude = 1.0\n"
    )
    motion = vi.simulate(str(path), 2, frequency=0.3)
    assert motion.sizes["mass"] == 2
    assert motion.sizes["stop"] == 0
    assembly = vi.Assembly(
        {"a": 1.0}, {"k": vi.Link("ground", "a", vi.Isolator(1.0, 0.1))}, units="none"
    )
    plain = vi.simulate(vi.Rig(assembly, 1.0, 0.2), 1)
    assert plain.attrs["unit_system"] == "none"
    assert plain["displacement"].attrs["units"] == "1"


def test_no_warning_without_a_cause() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        motion = vi.simulate(RIG, 3)
    assert "notes" not in motion.attrs
    assert motion.attrs["message"] == "done"
