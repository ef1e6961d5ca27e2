"""Numbers that count something."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.model.argument_types import share, whole


@pytest.mark.parametrize("value", [3, np.int64(3), np.uint8(3)])
def test_whole_numbers(value):
    assert whole(value, "n") == 3
    assert type(whole(value, "n")) is int


@pytest.mark.parametrize("value", [True, np.True_, 1.0, "3", None, 0, -1, np.float64(3)])
def test_what_is_no_whole_number(value):
    with pytest.raises(vi.InputError, match=r"n: .*; pass a whole number of at least 1"):
        whole(value, "n")


def test_shares():
    assert share("1e-9", "x") == 1e-9
    for wrong in (0.0, 1.0, 2, -1e-3, "a", None, float("nan")):
        with pytest.raises(vi.InputError, match="x"):
            share(wrong, "x")


def test_where_they_are_used():
    """numpy's whole numbers go in, and into a file; a text for a tolerance is refused in words."""
    case = vi.laboratory.case("B2-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 2.0)
    data = vi.simulate(vi.Rig(case.oscillator, shaken), np.int64(3), samples=np.int32(8))
    assert data.sizes["time"] == 25
    swept = vi.sweep(
        vi.Rig(case.oscillator, case.amplitude), [2.0], max_cycles=np.int64(50), threads=np.int8(1)
    )
    assert '"max_cycles": 50' in swept.attrs["parameters"]
    with pytest.raises(vi.InputError, match="tolerance: 'a'"):
        vi.sweep(vi.Rig(case.oscillator, case.amplitude), [2.0], tolerance="a")
    with pytest.raises(vi.InputError, match="max_cycles: True"):
        vi.sweep(vi.Rig(case.oscillator, case.amplitude), [2.0], max_cycles=True)
    state = data["final_state"].isel(component=slice(0, 4))
    vi.simulate(vi.Rig(case.oscillator, shaken), 1, state)
