"""Scenarios of rigs at the limits of the model."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from vibroimpact.scenario import store
from vibroimpact.scenario.cell import classified
from vibroimpact.scenario.kinds import Scenario
from vibroimpact.scenario.thresholds import Thresholds


def in_map(rig: vi.Rig) -> str:
    return Scenario(int(classified([rig], Thresholds(), 0.01, None)["scenario"][0])).label


def test_a_far_stop_that_is_never_reached_changes_nothing():
    """The range must reach the resonance of the near one alone."""
    near = vi.from_dimensionless(25.9, 0.0, 0.01, 0.15)
    gap = 5.0 * vi.from_dimensionless(25.9, 1.0, 0.01, 0.15).oscillator.right.gap
    far = near.oscillator.left.replace(gap=gap)
    both = vi.classify(near.oscillator.replace(left=far), near.amplitude)
    alone = vi.classify(near.oscillator.replace(left=None), near.amplitude)
    assert both.scenario == alone.scenario
    assert both.features.within
    assert both.features.swept == alone.features.swept


def test_light_damping_is_waited_for():
    """A linear rig (attached, elastic): at ten times f0 it decays by e^-0.01 a cycle."""
    rig = vi.from_dimensionless(30.0, 0.0, 0.0, 0.01)
    assert in_map(rig) == "S5"
    assert vi.classify(*rig).scenario == "S5"


@pytest.mark.parametrize("stiffness", ["60kN/m", "75kN/m"])
def test_maps_follow_the_branch_where_a_jump_may_hide(stiffness):
    case = vi.laboratory.case(f"{stiffness}-G3-A1")
    rig = vi.Rig(case.oscillator, case.amplitude)
    assert in_map(rig) == vi.classify(*rig).scenario
    assert in_map(rig) == {"60kN/m": "S6", "75kN/m": "S2"}[stiffness]


def test_too_short_a_wait_names_nothing():
    rig = vi.from_dimensionless(25.9, 0.5, 0.01, 0.15)
    assert vi.classify(*rig, max_cycles=1).scenario == "unclassified"


@pytest.mark.parametrize(("low", "high"), [(0.4, 1.2), (0.3, 0.69), (2.5, 4.0)])
def test_a_range_without_the_resonance_names_nothing(low, high):
    rig = vi.from_dimensionless(25.9, 0.5, 0.01, 0.15)
    held = np.arange(low, high, 0.01) * rig.oscillator.natural_frequency
    found = vi.classify(*rig, held)
    assert found.scenario == "unclassified"
    assert "beyond the frequencies swept" in found.evidence or "no contact" in found.evidence


@settings(max_examples=8, deadline=None)
@given(
    ratios=st.tuples(st.floats(0.5, 60.0), st.floats(0.5, 60.0)),
    gaps=st.tuples(st.floats(0.1, 1.2), st.floats(0.1, 1.2)),
    damping=st.floats(0.05, 0.3),
    scale=st.floats(1e-3, 1e3),
)
def test_mirror_and_scale(ratios, gaps, damping, scale):
    rig = vi.from_dimensionless(ratios, gaps, 0.01, damping)
    named = in_map(rig)
    if {named, in_map(vi.Rig(rig.oscillator.mirrored(), rig.amplitude))} == {"S2", "S6"}:
        # Beside a cusp: two folds closer than a step along the branch may be passed unseen.
        both = [vi.classify(o, rig.amplitude) for o in (rig.oscillator, rig.oscillator.mirrored())]
        (folds,) = [one.features.folds for one in both if one.features.folds]
        assert np.ptp(folds[-2:]) < 1e-3 * rig.oscillator.natural_frequency
        return
    assert in_map(vi.Rig(rig.oscillator.mirrored(), rig.amplitude)) == named
    other = vi.to_dimensionless(*rig).to_physical(
        mass=scale, stiffness=scale**2, amplitude=1.0 / scale
    )
    assert in_map(other) == named


def test_a_store_of_another_version_is_refused(tmp_path, monkeypatch):
    axes = ("stiffness_ratio", [1.0, 2.0]), ("gap_ratio", [0.5, 0.6])
    vi.scenario_map(*axes, step=0.05, store=tmp_path / "map")
    monkeypatch.setattr(store, "__version__", "99.0")
    with pytest.raises(vi.InputError, match="vibroimpact_version differ"):
        vi.scenario_map(*axes, step=0.05, store=tmp_path / "map")


@pytest.mark.parametrize("given", [{"extent": 1}, 3])
def test_thresholds_that_are_none_are_refused(given):
    rig = vi.from_dimensionless(25.9, 0.5, 0.01, 0.15)
    with pytest.raises(vi.InputError, match=r"thresholds: .* a Thresholds, or None, is accepted"):
        vi.classify(*rig, thresholds=given)


def test_a_verdict_is_shown_in_short():
    found = vi.classify("B2-G1-A3")
    assert len(repr(found)) < 500
    assert repr(found).startswith("Classification(scenario='S3', confidence=")
    page = found._repr_html_()
    for text in (found.scenario, f"{found.confidence:.0%}", "right hysteresis"):
        assert text in page
    assert "array" not in page
