"""Where the mass stays while nothing shakes it.

The force of the isolator and of the bumpers, each pushing only,

    K u + K_R max(u - G_R, 0) - K_L max(-u - G_L, 0),

rises with u from minus to plus infinity, and rigid stops bound u. So there is one place where it
equals the constant force; without that force and with no gap below 0 it is u = 0. Without a spring
the mass stays anywhere between its stops, u = 0 among them.
"""

from __future__ import annotations

import math
from itertools import product

from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.state import State
from vibroimpact.model.stops import Bumper, RigidStop


def equilibrium(oscillator: Oscillator) -> State:
    """Return the state of rest.

    Parameters
    ----------
    oscillator
        What vibrates; its base stands still.

    Returns
    -------
    State
        The displacement, with zero velocity. What it leaves open follows from the rig: bumpers
        are pressed as far as the mass reaches into them.

    Examples
    --------
    >>> from vibroimpact.model import Bumper, Isolator, Oscillator
    >>> equilibrium(Oscillator(1.0, Isolator(1.0, 0.1), Bumper(3.0, 0.1, -0.4))).displacement
    -0.3
    """
    sides = [(1, oscillator.right), (-1, oscillator.left)]
    bumpers = [(side, stop) for side, stop in sides if isinstance(stop, Bumper)]

    def at_rest(pressed: tuple[bool, ...]) -> tuple[float, float]:
        """How far a bumper is from agreeing, and the displacement, if these are pressed."""
        pairs = list(zip(pressed, bumpers, strict=True))
        stiffness = sum(stop.stiffness for yes, (_, stop) in pairs if yes)
        push = sum(side * stop.stiffness * stop.gap for yes, (side, stop) in pairs if yes)
        push += oscillator.force
        stiffness += oscillator.isolator.stiffness
        u = push / stiffness if stiffness else math.copysign(math.inf, push) if push else 0.0
        depths = [(yes, side * u - stop.gap) for yes, (side, stop) in pairs]
        return max((-depth if yes else depth for yes, depth in depths), default=0.0), u

    # Of all ways to press them one agrees; on the border of two, both give the same u.
    _, u = min(at_rest(pressed) for pressed in product((False, True), repeat=len(bumpers)))
    if isinstance(oscillator.right, RigidStop):
        u = min(u, oscillator.right.gap)
    if isinstance(oscillator.left, RigidStop):
        u = max(u, -oscillator.left.gap)
    return State(u)
