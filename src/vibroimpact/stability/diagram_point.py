"""What is seen at one value of a bifurcation diagram: its section, its kind, its exponents."""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import batch, lyapunov
from vibroimpact.engine.observers.record import DETACHMENT
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.status import Status
from vibroimpact.response.engine_system import EngineSystem, engine_system
from vibroimpact.response.outputs import NamedOutput, computed
from vibroimpact.stability.exponents import DISCARD
from vibroimpact.stability.motion_exponents import judge_orbit, judge_sections
from vibroimpact.stability.motion_type import Judgement
from vibroimpact.stability.parameter_sweep import SettledPoint
from vibroimpact.stability.settled_motion import Settled
from vibroimpact.stability.steady import approached

_Array = NDArray[np.float64]

Kind = Literal["stroboscopic", "impacts"]
"""Once a forcing cycle, or at the beginning of every contact."""

_IMPACT = ("stop", "phase", "velocity")
"""What the columns of an impact hold."""

_ROOM = 4096  # contacts that are written between two looks at the clock


LONGER = 4, 20
"""How many times as long a motion is followed, in turn, if it may be a torus or weakly chaotic."""


def point_width(section: Kind, states: EngineSystem) -> int:
    """Return the number of columns of a point of a section."""
    return len(_IMPACT) if section == "impacts" else states.parts


class SectionRecording(NamedTuple):
    """How the section of a motion is recorded."""

    section: Kind
    points: int
    """Cycles of a motion that does not settle whose sections are kept."""
    exponent_cycles: int
    max_events: int


class Seen(NamedTuple):
    """What is seen at one value."""

    held: SettledPoint
    kind: Judgement
    """Exponents per cycle."""
    points: _Array
    """Points of the section, a row each; of a periodic motion those of one period."""
    status: Status
    outputs: tuple[float, ...] = ()
    """Own outputs."""


def look_at(
    held: SettledPoint, look: SectionRecording, outputs: tuple[NamedOutput, ...] = ()
) -> Seen:
    """Name a motion, take its section, and compute own outputs."""
    seen = _looked_at(held, look)
    if seen.status not in (Status.DONE, Status.NOT_SETTLED):
        return seen._replace(outputs=(math.nan,) * len(outputs))
    if not outputs:
        return seen
    motion = seen.held.motion
    start = engine_system(motion.rig.system).state(motion.state, motion.excitation.phase)
    period = seen.kind.period
    values = computed(outputs, motion.rig, start, period or look.points, periodic=period > 0)
    return seen._replace(outputs=values)


def _looked_at(held: SettledPoint, look: SectionRecording) -> Seen:
    motion = held.motion
    if motion.status not in (Status.DONE, Status.NOT_SETTLED):
        return _nothing(held, look, motion.status)
    rows = np.empty((0, lyapunov.SECTION + motion.states.parts))
    if not motion.period:
        kind, rows, status = _wandering(motion, look)
        if kind.returns and (orbit := approached(motion, kind.returns)) is not None:
            motion = orbit  # on which it settles slowly
    if motion.period:
        kind, _, _, status = judge_orbit(motion, look.max_events)
        rows = rows[:0]
    if status is not Status.DONE:
        return _nothing(held, look, status)
    cycles = kind.period or look.points
    if look.section == "impacts":
        points, status = _impacts(motion, cycles, look.max_events)
    else:
        if not len(rows):
            status, rows = motion.engine.sections(motion.state.copy(), cycles, look.max_events)
        points = rows[:cycles, lyapunov.SECTION :]
    if status is not Status.DONE:
        return _nothing(held, look, status)
    named = Status.NOT_SETTLED if kind.motion == "undecided" else Status.DONE
    return Seen(held._replace(motion=motion), kind, points, named)


def _wandering(motion: Settled, look: SectionRecording) -> tuple[Judgement, _Array, Status]:
    """As `judge_wandering`, with what it has seen of the section."""
    cycles = max(look.exponent_cycles, look.points)
    for longer in (1, *LONGER):
        status, rows = motion.engine.sections(
            motion.state.copy(), longer * cycles, look.max_events, discard=DISCARD
        )
        kind = judge_sections(motion, rows)
        weak = kind.motion == "undecided" and (kind.bounded or kind.exponents[0] > 0.0)
        if status is not Status.DONE or not weak:
            break
    return kind, rows, status


def _impacts(motion: Settled, cycles: int, max_events: int) -> tuple[_Array, Status]:
    """Stop, phase of the forcing and velocity of each contact, as it begins."""
    shaken = motion.excitation
    state, number, parts = motion.state.copy(), 0, []
    outcome = 0
    while number < cycles and not outcome:
        events = np.empty((max_events + _ROOM, record_layout.EVENT))
        number, count, outcome = batch.trajectory(
            motion.engine.vector,
            shaken.amplitude,
            shaken.frequency,
            shaken.phase,
            state,
            float(number),
            float(cycles),
            0,
            max_events,
            np.empty((record_layout.SAMPLE, 0)),
            events,
        )
        parts.append(events[:count][events[:count, record_layout.E_KIND] != DETACHMENT])
    rows = np.concatenate(parts)
    turned = shaken.phase + shaken.angular_frequency * rows[:, record_layout.E_TIME]
    columns = [rows[:, record_layout.E_STOP], turned % (2.0 * math.pi), rows[:, record_layout.E_V]]
    return np.column_stack(columns), Status(outcome)


def _nothing(held: SettledPoint, look: SectionRecording, status: Status) -> Seen:
    """Of a motion that was given up."""
    empty = np.full(2, np.nan)
    kind = Judgement("undecided", 0, empty, empty, status.advice)
    states = held.motion.states
    width = point_width(look.section, states)
    return Seen(held, kind, np.empty((0, width)), status)
