"""Scenarios of rigs at the limits of the model."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from scenarios.node import in_map


def test_a_far_stop_that_is_never_reached_changes_nothing():
    """The range must reach the resonance of the near one alone."""
    near = vi.from_dimensionless(25.9, 0.0, 0.01, 0.15)
    gap = 5.0 * vi.from_dimensionless(25.9, 1.0, 0.01, 0.15).oscillator.right.gap
    far = near.oscillator.left.replace(gap=gap)
    both = vi.classify_scenario(vi.Rig(near.oscillator.replace(left=far), near.amplitude))
    alone = vi.classify_scenario(vi.Rig(near.oscillator.replace(left=None), near.amplitude))
    assert both.scenario == alone.scenario
    assert both.features.within
    assert both.features.swept == alone.features.swept


def test_light_damping_is_waited_for():
    """A linear rig (attached, elastic): at ten times f0 it decays by e^-0.01 a cycle."""
    rig = vi.from_dimensionless(30.0, 0.0, 0.0, 0.01)
    assert in_map(rig) == "S5"
    assert vi.classify_scenario(vi.Rig(*rig)).scenario == "S5"


def test_too_short_a_wait_names_nothing():
    rig = vi.from_dimensionless(25.9, 0.5, 0.01, 0.15)
    assert vi.classify_scenario(vi.Rig(*rig), max_cycles=1).scenario == "unclassified"


@pytest.mark.parametrize(("low", "high"), [(0.4, 1.2), (0.3, 0.69), (2.5, 4.0)])
def test_a_range_without_the_resonance_names_nothing(low, high):
    rig = vi.from_dimensionless(25.9, 0.5, 0.01, 0.15)
    held = np.arange(low, high, 0.01) * rig.oscillator.natural_frequency
    found = vi.classify_scenario(vi.Rig(*rig), held)
    assert found.scenario == "unclassified"
    assert "beyond the frequencies swept" in found.evidence or "no contact" in found.evidence


@pytest.mark.parametrize("given", [{"extent": 1}, 3])
def test_thresholds_that_are_none_are_refused(given):
    rig = vi.from_dimensionless(25.9, 0.5, 0.01, 0.15)
    with pytest.raises(vi.InputError, match=r"thresholds: .* a Thresholds, or None, is accepted"):
        vi.classify_scenario(vi.Rig(*rig), thresholds=given)


def test_a_verdict_is_shown_in_short():
    found = vi.classify_scenario("B2-G1-A3")
    assert len(repr(found)) < 500
    assert repr(found).startswith("Classification(scenario='S3', confidence=")
    page = found._repr_html_()
    for text in (found.scenario, f"{found.confidence:.0%}", "right hysteresis"):
        assert text in page
    assert "array" not in page
