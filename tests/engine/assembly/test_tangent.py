"""Disturbances against differences of motions."""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest

from engine.assembly.exact import Exact
from engine.assembly.following import follow_sections, sections
from engine.assembly.systems import System, full_mass, neighbours, row, storeys
from vibroimpact.engine.state import FIRST

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
                other[FIRST + i] += sign * step
                sides.append(carried(system, other, lines, tables=tables)[0])
            quotient = (sides[0] - sides[1])[FIRST : FIRST + width] / (2 * step)
            best = min(best, abs(quotient - q[i]).max() / abs(q[i]).max())
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
            other[FIRST + 2 * n + f] += sign * step
            sides.append(carried(system, other, lines)[0])
        quotient = (sides[0] - sides[1])[FIRST : FIRST + width] / (2 * step)
        assert abs(q[i]).max() > 1e-3
        assert abs(quotient - q[i]).max() <= 1e-6 * abs(q[i]).max()


APART = 1e-9
"""Time (s) between two contacts, of a period of 0.6 s."""


def exact_motion(system: System, state, lasts: float, moved: int | None = None) -> Exact:
    """A motion in 50 digits, from a state of which one number is moved by 1e-25."""
    exact = Exact(*system[:5], system.amplitude, system.omega, system.constant, grid=1.5e-3)
    n = system.n
    exact.y[: 2 * n] = [mp.mpf(x) for x in state[2 : 2 + 2 * n].tolist()]
    if moved is not None:
        exact.y[moved] += mp.mpf("1e-25")
    exact.advance(lasts, 0, (np.sin(0.3), np.cos(0.3)))
    return exact


@pytest.mark.parametrize("later", [0, 1])
@pytest.mark.parametrize("restitution", [None, 0.8])
def test_contacts_almost_at_once(restitution: float | None, later: int) -> None:
    """The mass in the middle meets both others, the one 1e-9 s after the other."""
    system = row(restitution)
    state = system.state(v=[0.9, 0.3, -0.5])
    for stop in (0, 1):
        alone = exact_motion(system._replace(stops=[]), state, 0.02 + (stop == later) * APART)
        gap = float(alone.y[stop] - alone.y[stop + 1])
        system.stops[stop] = system.stops[stop]._replace(gap=gap)
    lasts, n = system.period, system.n
    q = np.eye(2 * n + 3)[: 2 * n].copy()
    lines = sections(0.3, lasts, 1)
    end, count = carried(system, state, lines, q)
    true = exact_motion(system, state, lasts)
    (_, first, one, _), (_, second, other, _) = true.events[:2]
    assert (one, other) == (1 - later, later)
    # A rigid impact speeds the other pair up.
    assert 0.3 * APART < second - first < 1.001 * APART
    assert count == len(true.events) >= 4
    assert abs(end[2 : 2 + 2 * n] - np.array(true.y[: 2 * n], float)).max() <= 1e-12
    for i in range(2 * n):
        beside = exact_motion(system, state, lasts, i)
        pairs = zip(beside.y[: 2 * n], true.y[: 2 * n], strict=True)
        quotient = np.array([float((a - b) * mp.mpf("1e25")) for a, b in pairs])
        assert abs(quotient - q[i, : 2 * n]).max() <= 1e-11 * abs(quotient).max()
