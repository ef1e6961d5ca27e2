"""One leg: the mass moves one way, between tables, until something ends it."""

from __future__ import annotations

from typing import NamedTuple

AHEAD, BEHIND = 0, 1
"""Numbers of the stops as a leg has them, in the events that end it: that to which the mass goes,
and the one behind, whose face comes after it."""

PLAIN, BEGUN, FROM_AHEAD, FROM_BEHIND, SOFTLY, LANDED = 0, 1, 2, 4, 8, 16
"""What is known of its beginning, a bit each: that it is one; that the mass has just left the stop
ahead, or the one behind; that it has no acceleration yet; that it has just met the pressed bumper.
"""


class MotionLimits(NamedTuple):
    """What may end it, in a table's coordinate times `way`, by which the mass moves up.

    A free bumper stands at `stop` + memory · exp(−rate t), one behind at `behind` − …; the force
    of the pressed one is push_x x + push_v x′ + push_0, and all three are 0 where it cannot part.
    """

    way: float
    stop: float
    yields: float
    memory: float
    rate: float
    behind: float
    behind_memory: float
    behind_rate: float
    push_x: float
    push_v: float
    push_0: float
