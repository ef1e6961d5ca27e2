"""Axes of maps, and the rigs at their nodes."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.scenarios.axes import NAMES, logarithmic, read_axes, rig_at

CASE = vi.laboratory.case("B2-G1-A3")
SINE = vi.Harmonic(CASE.amplitude, 1.0)
BASE = vi.Rig(CASE.oscillator, SINE)


def test_physical_parameters():
    """A proportional stiffness keeps C_j/K_j, as the paper assumes (Section 7)."""
    rig = rig_at(BASE, {"proportional_stiffness": 680e3, "gap": 9e-3})
    assert rig.sine == SINE
    for side in (rig.oscillator.right, rig.oscillator.left):
        assert side.stiffness == 680e3
        assert side.gap == 9e-3
        ratio = CASE.oscillator.right.damping / CASE.oscillator.right.stiffness
        assert side.damping / side.stiffness == pytest.approx(ratio, rel=1e-14)
    assert rig_at(BASE, {"amplitude": 0.3}) == vi.Rig(CASE.oscillator, vi.Harmonic(0.3, 1.0))


@pytest.mark.parametrize("name", [name for name in NAMES if name != "damping_ratio"])
def test_a_name_means_in_maps_what_it_means_along_branches(name):
    varied = PARAMETERS[name]
    oscillator = CASE.oscillator
    if name == "stops.restitution":
        oscillator = oscillator.replace(left=vi.RigidStop(0.5, oscillator.left.gap))
        assert rig_at(vi.Rig(oscillator, SINE), {name: 0.7}).oscillator.left.restitution == 0.7
        return
    value = 1.3 * varied.read(vi.Rig(oscillator, SINE))
    assert rig_at(vi.Rig(oscillator, SINE), {name: value}) == varied.vary(
        vi.Rig(oscillator, SINE), value
    )


def test_a_stiffness_keeps_the_dashpot_and_a_proportional_one_the_relaxation_time():
    stiffness = 2.0 * CASE.oscillator.right.stiffness
    alone = rig_at(BASE, {"stops.stiffness": stiffness}).oscillator.right
    scaled = rig_at(BASE, {"proportional_stiffness": stiffness}).oscillator.right
    assert alone.stiffness == scaled.stiffness == stiffness
    assert alone.damping == CASE.oscillator.right.damping
    assert scaled.damping == pytest.approx(2.0 * alone.damping, rel=1e-14)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("stiffness_ratio", 3.0),
        ("gap_ratio", 0.7),
        ("relaxation_time", 0.02),
        ("damping_ratio", 0.05),
    ],
)
def test_dimensionless_parameters_one_at_a_time(name, value):
    before = vi.to_dimensionless(vi.Rig(CASE.oscillator, CASE.amplitude))
    rig = rig_at(BASE, {name: value})
    after = vi.to_dimensionless(vi.Rig(rig.oscillator, CASE.amplitude))
    assert rig.oscillator.mass == CASE.oscillator.mass
    assert rig.oscillator.isolator.stiffness == CASE.oscillator.isolator.stiffness
    own = {"gap_ratio": "gap"}.get(name, name)
    for group in ("right", "left"):
        for field in ("stiffness_ratio", "gap", "relaxation_time"):
            expected = value if field == own else getattr(getattr(before, group), field)
            assert getattr(getattr(after, group), field) == pytest.approx(expected, rel=1e-12)
    expected = value if own == "damping_ratio" else before.damping_ratio
    assert after.damping_ratio == pytest.approx(expected, rel=1e-12)


def test_sides_keep_what_is_their_own():
    oscillator = CASE.oscillator.replace(left=None)
    rig = rig_at(vi.Rig(oscillator, SINE), {"gap_ratio": 0.5, "stiffness_ratio": 2.0})
    assert rig.oscillator.left is None
    assert rig.oscillator.right.stiffness == pytest.approx(2.0 * oscillator.isolator.stiffness)


def test_logarithmic_axes_are_refined_geometrically():
    assert logarithmic(np.geomspace(0.5, 100, 9))
    assert logarithmic(np.geomspace(0.5, 100, 9).round(2))
    assert not logarithmic(np.linspace(0.5, 100, 9))
    assert not logarithmic(np.linspace(1.0, 1.02, 9))
    assert not logarithmic(np.linspace(0.0, 1.0, 9))
    x, y = read_axes({"stiffness_ratio": [1.0, 4.0, 16.0], "gap_ratio": [0.0, 0.5, 1.0]}, None)
    np.testing.assert_allclose(x.refined(1).values, [1, 2, 4, 8, 16])
    np.testing.assert_allclose(y.refined(2).values, np.linspace(0, 1, 9))
    # Of two values only the user knows.
    ends = {"damping_ratio": [0.1, 0.2], "stiffness_ratio": [1.0, 100.0]}
    for spacing, middle in (("log", 10.0), ("linear", 50.5)):
        x, y = read_axes(ends, {"stiffness_ratio": spacing})
        assert y.refined(1).values[1] == pytest.approx(middle)
        assert x.refined(1).values[1] == pytest.approx(0.15)


@pytest.mark.parametrize(
    ("name", "values", "message"),
    [
        ("gip", [1, 2], "^vary: 'gip' is unknown; use gap, amplitude"),
        ("gap_rtio", [1, 2], r"^vary: 'gap_rtio' is unknown; did you mean gap_ratio\?"),
        ("gap", "1:2", r"^vary\['gap'\]: '1:2' is not a list; pass a list of values"),
        ("gap", [0.01], r"^vary\['gap'\]: the list has one value; pass at least two values"),
        ("gap", ["3 mm", 7], r"^vary\['gap'\]: '3 mm' has a unit and 7 has none; write both"),
        ("gap", [0.01, 0.01], r"^vary\['gap'\]\[1\]: 10 mm follows 10 mm; sort the values in "),
        ("gap", [-0.01, 0.01], r"^vary\['gap'\]\[0\]"),
        ("stiffness_ratio", [0.0, 1.0], r"^vary\['stiffness_ratio'\]\[0\]"),
        ("gap", [0.01, "2 kg"], r"^vary\['gap'\]\[1\].*is a mass"),
        ("damping_ratio", [0.1, 0.8], r"^vary\['damping_ratio'\]\[1\].*no resonance peak"),
    ],
)
def test_what_cannot_be_an_axis_is_refused(name, values, message):
    other = {"relaxation_time": [0.01, 0.02]}
    for vary in ({name: values, **other}, {**other, name: values}):
        with pytest.raises(vi.InputError, match=message):
            read_axes(vary, None)


@pytest.mark.parametrize(
    ("spacing", "message"),
    [
        ("log", '^spacing: \'log\'; pass a dict of "log" or "linear" by parameter'),
        ({"gap": "cubic"}, r"^spacing\['gap'\]: 'cubic' is unknown; use log or linear"),
        ({"amplitude": "log"}, "^spacing: 'amplitude' is not an axis of this map; use gap or "),
        ({"gpa": "log"}, "^spacing: 'gpa' is unknown; use gap, amplitude"),
        ({"gap": "log"}, r"^vary\['gap'\]\[0\]: 0 is not possible on a logarithmic axis"),
    ],
)
def test_a_spacing_that_cannot_be_is_refused(spacing, message):
    with pytest.raises(vi.InputError, match=message):
        read_axes({"gap": [0.0, 1.0], "damping_ratio": [0.1, 0.2]}, spacing)


def test_text_with_units():
    x, _ = read_axes({"gap": ["5 mm", "0.01 m"], "damping_ratio": [0.1, 0.2]}, None)
    np.testing.assert_allclose(x.values, [5e-3, 10e-3])


@pytest.mark.parametrize(
    ("vary", "message"),
    [
        ({"gap": [0, 1], "gap_ratio": [0, 1]}, "'gap_ratio' varies the same quantity as 'gap'"),
        ({"gap": [0, 1], "stops.gap": [0, 1]}, "'gap' and 'stops.gap' are the same parameter"),
        ({"gap": [0, 1]}, "'gap'; pass a dict of values by parameter, with two parameters, such"),
        ({}, "no parameter; pass a dict"),
        (("gap", [0, 1]), r"\('gap', \[0, 1\]\); pass a dict"),
    ],
)
def test_axes_that_do_not_go_together(vary, message):
    with pytest.raises(vi.InputError, match=f"^vary: {message}"):
        read_axes(vary, None)


def test_a_base_without_bumpers_is_refused():
    with pytest.raises(vi.InputError, match="rig: there is no stop"):
        rig_at(vi.Rig(CASE.oscillator.without_bumpers(), SINE), {"gap": 1e-3})


def test_a_physical_and_a_dimensionless_parameter():
    """The physical ones hold as they are: a gap in mm is no other with another damping."""
    rig = rig_at(BASE, {"gap": 9e-3, "damping_ratio": 0.05})
    assert rig.oscillator.right.gap == rig.oscillator.left.gap == 9e-3
    assert rig.oscillator.damping_ratio == pytest.approx(0.05, rel=1e-12)
    assert rig.oscillator.right.stiffness == pytest.approx(510e3, rel=1e-12)
    rig = rig_at(BASE, {"amplitude": 0.3, "stiffness_ratio": 5.0})
    assert rig.amplitude == 0.3
    assert rig.oscillator.right.gap == CASE.oscillator.right.gap
    ratio = rig.oscillator.right.stiffness / rig.oscillator.isolator.stiffness
    assert ratio == pytest.approx(5.0, rel=1e-12)
    # Here the gap follows the amplitude.
    rig = rig_at(BASE, {"amplitude": 0.3, "gap_ratio": 0.5})
    assert vi.to_dimensionless(vi.Rig(rig.oscillator, 0.3)).right.gap == pytest.approx(
        0.5, rel=1e-12
    )
