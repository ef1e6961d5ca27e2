"""Rigs of curved laws, and how the tests follow them."""

from __future__ import annotations

import math
from itertools import cycle, product

import numpy as np

import vibroimpact as vi
from formula_stops import formula_stops
from samples import sample
from vibroimpact.engine import batch
from vibroimpact.engine import parameters as par
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.engine_system import engine_rig

ISOLATORS = {
    "linear": vi.Isolator(1.0, 0.2),
    "duffing": vi.PolynomialIsolator(1.0, 0.2, 0.5, 0.1),
    "softening": vi.PolynomialIsolator(1.0, 0.2, -0.02),
    "friction": vi.FrictionIsolator(1.0, 0.1, 0.15),
    "bilinear": vi.BilinearIsolator(2.0, 0.5, 0.5, 0.1),
    "bouc-wen": vi.BoucWenIsolator(2.0, 0.5, 0.5, 0.1),
    "bouc-wen of 2": vi.BoucWenIsolator(2.0, 0.5, 0.5, 0.1, 2, 0.6, 0.4),
    "bouc-wen of 3": vi.BoucWenIsolator(2.0, 0.5, 0.5, 0.1, 3, 0.7, 0.3),
    "exponential": vi.ExponentialIsolator(3.0, 0.5, 2.0, 0.1, 0.1, 1.5),
    "drag": vi.Isolator(1.0, 0.2, damping_exponent=2.0),
    "fluid": vi.Isolator(1.0, 0.2, damping_exponent=0.6),
}
"""One of each law, for masses of 1 kg."""

HYSTERETIC = ("bilinear", "bouc-wen", "bouc-wen of 2", "bouc-wen of 3", "exponential")

STOPS = {
    "bumper": vi.Bumper(30.0, 0.6, 0.5),
    "spring": vi.Bumper(30.0, 0.0, 0.5),
    "rigid": vi.RigidStop(0.7, 0.5),
    "hunt-crossley": vi.PowerBumper(40.0, 0.5, dissipation=0.3),
    "flores": vi.PowerBumper(40.0, 0.5, restitution=0.6, relation="flores"),
    "pounding": vi.JankowskiBumper(40.0, 0.5, 0.6, 1.0),
    **formula_stops(40.0, 0.5),
}


def pairs(*without: str) -> list[tuple[str, str]]:
    """Isolators and stops, but without some of these: all pairs, or each isolator and each stop."""
    stops = [name for name in STOPS if name not in without]
    return sample([*product(ISOLATORS, stops)], [*zip(ISOLATORS, cycle(stops), strict=False)])


SHAKEN = vi.Harmonic(0.6, 0.9 / math.tau, 0.4)


def between(isolator: str, stop: str | None, other: str | None = None) -> vi.Oscillator:
    """A rig with the same stop on both sides unless said."""
    right = STOPS[stop] if stop else None
    left = STOPS[other] if other else right
    return vi.Oscillator(1.0, ISOLATORS[isolator], right, left)


def followed(
    rig: vi.Oscillator,
    shaken: vi.Harmonic,
    cycles: float,
    state: np.ndarray,
    curved: bool = True,
) -> np.ndarray:
    """The state behind so many cycles, by Taylor steps whatever the laws."""
    vector = engine_rig(vi.Rig(rig, shaken)).copy()
    if curved:
        vector[par.CURVED] = 1.0
    end = state.copy()
    _, _, outcome = batch.trajectory(
        vector, shaken.amplitude, shaken.frequency, shaken.phase, end, 0.0, float(cycles), 0, 3000,
        np.empty((0, record_layout.SAMPLE)), np.empty((3001, record_layout.EVENT)),
    )  # fmt: skip
    assert outcome == 0
    return end


def started(rig: vi.Oscillator, *state: float) -> np.ndarray:
    """A start as the engine has it."""
    return engine_state(rig, vi.State(*state))
