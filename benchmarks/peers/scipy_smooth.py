"""Smooth laws between two stops by scipy's `solve_ivp` with DOP853, restarted at every event.

A Kelvin-Voigt bumper's memory is left out, as in `heyoka_smooth`: it has decayed when that bumper
is met again. Right-hand sides are plain Python on floats.
"""

import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from .smooth_problems import Smooth


def _event(function: Any, direction: float = -1.0) -> Any:
    """Mark an event function: stop where it passes zero in a direction."""
    function.terminal, function.direction = True, direction
    return function


def run(problem: Smooth, periods: int, rtol: float = 1e-12) -> tuple[float, float]:
    """Integrate from rest over a number of forcing periods, to x and x'."""
    amplitude, omega, damping = problem.amplitude, problem.frequency, problem.damping
    gap, k, c = problem.gap, problem.stiffness, problem.dissipation
    cubic, cos = problem.cubic, math.cos
    spring, memory, limit = 1.0, 0.0, math.inf
    if problem.hysteretic:
        elastic, spring, force = problem.hysteretic
        memory, limit = elastic - spring, force / elastic

    def derivative(t: float, y: Any, side: int, bend: float) -> Any:
        x, v, *z = y.tolist()
        a = amplitude * cos(omega * t) - damping * v - x * (spring + cubic * x * x)
        if side:
            depth, closing = side * x - gap, side * v
            if problem.power:
                a -= side * k * max(depth, 0.0) ** 1.5 * (1.0 + c * closing)
            else:
                a -= side * (k * depth + c * closing)
        if z:
            return v, a - memory * z[0], v * (1.0 - bend * z[0])
        return v, a

    t, end, side, first = 0.0, periods * problem.period, 0, {0: 1e-3, 1: 1e-3, -1: 1e-3}
    y = np.zeros(3 if problem.hysteretic else 2)
    way = turned = 1.0  # the signs of v and z
    while True:
        if not side:
            events = [_event(lambda _, y, *a: gap - y[0]), _event(lambda _, y, *a: gap + y[0])]
        elif problem.power:
            here = side
            events = [_event(lambda _, y, *a: here * y[0] - gap)]  # noqa: B023
        else:
            here = side
            events = [_event(lambda _, y, *a: k * (here * y[0] - gap) + c * here * y[1])]  # noqa: B023
        stops = len(events)
        if problem.hysteretic:
            events += [_event(lambda _, y, *a: y[1], -way), _event(lambda _, y, *a: y[2], -turned)]
        bend = 0.5 * (way + turned) / limit
        solution = solve_ivp(
            derivative,
            (t, end),
            y,
            method="DOP853",
            args=(side, bend),
            events=events,
            first_step=min(first[side], end - t),
            rtol=rtol,
            atol=1e-15,
        )
        if solution.status < 0:
            raise RuntimeError(solution.message)
        if solution.t.size > 2:
            longest = float(np.diff(solution.t)[:-1].max())
            first[side] = 1e-3 if problem.power and side else longest
        t, y = float(solution.t[-1]), solution.y[:, -1].copy()
        if solution.status == 0:
            return float(y[0]), float(y[1])
        which = next(i for i, times in enumerate(solution.t_events) if times.size)
        if which >= stops:
            y[1 + which - stops] = 0.0
            if which == stops:
                way = -way
            else:
                turned = -turned
        elif side:
            if problem.power:
                y[0] = side * gap
            side = 0
        else:
            side = 1 if which == 0 else -1
            y[0] = side * gap
