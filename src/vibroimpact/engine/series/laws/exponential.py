"""Springs that harden exponentially: 2 sinh · sinh(β u)."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import parameters as par


def shape(rig: Any) -> tuple[Any, ...]:
    """Return whether there is one."""
    return (True,) if rig[par.SINH] != 0.0 else ()


def force(law: Any, flags: tuple[Any, ...], u: Any, v: Any, z: Any) -> Any:
    """Return what pulls back."""
    steep = u * law.sinh_rate
    return law.sinh * (law.exp(steep) - law.exp(-steep))
