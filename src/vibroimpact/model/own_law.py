"""A law of one's own, given as a formula: of an isolator or of a stop."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, NamedTuple

from pydantic import SerializerFunctionWrapHandler, model_serializer, model_validator

from vibroimpact.errors import InputError, shown
from vibroimpact.model.formula import (
    FUNCTIONS,
    ODD,
    Dimension,
    Formula,
    Node,
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
from vibroimpact.model.law_registry import Named
from vibroimpact.model.quantities import LENGTH, STIFFNESS
from vibroimpact.model.units import plain, pretty, to_si_of_any
from vibroimpact.model.validation import Accepts, constructor

_FIELDS = ("kind", "formula", "gap", "numbers")
_RESERVED = {*_FIELDS, *FUNCTIONS, "u", "v", "d"}


class Parts(NamedTuple):
    """What a formula is made of: terms that built-in laws have, and what remains."""

    stiffness: float
    damping: float
    cubic: float
    quintic: float
    square: float
    """Of a drag c v |v|, where there is no other damping."""
    rest: tuple[tuple[float, Node], ...]
    """Its other terms, each with its sign."""


class Law(Named):
    """A law given as a formula, of the displacement and velocity or of a stop's deformation.

    As an isolator its force is a formula of ``u`` (m) and ``v`` (m/s), displacement and velocity of
    the mass relative to the base. It changes its sign with both, as every isolator's force. With a
    `gap` it is a stop: a formula of ``d`` (m), the depth to which the mass has gone into it, and
    ``v`` (m/s), the rate of that. A stop pushes where the formula is above 0, and never pulls.

    A formula has the operations ``+ - * / **`` and the functions exp, sqrt, sinh, cosh, tanh, sin,
    cos and abs; abs of ``u`` and ``v`` alone. It is parsed, and never run as code. Terms that the
    built-in laws have are followed as these, bit by bit.

    Its kind in a table is ``"formula"``.

    Parameters
    ----------
    formula
        Force in N, such as ``"k*u + k3*u**3 + c*v"``.
    gap
        Of a stop: distance in m from the mass at u = 0 to the stop at rest; or text such as
        ``"7.5 mm"``. None for an isolator.
    **numbers
        Each number that the formula names: text with a unit, such as ``k="26 kN/m"``, which is
        checked against the formula; or a plain number, in SI units.

    Raises
    ------
    InputError
        If the formula cannot be read, names what is not declared, has units that do not fit, or a
        divisor that may come to 0; the line names the column.

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

    @constructor
    def __init__(
        self, formula: str, gap: float | str | None = None, **numbers: float | str
    ) -> None:
        super().__init__(formula=formula, gap=gap, **numbers)

    @model_validator(mode="before")
    @classmethod
    def _read_formula(cls, data: Any) -> Any:
        if not isinstance(data, Mapping) or "formula" not in data:
            return data
        kept = {name: value for name, value in data.items() if name in _FIELDS}
        found: dict[str, tuple[float, Dimension]] = {
            name: (value, None) for name, value in kept.pop("numbers", ())
        }
        for name, value in data.items():
            if name in _FIELDS:
                continue
            if not str(name).isidentifier() or name in _RESERVED:
                raise InputError(
                    f"{shown(name)} cannot name a number of a formula; letters, digits and _ are "
                    "accepted, beginning with a letter, and no name that formulas have"
                )
            found[name] = to_si_of_any(value, name)
        is_stop = kept.get("gap") is not None
        read = read_formula(kept["formula"], found, ("d", "v") if is_stop else ("u", "v"))
        check_divisors(read, not is_stop)
        if not is_stop:
            _check_odd(read)
        numbers = tuple((name, value) for name, (value, _) in found.items())
        return {**kept, "formula": read.text, "numbers": numbers}

    @model_validator(mode="after")
    def _can_be_followed(self) -> Law:
        stiffness = self.initial_stiffness
        if not 0.0 <= stiffness < math.inf:
            raise InputError(
                f"formula: its stiffness at rest is {pretty(stiffness, STIFFNESS)}; at least 0 is "
                "accepted"
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
        """Its kind, its formula, its numbers in SI units and its gap."""
        gap = [] if self.gap is None else [("gap", pretty(self.gap, LENGTH))]
        named = [(name, plain(value)) for name, value in self.numbers]
        return [("kind", self.kind), ("formula", self.formula), *named, *gap]

    def __str__(self) -> str:
        parts = [f"{name}={text}" for name, text in self.rows()[1:]]
        return f"Law({', '.join(parts)})"

    @property
    def is_stop(self) -> bool:
        """Whether it is a stop's law."""
        return self.gap is not None

    @property
    def read(self) -> Formula:
        """The formula, parsed."""
        return _parsed(self.formula, self.numbers, self.is_stop)

    @property
    def parts(self) -> Parts:
        """Its terms that built-in laws have, and the rest."""
        return _parts(self.formula, self.numbers, self.is_stop)

    @property
    def power(self) -> tuple[float, float, float | None] | None:
        """The k, n and χ of a stop's force k dⁿ (1 + χ v), if it is one; χ may be missing."""
        if not self.is_stop:
            return None
        (sign, term), *others = terms(self.read.tree)
        return None if others or sign < 0.0 else _power(term)

    @property
    def operations(self) -> tuple[list[str | int], list[float]]:
        """What the engine follows as a formula in reverse Polish notation, and its numbers.

        Of an isolator that is what built-in laws do not have; of a stop all.
        """
        read = self.read
        return operations(terms(read.tree) if self.is_stop else self.parts.rest, read.variables)

    @property
    def linear(self) -> bool:
        """Whether its force is K u + C v."""
        return self.parts[2:] == (0.0, 0.0, 0.0, ())

    @property
    def initial_stiffness(self) -> float:
        """Tangent stiffness at rest, N/m."""
        return self.read.slope(0.0, 0.0, 0)

    @property
    def damping(self) -> float:
        """Slope of the force by the velocity at rest, N s/m."""
        return self.read.slope(0.0, 0.0, 1)

    def static_force(self, displacement: float) -> float:
        """Force (N) of a slow displacement or deformation (m); of a stop never below 0."""
        if not self.is_stop:
            return self.read.value(displacement, 0.0)
        return max(self.read.value(displacement, 0.0), 0.0) if displacement > 0.0 else 0.0

    def viscous_force(self, velocity: float) -> float:
        """Force (N) at u = 0 and a velocity (m/s)."""
        return self.read.value(0.0, velocity)

    @property
    def remembers(self) -> bool:
        """Whether its force depends on more than displacement and velocity."""
        return False

    def remembered(self, displacement: float) -> float:
        """Its memory, which it has not."""
        return 0.0

    @property
    def reach(self) -> float:
        """Displacement (m) up to which the static force grows; ∞ if it grows on and on."""
        return _first_fall(lambda u: self.read.slope(u, 0.0, 0))

    @property
    def restoring_reach(self) -> float:
        """Displacement (m) up to which its static force pushes back to rest; ∞ if everywhere."""
        return _first_fall(self.static_force)

    @property
    def strongest(self) -> float:
        """What the static force does not exceed within the reach, N; ∞ if it is unbounded."""
        if self.reach < math.inf:
            return self.static_force(self.reach)
        near, far = self.static_force(_FAR), self.static_force(100.0 * _FAR)
        return far if far <= 1.001 * near else math.inf

    @property
    def linear_and_bounded(self) -> tuple[float, float] | None:
        """K, if the static force is K u."""
        parts = self.parts
        if parts.cubic or parts.quintic or parts.rest:
            return None
        return parts.stiffness, 0.0


_FAR = 1e6
"""m; farther than any rig is displaced."""


def _first_fall(function: Any) -> float:
    """The least u > 0 (m) at which a function is not above 0; ∞ if there is none."""
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
                "v, as the force of an isolator does; odd powers, sinh, sin, tanh, and products "
                "with abs or even powers are accepted"
            )


