"""Where contact begins, and what is not regular there: no resonance of its own."""

from __future__ import annotations

import math

import numpy as np

from vibroimpact.model import Oscillator
from vibroimpact.response.resonance import Hysteresis
from vibroimpact.response.swept import Array, Flags, Swept


def onset(
    oscillator: Oscillator,
    both: Swept,
    irregular: Flags,
    apart: tuple[Hysteresis, ...],
    free: Array,
    prominence: float,
) -> tuple[tuple[float, float], ...]:
    """Ranges, not regular or with left hysteresis, that belong to where contact begins."""
    loose: Flags = np.logical_or.reduce(irregular)
    for item in apart:
        if item.side == "left":
            loose |= (both.frequency >= item.low) & (both.frequency <= item.high)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], loose, [False]]))).reshape(-1, 2)
    return tuple(
        (float(both.frequency[first]), float(both.frequency[end - 1]))
        for first, end in edges
        if not (
            _pressed_at_rest(oscillator, both, free)
            if first == 0
            else foot_in_contact(both, 0, int(first), prominence)
        )
    )


def foot_in_contact(both: Swept, k: int, i: int, prominence: float) -> bool:
    """Whether the mass hits a bumper in the valley of η_a below a frequency.

    Going down from it, the valley is passed where the curve has risen again by `prominence` of
    its height; if it never does, it is where the curve was lowest.
    """
    curve = both.eta_a[k]
    known = np.flatnonzero(np.isfinite(curve[: i + 1]))
    if not len(known):
        return bool(both.touching[k, i])
    foot = int(known[-1])
    height = curve[foot]
    for j in known[-2::-1]:
        if curve[j] < curve[foot]:
            foot = int(j)
        elif curve[j] - curve[foot] > prominence * height:
            break
    return bool(both.touching[k, foot])


def _pressed_at_rest(oscillator: Oscillator, both: Swept, free: Array) -> bool:
    """Whether the mass presses a bumper at any low frequency: A/ω0² is larger than a gap."""
    oscillator.check_linear("free flight in closed form", stops=False)
    gaps = [b.gap for b in (oscillator.right, oscillator.left) if b is not None]
    # Free flight's amplitude A/ω0² |H| at the lowest frequency, without its gain |H|.
    ratio = float(both.frequency[0]) / oscillator.natural_frequency
    inverse = math.hypot((1.0 - ratio) * (1.0 + ratio), 2.0 * oscillator.damping_ratio * ratio)
    return bool(gaps) and float(free[0]) * inverse >= min(gaps)


def within(frequency: float, spans: tuple[tuple[float, float], ...]) -> bool:
    """Whether a frequency lies in one of some ranges."""
    return any(low <= frequency <= high for low, high in spans)
