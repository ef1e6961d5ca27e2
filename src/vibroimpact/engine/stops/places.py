"""Where stops are, of whatever kind."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, inlined, kernel


@inlined
def gap_of(plan: Vector, stop: int) -> float:
    """Gap of a stop (m)."""
    return plan[par.stop_at(stop) + par.GAP]  # type: ignore[no-any-return]


@inlined
def place_at(plan: Vector, stop: int, deformation: float) -> float:
    """The displacement of a mass at a stop that is deformed so far."""
    u = gap_of(plan, stop) + deformation
    return u if stop == 0 else -u


@inlined
def total_gap(plan: Vector) -> float:
    """Sum of both gaps (m); below 0 where both stops can be touched at once."""
    return gap_of(plan, 0) + gap_of(plan, 1)


@kernel
def overlapping(plan: Vector) -> bool:
    """Whether both stops can be touched at once."""
    return bool(plan[par.stop_at(0) + par.GAP] + plan[par.stop_at(1) + par.GAP] < 0.0)
