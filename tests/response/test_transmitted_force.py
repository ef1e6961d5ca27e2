"""The force that the isolator and the stops exert on the base."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi

MASS = 3.0
SPRING = vi.Isolator(30e3, 120.0)
BUMPERS = (vi.Bumper(200e3, 80.0, 4e-3), vi.Bumper(90e3, 20.0, 6e-3))
WALLS = (vi.RigidStop(0.6, 4e-3), vi.RigidStop(0.7, 6e-3))


def between(stops, isolator=SPRING, force: float = 0.0) -> vi.Oscillator:
    return vi.Oscillator(MASS, isolator, *stops, force)


RIGS = {
    "bumpers": between(BUMPERS, force=40.0),
    "walls": between(WALLS, force=-25.0),
    "a wall and a bumper": between((WALLS[0], BUMPERS[1])),
    "rest on walls": between((vi.RigidStop(0.2, 1e-3), vi.RigidStop(0.3, 2e-3)), force=60.0),
    "preloaded": between((BUMPERS[0].replace(gap=-1e-3), BUMPERS[1].replace(gap=-2e-3))),
    "hertz": between((vi.PowerBumper(4e6, 4e-3, 1.5, 0.4), vi.PowerBumper(2e6, 5e-3, 1.5, 0.2))),
    "hardening": between(BUMPERS, vi.PolynomialIsolator(25e3, 100.0, 4e8, 0.0)),
    "friction": between(BUMPERS, vi.FrictionIsolator(30e3, 60.0, 30.0), 20.0),
    "yielding": between(BUMPERS, vi.BilinearIsolator(60e3, 8e3, 90.0, 60.0)),
    "formula": between(BUMPERS, vi.Law("k*u + c*v + q*u**3", k=25e3, c=110.0, q=3e8)),
}
SHAKEN = {
    "force": vi.Harmonic(150.0, 9.0, 0.4, of="force"),
    "unbalance": vi.Harmonic(0.045, 9.0, 0.4, of="unbalance"),
    "harmonics": vi.Periodic(7.0, [120.0, 60.0], [0.0, 1.0], of="force"),
    "base": vi.Harmonic("5 g", 9.0, 0.4),
}


def in_words(rig: vi.Oscillator, motion: xr.Dataset) -> np.ndarray:
    """K u + C u̇ and the forces of Kelvin–Voigt bumpers at the samples, in N."""
    u, v = motion["displacement"].values, motion["velocity"].values
    total = rig.isolator.stiffness * u + rig.isolator.damping * v
    for stop, name, side in ((rig.right, "right", 1), (rig.left, "left", -1)):
        pressed = motion["touching"].sel(stop=name).values
        total += np.where(pressed, stop.stiffness * (u - side * stop.gap) + stop.damping * v, 0.0)
    return total


@pytest.mark.parametrize("kind", SHAKEN)
def test_it_is_what_the_isolator_and_the_bumpers_push_with(kind: str) -> None:
    rig = RIGS["bumpers"]
    motion = vi.simulate(vi.Rig(rig, SHAKEN[kind]), 20)
    assert motion.sizes["event"] > 10
    force = motion["transmitted_force"].values
    np.testing.assert_allclose(force, in_words(rig, motion), atol=1e-12 * np.abs(force).max())
    # Where a contact begins it jumps by what the dashpot pushes with.
    begins = motion["event_contact"].values == 1
    side, v = (
        np.where(motion["event_stop"].values == "right", 1, -1)[begins],
        motion["event_velocity"].values[begins],
    )
    after, before = (
        motion[f"event_transmitted_force_{when}"].values[begins] for when in ("after", "before")
    )
    right, left = rig.right, rig.left
    deformed = np.where(
        side == 1,
        motion["event_deformation"].sel(stop="right").values[begins],
        (-motion["event_deformation"].sel(stop="left")).values[begins],
    )
    pushed = np.where(
        side == 1,
        right.stiffness * deformed + right.damping * v,
        left.stiffness * deformed + left.damping * v,
    )
    assert np.abs(pushed).min() > 0.0
    np.testing.assert_allclose(after - before, pushed, atol=1e-11 * np.abs(force).max())


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        *((name, "unbalance") for name in RIGS),
        *(("bumpers", kind) for kind in SHAKEN if kind != "unbalance"),
    ],
)
def test_its_extremes_are_those_of_dense_samples(name: str, kind: str) -> None:
    """Of a sweep, of a steady motion and of totals; never below a sample, and little above."""
    rig = vi.Rig(RIGS[name], SHAKEN[kind])
    held = vi.sweep(rig, [rig.frequency], "forward", window=12, phase=rig.shaking.phase)
    held = held.isel(direction=0, frequency=0)
    assert int(held["period"]) > 0
    motion = vi.simulate(rig, int(held["period"]), held["section"], 4096)
    values = np.concatenate(
        [
            motion[one].values
            for one in (
                "transmitted_force",
                "event_transmitted_force_before",
                "event_transmitted_force_after",
            )
        ]
    )
    size = float(np.ptp(values))
    totals = vi.totals(motion)
    for extremes in (held, totals):
        for end, sampled, sign in (("max", values.max(), 1.0), ("min", values.min(), -1.0)):
            more = sign * (float(extremes[f"transmitted_force_{end}"]) - sampled)
            assert -1e-8 * size <= more <= 2e-3 * size, (name, kind, end)
        excursion = float(extremes["transmitted_force_max"] - extremes["transmitted_force_min"])
        assert float(extremes["transmitted_force_excursion"]) == pytest.approx(excursion, rel=1e-12)
    np.testing.assert_allclose(
        held["transmitted_force_excursion"], totals["transmitted_force_excursion"], rtol=1e-8
    )
    theta = np.linspace(0.0, 2.0 * math.pi, 200_001)
    exciting = np.ptp(rig.shaking.at(theta)) * (MASS if rig.shaking.moves_base else 1.0)
    ratio = float(held["transmitted_force_excursion"]) / exciting
    assert float(held["transmissibility"]) == pytest.approx(ratio, rel=1e-8)


def test_if_the_base_moves_it_is_the_mass_times_the_acceleration() -> None:
    """F_0 − M (ü + A_t), in all results, at the same bits but for the product."""
    rig = vi.Rig(RIGS["bumpers"], SHAKEN["base"])
    motion, mass, load = vi.steady(rig), MASS, RIGS["bumpers"].force
    np.testing.assert_allclose(
        motion["transmitted_force"], load - mass * motion["acceleration"], rtol=1e-15, atol=1e-12
    )
    for data in (motion, vi.totals(motion), vi.sweep(rig, [8.0, 9.0])):
        for end, other in (("max", "min"), ("min", "max")):
            np.testing.assert_allclose(
                data[f"transmitted_force_{end}"],
                load - mass * data[f"acceleration_{other}"],
                rtol=1e-14,
            )


def test_a_published_case() -> None:
    """TR = √(k² + c²ω²) X/F: a force of 450 N at X = 22.876769 mm transmits 707.62 N.

    Stiffness, damping and mass are such that both follow to the digits stated.
    """
    omega, swing = 62.79, 22.876769e-3
    k, c = 30e3, 120.0
    mass = (k - math.sqrt((450.0 / swing) ** 2 - (c * omega) ** 2)) / omega**2
    rig = vi.Rig(vi.Oscillator(mass, vi.Isolator(k, c)), vi.Harmonic("450 N", "62.79 rad/s"))
    for data in (vi.steady(rig), vi.sweep(rig, ["62.79 rad/s"])):
        np.testing.assert_allclose(data["displacement_max"], swing, rtol=1e-10)
        np.testing.assert_allclose(data["transmitted_force_max"], 707.62, atol=5e-3)
        np.testing.assert_allclose(data["transmissibility"], 1.5725, atol=5e-5)


@pytest.mark.parametrize("ratio", [0.05, 0.4, 1.3])
def test_a_machine_on_its_mounts(ratio: float) -> None:
    """X = (m e/M) r²/D and TR = √(1 + (2ξr)²)/D under an unbalance: in sweeps and on branches."""
    natural, eccentric = 2.0 * math.pi * 4.0, 0.4 / 800.0
    mounts = vi.Isolator(800.0 * natural**2, 2.0 * ratio * 800.0 * natural)
    rig = vi.Rig(vi.Oscillator(800.0, mounts), "0.4 kg m")
    swept = vi.sweep(rig, np.linspace(1.0, 14.0, 60))
    along = vi.branch(rig, frequency="6 Hz", vary={"frequency": (1.0, 14.0)})
    for data in (swept, along):
        r = data["frequency"] / 4.0
        distance = np.hypot((1.0 - r) * (1.0 + r), 2.0 * ratio * r)
        exact = {
            "displacement_excursion": 2.0 * eccentric * r**2 / distance,
            "acceleration_excursion": 2.0 * eccentric * (natural * r**2) ** 2 / distance,
            "transmissibility": np.hypot(1.0, 2.0 * ratio * r) / distance,
        }
        for name, values in exact.items():
            curve = data[name].transpose(..., data["frequency"].dims[0])
            np.testing.assert_allclose(curve, curve * 0.0 + values, rtol=1e-11, err_msg=name)
    for direction in ("forward", "backward"):
        np.testing.assert_allclose(
            swept["transmitted_force_excursion"].sel(direction=direction),
            swept["free_transmitted_force_excursion"],
            rtol=1e-9,
        )


def test_the_machine_of_the_page_stays_clear_of_its_stops() -> None:
    """800 kg at 4 Hz and 6 %, 0.4 kg m, stops at 6 mm: 4.17 mm at most, and no contact."""
    natural = 2.0 * math.pi * 4.0
    mounts = vi.Isolator(800.0 * natural**2, 0.12 * 800.0 * natural)
    stop = vi.Bumper("3 MN/m", "10 kN s/m", "6 mm")
    rig = vi.Rig(vi.Oscillator(800.0, mounts, stop, stop), "0.4 kg m")
    swept = vi.sweep(rig, np.arange(2.0, 8.0, 0.01))
    assert float(swept["peak_displacement"].max()) == pytest.approx(4.17e-3, abs=5e-6)
    assert not swept["impacts"].sel(stop="right").any()
    sized = vi.required_gap(rig, {"frequency": (2.0, 8.0)})
    assert float(sized["common_gap"]) == pytest.approx(
        0.4 / 800.0 / (2.0 * 0.06 * math.sqrt(1.0 - 0.06**2)), rel=1e-6
    )


def test_the_unbalance_that_just_grazes_follows_the_resonance() -> None:
    """m e = G M D/r², the frequency varied together with the unbalance."""
    natural = 2.0 * math.pi * 4.0
    stop = vi.Bumper("3 MN/m", "10 kN s/m", "6 mm")
    mounts = vi.Isolator(800.0 * natural**2, 0.12 * 800.0 * natural)
    rig = vi.Rig(vi.Oscillator(800.0, mounts, stop, stop), "0.8 kg m")
    along = vi.branch(rig, frequency="3.5 Hz", vary={"frequency": (3.2, 3.9)})
    grazing = along.isel(bifurcation=list(along["bifurcation_kind"]).index("grazing"))
    curve = vi.bifurcation_curve(
        rig.at("3.5 Hz"), grazing, vary={"frequency": (3.2, 4.6), "amplitude": (0.3, 1.5)}
    )
    assert np.ptp(curve["frequency"].values) > 1.0
    r = curve["frequency"] / 4.0
    exact = 6e-3 * 800.0 * np.hypot((1.0 - r) * (1.0 + r), 0.12 * r) / r**2
    np.testing.assert_allclose(curve["amplitude"], exact, rtol=1e-7)
    assert curve["amplitude"].attrs["units"] == "kg m"


def test_along_a_branch_it_is_that_of_the_orbits() -> None:
    rig = vi.Rig(RIGS["bumpers"], "0.045 kg m", "12 Hz")
    along = vi.branch(rig, vary={"frequency": (6.0, 14.0)})
    for i in range(0, along.sizes["point"], max(1, along.sizes["point"] // 6)):
        one = along.isel(point=i)
        orbit = vi.orbit(rig, one["section"], frequency=float(one["frequency"]))
        for name in ("transmitted_force_max", "transmitted_force_min", "transmissibility"):
            assert float(one[name]) == pytest.approx(float(orbit[name]), rel=1e-8), (i, name)
    assert along["bifurcation_transmissibility"].notnull().all()


def test_without_an_exciting_force_there_is_no_ratio() -> None:
    ball = vi.Oscillator(1.0, vi.Isolator(40.0, 1.0), force=-9.81)
    motion = vi.steady(vi.Rig(ball, vi.Harmonic(0.0, "1 Hz")))
    assert float(motion["transmitted_force_max"]) == pytest.approx(-9.81, rel=1e-12)
    assert math.isnan(float(motion["transmissibility"]))


def test_through_a_record_too() -> None:
    record = vi.Record(30.0 * np.sin(0.3 * np.arange(200)), 0.01)
    motion = vi.simulate(vi.Rig(RIGS["bumpers"], record))
    assert motion.sizes["event"] > 4
    force = motion["transmitted_force"].values
    np.testing.assert_allclose(
        force, in_words(RIGS["bumpers"], motion), atol=1e-11 * np.abs(force).max()
    )
    totals = vi.totals(motion)
    events = motion["event_transmitted_force_after"].values
    assert float(totals["transmitted_force_max"]) >= max(force.max(), events.max()) * (1 - 1e-12)
