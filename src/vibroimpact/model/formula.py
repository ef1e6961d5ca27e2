"""Formulas of laws: texts that are parsed and checked, but never run as code.

Python's parser reads the text. Only sums, products, quotients, powers and the functions below are
accepted. A part of the formula that contains no variable is replaced by one number.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Mapping
from functools import cache
from typing import ClassVar, NamedTuple, NoReturn, TypeAlias

from vibroimpact.errors import InputError, advised, alternatives, meant, shown
from vibroimpact.law_numbers import LARGEST

_LONGEST = 300
"""Largest number of characters of a formula."""

Dimension: TypeAlias = tuple[float, float, float] | None
"""Powers of mass, length and time. None for a number without a unit, which may have any unit."""

NONE, LENGTH, VELOCITY, FORCE = (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 1.0, -1.0), (1.0, 1.0, -2.0)

ODD, EVEN, NEITHER = -1, 1, 0
"""Effect on a part if displacement and velocity change their signs: new sign, none, or other."""

FUNCTIONS = {
    "exp": NEITHER,
    "sqrt": NEITHER,
    "sinh": ODD,
    "cosh": EVEN,
    "tanh": ODD,
    "sin": ODD,
    "cos": EVEN,
    "abs": EVEN,
}
"""Accepted functions by name, with the parity of their value if the argument is odd."""

ARGUMENTS = ("kind", "formula", "gap", "numbers")
"""Names of a law's own arguments and keys, which no number of its formula can have."""

_REFUSED = {
    "sign": "a force that jumps can hold the mass at rest; use abs(u) or abs(v), or for dry "
    "friction a FrictionIsolator",
    "max": "it has no Taylor series at its corner; use abs(u) or abs(v), or max(..., 0) around the "
    "whole force of a stop",
    "min": "it has no Taylor series at its corner; use abs(u) or abs(v)",
    "log": "it is not finite at rest; use powers or exp",
}

_ELSEWHERE = {
    "d": "'d' is used for a stop, but this law has no gap; write 'u', or pass the gap of the stop",
    "u": "'u' is used for an isolator, but this law has a gap; write 'd', or remove the gap",
}

_WRITTEN = {
    (0.0, 0.0, 0.0): "a number without a unit",
    LENGTH: "a length",
    VELOCITY: "a velocity",
    FORCE: "a force",
    (1.0, 0.0, -2.0): "a stiffness",
    (1.0, 0.0, -1.0): "a damping",
    (0.0, -1.0, 0.0): "an inverse length",
    (0.0, -1.0, 1.0): "an inverse velocity",
}


class FormulaNode(NamedTuple):
    """A part of a formula, with its text and the column where it starts.

    `kind` is ``number``, ``variable``, an operator ``+ - * / **``, ``neg``, or the name of a
    function. The exponent of a power is a number.
    """

    kind: str
    parts: tuple[FormulaNode, ...]
    column: int
    text: str
    number: float = 0.0


class Formula(NamedTuple):
    """A formula that has been checked. Its tree contains the values of all numbers.

    `clipped` states that it is written as max(..., 0). The tree is then that of the first argument.
    """

    text: str
    variables: tuple[str, str]
    tree: FormulaNode
    clipped: bool = False

    def value(self, x: float, v: float) -> float:
        """Return the force (N) at a displacement or deformation (m) and a velocity (m/s)."""
        return value_of(self.tree, dict(zip(self.variables, (x, v), strict=True)))[0]

    def slope(self, x: float, v: float, which: int) -> float:
        """Return the derivative with respect to the displacement (0) or the velocity (1)."""
        values = dict(zip(self.variables, (x, v), strict=True))
        return value_of(self.tree, values, self.variables[which])[1]


