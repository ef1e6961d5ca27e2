"""Which piece of a law holds, and what friction holds."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from engine.taylor.rigs import ISOLATORS, SHAKEN, STOPS, between
from vibroimpact.engine import parameters as par
from vibroimpact.engine.flow_dispatch import flow_of, planned
from vibroimpact.engine.motion import LEFT, RIGHT, Motion
from vibroimpact.engine.state import FLIGHT
from vibroimpact.engine.taylor.mode_forces import isolator_force, stuck
from vibroimpact.engine.taylor.plan import build
from vibroimpact.response.engine_system import engine_rig


def plan_of(isolator: str, stop: str | None = None) -> np.ndarray:
    rig = engine_rig(vi.Rig(between(isolator, stop), SHAKEN))
    plan = planned(flow_of(rig), rig)
    build(plan, 0.6, 0.9)
    return plan


@pytest.mark.parametrize("isolator", ["linear", "duffing", "softening", "friction"])
@pytest.mark.parametrize("u", [0.3, -2.0])
def test_force_without_a_memory_is_the_static_one(isolator: str, u: float) -> None:
    law = ISOLATORS[isolator]
    plan = plan_of(isolator)
    force = isolator_force(plan, u, 0.0, 0.0)
    friction = getattr(law, "friction", 0.0)
    assert force == pytest.approx(law.static_force(u) - math.copysign(friction, u), rel=1e-14)
    rate = law.damping * 0.7
    assert isolator_force(plan, u, 0.7, 0.0) == pytest.approx(force + rate, rel=1e-14)


@pytest.mark.parametrize(
    ("u", "holds"), [(0.0, True), (0.15, True), (0.1501, False), (-0.2, False)]
)
def test_friction_holds_up_to_its_force(u: float, holds: bool) -> None:
    plan = plan_of("friction")
    still = Motion(FLIGHT, 0, u, 0.0, (0.0, 0.0), 0.0, 0.0, (0.0, 1.0))
    assert stuck(plan, still) == holds
    assert not stuck(plan, still._replace(v=1e-9))
    assert plan[par.FRICTION] == 0.15


@pytest.mark.parametrize("side", [RIGHT, LEFT])
def test_a_pressed_stop_helps_to_hold(side: int) -> None:
    plan = plan_of("friction", "spring")
    sign = 1.0 if side == RIGHT else -1.0
    u = sign * 0.502
    depth = 0.002 if side == RIGHT else 0.0, 0.002 if side == LEFT else 0.0
    # −sin θ of 1.08 holds against the spring and the stop: 0.502 + 0.06.
    clock = (-sign * 0.5 / 0.6, math.sqrt(1.0 - (0.5 / 0.6) ** 2))
    motion = Motion(side, 0, u, 0.0, depth, 0.0, 0.0, clock)
    assert stuck(plan, motion)
    assert not stuck(plan, motion._replace(mode=side, clock=(0.0, 1.0)))
    assert isinstance(STOPS["spring"], vi.Bumper)
