"""A parameter in steps: each value is held until the motion is steady, then comes the next.

As in a stepped sweep, but of any parameter. The motion is carried on from value to value; where
the rig itself has changed, its state is put where it can be.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import motion as layout
from vibroimpact.engine import parameters as par
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Assembly, Oscillator, State
from vibroimpact.model.parameter_ranges import field_of
from vibroimpact.model.parameters import Parameter
from vibroimpact.model.rig import Rig
from vibroimpact.response.analytic_free_response import check_bounded
from vibroimpact.response.engine_input import engine_rig, engine_state
from vibroimpact.response.hold_rows import HoldRows, Settling
from vibroimpact.response.prepared_rig import prepare
from vibroimpact.response.softening_limit import judged
from vibroimpact.stability.assembly_diagram import place_assembly, random_assembly_states
from vibroimpact.stability.settled_motion import Settled, reach_at_rest
from vibroimpact.tasks.threads import Stopped, Tally

_Array = NDArray[np.float64]

_RANDOM_SIZE = 1.5
_SOUND = (Status.DONE, Status.NOT_SETTLED)


class Held(NamedTuple):
    """Where a motion went at one value, and what was measured of it there."""

    found: Settled
    measured: HoldRows


def rigs_along(varied: Parameter, rig: Rig, values: Iterable[float]) -> list[Rig]:
    """Return the rig at each value of a parameter.

    Raises
    ------
    InputError
        If the rig has no such parameter, cannot have such a value, or is undamped at resonance.
    """
    varied.read(rig)  # refuses what the rig does not have
    found = [varied.vary(rig, float(value)) for value in values]
    for one in found:
        if isinstance(one.system, Oscillator):
            check_bounded(one)
        shaken = one.periodic
        if not (shaken.amplitude > 0.0 and shaken.frequency > 0.0):
            field = field_of(varied.name)
            raise InputError(f"{field}[0]: the {varied.name} is 0; pass a value greater than 0")
    return found


def stepped(
    every: Sequence[Rig],
    start: _Array | None,
    settling: Settling,
    seen: Callable[[Held], None],
    tally: Tally,
    *,
    carry: bool = True,
) -> None:
    """Hold one rig after the other.

    Parameters
    ----------
    every
        The rig at each value, in the order in which they are held.
    start
        Where the first begins, as the engine's vector, put where it can be; None for the rest.
    settling
        How long each is held.
    seen
        Function that is called with the result of each value.
    tally
        See `response.threads.each`; a hold is one step.
    carry
        Whether the next goes on where one has ended; if not, it begins where the first did.
    """
    before: Held | None = None
    for rig in every:
        if tally[1]:
            raise Stopped
        going_on = carry and before is not None and before.found.status in _SOUND
        if going_on and before is not None:
            state = before.found.state
            if rig.system != before.found.rig.system:
                state = nearest_state(rig, state)
        elif start is None:
            state = prepare(rig).state()
        else:
            state = nearest_state(rig, start)
        before = _held(rig, state, settling)
        seen(before)
        tally[0] += 1


def _held(rig: Rig, state: _Array, settling: Settling) -> Held:
    engine = prepare(rig)
    row, reached = engine.dwell(state, settling)
    status = Status(int(row.status))
    if isinstance(rig.system, Oscillator):
        status = Status(int(judged(rig.system, row.status, row.peak_displacement)))
    found = Settled(engine, reached, int(row.period), int(row.cycles), status)
    return Held(found, row)


def nearest_state(rig: Rig, state: _Array) -> _Array:
    """The nearest state that a rig can have: no mass inside a stop, no memory beyond its bounds."""
    if isinstance(rig.system, Assembly):
        return place_assembly(rig, state)
    oscillator = rig.oscillator
    u, v = float(state[layout.U]), float(state[layout.V])
    if oscillator.right is not None and oscillator.right.rigid:
        u = min(u, oscillator.right.gap)
    if oscillator.left is not None and oscillator.left.rigid:
        u = max(u, -oscillator.left.gap)
    deformation = {
        side: max(float(state[at]), sign * u - stop.gap, 0.0)
        for side, sign, at in (
            ("right", 1.0, layout.RIGHT_BUMPER),
            ("left", -1.0, layout.LEFT_BUMPER),
        )
        if (stop := getattr(oscillator, side)) is not None and stop.spring_and_dashpot is not None
    }
    most = engine_rig(rig)[par.YIELD]
    memory = min(max(float(state[layout.ISOLATOR]), -most), most)
    return engine_state(oscillator, State(u, v, deformation, isolator=memory))


def random_states(met: Iterable[Held], every: Sequence[Rig], count: int, seed: int) -> list[_Array]:
    """Random states up to 1.5 times as large as what was met, or as the widest gap if that is more.

    Vectors of the engine. Where there is neither, they are as large as the mass is moved by what
    shakes it slowly.
    """
    if isinstance(every[0].system, Assembly):
        return random_assembly_states(met, every, count, seed)
    sizes = [float(one.measured.peak_displacement) for one in met if one.found.status in _SOUND]
    gaps = [stop.gap for rig in every for stop in rig.oscillator.stops]
    size = max([0.0, *sizes, *gaps]) or max(reach_at_rest(one) for one in every)
    omega = float(np.median([rig.periodic.angular_frequency for rig in every]))
    generator = np.random.default_rng(seed)
    states = []
    for _ in range(count):
        u, v = generator.uniform(-_RANDOM_SIZE, _RANDOM_SIZE, 2) * size
        state = np.zeros(layout.STATE)
        state[layout.U], state[layout.V] = u, v * omega
        states.append(state)
    return states
