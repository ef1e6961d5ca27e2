"""Scenarios of rigs at the limits of the model."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from scenarios.node import in_map
from vibroimpact.scenarios.classify import classify
from vibroimpact.scenarios.scenario import Scenario


def test_a_far_stop_that_is_never_reached_changes_nothing():
    """The range must reach the resonance of the near one alone."""
    near = vi.from_dimensionless(25.9, 0.0, 0.01, 0.15)
    gap = 5.0 * vi.from_dimensionless(25.9, 1.0, 0.01, 0.15).oscillator.right.gap
    far = near.oscillator.left.replace(gap=gap)
    both = classify(vi.Rig(near.oscillator.replace(left=far), near.amplitude))
    alone = classify(vi.Rig(near.oscillator.replace(left=None), near.amplitude))
    assert both.scenario == alone.scenario
    assert both.features.within
    assert both.features.swept == alone.features.swept


def test_light_damping_is_waited_for():
    """A linear rig (attached, elastic): at ten times f0 it decays by e^-0.01 a cycle."""
    rig = vi.from_dimensionless(30.0, 0.0, 0.0, 0.01)
    assert in_map(rig) == "S5"
    assert classify(rig).scenario == "S5"


def test_too_short_a_wait_names_nothing():
    rig = vi.from_dimensionless(25.9, 0.5, 0.01, 0.15)
    assert classify(rig, max_cycles=1).scenario == "unclassified"


@pytest.mark.parametrize(("low", "high"), [(0.4, 1.2), (0.3, 0.69), (2.5, 4.0)])
def test_a_range_without_the_resonance_names_nothing(low, high):
    rig = vi.from_dimensionless(25.9, 0.5, 0.01, 0.15)
    held = np.arange(low, high, 0.01) * rig.oscillator.natural_frequency
    verdict = classify(rig, held)
    assert verdict.scenario == "unclassified"
    assert "outside the frequency range" in verdict.evidence or "no contact" in verdict.evidence


@pytest.mark.parametrize("value", [{"extent": 1}, 3])
def test_thresholds_that_are_none_are_refused(value):
    rig = vi.from_dimensionless(25.9, 0.5, 0.01, 0.15)
    with pytest.raises(vi.InputError, match=r"thresholds: .* is not a Thresholds; .*, or None$"):
        classify(rig, thresholds=value)


def test_the_dataset_has_the_variables_of_a_map_and_those_of_the_sweep():
    rig = vi.from_dimensionless(25.9, 0.5, 0.01, 0.15)
    data, inside = vi.classify_scenario(rig), classify(rig)
    assert data.attrs["label"] == inside.scenario == Scenario(data["scenario"].item()).label
    assert data.attrs["evidence"] == inside.evidence
    assert data["confidence"].item() == inside.confidence
    assert data["fold_frequency"].values.tolist() == list(inside.features.folds)
    nodes = vi.scenario_map(
        None, {"stiffness_ratio": [25.9, 26.0], "gap_ratio": [0.5, 0.6]}, step=0.1
    )
    assert {str(name) for name in nodes} - {"level"} <= {str(name) for name in data}
    assert data["eta_a"].identical(inside.sweep["eta_a"])


def test_a_threshold_that_matters_is_listed():
    data = vi.classify_scenario("B2-G4-A1")
    assert data.attrs["label"] == "S1"
    assert data.attrs["alternatives"] == "S2 if touch were 0.05"
