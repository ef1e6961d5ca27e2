"""Rigs of every law under every kind of shaking, whose motion `shaken_states` knows to 25 digits.

Under each kind of shaking each stop stands on the right once and on the left once (a bumper also
opposite each stop of `LATER`), and each isolator bears the mass at least once. Each rig touches
both of its stops, and none is chaotic. A new law is an entry of `LATER`; a stop that a formula
gives needs none.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

import vibroimpact as vi
from reference.law_cases import (
    MASS,
    PLAIN,
    STIFFNESS,
    Case,
    bumper,
    hertz,
    pounding,
    wall,
)

CYCLES = 6
"""Periods that are followed; of a record `LINES` from sample to sample."""
LINES = 60
STEP = 0.05

ISOLATORS: dict[str, Any] = {
    "linear": PLAIN,
    "friction": vi.FrictionIsolator(STIFFNESS, 300.0, 80.0),
    "bilinear": vi.BilinearIsolator(60e3, 20e3, 150.0, 600.0),
    "polynomial": vi.PolynomialIsolator(10e3, 900.0, 2e8, 1e11),
    "bouc-wen, n = 2": vi.BoucWenIsolator(80e3, 18e3, 150.0, 600.0, 2),
    "bouc-wen, n = 30": vi.BoucWenIsolator(80e3, 18e3, 150.0, 600.0, 30, 0.6, 0.4),
    "exponential": vi.ExponentialIsolator(100e3, 18e3, 300.0, 500.0, 150.0, 20.0),
    "drag 2": vi.Isolator(STIFFNESS, 12e3, 2.0),
    "drag 0.5": vi.Isolator(STIFFNESS, 250.0, 0.5),
    "drag 1.5": vi.Isolator(STIFFNESS, 4e3, 1.5),
}
STOPS: dict[str, Callable[[float], Any]] = {
    "bumper": bumper,
    "power 1.25": lambda gap: vi.PowerBumper(3e6, gap, 1.25, dissipation=0.5),
    "restitution": lambda gap: hertz(gap, restitution=0.6),
    "wall": wall,
    "jankowski": pounding,
    "hunt-crossley": lambda gap: hertz(gap, restitution=0.6, relation="hunt-crossley"),
    "elastic hertz": hertz,
    "flores": lambda gap: hertz(gap, restitution=0.7, relation="flores"),
    "dissipation": lambda gap: hertz(gap, dissipation=0.5),
    "gonthier": lambda gap: hertz(gap, restitution=0.5, relation="gonthier"),
    "power 2.5 by restitution": lambda gap: vi.PowerBumper(3e9, gap, 2.5, restitution=0.6),
    "lankarani-nikravesh": lambda gap: hertz(gap, restitution=0.6, relation="lankarani-nikravesh"),
}

LATER: dict[str, Callable[[float], Any]] = {}
"""Further stops. Each stands opposite a bumper on either side: an entry at the end of `STOPS` would
change the pairs, and with them the stored states, of other stops."""


def record(size: float) -> vi.Record:
    """Noise of so many m/s²."""
    return vi.Record(np.random.default_rng(11).uniform(-size, size, LINES + 1), STEP)


SHAKEN: dict[str, Callable[[float], Any]] = {
    "sine": lambda size: vi.Harmonic(0.6 * size, 1.2, 0.4),
    "odd harmonics": lambda size: vi.Periodic(1.1, [0.6 * size, 0.0, 0.5 * size], [0.3, 0.0, -1.0]),
    "even harmonics": lambda size: vi.Periodic(
        0.7, [0.3 * size, 0.6 * size, 0.0, 0.2 * size], [0.2, 1.0, 0.0, -0.5]
    ),
    "record": lambda size: record(2.0 * size),
    "displacement": lambda size: vi.Periodic(
        1.2, [0.01 * size, 0.0008 * size], [0.4, 0.0], of="displacement"
    ),
    "force": lambda size: vi.Periodic(1.2, [330.0 * size, 80.0 * size], [0.4, 1.0], of="force"),
}
SIZES: dict[str, float] = {"record: linear, power 1.25 and hunt-crossley": 1.2}
"""What some rigs are shaken by besides, to touch both stops and not to be chaotic."""


def cases(later: dict[str, Callable[[float], Any]]) -> dict[str, Case]:
    """The rigs by name, of which those without a stop of `later` do not depend on `later`."""
    by_name = {}
    isolators, stops = list(ISOLATORS), list(STOPS)
    stop_of = {**STOPS, **later}
    for kind, (shaken, shaking) in enumerate(SHAKEN.items()):
        pairs = [(right, stops[(i + kind + 1) % len(stops)]) for i, right in enumerate(stops)]
        pairs += [pair for one in later for pair in ((one, "bumper"), ("bumper", one))]
        for i, (right, left) in enumerate(pairs):
            isolator = isolators[(i + 3 * kind) % len(isolators)]
            name = f"{shaken}: {isolator}, {right} and {left}"
            rig = vi.Oscillator(
                MASS, ISOLATORS[isolator], stop_of[right](7e-3), stop_of[left](6e-3)
            )
            by_name[name] = Case(rig, shaking(SIZES.get(name, 1.0)))
    return by_name


CASES = cases(LATER)


def cycles(one: Case) -> int:
    """Periods or lines that a case is followed."""
    return LINES if isinstance(one.shaken, vi.Record) else CYCLES


def marks(one: Case) -> tuple[int, ...]:
    """Periods or lines behind which its state is stored."""
    return tuple(cycles(one) * part // 6 for part in (1, 3, 6))
