"""Systems on which the flow is tried."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from vibroimpact.engine.assembly.plan import (
    GROUND,
    Forcing,
    Stop,
    base_motion,
    make_plan,
    record_motion,
    state_width,
)
from vibroimpact.engine.jit import Vector


class System(NamedTuple):
    """A description and its forcing."""

    mass: Any
    damping: Any
    stiffness: Any
    stops: list[Stop]
    forcing: Forcing
    amplitude: float = 0.0
    omega: float = 1.0
    constant: Any = None

    @property
    def n(self) -> int:
        return len(self.mass)

    def plan(self, tables: bool = True) -> Vector:
        return make_plan(*self[:5], constant=self.constant, tables=tables)

    def state(self, u: Any = None, v: Any = None) -> Vector:
        state = np.zeros(state_width(self.n, len(self.stops)))
        if u is not None:
            state[2 : 2 + self.n] = u
        if v is not None:
            state[2 + self.n : 2 + 2 * self.n] = v
        return state

    @property
    def period(self) -> float:
        return 2.0 * math.pi / self.omega


def joined(n: int, links: list[tuple[int, int, float, float]]) -> tuple[Any, Any]:
    """Damping and stiffness of links (left, right, stiffness, damping)."""
    c, k = np.zeros((n, n)), np.zeros((n, n))
    for left, right, stiffness, damping in links:
        w = np.zeros(n)
        if left != GROUND:
            w[left] += 1.0
        if right != GROUND:
            w[right] -= 1.0
        c += damping * np.outer(w, w)
        k += stiffness * np.outer(w, w)
    return c, k


def neighbours() -> System:
    """Two masses, a bumper between them, and one on the left."""
    mass = np.diag([1.2, 0.9])
    c, k = joined(2, [(0, GROUND, 130.0, 0.9), (1, GROUND, 222.0, 1.1)])
    stops = [Stop(0, 1, 0.012, 2.5e4, 25.0), Stop(GROUND, 0, 0.02, 3.0e4, 30.0)]
    return System(mass, c, k, stops, base_motion(mass, np.ones(2)), 3.0, 2 * math.pi * 1.9)


def storeys(n: int = 4, walls: int = 2) -> System:
    """A building on a base that hits its moat, one wall elastic without a dashpot."""
    mass = np.eye(n)
    links = [(GROUND, 0, 400.0, 5.0), *((i, i + 1, 500.0, 5.0) for i in range(n - 1))]
    c, k = joined(n, links)
    stops = [Stop(n - 1, GROUND, 0.02, 2.0e4, 20.0), Stop(GROUND, 0, 0.01, 3.0e4)][:walls]
    return System(mass, c, k, stops, base_motion(mass, np.ones(n)), 3.0, 2 * math.pi * 1.2)


def row(restitution: float | None = None) -> System:
    """Three masses with stops between all and a wall, two harmonics, a constant force."""
    mass = np.diag([1.0, 1.3, 0.8])
    c, k = joined(3, [(i, GROUND, 140.0 + 40.0 * i, 0.8) for i in range(3)])
    pair = (
        {"stiffness": 2.0e4, "damping": 22.0}
        if restitution is None
        else {"restitution": restitution}
    )
    stops = [Stop(0, 1, 0.01, **pair), Stop(1, 2, 0.012, **pair), Stop(2, GROUND, 0.02, **pair)]
    forcing = base_motion(mass, np.ones(3), [(1.0, 0.0), (0.4, 0.7)])
    return System(
        mass, c, k, stops, forcing, 2.5, 2 * math.pi * 1.7, constant=np.array([0.4, 0.0, -0.2])
    )


def full_mass() -> System:
    """A mass matrix that is not diagonal, and a force on one degree of freedom."""
    mass = np.array([[1.0, 0.2, 0.0], [0.2, 1.5, 0.3], [0.0, 0.3, 0.7]])
    c, k = joined(3, [(0, GROUND, 150.0, 1.0), (0, 1, 200.0, 0.5), (1, 2, 300.0, 0.4)])
    stops = [Stop(2, GROUND, 0.015, 2.0e4, 30.0), Stop(GROUND, 1, 0.01, restitution=0.7)]
    weights = np.zeros((3, 2))
    weights[1, 0] = 1.0
    return System(mass, c, k, stops, Forcing(weights), 9.0, 2 * math.pi * 1.4)


def shaken(n: int = 4, interval: float = 0.02) -> System:
    """A building under a record."""
    system = storeys(n)
    return system._replace(forcing=record_motion(system.mass, np.ones(n), interval))


def record(count: int, interval: float = 0.02) -> Vector:
    """Lines of a record: value, slope and length."""
    rng = np.random.default_rng(7)
    t = np.arange(count + 1) * interval
    a = sum(
        rng.normal() * np.sin(2 * math.pi * f * t + rng.uniform(0, 6)) for f in (0.9, 1.6, 2.7, 4.1)
    )
    a = 2.5 * a
    return np.column_stack([a[:-1], np.diff(a) / interval, np.full(count, interval)])
