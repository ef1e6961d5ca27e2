"""A formula as the engine evaluates it: unpacked from a rig's vector (`law_numbers.pack`).

A vector then holds all of a rig, whoever receives it, in whichever process.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from vibroimpact.engine import parameters as par
from vibroimpact.law_numbers import BITS, IN_WORD, LARGEST, SYMBOLS, WORDS


def unpack(rig: Any, which: int) -> tuple[int, ...]:
    """Read the symbols of the isolator's program (0), or of that of a stop (1 right, 2 left)."""
    at = par.OWN + par.OWN_WIDTH * which
    symbols: list[int] = []
    for word in np.asarray(rig[at : at + WORDS]) if rig[at] else ():
        rest = int(word)
        for _ in range(IN_WORD):
            symbols.append(rest & LARGEST)
            rest >>= BITS
    while symbols and symbols[-1] == 0:
        symbols.pop()
    return tuple(symbols)


def evaluate(law: Any, symbols: tuple[int, ...], which: int, x: Any, v: Any, signs: Any) -> Any:
    """Run a program with numbers, series or what has derivatives.

    Parameters
    ----------
    law
        Whose functions are those of what the program is run with.
    which
        Whose program it is, for its numbers: 0 the isolator's, 1 or 2 that of a stop.
    x, v
        Displacement (m) and velocity (m/s), or what stands for them.
    signs
        Those of both, by which the absolute values are products.
    """
    first = par.OWN + par.OWN_WIDTH * which + par.OWN_FIRST

    def numbers(i: int) -> Any:
        return law.formula_number(first + i)

    stack: list[Any] = []
    rest = iter(symbols)
    for symbol in rest:
        name = SYMBOLS[symbol]
        if name in ("x", "v"):
            stack.append(x if name == "x" else v)
        elif name in ("|x|", "|v|"):
            at = ("|x|", "|v|").index(name)
            stack.append(law.size_of((x, v)[at], signs[at]))
        elif name == "number":
            stack.append(numbers(next(rest)))
        elif name in ("+", "-", "*", "/"):
            other = stack.pop()
            one = stack.pop()
            stack.append(
                one + other
                if name == "+"
                else one - other
                if name == "-"
                else one * other
                if name == "*"
                else one * law.inverse(other)
            )
        elif name == "power":
            stack.append(stack.pop() ** next(rest))
        elif name == "real power":
            stack.append(law.power(stack.pop(), numbers(next(rest))))
        elif name == "neg":
            stack.append(-stack.pop())
        else:
            stack.append(_FUNCTIONS[name](law, stack.pop()))
    (result,) = stack
    return result


class Traced:
    """Functions of a formula on numbers, which keep what the formula may bend with.

    A step must not pass a bend that its series does not show: a tanh is flat to rounding at some
    distance from its bend. How far the functions' arguments move on a step limits its length.
    """

    def __init__(self, machine: Any, law: Any) -> None:
        self.machine, self.law = machine, law
        self.arguments: list[tuple[Any, Any]] = []
        """Of functions, each with its distance from where the function bends; None if it bends
        everywhere."""
        self.factors: list[tuple[Any, Any]] = []
        """Divisors and bases of broken powers, with the exponent."""

    def exp(self, one: Any) -> Any:
        """Return e to this power."""
        self.arguments.append((one, -one))
        return self.law.exp(one)

    def sine(self, one: Any) -> Any:
        """Return the sine."""
        self.arguments.append((one, None))
        return self.law.sine(one)

    def cosine(self, one: Any) -> Any:
        """Return the cosine."""
        self.arguments.append((one, None))
        return self.law.cosine(one)

    def tanh(self, one: Any) -> Any:
        """Return the hyperbolic tangent."""
        twice = one * 2.0
        self.arguments.append((twice, self.machine.absolute(twice)))
        return self.law.tanh(one)

    def inverse(self, one: Any) -> Any:
        """Return 1 over a number."""
        self.factors.append((one, 1.0))
        return self.law.inverse(one)

    def power(self, one: Any, exponent: Any) -> Any:
        """Return a to the power of b."""
        self.factors.append((one, exponent))
        return self.law.power(one, exponent)

    def size_of(self, one: Any, sign: Any) -> Any:
        """Return the absolute value."""
        return self.machine.absolute(one)

    def formula_number(self, place: int) -> Any:
        """Return a number of the formula."""
        return self.law.formula_number(place)


FARTHEST = 4.0
"""What the argument of a function may change by on a step, and a factor by its share."""

FLAT = 80.0
"""At this distance from its bend a function is flat far below rounding: e^-80 is 2e-35. Up to
there its argument may move on one step."""


def bends(machine: Any, law: Any, symbols: tuple[int, ...], which: int, points: Any) -> Any:
    """Return by how much the arguments of a formula's functions move on a step, over what they may.

    `points` are pairs of what stands for x and v; the first is the step's beginning. None if the
    formula has no functions.
    """
    traces = []
    for x, v in points:
        traces.append(Traced(machine, law))
        evaluate(traces[-1], symbols, which, x, v, (None, None))
    first, most = traces[0], None
    shares = [
        1.0 / FARTHEST if distance is None else 1.0 / machine.most(distance - FLAT, FARTHEST)
        for _, distance in first.arguments
    ]
    for other in traces[1:]:
        moved = [
            machine.absolute(one - begun) * share
            for (one, _), (begun, _), share in zip(
                other.arguments, first.arguments, shares, strict=True
            )
        ]
        for (one, exponent), (begun, _) in zip(other.factors, first.factors, strict=True):
            share = one / begun
            grown = machine.most(share, 1.0 / share) - 1.0
            grown = machine.most(grown, grown * -1e3)  # below 0 if it changes its sign
            moved.append(machine.absolute(exponent) * grown * (1.0 / FARTHEST))
        for one in moved:
            most = one if most is None else machine.most(most, one)
    return most


_FUNCTIONS = {
    "exp": lambda law, one: law.exp(one),
    "sqrt": lambda law, one: law.power(one, 0.5),
    "sinh": lambda law, one: (law.exp(one) - law.exp(-one)) * 0.5,
    "cosh": lambda law, one: (law.exp(one) + law.exp(-one)) * 0.5,
    "tanh": lambda law, one: law.tanh(one),
    "sin": lambda law, one: law.sine(one),
    "cos": lambda law, one: law.cosine(one),
}
