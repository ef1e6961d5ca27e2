"""What the growth of disturbances says of a motion that was followed."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import lyapunov
from vibroimpact.engine.state import ONE_MASS
from vibroimpact.engine.status import Status
from vibroimpact.response.engine_system import EngineSystem
from vibroimpact.stability.exponents import DISCARD
from vibroimpact.stability.motion_type import Judgement, judge, repeats
from vibroimpact.stability.settled_motion import Settled, section_sizes
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]

_TINY = 1e-10
"""A multiplier smaller than this times the largest one is lost in its rounding."""
_TURNING = 8
"""Periods in which disturbances turn into their directions, where the second one is lost."""


def judge_orbit(motion: Settled, max_events: int) -> tuple[Judgement, float, int, Status]:
    """Exponents of a periodic motion from its monodromy matrix; the rest as `judge_wandering`."""
    parts = motion.states.parts
    carried = np.empty((parts, parts))
    damping = np.empty(1)
    state = motion.state.copy()
    rates = []
    for _ in range(2):  # the second time shows how far rounding and the rest of a transient go
        outcome = lyapunov.monodromy(
            motion.engine.vector,
            motion.excitation.amplitude,
            motion.excitation.frequency,
            motion.excitation.phase,
            state,
            motion.period,
            max_events,
            carried,
            damping,
        )
        if outcome != Status.DONE:
            nothing = np.full(2 * motion.states.masses, np.nan)
            judgement = Judgement("undecided", 0, nothing, nothing, Status(outcome).advice)
            return judgement, math.nan, 0, Status(outcome)
        rates.append(_rates(motion.states, carried) / motion.period)
    first, second = rates
    if np.isnan(first[1]) or np.isnan(second[1]):
        first[1] = second[1] = _second(motion, state, max_events)
    finite = np.isfinite(first) & np.isfinite(second)
    spread = np.abs(np.subtract(first, second, where=finite, out=np.zeros(len(first))))
    largest = math.exp(min(first[0] * motion.period, 700.0))
    kind = Judgement(
        "periodic",
        motion.period,
        first,
        spread,
        f"{repeats(motion.period)}; largest multiplier {largest:.6g} in modulus",
    )
    return kind, float(damping[0]) / motion.period, 2 * motion.period, Status.DONE


def _rates(states: EngineSystem, carried: _Array) -> _Array:
    """Logarithms of the largest multipliers of an orbit; NaN if the second is lost in rounding.

    A bumper that is never touched only relaxes; it is left out. What an isolator remembers is
    kept: during a rest on a stop it is not coupled to the motion, and the motion still depends on
    it later in the cycle.
    """
    if states.system.by_mass:
        moduli = np.sort(np.abs(np.linalg.eigvals(carried)))[::-1]
        with np.errstate(divide="ignore"):
            log_moduli: _Array = np.log(moduli[: 2 * states.masses])
        return log_moduli
    touched = [j for j in (2, 3) if carried[:2, j].any() or carried[j, :2].any()]
    memory = ONE_MASS.of_point.memory()
    kept = [0, 1, *touched, *([memory] if carried[memory].any() else [])]
    moduli = np.sort(np.abs(np.linalg.eigvals(carried[np.ix_(kept, kept)])))[::-1]
    with np.errstate(divide="ignore"):
        logarithms: _Array = np.log(moduli[:2])
    if moduli[0] > 0.0 and moduli[1] <= _TINY * moduli[0]:  # a rest leaves nothing of either
        logarithms[1] = np.nan
    return logarithms


def _second(motion: Settled, state: _Array, max_events: int) -> float:
    """Second exponent per cycle of an orbit whose second multiplier is lost in rounding.

    It is followed cycle by cycle, as for a motion that is not periodic: strong damping leaves a
    number, and a mass that sticks, or comes to rest, minus infinity.
    """
    status, rows = motion.engine.sections(
        state.copy(),
        motion.period,
        max_events,
        discard=_TURNING * motion.period,
    )
    return float(rows[:, lyapunov.SECOND].mean()) if status == Status.DONE else math.nan


def judge_wandering(
    motion: Settled,
    state: _Array,
    cycles: int,
    max_events: int,
    progress: Progress | None = None,
) -> tuple[Judgement, float, int, Status]:
    """Judge a motion that did not settle; the state is carried on, and progress counts cycles.

    Returns
    -------
    judgement, damping, cycles, status
        The damping per unit mass is the integral over a cycle, on average.
    """
    status, rows = motion.engine.sections(
        state, cycles, max_events, discard=DISCARD, progress=progress
    )
    damping = float(rows[:, lyapunov.DISSIPATION].mean()) if len(rows) else math.nan
    return judge_sections(motion, rows), damping, len(rows), status


def judge_sections(motion: Settled, rows: _Array) -> Judgement:
    """Judge a motion by its sections, and the growth of disturbances between them."""
    # That no motion is quasi-periodic where bumpers forget holds for one mass alone.
    several = motion.states.system.by_mass
    return judge(
        rows[:, : lyapunov.DISSIPATION],
        rows[:, lyapunov.SECTION :] / section_sizes(motion.engine),
        None if several else rows[:, lyapunov.DISSIPATION],
    )
