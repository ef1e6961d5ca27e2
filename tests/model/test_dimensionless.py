"""Physical parameters to dimensionless ones and back."""

import doctest
import math
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vibroimpact.errors import InputError
from vibroimpact.model import (
    Bumper,
    Dimensionless,
    DimensionlessBumper,
    DimensionlessRigidStop,
    Isolator,
    Oscillator,
    RigidStop,
    dimensionless,
    from_dimensionless,
    peak_displacement,
    to_dimensionless,
)
from vibroimpact.model.rig import Rig

ROUNDING = 1e-14

scale = st.floats(min_value=1e-4, max_value=1e6)
ratio = st.floats(min_value=1e-5, max_value=1e5)
not_negative = st.floats(min_value=0.0, max_value=1e3)
peaked = st.floats(min_value=1e-6, max_value=0.7)
sides = st.none() | st.builds(DimensionlessBumper, ratio, not_negative, not_negative)


def near(value):
    return pytest.approx(value, rel=ROUNDING, abs=1e-300)


def same_side(one, other):
    if one is None or other is None:
        return one is other
    return all(value == near(getattr(other, name)) for name, value in one)


def test_definitions():
    made = from_dimensionless(20.0, 0.5, 0.01, 0.15)
    oscillator, amplitude = made.oscillator, made.amplitude
    assert oscillator.isolator == Isolator(1.0, 0.3)
    assert oscillator.damping_ratio == 0.15
    assert oscillator.angular_frequency == 1.0
    assert amplitude == 1.0
    peak = 1.0 / (2.0 * 0.15 * math.sqrt(1.0 - 0.15**2))
    assert oscillator.right == Bumper(20.0, 0.2, 0.5 * peak)
    assert oscillator.left == oscillator.right


def test_the_peak_is_the_top_of_the_free_amplification_curve():
    oscillator = Oscillator(550.0, Isolator(26290.0, 1140.0))
    k, c, m = 26290.0, 1140.0, 550.0
    omega = np.linspace(0.1, 30.0, 2_000_001)
    response = 0.5 * m / np.hypot(k - m * omega**2, c * omega)
    assert peak_displacement(oscillator, 0.5) == pytest.approx(response.max(), rel=1e-9)
    assert peak_displacement(oscillator, 0.5) >= response.max() * (1.0 - 1e-15)


def test_sides_may_differ_or_be_absent():
    rig = from_dimensionless((20.0, 5.0), (0.5, 0.2), (0.01, 0.0), 0.15)
    group = to_dimensionless(rig)
    assert same_side(group.right, DimensionlessBumper(20.0, 0.5, 0.01))
    assert same_side(group.left, DimensionlessBumper(5.0, 0.2, 0.0))
    assert from_dimensionless((None, 5.0), 0.5, 0.01, 0.15).oscillator.right is None
    free = from_dimensionless(None, None, None, 0.9).oscillator
    assert free == Oscillator(1.0, Isolator(1.0, 1.8))
    assert from_dimensionless([20, None], 0.5, 0.01, 0.15).oscillator.left is None


def test_scales_may_be_text():
    made = from_dimensionless(
        19.4, 0.22, 0.01, 0.15, mass="550 kg", stiffness="26.29 kN/m", amplitude="0.05 g"
    )
    oscillator, amplitude = made.oscillator, made.amplitude
    assert oscillator.mass == 550.0
    assert oscillator.isolator.stiffness == 26290.0
    assert amplitude == 0.4903325
    assert to_dimensionless(Rig(oscillator, "0.05 g")).right.gap == near(0.22)


def test_a_rig_of_ratios_prints():
    rig = from_dimensionless(20.0, 0.5, 0.01, 0.15)
    assert isinstance(rig, Rig)
    assert rig.amplitude == 1.0
    assert "shaking=" in str(rig)
    assert pickle.loads(pickle.dumps(rig)) == rig
    with pytest.raises(AttributeError):
        rig.amplitude = 2.0


def test_a_group_prints():
    group = Dimensionless(0.15, DimensionlessBumper(20.0, 0.5, 0.01))
    assert str(group) == (
        "Dimensionless(damping_ratio=0.15, right=DimensionlessBumper(stiffness_ratio=20, "
        "gap=0.5, relaxation_time=0.01), left=None)"
    )
    assert eval(repr(group)) == group


@pytest.mark.parametrize("damping_ratio", [0.0, math.sqrt(0.5), 1.0])
def test_without_a_resonance_peak_a_gap_has_no_scale(damping_ratio):
    with pytest.raises(
        InputError, match=r"^damping_ratio: .* use .* greater than 0 and less than 0.707107"
    ):
        from_dimensionless(20.0, 0.5, 0.01, damping_ratio)
    oscillator = Oscillator(1.0, Isolator(1.0, 2.0 * damping_ratio), Bumper(1.0, 0.0, 1.0))
    with pytest.raises(InputError, match=r"^damping_ratio: "):
        to_dimensionless(Rig(oscillator, 1.0))
    with pytest.raises(InputError, match=r"^damping_ratio: "):
        peak_displacement(oscillator, 1.0)


