"""Motions that coexist: all of them, each once."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.stability.coexisting import find_motions


@cache
def motions(code: str, frequency: float, random: int = 12):
    case = vi.laboratory.case(code)
    return find_motions(
        vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, frequency)), random=random, samples=32
    )


def test_with_and_without_impact():
    large, small = motions("B2-G1-A3", 2.6)
    assert "forward branch" in large.attrs["starts"]
    assert "backward branch" in small.attrs["starts"]
    assert "rest" in small.attrs["starts"]
    assert float(large["impacts"].sel(stop="right")) == 1.0
    assert small.sizes["contact_number"] == 0
    assert [bool(m["mirror_pair"]) for m in (large, small)] == [False, False]


def test_every_start_is_accounted_for():
    attractors = motions("B2-G1-A3", 2.6)
    names = ", ".join(m.attrs["starts"] for m in attractors).split(", ")
    assert sorted(names) == sorted(
        ["rest", "forward branch", "backward branch", *(f"random {i}" for i in range(1, 13))]
    )


@pytest.mark.parametrize(("frequency", "kind"), [(1.12, "periodic"), (1.06, "chaotic")])
def test_a_mirrored_pair_is_one(frequency, kind):
    (one,) = motions("B3-10mm-A3", frequency)
    assert one["motion"].item() == kind
    assert bool(one["mirror_pair"])
    ways = [one.attrs["starts"], one.attrs["mirrored_starts"]]
    assert all("random" in way for way in ways)
    if kind == "periodic":
        assert "mirror image" in one.attrs["mirrored_starts"]


def test_motions_that_differ_by_whole_cycles_are_one():
    """Period 5, from many starts: five sections of the same orbit."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), vi.Bumper(29.0, 0.0, 1.26), None)
    omega = 0.81
    shaken = vi.Harmonic(0.7 * omega**2, omega / (2 * np.pi), np.pi)
    starts = {f"given {i}": vi.State(0.2 * i, 0.1, phase=np.pi) for i in range(5)}
    attractors = find_motions(vi.Rig(rig, shaken), starts=starts, random=0, samples=8)
    five = [m for m in attractors if int(m["period"]) == 5]
    assert len(five) == 1
    assert five[0].attrs["starts"].count("given") >= 2
    assert not any(bool(m["mirror_pair"]) for m in attractors)  # one bumper: no mirror image


def test_the_same_seed_finds_the_same():
    case = vi.laboratory.case("B3-10mm-A3")
    shaken = vi.Harmonic(case.amplitude, 0.7)
    names = [
        [
            m.attrs["starts"]
            for m in find_motions(vi.Rig(case.oscillator, shaken), seed=seed, samples=8)
        ]
        for seed in (3, 3, 4)
    ]
    assert names[0] == names[1]
    assert names[0] != names[2]


def test_frequencies_of_the_sweeps():
    """A forward sweep that begins above the jump does not arrive on the large motion."""
    case = vi.laboratory.case("B2-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 2.6)
    attractors = find_motions(
        vi.Rig(case.oscillator, shaken), frequencies=[2.59, 2.61, 3.0], random=0, samples=8
    )
    assert [m.attrs["starts"] for m in attractors] == ["rest, forward branch, backward branch"]


@pytest.mark.parametrize(
    "wrong",
    [
        {"random": -1},
        {"random": 1.5},
        {"window": 0},
        {"frequencies": []},
        {"starts": [vi.State(0.01)]},
    ],
)
def test_refused(wrong):
    case = vi.laboratory.case("B2-G1-A3")
    with pytest.raises(vi.InputError, match=next(iter(wrong))):
        find_motions(vi.Rig(case.oscillator, vi.Harmonic(0.5, 2.0)), **wrong)


def test_starts_with_a_phase_of_their_own():
    """The same orbit from rest at another phase, and from a dataset that ends in mid cycle."""
    case = vi.laboratory.case("B2-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 1.5)
    part = vi.simulate(vi.Rig(case.oscillator, shaken), 30.25, samples=0)
    attractors = find_motions(
        vi.Rig(case.oscillator, shaken),
        random=0,
        frequencies=[1.45],
        starts={"x": vi.State(0.0, 0.0, phase=1.0), "y": part},
        samples=8,
    )
    assert len(attractors) == 1
    assert attractors[0].attrs["starts"] == "rest, forward branch, x, y"


def test_the_event_limit():
    case = vi.laboratory.case("B3-10mm-A3")
    with pytest.warns(RuntimeWarning, match="max_events"):
        attractors = find_motions(
            vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.06)), max_events=6, samples=8
        )
    given_up = [m for m in attractors if "max_events" in m.attrs["message"]]
    assert len(given_up) == 1
    names = ", ".join(m.attrs["starts"] + ", " + m.attrs["mirrored_starts"] for m in attractors)
    assert all(f"random {i}" in names for i in range(1, 13))


def test_random_starts_between_walls():
    """They reach as far as the motion does, and half as much again, but not into the wall."""
    isolator = vi.Isolator("26.8 kN/m", "1.1 kN s/m")
    bumper = vi.Bumper("510 kN/m", "0.9 kN s/m", "-1 mm")
    rig = vi.Oscillator("550 kg", isolator, vi.RigidStop(0.6, "5 mm"), bumper)
    shaken = vi.Harmonic("0.05 g", "1.78 Hz")
    attractors = find_motions(vi.Rig(rig, shaken), frequencies=[1.78, 2.0], random=4, samples=8)
    names = {name for one in attractors for name in one.attrs["starts"].split(", ")}
    assert {f"random {i}" for i in range(1, 5)} <= names
    assert all(
        float(one["displacement_max"]) == pytest.approx(5e-3, rel=1e-12) for one in attractors
    )


def test_a_mass_that_a_preload_presses_against_a_wall_starts_at_its_equilibrium() -> None:
    """At u = 0 it would lie inside the wall. Chaotic motions surround a periodic one."""
    wall = vi.Oscillator("550 kg", vi.Isolator("26 kN/m", "0.2 kN s/m"), None, WALL)
    rig = vi.Rig(wall, "0.3 g")
    attractors = vi.coexisting_motions(rig, frequency=0.6, random=12, exponent_cycles=2000)
    assert "periodic" in attractors["motion"].values
    assert (attractors["displacement_min"] >= 0.02 - 1e-12).all()
    with pytest.raises(vi.InputError, match=r"rigid left stop; pass at least 0\.02 m"):
        vi.simulate(rig, 1.0, start=vi.State(0.0), frequency=0.6)


WALL = vi.RigidStop(0.95, "-20 mm")
