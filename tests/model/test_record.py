"""Measured motions of the base: what they are, what can be differentiated, what is refused."""

from __future__ import annotations

import math

import numpy as np
import pint
import pytest

import vibroimpact as vi

TIME = np.arange(401) * 0.01


def test_straight_lines_between_samples_and_nothing_outside():
    record = vi.Record([1.0, 3.0, -1.0], "500 ms")
    assert record.duration == 1.0
    assert record.peak == 3.0
    np.testing.assert_array_equal(record.time, [0.0, 0.5, 1.0])
    np.testing.assert_allclose(
        record.at([-0.1, 0.0, 0.25, 0.5, 0.875, 1.0, 1.1]), [0, 1, 2, 3, 0, -1, 0]
    )


def test_nobody_can_change_it():
    values = np.array([1.0, 2.0])
    record = vi.Record(values, 0.1)
    values[0] = 5.0
    assert record.acceleration[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        record.acceleration[0] = 2.0
    with pytest.raises(AttributeError):
        record.step = 0.2


def test_equal_by_value():
    one = vi.Record([1.0, 2.0], 0.1)
    assert one == vi.Record([1.0, 2.0], "100 ms")
    assert hash(one) == hash(vi.Record([1.0, 2.0], 0.1))
    assert one != vi.Record([1.0, 2.0], 0.2)
    assert one != vi.Record([1.0, 2.5], 0.1)
    assert one != "record"


def test_quantities():
    quantity = pint.UnitRegistry().Quantity([1.0, -2.0], "g_0")
    record = vi.Record(quantity, 0.1)
    np.testing.assert_allclose(record.acceleration, [9.80665, -19.6133])


def test_it_tells_what_it_is_in_one_line():
    record = vi.Record(np.zeros(5000), 0.01)
    assert str(record) == "Record(samples=5000, step=10 ms, peak=0 m/s²)"
    assert "\n" not in repr(record)
    assert "5000" in record._repr_html_()


@pytest.mark.parametrize(
    ("samples", "step", "line"),
    [
        (
            [1.0, math.nan, 2.0],
            0.1,
            r"acceleration\[1\]: nan is not finite; replace it by a finite",
        ),
        ([1.0, 2.0, -math.inf], 0.1, r"acceleration\[2\]: -inf is not finite"),
        ([1.0], 0.1, r"acceleration: 1 given; pass one sequence of at least 2 samples in m/s²"),
        ([], 0.1, r"acceleration: 0 given; pass one sequence of at least 2 samples"),
        (
            [[1.0, 2.0], [3.0, 4.0]],
            0.1,
            r"acceleration: shape \(2, 2\); pass one sequence of at least 2",
        ),
        (5.0, 0.1, r"acceleration: .*at least 2 samples"),
        ("a.csv", 0.1, r"acceleration: 'a.csv' is not a list of numbers"),
        (None, 0.1, r"acceleration: .*"),
        ([1.0, "x"], 0.1, r"acceleration: .* is not a list of numbers"),
        ([1.0, 2.0], 0.0, r"step: 0.0 is less than 1e-12"),
        ([1.0, 2.0], -0.1, r"step: -0.1 is less than 1e-12"),
        ([1.0, 2.0], math.nan, r"step: .*"),
        ([1.0, 2.0], "1 m", r"step: .*"),
        ([1.0, 2.0], None, r"step: .*"),
    ],
)
def test_refused(samples, step, line):
    with pytest.raises(vi.InputError, match=f"^{line}") as refused:
        vi.Record(samples, step)
    assert "\n" not in str(refused.value)


def test_samples_of_another_quantity_are_refused():
    with pytest.raises(vi.InputError, match=r"^acceleration: "):
        vi.Record(pint.UnitRegistry().Quantity([1.0, 2.0], "mm"), 0.1)


def test_a_displacement_is_differentiated_twice():
    """The error is of the second order of the step: a sine's is ω⁴ h²/12 X in the middle."""
    errors = []
    for count in (200, 400, 800):
        t = np.linspace(0.0, 4.0, count + 1)
        record = vi.Record.from_displacement(0.02 * np.sin(5.0 * t), 4.0 / count)
        exact = -0.02 * 25.0 * np.sin(5.0 * t)
        errors.append(np.abs(record.acceleration - exact)[20:-20].max())
    assert errors[0] == pytest.approx(0.02 * 5.0**4 * 0.02**2 / 12, rel=0.02)
    np.testing.assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 2.0, atol=0.02)


