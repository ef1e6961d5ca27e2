"""A law of an isolator or of a stop that the user defines by a formula."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import SerializerFunctionWrapHandler, model_serializer, model_validator

from vibroimpact.errors import InputError, shown, warn_of_input
from vibroimpact.law_numbers import (
    SYMBOLS,
    IsolatorNumbers,
    OwnStop,
    PowerLaw,
    Program,
    pack,
)
from vibroimpact.model.formula import (
    ARGUMENTS,
    FUNCTIONS,
    ODD,
    Dimension,
    Formula,
    FormulaNode,
    read_formula,
)
from vibroimpact.model.formula_terms import (
    check_divisors,
    everywhere,
    monomial,
    operations,
    parity,
    terms,
)
from vibroimpact.model.formula_units import check_numbers, units_of_numbers
from vibroimpact.model.integral import integral_of
from vibroimpact.model.law_registry import Named
from vibroimpact.model.quantities import DIMENSIONLESS, LENGTH, STIFFNESS, TIME, Quantity
from vibroimpact.model.units import plain, pretty, to_si_of_any
from vibroimpact.model.validation import Accepts, takes_fields

_RESERVED = {*ARGUMENTS, *FUNCTIONS, "max", "u", "v", "d"}


class FormulaParts(NamedTuple):
    """The terms of a formula: those that built-in laws have, and the others."""

    stiffness: float
    damping: float
    cubic: float
    quintic: float
    square: float
    """Coefficient c of a drag c v |v|. It is used only if there is no other damping."""
    rest: tuple[tuple[float, FormulaNode], ...]
    """The other terms, each with its sign."""


class Law(Named):
    """A law of an isolator or of a stop that is defined by a formula.

    Without a ``gap``, the law is an isolator. Its force is a formula of ``u`` (m) and ``v`` (m/s),
    the displacement and the velocity of the mass relative to the base. If ``u`` and ``v`` change
    their signs, the force must change its sign, too.

    With a ``gap``, the law is a stop. Its force is a formula of ``d`` (m), the penetration depth of
    the mass, and of ``v`` (m/s), the rate of ``d``. Where the formula is not greater than 0, the
    force is 0: a stop can push, but not pull. The formula ``k*d + c*v`` is that of a `Bumper`,
    whose face keeps its deformation after a contact and relaxes. ``max(k*d + c*v, 0)`` has no such
    memory: the face follows the mass.

    A formula may contain the operations ``+ - * / **`` and the functions exp, sqrt, sinh, cosh,
    tanh, sin, cos and abs. The argument of abs must be ``u`` or ``v``. The formula is parsed, and
    is never run as code. If a built-in law has the same term, the term gives the same result, bit
    for bit.

    In a study file, its ``kind`` is ``"formula"``.

    Parameters
    ----------
    formula
        Formula of the force in N, such as ``"k*u + k3*u**3 + c*v"``.
    gap
        For a stop: distance from the mass at u = 0 to the undeformed stop, in m; or a string such
        as ``"7.5 mm"``. Default: None, for an isolator.
    **numbers
        Values of the names in the formula. A string with a unit, such as ``k="26 kN/m"``, is
        checked against the units of the formula. A plain number is in SI units. A number cannot
        have the name of a variable, of a function or of a field of this class, such as ``gap``.

    Raises
    ------
    InputError
        If the formula cannot be read, or if it contains a name without a value. Also if its units
        do not agree, or if a divisor may become 0. The message states the column of the error.

    Warns
    -----
    InputWarning
        If the formula of a stop is ``k*d + c*v``, because this stop has a memory.

    Examples
    --------
    >>> softening = Law("k*u/(1 + abs(u)/a) + c*v", k="26 kN/m", a="5 cm", c="1 kN s/m")
    >>> round(softening.static_force(0.05), 6)
    650.0
    """

    kind: ClassVar[str] = "formula"
    designs: ClassVar[tuple[str, ...]] = ()
    damping_exponent: ClassVar[float] = 1.0

    formula: str
    if TYPE_CHECKING:
        gap: float  # None of an isolator, which no code asks for its gap
    else:
        gap: Annotated[float | None, Accepts(LENGTH, optional=True)] = None
    numbers: tuple[tuple[str, float], ...] = ()

    @takes_fields
    def __init__(
        self, /, formula: str, gap: float | str | None = None, **numbers: float | str
    ) -> None: ...

    @model_validator(mode="before")
    @classmethod
    def _read_formula(cls, data: Any) -> Any:
        if not isinstance(data, Mapping) or "formula" not in data:
            return data
        kept = {name: value for name, value in data.items() if name in ARGUMENTS}
        numbers = kept.pop("numbers", ())
        if not isinstance(numbers, tuple):  # which a law passes on; a user has no such argument
            raise _misnamed("numbers")
        pairs: dict[str, tuple[float, Dimension]] = {name: (value, None) for name, value in numbers}
        for name, value in data.items():
            if name in ARGUMENTS:
                continue
            if not str(name).isidentifier() or name in _RESERVED:
                raise _misnamed(name)
            pairs[name] = to_si_of_any(value, name)
        is_stop = kept.get("gap") is not None
        check_numbers(kept["formula"], pairs, data, _variables(is_stop))
        read = read_formula(kept["formula"], pairs, _variables(is_stop))
        check_divisors(read, not is_stop)
        if not is_stop:
            _check_odd(read)
        numbers = tuple((name, value) for name, (value, _) in pairs.items())
        if time := _relaxation_time(read.text, numbers, is_stop):
            warn_of_input(
                f"formula {read.text!r}",
                [
                    "it is the law of a Bumper, which has a memory: after a contact, its face "
                    f"relaxes in {pretty(time, TIME)}; for a force without memory, write "
                    f"max({read.text}, 0); if the memory is intended, use Bumper"
                ],
            )
        return {**kept, "formula": read.text, "numbers": numbers}

    @model_validator(mode="after")
    def _can_be_followed(self) -> Law:
        stiffness = self.initial_stiffness
        if not 0.0 <= stiffness < math.inf:
            raise InputError(
                f"formula: its stiffness at rest is {pretty(stiffness, STIFFNESS)}; change its "
                "numbers, so that this stiffness is finite and at least 0"
            )
        if self.is_stop and self.power is None:
            _check_whole(self.read)
        if self.power is None:
            _ = self.operations
        return self

    @model_serializer(mode="wrap")
    def _with_its_kind(self, fields: SerializerFunctionWrapHandler) -> dict[str, Any]:
        gap = {} if self.gap is None else {"gap": self.gap}
        return {"kind": self.kind, "formula": self.formula, **gap, **dict(self.numbers)}

    def __repr_args__(self) -> Any:
        yield "formula", self.formula
        if self.gap is not None:
            yield "gap", self.gap
        yield from self.numbers

    def rows(self) -> list[tuple[str, str]]:
        """Return kind, formula, numbers and gap, as pairs of name and text.

        A number whose unit does not follow from the formula is in SI units.
        """
        gap = [] if self.gap is None else [("gap", pretty(self.gap, LENGTH))]
        known = self.quantities
        named = [
            (name, pretty(value, known[name]) if name in known else plain(value))
            for name, value in self.numbers
        ]
        time = self.relaxation_time
        memory = [("memory", f"{pretty(time, TIME)}, as a Bumper")] if time else []
        return [("kind", self.kind), ("formula", self.formula), *named, *gap, *memory]

    def __str__(self) -> str:
        parts = [f"{name}={text}" for name, text in self.rows()[1:]]
        return f"Law({', '.join(parts)})"

    @property
    def is_stop(self) -> bool:
        """Whether the law is a stop."""
        return self.gap is not None

    @property
    def quantities(self) -> dict[str, Quantity]:
        """The quantities of the numbers, as far as the units of the formula determine them."""
        return units_of_numbers(self.formula, self.numbers, _variables(self.is_stop))

    def knobs(self) -> dict[str, tuple[float, Accepts]]:
        """Return the gap and the numbers of the formula, with what they accept."""
        quantities = self.quantities
        numbers = {
            name: (
                value,
                Accepts(
                    quantities.get(name, DIMENSIONLESS), meaning=f"number {name} in the formula"
                ),
            )
            for name, value in self.numbers
        }
        return {**super().knobs(), **numbers}

    @property
    def read(self) -> Formula:
        """The formula, parsed."""
        return _parsed(self.formula, self.numbers, self.is_stop)

    @property
    def parts(self) -> FormulaParts:
        """The terms that built-in laws have, and the other terms."""
        return _parts(self.formula, self.numbers, self.is_stop)

    @property
    def power(self) -> tuple[float, float, float | None] | None:
        """The numbers k, n and χ if the force of a stop is k dⁿ (1 + χ v), or k dⁿ (χ is None)."""
        if not self.is_stop:
            return None
        (sign, term), *others = terms(self.read.tree)
        return None if others or sign < 0.0 else _power(term)

    @property
    def relaxation_time(self) -> float:
        """Time constant c/k (s) with which the face of a stop k d + c v relaxes; otherwise 0.

        The stop is a `Bumper`. A force max(k d + c v, 0) has no such memory.
        """
        return _relaxation_time(self.formula, self.numbers, self.is_stop)

    @property
    def operations(self) -> tuple[list[str | int], list[float]]:
        """The operations that the engine evaluates, in reverse Polish notation, and their numbers.

        For an isolator, this part contains the terms that built-in laws do not have. For a stop, it
        contains all terms.
        """
        read = self.read
        return operations(terms(read.tree) if self.is_stop else self.parts.rest, read.variables)

    @property
    def linear(self) -> bool:
        """Whether the force is K u + C v."""
        return self.parts[2:] == (0.0, 0.0, 0.0, ()) and not self.read.clipped

    @property
    def initial_stiffness(self) -> float:
        """Tangent stiffness at rest (N/m)."""
        return self.read.slope(0.0, 0.0, 0)

    @property
    def damping(self) -> float:
        """Derivative of the force with respect to the velocity, at rest (N s/m)."""
        return self.read.slope(0.0, 0.0, 1)

    @property
    def initial_damping(self) -> float:
        """The same; of a stop at no deformation."""
        return self.damping

    def static_force(self, displacement: float) -> float:
        """Return the force (N) of a slow displacement or deformation (m); at least 0 for a stop."""
        if not self.is_stop:
            return self.read.value(displacement, 0.0)
        return max(self.read.value(displacement, 0.0), 0.0) if displacement > 0.0 else 0.0

    def stored_energy(self, displacement: float, memory: float = 0.0) -> float:
        """Return the energy (J) that a slow displacement or deformation (m) stores."""
        return integral_of(self.static_force, displacement)

    def viscous_force(self, velocity: float) -> float:
        """Return the force (N) at u = 0 and a velocity (m/s)."""
        return self.read.value(0.0, velocity)

    def engine_numbers(self) -> tuple[Any, ...]:
        """Return the numbers by which the engine follows the law, as a stop or as an isolator."""
        if self.power is not None:
            stiffness, exponent, dissipation = self.power
            return PowerLaw(stiffness, exponent, dissipation or 0.0, 0.0, self.gap)
        names, values = self.operations
        symbols = tuple(one if isinstance(one, int) else SYMBOLS.index(one) for one in names)
        program = Program(symbols, tuple(values))
        if self.is_stop:
            return OwnStop(pack(program, self.initial_stiffness), self.gap)
        parts = self.parts
        law = IsolatorNumbers(
            parts.cubic,
            parts.quintic,
            drag=2.0 if parts.square else 1.0,
            own=pack(program, self.initial_stiffness - parts.stiffness),
        )
        return parts.stiffness, parts.square or parts.damping, law

    def force(
        self, displacement: ArrayLike, direction: ArrayLike, velocity: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Return the force (N) along a path.

        Of a stop, ``direction`` is the velocity of the deformation, and the force is at least 0.
        """
        u = np.asarray(displacement, dtype=np.float64)
        v = np.asarray(direction if self.is_stop else velocity, dtype=np.float64)
        pairs = zip(u.tolist(), np.broadcast_to(v, u.shape).tolist(), strict=True)
        values = np.array([self.read.value(*one) for one in pairs])
        return np.maximum(values, 0.0) if self.is_stop else values

    @property
    def sticks(self) -> bool:
        """Whether the mass can come to rest away from the equilibrium: always false."""
        return False

    @property
    def spring_and_dashpot(self) -> None:
        """Of a stop whose face relaxes; an `Oscillator` replaces such a law by a `Bumper`."""

    @property
    def remembers(self) -> bool:
        """Whether the force depends on more than displacement and velocity: always false."""
        return False

    def remembered(self, displacement: float) -> float:
        """Return the memory, which is 0, because the law has none."""
        return 0.0

    @property
    def reach(self) -> float:
        """Displacement (m) up to which the static force grows; ∞ if it always grows."""
        return _first_fall(lambda u: self.read.slope(u, 0.0, 0))

    @property
    def restoring_reach(self) -> float:
        """Displacement (m) up to which the static force is restoring; ∞ if it always is."""
        return _first_fall(self.static_force)

    @property
    def strongest(self) -> float:
        """Upper bound of the static force within the reach (N); ∞ if it is unbounded."""
        if self.reach < math.inf:
            return self.static_force(self.reach)
        near, far = self.static_force(_FAR), self.static_force(100.0 * _FAR)
        return far if far <= 1.001 * near else math.inf

    @property
    def linear_and_bounded(self) -> tuple[float, float] | None:
        """The pair (K, 0) if the static force is K u; otherwise None."""
        parts = self.parts
        if parts.cubic or parts.quintic or parts.rest:
            return None
        return parts.stiffness, 0.0


