"""Distances from the equilibrium on the isolator alone to the stops."""

from __future__ import annotations

from vibroimpact.model.equilibrium import equilibrium
from vibroimpact.model.oscillator import Oscillator


def at_rest(oscillator: Oscillator, force: float | None = None) -> float:
    """Return the displacement (m) at which the isolator alone balances a constant force (N).

    Default of the force: the constant force of the oscillator.
    """
    held = oscillator.force if force is None else force
    if oscillator.isolator.linear:
        return held / oscillator.isolator.initial_stiffness
    return equilibrium(oscillator.without_bumpers().replace(force=held)).displacement


def clearances_at_rest(oscillator: Oscillator) -> dict[str, float]:
    """Return the distance (m) of each stop from the equilibrium on the isolator alone.

    It is the gap, changed by the displacement that the constant force causes.
    """
    rest = at_rest(oscillator)
    sides = {"right": (oscillator.right, -rest), "left": (oscillator.left, rest)}
    return {side: stop.gap + shift for side, (stop, shift) in sides.items() if stop is not None}
