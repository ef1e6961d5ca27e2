"""Numbers of a formula: those of the machine code being emitted, or plain floats.

A formula is written once, in Python, over whatever has the usual operators. Run with a `Code` it
emits straight code, without loops, whose numbers live in registers; run with `Plain` it computes.
"""

from __future__ import annotations

import math
import struct
from typing import Any

from llvmlite import ir

REAL = ir.DoubleType()
WHOLE = ir.IntType(64)


class Number:
    """A number of the code being emitted."""

    __slots__ = ("builder", "value")

    def __init__(self, builder: Any, value: Any) -> None:
        self.builder, self.value = builder, value

    def _of(self, other: Any) -> Any:
        return other.value if isinstance(other, Number) else ir.Constant(REAL, float(other))

    def _new(self, value: Any) -> Number:
        return Number(self.builder, value)

    def __add__(self, other: Any) -> Any:
        if not isinstance(other, (Number, float, int)):
            return NotImplemented
        if not isinstance(other, Number) and other == 0.0:
            return self
        return self._new(self.builder.fadd(self.value, self._of(other)))

    def __sub__(self, other: Any) -> Any:
        if not isinstance(other, (Number, float, int)):
            return NotImplemented
        if not isinstance(other, Number) and other == 0.0:
            return self
        return self._new(self.builder.fsub(self.value, self._of(other)))

    def __rsub__(self, other: Any) -> Number:
        return self._new(self.builder.fsub(self._of(other), self.value))

    def __mul__(self, other: Any) -> Any:
        if not isinstance(other, (Number, float, int)):
            return NotImplemented
        if not isinstance(other, Number):
            if other == 1.0:
                return self
            if other == 0.0:
                return 0.0
        return self._new(self.builder.fmul(self.value, self._of(other)))

    def __truediv__(self, other: Any) -> Number:
        return self._new(self.builder.fdiv(self.value, self._of(other)))

    def __rtruediv__(self, other: Any) -> Number:
        return self._new(self.builder.fdiv(self._of(other), self.value))

    def __neg__(self) -> Number:
        return self._new(self.builder.fneg(self.value))

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)

    __radd__, __rmul__ = __add__, __mul__


def whole_power(base: Any, exponent: int) -> Any:
    """Raise to a whole power by products; the same products for numbers and for series."""
    result, square = None, base
    while exponent:
        if exponent & 1:
            result = square if result is None else result * square
        exponent >>= 1
        if exponent:
            square = square * square
    return 1.0 if result is None else result


LANES = 4
"""Of what is summed over a whole series."""

_SHORT = ir.IntType(32)


class Lanes:
    """A few numbers side by side, in code."""

    __slots__ = ("builder", "kind", "value")

    def __init__(self, builder: Any, value: Any) -> None:
        self.builder, self.value, self.kind = builder, value, value.type

    @staticmethod
    def of(builder: Any, numbers: Any) -> Lanes:
        """Put numbers side by side."""
        value = ir.Constant(ir.VectorType(REAL, len(numbers)), ir.Undefined)
        for i, one in enumerate(numbers):
            one = one.value if isinstance(one, Number) else ir.Constant(REAL, float(one))
            value = builder.insert_element(value, one, _SHORT(i))
        return Lanes(builder, value)

    def _of(self, other: Any) -> Any:
        if isinstance(other, Lanes):
            return other.value
        if isinstance(other, Number):
            return Lanes.of(self.builder, [other] * self.kind.count).value
        if any(isinstance(one, Number) for one in other):
            return Lanes.of(self.builder, other).value
        return ir.Constant(self.kind, [float(one) for one in other])

    def __add__(self, other: Any) -> Lanes:
        return Lanes(self.builder, self.builder.fadd(self.value, self._of(other)))

    def __mul__(self, other: Any) -> Lanes:
        return Lanes(self.builder, self.builder.fmul(self.value, self._of(other)))

    def _call(self, name: str, *values: Any) -> Lanes:
        kind = ir.FunctionType(self.kind, [self.kind] * len(values))
        name = f"llvm.{name}.v{self.kind.count}f64"
        function = self.builder.module.declare_intrinsic(name, (), kind)
        return Lanes(self.builder, self.builder.call(function, values))

    def times(self, weights: Any, base: Lanes | None) -> Lanes:
        """Multiply by weights and add."""
        if base is None:
            return Lanes(self.builder, self.builder.fmul(self.value, self._of(weights)))
        return self._call("fma", self.value, self._of(weights), base.value)

    def absolute(self) -> Lanes:
        """Return the size."""
        return self._call("fabs", self.value)

    def lane(self, i: int) -> Number:
        """Take one of them."""
        return Number(self.builder, self.builder.extract_element(self.value, _SHORT(i)))

    def swapped(self) -> Lanes:
        """Take the second of two, then the first."""
        nothing = ir.Constant(self.kind, ir.Undefined)
        order = ir.Constant(ir.VectorType(_SHORT, 2), [1, 0])
        return Lanes(self.builder, self.builder.shuffle_vector(self.value, nothing, order))

    def turned(self, by: int, count: int) -> Lanes:
        """Move the first ones so many places down, the last of them to the top."""
        places = [(i + by) % count if i < count else i for i in range(self.kind.count)]
        order = ir.Constant(ir.VectorType(_SHORT, len(places)), places)
        nothing = ir.Constant(self.kind, ir.Undefined)
        return Lanes(self.builder, self.builder.shuffle_vector(self.value, nothing, order))

    def first(self, count: int) -> Lanes:
        """Keep the first ones, zero behind."""
        places = [i if i < count else self.kind.count for i in range(self.kind.count)]
        order = ir.Constant(ir.VectorType(_SHORT, len(places)), places)
        nothing = ir.Constant(self.kind, [0.0] * self.kind.count)
        return Lanes(self.builder, self.builder.shuffle_vector(self.value, nothing, order))

    def total(self) -> Number:
        """Add the four."""
        pair = ir.VectorType(_SHORT, 2)
        nothing = ir.Constant(self.kind, ir.Undefined)
        low, high = (
            self.builder.shuffle_vector(self.value, nothing, ir.Constant(pair, [i, i + 1]))
            for i in (0, 2)
        )
        both = self.builder.fadd(low, high)
        one, other = (self.builder.extract_element(both, _SHORT(i)) for i in (0, 1))
        return Number(self.builder, self.builder.fadd(one, other))