def read_formula(
    text: object, numbers: Mapping[str, tuple[float, Dimension]], variables: tuple[str, str]
) -> Formula:
    """Parse a formula and check its names and units.

    Parameters
    ----------
    numbers
        Values in SI units and dimensions of the numbers, by name.
    variables
        Names of the displacement or deformation (m) and of its rate (m/s).

    Raises
    ------
    InputError
        If the formula cannot be read, contains a name without a value, or has inconsistent units.
        The message states the column.
    """
    if not isinstance(text, str):
        raise InputError(f"formula: {shown(text)} is not a string; use a string such as 'k*u'")
    if len(text) > _LONGEST:
        raise InputError(f"formula: it has {len(text)} characters; use at most {_LONGEST}")
    try:
        tree, clipped = unclipped(text := text.strip(), variables)
    except SyntaxError as error:
        column = error.offset if error.offset and error.offset > 0 else len(text) + 1
        refuse_at(column, f"it cannot be read ({error.msg}); correct the formula at this place")
    except (ValueError, RecursionError, MemoryError):
        raise InputError(
            f"formula: {shown(text)} cannot be read; use a formula such as 'k*u + k3*u**3'"
        ) from None
    reader = Reader(text, numbers, variables)
    made = reader.read(tree)
    if unused := [name for name in numbers if name not in reader.used]:
        raise InputError(
            f"{unused[0]}: the formula {text!r} does not contain this number; remove {unused[0]}, "
            "or add it to the formula"
        )
    unit = reader.dimension(made)
    if unit is not None and not _same(unit, FORCE):
        refuse_at(1, f"the formula is {_words(unit)}, not a force; correct the units")
    if made.kind == "number":
        refuse_at(1, f"{text!r} depends on neither {' nor '.join(variables)}; add one of them")
    return Formula(text, variables, made, clipped)


def unclipped(text: str, variables: tuple[str, str]) -> tuple[ast.expr, bool]:
    """Parse a formula; of a stop's max(force, 0), return the force, and True."""
    tree = ast.parse(text, mode="eval").body
    match tree:
        case ast.Call(func=ast.Name("max"), args=[one, other], keywords=[]) if variables[0] == "d":
            for force, zero in ((one, other), (other, one)):
                if isinstance(zero, ast.Constant) and zero.value == 0:
                    return force, True
    return tree, False


def refuse_at(column: int, problem: str) -> NoReturn:
    """Raise an error about the part of a formula that starts in a column."""
    raise InputError(f"formula: column {column}: {problem}")


def _same(one: tuple[float, float, float], other: tuple[float, float, float]) -> bool:
    return all(abs(a - b) < 1e-9 for a, b in zip(one, other, strict=True))


def _words(unit: tuple[float, float, float]) -> str:
    for known, words in _WRITTEN.items():
        if _same(unit, known):
            return words
    named = zip(("kg", "m", "s"), unit, strict=True)
    return "in " + " ".join(
        f"{name}^{power:g}" if power != 1.0 else name for name, power in named if power
    )


