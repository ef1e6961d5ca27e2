"""The primary resonance lies within the frequencies that are swept."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.scenarios.classify import classify
from vibroimpact.scenarios.sweep_frequencies import LOW, STEP, frequencies, highest


def sine(*parameters) -> vi.Rig:
    return one_sine(vi.from_dimensionless(*parameters), "rig")


@settings(max_examples=25)
@given(
    ratio=st.floats(0.3, 100.0),
    gap=st.floats(0.05, 1.0),
    time=st.floats(0.0, 0.05),
    damping=st.floats(0.05, 0.3),
    sides=st.sampled_from(["both", "right", "left"]),
)
def test_the_primary_resonance_lies_within(ratio, gap, time, damping, sides):
    pair = {"both": ratio, "right": (ratio, None), "left": (None, ratio)}[sides]
    rig = sine(pair, gap, time, damping)
    held = frequencies(rig, step=0.02)
    data = vi.sweep(rig, held, "forward", max_cycles=500)
    one = data.isel(direction=0)
    touching = one["impacts"].sum("stop").values > 0.0
    # Soft bumpers with small gaps are still hit beyond it.
    assert not touching.any() or int(np.argmax(one["eta_d"].values)) < 0.97 * (len(held) - 1)


def test_grid():
    rig = sine(20.0, 0.5, 0.01, 0.15)
    held = frequencies(rig) / rig.oscillator.natural_frequency
    assert held[0] == pytest.approx(LOW)
    np.testing.assert_allclose(np.diff(held), STEP, rtol=1e-9)
    assert held[-1] == pytest.approx(highest(rig))
    assert highest(rig) % 0.5 == 0.0
    free = rig.oscillator.without_bumpers()
    assert highest(vi.Rig(free, rig.shaking)) == 1.5


def test_bounds():
    """Energy bounds a wide gap, stiffness a narrow one."""
    wide = sine(1e4, 0.5, 0.01, 0.15)
    assert 1.1 * 1.0983 / 0.5 < highest(wide) < 1.1 * 1.0983 / 0.5 + 0.6  # π√(1-ξ²)/(2√2 δ)
    narrow = sine(24.0, 1e-6, 0.01, 0.15)
    assert 5.5 < highest(narrow) < 6.1  # √(1 + λ) = 5


@pytest.mark.parametrize("stops", [True, False])
def test_an_undamped_isolator_is_not_held_at_its_resonance(stops):
    case = vi.laboratory.case("B2-G1-A3")
    rig = case.oscillator.replace(isolator=vi.Isolator(case.oscillator.isolator.stiffness, 0.0))
    rig = rig if stops else rig.without_bumpers()
    ratios = frequencies(one_sine(vi.Rig(rig, case.amplitude))) / rig.natural_frequency
    assert np.abs(ratios - 1.0).min() == pytest.approx(0.005)
    assert np.diff(ratios).min() == pytest.approx(0.005)
    damped = rig.replace(isolator=case.oscillator.isolator)
    there = frequencies(one_sine(vi.Rig(damped, case.amplitude))) / rig.natural_frequency
    assert np.count_nonzero(np.abs(there[: len(ratios)] - ratios[: len(there)]) > 1e-9) == 1
    if not stops:
        assert classify(vi.Rig(rig, case.amplitude)).scenario == "S0"


def test_a_range_of_too_many_frequencies_is_refused():
    rig = vi.Oscillator(550.0, vi.Isolator(1e-12, 0.0), right=vi.Bumper(510e3, 900.0, 0.0075))
    with pytest.raises(vi.InputError, match=r"^stiffness: .* the sweep would have .* frequencies"):
        classify(vi.Rig(rig, 0.5))
