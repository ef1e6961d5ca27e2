"""Where contact begins, and what is not regular there: no resonance of its own."""

from __future__ import annotations

import math

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.model.clearance import at_rest, clearances_at_rest
from vibroimpact.model.rig import Rig
from vibroimpact.response.curve_pair import Flags, Swept
from vibroimpact.response.resonance import Hysteresis, runs


def onset(
    rig: Rig,
    both: Swept,
    irregular: Flags,
    apart: tuple[Hysteresis, ...],
    prominence: float,
) -> tuple[tuple[float, float], ...]:
    """Ranges, not regular or with left hysteresis, that belong to where contact begins."""
    loose: Flags = np.logical_or.reduce(irregular)
    for item in apart:
        if item.side == "left":
            loose |= (both.frequency >= item.low) & (both.frequency <= item.high)
    return tuple(
        (float(both.frequency[first]), float(both.frequency[last]))
        for first, last in runs(loose)
        if not (
            _pressed_at_rest(rig) if first == 0 else foot_in_contact(both, 0, first, prominence)
        )
    )


def foot_in_contact(both: Swept, k: int, i: int, prominence: float) -> bool:
    """Whether the mass hits a bumper in the valley of η_a below a frequency.

    Going down from it, the valley is passed where the curve has risen again by `prominence` of
    its height; if it never does, it is where the curve was lowest.
    """
    down = both.eta_a[k, i::-1]
    known = np.isfinite(down)
    down = down[known]
    if not len(down):
        return bool(both.touching[k, i])
    risen = down - np.minimum.accumulate(down) > prominence * down[0]
    foot = down[: risen.argmax() or None].argmin()
    return bool(both.touching[k, i::-1][known][foot])


def _pressed_at_rest(rig: Rig) -> bool:
    """Whether the mass presses a bumper at any low frequency.

    The isolator is then loaded with M A, or not at all where the displacement of the base is given.
    """
    oscillator, shaken = rig.oscillator, rig.sine
    try:
        swing = at_rest(
            oscillator, oscillator.mass * float(shaken.acceleration(oscillator.mass, 0.0))
        )
    except InputError:  # more than a softening one bears
        swing = math.inf
    return any(swing >= gap for gap in clearances_at_rest(oscillator).values())


def within(frequency: float, spans: tuple[tuple[float, float], ...]) -> bool:
    """Whether a frequency lies in one of some ranges."""
    return any(low <= frequency <= high for low, high in spans)
