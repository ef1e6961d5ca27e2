"""What the orbits behind the curves add to the evidence: kinds of motion, and exact jumps."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator, State
from vibroimpact.model.rig import Rig
from vibroimpact.response.curve_pair import DIRECTIONS, Swept
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.prepared_rig import prepare
from vibroimpact.scenarios.evidence import Evidence, Irregular, Kind
from vibroimpact.scenarios.hidden_folds import hidden_stretches
from vibroimpact.scenarios.resonance_curves import Holds
from vibroimpact.stability.branch import branch, turning_points
from vibroimpact.stability.motion_exponents import judge_wandering
from vibroimpact.stability.settled_motion import Settled

KIND_CYCLES = 5000
"""Forcing cycles over which growth distinguishes chaotic from quasi-periodic motions."""
_LONGER = 20
"""How many times as long a motion is followed that seems quasi-periodic."""
_MAX_EVENTS = 10_000
_RELAXATIONS = 20.0
"""Relaxation times in a forcing cycle after which a bumper has relaxed."""

Check = Callable[[], None]


def with_kinds(
    evidence: Evidence,
    rig: Rig,
    ended: Holds,
    cycles: int = KIND_CYCLES,
    check: Check = lambda: None,
    *,
    brief: bool = False,
) -> Evidence:
    """Name the motions that are not periodic, by the growth of disturbances.

    Of each range, the motion in its middle is named; one that no verdict was found for stays
    "not periodic". `check` is called before each that is followed, and may raise to end it.

    If `brief`, as a map counts them: of a range of the backward sweep that overlaps a chaotic one
    of the forward sweep nothing is asked where only chaos, already counted, could be found in it.
    """
    oscillator = rig.oscillator
    named: list[Irregular] = []
    for item in evidence.irregular:
        is_counted = brief and any(
            "chaotic" in known.kinds and known.low <= item.high and item.low <= known.high
            for known in named
        )
        if item.not_periodic is None or (is_counted and _forgetful(oscillator, item.high)):
            named.append(item)
            continue
        check()
        kind = _kind(item, rig, ended, cycles, check)
        kinds = tuple(kind if known == "not periodic" else known for known in item.kinds)
        named.append(item._replace(kinds=kinds))
    return evidence._replace(irregular=tuple(named))


def _forgetful(oscillator: Oscillator, frequency: float) -> bool:
    """Whether all bumpers forget within a cycle: no motion is quasi-periodic (theory, 6.5)."""
    damped = oscillator.isolator.linear and oscillator.isolator.damping > 0.0
    if not damped:
        return False
    for stop in oscillator.stops.values():
        if stop.rigid:
            continue
        if stop.spring_and_dashpot is None:
            return False
        stiffness, damping = stop.spring_and_dashpot
        if damping * frequency * _RELAXATIONS > stiffness:
            return False
    return True


def _kind(
    item: Irregular,
    rig: Rig,
    ended: Holds,
    cycles: int,
    check: Check,
) -> Kind:
    """The kind of the motion in the middle of those of a range that are not periodic."""
    oscillator, shaken = rig.oscillator, rig.sine
    assert item.not_periodic is not None
    low, high = item.not_periodic
    k = DIRECTIONS.index(item.direction)
    inside = (low <= ended.frequency) & (ended.frequency <= high)
    wandering = np.flatnonzero(inside & (ended.period[k] == 0))
    i = int(wandering[len(wandering) // 2])
    if ended.plain[k, i]:
        return "chaotic"
    start = ended.state(item.direction, i)
    excitation = shaken.replace(frequency=float(ended.frequency[i]), phase=start.phase or 0.0)
    followed = Settled(
        prepare(Rig(oscillator, excitation)),
        engine_state(oscillator, start),
        0,
        0,
        Status.NOT_SETTLED,
    )

    def judged(state: NDArray[np.float64], cycles: int) -> tuple[str, bool]:
        judgement, _, _, status = judge_wandering(followed, state, cycles, _MAX_EVENTS)
        return (judgement.motion, judgement.bounded) if status is Status.DONE else ("", False)

    state = followed.state.copy()
    motion, bounded = judged(state, cycles)
    if motion == "quasi-periodic" or bounded:
        check()
        # A slow transient, or chaos that is slow to show, looks the same for a while.
        motion, _ = judged(state, _LONGER * cycles)
    kinds: dict[str, Kind] = {"chaotic": "chaotic", "quasi-periodic": "quasi-periodic"}
    return kinds.get(motion, "not periodic")


def with_folds(
    evidence: Evidence,
    rig: Rig,
    ended: Holds,
    both: Swept | None = None,
) -> Evidence:
    """Find where the branch through the primary resonance turns back, where it can be followed.

    With the curves of both directions it is followed only between those neighbouring frequencies
    where it may turn unseen, as a map asks; of a hysteresis that shows, folds may then be missing.
    """
    oscillator, shaken = rig.oscillator, rig.sine
    first = _primary_orbit(evidence, shaken, ended)
    if first is None:
        return evidence._replace(folds=None)
    low, high = evidence.swept
    stretches = None if both is None else hidden_stretches(both, ended)
    begins = [None] if stretches is None else [_within(ended, shaken, *one) for one in stretches]
    parts = [one for one in begins if one is not None]
    turns = _turns(oscillator, parts) if len(parts) == len(begins) else None
    if turns is None:
        turns = _turns(oscillator, [(first, low, high)])
    folds = None if turns is None else tuple(sorted(f for f in turns if low < f < high))
    return evidence._replace(folds=folds)


_Begun: TypeAlias = tuple[tuple[Harmonic, State], float, float]


def _turns(oscillator: Oscillator, parts: list[_Begun]) -> set[float] | None:
    """Where a branch turns back in some parts of it (Hz); None where Newton's method fails."""
    try:
        return {
            f
            for (shaken, state), begin, end in parts
            for f in turning_points(Rig(oscillator, shaken), state, (begin, end))
        }
    except InputError:
        return None


