"""Problem P by scipy's `solve_ivp` with DOP853, restarted at every event.

The state is the displacement and the velocity. A free bumper's memory stands in closed form in
the clearance, so it is exact and does not shorten the steps. Right-hand sides are plain Python on
floats: a numba-compiled one was no faster, most of the time being spent in scipy's own step.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from .problem import P, Problem

_Vector = NDArray[np.float64]


def _motion(
    problem: Problem, damping: float, stiffness: float, offset: float
) -> Callable[[float, _Vector], tuple[float, float]]:
    """Right-hand side of the motion within one phase."""
    amplitude, frequency, cos = problem.amplitude, problem.frequency, math.cos

    def derivative(t: float, y: _Vector) -> tuple[float, float]:
        x, v = y.tolist()
        return v, amplitude * cos(frequency * t) - damping * v - stiffness * x + offset

    return derivative


def _falling(function: Callable[[float, _Vector], float]) -> Any:
    """Mark an event function: stop where it falls to zero.

    The direction matters at detachment, where a clearance starts from zero, give or take an
    ulp, with zero slope, and opens.
    """
    function.terminal = True  # type: ignore[attr-defined]
    function.direction = -1.0  # type: ignore[attr-defined]
    return function


def run(
    periods: int, problem: Problem = P, rtol: float = 1e-12, atol: float = 1e-15
) -> tuple[float, float, float, float]:
    """Integrate from rest over a number of forcing periods.

    Parameters
    ----------
    periods
        Number of forcing periods.
    problem
        What to integrate.
    rtol, atol
        Tolerances of `solve_ivp`. With the default the error in x and x' stays below 2e-12, and
        below 2e-13 once the motion is periodic; a smaller `rtol` gains nothing.

    Returns
    -------
    x, v, r, l : float
        Displacement, velocity, and the deformation of the right and the left bumper (the left
        one negative when pressed) at the end.
    """
    damping, gap = 2.0 * problem.damping_ratio, problem.gap
    k, c, rate = problem.bumper_stiffness, problem.bumper_damping, problem.relaxation_rate
    exp = math.exp

    # The phases: 0 in flight, 1 touching the right bumper, -1 the left one.
    motions = {
        0: _motion(problem, damping, 1.0, 0.0),
        1: _motion(problem, damping + c, 1.0 + k, k * gap),
        -1: _motion(problem, damping + c, 1.0 + k, -k * gap),
    }
    # Deformation of each bumper, and when it had it.
    r, r_time, l, l_time = 0.0, 0.0, 0.0, 0.0  # noqa: E741
    events = {
        0: [
            _falling(lambda t, y: gap + r * exp(-rate * (t - r_time)) - y[0]),
            _falling(lambda t, y: gap + y[0] - l * exp(-rate * (t - l_time))),
        ],
        1: [_falling(lambda _, y: k * (y[0] - gap) + c * y[1])],
        -1: [_falling(lambda _, y: -k * (y[0] + gap) - c * y[1])],
    }
    # The longest step that a phase took last time is a better first one than scipy's guess.
    steps: dict[int, float] = {}

    t, end, phase = 0.0, periods * problem.period, 0
    y = np.zeros(2)
    while True:
        first = min(steps[phase], end - t) if phase in steps else None
        solution = solve_ivp(
            motions[phase],
            (t, end),
            y,
            method="DOP853",
            events=events[phase],
            first_step=first,
            rtol=rtol,
            atol=atol,
        )
        if solution.status < 0:
            raise RuntimeError(solution.message)
        if solution.t.size > 2:
            steps[phase] = float(np.diff(solution.t)[:-1].max())
        t, y = float(solution.t[-1]), solution.y[:, -1]
        x, v = y.tolist()
        if phase == 1:
            r, r_time = x - gap, t
        elif phase == -1:
            l, l_time = x + gap, t  # noqa: E741
        if solution.status == 0:
            return x, v, r * exp(-rate * (t - r_time)), l * exp(-rate * (t - l_time))
        hit = 1 if solution.t_events[0].size else -1
        phase = hit if phase == 0 else 0
