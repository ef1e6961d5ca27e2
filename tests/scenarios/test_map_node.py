"""One node of a map: the scenario of a rig, its mirror image, and the same at another scale."""

from __future__ import annotations

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from scenarios.node import in_map
from vibroimpact.scenarios.classify import classify


@pytest.mark.parametrize("stiffness", ["60kN/m", "75kN/m"])
def test_maps_follow_the_branch_where_a_jump_may_hide(stiffness):
    case = vi.laboratory.case(f"{stiffness}-G3-A1")
    rig = vi.Rig(case.oscillator, case.amplitude)
    assert in_map(rig) == classify(rig).scenario
    assert in_map(rig) == {"60kN/m": "S6", "75kN/m": "S2"}[stiffness]


# Beside a cusp, where two folds are closer than a step along the branch.
@example(ratios=(60.0, 1.0), gaps=(0.15375, 1.0), damping=0.1574, scale=2.0)
# What is not regular extends as far as the threshold, to rounding.
@example(ratios=(49.0, 57.0), gaps=(0.654296875, 0.390625), damping=0.265625, scale=232.5)
@settings(max_examples=8)
@given(
    ratios=st.tuples(st.floats(0.5, 60.0), st.floats(0.5, 60.0)),
    gaps=st.tuples(st.floats(0.1, 1.2), st.floats(0.1, 1.2)),
    damping=st.floats(0.05, 0.3),
    scale=st.floats(1e-3, 1e3),
)
def test_mirror_and_scale(ratios, gaps, damping, scale):
    rig = vi.from_dimensionless(ratios, gaps, 0.01, damping)
    named = in_map(rig)
    assert in_map(vi.Rig(rig.oscillator.mirrored(), rig.amplitude)) == named
    other = vi.to_dimensionless(rig).to_physical(
        mass=scale, stiffness=scale**2, amplitude=1.0 / scale
    )
    assert in_map(other) == named
