"""Whether a motion repeats itself: how far its state is from those of a few cycles ago.

The distance d_n(k) = ‖s_k − s_(k−n)‖ shrinks geometrically on the way to a stable orbit of n
cycles; from its decay from block to block of cycles follows what is still missing,
d_n ρⁿ / (1 − ρⁿ), and that must be below the tolerance
(docs/decisions/0004-sweep-convergence.md).
"""

from __future__ import annotations

import math

from vibroimpact.engine import flow
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import beyond, stack
from vibroimpact.engine.state import FIRST, LARGEST, copy, distance

LONGEST = 16
"""Longest period, in forcing cycles, that is recognised."""

BLOCK = 8
"""Cycles whose distances are judged together."""
_SIMPLE = 4 * BLOCK
"""Longer periods are looked for only where the simplest has not come in so many cycles."""
_STALLED_CYCLES = 96
_ROUNDING = 4e-15
_STALLED = 1e-11
_SAME = 1e-8  # states closer than this are one point of the section when counting a period
_SAFETY = 4.0  # on the estimated distance
_PATIENCE = 50  # times max_cycles, for a motion that keeps closing in
_CLOSING = 1e-3  # closer than this share of its size, a motion may be closing in
_RECENT = 0.2  # share of the cycles so far in which it must have come twice as close

# What is known: of each period the largest distance in this block and in the one before, and the
# ratios of the last blocks; sizes of the motion, in all, in this block, in the one before; the
# least distance of a block, and the blocks since; then the states of the last cycles.
_NOW, _BEFORE, _RATIO, _RATIO_BEFORE = (i * (LONGEST + 1) for i in range(4))
_SCALE, _SIZE, _SIZE_BEFORE, _BEST, _SINCE, _PAST = range(4 * (LONGEST + 1), 4 * (LONGEST + 1) + 6)

recurrence_buffer = stack(_PAST + LONGEST * (FIRST + LARGEST))


@kernel
def start(known: Vector) -> None:
    """Before the first cycle."""
    for i in range(LONGEST + 1):
        known[_NOW + i] = 0.0
        known[_BEFORE + i], known[_RATIO + i], known[_RATIO_BEFORE + i] = (
            math.inf,
            math.inf,
            math.inf,
        )
    for i in range(_SCALE, _BEST):
        known[i] = 0.0
    known[_BEST], known[_SINCE] = math.inf, 0.0


@kernel
def _past(plan: Vector, known: Vector, k: int) -> Vector:
    """The state behind cycle k."""
    return beyond(known, _PAST + (FIRST + flow.parts(plan)) * (k % LONGEST))


@kernel
def remember(plan: Vector, state: Vector, known: Vector, k: int) -> None:
    """Keep the state behind cycle k."""
    copy(state, _past(plan, known, k), FIRST + flow.parts(plan))


@kernel
def compare(plan: Vector, state: Vector, known: Vector, units: Vector, k: int) -> None:
    """Compare the state behind cycle k with those that are remembered."""
    known[_SIZE] = max(known[_SIZE], flow.size(plan, state))
    known[_SCALE] = max(known[_SIZE], known[_SIZE_BEFORE])
    for i in range(1, _longest(k) + 1):
        d = distance(plan, state, _past(plan, known, k - i), units)
        known[_NOW + i] = max(known[_NOW + i], d)


@kernel
def _longest(k: int) -> int:
    return 1 if k <= _SIMPLE else LONGEST


@kernel
def verdict(
    plan: Vector, state: Vector, known: Vector, units: Vector, k: int, tolerance: float
) -> int:
    """The period that the motion has settled on, at the end of a block; 0 if on none so far."""
    n = _converged(known, k, tolerance)
    if n:
        # A slowly alternating approach closes on 2 before 1: take the least that fits now.
        for i in range(1, n):
            d = distance(plan, state, _past(plan, known, k - i), units)
            if n % i == 0 and d <= _SAME * known[_SCALE]:
                return i
        return n
    n = _stalled(known, k)
    if n == 0:
        _next_block(known, k)
    return n


@kernel
def _converged(known: Vector, k: int, tolerance: float) -> int:
    """The period whose limit is within the tolerance; 0 if none is."""
    scale = known[_SCALE]
    for i in range(1, _longest(k) + 1):
        # ρ to the power of i, from the slowest of three successive blocks: on a rotating
        # approach a single ratio may be small by luck.
        now, before = known[_NOW + i], known[_BEFORE + i]
        slowest = max(now / before, known[_RATIO + i], known[_RATIO_BEFORE + i])
        if not before < math.inf:
            slowest = math.inf
        share = slowest ** (i / BLOCK) if slowest < 1.0 else 1.0
        small = now <= _ROUNDING * scale
        if small or (share < 1.0 and _SAFETY * now * share <= tolerance * scale * (1.0 - share)):
            return i
    return 0


@kernel
def _stalled(known: Vector, k: int) -> int:
    """The period of a motion that comes no closer, as rounding may keep a stiff rig; 0 if none."""
    longest = _longest(k)
    least = math.inf
    for i in range(1, longest + 1):
        least = min(least, known[_NOW + i])
    if least < 0.5 * known[_BEST]:
        known[_BEST], known[_SINCE] = least, 0.0
    else:
        known[_SINCE] += 1.0
    waited = known[_SINCE] * BLOCK >= max(_STALLED_CYCLES, _RECENT * k)
    if waited and least <= min(_STALLED * known[_SCALE], 4.0 * known[_BEST]):
        for i in range(1, longest + 1):
            if known[_NOW + i] <= 4.0 * least:
                return i
    return 0


@kernel
def _next_block(known: Vector, k: int) -> None:
    known[_SIZE_BEFORE], known[_SIZE] = known[_SIZE], 0.0
    for i in range(1, LONGEST + 1):
        now, before = known[_NOW + i], known[_BEFORE + i]
        known[_RATIO_BEFORE + i] = known[_RATIO + i]
        known[_RATIO + i] = now / before if before < math.inf else math.inf
        known[_BEFORE + i] = now if i <= _longest(k) else math.inf
        known[_NOW + i] = 0.0


@kernel
def closes_in(known: Vector, k: int, max_cycles: int) -> bool:
    """Whether a motion is still coming closer, so that it is waited for beyond `max_cycles`."""
    return (
        _STALLED_CYCLES <= k < _PATIENCE * max_cycles
        and known[_SINCE] * BLOCK < _RECENT * k
        and known[_BEST] <= _CLOSING * known[_SCALE]
    )
