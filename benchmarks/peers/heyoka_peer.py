"""Problem P by heyoka, specialised to what is known about P; `heyoka_general` assumes nothing.

Taylor series with terminal events, on one thread.

One integrator serves flight and both contacts. Its right-hand side and its two event functions
are linear forms whose coefficients are runtime parameters; an event's callback overwrites them
and the integration goes on inside heyoka, so Python is entered only at the four events a period.
The forcing is carried as an oscillator pair, cheaper for a Taylor series than a cosine of time.

The bumper memory is not a state variable. It decays 50 times faster than the motion and would
triple the number of steps, although it is known in closed form, ``r0 exp(-(t - t0) k / c)``. It
can matter at two places only, and both are handled without approximation beyond rounding:

- After detachment, until the mass is back inside the gap. There ``x'' <= a + 2 zeta |x'| - gap``
  on the right (mirrored on the left), which is negative for the speeds that `check` assumes: the
  mass falls back ever faster while the bumper's relaxation slows down, so the clearance opens.
- At the next contact with the same bumper, which is at ``x = gap`` if the memory is below
  rounding by then. If the other bumper was hit in between, the mass has crossed the whole gap
  twice and `check` has bounded the memory that is left. If not, the callback evaluates it, and
  refuses to go on where it still counts.
"""

import math
from array import array
from dataclasses import dataclass, field
from typing import Any

import heyoka as hy

from .problem import P, Problem

_NEGLIGIBLE = 1e-17
"""A bumper deformation below this does not change the place of the next contact."""

_SPEED_BOUND = 3.0
"""Assumed bound on the speed; it stays below 1.8 in problem P."""

_RIGHT, _LEFT, _NEITHER = 0, 1, -1


@dataclass(slots=True)
class _Mode:
    """What the callbacks know: where the mass is, and how the bumpers were left.

    `parameters` and `state` are memory views of the integrator's own, made by `run` for the run
    only: a lasting one would keep the integrator alive for ever.
    """

    parameters: Any = None
    state: Any = None
    touching: bool = False
    last: int = _NEITHER
    deformation: list[float] = field(default_factory=lambda: [0.0, 0.0])
    since: list[float] = field(default_factory=lambda: [0.0, 0.0])

    def memory(self, side: int, time: float, rate: float) -> float:
        """Deformation of a free bumper at a given time."""
        return self.deformation[side] * math.exp(-rate * (time - self.since[side]))


@dataclass(frozen=True, slots=True)
class Built:
    """A compiled integrator for one problem; see `run`."""

    integrator: Any
    problem: Problem
    flight: tuple[float, ...]
    mode: _Mode


def check(problem: Problem) -> None:
    """Raise ValueError where the memory may matter in a way that this peer does not treat."""
    damping = 2.0 * problem.damping_ratio
    if problem.amplitude + damping * _SPEED_BOUND >= problem.gap:
        raise ValueError("the mass might catch up with a bumper that it has just left")
    crossing_twice = 4.0 * problem.gap / _SPEED_BOUND
    if math.exp(-problem.relaxation_rate * crossing_twice) > _NEGLIGIBLE:
        raise ValueError("a bumper relaxes too slowly: its memory would need a state variable")


def build(problem: Problem = P, tol: float = 1e-13, fast_math: bool = True) -> Built:
    """Construct and compile the integrator.

    Parameters
    ----------
    problem
        What to integrate.
    tol
        heyoka's tolerance. It sets the order too; 1e-13 (order 16) is the fastest whose error
        in x and x' is that of rounding the time: 1e-13 after 50 periods, 2e-12 after 1,000.
    fast_math
        A tenth faster than without, at the same error.

    Returns
    -------
    Built
        What `run` needs.

    Raises
    ------
    ValueError
        Where the bumper memory could matter beyond what this peer treats.
    """
    check(problem)
    damping, gap = 2.0 * problem.damping_ratio, problem.gap
    k, c = problem.bumper_stiffness, problem.bumper_damping

    # The parameters: damping, stiffness and offset of the motion, then of each side's event
    # function the constant and the factors of x and v. Both fall to zero at their event.
    clear_right, clear_left = (gap, -1.0, 0.0), (gap, 1.0, 0.0)
    press_right, press_left = (-k * gap, k, c), (-k * gap, -k, -c)
    flight = (damping, 1.0, 0.0, *clear_right, *clear_left)
    contacts = (
        (damping + c, 1.0 + k, k * gap, *press_right, *clear_left),
        (damping + c, 1.0 + k, -k * gap, *clear_right, *press_left),
    )

    mode = _Mode()

    def on_event(side: int) -> Any:
        in_flight = array("d", flight)
        in_contact = array("d", contacts[side])
        stop = gap if side == _RIGHT else -gap

        def callback(integrator: Any, _sign: int) -> bool:
            if mode.touching:
                mode.parameters[:] = in_flight
                mode.touching = False
                mode.deformation[side] = mode.state[0] - stop
                mode.since[side] = integrator.time
            else:
                if mode.last == side:
                    left = mode.memory(side, integrator.time, problem.relaxation_rate)
                    if abs(left) > _NEGLIGIBLE:
                        raise RuntimeError(f"the bumper is still deformed by {left} at contact")
                mode.parameters[:] = in_contact
                mode.touching = True
                mode.last = side
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
    falling = hy.event_direction.negative
    events = [
        hy.t_event(
            par[i] + par[i + 1] * x + par[i + 2] * v,
            callback=on_event(side),
            direction=falling,
        )
        for side, i in ((_RIGHT, 3), (_LEFT, 6))
    ]
    integrator = hy.taylor_adaptive(
        system,
        [0.0, 0.0, 1.0, 0.0],
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
        If heyoka stops early, or a bumper has not relaxed at a contact.
    """
    integrator, problem, mode = built.integrator, built.problem, built.mode
    integrator.state[:] = (0.0, 0.0, 1.0, 0.0)
    integrator.pars[:] = built.flight
    integrator.time = 0.0
    integrator.reset_cooldowns()
    mode.touching, mode.last = False, _NEITHER
    mode.deformation[:] = mode.since[:] = (0.0, 0.0)
    mode.parameters, mode.state = memoryview(integrator.pars), memoryview(integrator.state)
    try:
        outcome = integrator.propagate_until(periods * problem.period)[0]
    finally:
        mode.parameters = mode.state = None
    if outcome != hy.taylor_outcome.time_limit:
        raise RuntimeError(f"heyoka stopped with {outcome}")

    x, v = integrator.state[:2].tolist()
    deformation = [
        mode.memory(side, integrator.time, problem.relaxation_rate) for side in (_RIGHT, _LEFT)
    ]
    if mode.touching:
        deformation[mode.last] = x - problem.gap if mode.last == _RIGHT else x + problem.gap
    return x, v, deformation[_RIGHT], deformation[_LEFT]
