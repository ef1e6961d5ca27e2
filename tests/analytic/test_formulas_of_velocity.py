"""Formulas that are not linear in the velocity, far past the nearest complex singularity of each.

The reference is DOP853, begun anew at each contact, detachment and turn, and wherever a stop begins
or ceases to push. It shares nothing with the package but the text of the formula.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import vibroimpact as vi
from samples import sample

MASS, ACCELERATION, SPEED = 3.2, 0.3, 0.28
FAST = 0.6
"""Of the rigs with stops (m/s)."""

ISOLATORS = {
    "tanh": "k*u + c*b*tanh(v/b)",
    "sin": "k*u + c*b*sin(v/b)",
    "cos": "k*u + c*v*cos(v/b) + c*v",
    "sinh": "k*u + c*b*sinh(v/b/q)",
    "cosh": "k*u + c*v*cosh(v/b/q)",
    "exp": "k*u + c*v*exp(-v**2/b**2)",
    "quotient": "k*u + c*v/(1 + v**2/b**2)",
    "quotient of a size": "k*u + c*v/(1 + abs(v)/b)",
    "root": "k*u + c*v/sqrt(1 + v**2/b**2)",
    "power": "k*u + c*v*(1 + v**2/b**2)**-1.5",
    "growing root": "k*u + c*v*sqrt(1 + v**2/b**2)",
    "with u": "k*u + c*b*tanh(v/b)/(1 + u**2/a**2)",
    "of u and v": "k*u + c*v*exp(-(u*v/(a*b))**2)",
    "Stribeck": "k*u + c*b*tanh(v/b)*(1 + 2*exp(-(v/b)**2))",
    "both bounded": "k*a*tanh(u/a) + c*b*tanh(v/b)",
}
STOPS = {
    "tanh": "k*d + c*b*tanh(v/b)",
    "tanh with d": "k*d*(1 + chi*b*tanh(v/b))",
    "exp": "k*d + c*v*exp(-(v/b)**2)",
    "exp with d": "k*d*exp(chi*v)",
    "quotient": "k*d/(1 + v**2/b**2) + c*d",
    "root": "k*d + c*v/sqrt(1 + v**2/b**2)",
    "sin": "k*d + c*b*sin(v/b)",
    "sinh": "k*d + c*b*sinh(v/b/q)",
    "cosh": "k*d + c*v*cosh(v/b/q)",
    "cos": "k*a*sin(d/a) + c*b*(2 - cos(v/b))",
    "product": "k*d**2 + c*d*v/(a + abs(v))",
    "nothing at v = 0": "c*abs(v)*d/a",
    "nothing but a spring at v = 0": "k*d + c*abs(v)*d/a",
    "square": "c*v**2*d/a",
    "dashpot in compression only": "k*d + c*(v + abs(v))/2",
    "never pulling": "max(k*d + c*v, 0)",
}
NUMBERS = {"k": 20.0, "c": 0.17, "a": 0.1, "chi": 0.7}


def law_of(formula: str, ratio: float, speed: float, gap: float | None = None, **more: float):
    """The law with b a ratio below the speed; sinh and cosh of at most 6."""
    sizes = {**NUMBERS, **more, "b": speed / ratio, "q": max(ratio / 6.0, 1.0)}
    names = {node.id for node in ast.walk(ast.parse(formula)) if isinstance(node, ast.Name)}
    numbers = {name: size for name, size in sizes.items() if name in names}
    scope = {**vars(math), "abs": abs, "max": max, **numbers}
    # The reference looks for where a force changes its sign, which a clipped force does not.
    code = compile(formula.removeprefix("max(").removesuffix(", 0)"), "formula", "eval")

    def force(x: float, v: float) -> float:
        return float(eval(code, scope, {"u": x, "d": x, "v": v}))

    return vi.Law(formula, gap, **numbers), force


Force = Callable[[float, float], float]


def followed(
    isolator: Force, stop: Force | None, gap: float, size: float, v: float, end: float, step: float
) -> tuple[np.ndarray, float, int]:
    """The state behind so many seconds, the largest speed, and how many contacts began."""
    t, y, side, pushes, way = 0.0, np.array([0.05 if stop is None else 0.0, v]), 0, False, 1.0
    fastest, contacts = 0.0, 0
    while True:

        def rates(t: float, y: np.ndarray, side: int = side, pushes: bool = pushes) -> list[float]:
            force = isolator(y[0], y[1])
            if pushes:
                force += side * stop(side * y[0] - gap, side * y[1])
            return [y[1], -force / MASS - size * math.sin(math.pi * t)]

        events = [(lambda t, y: y[1], -way)]
        if stop is not None and not side:
            events += [(lambda t, y: y[0] - gap, 1.0), (lambda t, y: -y[0] - gap, 1.0)]
        elif stop is not None:
            events.append((lambda t, y, s=side: s * y[0] - gap, -1.0))
            rises = -1.0 if pushes else 1.0
            events.append((lambda t, y, s=side: stop(s * y[0] - gap, s * y[1]), rises))
        for event, rises in events:
            event.terminal, event.direction = True, rises
        solution = solve_ivp(
            rates, (t, end), y, "DOP853", events=[event for event, _ in events],
            rtol=1e-13, atol=1e-16, max_step=step,
        )  # fmt: skip
        t, y = solution.t[-1], solution.y[:, -1].copy()
        fastest = max(fastest, np.abs(solution.y[1]).max())
        if solution.status == 0:
            return y, fastest, contacts
        which = next(i for i, times in enumerate(solution.t_events) if len(times))
        if which == 0:
            y[1], way = 0.0, -way
        elif not side:
            side = 1 if which == 1 else -1
            y[0], contacts = side * gap, contacts + 1
            pushes = stop(0.0, side * y[1]) > 0.0 or stop(1e-9, side * y[1]) > 0.0
        elif which == 1:
            y[0], side, pushes = side * gap, 0, False
        else:
            pushes = not pushes


@pytest.mark.parametrize("name", sample([*ISOLATORS], [*ISOLATORS][::8]))
def test_an_isolator_agrees_with_a_general_integrator(name: str) -> None:
    for ratio in sample((2.0, 4.0, 12.0, 60.0, 1000.0), (4.0, 1000.0)):
        law, force = law_of(ISOLATORS[name], ratio, SPEED)
        rig = vi.Rig(vi.Oscillator(MASS, law), vi.Harmonic(ACCELERATION, 0.5))
        data = vi.simulate(rig, 1, start=vi.State(0.05, SPEED))
        assert data.attrs["message"] == "done"
        known, fastest, _ = followed(force, None, 0.0, ACCELERATION, SPEED, 2.0, 0.002)
        assert fastest >= SPEED
        np.testing.assert_allclose(data["final_state"].values[:2], known, atol=1e-10, rtol=0.0)


@pytest.mark.parametrize("name", sample([*STOPS], [*STOPS][::8]))
def test_a_stop_agrees_with_a_general_integrator(name: str) -> None:
    formula = STOPS[name]
    dashpot = 6.0 if "k" in formula else 60.0
    ratios = sample((2.0, 4.0, 12.0, 60.0), (12.0,))
    for ratio in ratios if "b" in formula.replace("abs", "") else (1.0,):
        law, force = law_of(formula, ratio, FAST, 0.03, k=400.0, c=dashpot)
        rig = vi.Rig(vi.Oscillator(MASS, vi.Isolator(20.0, 0.3), law, law), vi.Harmonic(2.0, 0.5))
        data = vi.simulate(rig, 1, start=vi.State(0.0, FAST))
        assert data.attrs["message"] == "done"
        known, fastest, contacts = followed(
            lambda u, v: 20.0 * u + 0.3 * v, force, 0.03, 2.0, FAST, 2.0, 5e-4
        )
        assert fastest >= FAST
        assert contacts >= 2
        np.testing.assert_allclose(data["final_state"].values[:2], known, atol=1e-10, rtol=0.0)


def test_a_narrow_drag_takes_few_steps() -> None:
    """Regularised friction, 200 thousand times as narrow as the motion is fast."""
    law, _ = law_of("k*u + c*tanh(v/b) + q*exp(-(v/b)**2)*v", 1.0, 1e-6, q=1e-3)
    rig = vi.Rig(vi.Oscillator(MASS, law), vi.Harmonic(ACCELERATION, 0.5))
    data = vi.simulate(rig, 1, start=vi.State(0.05, SPEED))
    assert data.attrs["message"] == "done"
    friction = vi.FrictionIsolator(NUMBERS["k"], 0.0, NUMBERS["c"])
    sharp = vi.simulate(vi.Rig(vi.Oscillator(MASS, friction), vi.Harmonic(ACCELERATION, 0.5)), 1,
                        start=vi.State(0.05, SPEED))  # fmt: skip
    difference = np.abs(data["final_state"].values[:2] - sharp["final_state"].values[:2])
    assert difference.max() < 1e-5
