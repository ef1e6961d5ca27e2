"""How an entry begins that follows a motion under a periodic forcing."""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine import flow
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.state import load
from vibroimpact.engine.status import DONE, TOO_MUCH_WORK


@kernel
def open_entry(
    memory: Any,
    rig: Vector,
    amplitude: float,
    frequency: float,
    phase: float,
    state: Vector,
    here: Vector,
) -> Any:
    """Build a rig's plan for a forcing, and load a state at a section into `here`.

    Returns
    -------
    plan, s, c, period, outcome
        The plan, the clock at the section, the forcing's period (s), and `TOO_MUCH_WORK` or `DONE`.
    """
    plan = planned(memory, rig)
    period = 1.0 / frequency
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    s, c = math.sin(phase), math.cos(phase)
    load(plan, state, here, s, c)
    slow = flow.too_much_work(plan, period) != 0
    return plan, s, c, period, TOO_MUCH_WORK if slow else DONE
