"""Name the scenario of one rig, with the evidence for it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import xarray as xr

from vibroimpact.arguments import check_progress
from vibroimpact.errors import InputError
from vibroimpact.model.html_table import table
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.response.sweep import sweep
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.scenarios.classification import alternatives, confidence, scenario
from vibroimpact.scenarios.evidence import Evidence, evidence
from vibroimpact.scenarios.evidence_text import in_words
from vibroimpact.scenarios.orbit_evidence import with_folds, with_kinds
from vibroimpact.scenarios.resonance_curves import holds
from vibroimpact.scenarios.sweep_frequencies import cycles, highest
from vibroimpact.scenarios.sweep_frequencies import frequencies as default_frequencies
from vibroimpact.scenarios.thresholds import Thresholds, checked
from vibroimpact.tasks.threads import Progress

MAX_CYCLES = 2000
"""Forcing cycles to wait for a steady motion, at least."""
LEAST = 4
"""Frequencies, for curves are looked at."""


@dataclass(frozen=True)
class Classification:
    """A scenario, and why.

    Attributes
    ----------
    scenario
        ``"S0"`` to ``"S6"``, or ``"unclassified"``.
    confidence
        Share of the variations of the thresholds, each halved and each doubled, under which
        the scenario is the same.
    evidence
        What the curves show, in words.
    alternatives
        The variations that give another scenario: (threshold, its value) to scenario.
    features
        The evidence in numbers.
    thresholds
        Those that were used.
    sweep
        The resonance curves, as `vibroimpact.sweep` gives them.
    """

    scenario: str
    confidence: float
    evidence: str
    alternatives: dict[tuple[str, float], str]
    features: Evidence = field(repr=False)
    thresholds: Thresholds = field(repr=False)
    sweep: xr.Dataset = field(repr=False)

    def __str__(self) -> str:
        return f"{self.scenario} ({self.confidence:.0%}): {self.evidence}"

    def _repr_html_(self) -> str:
        rows = [("confidence", f"{self.confidence:.0%}"), ("evidence", self.evidence)]
        rows += [
            (f"if {threshold} were {value:g}", scenario)
            for (threshold, value), scenario in self.alternatives.items()
        ]
        return table(f"Scenario {self.scenario}", rows)


def classify_scenario(
    rig: AnyRig,
    frequencies: Iterable[float | str] | None = None,
    *,
    thresholds: Thresholds | None = None,
    max_cycles: int | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Classification:
    """Name the scenario of a rig: S0 to S6, or unclassified (the paper's Sections 4.3 and 6).

    The rig is swept forward and backward. Motions that did not become periodic are named by
    the growth of disturbances, and the branch of orbits through the primary resonance tells the
    jumps exactly: also those of a hysteresis so narrow that it hides between two frequencies.

    Parameters
    ----------
    rig
        The rig: a `Rig`, a laboratory case, its code, or the path of a study file.
    frequencies
        The frequencies to hold in Hz, rising. None for steps of a hundredth of the natural
        frequency from 0.4 times it to beyond where the primary resonance can lie.
    thresholds
        Where one scenario ends and the next begins; see `Thresholds`.
    max_cycles
        Forcing cycles to wait for a steady motion. None for 2000, and more where damping is
        light.
    threads, progress
        As in `sweeps`.

    Returns
    -------
    Classification
        ``scenario``, ``confidence``, ``evidence``, and what they were found from.

    Raises
    ------
    InputError
        If a value cannot be used.
    """
    check_progress(progress)
    used = checked(thresholds)
    rig = one_sine(as_rig(rig))
    held = default_frequencies(rig) if frequencies is None else frequencies
    if max_cycles is None:
        max_cycles = cycles(rig, highest(rig), MAX_CYCLES)
    data = sweep(rig, held, max_cycles=max_cycles, threads=threads, progress=progress)
    if data.sizes["frequency"] < LEAST:
        raise InputError(
            f"frequencies: {data.sizes['frequency']} given; at least {LEAST} are accepted, for "
            "curves are looked at"
        )
    found = evidence(rig, data, 0.5 * used.prominence)
    total = data.sizes["frequency"] * data.sizes["direction"]

    def check() -> None:
        if progress is not None:
            progress(total, total)  # which may raise, where the answer is not wanted any more

    ended = holds(data)
    found = with_kinds(found, rig, ended, check=check)
    check()
    found = with_folds(found, rig, ended)
    return Classification(
        scenario(found, used).label,
        confidence(found, used),
        in_words(found, used),
        {varied: other.label for varied, other in alternatives(found, used).items()},
        found,
        used,
        data,
    )
