"""Disturbances against differences of motions."""

from __future__ import annotations

import numpy as np
import pytest

from engine.assembly.following import follow_sections, sections
from engine.assembly.systems import System, full_mass, neighbours, row, storeys
from vibroimpact.engine.assembly import layout as at

SYSTEMS = {
    "neighbours": neighbours(),
    "storeys": storeys(),
    "row": row(),
    "rigid row": row(0.8),
    "full mass": full_mass(),
}


def carried(system: System, state, lines, q=None, tables=True):
    state = state.copy()
    plan = system.plan(tables)
    count = follow_sections(plan, system.amplitude, system.omega, state, lines, disturbances=q)
    assert count >= 0
    return state, count


@pytest.mark.parametrize("tables", [True, False])
@pytest.mark.parametrize("name", SYSTEMS)
def test_differences(name: str, tables: bool) -> None:
    system = SYSTEMS[name]
    n, width = system.n, 2 * system.n + len(system.stops)
    lines = sections(0.3, system.period, 1)
    start, _ = carried(system, system.state(), np.tile(lines, (7, 1)))
    assert start[0] == 0  # all are free here
    q = np.eye(width)[: 2 * n].copy()
    end, count = carried(system, start, lines, q, tables)
    assert count >= 2
    for i in range(2 * n):
        best = np.inf
        for step in (1e-6, 1e-7, 1e-8):
            sides = []
            for sign in (1.0, -1.0):
                other = start.copy()
                other[at.PARTS + i] += sign * step
                sides.append(carried(system, other, lines, tables=tables)[0])
            found = (sides[0] - sides[1])[at.PARTS : at.PARTS + width] / (2 * step)
            best = min(best, abs(found - q[i]).max() / abs(q[i]).max())
        assert best <= 2e-6
    # Nothing that is observed changes the motion.
    assert (carried(system, start, lines, None, tables)[0] == end).all()


def test_a_deformation_that_outlives_the_section() -> None:
    """Of a bumper with a slow dashpot, met while it still relaxes."""
    system = neighbours()
    stops = [s._replace(stiffness=400.0, damping=60.0) for s in system.stops]
    system = system._replace(stops=stops)
    n, width = 2, 6
    lines = sections(0.3, system.period, 1)
    start, _ = carried(system, system.state(), np.tile(lines, (9, 1)))
    free = [f for f in range(2) if not int(start[0]) >> f & 1 and start[2 + 2 * n + f] > 1e-6]
    assert free
    q = np.zeros((len(free), width))
    for i, f in enumerate(free):
        q[i, 2 * n + f] = 1.0
    _, count = carried(system, start, lines, q)
    assert count
    for i, f in enumerate(free):
        step = 1e-7
        sides = []
        for sign in (1.0, -1.0):
            other = start.copy()
            other[at.PARTS + 2 * n + f] += sign * step
            sides.append(carried(system, other, lines)[0])
        found = (sides[0] - sides[1])[at.PARTS : at.PARTS + width] / (2 * step)
        assert abs(q[i]).max() > 1e-3
        assert abs(found - q[i]).max() <= 1e-6 * abs(q[i]).max()
