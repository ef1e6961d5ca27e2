"""Problem P by this package."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

import vibroimpact as vi
from benchmarks.peers.problem import P, Problem
from vibroimpact.engine import batch, flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.parameters import rig_vector
from vibroimpact.engine.state import ONE_MASS, copy, state_buffer, width
from vibroimpact.engine.status import Status
from vibroimpact.law_numbers import IsolatorNumbers, StopNumbers

# a cos(Ωt) on the right-hand side is a base acceleration A sin(ωt + φ) with A = a, φ = −π/2.
PHASE = -0.5 * math.pi
_MAX_EVENTS = 100


def frequency(problem: Problem = P) -> float:
    """Forcing frequency in cycles per unit of time."""
    return problem.frequency / math.tau


def vector(problem: Problem = P) -> np.ndarray:
    """Return the rig as the engine takes it."""
    return stopped((problem.bumper_stiffness, problem.bumper_damping, problem.gap), problem)


def stopped(stop: StopNumbers, problem: Problem = P) -> np.ndarray:
    """Return the same mass and isolator between two others of these stops."""
    return rig_vector(1.0, 1.0, 2.0 * problem.damping_ratio, stop, stop)


def oscillator(problem: Problem = P) -> vi.Oscillator:
    """Return the rig as users write it, of mass 1 kg and stiffness 1 N/m."""
    bumper = vi.Bumper(problem.bumper_stiffness, problem.bumper_damping, problem.gap)
    return vi.Oscillator(1.0, vi.Isolator(1.0, 2.0 * problem.damping_ratio), bumper, bumper)


def yielding(law: IsolatorNumbers, stiffness: float = 1.0, problem: Problem = P) -> np.ndarray:
    """Return the same mass, dashpot and bumpers with an isolator that yields or slides."""
    bumper = (problem.bumper_stiffness, problem.bumper_damping, problem.gap)
    return rig_vector(1.0, stiffness, 2.0 * problem.damping_ratio, bumper, bumper, law=law)


def engine(
    periods: int, problem: Problem = P, rig: np.ndarray | None = None
) -> Callable[[], tuple[float, float]]:
    """Return a call of the engine from rest over a number of forcing periods.

    It is the call that `vi.simulate(..., samples=0)` makes, and returns x and x′ at the end.
    Another rig may take the place of the problem's.
    """
    rig = vector(problem) if rig is None else rig
    return trajectory(rig, problem.amplitude, frequency(problem), PHASE, periods)


def trajectory(
    rig: np.ndarray, amplitude: float, hertz: float, phase: float, periods: int
) -> Callable[[], tuple[float, float]]:
    """Return a call of the engine for any rig's vector, from rest."""
    state = np.zeros(ONE_MASS.width)
    out = np.empty((record_layout.SAMPLE, 0))
    events = np.empty((_MAX_EVENTS + 1, record_layout.EVENT))

    def call() -> tuple[float, float]:
        state[:] = 0.0
        _, _, outcome = batch.trajectory(
            rig,
            amplitude,
            hertz,
            phase,
            state,
            0.0,
            float(periods),
            0,
            _MAX_EVENTS,
            out,
            events,
        )
        if outcome:
            raise RuntimeError(Status(outcome).advice)
        return float(state[ONE_MASS.displacement()]), float(state[ONE_MASS.velocity()])

    return call


def events(periods: int, rig: np.ndarray, problem: Problem = P) -> int:
    """Count what happens in so many forcing periods from rest."""
    state = np.zeros(ONE_MASS.width)
    buffer = np.empty(((periods + 1) * _MAX_EVENTS, record_layout.EVENT))
    out = np.empty((record_layout.SAMPLE, 0))
    shaking = (problem.amplitude, frequency(problem), PHASE)
    _, count, _ = batch.trajectory(
        rig, *shaking, state, 0.0, float(periods), 0, _MAX_EVENTS, out, buffer
    )
    return int(count)


def linear(rig: vi.Oscillator) -> tuple[vi.Isolator, vi.Bumper]:
    """Return the isolator and the right stop of a rig whose laws are linear."""
    isolator, stop = rig.isolator, rig.right
    if not (isinstance(isolator, vi.Isolator) and isinstance(stop, vi.Bumper)):
        raise TypeError(f"the laws of {rig} are not linear")
    return isolator, stop


@entry("i8(f8[::1], f8, f8, f8, i8, f8[::1])")
def _counted(
    memory: Any,
    rig: Vector,
    amplitude: float,
    frequency: float,
    phase: float,
    periods: int,
    state: Vector,
) -> int:
    plan = planned(memory, rig)
    flow.build(plan, amplitude, math.tau * frequency)
    here = state_buffer()
    copy(pointer(state), here, width(plan))
    total = 0
    for _ in range(periods):
        total += flow.cycle(
            plan, here, math.sin(phase), math.cos(phase), 1.0 / frequency, _MAX_EVENTS
        )
    return total


def ends(periods: int, rig: np.ndarray, problem: Problem = P) -> int:
    """Count what ends a stretch in so many forcing periods from rest: turns and yields as well."""
    state = np.zeros(ONE_MASS.width)
    shaking = (problem.amplitude, frequency(problem), PHASE)
    return int(_counted(rig, *shaking, periods, state))


def simulate(
    periods: int, problem: Problem = P, samples: int = 0
) -> Callable[[], tuple[float, float]]:
    """Return the same by the public function, which checks, labels and describes."""
    rig = oscillator(problem)
    shaking = vi.Harmonic(problem.amplitude, frequency(problem), PHASE)

    def call() -> tuple[float, float]:
        data = vi.simulate(vi.Rig(rig, shaking), cycles=periods, samples=samples)
        x, v = data["final_state"].values[:2].tolist()
        return x, v

    return call
