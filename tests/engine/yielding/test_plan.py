"""The tables of an isolator that yields or slides, and their bounds."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vibroimpact.engine.flow_dispatch import flow_of, planned
from vibroimpact.engine.linear import tables
from vibroimpact.engine.linear.layout import COSINE, FINE, FINE_NODE, NODE, NODES, SINE, WIDTH, H
from vibroimpact.engine.linear.layout import TABLES as LINEAR
from vibroimpact.engine.parameters import rig_vector
from vibroimpact.engine.yielding import plan as yielding
from vibroimpact.engine.yielding.layout import ELASTIC, MOVES_LEFT, MOVES_RIGHT, PLAN
from vibroimpact.law_numbers import IsolatorNumbers

BUMPER = (30.0, 0.7, 0.4)
YIELDS = IsolatorNumbers(hysteretic=1.5, limit=0.3)


def made(build, law: IsolatorNumbers, load: float, stiffness: float = 0.5) -> np.ndarray:
    rig = rig_vector(1.0, stiffness, 0.1, BUMPER, BUMPER, load, law=law)
    plan = planned(flow_of(rig), rig)
    build(plan, 0.7, 1.3)
    return plan


@pytest.mark.parametrize("mode", [0, 1, 2])
@pytest.mark.parametrize(
    ("law", "branch", "load", "stiffness"),
    [
        (IsolatorNumbers(friction=0.2), MOVES_RIGHT, 0.1 - 0.2, 0.5),
        (IsolatorNumbers(friction=0.2), MOVES_LEFT, 0.1 + 0.2, 0.5),
        (YIELDS, MOVES_RIGHT, 0.1 - 0.45, 0.5),
        (YIELDS, MOVES_LEFT, 0.1 + 0.45, 0.5),
        (YIELDS, ELASTIC, 0.1, 2.0),
    ],
)
def test_a_branch_is_a_linear_isolator_with_a_load(
    law: IsolatorNumbers, branch: int, load: float, stiffness: float, mode: int
) -> None:
    ours = made(yielding.build, law, 0.1)
    theirs = made(tables.build, IsolatorNumbers(), load, stiffness)
    assert len(ours) == PLAN
    mine, other = yielding.table_of(branch, mode), LINEAR + tables.SIZE * mode
    assert ours[mine + H] == theirs[other + H]
    for first, count in ((NODE, NODES), (FINE_NODE, FINE)):
        rows = [
            plan[at + first : at + first + count * WIDTH].reshape(count, WIDTH)[:, :SINE]
            for plan, at in ((ours, mine), (theirs, other))
        ]
        np.testing.assert_allclose(rows[0], rows[1], atol=2e-14)


def test_the_clock_turns_in_a_circle() -> None:
    plan = made(yielding.build, IsolatorNumbers(friction=0.2), 0.0)
    for mode in range(3):
        table = yielding.table_of(MOVES_LEFT, mode)
        for at in range(table + NODE, table + FINE_NODE + FINE * WIDTH, WIDTH):
            assert abs(math.hypot(plan[at + COSINE], plan[at + SINE]) - 1.0) < 3e-16
