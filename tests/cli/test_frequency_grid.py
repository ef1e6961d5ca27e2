"""Frequency grids are exact decimals, both ends included."""

from __future__ import annotations

import pytest

from vibroimpact.cli.frequency_grid import (
    default_range,
    default_span,
    frequency_grid,
    list_frequencies,
)
from vibroimpact.cli.options import RigOptions
from vibroimpact.cli.rig import subject
from vibroimpact.cli.study import SweepTable
from vibroimpact.cli.vary import read_one
from vibroimpact.errors import InputError

DEFAULT = (0.5, 5.0, 0.01)


def test_values_are_the_decimals_that_were_meant():
    grid = frequency_grid(0.3, 4.0, 0.01)
    assert len(grid) == 371
    assert grid == tuple(float(f"{0.3 + 0.01 * k:.2f}") for k in range(371))
    assert 0.7 in grid
    assert grid[-1] == 4.0


def test_a_million_steps_without_drift():
    grid = frequency_grid(1.0, 10.0, 0.00001)
    assert grid[123_456] == 2.23456
    assert grid[-1] == 10.0


def test_the_end_is_included_even_off_the_grid():
    assert frequency_grid(0.5, 0.75, 0.1) == (0.5, 0.6, 0.7, 0.75)
    assert frequency_grid(1.0, 1.05, 0.1) == (1.0, 1.05)
    assert frequency_grid(1.0, 1.0, 0.1) == (1.0,)


def test_long_decimals_do_not_double_the_end():
    start = 2.0 / 6.283185307179586
    grid = frequency_grid(start, start + 5 * 0.1, 0.1)
    assert len(grid) == 6


def test_options_come_before_the_study_and_it_before_the_default():
    table = SweepTable.model_validate({"from": "0.4 Hz", "step": "0.2 Hz"})
    assert list_frequencies(None, "1Hz", None, None, table, DEFAULT) == (0.4, 0.6, 0.8, 1.0)
    assert list_frequencies("0.6Hz", "1Hz", None, None, table, DEFAULT) == (0.6, 0.8, 1.0)
    assert list_frequencies(None, None, None, None, None, DEFAULT) == frequency_grid(*DEFAULT)
    listed = SweepTable(frequencies=["1 Hz", 2])
    assert list_frequencies(None, None, None, None, listed, DEFAULT) == (1.0, 2.0)
    assert list_frequencies("1Hz", "1.01Hz", None, None, listed, DEFAULT) == (1.0, 1.01)
    assert list_frequencies(None, None, None, "3Hz, 4", listed, DEFAULT) == ("3Hz", "4")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("0Hz", None, None, None), r"--from: '0Hz' is not greater than 0"),
        ((None, "-1Hz", None, None), r"--to: '-1Hz' is not greater than 0"),
        ((None, None, "nan", None), r"--step: 'nan' is not finite"),
        (("1kg", None, None, None), r"--from: '1kg' is a mass; use a frequency"),
        (("1", "20rad/s", None, None), r"--from, --to: '20rad/s' has a unit and '1' has none"),
        (("6Hz", None, None, None), r"--from: 6 Hz is above --to, 5 Hz"),
        (
            (None, None, "1nHz", None),
            r"--step: 1e-09 Hz makes 4500000001 frequencies, more than 1000000; raise --step",
        ),
        ((None, "4Hz", None, "1Hz"), r"--to: given together with --frequencies"),
    ],
)
def test_what_cannot_be_used(arguments, message):
    with pytest.raises(InputError, match=message):
        list_frequencies(*arguments, None, DEFAULT)


def test_the_default_range_follows_from_the_rig(tmp_path):
    for code in ("B2-G1-A3", "B2-G1-A1", "B3-0mm-A2"):
        assert default_range(subject(code, RigOptions())) == (0.5, 5.0, 0.01)
    # A case that has become another rig has a range of its own.
    assert default_range(subject("B2-G1-A3", RigOptions(values=("mass=55 kg",)))) == (
        1.6,
        16.0,
        0.05,
    )
    path = tmp_path / "building.toml"
    path.write_text(
        '[oscillator]\nmass = "1000 t"\n'
        'isolator = { stiffness = 6316547, damping = "500 kN s/m" }\n'
        '[excitation]\namplitude = "0.3 m/s^2"\n'
    )
    building = subject(str(path), RigOptions())
    assert building.oscillator.natural_frequency == pytest.approx(0.4, rel=1e-4)
    assert default_range(building) == (0.18, 1.8, 0.005)
    assert default_span(building) == (0.11, 1.8)
    grid = list_frequencies(None, None, None, None, None, default_range(building))
    assert (grid[0], grid[-1], len(grid)) == (0.18, 1.8, 325)
    assert default_span(subject("B2-G1-A3", RigOptions())) == (0.3, 5.0)
    path.write_text('case = "B2-G1-A1"')
    assert default_range(subject(str(path), RigOptions())) == (0.5, 5.0, 0.01)


NO_SPRING = """
[oscillator]
mass = 1.0
isolator = { stiffness = 0, damping = 1.0 }
right = { stiffness = 100, damping = 0, gap = 0 }
left = { stiffness = 100, damping = 0, gap = 0 }
[excitation]
amplitude = 1.0
"""


def test_without_a_natural_frequency_nothing_is_refused_but_the_default(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(NO_SPRING)
    what = subject(str(path), RigOptions())
    assert list_frequencies("1Hz", "2Hz", "1Hz", None, None, default_range(what)) == (1.0, 2.0)
    for missing, options in (
        ("--from", (None, "2Hz", "1Hz")),
        ("--to", ("1Hz", None, "1Hz")),
        ("--step", ("1Hz", "2Hz", None)),
    ):
        with pytest.raises(InputError, match=f"{missing}: missing; the isolator has no stiffness"):
            list_frequencies(*options, None, None, default_range(what))
    assert read_one(what, ("frequency=1Hz:2Hz",)).span == (1.0, 2.0)
    assert read_one(what, ("gap=1mm:2mm",)).span == (0.001, 0.002)
    with pytest.raises(InputError, match="--vary: frequency: missing; the isolator has no stiff"):
        read_one(what, ())
    path.write_text(NO_SPRING + '[sweep]\nfrom = "1 Hz"\nto = "3 Hz"\n')
    assert default_span(subject(str(path), RigOptions())) == (1.0, 3.0)


@pytest.mark.parametrize(
    ("table", "span"),
    [
        ('from = "0.2 Hz"\nto = "2 Hz"', (0.2, 2.0)),
        ('to = "3 Hz"', (0.3, 3.0)),
        ('frequencies = ["2 Hz", "1 Hz", "3 Hz"]', (1.0, 3.0)),
        ('frequencies = ["2 Hz"]', (0.3, 5.0)),
    ],
)
def test_branches_run_over_the_range_of_the_studys_sweep(tmp_path, table, span):
    study = tmp_path / "study.toml"
    study.write_text(f'case = "B2-G1-A3"\n[sweep]\n{table}\n')
    assert default_span(subject(str(study), RigOptions(), None)) == span
