"""The state of an oscillator, from which a motion starts or is resumed."""

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
        f"{shown(value)} is not a side; -1 (left), 0 (none), 1 (right) or 2 (both) is accepted"
    )


class State(Model):
    """The state of an oscillator at one instant.

    The deformation of a bumper belongs to the state because it outlasts the contact: a bumper that
    the mass has left is still relaxing.

    Parameters
    ----------
    displacement
        u in m, relative to the base.
    velocity
        u̇ in m/s, relative to the base.
    right_bumper
        Deformation u_R in m of the right bumper, at least 0. None: at rest, or pressed by
        the mass if the displacement exceeds the gap. For a compressed stop without memory: the
        speed in m/s at the start of the contact, which determines the dissipation if the stop has a
        restitution.
    left_bumper
        Deformation u_L in m of the left bumper, at most 0. None: as for the right one.
    phase
        Phase of the excitation at this instant in rad. None: the excitation's own.
    contact
        Stop that the mass touches: -1 left, 0 none, 1 right, 2 both. None: deduced from the
        displacement and the deformations.
    isolator
        Memory of a hysteretic isolator, in m: the deformation z of its elastic part, the z of Bouc
        and Wen, or, for the exponential model, the hysteretic force divided by k_a - k_b.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or a wrong sign.
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
