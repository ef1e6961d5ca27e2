"""Taylor series of polynomial differential equations, in integers of fixed point.

A `Tape` holds the series of a step in x = (independent variable)/step, 0 <= x <= 1: of its
unknowns, and of what is summed and multiplied from them. An order is filled in after the other: the
next coefficient of an unknown follows from its rate's. An integer c stands for c 2^-BITS.
"""

from __future__ import annotations

from collections.abc import Callable
from operator import mul
from typing import Any

from mpmath import mp, mpf

from reference.first_zero import first_zero

BITS = 320
"""Behind the point: 1e-96."""


def fixed(x: Any) -> int:
    """The integer that stands for a number."""
    return int(mp.ldexp(mpf(x), BITS))


def number(c: int) -> mpf:
    """The number that an integer stands for."""
    return mp.ldexp(mpf(c), -BITS)


def zero_of_jet(series: list[int], known: int) -> mpf | None:
    """First place in [0, 1) where a jet changes its sign, but for so many zeros at 0."""
    while known < len(series) and not series[known]:
        known += 1
    rest = series[known:]
    if not rest or rest[0] > sum(map(abs, rest[1:])):
        return None
    return first_zero([number(one) for one in rest])


class Jet:
    """One series. `extend` says its next coefficient."""

    def __init__(self, tape: Tape, extend: Callable[[int], int]) -> None:
        self.tape, self.c, self.extend = tape, list[int](), extend
        tape.jets.append(self)

    def __add__(self, other: Any) -> Jet:
        b = other if isinstance(other, Jet) else self.tape.constant(other)
        return Jet(self.tape, lambda n: self.c[n] + b.c[n])

    def __sub__(self, other: Any) -> Jet:
        b = other if isinstance(other, Jet) else self.tape.constant(other)
        return Jet(self.tape, lambda n: self.c[n] - b.c[n])

    def __mul__(self, other: Any) -> Jet:
        if isinstance(other, Jet):
            return Jet(self.tape, lambda n: sum(map(mul, self.c, reversed(other.c))) >> BITS)
        k = fixed(other)
        return Jet(self.tape, lambda n: k * self.c[n] >> BITS)

    def power(self, k: int) -> Jet:
        """By squaring; k at least 1."""
        if k == 1:
            return self
        jet = self._squared(k)
        self.tape.powers.append((self, k, jet))
        return jet

    def _squared(self, k: int) -> Jet:
        if k == 1:
            return self
        half = self._squared(k // 2)
        return half * half * self if k % 2 else half * half


class Unknown(Jet):
    """A series that is integrated."""

    rate: Jet

    def __init__(self, tape: Tape, value: Any) -> None:
        self.tape, self.c = tape, [fixed(value)]
        tape.unknowns.append(self)


class Tape:
    """The series of one step."""

    def __init__(self) -> None:
        self.jets, self.unknowns = list[Jet](), list[Unknown]()
        self.powers = list[tuple[Jet, int, Jet]]()

    def constant(self, value: Any) -> Jet:
        """A series of one term."""
        k = fixed(value)
        return Jet(self, lambda n: 0 if n else k)

    def run(self, step: mpf, order: int) -> None:
        """Fill all series in up to an order, for a step."""
        h = fixed(step)
        for n in range(order):
            for jet in self.jets:
                jet.c.append(jet.extend(n))
            for unknown in self.unknowns:
                unknown.c.append((h * unknown.rate.c[n] >> BITS) // (n + 1))
        for jet in self.jets:
            jet.c.append(jet.extend(order))

    def stretch(self, tolerance: int, most: float = 4.0) -> float:
        """By what factor the step may change so that the last terms fall to 2^-tolerance."""
        factor = most
        for unknown in self.unknowns:
            for k in (len(unknown.c) - 1, len(unknown.c) - 2):
                if unknown.c[k]:
                    share = BITS - tolerance - unknown.c[k].bit_length()
                    factor = min(factor, 2.0 ** (share / k))
        while not self._ends_right(factor, tolerance):
            factor *= 0.7
        return factor

    def _ends_right(self, factor: float, tolerance: int) -> bool:
        """Whether powers are so near those of their bases at the step's end.

        The last terms do not see a power that begins beyond them: x^50 from x = 0.
        """
        for base, k, power in self.powers:
            approximate, exact = (value(rescaled(one.c, factor), mpf(1)) for one in (power, base))
            size = exact**k if abs(exact) > 1 else mpf(1)
            if abs(approximate - exact**k) > abs(size) * mpf(2) ** (20 - tolerance):
                return False
        return True


def rescaled(c: list[int], factor: float) -> list[int]:
    """The series for a step that is longer by a factor."""
    f, power, out = fixed(factor), 1 << BITS, []
    for one in c:
        out.append(one * power >> BITS)
        power = power * f >> BITS
    return out


def value(c: list[int], x: mpf) -> mpf:
    """Of a series at x."""
    at, total = fixed(x), 0
    for one in reversed(c):
        total = (total * at >> BITS) + one
    return number(total)
