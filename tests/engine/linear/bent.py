"""How far a motion's x″ goes about a state, beside its bounds; a script, run without the compiler.

Compiling the tables for each kind of forcing would take far longer than these few states.
"""

from __future__ import annotations

import json
import math

import numpy as np

from vibroimpact.engine.flow_dispatch import flow_of, planned
from vibroimpact.engine.forcing.dispatch import short_series
from vibroimpact.engine.linear.evaluate import band, node, travel
from vibroimpact.engine.linear.layout import NODES, TABLES, Row
from vibroimpact.engine.linear.table_search import bends
from vibroimpact.engine.linear.tables import build
from vibroimpact.engine.parameters import Drive, rig_vector

DRIVES = {
    "one sine": Drive(),
    "four": Drive(weights=((0.6, 0.1), (0.0, 0.0), (-0.9, 0.4), (0.1, 0.3))),
    "a record's line": Drive(interval=10.0),
}


def bent(rig: np.ndarray, omega: float, row: Row, low: float, high: float) -> tuple[float, float]:
    """The largest of x″ and −x″ from `low` to `high` steps on, each less its bound, over the size
    of x″; and the bounds' distance over that size."""
    plan = planned(flow_of(rig), rig)
    build(plan, 1.0, omega)
    second = 8.0 * band(plan, TABLES, row.x, row.v)
    curvatures = []
    for y in np.linspace(0.0, high - low, 41):
        i = min(int(y), NODES - 1)
        there = travel(plan, TABLES, y - i, node(plan, TABLES, i, row))
        curvatures.append(2.0 * short_series(plan, TABLES, there)[2])
    rise, fall = bends(plan, TABLES, node(plan, TABLES, int(-low), row), second, low, high)
    beyond = max(max(curvatures) - rise, -min(curvatures) - fall)
    return beyond / np.abs(curvatures).max(), (rise + fall) / np.abs(curvatures).max()


def main() -> None:
    """Random rigs and states: what comes closest to a bound, and the closest bounds."""
    for drive in DRIVES.values():
        rng = np.random.default_rng(7)
        for low, high in ((0.0, 1.0), (0.0, 2.0), (-1.0, 1.0)):
            results = []
            for _ in range(60):
                stiffness, damping, omega = 10.0 ** rng.uniform(-2, 2, 3)
                rig = rig_vector(1.0, stiffness, damping, (9.0, 1.0, 5.0), None, drive=drive)
                x, v = rng.normal(size=2) * 10.0 ** rng.uniform(-3, 3, 2)
                angle = rng.uniform(0.0, 7.0)
                row = Row(x, v, math.sin(angle), math.cos(angle))
                results.append(bent(rig, omega, row, low, high))
            beyond, distance = np.transpose(results)
            print(json.dumps([beyond.max(), np.median(distance)]))


if __name__ == "__main__":
    main()
