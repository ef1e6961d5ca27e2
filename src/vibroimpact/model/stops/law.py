"""Base classes of the stops, which push and never pull."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import model_validator

from vibroimpact.errors import InputError
from vibroimpact.law_numbers import StopNumbers
from vibroimpact.model.integral import integral_of
from vibroimpact.model.law_registry import Named
from vibroimpact.model.own_law import Law
from vibroimpact.model.unknown_keys import listed
from vibroimpact.model.validation import Accepts, constructor, in_order


class StopLaw(Named):
    """Base class of the stops that a mass can hit.

    A new law has a ``kind``, its fields (one of them ``gap``) with their quantities and bounds,
    defines `engine_numbers`, `static_force` and `force`, and is an entry of `STOPS`. What it does
    not define is that of a deformable stop without memory. A law that is given by a formula is
    derived from `FormulaStop` instead, and needs no more than its fields and the formula; a rigid
    one, from `WallLaw`; one with a memory, from `StopWithMemory`.

    Attributes
    ----------
    gap
        Distance (m) from the mass at u = 0 to the stop at rest. A negative gap is a preload.
    """

    if TYPE_CHECKING:  # a field of each law, in its own place
        gap: float

    def engine_numbers(self) -> StopNumbers:
        """Return the numbers by which the engine follows the law."""
        raise NotImplementedError

    def static_force(self, deformation: float) -> float:
        """Return the force (N) of the stop at a slow deformation (m)."""
        raise NotImplementedError

    def stored_energy(self, deformation: float, memory: float | None = None) -> float:
        """Return the energy (J) that the stop gives back after a deformation (m).

        A law that remembers has a `memory` (m). Default: the deformation was slow.
        """
        return integral_of(self.static_force, deformation)

    def force(self, deformation: ArrayLike, velocity: ArrayLike) -> NDArray[np.float64]:
        """Return the force (N, at least 0) along a contact, which starts at the first sample.

        Parameters
        ----------
        deformation
            Deformation in m, at least 0.
        velocity
            Velocity of the deformation in m/s.
        """
        raise NotImplementedError

    @classmethod
    def like(
        cls, force: float, depth: float, gap: float, restitution: float, omega: float, mass: float
    ) -> Self | None:
        """Return such a stop that is about as strong as another one, if the law has an example.

        Parameters
        ----------
        force
            Static force in N at the deformation ``depth`` (m).
        gap
            Gap in m.
        restitution
            Coefficient of restitution, if the law has one.
        omega
            Natural frequency of the mass on its isolator in rad/s.
        mass
            Mass in kg.
        """
        return None

    @property
    def is_stop(self) -> bool:
        """Whether the law is a stop: always true."""
        return True

    @property
    def linear(self) -> bool:
        """Whether the motion is linear while nothing is hit or left."""
        return False

    @property
    def remembers(self) -> bool:
        """Whether the force also depends on a memory of the law's own."""
        return False

    def remembered(self, deformation: float) -> float:
        """Return the memory (m) of a deformation (m) that has lasted for long."""
        return 0.0

    @property
    def spring_and_dashpot(self) -> tuple[float, float] | None:
        """The pair (K_j, C_j) of a stop whose face relaxes after a contact; otherwise None."""
        return None

    @property
    def initial_damping(self) -> float:
        """Derivative of the force with respect to the velocity, at no deformation (N s/m)."""
        return self.spring_and_dashpot[1] if self.spring_and_dashpot else 0.0


class WallLaw(StopLaw):
    """Base class of the rigid stops, which return the mass at once, or hold it at rest.

    A new one has a ``kind``, its fields (one of them ``gap``), and `engine_numbers` that return a
    `Wall` with the name of a law of rebound; `engine.stops` describes the law.
    """

    @property
    def linear(self) -> bool:
        """Whether the motion between impacts stays linear: always true for a rigid wall."""
        return True

    @property
    def rigid(self) -> bool:
        """Whether the mass cannot pass the stop: always true."""
        return True


class StopWithMemory(StopLaw):
    """Base class of the deformable stops with a memory of their own.

    Only an `Assembly` can have them; an oscillator is an assembly of one mass. The memory is the
    deformation (m) at which the face stands while no body touches it. A new law has a ``kind``, its
    fields (one of them ``gap``), `static_force`, `force`, and `engine_numbers` that return a
    `MemoryStop` with the name of its formulas in ``engine/stops/memory_laws.py``; if the memory is
    not the deformation itself while the stop is pressed, also `remembered` and `stored_energy`.
    """

    @property
    def remembers(self) -> bool:
        """Whether the law has a memory: always true."""
        return True

    def remembered(self, deformation: float) -> float:
        """Return the memory (m) of a deformation (m) that has lasted for long."""
        return deformation


