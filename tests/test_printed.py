from __future__ import annotations

import pytest

from printed import same_print

SAME = [
    ("k = 508706 N/m", "k = 508707 N/m"),
    ("at 2.64 Hz, 12.17 mm", "at 2.64 Hz, 12.18 mm"),
    ("9.999 mm", "10.00 mm"),
    ("12.2 mm     forward", "12.21 mm    forward"),
    ("[1.93  0.134]", "[1.93 0.135]"),
    ("-0.0", "0.0"),
    ("1.234e-05", "1.235e-05"),
    ("0.123456789012345", "0.123456789013999"),
    ("1,234,567 N", "1,234,568 N"),
    ("a\n...\nb 1.0", "a\nx\ny\nb 1.1"),
    ("...", "whatever\nis printed"),
    ("a\n...", "a"),
    ("B2-10mm-A3", "B2-10mm-A3"),
]
OTHER = [
    ("k = 508706 N/m", "k = 508708 N/m"),
    ("451 frequencies", "452 frequencies"),
    ("12.17 mm", "12.19 mm"),
    ("12.17 mm", "12.2 mm"),
    ("12.17 mm", "12.17 m"),
    ("12.17 mm", "-12.17 mm"),
    ("12.17 mm", "12.17"),
    ("2 contacts", "2"),
    ("1e-5", "1e-6"),
    ("B2-G1-A3", "B3-G1-A3"),
    ("a\n...\nb", "a\nb\nc"),
    ("a\nb", "a"),
    ("a", "a\nb"),
    ("", "a"),
    ("1.0 2.0", "1.0"),
    ("nan", "1.0"),
]


@pytest.mark.parametrize(("expected", "printed"), SAME)
def test_last_digits_may_differ(expected, printed):
    assert same_print(expected, printed)


@pytest.mark.parametrize(("expected", "printed"), OTHER)
def test_other_differences_are_noticed(expected, printed):
    assert not same_print(expected, printed)
