"""A parameter in steps: each value is held until the motion is steady, then comes the next.

As in a stepped sweep, but of any parameter. The motion is carried on from value to value; where
the rig itself has changed, its state is put where it can be.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import hold
from vibroimpact.engine import motion as layout
from vibroimpact.engine import parameters as par
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Oscillator, Repeated, RigidStop, State, equilibrium
from vibroimpact.model.access import Setting
from vibroimpact.model.parameters import Parameter
from vibroimpact.response.analytic_free_response import check_bounded
from vibroimpact.response.engine_input import engine_rig, engine_state
from vibroimpact.response.propagate import hold_once
from vibroimpact.response.softening_limit import judged
from vibroimpact.stability.settle import Settled, reach_at_rest
from vibroimpact.tasks.threads import Stopped, Tally

_Array = NDArray[np.float64]

_RANDOM_SIZE = 1.5
_SOUND = (Status.DONE, Status.NOT_SETTLED)


class Patience(NamedTuple):
    """How long a value is held."""

    tolerance: float = 1e-12
    max_cycles: int = 2000
    window: int = 500
    """Cycles over which a motion that did not settle is measured."""
    max_events: int = 10_000


class Held(NamedTuple):
    """Where a motion went at one value, and what was measured of it there."""

    found: Settled
    measured: _Array
    """A row of `engine.hold`."""


def settings(
    varied: Parameter, oscillator: Oscillator, excitation: Repeated, values: Iterable[float]
) -> list[Setting]:
    """The rig and its forcing at each value of a parameter.

    Raises
    ------
    InputError
        If the rig has no such parameter, cannot have such a value, or is undamped at resonance.
    """
    varied.read(oscillator, excitation)  # refuses what the rig does not have
    found = [varied.write(oscillator, excitation, float(value)) for value in values]
    for rig, shaken in found:
        check_bounded(rig, shaken)
        if not (shaken.amplitude > 0.0 and shaken.frequency > 0.0):
            raise InputError(f"low: {varied.name} of 0; a value greater than 0 is accepted")
    return found


def stepped(
    every: Sequence[Setting],
    start: _Array | None,
    patience: Patience,
    seen: Callable[[Held], None],
    tally: Tally,
    *,
    carry: bool = True,
) -> None:
    """Hold one setting after the other.

    Parameters
    ----------
    every
        The rig and its forcing at each value, in the order in which they are held.
    start
        Where the first begins, as the engine's vector, put where it can be; None for the rest.
    patience
        How long each is held.
    seen
        Called with what was found of each.
    tally
        See `response.threads.each`; a hold is one step.
    carry
        Whether the next goes on where one has ended; if not, it begins where the first did.
    """
    before: Held | None = None
    for rig, shaken in every:
        if tally[1]:
            raise Stopped
        going_on = carry and before is not None and before.found.status in _SOUND
        if going_on and before is not None:
            state = before.found.state
            if rig != before.found.oscillator:
                state = placed(rig, shaken, state)
        elif start is None:
            state = engine_state(rig, equilibrium(rig))
        else:
            state = placed(rig, shaken, start)
        before = _held(rig, shaken, state, patience)
        seen(before)
        tally[0] += 1


def _held(rig: Oscillator, shaken: Repeated, state: _Array, patience: Patience) -> Held:
    row, reached = hold_once(engine_rig(rig, shaken), shaken, state, *patience)
    swing = np.abs(row[[hold.U_LEAST, hold.U_MOST]]).max()
    status = Status(int(judged(rig, row[hold.OUTCOME], swing)))
    found = Settled(rig, shaken, reached, int(row[hold.PERIOD]), int(row[hold.CYCLES]), status)
    return Held(found, row)


def placed(rig: Oscillator, shaken: Repeated, state: _Array) -> _Array:
    """The nearest state that a rig can have: no mass inside a stop, no memory beyond its bounds."""
    u, v = float(state[layout.U]), float(state[layout.V])
    if isinstance(rig.right, RigidStop):
        u = min(u, rig.right.gap)
    if isinstance(rig.left, RigidStop):
        u = max(u, -rig.left.gap)
    right, left = (
        sign * max(float(state[at]), sign * u - stop.gap, 0.0) if isinstance(stop, Bumper) else None
        for stop, sign, at in (
            (rig.right, 1.0, layout.RIGHT_BUMPER),
            (rig.left, -1.0, layout.LEFT_BUMPER),
        )
    )
    most = engine_rig(rig, shaken)[par.YIELD]
    memory = min(max(float(state[layout.ISOLATOR]), -most), most)
    return engine_state(rig, State(u, v, right, left, isolator=memory))


def random_states(
    met: Iterable[Held], every: Sequence[Setting], count: int, seed: int
) -> list[_Array]:
    """Random states up to 1.5 times as large as what was met, or as the widest gap if that is more.

    Vectors of the engine. Where there is neither, they are as large as the mass is moved by what
    shakes it slowly.
    """
    sizes = [
        np.abs(one.measured[[hold.U_LEAST, hold.U_MOST]]).max()
        for one in met
        if one.found.status in _SOUND
    ]
    gaps = [stop.gap for rig, _ in every for stop in rig.stops]
    size = max([0.0, *sizes, *gaps]) or max(reach_at_rest(*one) for one in every)
    omega = float(np.median([shaken.angular_frequency for _, shaken in every]))
    generator = np.random.default_rng(seed)
    states = []
    for _ in range(count):
        u, v = generator.uniform(-_RANDOM_SIZE, _RANDOM_SIZE, 2) * size
        state = np.zeros(layout.STATE)
        state[layout.U], state[layout.V] = u, v * omega
        states.append(state)
    return states
