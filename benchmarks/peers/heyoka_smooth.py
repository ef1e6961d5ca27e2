"""Smooth laws between two stops by heyoka, with terminal events, on one thread.

One integrator serves flight and both contacts, and every branch of the isolator's law. What differs
stands in runtime parameters that an event's callback overwrites, so that Python is entered only at
the events. The forcing is carried as an oscillator pair.

A Kelvin-Voigt bumper's memory is no state variable: as in `heyoka_peer` it has decayed to below
rounding when that bumper is met again, which takes a crossing of the gap.

**A stop of power 1.5** has no Taylor series in time where contact begins. In contact the unknown is
``w`` with depth ``w^2``, followed in a variable in which ``dt = 2 w`` times its own step: all is
polynomial, and each contact ends where ``w`` falls to zero. Time is then a state variable, and the
end of the run an event.
"""

from array import array
from dataclasses import dataclass
from typing import Any

import heyoka as hy

from .smooth_problems import Smooth

_INSTANT = 1e-8

_FALLING = hy.event_direction.negative


@dataclass(slots=True)
class _Mode:
    """What the callbacks know.

    `parameters` and `state` are memory views of the integrator's own, made by `run` for the run
    only: a lasting one would keep the integrator alive for ever.
    """

    parameters: Any = None
    state: Any = None
    touching: bool = False


@dataclass(frozen=True, slots=True)
class Built:
    """A compiled integrator for one problem; see `run`."""

    integrator: Any
    problem: Smooth
    start: tuple[float, ...]
    flight: tuple[float, ...]
    mode: _Mode


def build(problem: Smooth, tol: float) -> Built:
    """Construct and compile the integrator for a problem."""
    return (_power if problem.power else _bumpers)(problem, tol)


def _bumpers(problem: Smooth, tol: float) -> Built:
    """Between Kelvin-Voigt bumpers."""
    gap, k, c = problem.gap, problem.stiffness, problem.dissipation
    par = hy.par
    mode = _Mode()
    x, v, cosine, sine, z = hy.make_vars("x", "v", "cosine", "sine", "z")
    spring, memory = 1.0, 0.0
    if problem.hysteretic:
        elastic, spring, force = problem.hysteretic
        memory, limit = elastic - spring, force / elastic

    # Damping, stiffness and offset of the motion, of each side's event function the constant and
    # the factors of x and v, and last the bend of the isolator's branch.
    clear_right, clear_left = (gap, -1.0, 0.0), (gap, 1.0, 0.0)
    press_right, press_left = (-k * gap, k, c), (-k * gap, -k, -c)
    flight: tuple[float, ...] = (problem.damping, spring, 0.0, *clear_right, *clear_left)
    contacts = (
        (problem.damping + c, spring + k, k * gap, *press_right, *clear_left),
        (problem.damping + c, spring + k, -k * gap, *clear_right, *press_left),
    )
    last = len(flight)

    def on_stop(side: int) -> Any:
        in_flight, in_contact = array("d", flight), array("d", contacts[side])

        def callback(_integrator: Any, _sign: int) -> bool:
            mode.parameters[:last] = in_flight if mode.touching else in_contact
            mode.touching = not mode.touching
            return True

        return callback

    acceleration = problem.amplitude * cosine - par[0] * v + par[2] - x * par[1]
    if problem.cubic:
        acceleration = (
            problem.amplitude * cosine
            - par[0] * v
            + par[2]
            - x * (par[1] + problem.cubic * (x * x))
        )
    events = [
        hy.t_event(
            par[i] + par[i + 1] * x + par[i + 2] * v, callback=on_stop(side), direction=_FALLING
        )
        for side, i in ((0, 3), (1, 6))
    ]
    system = [(x, v), (v, acceleration)]
    start: tuple[float, ...] = (0.0, 0.0, 1.0, 0.0)
    if problem.hysteretic:
        # z' = v (1 - bend z), bend = (s_v + s_z) / 2 z_max: its sign changes as v and z turn.
        bend = 0.5 / limit

        def turns(at: int, one: Any) -> Any:
            def callback(_integrator: Any, sign: int) -> bool:
                other = mode.state[5 - at]
                way = 1.0 if other > 0.0 else -1.0
                mode.parameters[last] = bend * (sign + way)
                return True

            return hy.t_event(one, callback=callback)

        system[1] = (v, acceleration - memory * z)
        events += [turns(1, v), turns(4, z)]
        flight = (*flight, 2.0 * bend)
        # From rest x, v and z are zero at once, which no event takes for a crossing: an instant
        # later the motion is known to rounding.
        push = problem.amplitude
        start = (0.5 * push * _INSTANT**2, push * _INSTANT, 1.0, problem.frequency * _INSTANT)
        start = (*start, start[0])
    omega = problem.frequency
    system += [(cosine, -omega * sine), (sine, omega * cosine)]
    if problem.hysteretic:
        system.append((z, v * (1.0 - par[last] * z)))
    return _built(problem, system, start, flight, events, tol, mode)


