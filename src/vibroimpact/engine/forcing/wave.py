"""One part of a forcing, as the tables are made for it."""

from __future__ import annotations

from typing import NamedTuple

from vibroimpact.engine.jit import kernel


class Wave(NamedTuple):
    """amplitude · (sine s + cosine c), with s′ = rate c and c′ = −closes rate s.

    `closes` is 1 for what turns in a circle and 0 for a straight line, whose c is its slope.
    """

    amplitude: float
    rate: float
    closes: float
    sine: float
    cosine: float


@kernel
def without_amplitude(wave: Wave) -> Wave:
    """The same where it cannot move the mass."""
    _, rate, closes, sine, cosine = wave
    return Wave(0.0, rate, closes, sine, cosine)
