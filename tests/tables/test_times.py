"""Times of tables: even, rounded and missing ones, and stamps with dates."""

from __future__ import annotations

from datetime import datetime, timedelta

import numpy as np
import pytest

from vibroimpact.tables.times import (
    counts_samples,
    rises,
    seconds_since_start,
    spacing,
    stamp,
    stated_order,
)


def test_the_step_of_even_rounded_and_broken_times():
    times = 3.0 + 0.01 * np.arange(300)
    assert spacing(times).step == pytest.approx(0.01)
    assert spacing(times).is_exact
    rounded = np.round(np.arange(300) / 128, 3)
    assert spacing(rounded).step == pytest.approx(1 / 128, rel=1e-4)
    assert not spacing(rounded).is_exact
    assert spacing(np.delete(times, 40)).step is None
    assert spacing(times[::-1]).step is None


def test_what_can_be_times():
    swing = np.sin(0.1 * np.arange(300))
    assert rises(np.arange(300.0))
    assert rises(np.repeat(np.arange(100.0), 3))  # rounded
    assert not rises(swing)
    assert not rises(np.zeros(300))
    assert not rises(np.array([0.0, np.nan, 1.0]))
    assert counts_samples(np.arange(1.0, 50.0))
    assert not counts_samples(0.5 * np.arange(50.0))


FORMATS = [
    "%Y-%m-%dT%H:%M:%S.%f", "%Y-%m-%d %H:%M:%S,%f", "%Y/%m/%d-%H:%M:%S.%f", "%d.%m.%Y %H:%M:%S.%f",
    "%d/%m/%Y %H:%M:%S.%f", "%m/%d/%Y %I:%M:%S.%f %p", "%d.%m.%y %H:%M:%S.%f", "%H:%M:%S.%f",
    "%Y-%m-%dT%H:%M:%S.%fZ", "%Y-%m-%dT%H:%M:%S.%f+02:00", "%d-%b-%Y %H:%M:%S.%f",
    "%d %B %Y %H:%M:%S.%f", "%b %d, %Y %H:%M:%S.%f", "%Y%m%dT%H%M%S.%f", "%Y%m%dT%H%M%SZ",
]  # fmt: skip


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize(
    "start",
    [
        (2024, 5, 4, 11, 59, 59),
        (2024, 5, 4, 23, 59, 58),
        (2024, 5, 31, 23, 59, 58),
        (2023, 12, 31, 23, 59, 58),
    ],
)
def test_stamps_across_midnights_months_and_years(form, start):
    steps = 0.005 * np.arange(900)
    if "%f" not in form:
        steps = np.arange(900.0)
    at = [datetime(*start) + timedelta(seconds=round(float(one), 3)) for one in steps]
    stamps = [stamp(one.strftime(form)) for one in at]
    assert all(stamps)
    np.testing.assert_allclose(seconds_since_start(stamps), steps, atol=1e-9)


def test_the_order_of_a_date_is_the_one_that_is_stated_or_even():
    days = [stamp(f"0{day}/06/2024 00:00:00") for day in (1, 2, 3, 4)]
    np.testing.assert_array_equal(seconds_since_start(days), 86400.0 * np.arange(4))
    months = seconds_since_start(days, "mdy")
    np.testing.assert_array_equal(np.round(months / 86400.0), [0, 31, 60, 91])
    assert stated_order(["Timestamp (dd/mm/yyyy hh:mm:ss)"]) == "dmy"
    assert stated_order(["MM-DD-YYYY"]) == "mdy"
    assert stated_order(["Time"]) is None
    assert seconds_since_start([stamp("31/31/2024 00:00:00")] * 2) is None


def test_minutes_and_seconds_need_a_fraction():
    stamps = [stamp(f"{59 + i // 60}:{i % 60:02d}.5") for i in range(120)]
    np.testing.assert_array_equal(seconds_since_start(stamps), np.arange(120.0))


@pytest.mark.parametrize("text", ["1.234", "20.5.3", "1-2-3", "25:00:00", "12:00", "-1.5", "X", ""])
def test_what_is_no_stamp(text):
    assert stamp(text) is None