def _misnamed(name: object) -> InputError:
    why = ", because it has another meaning there" if name in _RESERVED else ""
    return InputError(
        f"{shown(name)} cannot be the name of a number in a formula{why}; use a name such as 'k3', "
        "of letters, digits and _, that begins with a letter"
    )


def _variables(is_stop: bool) -> tuple[str, str]:
    return ("d", "v") if is_stop else ("u", "v")


_FAR = 1e6
"""A displacement (m) that is larger than that of any rig."""


def _first_fall(function: Any) -> float:
    """Return the least u > 0 (m) at which a function is not above 0; ∞ if there is none."""
    before, u = 0.0, 1e-9
    while u < _FAR:
        if not function(u) > 0.0 and (before > 0.0 or function(1e-3 * u) <= 0.0):
            low, high = before, u
            for _ in range(80):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if function(middle) > 0.0 else (low, middle)
            return low
        before, u = u, 1.05 * u
    return math.inf


def _check_odd(read: Formula) -> None:
    for _, term in terms(read.tree):
        if parity(term) != ODD:
            raise InputError(
                f"formula: column {term.column}: {term.text!r} does not change its sign with u and "
                "v, as the force of an isolator must; use terms such as u**3, u*abs(u), sinh(u/u0) "
                "and tanh(v/v0)"
            )


