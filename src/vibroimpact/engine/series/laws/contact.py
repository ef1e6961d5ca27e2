"""Stops of a power of the deformation, k δⁿ (1 + χ δ′) + c δ^¼ δ′, or of a formula of one's own."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine.series import program


def force(law: Any, stop: str, kind: Any, depth: Any, rate: Any) -> Any:
    """Return what a stop pushes with; `stop` names its numbers.

    `kind` is 1 for a power, 2 for one with a viscous part, or whose program it follows, and that.
    """
    if isinstance(kind, tuple):
        way = law.way if stop == "push" else -law.way
        force = program.evaluate(law, kind[1], kind[0], depth, rate * law.per_unit, (1.0, way))
        return force * law.own_weight
    k, n = getattr(law, stop), getattr(law, f"{stop}_exponent")
    elastic = law.power(depth, n) * k
    push = elastic + getattr(law, f"{stop}_dissipation") * (elastic * rate)
    if kind == 2:
        push = push + getattr(law, f"{stop}_viscous") * (law.power(depth, 0.25) * rate)
    return push
