"""Records read from columns of numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.records.columns import read_columns


def written(tmp_path, text: str):
    path = tmp_path / "record.csv"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("text", "step"),
    [
        ("1\n2\n-3\n", 0.1),
        ("# one\n\n1 # first\n2\n-3", "100 ms"),
        ("time,a\n0.0,1\n0.1,2\n0.2,-3\n", None),
        ("time;a\r\n5.0;1\r\n5.1;2\r\n5.2;-3\r\n", None),
        ("\ufefft\ta\n0 1\n0.1\t2\n0.2 -3\n", None),
        ("0, 0.1, 0.2\n1, 2, -3\n", None),
    ],
)
def test_all_say_the_same(tmp_path, text, step):
    record = read_columns(written(tmp_path, text), step)
    np.testing.assert_array_equal(record.acceleration, [1.0, 2.0, -3.0])
    assert record.step == pytest.approx(0.1, rel=1e-12)


def test_units(tmp_path):
    path = written(tmp_path, "0.1\n-0.2\n0.3\n")
    np.testing.assert_allclose(
        read_columns(path, 0.1, "g").acceleration, [0.980665, -1.96133, 2.941995]
    )
    time = np.arange(50) * 0.02
    rows = "\n".join(f"{t!r},{20 * math.sin(3 * t)!r}" for t in time.tolist())
    moved = read_columns(written(tmp_path, rows), None, "mm")
    expected = vi.Record.from_displacement(0.02 * np.sin(3 * time), 0.02)
    np.testing.assert_allclose(moved.acceleration, expected.acceleration, atol=1e-10)


@pytest.mark.parametrize(
    ("text", "step", "unit", "line"),
    [
        ("1\nnan\n2\n", 0.1, "m/s^2", r".*acceleration\[1\]: nan is not finite"),
        ("1\n", 0.1, "m/s^2", r".*acceleration: 1; at least 2"),
        ("", 0.1, "m/s^2", r"record: .* has no numbers"),
        ("words only\n", 0.1, "m/s^2", r"record: .* has no numbers"),
        ("1\n2\n", None, "m/s^2", r"step: missing, and .* has no times"),
        ("0,1\n0.1,2\n", 0.1, "m/s^2", r"step: 0.1, but .* has times of its own"),
        ("1\n2\n", 0.0, "m/s^2", r"step: .*greater than 0"),
        ("1\n2\nend\n", 0.1, "m/s^2", r"record: .*, line 3: 'end' is no row of numbers"),
        ("1,2,3\n4,5,6\n7,8,9\n", None, "m/s^2", r"record: .* has rows of \[3\] numbers"),
        ("1,2\n3\n", None, "m/s^2", r"record: .* has rows of \[1, 2\] numbers"),
        ("0,1\n0.1,2\n0.5,3\n", None, "m/s^2", r"record: .*, sample 1: .* not evenly spaced"),
        ("0,1\n-0.1,2\n-0.2,3\n", None, "m/s^2", r"record: .*not evenly spaced"),
        ("0,1\n0,2\n0,3\n", None, "m/s^2", r"record: .*not evenly spaced"),
        ("1\n2\n", 0.1, "N", r"unit: .*"),
        ("1\n2\n", 0.1, "nonsense", r"unit: .*"),
        ("0\n0\n0\n0\n0\n1\n1\n1\n1\n1\n", 0.1, "mm", r".*displacement\[\d\]: it jumps"),
    ],
)
def test_refused_in_one_line(tmp_path, text, step, unit, line):
    with pytest.raises(vi.InputError, match=f"^{line}") as refused:
        read_columns(written(tmp_path, text), step, unit)
    assert "\n" not in str(refused.value)


def test_what_is_no_text_file(tmp_path):
    with pytest.raises(vi.InputError, match=r"^record: .* cannot be read \(No such file"):
        read_columns(tmp_path / "missing.csv", 0.1)
    path = tmp_path / "binary.dat"
    path.write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(vi.InputError, match=r"^record: .* is not text"):
        read_columns(path, 0.1)
