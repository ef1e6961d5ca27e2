"""Dashpots of another power of the velocity than 1: drag |v|^α, the way of v being known."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import parameters as par


def shape(rig: Any) -> tuple[Any, ...]:
    """Return 2, or 0 for a power that is not a whole number."""
    if rig[par.DRAG] == 1.0 or rig[par.DAMPING] == 0.0:
        return ()
    return (2 if rig[par.DRAG] == 2.0 else 0,)


def force(law: Any, power: tuple[Any, ...], u: Any, v: Any, z: Any) -> Any:
    """Return what pulls back; `drag` has the sign of the way."""
    if power[0] == 2:
        return law.drag * (v * v)
    return law.drag * law.power(law.way * law.per_unit * v, law.drag_exponent)
