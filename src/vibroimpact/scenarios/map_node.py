"""One node of a map: its rig is swept and classified."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.settling import PATIENT
from vibroimpact.model.rig import Rig
from vibroimpact.response.curve_pair import Direction
from vibroimpact.response.peaks import Curve
from vibroimpact.scenarios.classification import confidence, scenario
from vibroimpact.scenarios.evidence import Evidence, evidence_of
from vibroimpact.scenarios.orbit_evidence import with_folds, with_kinds
from vibroimpact.scenarios.resonance_curves import swept_alone
from vibroimpact.scenarios.sweep_frequencies import cycles, held, highest
from vibroimpact.scenarios.thresholds import Thresholds
from vibroimpact.tasks.threads import Stopped, Tally

MAX_CYCLES = 300
"""Forcing cycles to wait for a steady motion, at least; more where damping is light."""
WINDOW = 100
"""Forcing cycles over which a motion that did not settle is measured."""
KIND_CYCLES = 2000
"""Forcing cycles over which growth distinguishes chaotic from quasi-periodic motions."""
RIG = 10**9
"""What a rig counts in a tally: more than its holds, which the sweeps count one by one."""

Value = Callable[[Evidence, Thresholds], float]

VALUES: dict[str, Value] = {
    "confidence": confidence,
    "extent": lambda e, t: e.extent(t.prominence),
    "penetration_ratio": lambda e, t: e.penetration,
    "peak_eta_a_forward": lambda e, t: _peak(e, "eta_a", "forward"),
    "peak_eta_a_backward": lambda e, t: _peak(e, "eta_a", "backward"),
    "peak_eta_d_forward": lambda e, t: _peak(e, "eta_d", "forward"),
    "peak_eta_d_backward": lambda e, t: _peak(e, "eta_d", "backward"),
    "resonance_ratio": lambda e, t: e.resonance,
    "jump_down_ratio": lambda e, t: _over(e, e.right[-1].ends[1] if e.right else None),
    "jump_up_ratio": lambda e, t: _over(e, e.right[-1].ends[0] if e.right else None),
    "contact_low_ratio": lambda e, t: _over(e, e.contact[0] if e.contact else None),
    "contact_high_ratio": lambda e, t: _over(e, e.contact[1] if e.contact else None),
}
"""The numbers that a map holds of each node; NaN where there is none."""

Count = Callable[[Evidence, Thresholds], int]

COUNTS: dict[str, Count] = {
    "left_hysteresis_count": lambda e, t: len(e.left),
    "secondary_count": lambda e, t: len(e.secondary_resonances(t.prominence)),
    "irregular_count": lambda e, t: len(e.irregular_once),
    "chaotic_count": lambda e, t: _ranges(e, "chaotic"),
    "quasi_periodic_count": lambda e, t: _ranges(e, "quasi-periodic"),
    "subharmonic_count": lambda e, t: _ranges(e, "subharmonic"),
    "mirrored_pair_count": lambda e, t: _ranges(e, "mirrored pair"),
}
"""How many ranges of a kind a map counts at each node; -1 at nodes that were not computed."""


def classified(
    rigs: Sequence[Rig],
    thresholds: Thresholds,
    step: float,
    max_cycles: int | None,
    tally: Tally | None = None,
) -> dict[str, NDArray[Any]]:
    """Sweep some rigs, on this thread, and name their scenarios.

    Returns
    -------
    dict
        ``scenario`` and the names of `VALUES` and `COUNTS`, each an array with a value a rig.

    Raises
    ------
    Stopped
        If the tally asks for it; a rig that is done counts as `RIG` in it.
    """
    tally = np.zeros(2, dtype=np.int64) if tally is None else tally
    ordered = []
    for number, rig in enumerate(rigs, start=1):
        ordered.append(_seen(rig, thresholds, step, max_cycles, tally))
        tally[0] = number * RIG
    return {
        "scenario": np.array([scenario(one, thresholds) for one in ordered], dtype=np.int8),
        **{name: np.array([get(e, thresholds) for e in ordered]) for name, get in VALUES.items()},
        **{
            name: np.array([count(e, thresholds) for e in ordered], dtype=np.int16)
            for name, count in COUNTS.items()
        },
    }


def _seen(
    rig: Rig, thresholds: Thresholds, step: float, max_cycles: int | None, tally: Tally
) -> Evidence:
    """What the sweep of a rig shows, and its orbits where the map needs them."""

    def check() -> None:
        if tally[1]:
            raise Stopped

    high = highest(rig)
    waited, transient = max_cycles, PATIENT
    if waited is None:
        waited = cycles(rig, high, MAX_CYCLES)
        transient = cycles(rig, high, 1) / (high * rig.oscillator.natural_frequency)
    swept = held(rig.oscillator, high, step)
    curves, ended = swept_alone(rig, swept, waited, WINDOW, tally, transient)
    check()
    evidence = evidence_of(rig, curves, 0.5 * thresholds.prominence)
    evidence = with_kinds(evidence, rig, ended, KIND_CYCLES, check, brief=True)
    if _rests_on_a_jump(evidence, thresholds):
        check()
        evidence = with_folds(evidence, rig, ended, curves.both)
    return evidence


def _rests_on_a_jump(evidence: Evidence, thresholds: Thresholds) -> bool:
    """Whether the scenario may hang on a jump that no two frequencies show."""
    if evidence.right or evidence.contact is None:
        return False
    named = {scenario(evidence._replace(folds=folds), thresholds) for folds in ((), (math.inf,))}
    return len(named) > 1


def _peak(evidence: Evidence, curve: Curve, direction: Direction) -> float:
    heights = [p.value for p in evidence.peaks if p.curve == curve and p.direction == direction]
    return max(heights, default=math.nan)


def _over(evidence: Evidence, frequency: float | None) -> float:
    return math.nan if frequency is None else frequency / evidence.natural_frequency


def _ranges(evidence: Evidence, kind: str) -> int:
    """How many ranges hold such motions, those of the two directions that overlap once."""
    holding = [item for item in evidence.irregular if kind in item.kinds]
    return len(evidence._replace(irregular=tuple(holding)).irregular_once)
