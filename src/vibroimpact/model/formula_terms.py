"""Terms of a formula: their parity, their divisors, and the list of operations for the engine."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from vibroimpact.errors import InputError
from vibroimpact.law_numbers import MOST_SYMBOLS, OWN_NUMBERS
from vibroimpact.model.formula import (
    EVEN,
    FUNCTIONS,
    NEITHER,
    ODD,
    Formula,
    FormulaNode,
    refuse_at,
    value_of,
)


def parity(node: FormulaNode) -> int:
    """Return whether a part of a formula is ODD, EVEN or NEITHER."""
    kind = node.kind
    if kind == "number":
        return EVEN
    if kind == "variable":
        return ODD
    parities = [parity(part) for part in node.parts]
    if kind in ("+", "-"):
        return parities[0] if parities[0] == parities[1] else NEITHER
    if kind in ("*", "/"):
        return parities[0] * parities[1]
    if kind == "neg":
        return parities[0]
    if kind == "**":
        n = node.parts[1].number
        if parities[0] == EVEN:
            return EVEN
        return NEITHER if n != int(n) else (parities[0] if int(n) % 2 else abs(parities[0]))
    return EVEN if parities[0] == EVEN else (FUNCTIONS[kind] if parities[0] == ODD else NEITHER)


def terms(node: FormulaNode) -> list[tuple[float, FormulaNode]]:
    """Split a sum into its terms, each with its sign."""
    if node.kind == "+":
        return terms(node.parts[0]) + terms(node.parts[1])
    if node.kind == "-":
        return terms(node.parts[0]) + [(-sign, one) for sign, one in terms(node.parts[1])]
    if node.kind == "neg":
        return [(-sign, one) for sign, one in terms(node.parts[0])]
    return [(1.0, node)]


def monomial(node: FormulaNode, variables: Sequence[str]) -> tuple[float, tuple[float, ...]] | None:
    """Return the factor and the powers of x, v, |x| and |v| in a product, or None if it is none."""
    kind = node.kind
    if kind == "number":
        return node.number, (0.0, 0.0, 0.0, 0.0)
    if kind == "variable":
        i = variables.index(node.text)
        return 1.0, tuple(1.0 if j == i else 0.0 for j in range(4))
    operands = [monomial(part, variables) for part in node.parts]
    one = operands[0]
    if one is None:
        return None
    if kind == "neg":
        return -one[0], one[1]
    if kind == "abs":
        i = variables.index(node.parts[0].text)
        return 1.0, tuple(1.0 if j == i + 2 else 0.0 for j in range(4))
    if kind in ("*", "/"):
        other = operands[1]
        if other is None or (kind == "/" and (any(other[1]) or other[0] == 0.0)):
            return None
        powers = tuple(a + b for a, b in zip(one[1], other[1], strict=True))
        return (one[0] * other[0] if kind == "*" else one[0] / other[0]), powers
    if kind == "**" and one[0] == 1.0:
        n = node.parts[1].number
        return 1.0, tuple(a * n for a in one[1])
    return None


def everywhere(node: FormulaNode) -> Iterator[FormulaNode]:
    """Yield all parts of a formula, beginning with the whole formula."""
    yield node
    for part in node.parts:
        yield from everywhere(part)


_SIZES = [10.0 ** (0.05 * i) for i in range(-180, 81)]
"""Displacements (m) and velocities (m/s) at which divisors are checked."""


def check_divisors(formula: Formula, both_ways: bool) -> None:
    """Raise an error if a divisor, or the base of a fractional or negative power, can become 0.

    The first variable may be negative with `both_ways`. The message states the column, and the
    values of the variables.
    """
    for node in everywhere(formula.tree):
        if node.kind == "/":
            part, above = node.parts[1], False
        elif node.kind == "sqrt":
            part, above = node.parts[0], True
        elif node.kind == "**":
            n = node.parts[1].number
            part, above = node.parts[0], n != int(n)
            if (n >= 0.0 and not above) or (n >= 1.0 and part.text == "d"):
                continue
        else:
            continue
        _check_nonzero(formula, node, part, above, both_ways)


def _check_nonzero(
    formula: Formula, node: FormulaNode, part: FormulaNode, above: bool, both_ways: bool
) -> None:
    what = "divisor" if node.kind == "/" else "base"

    def at(x: float, v: float) -> float:
        return value_of(part, dict(zip(formula.variables, (x, v), strict=True)))[0]

    rest = at(0.0, 0.0)
    if not rest > 0.0 if above else rest == 0.0:
        refuse_at(
            part.column,
            f"the {what} {part.text!r} is {rest:g} at rest; use a {what} that "
            f"{'stays above' if above else 'is never'} 0",
        )
    way = math.copysign(1.0, rest)
    rays = [(1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (1.0, 1.0), (1.0, -1.0), (1.0, 30.0), (1.0, -30.0)]
    if both_ways:
        rays += [(-x, v) for x, v in rays if x]
    for x, v in rays:
        before = 0.0
        for size in _SIZES:
            value = at(x * size, v * size)
            if value * way <= 0.0:
                for _ in range(60):
                    middle = 0.5 * (before + size)
                    before, size = (
                        (middle, size)
                        if at(x * middle, v * middle) * way > 0.0
                        else (before, middle)
                    )
                place = [
                    f"{name} = {one * size:.3g} {unit}"
                    for name, one, unit in zip(formula.variables, (x, v), ("m", "m/s"), strict=True)
                    if one
                ]
                refuse_at(
                    part.column,
                    f"the {what} {part.text!r} is 0 at {' and '.join(place)}; use a {what} "
                    f"that {'stays above' if above else 'is never'} 0",
                )
            before = size


def operations(
    signed: Sequence[tuple[float, FormulaNode]], variables: Sequence[str]
) -> tuple[list[str | int], list[float]]:
    """Convert a sum of terms to reverse Polish notation.

    Returns
    -------
    operations, numbers
        Names of operations as in `engine.series.program`. After some operations, there is an index
        of the numbers, or a whole exponent.

    Raises
    ------
    InputError
        If there are too many operations or numbers.
    """
    symbols: list[str | int] = []
    numbers: list[float] = []

    def number(value: float) -> int:
        if value not in numbers:
            numbers.append(value)
        return numbers.index(value)

    def write(node: FormulaNode) -> None:
        kind, parts = node.kind, node.parts
        if kind == "number":
            symbols.extend(("number", number(node.number)))
        elif kind == "variable":
            symbols.append("xv"[variables.index(node.text)])
        elif kind == "abs":
            symbols.append(("|x|", "|v|")[variables.index(parts[0].text)])
        elif kind == "**":
            raise_to(*parts)
        else:
            for part in parts:
                write(part)
            symbols.append(kind)

    def raise_to(base: FormulaNode, exponent: FormulaNode) -> None:
        n = exponent.number
        if n < 0.0:
            symbols.extend(("number", number(1.0)))
            raise_to(base, exponent._replace(number=-n))
            symbols.append("/")
            return
        write(base)
        if n != int(n):
            symbols.extend(("real power", number(n)))
        elif n > 1.0:
            symbols.extend(("power", int(n)))

    for i, (sign, term) in enumerate(signed):
        write(term)
        if i:
            symbols.append("+" if sign > 0.0 else "-")
        elif sign < 0.0:
            symbols.append("neg")
    for what, count, most in (
        ("operations", len(symbols), MOST_SYMBOLS),
        ("numbers", len(numbers), OWN_NUMBERS),
    ):
        if count > most:
            raise InputError(
                f"formula: it has {count} {what}; shorten it to at most {most}, not counting the "
                "terms in u, u**3, u**5 and v of an isolator"
            )
    return symbols, numbers
