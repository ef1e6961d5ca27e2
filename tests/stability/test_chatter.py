"""Branches of motions that come to rest on a rigid stop after infinitely many impacts."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from stability.followed import values
from vibroimpact.model.parameter_ranges import read_ranges
from vibroimpact.stability import chatter
from vibroimpact.stability.branch import _first_orbit


def ball(restitution):
    """A ball on a shaken table, all but without a spring."""
    isolator = vi.Isolator(1e-3, 0.01)
    return vi.Oscillator(1.0, isolator, vi.RigidStop(restitution, 0.0), force=9.81)


@pytest.fixture(scope="module")
def bouncing():
    shaken = vi.Harmonic(12.0, 1.0)
    return vi.branch(vi.Rig(ball(0.5), shaken), vary={"amplitude": (5.0, 25.0)})


def test_the_number_of_followed_impacts_of_a_chatter_is_no_grazing(bouncing):
    """As long as the chatter is completed the mass only lifts off where its weight is passed."""
    rests = np.hypot(bouncing["multiplier_real"], bouncing["multiplier_imag"]).max("multiplier")
    last = float(bouncing["amplitude"].values[rests.values == 0.0].max())
    assert last == pytest.approx(15.68052, abs=1e-5)
    grazing = values(bouncing, "grazing")
    within = grazing[grazing < last - 1e-9]
    np.testing.assert_allclose(within, [9.81], rtol=1e-9)
    counts = bouncing["impacts"].sel(stop="right").values[rests.values == 0.0]
    assert len(np.unique(counts)) > 5  # though it changes along the branch


def test_a_branch_does_not_come_back_along_the_orbits_at_rest(bouncing):
    assert bouncing.attrs["ended_low"] == "the range ends at 0.509858106 g"
    ended = bouncing.attrs["ended_high"]
    assert "the branch repeats the orbits in which the mass comes to rest" in ended
    along = bouncing["amplitude"].values
    assert (np.diff(along) > -1e-3).all()


def test_a_release_at_the_section_is_no_grazing():
    """A wall at the place of rest is left where the acceleration of the base changes its sign."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), vi.RigidStop(0.7, 0.0))
    grazings = [
        values(
            vi.branch(
                vi.Rig(rig, vi.Harmonic(1.0, 0.05, phase)), vary={"frequency": (0.03, 0.064)}
            ),
            "grazing",
        )
        for phase in (0.0, 1.0)
    ]
    assert [len(one) for one in grazings] == [0, 0]


def test_a_grazing_of_the_other_wall_between_two_chatters_is_one():
    wall = vi.RigidStop(0.6, 0.05)
    rig = vi.Oscillator(1.0, vi.Isolator(0.0, 0.1), wall, wall, force=0.5)
    shaken = vi.Harmonic(1.0, 0.3)
    data = vi.branch(vi.Rig(rig, shaken), vary={"amplitude": (0.3, 1.8)})
    np.testing.assert_allclose(
        values(data, "grazing"), [0.5, 0.7395252246, 1.3754939077], rtol=1e-8
    )
    for value, hits in ((0.739, 0.0), (0.740, 1.0), (1.375, 1.0), (1.376, 2.0)):
        beside = vi.steady(vi.Rig(rig, vi.Harmonic(value, 0.3)))
        assert float(beside["impacts"].sel(stop="left")) == hits


def test_a_mass_at_rest_at_the_section_begins_no_contact():
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), vi.RigidStop(0.8, 0.6), force=2.0)
    shaken = vi.Harmonic(0.3, 0.2)
    whole, vary = vi.Rig(rig, shaken), {"frequency": (0.15, 0.3)}
    data = vi.branch(whole, vi.State(0.6, 0.0), vary=vary)
    assert data.sizes["bifurcation"] == 0
    assert (data["impacts"].sel(stop="right") == 0.0).all()
    _, first = _first_orbit(whole, vi.State(0.6, 0.0), read_ranges(vary, whole)[0], None)
    assert chatter.rests(first)
    assert first.contacts == (0, 0)