def _within(ended: Holds, shaken: Harmonic, first: int, last: int) -> _Begun | None:
    """Where a branch begins at one end of a stretch, and the frequencies of both; None if nowhere.

    In contact, for beside the branches of a narrow gap free flight is another one.
    """
    for i in (first, last):
        if ended.period[0, i] == 1 and ended.contacts[0, i].any():
            return (
                _orbit(ended, shaken, i),
                float(ended.frequency[first]),
                float(ended.frequency[last]),
            )
    return None


def primary_branch(evidence: Evidence, rig: Rig, ended: Holds) -> xr.Dataset | None:
    """The branch of orbits through the primary resonance, over the frequencies that were swept.

    None where the mass hits no bumper, where the motion there is not of one forcing cycle, or
    where Newton's method finds no orbit, as on the edge of stability.
    """
    oscillator, shaken = rig.oscillator, rig.sine
    first = _primary_orbit(evidence, shaken, ended)
    if first is None:
        return None
    low, high = evidence.swept
    try:
        return branch(Rig(oscillator, first[0]), first[1], vary={"frequency": (low, high)})
    except InputError:
        return None


def _primary_orbit(
    evidence: Evidence, shaken: Harmonic, ended: Holds
) -> tuple[Harmonic, State] | None:
    """The forcing at the primary resonance and the state there, where the branch begins."""
    tops = [
        p for p in evidence.peaks if p.primary and p.direction == "forward" and p.curve == "eta_a"
    ]
    if evidence.contact is None or not tops:
        return None
    i = int(np.searchsorted(ended.frequency, tops[0].frequency))
    return None if int(ended.period[0, i]) != 1 else _orbit(ended, shaken, i)


def _orbit(ended: Holds, shaken: Harmonic, i: int) -> tuple[Harmonic, State]:
    """The forcing of a hold, and the state at its end."""
    at = shaken.replace(frequency=float(ended.frequency[i]), phase=0.0)
    return at, ended.state("forward", i)