def _power(term: Node) -> tuple[float, float, float | None] | None:
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
                f"formula: column {node.column}: {node.text!r} has no series where contact begins; "
                "whole exponents are accepted, or k*d**n*(1 + chi*v) alone"
            )


@lru_cache(maxsize=512)
def _parsed(text: str, numbers: tuple[tuple[str, float], ...], is_stop: bool) -> Formula:
    known: dict[str, tuple[float, Dimension]] = {name: (value, None) for name, value in numbers}
    return read_formula(text, known, ("d", "v") if is_stop else ("u", "v"))


@lru_cache(maxsize=512)
def _parts(text: str, numbers: tuple[tuple[str, float], ...], is_stop: bool) -> Parts:
    read = _parsed(text, numbers, is_stop)
    known: dict[tuple[float, ...], int] = {(1, 0, 0, 0): 0, (0, 1, 0, 0): 1}
    if not is_stop:
        known |= {(3, 0, 0, 0): 2, (5, 0, 0, 0): 3, (0, 1, 0, 1): 4}
    found, rest = [0.0] * 5, []
    for sign, term in terms(read.tree):
        made = monomial(term, read.variables)
        which = None if made is None else known.get(made[1])
        if made is None or which is None:
            rest.append((sign, term))
        else:
            found[which] += sign * made[0]
    if found[4] and found[1]:  # a dashpot has one power of the velocity
        rest += [
            (sign, term)
            for sign, term in terms(read.tree)
            if (made := monomial(term, read.variables)) is not None and made[1] == (0, 1, 0, 1)
        ]
        found[4] = 0.0
    linear, dashpot, cubic, quintic, drag = found
    return Parts(linear, dashpot, cubic, quintic, drag, tuple(rest))
