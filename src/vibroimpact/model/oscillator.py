"""The vibrating mass, its isolator and its two stops (the paper's Fig. 1).

For the linear isolator the equation of motion is
``M ü + C u̇ + K u + (contact force) = -M A_t(t)``, where ``u`` is the displacement relative to the
base. The other isolators have their own forces. A stop can push the mass, but not pull it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Self, cast

import numpy as np
from pydantic import (
    Field,
    SerializerFunctionWrapHandler,
    ValidationInfo,
    field_validator,
    model_serializer,
    model_validator,
)

from vibroimpact.errors import InputError
from vibroimpact.model.built_in_laws import as_isolator, as_stop
from vibroimpact.model.isolators import ISOLATORS, AnyIsolator, Isolator, IsolatorLaw
from vibroimpact.model.isolators.design import designed
from vibroimpact.model.quantities import FORCE, GRAVITY, LENGTH, MASS
from vibroimpact.model.stated_units import check_no_units, has_unit, values_of
from vibroimpact.model.stops import STOPS, Bumper, JankowskiBumper, Stop, WallLaw
from vibroimpact.model.stops.bumper import returning
from vibroimpact.model.system import PartNames, System, Units
from vibroimpact.model.units import pretty, to_si
from vibroimpact.model.validation import Accepts, takes_fields
from vibroimpact.model.written_units import NONE, SI, written_for

if TYPE_CHECKING:
    from vibroimpact.model.excitation import Repeated

SIDES = ("right", "left")
"""Names of the stops of an oscillator, in the order of results."""
_LEAST, _MOST = 1e-50, 1e50
"""Natural frequencies (rad/s) and damping ratios whose powers are floating-point numbers."""


class Oscillator(System):
    """A mass on an isolator, with a stop on each side. The stops may differ, or be absent.

    Parameters
    ----------
    mass
        Mass M in kg, greater than 0; or a string such as ``"550 kg"``. In the table of a study
        file, ``weight`` may replace the mass. It is the weight M g in N, or a string such as
        ``"50 MN"``.
    isolator
        An `Isolator`, `FrictionIsolator`, `BilinearIsolator`, `PolynomialIsolator`,
        `BoucWenIsolator`, `ExponentialIsolator` or `Law`. A mapping with the fields of such an
        object is also accepted. It must have the key ``kind`` if the isolator is not linear. It may
        have the arguments of ``from_period`` or ``from_strength`` (without the mass) instead of the
        fields. Default: no isolator, that is, ``Isolator(0, 0)``; then a stop must hold the mass.
    right
        Stop at positive displacement: a `Bumper`, `RigidStop`, `PowerBumper`, `JankowskiBumper`, or
        a `Law` with a gap. A mapping with the fields of such an object is also accepted. It must
        have the key ``kind`` if the stop is not a `Bumper`. For a `Bumper`, it may have the
        coefficient of restitution of this mass, ``restitution``, instead of the damping. Default:
        None, no stop.
    left
        Stop at negative displacement, as for ``right``.
    force
        Constant force on the mass in N, positive to the right; or a string such as ``"-5.4 kN"``.
        Examples are the weight of the mass and wind. Default: 0.
    units
        ``"SI"``, or ``"none"`` if the numbers are dimensionless. Results of a rig without units are
        printed and drawn without units, and with the angular frequency ω = 2π f. Default:
        ``"none"`` if the mass and the initial stiffness are 1 and no unit is stated; otherwise
        ``"SI"``.

    Raises
    ------
    InputError
        If a value is invalid. The message contains the path of the value, such as ``right.gap``.
        Also if two rigid stops leave no room for the mass, or if no spring and no stop balances the
        constant force.
    """

    table_name = "oscillator"
    by_mass = False
    _quiet: ClassVar[Mapping[str, Any]] = {"force": 0.0}

    mass: Annotated[float, Accepts(MASS, above=0.0)]
    isolator: Annotated[AnyIsolator, ISOLATORS] = Isolator(0.0, 0.0)
    right: Annotated[Stop | None, STOPS] = None
    left: Annotated[Stop | None, STOPS] = None
    force: Annotated[float, Accepts(FORCE, meaning="constant force on the mass")] = 0.0
    units: Units = Field(default=cast("Units", None), validate_default=True)

    @takes_fields
    def __init__(
        self,
        mass: float | str,
        isolator: AnyIsolator | Mapping[str, Any] | None = None,
        right: Stop | Mapping[str, Any] | None = None,
        left: Stop | Mapping[str, Any] | None = None,
        force: float | str = 0.0,
        units: Units | None = None,
    ) -> None: ...

    @classmethod
    def _table_keys(cls) -> list[str]:
        """Return the keys that the table of an oscillator may have."""
        return [*super()._table_keys(), "weight"]

    @model_validator(mode="before")
    @classmethod
    def _weighed(cls, data: Any) -> Any:
        if not isinstance(data, Mapping) or "weight" not in data:
            return data
        if "mass" in data:
            raise InputError("weight: given together with mass; remove one of the two")
        rest = {name: value for name, value in data.items() if name != "weight"}
        return {"mass": _mass_of(data["weight"]), **rest}

    @model_validator(mode="before")
    @classmethod
    def _stated_units(cls, data: Any) -> Any:
        """Let a value with a unit decide about the units of the rig."""
        if not isinstance(data, Mapping):
            return data
        units = data.get("units")
        if units is None:  # recognised below, so that it does not count as stated
            data = {name: value for name, value in data.items() if name != "units"}
        if units == NONE:
            check_no_units(data)
        elif units is None and _is_one(data.get("mass")):
            stated = any(has_unit(value) for _, value in values_of(data))
            return {**data, "units": SI} if stated else data
        return data

    @field_validator("units", mode="before")
    @classmethod
    def _recognised_units(cls, value: Any, info: ValidationInfo) -> Any:
        if value is not None:
            return value
        mass, isolator = info.data.get("mass"), info.data.get("isolator")
        ones = mass == 1.0 and isolator is not None and isolator.initial_stiffness == 1.0
        return NONE if ones else SI

    @field_validator("isolator", mode="before")
    @classmethod
    def _for_this_mass(cls, value: Any, info: ValidationInfo) -> Any:
        if value is None:
            return Isolator(0.0, 0.0)
        law = ISOLATORS.classes.get(ISOLATORS.kind_of(value))
        if not isinstance(value, Mapping) or law is None:
            return value
        if not issubclass(law, IsolatorLaw):
            return value
        return designed(value, law, info.data.get("mass"))

    @field_validator("right", "left", mode="before")
    @classmethod
    def _returning_this_mass(cls, value: Any, info: ValidationInfo) -> Any:
        if not isinstance(value, Mapping) or STOPS.kind_of(value) != Bumper.kind:
            return value
        return returning(value, info.data.get("mass"))

    @field_validator("isolator", mode="after")
    @classmethod
    def _built_in_isolator(cls, value: AnyIsolator) -> AnyIsolator:
        return as_isolator(value)

    @field_validator("right", "left", mode="after")
    @classmethod
    def _hit_by_a_mass(cls, value: Stop | None) -> Stop | None:
        if isinstance(value, JankowskiBumper) and value.mass is None:
            raise InputError(
                'mass: missing; pass the mass that hits this stop, such as "550 kg" (only an '
                "Assembly fills it in)"
            )
        return value

    @field_validator("right", "left", mode="after")
    @classmethod
    def _built_in_stop(cls, value: Stop | None) -> Stop | None:
        return as_stop(value)

    @model_validator(mode="after")
    def _frequency_exists(self) -> Self:
        # Each may be moderate while their ratio is not.
        k, m = self.isolator.initial_stiffness, self.mass
        if k == 0.0:
            return self
        for what, size, least, unit in (
            ("natural angular frequency", math.sqrt(k / m), _LEAST, " rad/s"),
            ("damping ratio", self.isolator.damping / math.sqrt(k * m), 0.0, ""),
        ):
            if what == "damping ratio" and self.isolator.damping_exponent != 1.0:
                continue
            if not least <= size <= _MOST:
                raise InputError(
                    f"mass {m:g} kg, stiffness {k:g} N/m and damping {self.isolator.damping:g} "
                    f"N s/m: the {what} is about {size:.0e}{unit}, but only values from "
                    f"{least:g} to {_MOST:g}{unit} can be computed; correct the three values"
                )
        return self

    @model_validator(mode="after")
    def _held(self) -> Self:
        """Check that a spring, friction or stops hold the mass against the constant force."""
        strongest = self.isolator.strongest
        against = self.right if self.force > 0.0 else self.left
        slips = self.force != 0.0 and abs(self.force) >= strongest
        if (slips and against is None) or (strongest == 0.0 and not self.stops):
            side = "right" if self.force > 0.0 else "left"
            pushed = f" against a force of {pretty(self.force, FORCE)}" if self.force else ""
            bound, remedy = (
                ("isolator.stiffness: 0, and nothing", "use a stiffness greater than 0")
                if strongest == 0.0
                else (
                    f"force: the isolator bears less than {pretty(strongest, FORCE)}, and no stop",
                    "reduce the force",
                )
            )
            raise InputError(
                f"{bound} holds the mass{pushed}; {remedy}, or add a "
                f"{f'{side} stop' if self.force else 'stop'}"
            )
        return self

    @model_validator(mode="after")
    def _stops_of_one_mass(self) -> Self:
        for side, stop in self.stops.items():
            if stop.remembers:
                raise InputError(
                    f"{side}: a {type(stop).__name__} is a stop of assemblies only; use an "
                    "Assembly of one mass, or [assembly] in a study file"
                )
        return self

    @model_validator(mode="after")
    def _room_between_walls(self) -> Self:
        if isinstance(self.right, WallLaw) and isinstance(self.left, WallLaw):
            right, left = self.right.gap, self.left.gap
            if not right + left > 0.0:
                raise InputError(
                    f"right.gap: {pretty(right, LENGTH)} and left.gap: {pretty(left, LENGTH)} "
                    "leave no room between two rigid stops; use gaps with a sum greater than 0"
                )
        return self

    @property
    def names(self) -> tuple[str, ...]:
        """Name of the mass."""
        return ("mass",)

    @property
    def stops(self) -> dict[str, Stop]:
        """The stops that exist, by their sides, with the right stop first."""
        both = {"right": self.right, "left": self.left}
        return {side: stop for side, stop in both.items() if stop is not None}

    @property
    def stop_laws(self) -> dict[str, Stop]:
        """The same as `stops`."""
        return self.stops

    @property
    def counted_stops(self) -> tuple[str, ...]:
        """Both sides."""
        return SIDES

    @property
    def part_names(self) -> PartNames:
        """Names of the stops that exist, by the dim ``stop``."""
        return {"stop": np.array(list(self.stops), dtype="<U5")}

    @property
    def angular_frequency(self) -> float:
        """Undamped natural angular frequency without stops, ω0 = √(K/M), in rad/s. It may be 0.

        K is the ``initial_stiffness`` of the isolator, which applies to small motions.
        """
        return math.sqrt(self.isolator.initial_stiffness / self.mass)

    @property
    def natural_frequency(self) -> float:
        """Undamped natural frequency without stops, ω0/2π, in Hz.

        Raises
        ------
        InputError
            If the isolator has no stiffness.
        """
        self._springs("natural frequency")
        return self.angular_frequency / math.tau

    @property
    def damping_ratio(self) -> float:
        """Damping factor of the isolator, ξ = C/(2√(K M)) (the paper's Section 7).

        It describes the dashpot in small motions. Friction and yielding dissipate additional
        energy.

        Raises
        ------
        InputError
            If the isolator has no stiffness, or if its damping exponent is not 1.
        """
        return self.isolator.damping / self.critical_damping

    @property
    def critical_damping(self) -> float:
        """Damping at which the damping ratio is 1, 2√(K M), in N s/m.

        Raises
        ------
        InputError
            As in `damping_ratio`.
        """
        self._springs("damping ratio")
        if self.isolator.damping_exponent != 1.0:
            raise InputError(
                f"isolator.damping_exponent: {self.isolator.damping_exponent:g}; the damping ratio "
                "would depend on the velocity, so it is undefined; use the exponent 1"
            )
        return 2.0 * math.sqrt(self.isolator.initial_stiffness * self.mass)

    def _springs(self, what: str) -> None:
        if self.isolator.initial_stiffness == 0.0:
            instead = "frequencies in Hz" if what == "natural frequency" else "the damping itself"
            raise InputError(
                f"isolator.stiffness: 0, so there is no {what}; use a stiffness greater than 0, or "
                f"pass {instead}"
            )

    @property
    def linear(self) -> bool:
        """Whether all forces are linear in flight and during contact.

        This is true for an `Isolator` whose damping exponent is 1, with stops that are a `Bumper`
        or a `RigidStop`.
        """
        return self.isolator.linear and all(one.linear for one in self.stops.values())

    def _acted_on_by(self, shaking: Repeated) -> Repeated:
        """Return an excitation, which acts on the only mass, and must not name one."""
        if shaking.on is not None:
            raise InputError(
                f"shaking.on: {shaking.on!r}, but an Oscillator has only one mass; remove on"
            )
        return shaking

    def check_linear(self, what: str, stops: bool = True) -> None:
        """Raise an error if the law of the isolator or of a stop is not linear.

        Raises
        ------
        InputError
            If the law of the isolator is not linear, or, with ``stops``, if the law of a stop is
            not linear. The message states that such a law does not have ``what``.
        """
        parts = {"isolator": self.isolator, "right": self.right, "left": self.left}
        for name, part in parts.items():
            if part is None or part.linear or (name != "isolator" and not stops):
                continue
            law = part.kind if part.kind != "linear" else "a dashpot with an exponent"
            linear = "a linear Isolator" if name == "isolator" else "a Bumper or a RigidStop"
            raise InputError(
                f"{name}: its law, {law}, is not linear, so it has no {what}; use {linear}"
            )

    @property
    def symmetric(self) -> bool:
        """Whether the oscillator is its own mirror image."""
        return self.right == self.left and self.force == 0.0

    def _read(self) -> Iterator[tuple[str, Any, str]]:
        with written_for(self):
            yield from list(super()._read())

    def rows(self) -> list[tuple[str, str]]:
        """Return the paths of the fields and their values, with units unless the rig has none."""
        with written_for(self):
            return super().rows()

    def _unsaid(self, name: str | None, value: Any) -> bool:
        if name == "units":  # what would be recognised anyway
            return bool(value == SI and not self.of_ones)
        return super()._unsaid(name, value)

    @model_serializer(mode="wrap")
    def _dumped(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        table: dict[str, Any] = handler(self)
        if self._unsaid("units", self.units):
            del table["units"]
        return table

    @property
    def of_ones(self) -> bool:
        """Whether the mass and the initial stiffness of the isolator are 1."""
        return self.mass == self.isolator.initial_stiffness == 1.0

    @property
    def may_have_units(self) -> bool:
        """Whether a unit stated elsewhere makes a rig without units one in SI units.

        False if ``units`` was passed.
        """
        return self.of_ones and "units" not in self.model_fields_set

    def replace(self, **changes: Any) -> Self:
        """Return a copy with some fields changed. It is validated like a new object.

        A ``weight`` replaces the mass. Units that were recognised stay so, and a unit that is
        stated later may still correct them.

        Raises
        ------
        InputError
            If a field is unknown, or if its new value is invalid.
        """
        if "weight" in changes and "mass" not in changes:
            changes["mass"] = _mass_of(changes.pop("weight"))
        made = super().replace(**changes)
        if not {"units"} & (self.model_fields_set | changes.keys()):
            made.model_fields_set.discard("units")
        return made

    def mirrored(self) -> Oscillator:
        """Return the mirror image: the stops are exchanged, and the constant force is reversed."""
        return self.replace(right=self.left, left=self.right, force=-self.force + 0.0)

    def without_bumpers(self) -> Oscillator:
        """Return a copy with the same mass and isolator, but without stops."""
        return self.replace(right=None, left=None)


def _mass_of(weight: object) -> float:
    return to_si(weight, FORCE, "weight", above=0.0) / GRAVITY


def _is_one(mass: object) -> bool:
    try:
        return to_si(mass, MASS, "mass") == 1.0
    except InputError:  # reported with the field
        return False
