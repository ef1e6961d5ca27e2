"""Classify a rig by its scenario (S0 to S6), with the evidence."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import xarray as xr

from vibroimpact.datasets.description import describe
from vibroimpact.errors import InputError
from vibroimpact.model.argument_types import PositiveInt
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.model.written_units import written_for
from vibroimpact.response.sweep import sweep
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.scenarios.classification import alternatives, confidence, scenario
from vibroimpact.scenarios.evidence import Evidence, evidence
from vibroimpact.scenarios.evidence_text import in_words
from vibroimpact.scenarios.map_node import COUNTS, VALUES
from vibroimpact.scenarios.orbit_evidence import with_folds, with_kinds
from vibroimpact.scenarios.resonance_curves import holds
from vibroimpact.scenarios.scenario import FLAGS, Scenario
from vibroimpact.scenarios.sweep_frequencies import cycles, highest
from vibroimpact.scenarios.sweep_frequencies import frequencies as default_frequencies
from vibroimpact.scenarios.thresholds import Thresholds, checked
from vibroimpact.tasks.threads import Progress

MAX_CYCLES = 2000
"""Least number of forcing cycles to wait for a steady motion."""
LEAST = 4
"""Least number of frequencies of a resonance curve."""


@dataclass(frozen=True)
class Classification:
    """A scenario, and why.

    Attributes
    ----------
    named
        The scenario.
    confidence
        Share of the variations of the thresholds, each halved and each doubled, under which
        the scenario is the same.
    evidence
        Features of the curves, in words.
    alternatives
        The variations that give another scenario: (threshold, its value) to scenario.
    features
        The evidence in numbers.
    thresholds
        Those that were used.
    sweep
        The resonance curves, as returned by `vibroimpact.sweep`.
    """

    named: Scenario
    confidence: float
    evidence: str
    alternatives: dict[tuple[str, float], str]
    features: Evidence
    thresholds: Thresholds
    sweep: xr.Dataset

    @property
    def scenario(self) -> str:
        """Return ``"S0"`` to ``"S6"``, or ``"unclassified"``."""
        return self.named.label


@public
def classify_scenario(
    rig: AnyRig,
    frequencies: Iterable[float | str] | None = None,
    *,
    thresholds: Thresholds | None = None,
    max_cycles: PositiveInt | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Classify the resonance curves of a rig by their scenario: S0 to S6, or unclassified.

    A scenario describes which resonances, jumps and hysteresis the curves have (the paper's
    Sections 4.3 and 6).

    The frequency is swept forward and backward. A motion that does not become periodic is
    classified by the growth of small disturbances. The branch of periodic orbits through the
    primary resonance gives the exact frequencies of the jumps, even if a narrow hysteresis lies
    between two frequencies of the sweep.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    frequencies
        Rising frequencies of the sweeps, in Hz. Default: from 0.4 times the natural frequency to
        above the highest possible primary resonance, in steps of a hundredth of the natural
        frequency.
    thresholds
        Thresholds between the scenarios; see `Thresholds`.
    max_cycles
        Number of forcing cycles to wait for a steady motion. Default: 2000, or more if the damping
        is light.
    threads, progress
        As in `sweeps`.

    Returns
    -------
    xarray.Dataset
        The resonance curves have the same variables as in `sweep`. ``scenario`` is the number of
        the scenario. The features that determine it have the same names as in `scenario_map`.
        ``fold_frequency`` contains the frequencies at which the branch of the primary resonance
        turns back.

        To estimate the confidence, each threshold is halved and doubled in turn. ``confidence`` is
        the share of these variations that give the same scenario.

        The attribute ``label`` is the scenario as text (``"S0"`` to ``"S6"``, or
        ``"unclassified"``). ``meaning`` describes this scenario, and ``evidence`` states why it was
        chosen. ``alternatives`` lists the variations that give another scenario.

    Raises
    ------
    InputError
        If a value is invalid.
    """
    classification = classify(
        rig,
        frequencies,
        thresholds=thresholds,
        max_cycles=max_cycles,
        threads=threads,
        progress=progress,
    )
    features, used = classification.features, classification.thresholds
    data = classification.sweep.assign(
        {
            "scenario": np.int8(classification.named),
            **{name: get(features, used) for name, get in VALUES.items()},
            **{name: np.int16(count(features, used)) for name, count in COUNTS.items()},
            "fold_frequency": ("fold", np.array(features.folds or (), dtype=np.float64)),
        }
    )
    data["scenario"].attrs |= FLAGS
    data.attrs |= {
        "created_by": "vibroimpact.classify_scenario",
        "label": classification.scenario,
        "meaning": classification.named.meaning,
        "evidence": classification.evidence,
        "alternatives": "; ".join(
            f"{other} if {threshold} were {value:g}"
            for (threshold, value), other in classification.alternatives.items()
        ),
    }
    return describe(data, data.attrs["created_by"])


@public
def classify(
    rig: AnyRig,
    frequencies: Iterable[float | str] | None = None,
    *,
    thresholds: Thresholds | None = None,
    max_cycles: PositiveInt | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Classification:
    """Classify a rig as `classify_scenario` does, and return the evidence as objects."""
    used = checked(thresholds)
    rig = one_sine(as_rig(rig))
    held = default_frequencies(rig) if frequencies is None else frequencies
    if max_cycles is None:
        max_cycles = cycles(rig, highest(rig), MAX_CYCLES)
    data = sweep(rig, held, max_cycles=max_cycles, threads=threads, progress=progress)
    if data.sizes["frequency"] < LEAST:
        raise InputError(
            f"frequencies: {data.sizes['frequency']} values are too few for a resonance curve; "
            f"pass at least {LEAST} frequencies"
        )
    features = evidence(rig, data, 0.5 * used.prominence)
    total = data.sizes["frequency"] * data.sizes["direction"]

    def check() -> None:
        if progress is not None:
            progress(total, total)  # which may raise, where the answer is not wanted any more

    ended = holds(data)
    features = with_kinds(features, rig, ended, check=check)
    check()
    features = with_folds(features, rig, ended)
    with written_for(rig):
        words = in_words(features, used)
    return Classification(
        scenario(features, used),
        confidence(features, used),
        words,
        {varied: other.label for varied, other in alternatives(features, used).items()},
        features,
        used,
        data,
    )
