"""Shares of random states, and motions that keep their numbers along a parameter."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact.attraction.match_attractors import matched, point_distance
from vibroimpact.datasets.vocabulary import VARIABLES

WINDOW = (-0.012, 0.012), (-0.1, 0.1)
CODE = "B3-10mm-A3"


def test_shares_hold_those_of_a_grid():
    grid = vi.basins(CODE, *WINDOW, frequency=0.7, nodes=sample(400, 120))
    drawn = vi.basin_stability(CODE, *WINDOW, frequency=0.7, states=sample(5000, 800))
    assert list(drawn["motion"].values) == ["periodic", "periodic"]
    np.testing.assert_allclose(
        drawn["displacement_excursion"], grid["displacement_excursion"], rtol=1e-9
    )
    assert (drawn["share_low"].values <= grid["share"].values).all()
    assert (grid["share"].values <= drawn["share_high"].values).all()
    assert int(drawn["states"].sum()) + int(drawn["given_up"]) == sample(5000, 800)
    for name in drawn.variables:
        assert drawn[name].attrs["units"] == VARIABLES[str(name)].units


def test_a_seed_draws_the_same_states():
    one, same, other = (
        vi.basin_stability(CODE, *WINDOW, frequency=0.7, states=100, seed=seed)
        for seed in (3, 3, 4)
    )
    np.testing.assert_array_equal(one["states"], same["states"])
    assert (one["states"].values != other["states"].values).any()


@pytest.mark.full
def test_motions_keep_their_numbers_along_a_parameter():
    frequencies = [1.6, 1.8, 2.2, 2.6, 2.75]
    data = vi.basin_stability("B2-G1-A3", frequency=2.0, vary={"frequency": frequencies}, states=80)
    assert data["share"].dims == ("frequency", "attractor")
    np.testing.assert_array_equal(data["frequency"], frequencies)
    sizes = data["displacement_excursion"].values
    # The one that hits grows until it is lost, the one that flies free comes in and shrinks.
    assert (np.diff(sizes[:4, 0]) > 0.0).all()
    assert (np.diff(sizes[1:, 1]) < 0.0).all()
    np.testing.assert_array_equal(np.isnan(sizes[:, 0]), [0, 0, 0, 0, 1])
    np.testing.assert_array_equal(np.isnan(sizes[:, 1]), [1, 0, 0, 0, 0])
    assert (data["motion"].values[np.isnan(sizes)] == "").all()
    np.testing.assert_allclose(data["share"].sum("attractor"), 1.0)


def test_points_tell_which_motion_goes_on():
    rng = np.random.default_rng(0)
    cloud = 0.01 * rng.normal(size=(50, 2))
    single = np.array([[0.5, 0.5]])
    pair = np.array([[0.48, 0.5], [0.53, 0.5]])
    assert point_distance(single, pair) == pytest.approx(0.025)
    assert point_distance(cloud, cloud) == 0.0
    # A period doubles, another motion goes on, a third is new.
    before = {0: single, 4: cloud}
    assert matched(before, [cloud + 0.01, pair, single - 2.0], {0: 1, 4: 0}, 5) == [4, 0, 5]
    # Two lead to one: the nearer goes on.
    assert matched({1: single, 2: single + 0.1}, [pair], {1: 0, 2: 0}, 3) == [1]
    # What jumps far is another motion, and so is what nothing leads to.
    assert matched({0: single}, [single + 1.0], {0: 0}, 1) == [1]
    assert matched({0: single}, [single], {}, 1) == [1]


@pytest.mark.parametrize(
    ("words", "named"),
    [
        ({"states": 0}, "states: 0"),
        ({"seed": -1}, "seed: -1"),
        ({"vary": {"frequency": None}}, "vary['frequency']: None is not a list"),
        ({"vary": {"frequency": []}}, "vary['frequency']: the list is empty"),
        ({"vary": {"frequency": ["1 mm"]}}, "vary['frequency'][0]: "),
        ({"vary": {"frequency": [1.0, 2.0, 1.0]}}, "vary['frequency']: 1 Hz is given twice"),
        ({"vary": {"colour": [1.0]}}, "vary: 'colour' is unknown"),
        ({"vary": {"gap": [1.0], "mass": [1.0]}}, "vary: 'gap', 'mass'; pass a dict of values"),
        (
            {"velocity": (1.0, -1.0)},
            "velocity: the first value, 1 m/s, is not below the second, -1 m/s",
        ),
    ],
)
def test_what_is_refused(words, named):
    with pytest.raises(vi.InputError) as caught:
        vi.basin_stability(CODE, frequency=0.7, **words)
    assert str(caught.value).startswith(named)
