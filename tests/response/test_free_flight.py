"""Steady free flight in closed form, and what η is taken over."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.response.free_flight import (
    check_bounded,
    free_flight_excursions,
    reference_excursions,
)


def rig(ratio: float) -> vi.Oscillator:
    return vi.Oscillator(3.0, vi.Isolator(12.0, 2.0 * ratio * 6.0))


def test_it_is_where_a_simulation_settles():
    one = vi.steady(rig(0.1), vi.Harmonic(0.7, 0.5), samples=8)
    found = free_flight_excursions(rig(0.1), vi.Harmonic(0.7, 1.0), np.array([0.5]))
    assert float(one["displacement_excursion"]) == pytest.approx(found[0][0], rel=1e-11)
    assert float(one["acceleration_excursion"]) == pytest.approx(found[1][0], rel=1e-11)


@pytest.mark.parametrize("ratio", [1e-3, 0.15, 0.5, 0.70, 0.72, 1.0, 5.0])
def test_the_reference_is_the_largest_at_any_frequency(ratio):
    """Found on a fine grid; from 1/√2 on the displacement's is the limit at low frequencies."""
    natural = rig(ratio).natural_frequency
    near = 1.0 + np.linspace(-5.0, 5.0, 20_001) * min(ratio, 0.1)
    grid = natural * np.concatenate([np.geomspace(1e-6, 20.0, 20_000), near[near > 0.0]])
    most = [
        values.max() for values in free_flight_excursions(rig(ratio), vi.Harmonic(0.7, 1.0), grid)
    ]
    reference = reference_excursions(rig(ratio), vi.Harmonic(0.7, 1.0))
    np.testing.assert_allclose(most, reference, rtol=1e-6)
    assert (np.array(most) <= np.array(reference) * (1 + 1e-12)).all()


def test_an_undamped_isolator_has_no_largest():
    still = vi.Oscillator(1.0, vi.Isolator(4.0, 0.0))
    assert reference_excursions(still, vi.Harmonic(0.7, 1.0)) == (0.35, 1.4)


def test_unbounded_motions_are_refused():
    free = rig(0.0)
    with pytest.raises(vi.InputError, match=r"frequency: .* grows without bound"):
        check_bounded(free, vi.Harmonic(1.0, free.natural_frequency))
    with pytest.raises(vi.InputError, match=r"frequencies\[1\]: .* grows without bound"):
        free_flight_excursions(free, vi.Harmonic(1.0, 1.0), np.array([0.1, free.natural_frequency]))
    check_bounded(free, vi.Harmonic(1.0, 0.9 * free.natural_frequency))
    check_bounded(rig(0.1), vi.Harmonic(1.0, free.natural_frequency))
