"""What η is taken over where free flight has no bound, and how it is drawn."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.figures import resonance_curves
from vibroimpact.response.plausibility import UNBOUNDED

STOP = vi.Bumper(30.0, 0.1, 3.0)
WITHOUT = {
    "linear": vi.Isolator(1.0, 0.0),
    "friction": vi.FrictionIsolator(1.0, 0.0, 0.3),
}


@pytest.mark.parametrize("law", WITHOUT.values(), ids=WITHOUT)
def test_a_sweep_says_that_there_is_no_bound_and_draws_physical_units(law):
    oscillator = vi.Oscillator(1.0, law, STOP, units="SI")
    data = vi.sweep(vi.Rig(oscillator, 1.0), np.linspace(0.05, 0.4, 71))
    assert UNBOUNDED in data.attrs["notes"]
    assert "1 m" in data.attrs["notes"]  # A M/K
    axes = resonance_curves(data)
    assert "(g)" in axes[0].get_ylabel()
    largest = max(line for line in data["peak_displacement"].values.ravel())
    assert axes[1].get_ylim()[1] < 2e3 * largest
    assert "eta_a" in resonance_curves(data, physical=False)[0].get_ylabel()


def test_a_damped_one_has_a_bound():
    data = vi.sweep(vi.Rig(vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), STOP), 1.0), [0.1, 0.2])
    assert "notes" not in data.attrs
    assert resonance_curves(data)[0].get_ylabel() == "largest absolute\nacceleration"
    assert "eta_a" in resonance_curves(data, physical=False)[0].get_ylabel()
