"""One node of a map: the scenario of a rig, its mirror image, and the same at another scale."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from scenario.node import in_map


@pytest.mark.parametrize("stiffness", ["60kN/m", "75kN/m"])
def test_maps_follow_the_branch_where_a_jump_may_hide(stiffness):
    case = vi.laboratory.case(f"{stiffness}-G3-A1")
    rig = vi.Rig(case.oscillator, case.amplitude)
    assert in_map(rig) == vi.classify(*rig).scenario
    assert in_map(rig) == {"60kN/m": "S6", "75kN/m": "S2"}[stiffness]


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
