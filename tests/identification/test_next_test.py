"""What to test next."""

from __future__ import annotations

import re

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.identification.next_test import _first_least


def test_a_tie_is_not_broken_by_rounding():
    """Of candidates that only rounding parts the first one is taken, whatever the processor."""
    values = np.full((2, 2, 3), np.nan)
    values[0, 0, 1], values[0, 1, 1], values[1, 0, 2] = 0.25, 0.25 * (1.0 - 1e-12), 0.3
    assert _first_least(values) == (0, 0, 1)
    assert _first_least(-values) == (1, 0, 2)
    values[1, 1, 0] = 0.24
    assert _first_least(values) == (1, 1, 0)


STOPPED = vi.Oscillator(3, vi.Isolator(2, 0.3), vi.Bumper(40, 1, 0.7), units="none")


@pytest.mark.parametrize("of", ["acceleration", "force"])
@pytest.mark.parametrize("units", ["none", "SI"])
def test_the_next_test_has_the_units_of_the_rig(of, units):
    rig = vi.Rig(STOPPED.replace(units=units), vi.Harmonic(0.9, 0.1, of=of))
    swept = vi.sweep(rig, np.linspace(0.08, 0.2, 9))
    fit = vi.identify(rig, swept, ["isolator.damping"], starts=1)
    data = vi.next_test(fit, [0.1, 0.15])
    bare = units == "none"
    assert (
        fit.attrs.get("unit_system") == data.attrs.get("unit_system") == ("none" if bare else None)
    )
    size = {"acceleration": "m s-2", "force": "N"}[of]
    assert data["candidate_amplitude"].attrs["units"] == ("1" if bare else size)
    assert data["frequency"].attrs["units"] == ("1" if bare else "Hz")
    name = {"acceleration": "base acceleration", "force": "force on the mass"}[of]
    assert name in data["candidate_amplitude"].attrs["long_name"]
    sizes = {"none": r"\)?, [\d.]+, would", "acceleration": r" (?:m?g|m/s²), ", "force": " N, "}
    assert re.search(sizes["none" if bare else of], data.attrs["findings"])
    assert bare == ("Hz" not in data.attrs["findings"])
    if bare:
        with pytest.raises(vi.InputError, match="has a unit, but the rig has none"):
            vi.next_test(fit, [0.1], ["0.5 m/s^2"])
