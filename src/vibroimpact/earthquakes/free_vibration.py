"""Duration of free vibration after a record, while the base stands still."""

from __future__ import annotations

import math

from vibroimpact.model import Oscillator
from vibroimpact.model.rig import Rig

_STIFFNESSES = (
    "stiffness",
    "elastic_stiffness",
    "post_yield_stiffness",
    "reversal_stiffness",
    "final_stiffness",
)
_SWINGS = 2.0
"""Natural periods: the mass swings to either side, and with less energy ever after."""
_LONGEST = 60.0
"""Seconds, if the record is not longer."""
_BLOCK = 1.0625
"""Natural periods: more than one, so that both ends of a swing lie in it."""
BLOCKS = 2000
"""Natural periods for which the mass is followed at most until it rests."""
SMALL = 1e-9
"""Share of the largest displacement below which a swing is none."""


def free_tail(rig: Rig) -> float:
    """Return the default duration of free vibration after a record (s).

    Two natural periods with the softest of the isolator's springs, of an assembly the longest ones,
    or as long as the record if it has none; a minute at most, or as long as the record. The free
    motion has lost energy by then: it was largest before.
    """
    record = rig.record
    most = max(_LONGEST, record.duration)
    if rig.system.by_mass:
        slowest = rig.system.angular_frequency
        return min(_SWINGS * math.tau / slowest, most) if slowest else record.duration
    oscillator = rig.oscillator
    law = dict(oscillator.isolator)
    springs = [law[name] for name in _STIFFNESSES if law.get(name, 0.0) > 0.0]
    if not springs:
        return record.duration
    return min(_SWINGS * math.tau * math.sqrt(oscillator.mass / min(springs)), most)


def settles(oscillator: Oscillator) -> bool:
    """Whether it depends on the motion where the mass comes to rest."""
    isolator = oscillator.isolator
    sticks = isolator.sticks or isolator.initial_stiffness == 0.0
    return sticks or isolator.remembers


def block(rig: Rig) -> float:
    """Time over which it is seen whether a free motion still swings (s)."""
    oscillator, record = rig.oscillator, rig.record
    omega = oscillator.angular_frequency
    most = max(_LONGEST, record.duration)
    return min(_BLOCK * math.tau / omega, most) if omega else record.duration
