"""Nodes of a grid that become states where they are followed."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.attraction.label_states import (
    NO_TRAPS,
    Region,
    SectionSetup,
    follow,
    follow_region,
)
from vibroimpact.attraction.state_grid import lattice

CASE = vi.laboratory.case("B3-10mm-A3")
STAGE = SectionSetup(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 0.7)))
BUMPERS = (0.002, -0.001, 0.0)


def test_one_state_a_node():
    points = np.array(lattice((-1.0, 1.0), (0.0, 2.0), (3, 2)))
    np.testing.assert_array_equal(points[:, 0], [-1, 0, 1, -1, 0, 1])
    np.testing.assert_array_equal(points[:, 1], [0, 0, 0, 2, 2, 2])
    assert not points[:, 2:].any()


@pytest.mark.parametrize("which", [slice(3, 9), slice(0, 0), np.array([11, 2, 2, 5])])
def test_some_nodes_are_the_states_of_all(which):
    nodes = lattice((-0.01, 0.01), (-0.1, 0.1), (4, 3), BUMPERS)
    every = np.array(nodes)
    assert len(nodes) == len(every) == 12
    np.testing.assert_array_equal(np.array(nodes[which]), every[which])
    np.testing.assert_array_equal(every[:, 2:], np.tile(BUMPERS, (12, 1)))


def test_nodes_lead_where_their_states_lead():
    nodes = lattice((-0.01, 0.01), (-0.1, 0.1), (70, 60), BUMPERS)
    ours = follow(STAGE, nodes, None, NO_TRAPS, 2)
    theirs = follow(STAGE, np.array(nodes), None, NO_TRAPS, 2)
    for one, other in zip(ours, theirs, strict=True):
        np.testing.assert_array_equal(one, other)


def test_few_bytes_a_node_travel():
    number = 40_000
    nodes = lattice((-0.01, 0.01), (-0.1, 0.1), (200, 200))
    region = Region(STAGE, nodes, np.empty((0, 8)), NO_TRAPS, 1)
    there = pickle.loads(pickle.dumps(region))
    assert len(pickle.dumps(region)) < 5 * number
    labels = follow_region(there, np.zeros(2, dtype=np.int64))
    assert len(labels.owner) == number