def _power(problem: Smooth, tol: float) -> Built:
    """Between stops of power 1.5."""
    gap, k, chi = problem.gap, problem.stiffness, problem.dissipation
    par = hy.par
    mode = _Mode()
    y, v, cosine, sine, t = hy.make_vars("y", "v", "cosine", "sine", "t")

    # y is x in flight and w in contact, x = par0 + y (par1 + par2 y). Then the clock's rate
    # par3 + par4 y, the force y^3 (par5 + par6 v), and of y' = par7 v and of both
    # event functions par8 - par9 y and par10 + par11 y.
    flight = (0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, gap, 1.0, gap, 1.0)
    contacts = tuple(
        (sign * gap, 0.0, sign, 0.0, 2.0, sign * k, k * chi, sign, 0.0, -1.0, 1.0, 0.0)
        for sign in (1.0, -1.0)
    )

    def on_stop(side: int) -> Any:
        in_flight, in_contact = array("d", flight), array("d", contacts[side])

        def callback(_integrator: Any, _sign: int) -> bool:
            if mode.touching:
                # Contact ends by the first event function, whichever side it was.
                where = mode.parameters[0]
                mode.parameters[:12] = in_flight
                mode.state[0] = where
            else:
                mode.parameters[:12] = in_contact
                mode.state[0] = 0.0
            mode.touching = not mode.touching
            return True

        return callback

    x = par[0] + y * (par[1] + par[2] * y)
    rate = par[3] + par[4] * y
    force = (y * (y * y)) * (par[5] + par[6] * v)
    acceleration = problem.amplitude * cosine - problem.damping * v - x - force
    omega = problem.frequency
    system = [
        (y, par[7] * v),
        (v, rate * acceleration),
        (cosine, rate * (-omega * sine)),
        (sine, rate * (omega * cosine)),
        (t, rate),
    ]
    events = [
        hy.t_event(par[8] - par[9] * y, callback=on_stop(0), direction=_FALLING),
        hy.t_event(par[10] + par[11] * y, callback=on_stop(1), direction=_FALLING),
        hy.t_event(par[12] - t, direction=_FALLING),
    ]
    return _built(problem, system, (0.0, 0.0, 1.0, 0.0, 0.0), (*flight, 0.0), events, tol, mode)


def _built(
    problem: Smooth,
    system: list[Any],
    start: tuple[float, ...],
    flight: tuple[float, ...],
    events: list[Any],
    tol: float,
    mode: _Mode,
) -> Built:
    integrator = hy.taylor_adaptive(
        system,
        list(start),
        pars=list(flight),
        t_events=events,
        tol=tol,
        fast_math=True,
        compact_mode=False,
    )
    return Built(integrator, problem, start, flight, mode)


def run(built: Built, periods: int) -> tuple[float, float]:
    """Integrate from rest over a number of forcing periods, to x and x'.

    Raises
    ------
    RuntimeError
        If heyoka stops early.
    """
    integrator, mode, problem = built.integrator, built.mode, built.problem
    integrator.state[:] = built.start
    integrator.pars[:] = built.flight
    integrator.time = _INSTANT if problem.hysteretic else 0.0
    integrator.reset_cooldowns()
    mode.touching = False
    mode.parameters, mode.state = memoryview(integrator.pars), memoryview(integrator.state)
    end = periods * problem.period
    expected: Any = hy.taylor_outcome.time_limit
    if problem.power:
        integrator.pars[12] = end
        # A contact's own variable is longer than its time.
        outcome = integrator.propagate_until(100.0 * end)[0]
        expected = hy.taylor_outcome(-3)
    else:
        outcome = integrator.propagate_until(end)[0]
    mode.parameters = mode.state = None
    if outcome != expected:
        raise RuntimeError(f"heyoka stopped with {outcome}")
    x, v = integrator.state[:2].tolist()
    if problem.power:
        place, first, second = integrator.pars[:3].tolist()
        x = place + x * (first + second * x)
    return x, v
