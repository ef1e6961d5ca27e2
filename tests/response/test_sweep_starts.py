"""Where a forward and a backward sweep arrive at a frequency."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.response.sweep_starts import arrivals

CASE = vi.laboratory.case("B2-G1-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 2.0, 0.4)


def test_from_below_on_the_large_motion_from_above_on_the_small_one():
    starts = arrivals(vi.Rig(CASE.oscillator, SHAKEN))
    assert list(starts) == ["forward branch", "backward branch"]
    motions = [vi.steady(vi.Rig(CASE.oscillator, SHAKEN), start, 8) for start in starts.values()]
    assert [int(motion["impacts"].sel(stop="right")) for motion in motions] == [1, 0]
    assert {start.phase for start in starts.values()} == {0.4}


def test_the_frequencies_that_are_given():
    """It is the end of the hold before the frequency; a way without any is left out."""
    starts = arrivals(vi.Rig(CASE.oscillator, SHAKEN), [1.5, 1.9, 2.0])
    assert list(starts) == ["forward branch"]
    held = vi.sweep(vi.Rig(CASE.oscillator, CASE.amplitude), [1.5, 1.9], "forward", phase=0.4)
    last = held["section"].isel(direction=0, frequency=-1)
    state = starts["forward branch"]
    np.testing.assert_array_equal(last[:2], [state.displacement, state.velocity])
    with pytest.raises(vi.InputError, match="frequencies"):
        arrivals(vi.Rig(CASE.oscillator, SHAKEN), [])