def _power(term: FormulaNode) -> tuple[float, float, float | None] | None:
    dissipation = None
    if term.kind == "*" and term.parts[1].kind == "+":
        one, rate = (monomial(part, ("d", "v")) for part in term.parts[1].parts)
        if one != (1.0, (0.0, 0.0, 0.0, 0.0)) or rate is None or rate[1] != (0.0, 1.0, 0.0, 0.0):
            return None
        dissipation, term = rate[0], term.parts[0]
    made = monomial(term, ("d", "v"))
    if made is None or made[1][1:] != (0.0, 0.0, 0.0) or not made[1][0] >= 1.0:
        return None
    return made[0], made[1][0], dissipation


def _check_whole(read: Formula) -> None:
    for node in everywhere(read.tree):
        if node.kind == "**" and node.parts[1].number % 1.0:
            raise InputError(
                f"formula: column {node.column}: {node.text!r} has no Taylor series where "
                "contact begins; use a whole exponent, or the formula k*d**n*(1 + chi*v) without "
                "other terms"
            )


@lru_cache(maxsize=512)
def _parsed(text: str, numbers: tuple[tuple[str, float], ...], is_stop: bool) -> Formula:
    known: dict[str, tuple[float, Dimension]] = {name: (value, None) for name, value in numbers}
    return read_formula(text, known, _variables(is_stop))