class PlainLanes:
    """The same in floats."""

    def __init__(self, numbers: Any) -> None:
        self.numbers = [float(one) for one in numbers]

    def _of(self, other: Any) -> Any:
        if isinstance(other, PlainLanes):
            return other.numbers
        return [other] * len(self.numbers) if isinstance(other, float) else other

    def __add__(self, other: Any) -> PlainLanes:
        return PlainLanes(a + b for a, b in zip(self.numbers, self._of(other), strict=True))

    def __mul__(self, other: Any) -> PlainLanes:
        return PlainLanes(a * b for a, b in zip(self.numbers, self._of(other), strict=True))

    def times(self, weights: Any, base: PlainLanes | None) -> PlainLanes:
        """Multiply by weights and add."""
        by = PlainLanes(a * b for a, b in zip(self.numbers, self._of(weights), strict=True))
        return by if base is None else by + base

    def absolute(self) -> PlainLanes:
        """Return the size."""
        return PlainLanes(abs(one) for one in self.numbers)

    def lane(self, i: int) -> float:
        """Take one of them."""
        return self.numbers[i]

    def swapped(self) -> PlainLanes:
        """Take the second of two, then the first."""
        return PlainLanes(reversed(self.numbers))

    def total(self) -> float:
        """Add the four."""
        a, b, c, d = self.numbers
        return (a + c) + (b + d)


