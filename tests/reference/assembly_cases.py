"""Assemblies with curved links, of which `assembly_states` knows the motion to 25 digits.

Each touches its stops late in the motion, and none is chaotic.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import vibroimpact as vi

CYCLES = 20


class Case(NamedTuple):
    """A rig and the state from which it starts."""

    rig: vi.Rig
    start: vi.State


def case(
    masses: dict[str, float],
    links: dict[str, tuple[str, str, Any]],
    stops: dict[str, tuple[str, str, Any]],
    amplitude: float,
    frequency: float,
    speeds: dict[str, float],
) -> Case:
    """With velocities at the start, so that links know which way they go."""
    parts = {
        part: {name: vi.Link(*one) for name, one in table.items()}
        for part, table in (("links", links), ("stops", stops))
    }
    shaken = vi.Harmonic(amplitude, frequency, 0.3)
    return Case(vi.Rig(vi.Assembly(masses, **parts), shaken), vi.State(velocity=speeds))


LINEAR = vi.Isolator(140.0, 1.2)
STOREY = vi.Isolator(900.0, 2.0)
CUBIC = vi.PolynomialIsolator(120.0, 1.0, cubic=6e4)
QUINTIC = vi.PolynomialIsolator(400.0, 1.5, cubic=-2e4, quintic=5e7)
BOUC_WEN = vi.BoucWenIsolator(400.0, 60.0, 3.0, 0.8)
SHARP = vi.BoucWenIsolator(500.0, 80.0, 2.0, 0.8, exponent=3)
BILINEAR = vi.BilinearIsolator(500.0, 70.0, 2.0, 0.8)
EXPONENTIAL = vi.ExponentialIsolator(400.0, 60.0, 40.0, 0.8)
PENDULUM = vi.FrictionIsolator.from_pendulum(3.0, 0.25, 0.04)
BUMPER = vi.Bumper(1.5e4, 15.0, 0.012)
ELASTIC = vi.Bumper(1e4, 0.0, 0.015)
HUNT = vi.PowerBumper(2e5, 0.012, dissipation=0.5)
RESTITUTION = vi.PowerBumper(2e5, 0.01, restitution=0.6)
JANKOWSKI = vi.JankowskiBumper(2e5, 0.012, 0.6)
SQUARE = vi.PowerBumper(2e6, 0.012, exponent=2.0, dissipation=0.4)

CASES = {
    "two, cubic": case(
        {"a": 1.2, "b": 0.9},
        {"i": ("ground", "a", LINEAR), "j": ("ground", "b", CUBIC)},
        {"s": ("a", "b", BUMPER), "w": ("ground", "a", BUMPER)},
        3.0,
        1.9,
        {"a": 0.1, "b": -0.2},
    ),
    "two, bouc-wen and jankowski": case(
        {"a": 1.0, "b": 0.7},
        {"i": ("ground", "a", BOUC_WEN), "j": ("ground", "b", LINEAR)},
        {"s": ("a", "b", JANKOWSKI), "w": ("b", "ground", ELASTIC)},
        3.0,
        1.6,
        {"a": 0.1, "b": -0.2},
    ),
    "two, polynomials and a rigid stop": case(
        {"a": 1.0, "b": 0.7},
        {"i": ("ground", "a", QUINTIC), "j": ("ground", "b", CUBIC)},
        {"s": ("a", "b", vi.RigidStop(0.6, 0.012)), "w": ("b", "ground", HUNT)},
        3.0,
        1.7,
        {"a": 0.1, "b": -0.2},
    ),
    "three, bilinear base between hunt-crossley stops": case(
        {"base": 1.2, "mid": 1.0, "top": 0.8},
        {
            "i": ("ground", "base", BILINEAR),
            "m": ("base", "mid", STOREY),
            "t": ("mid", "top", STOREY),
        },
        {"r": ("base", "ground", HUNT), "l": ("ground", "base", HUNT)},
        3.0,
        1.1,
        {"base": 0.1, "mid": 0.15, "top": 0.2},
    ),
    "three, friction pendulum base between bumpers": case(
        {"base": 1.2, "mid": 1.0, "top": 0.8},
        {
            "i": ("ground", "base", PENDULUM),
            "m": ("base", "mid", STOREY),
            "t": ("mid", "top", STOREY),
        },
        {"r": ("base", "ground", BUMPER), "l": ("ground", "base", HUNT)},
        3.0,
        0.7,
        {"base": 0.1, "mid": 0.15, "top": 0.2},
    ),
    "three in a row, bouc-wen, powers": case(
        {"a": 1.0, "b": 1.3, "c": 0.8},
        {"i": ("ground", "a", SHARP), "j": ("ground", "b", LINEAR), "k": ("ground", "c", CUBIC)},
        {"ab": ("a", "b", RESTITUTION), "bc": ("b", "c", SQUARE), "w": ("c", "ground", BUMPER)},
        2.5,
        1.7,
        {"a": 0.1, "b": -0.05, "c": 0.2},
    ),
    "four, exponential base at bumpers": case(
        {"base": 1.2, "one": 1.0, "two": 1.0, "top": 0.8},
        {
            "i": ("ground", "base", EXPONENTIAL),
            "x": ("base", "one", STOREY),
            "y": ("one", "two", STOREY),
            "z": ("two", "top", STOREY),
        },
        {"r": ("base", "ground", BUMPER), "l": ("ground", "base", BUMPER)},
        3.0,
        1.0,
        {"base": 0.1, "one": 0.15, "two": 0.17, "top": 0.2},
    ),
    "four, bilinear and bouc-wen links between masses": case(
        {"a": 1.0, "b": 0.9, "c": 1.1, "d": 0.8},
        {
            "i": ("ground", "a", LINEAR),
            "x": ("a", "b", BILINEAR),
            "y": ("ground", "c", CUBIC),
            "z": ("c", "d", BOUC_WEN),
        },
        {"bc": ("b", "c", BUMPER), "d": ("d", "ground", HUNT), "w": ("ground", "a", JANKOWSKI)},
        3.0,
        1.6,
        {"a": 0.1, "b": -0.05, "c": 0.2, "d": -0.1},
    ),
}