class Reader:
    """Converter of the parser's tree to nodes. It accepts only the operations of formulas."""

    _signs: ClassVar = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**"}

    def __init__(
        self,
        text: str,
        numbers: Mapping[str, tuple[float, Dimension]],
        variables: tuple[str, str],
    ) -> None:
        self.text, self.numbers, self.variables = text, numbers, variables
        self.used: list[str] = []
        self.units: dict[FormulaNode, Dimension] = {}

    def column(self, part: ast.expr) -> int:
        """Return the column where a part starts, counted from 1."""
        return len(self.text.encode()[: part.col_offset].decode(errors="ignore")) + 1

    def read(self, part: ast.expr) -> FormulaNode:
        """Return the node of a part of the tree."""
        at = self.column(part)
        text = ast.get_source_segment(self.text, part) or ""
        if isinstance(part, ast.Constant):
            value = part.value
            if isinstance(value, bool) or not isinstance(value, int | float):
                refuse_at(at, f"{shown(value)} is not a number; use a number such as 2.5")
            if not abs(value) < 1e300:
                refuse_at(at, f"{text} is not a finite number")
            return FormulaNode("number", (), at, text, float(value))
        if isinstance(part, ast.Name):
            return self.named(part.id, at)
        if isinstance(part, ast.UnaryOp) and isinstance(part.op, ast.USub | ast.UAdd):
            inner = self.read(part.operand)
            if isinstance(part.op, ast.UAdd):
                return inner
            return self.made("neg", (inner,), at, text)
        if isinstance(part, ast.BinOp) and type(part.op) in self._signs:
            sign = self._signs[type(part.op)]
            both = (self.read(part.left), self.read(part.right))
            if sign == "**":
                return self.power(*both, at, text)
            return self.made(sign, both, at, text)
        if isinstance(part, ast.BinOp) and isinstance(part.op, ast.BitXor):
            refuse_at(at, f"{text!r}: ^ is not a power here; write **")
        if isinstance(part, ast.Call):
            return self.called(part, at, text)
        refuse_at(at, f"{text or 'this'} is not a formula; use + - * / ** ( ) and functions")

    def named(self, name: str, at: int) -> FormulaNode:
        """Return the node of a name, which is a variable or a number with a value."""
        if name in self.variables:
            return FormulaNode("variable", (), at, name)
        if name not in self.numbers:
            known = (*self.variables, *self.numbers)
            if name in _ELSEWHERE:
                refuse_at(at, _ELSEWHERE[name])
            if name in ARGUMENTS:
                refuse_at(at, f"{name!r} cannot be the name of a number; use another name")
            refuse_at(
                at,
                f"{name!r} has no value; {advised(meant(name, known), alternatives(known))}, or "
                f"pass {name}=... as another argument",
            )
        if name not in self.used:
            self.used.append(name)
        node = FormulaNode("number", (), at, name, self.numbers[name][0])
        self.units[node] = self.numbers[name][1]
        return node

    def called(self, part: ast.Call, at: int, text: str) -> FormulaNode:
        """Return the node of a function call."""
        name = part.func.id if isinstance(part.func, ast.Name) else ""
        if name in _REFUSED:
            refuse_at(at, f"{name} is not accepted: {_REFUSED[name]}")
        if name not in FUNCTIONS or part.keywords or len(part.args) != 1:
            what = (
                f"{name!r} is not a function that formulas accept"
                if name and name not in FUNCTIONS
                else f"{text!r} cannot be read"
            )
            refuse_at(at, f"{what}; use {alternatives(FUNCTIONS)} with one argument")
        inner = self.read(part.args[0])
        if name == "abs" and inner.kind not in ("number", "variable"):
            refuse_at(
                at,
                f"the absolute value of {inner.text!r} is not accepted, because its corner may lie "
                f"anywhere; use abs({self.variables[0]}) or abs({self.variables[1]})",
            )
        return self.made(name, (inner,), at, text)

    def power(self, base: FormulaNode, exponent: FormulaNode, at: int, text: str) -> FormulaNode:
        """Return the node of a power. The exponent must be a number."""
        if exponent.kind != "number":
            refuse_at(exponent.column, f"the exponent {exponent.text!r} varies; use a number")
        unit = self.dimension(exponent)
        if unit is not None and not _same(unit, NONE):
            refuse_at(
                exponent.column, f"the exponent {exponent.text!r} is {_words(unit)}, not a number"
            )
        if not abs(exponent.number) <= LARGEST:
            refuse_at(
                exponent.column,
                f"the exponent is {exponent.number:g}; use one from -{LARGEST} to {LARGEST}",
            )
        made = self.made("**", (base, exponent), at, text)
        if exponent.number:
            return made
        one = FormulaNode("number", (), at, text, 1.0)  # also where the base is 0
        self.units[one] = self.units[made]
        return one

    def made(self, kind: str, parts: tuple[FormulaNode, ...], at: int, text: str) -> FormulaNode:
        """Return a node of other nodes. If all of them are numbers, it is a number, too."""
        node = FormulaNode(kind, parts, at, text)
        unit = self.dimension(node)
        if all(part.kind == "number" for part in parts):
            value = value_of(node, {})[0]
            if not math.isfinite(value):
                refuse_at(at, f"{text!r} is not a finite number")
            node = FormulaNode("number", (), at, text, value)
            self.units[node] = unit
        return node

    def dimension(self, node: FormulaNode) -> Dimension:
        """Return the dimension of a node, and check its units on the first call."""
        if node not in self.units:
            self.units[node] = self.dimension_of(node)
        return self.units[node]

    def dimension_of(self, node: FormulaNode) -> Dimension:
        """Compute the dimension of a node from the dimensions of its parts."""
        kind, parts = node.kind, node.parts
        if kind == "number":
            return None if node.text not in self.numbers else self.numbers[node.text][1]
        if kind == "variable":
            return LENGTH if node.text == self.variables[0] else VELOCITY
        units = [self.dimension(part) for part in parts]
        if kind in ("+", "-"):
            one, other = units
            if one is not None and other is not None and not _same(one, other):
                refuse_at(
                    parts[1].column,
                    f"{parts[1].text!r} is {_words(other)}, but it is added to {parts[0].text!r}, "
                    f"which is {_words(one)}",
                )
            return one if other is None else other
        if kind in ("neg", "abs"):
            return units[0]
        if kind in ("*", "/"):
            # A plain factor such as 2 has no unit; a number given without one takes what fits.
            if any(
                unit is None and not _literal(part) for part, unit in zip(parts, units, strict=True)
            ):
                return None
            one, other = ((NONE if unit is None else unit) for unit in units)
            way = 1.0 if kind == "*" else -1.0
            return tuple(a + way * b for a, b in zip(one, other, strict=True))  # type: ignore[return-value]
        if kind == "**":
            if units[0] is None:
                return None
            return tuple(a * parts[1].number for a in units[0])  # type: ignore[return-value]
        inner = units[0]
        if kind == "sqrt":
            return None if inner is None else tuple(0.5 * a for a in inner)  # type: ignore[return-value]
        if inner is not None and not _same(inner, NONE):
            refuse_at(
                parts[0].column,
                f"the argument of {kind}, {parts[0].text!r}, is {_words(inner)}; use a number "
                "without a unit",
            )
        return NONE


