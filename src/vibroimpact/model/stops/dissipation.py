"""Dissipation of a contact k δⁿ (1 + χ δ') that gives a coefficient of restitution.

With χ = d/v₀ and v₀ the closing speed, the rebound depends on d alone: with w = -v/v₀ at the end,
ln[(1 + d)/(1 - w d)] = d (1 + w), for any n. The dissipation number d for a restitution e therefore
solves this equation with w = e. The common relations are approximations of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal, TypeAlias

from vibroimpact.errors import InputError, shown

Relation: TypeAlias = Literal["exact", "hunt-crossley", "lankarani-nikravesh", "flores", "gonthier"]
"""Name of a relation between d and e."""

_SMALL = 0.25
"""d up to which a series stands for the logarithms, whose digits would cancel."""


def _exact(e: float) -> float:
    """Return the root d between 0 and 1/e of ln[(1 + d)/(1 - e d)] = d (1 + e)."""
    if e == 1.0:
        return 0.0
    from scipy.optimize import brentq

    def over_square(d: float) -> float:
        """Return the difference of both sides divided by d²; it increases through the root."""
        if d > _SMALL:
            return (math.log1p(d) - math.log1p(-e * d) - d * (1.0 + e)) / d**2
        total, power = -0.5 * (1.0 - e) * (1.0 + e), d
        for k in range(3, 32):
            total += (e**k - (-1.0) ** k) * power / k
            power *= d
        return total

    most = math.nextafter(1.0 / e, 0.0)
    while e * most >= 1.0:
        most = math.nextafter(most, 0.0)
    if over_square(most) <= 0.0:
        return most
    return float(brentq(over_square, 0.0, most, xtol=1e-300, rtol=1e-15))


RELATIONS: dict[str, Callable[[float], float]] = {
    "exact": _exact,
    "hunt-crossley": lambda e: 1.5 * (1.0 - e),
    "lankarani-nikravesh": lambda e: 0.75 * (1.0 - e) * (1.0 + e),
    "flores": lambda e: 1.6 * (1.0 - e) / e,
    "gonthier": lambda e: (1.0 - e) * (1.0 + e) / e,
}
"""d of e, by name. Hunt and Crossley, J. Appl. Mech. 42 (1975) 440; Lankarani and Nikravesh, J.
Mech. Des. 112 (1990) 369; Flores et al., Multibody Syst. Dyn. 25 (2011) 357; Gonthier et al.,
Multibody Syst. Dyn. 11 (2004) 209."""

_DIVIDE = ("exact", "flores", "gonthier")
"""Relations with which d grows without bound as e falls to 0."""


def dissipation_number(restitution: float, relation: str) -> float:
    """Return d for a restitution from 0 to 1.

    Raises
    ------
    InputError
        If the relation is unknown, or d is not finite.
    """
    if relation not in RELATIONS:
        *names, last = map(repr, RELATIONS)
        raise InputError(
            f"relation: {shown(relation)} is unknown; use {', '.join(names)} or {last}"
        )
    if relation in _DIVIDE and not restitution > 1e-300:
        others = " or ".join(repr(name) for name in RELATIONS if name not in _DIVIDE)
        raise InputError(
            f"restitution: {restitution:g} gives an infinite dissipation with the relation "
            f"{relation!r}; use a restitution greater than 0, or the relation {others}"
        )
    return RELATIONS[relation](restitution)