@lru_cache(maxsize=512)
def _parts(text: str, numbers: tuple[tuple[str, float], ...], is_stop: bool) -> FormulaParts:
    read = _parsed(text, numbers, is_stop)
    known: dict[tuple[float, ...], int] = {(1, 0, 0, 0): 0, (0, 1, 0, 0): 1}
    if not is_stop:
        known |= {(3, 0, 0, 0): 2, (5, 0, 0, 0): 3, (0, 1, 0, 1): 4}
    coefficients, rest = [0.0] * 5, []
    for sign, term in terms(read.tree):
        made = monomial(term, read.variables)
        which = None if made is None else known.get(made[1])
        if made is None or which is None:
            rest.append((sign, term))
        else:
            coefficients[which] += sign * made[0]
    if coefficients[4] and coefficients[1]:  # a dashpot has one power of the velocity
        rest += [
            (sign, term)
            for sign, term in terms(read.tree)
            if (made := monomial(term, read.variables)) is not None and made[1] == (0, 1, 0, 1)
        ]
        coefficients[4] = 0.0
    linear, dashpot, cubic, quintic, drag = coefficients
    return FormulaParts(linear, dashpot, cubic, quintic, drag, tuple(rest))


def _relaxation_time(text: str, numbers: tuple[tuple[str, float], ...], is_stop: bool) -> float:
    parts = _parts(text, numbers, is_stop)
    if not is_stop or parts.rest or not parts.damping or _parsed(text, numbers, is_stop).clipped:
        return 0.0
    return parts.damping / parts.stiffness if parts.stiffness else math.inf
