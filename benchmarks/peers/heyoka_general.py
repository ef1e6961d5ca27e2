"""The contact law in full generality by heyoka, with terminal events, on one thread.

The deformation of either bumper is a state variable, so that nothing is assumed about the
parameters: bumpers may relax slowly, be met again before they have relaxed, or be hit twice on
end. The bumpers must have a dashpot (``c > 0``), as everywhere in this comparison.

One integrator serves flight and both contacts. Its right-hand side and its two event functions
are linear forms whose coefficients are runtime parameters; an event's callback overwrites them
and the integration goes on inside heyoka, so Python is entered only at the events. The forcing is
carried as an oscillator pair, cheaper for a Taylor series than a cosine of time.
"""

from array import array
from dataclasses import dataclass
from typing import Any

import heyoka as hy

from .problem import P, Problem

_START = (0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
_RIGHT, _LEFT = 0, 1


@dataclass(slots=True)
class _Mode:
    """What the callbacks know.

    `parameters` is a memory view of the integrator's own, made by `run` for the run only: a
    lasting one would keep the integrator alive for ever.
    """

    parameters: Any = None
    touching: bool = False


@dataclass(frozen=True, slots=True)
class Built:
    """A compiled integrator for one problem; see `run`."""

    integrator: Any
    problem: Problem
    flight: tuple[float, ...]
    mode: _Mode


def build(problem: Problem = P, tol: float = 1e-10, fast_math: bool = True) -> Built:
    """Construct and compile the integrator.

    Parameters
    ----------
    problem
        What to integrate.
    tol
        heyoka's tolerance. It sets the order too; 1e-10 (order 13) is as fast as any whose error
        in x and x' stays below 1e-11: 2e-13 after 50 periods, 5e-13 after 1,000.
    fast_math
        A tenth faster than without, at the same error.

    Returns
    -------
    Built
        What `run` needs.
    """
    damping, gap = 2.0 * problem.damping_ratio, problem.gap
    k, c, rate = problem.bumper_stiffness, problem.bumper_damping, problem.relaxation_rate

    # The parameters: damping of the motion and the weights of r and l in its equation; of each
    # side's event function the constant and the factors of x, v and the deformation; of r' and
    # l' the factors of v and of the deformation. Both event functions fall to zero.
    clear_right, clear_left = (gap, -1.0, 0.0, 1.0), (gap, 1.0, 0.0, -1.0)
    press_right, press_left = (0.0, 0.0, c, k), (0.0, 0.0, -c, -k)
    follow, relax = (1.0, 0.0), (0.0, rate)
    flight = (damping, 0.0, 0.0, *clear_right, *clear_left, *relax, *relax)
    contacts = (
        (damping + c, k, 0.0, *press_right, *clear_left, *follow, *relax),
        (damping + c, 0.0, k, *clear_right, *press_left, *relax, *follow),
    )

    mode = _Mode()

    def on_event(side: int) -> Any:
        in_flight, in_contact = array("d", flight), array("d", contacts[side])

        def callback(_integrator: Any, _sign: int) -> bool:
            mode.parameters[:] = in_flight if mode.touching else in_contact
            mode.touching = not mode.touching
            return True

        return callback

    x, v, cosine, sine, r, l = hy.make_vars(  # noqa: E741
        "x", "v", "cosine", "sine", "r", "l"
    )
    par = hy.par
    system = [
        (x, v),
        (v, problem.amplitude * cosine - par[0] * v - x - par[1] * r - par[2] * l),
        (cosine, -problem.frequency * sine),
        (sine, problem.frequency * cosine),
        (r, par[11] * v - par[12] * r),
        (l, par[13] * v - par[14] * l),
    ]
    events = [
        hy.t_event(
            par[i] + par[i + 1] * x + par[i + 2] * v + par[i + 3] * deformation,
            callback=on_event(side),
            direction=hy.event_direction.negative,
        )
        for side, i, deformation in ((_RIGHT, 3, r), (_LEFT, 7, l))
    ]
    integrator = hy.taylor_adaptive(
        system,
        list(_START),
        pars=list(flight),
        t_events=events,
        tol=tol,
        fast_math=fast_math,
        compact_mode=False,
    )
    return Built(integrator, problem, flight, mode)


def run(built: Built, periods: int) -> tuple[float, float, float, float]:
    """Integrate from rest over a number of forcing periods.

    Parameters
    ----------
    built
        The compiled integrator; may be used again and again.
    periods
        Number of forcing periods.

    Returns
    -------
    x, v, r, l : float
        Displacement, velocity, and the deformation of the right and the left bumper (the left
        one negative when pressed) at the end.

    Raises
    ------
    RuntimeError
        If heyoka stops early.
    """
    integrator, mode = built.integrator, built.mode
    integrator.state[:] = _START
    integrator.pars[:] = built.flight
    integrator.time = 0.0
    integrator.reset_cooldowns()
    mode.touching = False
    mode.parameters = memoryview(integrator.pars)
    try:
        outcome = integrator.propagate_until(periods * built.problem.period)[0]
    finally:
        mode.parameters = None
    if outcome != hy.taylor_outcome.time_limit:
        raise RuntimeError(f"heyoka stopped with {outcome}")
    x, v, _, _, r, l = integrator.state.tolist()  # noqa: E741
    return x, v, r, l
