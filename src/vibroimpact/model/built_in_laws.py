"""Read a law, and replace one that is defined by a formula by the built-in law with its force."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from vibroimpact.errors import InputError, shown
from vibroimpact.model.isolators import AnyIsolator, Isolator, PolynomialIsolator
from vibroimpact.model.own_law import Law
from vibroimpact.model.stops import Bumper, PowerBumper, Stop


def as_deformable(value: object, field: str) -> AnyIsolator | Stop:
    """Return an isolator or a stop that is not rigid."""
    if not isinstance(value, AnyIsolator | Stop):
        raise InputError(f"{field}: {shown(value)} is not a law; pass an isolator or a stop")
    if value.rigid:
        raise InputError(f"{field}: a rigid stop has no displacement; pass a deformable stop")
    return value


Deformable: TypeAlias = Annotated[AnyIsolator | Stop, as_deformable]
"""An isolator or a stop that is not rigid."""


def as_isolator(law: AnyIsolator) -> AnyIsolator:
    """Return the built-in isolator with the same force as a formula, or else the law itself.

    Raises
    ------
    InputError
        If the formula is the law of a stop.
    """
    if not isinstance(law, Law):
        return law
    if law.is_stop:
        raise InputError(
            "gap: an isolator has no gap; remove gap, and write the formula with u and v"
        )
    parts = law.parts
    if parts.rest:
        return law
    damping, exponent = (parts.square, 2.0) if parts.square else (parts.damping, 1.0)
    if parts.cubic or parts.quintic:
        return PolynomialIsolator(
            parts.stiffness, damping, parts.cubic, parts.quintic, damping_exponent=exponent
        )
    return Isolator(parts.stiffness, damping, damping_exponent=exponent)


def as_stop(law: Stop | None) -> Stop | None:
    """Return the built-in stop with the same force as a formula, or else the law itself.

    Raises
    ------
    InputError
        If the formula is the law of an isolator.
    """
    if not isinstance(law, Law):
        return law
    if law.gap is None:
        raise InputError(
            "gap: missing; the law of a stop requires a gap, so pass one such as '7.5 mm'"
        )
    parts = law.parts
    if not parts.rest and not (parts.damping and law.read.clipped):
        return Bumper(parts.stiffness, parts.damping, law.gap)
    if law.power is None:
        return law
    stiffness, exponent, dissipation = law.power
    return PowerBumper(stiffness, law.gap, exponent, dissipation=dissipation)
