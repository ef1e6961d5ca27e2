"""A lower bound for the engine's time: the same motion with all event times known beforehand.

What is replayed is the steady orbit of problem P. Each phase is one table row and one short
Taylor series, as in the engine; no interval is looked at and no root is sought. So the bound is
the chain of operations in which each event waits for the one before it.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray

import vibroimpact as vi
from benchmarks import ours
from benchmarks.peers.problem import P
from vibroimpact.engine.jit import OPTIONS
from vibroimpact.engine.linear.evaluate import node, travel
from vibroimpact.engine.linear.layout import NODES, PLAN, SIZE, TABLES, H, Row
from vibroimpact.engine.linear.tables import build
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.motion import LEFT, RIGHT
from vibroimpact.engine.parameters import SIZE as RIG
from vibroimpact.engine.state import FLIGHT

_Vector = NDArray[np.float64]
_SETTLED = 200


@dataclass(frozen=True, slots=True)
class Orbit:
    """One steady forcing period, from one event to the same one a period later."""

    start: tuple[float, float, float, float]
    """u, u′ and sine and cosine of the forcing phase at its beginning."""
    modes: tuple[int, ...]
    times: tuple[float, ...]
    """How long each phase lasts."""

    @property
    def contacts(self) -> int:
        """How many contacts there are in a period."""
        return sum(mode != FLIGHT for mode in self.modes)


def orbit() -> Orbit:
    """Find the steady orbit of problem P."""
    shaking = vi.Harmonic(P.amplitude, ours.frequency(), ours.PHASE)
    data = vi.simulate(vi.Rig(ours.oscillator(), shaking), cycles=_SETTLED)
    at = data["event_time"].values
    events = int(np.sum(data["event_cycle"].values == _SETTLED - 1))
    last = slice(-events - 1, None)
    touching = data["event_contact"].values[last][:-1] == 1
    right = data["event_stop"].values[last][:-1] == "right"
    modes = np.where(touching, np.where(right, RIGHT, LEFT), FLIGHT)
    u = data["event_displacement"].values[last][0]
    v = data["event_velocity"].values[last][0]
    angle = P.frequency * at[last][0] + ours.PHASE
    start = (float(u), float(v), float(np.sin(angle)), float(np.cos(angle)))
    return Orbit(start, tuple(modes.tolist()), tuple(np.diff(at[last]).tolist()))


@numba.njit(**OPTIONS)
def _steps(memory: _Vector, amplitude: float, omega: float) -> tuple[float, float, float]:
    plan = pointer(memory)
    build(plan, amplitude, omega)
    steps = (plan[TABLES + H], plan[TABLES + SIZE + H], plan[TABLES + 2 * SIZE + H])
    memory[0] += 0.0  # keeps it alive until here
    return steps


@numba.njit(**OPTIONS)
def _replay(
    memory: _Vector,
    gap: float,
    modes: NDArray[np.int64],
    nodes: NDArray[np.int64],
    rests: _Vector,
    start: tuple[float, float, float, float],
    periods: int,
) -> tuple[float, float, float, float]:
    plan = pointer(memory)
    u, v, s, c = start
    for _ in range(periods):
        for i in range(len(modes)):
            mode = modes[i]
            table = TABLES + SIZE * mode
            sign = -1.0 if mode == LEFT else 1.0
            shift = 0.0 if mode == FLIGHT else gap
            row = Row(sign * u - shift, sign * v, sign * s, sign * c)
            row = node(plan, table, nodes[i], row)
            x, v, s, c = travel(plan, table, rests[i], row)
            u, v, s, c = sign * (x + shift), sign * v, sign * s, sign * c
    memory[0] += 0.0  # keeps it alive until here
    return u, v, s, c


@dataclass(frozen=True, slots=True)
class Floor:
    """The replay of a number of periods, and what the engine has to look at beyond it."""

    call: Callable[[], tuple[float, float, float, float]]
    orbit: Orbit
    rows: int
    """Table rows that the engine looks at in a period in search of events."""


def floor(periods: int) -> Floor:
    """Prepare the replay."""
    known = orbit()
    memory = np.zeros(PLAN)
    memory[:RIG] = ours.vector()
    h = _steps(memory, P.amplitude, P.frequency)
    lengths = np.array([t / h[mode] for t, mode in zip(known.times, known.modes, strict=True)])
    nodes = lengths.astype(np.int64)
    if nodes.max() >= NODES:
        raise RuntimeError("a phase is longer than a table")
    modes = np.array(known.modes, dtype=np.int64)
    rests = lengths - nodes

    def call() -> tuple[float, float, float, float]:
        u, v, s, c = _replay(memory, P.gap, modes, nodes, rests, known.start, periods)
        return u, v, s, c

    difference = np.abs(np.subtract(call(), known.start)).max()
    if not difference < 1e-9:
        raise RuntimeError(f"the replay has left the orbit by {difference:g}")
    return Floor(call, known, int(np.sum(nodes + 1)))
