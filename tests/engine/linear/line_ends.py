"""Contacts in the last part of a step under a record's line; a script, run without the compiler.

A soft spring, and a slope that turns the base's acceleration over in one step: the mass dips below
the level 0 shortly before the line ends, while the node behind it lies well above.
"""

from __future__ import annotations

import math

from vibroimpact.engine.flow_dispatch import flow_of, planned
from vibroimpact.engine.linear.flight import flight
from vibroimpact.engine.linear.layout import TABLES, H, Row
from vibroimpact.engine.linear.table_search import BELOW, WITHIN, Bounds
from vibroimpact.engine.linear.tables import build
from vibroimpact.engine.parameters import Drive, rig_vector
from vibroimpact.engine.state import FLIGHT

INTERVAL, ROOT, SLOPE = 0.01, 0.05, 200.0
LEVEL = Bounds(math.inf, 0.0, 0.0, 0.0, math.inf, math.inf)


def main() -> None:
    """How many of the dips there are, and how many are found."""
    rig = rig_vector(1.0, ROOT * ROOT, 0.0, None, None, drive=Drive(interval=INTERVAL))
    plan = planned(flow_of(rig), rig)
    build(plan, 1.0, SLOPE)
    h = plan[TABLES + H]
    band = (1.0 + 17.0 * h * ROOT) * h * h / 8.0
    dips = detections = 0
    for share in (0.25, 0.3, 0.35, 0.4, 0.45):
        pull = 1.0 - SLOPE * share * INTERVAL
        for depth in (1e-3, 5e-3, 1e-2, 3e-2, 0.1):
            for above in (1.005, 1.02, 1.05):
                t, x = share * h, above * band
                v = (-depth * band - x - pull * t * t / 2 - SLOPE * t**3 / 6) / t
                row = Row(x, v, -pull, -SLOPE)
                way, *_ = flight(plan, FLIGHT, row, LEVEL, WITHIN, False, t, 0.0)
                dips, detections = dips + 1, detections + (way == BELOW)
    print(dips, detections)


if __name__ == "__main__":
    main()
