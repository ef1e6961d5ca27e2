"""Stops of a power of the deformation: k δⁿ (1 + χ δ′) + c δ^¼ δ′."""

from __future__ import annotations

from typing import Any


def force(law: Any, stop: str, viscous: bool, depth: Any, rate: Any) -> Any:
    """Return what a stop pushes with; `stop` names its numbers."""
    k, n = getattr(law, stop), getattr(law, f"{stop}_exponent")
    elastic = law.power(depth, n) * k
    push = elastic + getattr(law, f"{stop}_dissipation") * (elastic * rate)
    if viscous:
        push = push + getattr(law, f"{stop}_viscous") * (law.power(depth, 0.25) * rate)
    return push
