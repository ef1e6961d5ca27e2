"""The state of an oscillator, from which a motion can be started or resumed."""

from __future__ import annotations

from collections.abc import Mapping
from numbers import Integral
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator

from vibroimpact.errors import InputError, shown
from vibroimpact.model.quantities import ANGLE, LENGTH, VELOCITY
from vibroimpact.model.validation import Accepts, Model, constructor


def _contact(value: Any) -> int | None:
    if value is None:
        return None
    if getattr(value, "ndim", None) == 0 and hasattr(value, "item"):
        value = value.item()  # a numpy scalar or an array of no dimension
    is_number = isinstance(value, Integral | float) and not isinstance(value, bool)
    if is_number and value in (-1, 0, 1, 2):
        return int(value)
    raise InputError(
        f"{shown(value)} is not a stop; pass -1 (left stop), 0 (no contact), 1 (right stop) or "
        "2 (both stops)"
    )


class State(Model):
    """The state of an oscillator at one instant.

    The deformations of the bumpers are part of the state: after the mass has left a bumper, the
    bumper is still deformed and relaxes.

    If the mass is at the face of an undeformed stop and moves towards it, the contact begins at
    this instant, and `simulate` lists it. If ``contact`` states that the mass touches the stop, the
    contact has begun before.

    Parameters
    ----------
    displacement
        Displacement u in m, relative to the base.
    velocity
        Velocity u̇ in m/s, relative to the base.
    right_bumper
        Deformation u_R of the right bumper in m, at least 0. Default: the bumper is undeformed, or
        compressed by the mass if the displacement exceeds the gap. For a stop without memory (any
        other stop than a `Bumper`) the value has another meaning while the stop is compressed: the
        speed in m/s at the start of the contact. If the stop has a coefficient of restitution, this
        speed determines its dissipation.
    left_bumper
        Deformation u_L of the left bumper in m, at most 0. Default: as for the right bumper.
    phase
        Phase of the excitation at this instant, in rad. Default: the initial phase of the
        excitation.
    contact
        Stop that the mass touches: -1 (left), 0 (none), 1 (right) or 2 (both). Default: deduced
        from the displacement and the deformations.
    isolator
        Internal variable (memory) of a hysteretic isolator, in m. For the bilinear isolator it is
        the deformation z of the elastic part. For the Bouc-Wen model it is z. For the exponential
        model it is the hysteretic force divided by k_a - k_b.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or has a wrong sign.
    """

    _quiet: ClassVar[Mapping[str, Any]] = {"isolator": 0.0}

    displacement: Annotated[float, Accepts(LENGTH)] = 0.0
    velocity: Annotated[float, Accepts(VELOCITY)] = 0.0
    right_bumper: Annotated[float | None, Accepts(LENGTH, minimum=0.0, optional=True)] = None
    left_bumper: Annotated[float | None, Accepts(LENGTH, maximum=0.0, optional=True)] = None
    phase: Annotated[float | None, Accepts(ANGLE, optional=True)] = None
    contact: Annotated[Literal[-1, 0, 1, 2] | None, BeforeValidator(_contact)] = None
    isolator: Annotated[float, Accepts(LENGTH)] = 0.0

    @constructor
    def __init__(
        self,
        displacement: float | str = 0.0,
        velocity: float | str = 0.0,
        right_bumper: float | str | None = None,
        left_bumper: float | str | None = None,
        phase: float | str | None = None,
        contact: int | None = None,
        isolator: float | str = 0.0,
    ) -> None:
        super().__init__(
            displacement=displacement,
            velocity=velocity,
            right_bumper=right_bumper,
            left_bumper=left_bumper,
            phase=phase,
            contact=contact,
            isolator=isolator,
        )
