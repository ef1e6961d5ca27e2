"""Whether a motion is plainly chaotic: two of them side by side.

A second motion begins next to the first, and after each cycle it is brought back to that distance.
The growth of these distances distinguishes, within a few cycles, a motion that runs away from its
neighbours at once from one that is slow to settle. Little growth decides nothing.
"""

from __future__ import annotations

import math

from vibroimpact.engine import flow
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.sections import advance
from vibroimpact.engine.state import FIRST, distance, put, room
from vibroimpact.engine.status import DONE

_APART = 1e-8
"""Distance of the two, as a share of the motion's size."""
_TURNS = 4
"""Cycles in which the distance turns to where it grows most."""
_BESIDE = 48
"""Cycles in which growth must be plain."""
_PLAIN = 12.0
"""Logarithm of plain growth, to either side: a periodic motion contracts."""


@kernel
def runs_away(
    plan: Vector,
    state: Vector,
    s: float,
    c: float,
    period: float,
    units: Vector,
    max_events: int,
) -> tuple[bool, int]:
    """Follow a motion until it is plainly chaotic, plainly not, or for so many cycles.

    Returns
    -------
    plain, cycles
        Whether it is chaotic; the state is that after so many cycles.
    """
    parts = flow.parts(plan)
    other, section = room(), room()
    apart = _APART * flow.size(plan, state)
    put(plan, state, other)
    velocity = 0
    while units[velocity] != 1.0:
        velocity += 1
    flow.disturb(plan, other, velocity, apart, period)
    growth = 0.0
    k = 0
    while k < _BESIDE:
        _, outcome = advance(plan, state, section, s, c, period, max_events)
        if outcome != DONE:
            put(plan, section, state)
            return False, k
        events = flow.cycle(plan, other, s, c, period, max_events)
        k += 1
        far = distance(plan, state, other, units)
        if events > max_events or not 0.0 < far < math.inf:
            break
        if k > _TURNS:
            growth += math.log(far / apart)
        if abs(growth) >= _PLAIN:
            break
        # Bring it back to where it was, on the way to the first.
        share = apart / far
        for i in range(FIRST, FIRST + parts):
            other[i] = state[i] + share * (other[i] - state[i])
        other[0] = state[0]
        flow.place(plan, other)
    return growth >= _PLAIN, k
