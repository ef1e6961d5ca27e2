"""The state of an oscillator or an assembly, from which a motion can be started or resumed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from numbers import Integral
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, model_validator

from vibroimpact.errors import InputError, shown
from vibroimpact.model.assembly.state import AssemblyState
from vibroimpact.model.frozen_mapping import FrozenMapping
from vibroimpact.model.quantities import ANGLE, LENGTH, VELOCITY
from vibroimpact.model.validation import Accepts, Model, takes_fields

_BOTH = ("displacement", "velocity")
_BY_NAME = ("memory", "touching")
"""Values that only the state of an assembly has."""
_INSTEAD = {"contact": "touching", "isolator": "memory"}
_SIDES = ("right", "left")
_DEFORMATION = Accepts(LENGTH, minimum=0.0)


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
    """The state of an oscillator, or of an assembly by names, at one instant.

    Numbers make the state of an `Oscillator`. Mappings from names make that of an `Assembly`, as in
    ``State({"base": "1 cm"}, {"roof": 0.1}, deformation={"moat": "2 mm"})``. A mass that is not
    named is at u = 0, and at rest.

    The deformations of the bumpers are part of the state: after the mass has left a bumper, the
    bumper is still deformed and relaxes.

    If the mass is at the face of an undeformed stop and moves towards it, the contact begins at
    this instant, and `simulate` lists it. If ``contact`` states that the mass touches the stop, the
    contact has begun before.

    Parameters
    ----------
    displacement
        Displacement u in m, relative to the base; or a mapping from masses to displacements.
    velocity
        Velocity u̇ in m/s, relative to the base; or a mapping from masses to velocities.
    deformation
        Mapping from stops ("right" and "left", or the names of an assembly's stops) to their
        deformations in m, at least 0. A stop that is not named is undeformed, or compressed as far
        as the displacement exceeds the gap. For a stop without memory (any other stop than a
        `Bumper`) of an oscillator the value has another meaning while the stop is compressed: the
        speed in m/s at the start of the contact. If the stop has a coefficient of restitution, this
        speed determines its dissipation.
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
    memory
        For an assembly: mapping from hysteretic links to their internal variables in m. Default: 0.
    touching
        For an assembly: names of the stops whose bodies touch. Default: deduced from the
        displacements and the deformations.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or has a wrong sign. Also if values of an
        oscillator and of an assembly are passed together.
    """

    _quiet: ClassVar[Mapping[str, Any]] = {"deformation": {}, "isolator": 0.0}

    displacement: Annotated[float, Accepts(LENGTH)] = 0.0
    velocity: Annotated[float, Accepts(VELOCITY)] = 0.0
    deformation: FrozenMapping[float] = FrozenMapping()
    phase: Annotated[float | None, Accepts(ANGLE, optional=True)] = None
    contact: Annotated[Literal[-1, 0, 1, 2] | None, BeforeValidator(_contact)] = None
    isolator: Annotated[float, Accepts(LENGTH)] = 0.0

    @model_validator(mode="before")
    @classmethod
    def _by_side(cls, data: Any) -> Any:
        """Read deformations by side; a side that is None is deduced, as if it were left out."""
        if not isinstance(data, Mapping):
            return data
        table = data.get("deformation")
        table = {} if table is None else table
        if not isinstance(table, Mapping):
            raise InputError(
                f"deformation: {shown(table)} is not a mapping from stops; pass deformations such "
                'as {"right": "2 mm"}'
            )
        by_side = {}
        for side, value in table.items():
            if side not in _SIDES:
                raise InputError(
                    f"deformation.{side}: this is not a stop of an Oscillator; use right or left"
                )
            if value is not None:
                by_side[str(side)] = _DEFORMATION.at(value, f"deformation.{side}")
        known = FrozenMapping({side: by_side[side] for side in _SIDES if side in by_side})
        return {**data, "deformation": known}

    def __new__(cls, *args: Any, **values: Any) -> Any:
        """Return the state of an assembly if values are mappings from names."""
        arguments = dict(zip(cls.model_fields, args, strict=False)) | values
        by_name = [key for key in _BY_NAME if arguments.get(key) is not None]
        by_name += [key for key in _BOTH if isinstance(arguments.get(key), Mapping)]
        stops = arguments.get("deformation")
        if isinstance(stops, Mapping) and not {*stops} <= {*_SIDES} and not {*arguments} & {*_BOTH}:
            by_name.append("deformation")
        if cls is not State or not by_name:
            return super().__new__(cls)
        for key in arguments:
            if key not in (*_BOTH, "deformation", *_BY_NAME, "phase"):
                other = _INSTEAD.get(key)
                use = f"use {other}" if other else f"remove {key}"
                raise InputError(
                    f"{key}: passed together with {by_name[0]} by name, which is for an Assembly; "
                    f"{use}, or pass numbers for an Oscillator"
                )
        return AssemblyState(**arguments)

    @takes_fields
    def __init__(
        self,
        displacement: float | str | Mapping[str, float | str] = 0.0,
        velocity: float | str | Mapping[str, float | str] = 0.0,
        deformation: Mapping[str, float | str | None] | None = None,
        phase: float | str | None = None,
        contact: int | None = None,
        isolator: float | str = 0.0,
        *,
        memory: Mapping[str, float | str] | None = None,
        touching: Iterable[str] | None = None,
    ) -> None: ...
