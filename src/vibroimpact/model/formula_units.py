"""The units of the numbers in a formula, as far as the formula determines them.

The parts of a sum have the same unit, the argument of a function and an exponent have none, and the
whole formula is a force. These are linear equations for the powers of mass, length and time in the
unit of each number.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.model import quantities
from vibroimpact.model.formula import (
    FORCE,
    LENGTH,
    VELOCITY,
    Dimension,
    Reader,
    read_formula,
    refuse_at,
    unclipped,
)
from vibroimpact.model.quantities import (
    Quantity,
    in_base_units,
    power_damping,
    power_stiffness,
)
from vibroimpact.model.units import to_si

_Array = NDArray[np.float64]
_NEAR = 1e-9


class _Unit(NamedTuple):
    """Powers of mass, length and time: those that are known, and so many times each number's."""

    known: _Array
    shares: _Array

    def plus(self, other: _Unit, times: float = 1.0) -> _Unit:
        return _Unit(self.known + times * other.known, self.shares + times * other.shares)


@lru_cache(maxsize=512)
def units_of_numbers(
    text: str, numbers: tuple[tuple[str, float], ...], variables: tuple[str, str]
) -> dict[str, Quantity]:
    """Return the quantities of the numbers of a formula that its units determine.

    A number that is written out, such as 2, has no unit. If the units then contradict each other,
    such numbers may have any unit.
    """
    by_name = _solved(_Units(text, dict(numbers), variables, any_literal=False))
    if by_name is None:
        by_name = _solved(_Units(text, dict(numbers), variables, any_literal=True))
    return by_name or {}


def check_numbers(
    formula: object,
    numbers: Mapping[str, tuple[float, Dimension]],
    arguments: Mapping[str, object],
    variables: tuple[str, str],
) -> None:
    """Raise an error if a number is given in another unit than the formula determines.

    Parameters
    ----------
    numbers
        Values in SI units and stated dimensions of the numbers, by name.
    arguments
        The numbers as they were passed by the user.
    """
    stated = [name for name, (_, dimension) in numbers.items() if dimension is not None]
    if not stated:
        return
    values = {name: value for name, (value, _) in numbers.items()}
    text = read_formula(formula, {name: (x, None) for name, x in values.items()}, variables).text
    known = units_of_numbers(text, tuple(values.items()), variables)
    for name in stated:
        if name not in known:
            continue
        try:
            to_si(arguments[name], known[name], name)
        except InputError as error:
            occurrence = re.search(rf"\b{name}\b", text)
            refuse_at(occurrence.start() + 1 if occurrence else 1, str(error))


def _solved(reader: _Units) -> dict[str, Quantity] | None:
    rows = reader.equations()
    shares, known = (np.array([row[i] for row in rows]) for i in (1, 0))
    inverse = np.linalg.pinv(shares)
    powers = -inverse @ known
    if np.abs(shares @ powers + known).max() > _NEAR:
        return None
    determined = np.abs((inverse @ shares).diagonal() - 1.0) < _NEAR
    return {
        name: _quantity(tuple(round(float(power), 9) + 0.0 for power in powers[i]))
        for i, name in enumerate(reader.numbers)
        if determined[i]
    }


class _Units:
    """Finds the unit of each part of a formula that has been checked."""

    def __init__(
        self,
        text: str,
        numbers: Mapping[str, float],
        variables: tuple[str, str],
        any_literal: bool,
    ) -> None:
        self.numbers, self.variables = numbers, variables
        self.reader = Reader(text, {name: (x, None) for name, x in numbers.items()}, variables)
        self.tree, _ = unclipped(text, variables)
        literals = [part for part in ast.walk(self.tree) if isinstance(part, ast.Constant)]
        self.unknown: list[str | ast.expr] = [*numbers, *(literals if any_literal else ())]
        self.zero: list[_Unit] = []
        """What must have no unit."""

    def equations(self) -> list[_Unit]:
        """What is zero: also the unit of the formula over that of a force."""
        whole = self.unit(self.tree)
        return [*self.zero, whole._replace(known=whole.known - FORCE)]

    def unit(self, part: ast.expr) -> _Unit:
        none = _Unit(np.zeros(3), np.zeros(len(self.unknown)))
        if isinstance(part, ast.Constant):
            return none._replace(shares=np.array([float(part is one) for one in self.unknown]))
        if isinstance(part, ast.Name):
            if part.id in self.variables:
                known = (LENGTH, VELOCITY)[self.variables.index(part.id)]
                return none._replace(known=np.array(known))
            return none._replace(shares=np.array([float(part.id == one) for one in self.unknown]))
        if isinstance(part, ast.UnaryOp):
            return self.unit(part.operand)
        if isinstance(part, ast.BinOp):
            one, other = self.unit(part.left), self.unit(part.right)
            if isinstance(part.op, ast.Mult | ast.Div):
                return one.plus(other, 1.0 if isinstance(part.op, ast.Mult) else -1.0)
            if isinstance(part.op, ast.Pow):
                self.zero.append(other)
                exponent = self.reader.read(part.right).number
                return none.plus(one, exponent)
            self.zero.append(one.plus(other, -1.0))
            return one
        if isinstance(part, ast.Call):
            inner = self.unit(part.args[0])
            name = getattr(part.func, "id", "")
            if name in ("sqrt", "abs"):
                return none.plus(inner, 0.5 if name == "sqrt" else 1.0)
            self.zero.append(inner)
        return none


def _quantity(powers: tuple[float, ...]) -> Quantity:
    """The quantity with these powers of mass, length and time."""
    mass, length, time = powers
    if mass == 1.0 and time == -2.0 and length < 1.0:
        return power_stiffness(1.0 - length)
    if mass == 1.0 and length < 1.0 and time == -1.0 - length:
        return power_damping(1.0 - length)
    made = in_base_units(mass, length, time)
    return next((one for one in _NAMED if one.base == made.base), made)


_NAMED = (
    quantities.DIMENSIONLESS,
    quantities.LENGTH,
    quantities.VELOCITY,
    quantities.MASS,
    quantities.TIME,
    quantities.FORCE,
    quantities.DECAY,
    quantities.DISSIPATION,
)
