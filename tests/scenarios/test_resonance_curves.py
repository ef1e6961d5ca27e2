"""The curves of a rig: the same from a sweep without a dataset as from one with it."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.errors import InputError
from vibroimpact.response.curve_pair import as_rigs
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.scenarios.resonance_curves import each_curves, holds, swept_alone


@pytest.mark.parametrize("gaps", [(0.1, 0.1), (0.5, 0.1)])
def test_a_sweep_without_a_dataset_shows_the_same(gaps):
    rig = one_sine(vi.from_dimensionless(20.0, gaps, 0.01, 0.15), "rig")
    grid = np.arange(0.5, 2.5, 0.02) * rig.oscillator.natural_frequency
    data = vi.sweep(rig, grid, max_cycles=300, window=100)
    curves, ended = swept_alone(rig, grid, 300, 100, np.zeros(2, dtype=np.int64))
    (from_data,) = each_curves(as_rigs(data))
    assert from_data.uneven.any()
    assert from_data.both.settled.all() == (gaps[0] != gaps[1])
    for one, other in zip((*curves, *curves.both), (*from_data, *from_data.both), strict=True):
        if not hasattr(one, "_fields"):
            np.testing.assert_array_equal(one, other)
    for one, other in zip(ended, holds(data), strict=True):
        np.testing.assert_array_equal(one, other)


def test_a_bumper_that_stays_pressed_is_touched_in_both():
    rig = one_sine(vi.from_dimensionless(20.0, 0.5, 0.01, 0.15), "rig")
    oscillator, shaken = rig.oscillator, rig.sine
    pressed = oscillator.left.replace(gap=-3.0 * oscillator.left.gap)
    rig = one_sine(vi.Rig(oscillator.replace(left=pressed), shaken), "rig")
    grid = np.array([0.5, 0.7]) * oscillator.natural_frequency
    data = vi.sweep(rig, grid, max_cycles=300, window=100)
    assert not data["impacts"].sel(stop="left").any()
    curves, _ = swept_alone(rig, grid, 300, 100, np.zeros(2, dtype=np.int64))
    (from_data,) = each_curves(as_rigs(data))
    assert curves.both.touching.all()
    assert from_data.both.touching.all()


def test_the_end_of_a_hold_is_where_the_mass_goes_on():
    rig = one_sine(vi.from_dimensionless(20.0, 0.3, 0.01, 0.15), "rig")
    grid = np.array([1.2, 1.3]) * rig.oscillator.natural_frequency
    data = vi.sweep(rig, grid)
    first = holds(data).state("backward", 0)
    again = vi.sweep(rig, grid[:1], "backward", start=first)["section"]
    assert first.displacement == pytest.approx(float(again.sel(component="displacement").item()))
    assert first.displacement != holds(data).state("backward", 1).displacement


def test_one_direction_tells_no_hysteresis():
    rig = one_sine(vi.from_dimensionless(20.0, 0.3, 0.01, 0.15), "rig")
    data = vi.sweep(rig, [0.5, 1.0], "forward")
    with pytest.raises(InputError, match="sweep in both directions, 'forward' and 'backward'"):
        list(each_curves(as_rigs(data)))
