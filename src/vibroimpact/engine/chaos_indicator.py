"""Whether a motion is plainly chaotic: two of them side by side.

A second motion begins next to the first, and after each cycle it is brought back to that distance.
What the distances grow by tells a motion that runs away from its neighbours at once, within a few
cycles, from one that is slow to settle. Little growth tells nothing.
"""

from __future__ import annotations

import math

from vibroimpact.engine.event_loop import cycle
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import Clock, Motion, finite
from vibroimpact.engine.observe import UNOBSERVED
from vibroimpact.engine.section_map import placed

_APART = 1e-8
"""Distance of the two, as a share of the motion's size."""
_TURNS = 4
"""Cycles in which the distance turns to where it grows most."""
_BESIDE = 48
"""Cycles in which growth must be plain."""
_PLAIN = 12.0
"""Logarithm of plain growth, to either side: a periodic motion contracts."""


@kernel
def distance(one: Motion, other: Motion, weight: float) -> float:
    """How far two states are apart, as a velocity."""
    most = max(abs(one.u - other.u), abs(one.right - other.right), abs(one.left - other.left))
    return max(weight * most, weight * abs(one.z - other.z), abs(one.v - other.v))


@kernel
def between(plan: Vector, one: Motion, other: Motion, share: float) -> Motion:
    """The state at a share of the way from one to another."""
    return placed(
        plan,
        one.mode,
        one.u + share * (other.u - one.u),
        one.v + share * (other.v - one.v),
        one.right + share * (other.right - one.right),
        one.left + share * (other.left - one.left),
        one.z + share * (other.z - one.z),
        one.clock,
    )


@kernel
def runs_away(
    plan: Vector, motion: Motion, clock: Clock, period: float, weight: float, max_events: int
) -> tuple[bool, int, Motion]:
    """Follow a motion until it is plainly chaotic, plainly not, or for so many cycles.

    Returns
    -------
    plain, cycles, motion
        Whether it is chaotic.
    """
    apart = _APART * max(weight * abs(motion.u), abs(motion.v))
    other = placed(
        plan,
        motion.mode,
        motion.u,
        motion.v + apart,
        motion.right,
        motion.left,
        motion.z,
        motion.clock,
    )
    growth = 0.0
    k = 0
    while k < _BESIDE:
        section = motion
        events, motion, _ = cycle(plan, section, clock, period, max_events, UNOBSERVED)
        if events > max_events or not finite(motion):
            return False, k, section
        events, other, _ = cycle(plan, other, clock, period, max_events, UNOBSERVED)
        k += 1
        far = distance(motion, other, weight)
        if events > max_events or not 0.0 < far < math.inf:
            break
        if k > _TURNS:
            growth += math.log(far / apart)
        if abs(growth) >= _PLAIN:
            break
        other = between(plan, motion, other, apart / far)
    return growth >= _PLAIN, k, motion