@pytest.mark.parametrize("damping_ratio", [0.0, 1.0])
def test_a_gap_of_zero_needs_no_scale(damping_ratio):
    rig = from_dimensionless(20.0, 0.0, 0.01, damping_ratio)
    assert rig.oscillator.right.gap == 0.0
    assert to_dimensionless(rig).right.gap == 0.0


def test_without_excitation_a_gap_has_no_scale():
    with pytest.raises(InputError, match=r"^amplitude: 0 "):
        from_dimensionless(20.0, 0.5, 0.01, 0.15, amplitude=0.0)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((-1.0, 0.5, 0.01, 0.15), r"^right\.stiffness_ratio: -1.0 is not greater than 0"),
        ((0.0, 0.5, 0.01, 0.15), r"^right\.stiffness_ratio: 0.0 is not greater than 0"),
        (((1.0, 0.0), 0.5, 0.01, 0.15), r"^left\.stiffness_ratio: 0.0 is not greater than 0"),
        ((1.0, "1 m", 0.01, 0.15), r"^right\.gap: '1 m' is a length"),
        ((1.0, 0.5, -0.01, 0.15), r"^right\.relaxation_time: -0.01 is less than 0"),
        ((1.0, 0.5, 0.01, -0.15), r"^damping_ratio: -0.15 is less than 0"),
        ((1.0, 0.5, 0.01, math.nan), r"^damping_ratio: nan is not finite"),
        ((1.0, "5 mm", 0.01, 0.15), r"^right\.gap: '5 mm' is a length; use a dimensionless number"),
        ((1.0, None, 0.01, 0.15), r"^right\.gap: None is not a number"),
        (((1.0, 2.0, 3.0), 0.5, 0.01, 0.15), r"^stiffness_ratio: .* a pair \(right, left\)"),
    ],
)
def test_bad_input(arguments, message):
    with pytest.raises(InputError, match=message):
        from_dimensionless(*arguments)


@pytest.mark.parametrize(
    ("scales", "message"),
    [
        ({"mass": 0.0}, r"^mass: "),
        ({"stiffness": "1 kg"}, r"^stiffness: '1 kg' is a mass"),
        ({"amplitude": -1.0}, r"^amplitude: -1.0 is less than 0"),
        ({"amplitude": 1e300, "stiffness": 1e-30}, r"^amplitude: .* floating-point"),
        (
            {"mass": 1e300, "stiffness": 1e-300},
            r"^mass: 1e\+300 is too large; pass at most 1e\+100",
        ),
    ],
)
def test_bad_scales(scales, message):
    with pytest.raises(InputError, match=message):
        from_dimensionless(20.0, 0.5, 0.01, 0.15, **scales)


@given(peaked, sides, sides, scale, scale, scale)
def test_dimensionless_to_physical_and_back(damping_ratio, right, left, mass, stiffness, amplitude):
    group = Dimensionless(damping_ratio, right, left)
    back = to_dimensionless(group.to_physical(mass=mass, stiffness=stiffness, amplitude=amplitude))
    assert back.damping_ratio == near(damping_ratio)
    assert same_side(back.right, right)
    assert same_side(back.left, left)


@given(
    st.builds(Isolator, scale, st.just(0.0)),
    peaked,
    st.none() | st.builds(Bumper, scale, scale, st.floats(0.0, 1e3)),
    st.none() | st.builds(Bumper, scale, scale, st.floats(0.0, 1e3)),
    scale,
    scale,
)
def test_physical_to_dimensionless_and_back(isolator, xi, right, left, mass, amplitude):
    damping = 2.0 * xi * math.sqrt(isolator.stiffness * mass)
    oscillator = Oscillator(mass, isolator.replace(damping=damping), right, left)
    group = to_dimensionless(Rig(oscillator, amplitude))
    back = group.to_physical(mass=mass, stiffness=isolator.stiffness, amplitude=amplitude)
    assert back.amplitude == amplitude
    assert same_side(back.oscillator.isolator, oscillator.isolator)
    assert same_side(back.oscillator.right, right)
    assert same_side(back.oscillator.left, left)


def test_examples_of_the_docstrings():
    assert doctest.testmod(dimensionless).failed == 0


def test_rigid_stops_and_preloads():
    oscillator = Oscillator(4.0, Isolator(100.0, 2.0), RigidStop(0.7, 0.3), Bumper(50.0, 1.0, -0.1))
    group = to_dimensionless(Rig(oscillator, 2.0))
    peak = peak_displacement(oscillator, 2.0)
    assert group.right == DimensionlessRigidStop(0.7, 0.3 / peak)
    assert group.right.stiffness_ratio == math.inf
    assert group.left.gap == -0.1 / peak
    made = group.to_physical(mass=4.0, stiffness=100.0, amplitude=2.0)
    back, amplitude = made.oscillator, made.amplitude
    assert amplitude == 2.0
    assert same_side(back.right, oscillator.right)
    assert same_side(back.left, oscillator.left)
