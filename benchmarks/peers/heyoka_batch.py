"""Problem P from several starts at once by heyoka's batch mode, one SIMD lane each.

As `heyoka_peer`, with the same assumptions about the bumper memory; read there first. Lanes go
on together, so one that meets an event makes the others take the shorter step with it.
"""

import math
from dataclasses import dataclass
from typing import Any

import heyoka as hy
import numpy as np
from numpy.typing import NDArray

from .heyoka_peer import check
from .problem import P, Problem

_Vector = NDArray[np.float64]
_RIGHT, _LEFT, _NEITHER = 0, 1, -1

lanes: int = hy.recommended_simd_size()
"""How many trajectories this processor integrates at once."""


@dataclass(slots=True)
class _Mode:
    """What the callbacks know of each lane; see `heyoka_peer`."""

    parameters: Any
    time: Any
    touching: list[bool]
    last: list[int]
    left_at: list[float]


@dataclass(frozen=True, slots=True)
class Built:
    """A compiled integrator for one problem; see `run`."""

    integrator: Any
    problem: Problem
    flight: _Vector
    mode: _Mode


def build(problem: Problem = P, tol: float = 1e-13, fast_math: bool = True) -> Built:
    """Construct and compile the integrator; arguments as in `heyoka_peer.build`."""
    check(problem)
    damping, gap = 2.0 * problem.damping_ratio, problem.gap
    k, c = problem.bumper_stiffness, problem.bumper_damping
    clear_right, clear_left = (gap, -1.0, 0.0), (gap, 1.0, 0.0)
    press_right, press_left = (-k * gap, k, c), (-k * gap, -k, -c)
    flight = np.array((damping, 1.0, 0.0, *clear_right, *clear_left))
    contacts = (
        np.array((damping + c, 1.0 + k, k * gap, *press_right, *clear_left)),
        np.array((damping + c, 1.0 + k, -k * gap, *clear_right, *press_left)),
    )
    # After this time a bumper has forgotten: exp(-40) of a deformation below 1 is 4e-18.
    forgotten = 40.0 / problem.relaxation_rate
    mode = _Mode(None, None, [], [], [])

    def on_event(side: int) -> Any:
        in_contact = contacts[side]

        def callback(_integrator: Any, _sign: int, lane: int) -> bool:
            if mode.touching[lane]:
                mode.parameters[lane][:] = flight
                mode.left_at[lane] = mode.time[lane]
            else:
                if mode.last[lane] == side and mode.time[lane] - mode.left_at[lane] < forgotten:
                    raise RuntimeError("the bumper is still deformed at contact")
                mode.parameters[lane][:] = in_contact
                mode.last[lane] = side
            mode.touching[lane] = not mode.touching[lane]
            return True

        return callback

    x, v, cosine, sine = hy.make_vars("x", "v", "cosine", "sine")
    par = hy.par
    system = [
        (x, v),
        (v, problem.amplitude * cosine - par[0] * v - par[1] * x + par[2]),
        (cosine, -problem.frequency * sine),
        (sine, problem.frequency * cosine),
    ]
    events = [
        hy.t_event_batch(
            par[i] + par[i + 1] * x + par[i + 2] * v,
            callback=on_event(side),
            direction=hy.event_direction.negative,
        )
        for side, i in ((_RIGHT, 3), (_LEFT, 6))
    ]
    integrator = hy.taylor_adaptive_batch(
        system,
        np.zeros((4, lanes)),
        pars=np.tile(flight[:, np.newaxis], (1, lanes)),
        t_events=events,
        tol=tol,
        fast_math=fast_math,
        compact_mode=False,
    )
    return Built(integrator, problem, flight, mode)


def run(built: Built, starts: _Vector, periods: int) -> _Vector:
    """Integrate from several starts over a number of forcing periods.

    Parameters
    ----------
    built
        The compiled integrator; may be used again and again.
    starts
        Displacement and velocity, shape (2, lanes), within the gap and below speed 1.
    periods
        Number of forcing periods.

    Returns
    -------
    ndarray, shape (2, lanes)
        Displacement and velocity at the end.

    Raises
    ------
    RuntimeError
        If heyoka stops early, or a bumper has not relaxed at a contact.
    """
    integrator, mode = built.integrator, built.mode
    integrator.state[:2] = starts
    integrator.state[2] = 1.0
    integrator.state[3] = 0.0
    integrator.pars[:] = built.flight[:, np.newaxis]
    integrator.set_time(0.0)
    integrator.reset_cooldowns()
    mode.touching[:] = [False] * lanes
    mode.last[:] = [_NEITHER] * lanes
    mode.left_at[:] = [-math.inf] * lanes
    mode.parameters = [integrator.pars[:, lane] for lane in range(lanes)]
    mode.time = memoryview(integrator.time)
    try:
        integrator.propagate_until([periods * built.problem.period] * lanes)
    finally:
        mode.parameters = mode.time = None
    outcomes = {result[0] for result in integrator.propagate_res}
    if outcomes != {hy.taylor_outcome.time_limit}:
        raise RuntimeError(f"heyoka stopped with {outcomes}")
    return np.array(integrator.state[:2])
