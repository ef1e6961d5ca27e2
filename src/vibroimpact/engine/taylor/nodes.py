"""Sixteen nodes of a leap, and the sums over them: integrals of what is known there.

The nodes are Gauss's. A sum is a matrix times sixteen numbers of a plan: written for LLVM as
operations on one vector of sixteen, with the matrix in the code, it takes a few nanoseconds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic, overload
from numpy.polynomial import legendre

from vibroimpact.engine.jit import Vector

COUNT = 16
"""Nodes of a leap: the motion between is a polynomial of this many terms."""

_AT, _GAUSS = legendre.leggauss(COUNT)
PLACES = (_AT + 1.0) / 2.0
"""Where in a leap they lie, a share of it."""

_UNITS = np.eye(COUNT)
_LEGENDRE = legendre.legvander(_AT, COUNT - 1)
_SPECTRUM = np.linalg.inv(_LEGENDRE)


def _integrated(times: int) -> np.ndarray:
    """From values at the nodes to the integral from the beginning to each node."""
    columns = [legendre.legval(_AT, legendre.legint(unit, times, lbnd=-1.0)) for unit in _UNITS]
    return np.array(columns).T @ _SPECTRUM / 2.0**times


_FUSED = ("contract",)
_WIDE = ir.VectorType(ir.DoubleType(), COUNT)
_INDEX = ir.IntType(64)


def _splat(builder: Any, one: Any) -> Any:
    undefined = ir.Constant(_WIDE, ir.Undefined)
    first = builder.insert_element(undefined, one, ir.Constant(ir.IntType(32), 0))
    zeros = ir.Constant(ir.VectorType(ir.IntType(32), COUNT), [0] * COUNT)
    return builder.shuffle_vector(first, undefined, zeros)


def _place(builder: Any, memory: Any, at: Any) -> Any:
    return builder.gep(memory, [at], inbounds=True, source_etype=ir.DoubleType())


def _sum(matrix: np.ndarray) -> Callable[..., None]:
    """Make a kernel: into = start + slope place + scale (matrix times source), node by node."""

    def plain(
        plan: Vector, source: int, into: int, scale: float, start: float, slope: float
    ) -> None:
        given = np.array([plan[source + j] for j in range(COUNT)])
        found = start + slope * PLACES + scale * (matrix @ given)
        for i in range(COUNT):
            plan[into + i] = found[i]

    @intrinsic
    def wide(
        typing: Any, plan: Any, source: Any, into: Any, scale: Any, start: Any, slope: Any
    ) -> Any:
        def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            plan, source, into, scale, start, slope = args

            def fused(a: Any, b: Any, c: Any) -> Any:
                return builder.fadd(builder.fmul(a, b, flags=_FUSED), c, flags=_FUSED)

            # Four sums side by side: each waits for a quarter of the products only.
            sums: list[Any] = [None] * 4
            for j in range(COUNT):
                place = _place(builder, plan, builder.add(source, _INDEX(j)))
                one = _splat(builder, builder.load(place, typ=ir.DoubleType()))
                column = ir.Constant(_WIDE, [float(a) for a in matrix[:, j]])
                before = sums[j % 4]
                sums[j % 4] = (
                    builder.fmul(column, one) if before is None else fused(column, one, before)
                )
            places = ir.Constant(_WIDE, [float(a) for a in PLACES])
            base = fused(places, _splat(builder, slope), _splat(builder, start))
            total = builder.fadd(builder.fadd(*sums[:2]), builder.fadd(*sums[2:]))
            total = fused(total, _splat(builder, scale), base)
            target = builder.bitcast(_place(builder, plan, into), _WIDE.as_pointer())
            builder.store(total, target, align=8)
            return context.get_dummy_value()

        whole, real = types.int64, types.float64
        return types.void(plan, whole, whole, real, real, real), build

    @overload(plain, strict=False)
    def _plain(plan: Any, source: Any, into: Any, scale: Any, start: Any, slope: Any) -> Any:
        return lambda plan, source, into, scale, start, slope: wide(  # type: ignore[call-arg]
            plan, source, into, scale, start, slope
        )

    return plain


class _Lanes:
    """A vector of sixteen, on which formulae are written as for one number."""

    def __init__(self, builder: Any, value: Any) -> None:
        self.builder, self.value = builder, value

    def _of(self, other: Any) -> Any:
        return other.value if isinstance(other, _Lanes) else ir.Constant(_WIDE, [other] * COUNT)

    def _new(self, value: Any) -> _Lanes:
        return _Lanes(self.builder, value)

    def __add__(self, other: Any) -> _Lanes:
        return self._new(self.builder.fadd(self.value, self._of(other), flags=_FUSED))

    def __sub__(self, other: Any) -> _Lanes:
        return self._new(self.builder.fsub(self.value, self._of(other), flags=_FUSED))

    def __rsub__(self, other: Any) -> _Lanes:
        return self._new(self.builder.fsub(self._of(other), self.value, flags=_FUSED))

    def __mul__(self, other: Any) -> _Lanes:
        return self._new(self.builder.fmul(self.value, self._of(other), flags=_FUSED))

    __radd__, __rmul__ = __add__, __mul__


def nodewise(
    formula: Callable[..., Any], sources: Sequence[Any], into: int
) -> Callable[[Vector, tuple[float, ...]], None]:
    """Make a kernel that computes one formula at all nodes at once.

    Parameters
    ----------
    formula
        Of what is at a node, and then of numbers that are the same for all: sums and products.
    sources
        Where in the plan what it begins with stands, or sixteen numbers.
    into
        Where in the plan the result goes.
    """
    # A loop would do, but LLVM unrolls one of a long body and leaves it scalar.

    def plain(plan: Vector, reals: tuple[float, ...]) -> None:
        found = []
        for i in range(COUNT):
            own = [plan[at + i] if isinstance(at, int) else float(at[i]) for at in sources]
            found.append(formula(*own, *reals))
        for i in range(COUNT):
            plan[into + i] = found[i]

    @intrinsic
    def wide(typing: Any, plan: Any, reals: Any) -> Any:
        def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            plan, given = args

            def place(at: int) -> Any:
                return builder.bitcast(_place(builder, plan, _INDEX(at)), _WIDE.as_pointer())

            lanes = [
                builder.load(place(at), align=8, typ=_WIDE)
                if isinstance(at, int)
                else ir.Constant(_WIDE, [float(a) for a in at])
                for at in sources
            ]
            lanes += [
                _splat(builder, builder.extract_value(given, i))
                for i in range(signature.args[1].count)
            ]
            result = formula(*(_Lanes(builder, one) for one in lanes))
            builder.store(result.value, place(into), align=8)
            return context.get_dummy_value()

        return types.void(plan, reals), build

    @overload(plain, strict=False)
    def _plain(plan: Any, reals: Any) -> Any:
        return lambda plan, reals: wide(plan, reals)  # type: ignore[call-arg]

    return plain


def polynomial(coefficients: Sequence[float]) -> Callable[[Any], Any]:
    """Σ coefficient yⁿ as a formula, even and odd powers apart: half as long to wait for."""

    def half(first: int, square: Any) -> Any:
        *rest, total = coefficients[first::2]
        for a in reversed(rest):
            total = square * total + a
        return total

    def formula(y: Any) -> Any:
        square = y * y
        return half(0, square) + y * half(1, square)

    return formula


integral = _sum(_integrated(1))
"""∫ from the beginning to each node."""

twice = _sum(_integrated(2))
"""∫∫."""

spectrum = _sum(_SPECTRUM)
"""Coefficients of Legendre's polynomials."""

_ENDS = np.array([_GAUSS / 2.0, (1.0 - PLACES) * _GAUSS / 2.0])
END_OF_ONE, END_OF_TWO = _ENDS[0], _ENDS[1]
"""Weights of the integral to the end, and of the integral's integral."""


SINES = polynomial([(-1.0) ** n / math.factorial(2 * n + 1) for n in range(9)])
"""sin(y)/y from y², |y| up to 1."""

COSINES = polynomial([(-1.0) ** n / math.factorial(2 * n) for n in range(10)])
"""cos(y) from y²."""

FADING = polynomial([(-1.0) ** n / math.factorial(n + 1) for n in range(18)])
"""(1 − exp(−y))/y, |y| up to 1."""
