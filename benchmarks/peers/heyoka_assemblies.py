"""Several masses by heyoka, with terminal events, on one thread.

As in `heyoka_general`, the deformation of each bumper is a state variable, so that bumpers may
relax slowly and be met again before they have relaxed. Each bumper has a flag, a runtime parameter,
that the callback of its event overwrites.
"""

import math
from dataclasses import dataclass
from typing import Any

import heyoka as hy

from .assembly_problems import GROUND, Masses


@dataclass(frozen=True, slots=True)
class Built:
    """A compiled integrator; see `run`."""

    integrator: Any
    problem: Masses
    start: tuple[float, ...]
    flags: list[Any]
    """Of each bumper the memory view of its parameters that its callback writes into."""


def build(problem: Masses, tol: float = 1e-10, fast_math: bool = True) -> Built:
    """Construct and compile the integrator.

    Parameters
    ----------
    problem
        What to integrate.
    tol
        heyoka's tolerance, which sets the order too.
    fast_math
        Whether sums may be computed in any order.
    """
    n, count = len(problem.masses), len(problem.bumpers)
    u, v = (hy.make_vars(*(f"{x}{i}" for i in range(n))) for x in "uv")
    sine, cosine = hy.make_vars("sine", "cosine")
    deformation = [hy.make_vars(f"d{b}") for b in range(count)]
    force = [-mass * problem.amplitude * sine for mass in problem.masses]

    def apart(x: Any, left: int, right: int) -> Any:
        if left == GROUND:
            return -x[right]
        return x[left] if right == GROUND else x[left] - x[right]

    def push(left: int, right: int, size: Any) -> None:
        if left != GROUND:
            force[left] = force[left] - size
        if right != GROUND:
            force[right] = force[right] + size

    for left, right, k, c, cubic in problem.links:
        s, rate = apart(u, left, right), apart(v, left, right)
        push(left, right, k * s + c * rate + (cubic * (s * s * s) if cubic else 0.0))
    flags: list[Any] = [None]
    relaxing, events = [], []

    def callback(b: int) -> Any:
        def switch(_integrator: Any, _sign: int) -> bool:
            flags[0][b] = 1.0 - flags[0][b]
            return True

        return switch

    for b, (left, right, k, c, gap) in enumerate(problem.bumpers):
        touches, s, rate = hy.par[b], apart(u, left, right), apart(v, left, right)
        pressing = touches * (k * deformation[b] + c * rate)
        push(left, right, pressing)
        relaxing.append(touches * rate - (1.0 - touches) * ((k / c) * deformation[b]))
        events.append(
            hy.t_event(
                pressing + (1.0 - touches) * (gap + deformation[b] - s),
                callback=callback(b),
                direction=hy.event_direction.negative,
            )
        )
    system = [
        *((u[i], v[i]) for i in range(n)),
        *((v[i], force[i] * (1.0 / problem.masses[i])) for i in range(n)),
        (sine, problem.omega * cosine),
        (cosine, -problem.omega * sine),
        *zip(deformation, relaxing, strict=True),
    ]
    start = (
        *(0.0,) * (2 * n),
        math.sin(problem.phase),
        math.cos(problem.phase),
        *(0.0,) * count,
    )
    integrator = hy.taylor_adaptive(
        system,
        list(start),
        pars=[0.0] * count,
        t_events=events,
        tol=tol,
        fast_math=fast_math,
        compact_mode=False,
    )
    return Built(integrator, problem, start, flags)


def run(built: Built, periods: int) -> tuple[float, ...]:
    """Integrate from rest over a number of forcing periods; u and v at the end.

    Raises
    ------
    RuntimeError
        If heyoka stops early.
    """
    _propagate(built, periods)
    return tuple(built.integrator.state[: 2 * len(built.problem.masses)].tolist())


def steps(built: Built, periods: int) -> int:
    """Count the steps of such a run."""
    return _propagate(built, periods)


def _propagate(built: Built, periods: int) -> int:
    integrator = built.integrator
    integrator.state[:] = built.start
    integrator.pars[:] = 0.0
    integrator.time = 0.0
    integrator.reset_cooldowns()
    built.flags[0] = memoryview(integrator.pars)
    try:
        outcome, _, _, count, *_ = integrator.propagate_until(periods * built.problem.period)
    finally:
        built.flags[0] = None
    if outcome != hy.taylor_outcome.time_limit:
        raise RuntimeError(f"heyoka stopped with {outcome}")
    return int(count)