@cache
def _literal(node: FormulaNode) -> bool:
    """Whether a node is a number that is written out, such as 2 or 1/3."""
    return node.kind == "number" and all(one in "0123456789.eE+-*/() " for one in node.text)


def value_of(node: FormulaNode, values: Mapping[str, float], by: str = "") -> tuple[float, float]:
    """Return the value of a node, and its derivative with respect to the variable `by`."""
    kind = node.kind
    if kind == "number":
        return node.number, 0.0
    if kind == "variable":
        return values[node.text], 1.0 if node.text == by else 0.0
    operands = [value_of(part, values, by) for part in node.parts]
    a, da = operands[0]
    try:
        if kind == "+":
            return a + operands[1][0], da + operands[1][1]
        if kind == "-":
            return a - operands[1][0], da - operands[1][1]
        if kind == "neg":
            return -a, -da
        if kind == "*":
            return a * operands[1][0], da * operands[1][0] + a * operands[1][1]
        if kind == "/":
            b, db = operands[1]
            return a / b, (da - a / b * db) / b
        if kind == "**":
            n = operands[1][0]
            if a < 0.0 and n != int(n):
                return math.nan, math.nan
            return float(a**n), float(n * a ** (n - 1.0)) * da if da or n >= 1.0 else 0.0
        if kind == "abs":
            return abs(a), math.copysign(1.0, a) * da
        if kind == "sqrt":
            root = math.sqrt(a) if a >= 0.0 else math.nan
            return root, 0.5 * da / root if da else 0.0
        return float(getattr(math, kind)(a)), _SLOPES[kind](a) * da
    except ZeroDivisionError:
        return math.inf, math.nan
    except OverflowError:
        return math.inf, math.inf


_SLOPES: dict[str, Callable[[float], float]] = {
    "exp": math.exp,
    "sinh": math.cosh,
    "cosh": math.sinh,
    "tanh": lambda x: 1.0 - math.tanh(x) ** 2,
    "sin": math.cos,
    "cos": lambda x: -math.sin(x),
}
"""Derivatives of the functions."""