def test_a_cubic_is_differentiated_exactly():
    t = np.arange(20) * 0.1
    record = vi.Record.from_displacement(0.3 - t + 2 * t**2 - t**3, 0.1)
    np.testing.assert_allclose(record.acceleration, 4 - 6 * t, atol=1e-10)


def test_moved_by_a_displacement_as_by_its_acceleration():
    """Relative to a base whose acceleration is -X ω² sin ωt."""
    rig = vi.Oscillator(2.0, vi.Isolator(8.0, 0.8), vi.RigidStop(0.5, 0.02))
    moved = vi.Harmonic("20 mm", 0.5)
    record = vi.Record.from_displacement(0.02 * np.sin(math.pi * TIME), 0.01)
    one = vi.simulate(vi.Rig(rig, record), samples=0)["final_state"].values[:2]
    other = vi.simulate(vi.Rig(rig, moved), 2, samples=0)["final_state"].values[:2]
    np.testing.assert_allclose(one, other, atol=1e-5)


ROUGH = r"displacement\[\d+\]: the displacement jumps or is too rough"


@pytest.mark.parametrize(
    ("values", "line"),
    [
        (
            np.where(TIME < 2.0, 0.0, 0.01),
            ROUGH,
        ),
        (
            0.01 * (-1.0) ** np.arange(401),
            r"displacement\[\d+\]: the displacement jumps or is too rough",
        ),
        (
            np.random.default_rng(1).normal(size=401),
            r"displacement\[\d+\]: the displacement jumps or is too",
        ),
        (np.sin(TIME)[:7], r"displacement: 7 given; pass one sequence of at least 8 samples in m"),
        (np.where(TIME == 1.0, np.nan, TIME), r"displacement\[100\]: nan is not finite"),
    ],
)
def test_what_cannot_be_differentiated_is_refused(values, line):
    with pytest.raises(vi.InputError, match=f"^{line}") as refused:
        vi.Record.from_displacement(values, 0.01)
    assert "\n" not in str(refused.value)


def test_scaled_cut_and_levelled_say_so():
    record = vi.Record([0.0, 1.0, -4.0, 2.0, 1.0], 0.5)
    assert record.about.notes == ()
    assert record.peak_time == 1.0
    double = record.scaled(-2)
    np.testing.assert_array_equal(double.acceleration, [0.0, -2.0, 8.0, -4.0, -2.0])
    assert record.scaled(peak="0.5 g").peak == pytest.approx(4.903325)
    part = double.cut("0.6 s", 1.5)
    np.testing.assert_array_equal(part.acceleration, [-2.0, 8.0, -4.0])
    assert part.about.notes == ("scaled by -2", "cut to the part from 0.5 to 1.5 s")
    np.testing.assert_array_equal(record.cut().acceleration, record.acceleration)
    level = record.levelled()
    np.testing.assert_allclose(level.acceleration, record.acceleration, atol=1e-15)
    tilted = vi.Record(record.acceleration + 3.0 - 2.0 * record.time, 0.5).levelled("line")
    np.testing.assert_allclose(
        tilted.acceleration, record.levelled("line").acceleration, atol=1e-14
    )
    (note,) = tilted.about.notes
    assert note == "line subtracted: 2.4 m/s² at the beginning and -0.4 m/s² at the end"
    assert ("notes", note) in tilted.rows()


@pytest.mark.parametrize(
    ("change", "line"),
    [
        (lambda r: r.scaled(0), "scale: 0; use a number other than 0"),
        (lambda r: r.scaled(2, peak=1), "peak: 1 is given together with scale = 2;"),
        (lambda r: r.scaled(peak="-1 g"), "peak: '-1 g' is not greater than 0"),
        (lambda r: vi.Record([0, 0], 1).scaled(peak=1), "peak: 1 cannot be reached"),
        (lambda r: r.cut(2, 1), "end: 1 s leaves fewer than 2 samples after the start, 2 s"),
        (lambda r: r.cut(0, 99), "end: 99 is greater than 2.25"),
        (lambda r: r.cut(-1), "start: -1 is less than 0"),
        (lambda r: r.levelled("parabola"), "baseline: 'parabola'; use 'mean' or 'line'"),
    ],
)
def test_changes_that_cannot_be_made(change, line):
    with pytest.raises(vi.InputError) as refused:
        change(vi.Record([0.0, 1.0, -4.0, 2.0, 1.0], 0.5))
    assert str(refused.value).startswith(line)
