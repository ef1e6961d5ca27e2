"""`contacts` and `totals` of assemblies: one mass, closed forms, energy, mirror and order."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from response.test_assembly_motion import BUMPER, ELASTIC, QUAKE, neighbours, one_mass
from stability.test_assembly_orbits import damper, frame

FORCE = vi.Harmonic("400 N", 1.3)
SINE = vi.Harmonic("2.5 m/s2", 0.9, 0.4)
LIVELY = vi.RigidStop(0.9, 5e-3)
"""Without chatter, of which the two flows leave out a different rest."""
MOTIONS = {
    "bumpers": (BUMPER, BUMPER, SINE, 0.0),
    "elastic": (ELASTIC, BUMPER.replace(gap=3e-3), SINE, 0.0),
    "walls": (LIVELY, LIVELY, SINE, 0.0),
    "one wall, held": (LIVELY, None, FORCE, 150.0),
    "rest": (vi.RigidStop(0.0, 0.0), BUMPER, vi.Harmonic("0.6 m/s2", 0.5), 300.0),
    "record": (BUMPER, LIVELY, QUAKE, 40.0),
    "harmonics": (BUMPER, LIVELY, vi.Periodic(0.8, [2.0, 0.0, 0.7], [0.1, 0.0, 0.3]), 0.0),
}
SAME = {
    "start", "end", "duration", "start_velocity", "end_velocity", "peak_force", "impulse",
    "penetration", "dissipated", "dissipated_relaxing", "closing_speed", "restitution",
    "start_phase", "end_phase", "duration_share",
}  # fmt: skip


def near(actual: xr.DataArray, expected: xr.DataArray, tolerance: float = 1e-11) -> None:
    values = np.asarray(expected)
    finite = np.abs(values[np.isfinite(values)])
    size = float(finite.max(initial=0.0)) + 1e-5
    np.testing.assert_allclose(
        np.squeeze(actual), np.squeeze(expected), rtol=0, atol=tolerance * size
    )


def both(kind: str) -> tuple[xr.Dataset, xr.Dataset]:
    right, left, shaking, force = MOTIONS[kind]
    cycles = None if isinstance(shaking, vi.Record) else 9.3
    if kind == "walls":  # impacts of e = 0.9 let rounding grow
        cycles = 3.3
    one, several = (
        vi.simulate(vi.Rig(system, shaking), cycles, samples=8)
        for system in one_mass(right, left, force)
    )
    return one, several


@pytest.mark.parametrize("kind", MOTIONS)
def test_contacts_of_one_mass_are_the_oscillators(kind: str) -> None:
    one, several = (vi.contacts(motion) for motion in both(kind))
    assert one.sizes["contact_number"] >= 5
    expected = one["contact_stop"].values
    # An impact and the rest after it begin at once.
    at = np.lexsort((several["contact_duration"], several["contact_start"].values.round(9)))
    of_one = np.lexsort((one["contact_duration"], one["contact_start"].values.round(9)))
    assert several["contact_stop"].values[at].tolist() == expected[of_one].tolist()
    names = (
        SAME
        if "contact_start_phase" in one
        else {n for n in SAME if "_phase" not in n} - {"duration_share"}
    )
    for name in names:
        mine, theirs = several[f"contact_{name}"][at], one[f"contact_{name}"][of_one]
        if name == "restitution":  # where a rest begins it is of rounding
            moving = (one["contact_closing_speed"][of_one] > 1e-9).values
            mine, theirs = mine[moving], theirs[moving]
        near(mine, theirs, 1e-8)
    assert (several["contact_grazing"][at].values == one["contact_grazing"][of_one].values).all()


@pytest.mark.parametrize("kind", MOTIONS)
def test_totals_of_one_mass_are_the_oscillators(kind: str) -> None:
    one, several = (vi.totals(motion) for motion in both(kind))
    for name in one:
        if not str(name).startswith("total"):
            near(several[name], one[name])
    near(several["total_supplied"], one["total_supplied"])
    near(several["total_links"], one["total_isolator"])
    near(several["total_stops"].sum("stop"), one["total_bumpers"])
    assert float(several["total_damping"]) == pytest.approx(
        0.0, abs=1e-12 * float(one["total_isolator"])
    )


def balance(totals: xr.Dataset) -> None:
    lost = [totals[f"total_{name}"].sum() for name in ("links", "stops", "damping", "stored")]
    size = float(sum(abs(one) for one in lost))
    assert float(sum(lost)) == pytest.approx(float(totals["total_supplied"]), abs=1e-11 * size)
    assert size > 0.0


@pytest.mark.parametrize("shaking", [vi.Harmonic(3.0, 1.9, 0.3), QUAKE])
def test_energies_are_balanced(shaking: object) -> None:
    cycles = 12.4 if isinstance(shaking, vi.Harmonic) else None
    totals = vi.totals(vi.simulate(vi.Rig(neighbours(), shaking), cycles, samples=2))
    balance(totals)
    assert (totals["total_stops"] > 0.0).all()
    assert (totals["total_links"] > 0.0).all()


def test_energies_of_modal_damping_and_rigid_neighbours() -> None:
    towers = vi.chain(
        ["200 t", "150 t", "150 t"],
        ["120 MN/m", "90 MN/m", "60 MN/m"],
        damping_ratio=0.03,
        stops={
            "low": vi.Link("floor_1", "ground", vi.RigidStop(0.6, "4 mm")),
            "high": vi.Link("ground", "floor_3", vi.Bumper("40 MN/m", "300 kN s/m", "9 mm")),
        },
    )
    force = vi.Harmonic("700 kN", "2.2 Hz", on="floor_2")
    motion = vi.simulate(vi.Rig(towers, force), 25, samples=4)
    totals = vi.totals(motion)
    balance(totals)
    assert float(totals["total_damping"]) > 0.0
    assert (totals["total_links"] == 0.0).all()
    log = vi.contacts(motion)
    for stop in ("low", "high"):
        mine = log["contact_stop"] == stop
        assert int(mine.sum()) >= 5
        # All but what is cut off, and what free bumpers lose before the first contact.
        lost = (log["contact_dissipated"] + log["contact_dissipated_relaxing"])[mine].sum()
        assert float(lost) <= float(totals["total_stops"].sel(stop=stop)) * (1.0 + 1e-12)
        assert int(mine.sum()) in (
            int(totals["impact_count"].sel(stop=stop)) - 1,
            int(totals["impact_count"].sel(stop=stop)),
        )
    assert float(totals["peak_force"].sel(stop="low")) == math.inf
    impacts = log["contact_stop"] == "low"
    np.testing.assert_allclose(log["contact_restitution"][impacts], 0.6, rtol=1e-9)


@pytest.mark.parametrize("stop", [None, vi.RigidStop(0.8, 0.012)])
def test_totals_of_a_steady_motion_are_those_of_its_sweep(stop: object) -> None:
    motion = vi.steady(vi.Rig(frame(stop), vi.Harmonic("1 m/s2", 0.9)))
    totals, log = vi.totals(motion), vi.contacts(motion)
    for name in totals:
        if name in motion and not str(name).startswith("peak_force"):
            near(totals[name], motion[name], 1e-12)
    np.testing.assert_allclose(totals["peak_force"], motion["peak_force"], rtol=1e-12)
    period = int(motion["period"])
    for stop_name in ("right", "left"):
        count = int((log["contact_stop"] == stop_name).sum())
        assert count == period * float(motion["impacts"].sel(stop=stop_name))
    # What is stored comes again, and so each contact's loss is in the list.
    assert abs(float(totals["total_stored"])) < 1e-9 * float(totals["total_supplied"])
    lost = float((log["contact_dissipated"] + log["contact_dissipated_relaxing"]).sum())
    assert lost == pytest.approx(float(totals["total_stops"].sum()), rel=1e-9)


def test_bodies_that_stop_at_once_leave_no_extreme_unknown() -> None:
    """Without restitution an impact and the rest after it are at one instant."""
    motion = vi.simulate(
        vi.Rig(frame(vi.RigidStop(0.0, 0.012)), vi.Harmonic("1 m/s2", 0.9)), 8, samples=64
    )
    totals = vi.totals(motion)
    assert (totals["impact_count"] > 2.0).all()
    sampled = abs(motion["acceleration"]).max("time")
    assert (totals["peak_acceleration"] >= sampled * (1.0 - 1e-9)).all()
    assert float(totals["peak_transmitted_force"]) >= float(abs(motion["transmitted_force"]).max())
    balance(totals)


def test_impacts_of_an_impact_damper_are_those_of_its_formula() -> None:
    zeta, mu, e, d, speed = 0.01, 0.05, 0.75, 30.0, 14.78340654
    rig = damper(zeta=zeta, mass=mu, e=e, clearance=d)
    motion = vi.orbit(rig)
    log, totals = vi.contacts(motion), vi.totals(motion)
    assert log.sizes["contact_number"] == 2
    # The ball turns round at each impact.
    np.testing.assert_allclose(log["contact_impulse"], 2.0 * mu * speed, rtol=1e-8)
    np.testing.assert_allclose(totals["impulse"], 2.0 * mu * speed, rtol=1e-8)
    np.testing.assert_allclose(
        abs(log["contact_start_velocity"].sel(mass="ball")), speed, rtol=1e-8
    )
    closing = 2.0 * mu * speed * (1.0 + mu) / (mu * (1.0 + e))
    np.testing.assert_allclose(log["contact_closing_speed"], closing, rtol=1e-8)
    meeting = mu / (1.0 + mu)
    lost = 0.5 * meeting * (1.0 - e * e) * closing**2
    np.testing.assert_allclose(totals["total_stops"], lost, rtol=1e-8)
    balance(totals)


def test_a_ball_in_a_shaken_cavity_is_that_of_its_formula() -> None:
    """A symmetric orbit with two impacts a period, each of impulse 2 m V."""
    e, b, size, mass = 0.6, 1.0, 0.4, 0.3
    s = (1.0 - e) / (1.0 + e)
    sigma = 2.0 * s / math.pi
    # (y − b)² + σ² y² = A², the larger root.
    y = (b + math.sqrt(b * b - (1.0 + sigma**2) * (b * b - size**2))) / (1.0 + sigma**2)
    assert y == pytest.approx(1.33855, rel=1e-5)
    speed = 2.0 * y / math.pi
    assert speed == pytest.approx(0.85215, rel=1e-5)
    wall = vi.RigidStop(e, b)
    ball = vi.Assembly(
        {"ball": mass},
        stops={"right": vi.Link("ball", "ground", wall), "left": vi.Link("ground", "ball", wall)},
        units="none",
    )
    shaken = vi.Harmonic(size, 1.0 / (2.0 * math.pi), of="displacement")
    start = vi.State(displacement={"ball": 0.9}, velocity={"ball": 0.6})
    settled = vi.simulate(vi.Rig(ball, shaken), 300, start, samples=0)
    totals = vi.totals(vi.simulate(vi.Rig(ball, shaken), 1, settled, samples=4))
    assert totals["impact_count"].values.tolist() == [1.0, 1.0]
    np.testing.assert_allclose(totals["impulse"], 2.0 * mass * speed, rtol=1e-9)


def mirrored(assembly: vi.Assembly) -> vi.Assembly:
    stops = {n: vi.Link(one.right, one.left, one.law) for n, one in assembly.stops.items()}
    return assembly.replace(stops=stops, forces={n: -f for n, f in assembly.forces.items()})


def test_mirror_and_order_change_nothing() -> None:
    rig = neighbours()
    shaking = vi.Harmonic(3.0, 1.9, 0.3)
    totals, log = (
        of(vi.simulate(vi.Rig(rig, shaking), 8, samples=2)) for of in (vi.totals, vi.contacts)
    )
    image = vi.simulate(vi.Rig(mirrored(rig), shaking.replace(phase=0.3 + math.pi)), 8, samples=2)
    other = vi.totals(image)
    near(other["displacement_max"], -totals["displacement_min"])
    near(other["acceleration_min"], -totals["acceleration_max"])
    near(other["drift_max"], -totals["drift_min"])
    for name in ("peak_force", "impulse", "impact_count", "total_links", "total_stops"):
        near(other[name], totals[name], 1e-10)
    turned = rig.replace(masses=dict(reversed(list(rig.masses.items()))))
    motion = vi.simulate(vi.Rig(turned, shaking), 8, samples=2)
    again = vi.totals(motion)
    assert list(again["mass"].values) == list(totals["mass"].values)[::-1]
    for name in totals:
        near(again[name].reindex_like(totals[name]), totals[name], 1e-10)
    same = vi.contacts(motion)
    assert same["contact_stop"].values.tolist() == log["contact_stop"].values.tolist()
    near(same["contact_impulse"], log["contact_impulse"], 1e-9)


def test_a_motion_that_is_cut() -> None:
    motion = vi.simulate(vi.Rig(neighbours(), vi.Harmonic(3.0, 1.9, 0.3)), 8, samples=64)
    whole = vi.contacts(motion)
    late = motion.isel(time=slice(2 * 64 + 5, 6 * 64 + 11))
    part = vi.contacts(late)
    begins, ends = float(late["time"][0]), float(late["time"][-1])
    inside = (whole["contact_start"] > begins) & (whole["contact_end"] < ends)
    assert int(inside.sum()) > 5
    near(part["contact_start"], whole["contact_start"][inside], 1e-9)
    near(part["contact_impulse"], whole["contact_impulse"][inside], 1e-9)
    record = vi.simulate(vi.Rig(neighbours(), QUAKE), samples=4)
    log = vi.contacts(record)
    part = vi.contacts(record.isel(time=slice(None, record.sizes["time"] // 2)))
    count = part.sizes["contact_number"]
    assert 0 < count < log.sizes["contact_number"]
    near(part["contact_end"], log["contact_end"][:count], 1e-9)


def test_what_is_not_recorded() -> None:
    motion = vi.simulate(vi.Rig(neighbours(), vi.Harmonic(3.0, 1.9)), 2, samples=0)
    for function in (vi.contacts, vi.totals):
        with pytest.raises(vi.InputError, match=r"^motion: this is not a recorded motion"):
            function(motion)


def test_bodies_that_left_without_speed_and_return_hit_each_other() -> None:
    """An impact without return leaves no speed; after a flight there is a second one."""
    assembly = vi.Assembly(
        {"a": 0.6116826483904807, "b": 0.559228125484749},
        links={
            "g": vi.Link("ground", "a", vi.Isolator(0.34530018143194574, 0.0)),
            "l": vi.Link("a", "b", vi.Isolator(2.808388512449001, 0.2193428720145777)),
            "k": vi.Link("b", "a", vi.Isolator(0.5720024181987748, 0.0)),
        },
        stops={"s": vi.Link("a", "b", vi.RigidStop(0.0, 0.4775787551863301))},
    )
    shaken = vi.Harmonic(1.9858781414912148, 0.11742319496363401, 0.007054873381011628)
    motion = vi.simulate(vi.Rig(assembly, shaken), 3)
    assert motion["event_contact"].values.tolist() == [2, 1, 0, 2, 2, 1, 0]
    totals = vi.totals(motion)
    spent = totals["total_links"].sum() + totals["total_stops"].sum() + totals["total_stored"]
    assert float(spent) == pytest.approx(float(totals["total_supplied"]), rel=1e-11)
