"""Which flow carries which rig, and that a rig compiles its own flow only."""

from __future__ import annotations

import math

import numpy as np
import pytest

from engine.for_flow import ForFlow
from vibroimpact.engine.flow_dispatch import (
    AnyStops,
    Bumpers,
    Curved,
    Yielding,
    carries,
    flow_of,
    planned,
)
from vibroimpact.engine.linear.layout import PLAN
from vibroimpact.engine.parameters import SIZE, free_rig, rig_vector
from vibroimpact.law_numbers import IsolatorNumbers, PowerLaw, StopNumbers

BUMPER, WALL = (20.0, 0.4, 1.0), (0.5, 1.0)


def rig(right: StopNumbers | None, left: StopNumbers | None) -> np.ndarray:
    return rig_vector(1.0, 1.0, 0.1, right, left)


@pytest.mark.parametrize(
    ("right", "left", "flow"),
    [
        (None, None, Bumpers),
        (BUMPER, BUMPER, Bumpers),
        (BUMPER, (20.0, 0.4, -0.5), Bumpers),  # preloaded, but out of the other one's reach
        (BUMPER, (20.0, 0.4, -1.0), Bumpers),  # touched at one place both, pressed never
        (None, (20.0, 0.4, -1.0), Bumpers),
        (BUMPER, (20.0, 0.4, -1.5), AnyStops),
        ((20.0, 0.4, -0.1), (20.0, 0.4, -0.1), AnyStops),
        (WALL, None, AnyStops),
        (BUMPER, WALL, AnyStops),
    ],
)
def test_the_flow_follows_from_the_stops(
    right: StopNumbers | None, left: StopNumbers | None, flow: type
) -> None:
    for sides in ((right, left), (left, right)):
        storage = flow_of(rig(*sides))
        assert type(storage) is flow
        assert storage.memory.shape == (PLAN,)


POWER = PowerLaw(20.0, 1.5, 0.0, 0.0, 1.0)
YIELDS = IsolatorNumbers(hysteretic=1.5, limit=0.3)


@pytest.mark.parametrize(
    ("law", "right", "left", "flow"),
    [
        (IsolatorNumbers(friction=0.1), BUMPER, WALL, Yielding),
        (YIELDS, None, BUMPER, Yielding),
        (YIELDS._replace(drag=2.0), None, BUMPER, Curved),
        (YIELDS, BUMPER, (20.0, 0.4, -1.5), Curved),  # overlapping
        (YIELDS, BUMPER, POWER, Curved),
        (YIELDS._replace(friction=0.1), None, None, Curved),
        (YIELDS._replace(limit=math.inf, knee=1.0), None, None, Curved),  # of Bouc and Wen
        (IsolatorNumbers(cubic=1.0), None, None, Curved),
    ],
)
def test_the_flow_follows_from_the_isolator(
    law: IsolatorNumbers, right: StopNumbers | None, left: StopNumbers | None, flow: type
) -> None:
    one = rig_vector(1.0, 1.0, 0.1, right, left, law=law)
    assert type(flow_of(one)) is flow
    curved = rig_vector(1.0, 1.0, 0.1, None, None, law=IsolatorNumbers(cubic=1.0))
    assert carries(one, one.copy())
    assert carries(one, curved) == (law == IsolatorNumbers(cubic=1.0))
    # The curved flow follows branches of every law, but emits no series that it was not made for.
    assert carries(curved, one) >= carries(one, curved)


@pytest.mark.parametrize(
    ("made_for", "asked", "carried"),
    [
        (IsolatorNumbers(cubic=1.0, quintic=2.0), IsolatorNumbers(cubic=1.0), True),
        (IsolatorNumbers(cubic=1.0), IsolatorNumbers(cubic=1.0, quintic=2.0), False),
        (IsolatorNumbers(drag=1.5), IsolatorNumbers(drag=2.0), True),
        (IsolatorNumbers(drag=2.0), IsolatorNumbers(drag=1.5), False),
        (
            IsolatorNumbers(hysteretic=1.0, knee=1.0, sharpness=2.0),
            IsolatorNumbers(hysteretic=1.0, knee=1.0),
            False,
        ),
    ],
)
def test_a_curved_flow_carries_rigs_that_have_no_more_laws(
    made_for: IsolatorNumbers, asked: IsolatorNumbers, carried: bool
) -> None:
    made, other = (rig_vector(1.0, 1.0, 0.1, None, None, law=law) for law in (made_for, asked))
    assert carries(made, other) == carried


def _gap(storage, vector):
    plan = planned(storage, vector)
    return plan[5] + 0.0 * storage.memory[0]


def test_a_rig_pays_for_its_own_flow_only() -> None:
    entry = ForFlow(_gap, "f8(f8[::1])")
    assert entry(free_rig()) == math.inf
    assert set(entry._compiled) == {Bumpers}
    assert entry(rig(WALL, None)) == WALL[1]
    assert set(entry._compiled) == {Bumpers, AnyStops}
    assert SIZE > 5
