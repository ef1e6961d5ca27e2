"""How far a mass may swing about where its isolator holds it, before it meets a stop."""

from __future__ import annotations

from vibroimpact.model.equilibrium import equilibrium
from vibroimpact.model.oscillator import Oscillator


def at_rest(oscillator: Oscillator, force: float | None = None) -> float:
    """Where the isolator alone holds the mass against a force (N), the constant one if None (m)."""
    held = oscillator.force if force is None else force
    if oscillator.isolator.linear:
        return held / oscillator.isolator.initial_stiffness
    return equilibrium(oscillator.without_bumpers().replace(force=held)).displacement


def room(oscillator: Oscillator) -> dict[str, float]:
    """How far each stop stands from where the isolator would hold the mass at rest (m).

    That is its gap, shifted by what the constant force does to the isolator.
    """
    rest = at_rest(oscillator)
    sides = {"right": (oscillator.right, -rest), "left": (oscillator.left, rest)}
    return {side: stop.gap + shift for side, (stop, shift) in sides.items() if stop is not None}
