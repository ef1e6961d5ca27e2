"""A stop max(0, k d + c v), which never pulls and has no memory, by an independent integration."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import vibroimpact as vi

CYCLES, PERIOD = 20, math.tau / 3.0
GAP, STIFFNESS, DAMPING = 0.1, 50.0, 50.0


def integrated() -> tuple[float, float]:
    """Displacement after `CYCLES` from rest, and the largest one of the last cycle."""

    def push(u: float, v: float) -> float:
        side = math.copysign(1.0, u)
        depth = abs(u) - GAP
        return -side * max(0.0, STIFFNESS * depth + DAMPING * side * v) if depth > 0.0 else 0.0

    def rates(t: float, y: np.ndarray) -> list[float]:
        u, v = y
        return [v, math.sin(3.0 * t) - u - 0.02 * v + push(u, v)]

    def face(t: float, y: np.ndarray) -> float:
        return abs(y[0]) - GAP

    def release(t: float, y: np.ndarray) -> float:
        side = math.copysign(1.0, y[0])
        return STIFFNESS * (abs(y[0]) - GAP) + DAMPING * side * y[1]

    def turn(t: float, y: np.ndarray) -> float:
        return y[1]

    face.terminal = release.terminal = True
    t, y, largest = 0.0, np.zeros(2), 0.0
    while t < CYCLES * PERIOD:
        solution = solve_ivp(
            rates, (t, CYCLES * PERIOD), y, "DOP853", events=(face, release, turn),
            rtol=1e-12, atol=1e-14, max_step=0.05,
        )  # fmt: skip
        t, y = solution.t[-1], solution.y[:, -1]
        for at, state in zip(solution.t_events[2], solution.y_events[2], strict=True):
            if at >= (CYCLES - 1) * PERIOD:
                largest = max(largest, abs(float(state[0])))
        if solution.status == 1:  # to the other side of the event
            step = 1e-13
            y = y + step * np.array(rates(t, y))
            t += step
    return float(y[0]), largest


def test_end_and_largest_displacement_of_the_last_cycle() -> None:
    stop = vi.Law("max(k*d + c*v, 0)", gap=GAP, k=STIFFNESS, c=DAMPING)
    oscillator = vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), stop, stop)
    rig = vi.Rig(oscillator, vi.Harmonic(1.0, 1.0 / PERIOD, of="force"))
    before = vi.simulate(rig, CYCLES - 1)
    last = vi.simulate(rig, 1, start=before, samples=20_000)
    end, largest = integrated()
    assert end == pytest.approx(-0.1108822, abs=5e-8)
    assert largest == pytest.approx(0.11215, abs=5e-6)
    assert float(last["displacement"][-1]) == pytest.approx(end, abs=1e-9)
    assert float(np.abs(last["displacement"]).max()) == pytest.approx(largest, abs=1e-8)
