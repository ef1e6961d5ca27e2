"""Which nodes a refined map computes, on scenarios that are known everywhere."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vibroimpact.grids.refinement import UNKNOWN, Nodes


def refined(truth: np.ndarray, refine: int) -> tuple[np.ndarray, np.ndarray]:
    """The map as it would be computed, and which nodes were."""
    nodes = Nodes(truth.shape, refine)
    known = np.full(truth.shape, UNKNOWN, dtype=np.int8)
    computed = np.zeros(truth.shape, dtype=bool)
    for level in range(refine + 1):
        chosen = nodes.nodes_to_compute(level, known)
        assert not (chosen & (known != UNKNOWN)).any()  # none twice
        known[chosen] = truth[chosen]
        computed |= chosen
        if level:
            nodes.fill(level, known)
    return known, computed


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.1])
def test_a_straight_border_is_exact_and_cheap(angle):
    n, refine = 12, 3
    size = (n - 1) * 2**refine + 1
    y, x = np.mgrid[:size, :size] / (size - 1)
    truth = (np.cos(angle) * x + np.sin(angle) * y > 0.6).astype(np.int8)
    known, computed = refined(truth, refine)
    np.testing.assert_array_equal(known, truth)
    # A border is a line: refined k times it takes 2^k nodes for each of the coarse squares.
    assert computed.sum() < n * n + 12 * n * 2**refine
    assert computed.mean() < 0.25


def test_one_scenario_takes_the_coarse_grid_alone():
    known, computed = refined(np.full((33, 17), 4, dtype=np.int8), 3)
    assert (known == 4).all()
    assert computed.sum() == 5 * 3


@given(
    truth=st.integers(2, 4).flatmap(
        lambda rows: st.integers(2, 4).flatmap(
            lambda columns: st.lists(
                st.integers(0, 2),
                min_size=((rows - 1) * 4 + 1) * ((columns - 1) * 4 + 1),
                max_size=((rows - 1) * 4 + 1) * ((columns - 1) * 4 + 1),
            ).map(
                lambda numbers: np.array(numbers, dtype=np.int8).reshape(
                    (rows - 1) * 4 + 1, (columns - 1) * 4 + 1
                )
            )
        )
    )
)
def test_every_node_is_known_and_those_computed_are_true(truth):
    known, computed = refined(truth, 2)
    assert (known != UNKNOWN).all()
    np.testing.assert_array_equal(known[computed], truth[computed])
    # What was not computed has the scenario of a corner of its square.
    assert set(np.unique(known)) <= set(np.unique(truth[computed]))
