"""Random rigs whose isolator yields or slides, followed by tables and by Taylor steps."""

from __future__ import annotations

import math

import numpy as np

import vibroimpact as vi
from vibroimpact.engine import batch
from vibroimpact.engine import parameters as par
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.state import ONE_MASS
from vibroimpact.response.engine_system import engine_rig

CYCLES = 8


def random_rig(
    rng: np.random.Generator, several: bool
) -> tuple[vi.Oscillator, vi.Harmonic | vi.Periodic]:
    """Of unit mass and about unit stiffness, for motions of about unit size."""

    def one_of(*values: float) -> float:
        return float(rng.choice(values))

    damping = one_of(0.0, 0.01, 0.3, 10.0 ** rng.uniform(-3, 0.5))
    isolator: vi.FrictionIsolator | vi.BilinearIsolator
    if rng.random() < 0.5:
        friction = 10.0 ** rng.uniform(-2, 0.3)
        isolator = vi.FrictionIsolator(one_of(0.0, 1.0, 1.0, 1.0), damping, friction)
    else:
        elastic, after = 10.0 ** rng.uniform(0, 1.5), 10.0 ** rng.uniform(-1.5, 0)
        force = elastic * 10.0 ** rng.uniform(-2, 0.5)
        isolator = vi.BilinearIsolator(elastic, one_of(0.0, after, after), force, damping)

    def stop() -> vi.Bumper | vi.RigidStop | None:
        gap = one_of(0.0, rng.uniform(0.05, 1.5), rng.uniform(0.05, 1.5), -rng.uniform(0, 0.3))
        stiffness, kind = 10.0 ** rng.uniform(-1, 4), int(rng.integers(4))
        if kind == 0:
            return None
        if kind == 1:
            e = rng.uniform(0.1, 1)
            return vi.RigidStop(one_of(0.0, 1.0, e, e), gap)
        share = one_of(0.0, 0.1, 10.0 ** rng.uniform(-2, 1))
        return vi.Bumper(stiffness, share * math.sqrt(stiffness), gap)

    right, left = stop(), stop()
    if right is not None and left is not None:
        left = left.replace(gap=max(left.gap, 0.05 - right.gap))
    bears = isolator.strongest == math.inf
    load = one_of(0.0, 0.0, rng.uniform(-0.3, 0.3)) if bears else 0.0
    size, frequency = 10.0 ** rng.uniform(-1, 0.7), 10.0 ** rng.uniform(-0.7, 0.7) / math.tau
    shaken: vi.Harmonic | vi.Periodic = vi.Harmonic(size, frequency, rng.uniform(0, 6))
    if several:
        shaken = vi.Periodic(frequency, size * rng.uniform(0.1, 1, 3), rng.uniform(0, 6, 3))
    return vi.Oscillator(1.0, isolator, right, left, load), shaken


def vectors(rig: vi.Oscillator, shaken: vi.Harmonic | vi.Periodic) -> tuple[np.ndarray, np.ndarray]:
    """The rig for tables, and for Taylor steps: a spring that is next to nothing is no line."""
    tables = engine_rig(vi.Rig(rig, shaken))
    taylor = tables.copy()
    taylor[par.CUBIC] = 1e-300
    return tables, taylor


def started(rig: vi.Oscillator) -> np.ndarray:
    """At rest where it is nearest to 0."""
    state = np.zeros(ONE_MASS.width)
    most = rig.right.gap if rig.right is not None else math.inf
    least = -rig.left.gap if rig.left is not None else -math.inf
    state[ONE_MASS.displacement()] = min(max(0.0, least), most)
    return state


def followed(
    vector: np.ndarray,
    shaken: vi.Harmonic | vi.Periodic,
    state: np.ndarray,
    share: float = 0.0,
    samples: int = 1,
    cycles: int = CYCLES,
) -> tuple[int, np.ndarray, np.ndarray, np.ndarray]:
    """Outcome, samples, events and the end; amplitude and phase off by a share."""
    end, events = state.copy(), np.empty((20_000, record_layout.EVENT))
    out = np.empty((record_layout.SAMPLE, cycles * samples + 1))
    size = shaken.amplitude if isinstance(shaken, vi.Harmonic) else 1.0
    _, count, outcome = batch.trajectory(
        vector, size * (1.0 + share), shaken.frequency, shaken.phase + share, end, 0.0,
        float(cycles), samples, 3000, out, events,
    )  # fmt: skip
    return outcome, out, events[:count], end
