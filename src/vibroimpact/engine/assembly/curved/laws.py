"""Curved links and stops as rows of an assembly, and their numbers in its vector."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved.tape import LawTape, shape_of
from vibroimpact.engine.parameters import rig_vector
from vibroimpact.engine.series.kernels import pushed
from vibroimpact.engine.stops import memory_laws
from vibroimpact.law_numbers import IsolatorNumbers, MemoryStop, OwnStop, PowerLaw

PUSHING = (of.POWER, of.OWN_STOP, of.MEMORY_STOP)
"""Behaviours of stops."""
BRANCHING = (of.HYSTERETIC, of.BILINEAR, of.DRAG, of.FRICTION, of.OWN)
"""Behaviours whose force has branches."""


def link_rows(numbers: IsolatorNumbers, damping: float) -> list[tuple[int, tuple[float, ...]]]:
    """Return the rows of a link but for its spring and linear dashpot: behaviour and numbers.

    Parameters
    ----------
    numbers
        What it does besides.
    damping
        Its damping coefficient, which counts if the dashpot is not linear.
    """
    none = IsolatorNumbers()
    laws = []
    smooth = none._replace(
        cubic=numbers.cubic,
        quintic=numbers.quintic,
        sinh=numbers.sinh,
        sinh_rate=numbers.sinh_rate,
    )
    if numbers.cubic or numbers.quintic or numbers.sinh:
        laws.append((of.SMOOTH, smooth, 0.0))
    if numbers.hysteretic:
        law = none._replace(
            hysteretic=numbers.hysteretic,
            slope=numbers.slope,
            turning=numbers.turning,
            knee=numbers.knee,
            sharpness=numbers.sharpness,
            limit=numbers.limit,
        )
        laws.append((of.BILINEAR if numbers.limit < math.inf else of.HYSTERETIC, law, 0.0))
    if numbers.friction:
        laws.append((of.FRICTION, none._replace(friction=numbers.friction), 0.0))
    if numbers.own:
        laws.append((of.OWN, none._replace(own=numbers.own), 0.0))
    if numbers.drag != 1.0 and damping:
        laws.append((of.DRAG, none._replace(drag=numbers.drag), damping))
    return [
        (behaviour, tuple(rig_vector(1.0, 0.0, by, None, None, law=law).tolist()))
        for behaviour, law, by in laws
    ]


def stop_law(numbers: PowerLaw | OwnStop | MemoryStop) -> tuple[int, tuple[float, ...]]:
    """Return behaviour and numbers of a stop that pushes."""
    vector = rig_vector(1.0, 0.0, 0.0, numbers, None)
    behaviour = {PowerLaw: of.POWER, OwnStop: of.OWN_STOP, MemoryStop: of.MEMORY_STOP}
    return behaviour[type(numbers)], tuple(vector.tolist())


def initial_stiffness(stop: Any) -> float:
    """Return what a curved link adds to the stiffness at rest (N/m)."""
    if not stop.behaviour or stop.behaviour in PUSHING:
        return 0.0
    law = stop.law
    sinh = 2.0 * law[par.SINH] * law[par.SINH_RATE]
    return float(law[par.HYSTERETIC] * law[par.SLOPE] + sinh + law[par.OWN + par.OWN_STIFFNESS])


def written(stops: Sequence[Any]) -> tuple[Any, Any]:
    """Return the numbers of all rows, and the operations of all tapes."""
    rows = np.zeros((len(stops), of.WIDTH))
    tape: list[list[float]] = []
    branches = 0
    for row, stop in zip(rows, stops, strict=True):
        row[of.BRANCH] = -1.0
        if not stop.behaviour:
            continue
        row[of.BEHAVIOUR] = stop.behaviour
        row[of.NUMBERS :] = stop.law
        if stop.behaviour in BRANCHING:
            row[of.BRANCH] = branches
            branches += 1
        if stop.behaviour == of.FRICTION:
            continue
        push = pushed(np.array(stop.law), 0) if stop.behaviour in PUSHING else 0
        if stop.behaviour == of.MEMORY_STOP:
            push = list(memory_laws.LAWS.values())[int(stop.law[par.BUMPER + par.REBOUND])]
            row[of.TIED] = push.rate is None
        made = LawTape(shape_of(np.array(stop.law), push), len(tape))
        row[of.FIRST_OP], row[of.KNOWN] = len(tape), made.known
        tape += made.rows
        row[of.LAST_OP] = len(tape)
        row[of.S_NODE : of.RAW_NODE + 1] = made.nodes
        tape += made.slope_rows
        row[of.SLOPE_CONSTANTS] = made.slope_constants
        row[of.LAST_SLOPE] = len(tape)
        row[of.BY_S : of.FLOW_BY_S + 1] = made.slopes
    return rows, np.array(tape).reshape(-1, of.OP_WIDTH)