class FormulaStop(StopLaw):
    """Base class of the stops without memory whose force is given by a formula.

    A new law has a ``kind``, its fields and the ``formula``, in which ``d`` is the deformation (m),
    ``v`` its rate (m/s), and the other names are fields. The fields are the arguments of the
    class, in their order. For example::

        from typing import Annotated, ClassVar

        from vibroimpact.model.quantities import LENGTH, STIFFNESS, quantity
        from vibroimpact.model.stops.law import FormulaStop
        from vibroimpact.model.validation import Accepts

        class DragBumper(FormulaStop):
            kind: ClassVar[str] = "drag"
            formula: ClassVar[str] = "stiffness*d + drag*d**2*v"

            stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
            drag: Annotated[float, Accepts(quantity("N s/m^3"), minimum=0.0)]
            gap: Annotated[float, Accepts(LENGTH)]

    A negative force counts as 0. What a formula may contain is described in `Law`. A field may have
    the name of another law's with another unit; the path ``stops.NAME`` then sets equal laws only.

    With its entry in `STOPS`, study files, parameters by path, results, figures, the explorer and
    the tests of all laws have the law (``tests/model/test_registered_stop.py``). It needs no stored
    states in ``tests/reference/``, for it is a `Law`, bit for bit; test what is special to it. What
    does not follow:

    - the name ``vibroimpact.DragBumper``: lines in ``model/__init__.py``, ``__init__.pyi``,
      ``docs/reference/what-vibrates.md`` and the docstring of `Oscillator`;
    - a page in ``docs/laws/`` and its two lines in ``index.md``, its kind in
      ``docs/how-to/study-file.md``, and a line of the changes;
    - ``words``, if the explorer shall show another name than the kind.

    Type checkers know the arguments if the class has an ``__init__`` as that of `PowerBumper`.
    """

    formula: ClassVar[str]

    @constructor
    def __init__(self, /, *values: Any, **named: Any) -> None:
        names = in_order(type(self))
        if len(values) > len(names):
            raise InputError(
                f"{type(self).__name__}: {len(values)} values are passed by position, but it has "
                f"{len(names)} fields; pass {listed(names)}"
            )
        super().__init__(**dict(zip(names, values, strict=False)), **named)

    @classmethod
    def __pydantic_init_subclass__(cls, **options: Any) -> None:
        """Show the fields as the arguments of the class."""
        super().__pydantic_init_subclass__(**options)
        either, required = inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.empty
        cls.__signature__ = inspect.Signature(
            [
                inspect.Parameter(
                    name, either, default=required if field.is_required() else field.default
                )
                for name in in_order(cls)
                for field in [cls.model_fields[name]]
            ]
        )

    @model_validator(mode="after")
    def _can_be_followed(self) -> Self:
        _ = self.law
        return self

    @classmethod
    def like(
        cls, force: float, depth: float, gap: float, restitution: float, omega: float, mass: float
    ) -> Self | None:
        """Return such a stop with this force, whose terms are of about the same size."""
        known = {"gap": gap, "restitution": restitution, "mass": mass}
        numbers: dict[str, float] = {}
        powers: dict[str, float] = {}
        for name, field in cls.model_fields.items():
            accepts = next((one for one in field.metadata if isinstance(one, Accepts)), None)
            if accepts is None:
                continue
            quantity = accepts.of(numbers).quantity
            size = quantity.size(mass, depth, 1.0 / omega)
            numbers[name] = known.get(name, size)
            powers[name] = 0.0 if name in known else dict(quantity.base).get("kilogram", 0.0)
        try:
            now = cls(**numbers).static_force(depth)
            return cls(**{name: n * (force / now) ** powers[name] for name, n in numbers.items()})
        except (InputError, ArithmeticError):
            return None

    @property
    def law(self) -> Law:
        """The law that a user would have written."""
        fields = {name: value for name, value in self if name != "gap"}
        return Law(f"max({self.formula}, 0)", self.gap, **fields)

    @property
    def initial_damping(self) -> float:
        """Derivative of the force with respect to the velocity, at no deformation (N s/m)."""
        return self.law.initial_damping

    def engine_numbers(self) -> StopNumbers:
        """Return the numbers by which the engine follows the formula."""
        return self.law.engine_numbers()

    def static_force(self, deformation: float) -> float:
        """Return the force (N) of the stop at a slow deformation (m)."""
        return self.law.static_force(deformation)

    def force(self, deformation: ArrayLike, velocity: ArrayLike) -> NDArray[np.float64]:
        """Return the force (N, at least 0) along a contact."""
        return self.law.force(deformation, velocity)
