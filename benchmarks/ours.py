"""Problem P by this package."""

import math
from collections.abc import Callable

import numpy as np

import vibroimpact as vi
from benchmarks.peers.problem import P, Problem
from vibroimpact.engine import batch
from vibroimpact.engine import motion as layout
from vibroimpact.engine.observers import record
from vibroimpact.engine.parameters import rig_vector

# a cos(Ωt) on the right-hand side is a base acceleration A sin(ωt + φ) with A = a, φ = −π/2.
PHASE = -0.5 * math.pi
_MAX_EVENTS = 100


def frequency(problem: Problem = P) -> float:
    """Forcing frequency in cycles per unit of time."""
    return problem.frequency / math.tau


def vector(problem: Problem = P) -> np.ndarray:
    """Return the rig as the engine takes it."""
    bumper = (problem.bumper_stiffness, problem.bumper_damping, problem.gap)
    return rig_vector(1.0, 1.0, 2.0 * problem.damping_ratio, bumper, bumper)


def oscillator(problem: Problem = P) -> vi.Oscillator:
    """Return the rig as users write it, of mass 1 kg and stiffness 1 N/m."""
    bumper = vi.Bumper(problem.bumper_stiffness, problem.bumper_damping, problem.gap)
    return vi.Oscillator(1.0, vi.Isolator(1.0, 2.0 * problem.damping_ratio), bumper, bumper)


def engine(periods: int, problem: Problem = P) -> Callable[[], tuple[float, float]]:
    """Return a call of the engine from rest over a number of forcing periods.

    It is the call that `vi.simulate(..., samples=0)` makes, and returns x and x′ at the end.
    """
    rig, hertz = vector(problem), frequency(problem)
    state = np.zeros(layout.STATE)
    out = np.empty((0, record.SAMPLE))
    events = np.empty((_MAX_EVENTS + 1, record.EVENT))

    def call() -> tuple[float, float]:
        state[:] = 0.0
        batch.trajectory(
            rig,
            problem.amplitude,
            hertz,
            PHASE,
            state,
            0.0,
            float(periods),
            0,
            _MAX_EVENTS,
            out,
            events,
        )
        return float(state[layout.U]), float(state[layout.V])

    return call


def simulate(periods: int, problem: Problem = P) -> Callable[[], tuple[float, float]]:
    """Return the same by the public function, which checks, labels and describes."""
    rig = oscillator(problem)
    shaking = vi.Harmonic(problem.amplitude, frequency(problem), PHASE)

    def call() -> tuple[float, float]:
        data = vi.simulate(rig, shaking, cycles=periods, samples=0)
        x, v = data["final_state"].values[:2].tolist()
        return x, v

    return call
