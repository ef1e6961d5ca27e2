"""Memories of Bouc and Wen's kind: hysteretic · z, with z′ = v (slope − bend zⁿ) on each branch."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import parameters as par


def shape(rig: Any) -> tuple[Any, ...]:
    """Return the power n of the memory; 0 where it yields at a limit instead."""
    if rig[par.HYSTERETIC] == 0.0:
        return ()
    bends = rig[par.KNEE] != 0.0 or rig[par.TURNING] != 0.0
    return (int(rig[par.SHARPNESS]) if bends else 0,)


def force(law: Any, power: tuple[Any, ...], u: Any, v: Any, z: Any) -> Any:
    """Return what pulls back."""
    return law.hysteretic * z


def flow(law: Any, power: tuple[Any, ...], u: Any, v: Any, z: Any) -> Any:
    """Return the memory's rate."""
    if power[0] == 0:
        return law.slope * v
    return law.slope * v - law.bend * (v * z ** power[0])
