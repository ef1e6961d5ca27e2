"""Several masses by scipy's `solve_ivp` with DOP853, restarted at every event.

A free bumper's memory stands in closed form in its clearance, so that it does not shorten the
steps.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from .assembly_problems import GROUND, Masses

_Vector = NDArray[np.float64]


def run(
    problem: Masses, periods: int, rtol: float = 1e-10, atol: float = 1e-13
) -> tuple[float, ...]:
    """Integrate from rest over a number of forcing periods; u and v at the end."""
    n, masses = len(problem.masses), np.array(problem.masses)
    amplitude, omega, phase = problem.amplitude, problem.omega, problem.phase

    def closing(left: int, right: int) -> _Vector:
        row = np.zeros(n)
        if left != GROUND:
            row[left] += 1.0
        if right != GROUND:
            row[right] -= 1.0
        return row

    stiffness, damping = np.zeros((n, n)), np.zeros((n, n))
    cubics = []
    for left, right, k, c, cubic in problem.links:
        w = closing(left, right)
        stiffness += k * np.outer(w, w)
        damping += c * np.outer(w, w)
        if cubic:
            cubics.append((w, cubic))
    rows = [closing(bumper.left, bumper.right) for bumper in problem.bumpers]

    def motion(pressed: frozenset[int]) -> Any:
        k, c, still = stiffness.copy(), damping.copy(), np.zeros(n)
        for b in pressed:
            bumper, w = problem.bumpers[b], rows[b]
            k += bumper.stiffness * np.outer(w, w)
            c += bumper.damping * np.outer(w, w)
            still += bumper.stiffness * bumper.gap * w
        linear = -np.hstack([k, c]) / masses[:, None]
        offset = still / masses

        def derivative(t: float, y: _Vector) -> _Vector:
            a = linear @ y + (offset - amplitude * np.sin(omega * t + phase))
            for w, cubic in cubics:
                a -= cubic * (w @ y[:n]) ** 3 / masses * w
            return np.concatenate([y[n:], a])

        return derivative

    # The deformation of each bumper, and when it had it.
    memory = [(0.0, 0.0)] * len(rows)

    def watched(b: int, pressed: frozenset[int]) -> Any:
        bumper, w = problem.bumpers[b], rows[b]
        gap, k, c = bumper.gap, bumper.stiffness, bumper.damping
        if b in pressed:
            row, offset = np.concatenate([k * w, c * w]), k * gap

            def function(t: float, y: _Vector) -> float:
                return float(row @ y) - offset
        else:
            deformation, since = memory[b]

            def function(t: float, y: _Vector) -> float:
                held = deformation * np.exp(-k / c * (t - since))
                return float(gap + held - w @ y[:n])

        function.terminal, function.direction = True, -1.0  # type: ignore[attr-defined]
        return function

    steps: dict[frozenset[int], float] = {}
    motions: dict[frozenset[int], Any] = {}
    t, end, y = 0.0, periods * problem.period, np.zeros(2 * n)
    pressed: frozenset[int] = frozenset()
    while True:
        if pressed not in motions:
            motions[pressed] = motion(pressed)
        first = min(steps[pressed], end - t) if pressed in steps else None
        solution = solve_ivp(
            motions[pressed],
            (t, end),
            y,
            method="DOP853",
            events=[watched(b, pressed) for b in range(len(rows))],
            first_step=first,
            rtol=rtol,
            atol=atol,
        )
        if solution.status < 0:
            raise RuntimeError(solution.message)
        if solution.t.size > 2:
            steps[pressed] = float(np.diff(solution.t)[:-1].max())
        t, y = float(solution.t[-1]), solution.y[:, -1]
        if solution.status == 0:
            return tuple(y.tolist())
        (b,) = (i for i, times in enumerate(solution.t_events) if times.size)
        if b in pressed:
            memory[b] = float(rows[b] @ y[:n]) - problem.bumpers[b].gap, t
        pressed ^= {b}
