"""A user's own formula of the displacement and the velocity, given as text."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine.series import program


def shape(rig: Any) -> tuple[Any, ...]:
    """Return the operations of the formula."""
    return program.unpack(rig, 0)


def force(law: Any, symbols: tuple[Any, ...], u: Any, v: Any, z: Any) -> Any:
    """Return what pulls back."""
    signs = law.side, law.way
    force = program.evaluate(law, symbols, 0, u, v * law.per_unit, signs)
    return force * law.own_weight
