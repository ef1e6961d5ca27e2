"""What holds measure, against what is found of the same motions in other ways."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi

ISOLATOR = vi.Isolator(26.8e3, 1.1e3)
BUMPER = vi.Bumper(510e3, 900.0, 7.5e-3)
RIGS = {
    "bumpers": vi.Oscillator(550, ISOLATOR, BUMPER, BUMPER.replace(gap=4e-3)),
    "one bumper": vi.Oscillator(550, ISOLATOR, BUMPER),
    "power laws": vi.Oscillator(
        550,
        ISOLATOR,
        vi.PowerBumper("2 GN/m^1.5", "7 mm", dissipation=0.4),
        vi.JankowskiBumper("2 GN/m^1.5", "5 mm", 0.6, 550),
    ),
    "hardening": vi.Oscillator(550, vi.PolynomialIsolator(26e3, 1.1e3, 1e6), BUMPER),
    "yielding": vi.Oscillator(550, vi.BilinearIsolator(1e5, 2e4, 300, 0), BUMPER, BUMPER),
}
WALLS = {
    "walls": vi.Oscillator(550, ISOLATOR, vi.RigidStop(0.6, 8e-3), vi.RigidStop(0.3, 9e-3)),
    "a wall": vi.Oscillator(550, ISOLATOR, vi.RigidStop(0.6, 8e-3), BUMPER),
}
FREQUENCY = 1.5


def held_and_contacts(rig: vi.Oscillator) -> tuple[xr.Dataset, xr.Dataset]:
    held = vi.sweep(vi.Rig(rig, 0.5), [FREQUENCY], "forward").isel(direction=0, frequency=0)
    assert held["motion"] == "periodic"
    cycles = int(held["period"])
    motion = vi.simulate(
        vi.Rig(rig, vi.Harmonic(0.5, FREQUENCY)), 4 * cycles, held["section"], samples=8
    )
    return held, vi.contacts(motion)


@pytest.mark.parametrize("name", [*RIGS, *WALLS])
def test_forces_and_impulses_are_those_of_the_contacts(name: str) -> None:
    rig = (RIGS | WALLS)[name]
    held, log = held_and_contacts(rig)
    assert log.sizes["contact_number"]
    for side in held["stop"].values:
        mine = log["contact_stop"].values == side
        forces, impulses = (log[f"contact_{what}"].values for what in ("peak_force", "impulse"))
        force, impulse = held["peak_force"].sel(stop=side), held["peak_impulse"].sel(stop=side)
        if isinstance(getattr(rig, side), vi.RigidStop):
            assert float(force) == np.inf
            assert float(impulse) == pytest.approx(impulses[mine].max(), rel=1e-9)
        else:
            assert float(force) == pytest.approx(forces[mine].max(initial=0.0), rel=1e-9)
            assert float(impulse) == 0.0


@pytest.mark.parametrize("name", [name for name in RIGS if name != "yielding"])
def test_no_moment_of_the_motion_has_a_larger_force(name: str) -> None:
    """Newton's law at samples: what the isolator and the base do not explain is the stops'."""
    rig = RIGS[name]
    held = vi.sweep(vi.Rig(rig, 0.5), [FREQUENCY], "forward").isel(direction=0, frequency=0)
    motion = vi.simulate(
        vi.Rig(rig, vi.Harmonic(0.5, FREQUENCY)), 1, held["section"], samples=20_000
    )
    u, v = motion["displacement"].values, motion["velocity"].values
    stops = -rig.mass * motion["acceleration"].values
    stops -= np.array([rig.isolator.static_force(one) for one in u]) + rig.isolator.damping * v
    for side, sign in (("right", 1.0), ("left", -1.0)):
        if getattr(rig, side) is None:
            continue
        largest = float(held["peak_force"].sel(stop=side))
        seen = max(0.0, (sign * stops)[motion["touching"].sel(stop=side).values].max(initial=0.0))
        assert seen <= largest * (1.0 + 1e-9)
        assert seen >= largest * (1.0 - 1e-3)


def test_right_and_left_change_places_in_the_mirror() -> None:
    rig = RIGS["bumpers"]
    here = vi.sweep(vi.Rig(rig, 0.5), [1.0, FREQUENCY], phase=0.0)
    there = vi.sweep(vi.Rig(rig.mirrored(), 0.5), [1.0, FREQUENCY], phase=np.pi)
    for one, other in (("right", "left"), ("left", "right")):
        np.testing.assert_allclose(
            here["peak_force"].sel(stop=one), there["peak_force"].sel(stop=other), rtol=1e-8
        )


def test_peaks_are_the_larger_ends() -> None:
    data = vi.sweep(vi.Rig(RIGS["bumpers"], 0.5), [1.0, FREQUENCY, 4.0])
    for what in ("displacement", "acceleration"):
        ends = [np.abs(data[f"{what}_{end}"].values) for end in ("max", "min")]
        np.testing.assert_array_equal(data[f"peak_{what}"], np.maximum(*ends))
    assert (data["peak_force"].sel(stop="right").sel(frequency=4.0) == 0.0).all()


def test_a_branch_has_them_too() -> None:
    rig = RIGS["bumpers"]
    held = vi.sweep(vi.Rig(rig, 0.5), [FREQUENCY], "forward").isel(direction=0, frequency=0)
    orbit = vi.branch(
        vi.Rig(rig, vi.Harmonic(0.5, FREQUENCY)), held["section"], vary={"frequency": (1.49, 1.51)}
    )
    at = int(np.argmin(np.abs(orbit["frequency"].values - FREQUENCY)))
    for name in ("peak_displacement", "peak_acceleration", "peak_force"):
        np.testing.assert_allclose(orbit[name][at], held[name], rtol=1e-2)
