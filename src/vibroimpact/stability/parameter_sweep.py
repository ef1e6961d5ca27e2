"""A parameter in steps: each value is held until the motion is steady, then comes the next.

As in a stepped sweep, but of any parameter. The motion is carried on from value to value; where
the rig itself has changed, its state is put where it can be.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model.parameter_ranges import field_of
from vibroimpact.model.parameters import Parameter
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.hold_rows import HoldRows, Settling
from vibroimpact.response.prepared_rig import prepare
from vibroimpact.stability.nearest_state import nearest_state, random_state
from vibroimpact.stability.settled_motion import Settled, reach_at_rest
from vibroimpact.tasks.threads import Stopped, Tally

_Array = NDArray[np.float64]

_SOUND = (Status.DONE, Status.NOT_SETTLED)


class SettledPoint(NamedTuple):
    """Where a motion went at one value, and what was measured of it there."""

    motion: Settled
    measured: HoldRows


def rigs_along(varied: Parameter, rig: Rig, values: Iterable[float]) -> list[Rig]:
    """Return the rig at each value of a parameter.

    Raises
    ------
    InputError
        If the rig has no such parameter, cannot have such a value, or is undamped at resonance.
    """
    varied.read(rig)  # refuses what the rig does not have
    rigs = [varied.vary(rig, float(value)) for value in values]
    for one in rigs:
        engine_system(one.system).check_bounded(one)
        shaken = one.periodic
        if not (shaken.amplitude > 0.0 and shaken.frequency > 0.0):
            field = field_of(varied.name)
            raise InputError(f"{field}[0]: the {varied.name} is 0; pass a value greater than 0")
    return rigs


def stepped(
    every: Sequence[Rig],
    start: _Array | None,
    settling: Settling,
    seen: Callable[[SettledPoint], None],
    tally: Tally,
    *,
    carry: bool = True,
) -> None:
    """Hold one rig after the other.

    `seen` is called with the result of each value. In `tally`, a hold is one step.

    Parameters
    ----------
    every
        The rig at each value, in the order in which they are held.
    start
        Where the first begins, as the engine's vector, put where it can be; None for the rest.
    carry
        Whether the next goes on where one has ended; if not, it begins where the first did.
    """
    before: SettledPoint | None = None
    for rig in every:
        if tally[1]:
            raise Stopped
        going_on = carry and before is not None and before.motion.status in _SOUND
        if going_on and before is not None:
            state = before.motion.state
            if rig.system != before.motion.rig.system:
                state = nearest_state(rig, state)
        elif start is None:
            state = prepare(rig).state()
        else:
            state = nearest_state(rig, start)
        before = _held(rig, state, settling)
        seen(before)
        tally[0] += 1


def _held(rig: Rig, state: _Array, settling: Settling) -> SettledPoint:
    engine = prepare(rig)
    row, reached = engine.dwell(state, settling)
    status = Status(int(engine.states.judged(row.status, row.peak_displacement)))
    motion = Settled(engine, reached, int(row.period), int(row.cycles), status)
    return SettledPoint(motion, row)


def random_states(
    met: Iterable[SettledPoint], every: Sequence[Rig], count: int, seed: int
) -> list[_Array]:
    """Random states up to 1.5 times as large as what was met, or as the widest gap if that is more.

    Vectors of the engine. Where there is neither, they are as large as the mass is moved by what
    shakes it slowly.
    """
    sizes = [_size(one) for one in met if one.motion.status in _SOUND]
    gaps = [law.gap for rig in every for law in rig.system.stop_laws.values()]
    size = max([0.0, *sizes, *gaps]) or max(reach_at_rest(one) for one in every)
    omega = float(np.median([rig.periodic.angular_frequency for rig in every]))
    generator = np.random.default_rng(seed)
    return [random_state(every[0], generator, size, omega) for _ in range(count)]


def _size(held: SettledPoint) -> float:
    """Return the largest displacement of all masses (m)."""
    measured = held.motion.states.measured(held.measured.array, ())
    return float(np.max(measured["peak_displacement"][1]))
