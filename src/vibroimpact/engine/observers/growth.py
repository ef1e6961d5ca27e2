"""How two disturbances of a motion grow: their directions carried on, their sizes summed up."""

from __future__ import annotations

from typing import NamedTuple

from vibroimpact.engine.dispatch import grow
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.motion import Stretch
from vibroimpact.engine.observe import observer


class Growth(NamedTuple):
    """One disturbance, and what its flow keeps of a second one, of unit size after each cycle.

    `first` and `both` are the logarithms of how much they have grown since the section, which
    comes again at `length` (s); `dissipation` is the integral of the damping; `shrunk` bounds
    how much they may have shrunk since they were last brought to unit size.
    """

    disturbance: Vector
    second: Vector
    weight: float
    length: float
    first: float
    both: float
    dissipation: float
    shrunk: float


@observer(Growth)
def growth(plan: Vector, notes: Growth, stretch: Stretch) -> Growth:
    """Carry both through one stretch."""
    return grow(plan, notes, stretch)  # type: ignore[no-any-return]
