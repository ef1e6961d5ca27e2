"""Coefficients of products and powers of the series in hand, one by one."""

from __future__ import annotations

from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.series.layout import ROOM, X
from vibroimpact.engine.series.values import Push


@inlined
def convolved(plan: Vector, a: int, b: int, n: int) -> float:
    """Coefficient n of the product of two series."""
    even = 0.0
    odd = 0.0
    for j in range(0, n, 2):
        even += plan[a + j] * plan[b + n - j]
        odd += plan[a + j + 1] * plan[b + n - j - 1]
    if n % 2 == 0:
        even += plan[a + n] * plan[b]
    return even + odd


@inlined
def pushed(plan: Vector, a: int, n: int) -> float:
    """Coefficient n of the product of a series and x′."""
    even = 0.0
    odd = 0.0
    for j in range(0, n, 2):
        even += plan[a + n - j] * ((j + 1) * plan[X + j + 1])
        odd += plan[a + n - j - 1] * ((j + 2) * plan[X + j + 2])
    if n % 2 == 0:
        even += plan[a] * ((n + 1) * plan[X + n + 1])
    return even + odd


@inlined
def raised_to(plan: Vector, base: int, exponent: float, into: int, n: int) -> None:
    """Coefficient n of a power of a series that does not begin with 0."""
    if n == 0:
        plan[into] = plan[base] ** exponent
        return
    total = 0.0
    for j in range(1, n + 1):
        total += ((exponent + 1.0) * j - n) * plan[base + j] * plan[into + n - j]
    plan[into + n] = total / (n * plan[base])


@kernel
def pressed(
    plan: Vector, push: Push, sign: float, deformation: int, into: int, unit: float, n: int
) -> float:
    """Coefficient n of what a power-law stop pushes with, `sign` being that of δ′ to x′."""
    raised_to(plan, deformation, push.exponent, into, n)
    force = plan[into + n]
    if push.dissipation != 0.0:
        force += sign * push.dissipation / unit * pushed(plan, into, n)
    force *= push.stiffness
    if push.viscous != 0.0:
        raised_to(plan, deformation, 0.25, into + ROOM, n)
        force += sign * push.viscous / unit * pushed(plan, into + ROOM, n)
    return force * unit * unit  # type: ignore[no-any-return]
