"""Where a branch meets that of the simpler motions which its own left."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.stability.bifurcations import bifurcating_orbits
from vibroimpact.stability.branch import follow_both_ways
from vibroimpact.stability.fixed_points import Orbit
from vibroimpact.stability.initial_orbit import first_orbit
from vibroimpact.stability.parameter_family import family
from vibroimpact.stability.parent_branches import half_plus, is_of_simpler_map, parent

CASE = vi.laboratory.case("B3-10mm-A3")
SPAN = (1.0, 1.3)


@pytest.fixture(scope="module")
def doubling():
    """The branch of the pair, its period doubling, and the branch that is born there."""
    fam = family(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 1.2)), "frequency")
    pair = follow_both_ways(first_orbit(fam, SPAN, None, 1), SPAN, 1000)
    bifurcation = next(b for b in pair.bifurcations if b.kind == "period doubling" and not b.turns)
    (station,) = bifurcating_orbits(bifurcation)
    return bifurcation, follow_both_ways(station.orbit, SPAN, 1000)


def test_a_test_function_that_vanishes_at_minus_one(doubling):
    bifurcation, _ = doubling
    assert np.abs(bifurcation.orbit.multipliers + 1.0).min() < 1e-8
    assert abs(half_plus(bifurcation.orbit)) < 1e-8


def test_the_branch_passes_its_parent_in_its_last_step(doubling):
    bifurcation, followed = doubling
    stations = followed.stations
    met = parent(stations[-2].orbit, stations[-1].orbit)
    assert met is not None
    assert met.section.count == 1
    places = [b.orbit.value for b in followed.bifurcations if b.turns and b.orbit is not met]
    assert min(abs(value - bifurcation.orbit.value) for value in places) < 1e-9
    middle = len(stations) // 2
    assert parent(stations[middle].orbit, stations[middle + 1].orbit) is None


def test_an_orbit_of_the_simpler_map_has_slid(doubling):
    bifurcation, followed = doubling
    assert not is_of_simpler_map(followed.stations[len(followed.stations) // 2].orbit)
    once = bifurcation.orbit
    twice = Orbit(
        once.section.with_map(2, mirror=False), once.point, once.facts, once.carried, once.slope
    )
    assert is_of_simpler_map(twice)