class Code:
    """Emits a function of (memory, numbers...), block by block within one function."""

    def __init__(self, builder: Any, memory: Any, numbers: Any) -> None:
        self.builder, self.memory = builder, memory
        self.arguments = [Number(builder, one) for one in numbers]

    def _place(self, at: int) -> Any:
        return self.builder.gep(self.memory, [WHOLE(at)], inbounds=True, source_etype=REAL)

    def load(self, at: int) -> Any:
        """Read a number of the memory."""
        return Number(self.builder, self.builder.load(self._place(at), typ=REAL))

    def store(self, at: int, number: Any) -> None:
        """Write a number to the memory."""
        value = number.value if isinstance(number, Number) else ir.Constant(REAL, float(number))
        self.builder.store(value, self._place(at))

    def load_lanes(self, at: int, count: int) -> Lanes:
        """Read numbers side by side."""
        kind = ir.VectorType(REAL, count)
        place = self.builder.bitcast(self._place(at), kind.as_pointer())
        return Lanes(self.builder, self.builder.load(place, typ=kind, align=8))

    def store_lanes(self, at: int, lanes: Lanes) -> None:
        """Write numbers side by side."""
        place = self.builder.bitcast(self._place(at), lanes.kind.as_pointer())
        self.builder.store(lanes.value, place, align=8)

    def _call(self, name: str, *numbers: Any) -> Number:
        types = [REAL] * len(numbers)
        function = self.builder.module.declare_intrinsic(name, (), ir.FunctionType(REAL, types))
        values = [
            one.value if isinstance(one, Number) else ir.Constant(REAL, float(one))
            for one in numbers
        ]
        return Number(self.builder, self.builder.call(function, values))

    def fma(self, a: Any, b: Any, c: Any) -> Any:
        """Compute a b + c, rounded once; of lanes a, side by side."""
        if isinstance(a, Lanes):
            return a.times(b, c if isinstance(c, Lanes) else None)
        if any(not isinstance(one, Number) and one == 0.0 for one in (a, b)):
            return c
        if not isinstance(c, Number) and c == 0.0:
            return a * b
        if not isinstance(a, Number) and not isinstance(b, Number):
            return c + a * b
        if not isinstance(a, Number) and a == 1.0:
            return b + c
        if not isinstance(b, Number) and b == 1.0:
            return a + c
        return self._call("llvm.fma.f64", a, b, c)

    def lanes(self, numbers: Any) -> Lanes:
        """Put numbers side by side."""
        return Lanes.of(self.builder, numbers)

    def absolute(self, a: Any) -> Any:
        """Return the size."""
        return self._call("llvm.fabs.f64", a)

    def _chosen(self, sign: str, a: Any, b: Any) -> Any:
        one, other = (Number(self.builder, None)._of(x) for x in (a, b))
        test = self.builder.fcmp_ordered(sign, one, other)
        return Number(self.builder, self.builder.select(test, one, other))

    def least(self, a: Any, b: Any) -> Any:
        """Return the lesser; b if either is not a number."""
        return self._chosen("<", a, b)

    def most(self, a: Any, b: Any) -> Any:
        """Return the greater; b if either is not a number."""
        return self._chosen(">", a, b)

    def exponential(self, a: Any) -> Any:
        """Return e to this power."""
        return self._call("llvm.exp.f64", a)

    def sine(self, a: Any) -> Any:
        """Return the sine."""
        return self._call("llvm.sin.f64", a)

    def cosine(self, a: Any) -> Any:
        """Return the cosine."""
        return self._call("llvm.cos.f64", a)

    def signed(self, a: Any, b: Any) -> Any:
        """Return the size of a with the sign of b."""
        return self._call("llvm.copysign.f64", a, b)

    def power(self, a: Any, b: Any) -> Any:
        """Return a to the power of b."""
        return self._call("llvm.pow.f64", a, b)

    def root(self, a: Any) -> Any:
        """Return the square root."""
        return self._call("llvm.sqrt.f64", a)

    def bits(self, a: Any) -> Any:
        """Read the bits of a number above 0 as a whole number, as a number: its logarithm, nearly.

        Over 2^52, and less 1023, that is the binary logarithm within 0.09.
        """
        return Number(self.builder, self.builder.sitofp(self.builder.bitcast(a.value, WHOLE), REAL))

    def of_bits(self, a: Any) -> Any:
        """Invert `bits`."""
        whole = self.builder.fptosi(a.value, WHOLE)
        return Number(self.builder, self.builder.bitcast(whole, REAL))


class Plain:
    """The same with floats and an array."""

    def __init__(self, memory: Any, numbers: Any) -> None:
        self.memory, self.arguments = memory, [float(one) for one in numbers]

    def load(self, at: int) -> float:
        """Read a number of the memory."""
        return float(self.memory[at])

    def store(self, at: int, number: float) -> None:
        """Write a number to the memory."""
        self.memory[at] = number

    def fma(self, a: float, b: float, c: float) -> float:
        """Compute a b + c."""
        return a * b + c

    def lanes(self, numbers: Any) -> PlainLanes:
        """Put numbers side by side."""
        return PlainLanes(numbers)

    def absolute(self, a: float) -> float:
        """Return the size."""
        return abs(a)

    def least(self, a: float, b: float) -> float:
        """Return the lesser."""
        return a if a < b else b

    def most(self, a: float, b: float) -> float:
        """Return the greater."""
        return a if a > b else b

    def exponential(self, a: float) -> float:
        """Return e to this power."""
        return math.exp(a) if a < 709.0 else math.inf

    def sine(self, a: float) -> float:
        """Return the sine."""
        return math.sin(a) if abs(a) < math.inf else math.nan

    def signed(self, a: float, b: float) -> float:
        """Return the size of a with the sign of b."""
        return math.copysign(a, b)

    def cosine(self, a: float) -> float:
        """Return the cosine."""
        return math.cos(a) if abs(a) < math.inf else math.nan

    def power(self, a: float, b: float) -> float:
        """Return a to the power of b."""
        try:
            return float(a**b) if a > 0.0 else (0.0 if a == 0.0 and b > 0.0 else math.nan)
        except OverflowError:
            return math.inf

    def root(self, a: float) -> float:
        """Return the square root."""
        return math.sqrt(a)

    def bits(self, a: float) -> float:
        """Read the bits as a whole number."""
        return float(struct.unpack("<q", struct.pack("<d", a))[0])

    def of_bits(self, a: float) -> float:
        """Invert `bits`."""
        return float(struct.unpack("<d", struct.pack("<q", int(a)))[0])
