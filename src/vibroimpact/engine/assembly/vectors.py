"""Sums of rows of eight numbers, which the compiler does not vectorize by itself."""

from __future__ import annotations

import inspect
import math
from typing import Any

from llvmlite import ir

from vibroimpact.engine.compiler import cgutils, intrinsic, overload, types
from vibroimpact.engine.jit import Vector

_EIGHT = ir.VectorType(ir.DoubleType(), 8)
_FUSED = ("contract",)
_DOUBLES = types.CPointer(types.float64)  # type: ignore[no-untyped-call]
_WORD = ir.IntType(64)
_LANE = ir.IntType(32)


def combine(rows: Vector, x: Vector, n: int, out: Vector) -> None:
    """Out = Σ x_i rows_i for eight numbers; rows follow each other."""
    for r in range(8):
        out[r] = sum(rows[8 * i + r] * x[i] for i in range(n))


def combine_sixteen(rows: Vector, x: Vector, n: int, out: Vector) -> None:
    """Out = Σ x_i rows_i for sixteen numbers; rows follow each other."""
    for r in range(16):
        out[r] = sum(rows[16 * i + r] * x[i] for i in range(n))


def combine_ranges(
    rows: Vector,
    x: Vector,
    u0: int,
    u1: int,
    v0: int,
    v1: int,
    w0: int,
    w1: int,
    y: Vector,
    y0: int,
    y1: int,
    out: Vector,
) -> None:
    """Out = Σ x_i rows_i for eight numbers over three ranges, + Σ y_i rows_(w1 + i) over one."""
    for r in range(8):
        total = sum(rows[8 * (w1 + i) + r] * y[i] for i in range(y0, y1))
        for begin, end in ((w0, w1), (u0, u1), (v0, v1)):
            total += sum(rows[8 * i + r] * x[i] for i in range(begin, end))
        out[r] = total


def scale(x: Vector, factor: float, out: Vector, n: int) -> None:
    """Out = factor · x for n numbers, and what follows them up to a multiple of eight."""
    for i in range(-(-n // 8) * 8):
        out[i] = factor * x[i]


def gains(rows: Vector, stride: int, order: int, tau: float, out: Vector) -> None:
    """Out = Σ rows_j τʲ over j = 1 … order (at least 2), for eight numbers."""
    for r in range(8):
        total = 0.0
        for j in range(order, 0, -1):
            total = (total + rows[j * stride + r]) * tau
        out[r] = total


def slopes(rows: Vector, stride: int, order: int, tau: float, out: Vector) -> None:
    """Out = Σ j rows_j τʲ; as `gains`."""
    for r in range(8):
        total = 0.0
        for j in range(order, 0, -1):
            total = (total + j * rows[j * stride + r]) * tau
        out[r] = total


def halve(b: Vector, right: Vector) -> None:
    """Sixteen Bernstein coefficients of a polynomial: b becomes those of its left half."""
    for k in range(15):
        right[15 - k] = b[15]
        for j in range(15, k, -1):
            b[j] = 0.5 * (b[j] + b[j - 1])
    right[0] = b[15]


def convolve(plan: Vector, a: int, b: int, n: int) -> float:
    """Σ a_i b_(−i) over i < n, for series that begin at places of the plan."""
    total = 0.0
    for i in range(n):
        total += plan[a + i] * plan[b - i]
    return total


def convolve_weighted(plan: Vector, a: int, b: int, n: int, begin: float, by: float) -> float:
    """Σ (begin + i · by) a_i b_(−i) over i < n."""
    total = 0.0
    for i in range(n):
        total += (begin + i * by) * plan[a + i] * plan[b - i]
    return total


def binary_logarithm(x: float) -> float:
    """The binary logarithm of a positive number within 0.09, by its bits."""
    share, exponent = math.frexp(x)
    return exponent - 2.0 + 2.0 * share


def binary_power(y: float) -> float:
    """Invert `binary_logarithm`, from −1000 to 1000."""
    whole = math.floor(y)
    return math.ldexp(1.0 + y - whole, whole)


def _zero() -> Any:
    return ir.Constant(_EIGHT, [0.0] * 8)


def _eight(builder: Any, memory: Any, index: Any) -> Any:
    """Eight numbers from a place on."""
    at = builder.gep(memory, [index], source_etype=ir.DoubleType())
    return builder.load(builder.bitcast(at, _EIGHT.as_pointer()), typ=_EIGHT, align=8)


def _store(builder: Any, eight: Any, memory: Any, index: Any) -> None:
    at = builder.gep(memory, [index], source_etype=ir.DoubleType())
    builder.store(eight, builder.bitcast(at, _EIGHT.as_pointer()), align=8)


def _spread(builder: Any, one: Any, kind: Any = _EIGHT) -> Any:
    """One number, eight times."""
    first = builder.insert_element(ir.Constant(kind, ir.Undefined), one, ir.Constant(_LANE, 0))
    every = ir.Constant(ir.VectorType(_LANE, 8), [0] * 8)
    return builder.shuffle_vector(first, first, every)


def _number(builder: Any, memory: Any, index: Any) -> Any:
    at = builder.gep(memory, [index], source_etype=ir.DoubleType())
    return builder.load(at, typ=ir.DoubleType())


def _fused(builder: Any, a: Any, b: Any, c: Any) -> Any:
    return builder.fadd(c, builder.fmul(a, b, flags=_FUSED), flags=_FUSED)


def _word(n: int) -> Any:
    return ir.Constant(_WORD, n)


def _total(builder: Any) -> Any:
    total = cgutils.alloca_once(builder, _EIGHT)  # type: ignore[no-untyped-call]
    builder.store(_zero(), total)
    return total


def _add(builder: Any, total: Any, a: Any, b: Any) -> None:
    builder.store(_fused(builder, a, b, builder.load(total, typ=_EIGHT)), total)


@intrinsic
def _combine(typing: Any, rows: Any, x: Any, n: Any, out: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        rows, x, n, out = args
        totals = [_total(builder) for _ in range(2)]

        def add(i: Any, part: int) -> None:
            row = _eight(builder, rows, builder.shl(i, _word(3)))
            _add(builder, totals[part], row, _spread(builder, _number(builder, x, i)))

        with cgutils.for_range(builder, builder.lshr(n, _word(1))) as loop:
            first = builder.shl(loop.index, _word(1))  # two sums, as each waits for itself
            add(first, 0)
            add(builder.add(first, _word(1)), 1)
        with cgutils.for_range(builder, builder.and_(n, _word(1))):
            add(builder.sub(n, _word(1)), 0)
        parts = [builder.load(one, typ=_EIGHT) for one in totals]
        _store(builder, builder.fadd(*parts), out, _word(0))
        return context.get_dummy_value()

    return types.void(_DOUBLES, _DOUBLES, types.int64, _DOUBLES), build


@intrinsic
def _combine_sixteen(typing: Any, rows: Any, x: Any, n: Any, out: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        rows, x, n, out = args
        totals = [_total(builder) for _ in range(4)]

        def add(row: Any, part: int) -> None:
            one = _spread(builder, _number(builder, x, row))
            at = builder.mul(row, _word(16))
            for half in range(2):
                here = _eight(builder, rows, builder.add(at, _word(8 * half)))
                _add(builder, totals[2 * part + half], here, one)

        pairs = builder.lshr(n, _word(1))
        with cgutils.for_range(builder, pairs) as loop:  # two sums, as each waits for itself
            first = builder.shl(loop.index, _word(1))
            add(first, 0)
            add(builder.add(first, _word(1)), 1)
        with cgutils.for_range(builder, builder.and_(n, _word(1))):
            add(builder.sub(n, _word(1)), 0)
        for half in range(2):
            parts = [builder.load(totals[2 * part + half], typ=_EIGHT) for part in range(2)]
            _store(builder, builder.fadd(*parts), out, _word(8 * half))
        return context.get_dummy_value()

    return types.void(_DOUBLES, _DOUBLES, types.int64, _DOUBLES), build


@intrinsic
def _combine_ranges(
    typing: Any,
    rows: Any,
    x: Any,
    u0: Any,
    u1: Any,
    v0: Any,
    v1: Any,
    w0: Any,
    w1: Any,
    y: Any,
    y0: Any,
    y1: Any,
    out: Any,
) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        rows, x, u0, u1, v0, v1, w0, w1, y, y0, y1, out = args
        early, late = _total(builder), _total(builder)

        def add(total: Any, begin: Any, end: Any, numbers: Any, row: Any) -> None:
            with cgutils.for_range(builder, builder.sub(end, begin)) as loop:
                i = builder.add(begin, loop.index)
                here = builder.shl(builder.add(i, row), _word(3))
                one = _spread(builder, _number(builder, numbers, i))
                _add(builder, total, _eight(builder, rows, here), one)

        # What is computed last is added last: only that is waited for.
        add(early, w0, w1, x, _word(0))
        add(early, u0, u1, x, _word(0))
        add(early, y0, y1, y, w1)
        add(late, v0, v1, x, _word(0))
        sums = [builder.load(one, typ=_EIGHT) for one in (early, late)]
        _store(builder, builder.fadd(*sums), out, _word(0))
        return context.get_dummy_value()

    n = types.int64
    return types.void(_DOUBLES, _DOUBLES, n, n, n, n, n, n, _DOUBLES, n, n, _DOUBLES), build


@intrinsic
def _scale(typing: Any, x: Any, factor: Any, out: Any, n: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        x, factor, out, n = args
        every = _spread(builder, factor)
        blocks = builder.lshr(builder.add(n, _word(7)), _word(3))
        with cgutils.for_range(builder, blocks) as loop:
            i = builder.shl(loop.index, _word(3))
            _store(builder, builder.fmul(_eight(builder, x, i), every), out, i)
        return context.get_dummy_value()

    return types.void(_DOUBLES, types.float64, _DOUBLES, types.int64), build


def _series_sum(weighted: bool) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        rows, stride, order, tau, out = args
        t = _spread(builder, tau)
        square = builder.fmul(t, t)

        def coefficient(j: Any) -> Any:
            row = _eight(builder, rows, builder.mul(j, stride))
            if not weighted:
                return row
            weight = builder.sitofp(j, ir.DoubleType())
            return builder.fmul(row, _spread(builder, weight))

        # Odd and even powers separately, as each sum waits for itself.
        high, low = _total(builder), _total(builder)

        def include(total: Any, j: Any) -> None:
            before = builder.load(total, typ=_EIGHT)
            builder.store(_fused(builder, before, square, coefficient(j)), total)

        with cgutils.for_range(builder, builder.lshr(order, _word(1))) as loop:
            j = builder.sub(order, builder.shl(loop.index, _word(1)))
            include(high, j)
            include(low, builder.sub(j, _word(1)))
        odd = builder.and_(order, _word(1))
        with cgutils.for_range(builder, odd):
            include(high, _word(1))
        is_odd = builder.icmp_unsigned("!=", odd, _word(0))
        upper, lower = (builder.load(one, typ=_EIGHT) for one in (high, low))
        ones, twos = builder.select(is_odd, upper, lower), builder.select(is_odd, lower, upper)
        total = builder.fmul(_fused(builder, twos, t, ones), t)
        _store(builder, total, out, _word(0))
        return context.get_dummy_value()

    return build


@intrinsic
def _gains(typing: Any, rows: Any, stride: Any, order: Any, tau: Any, out: Any) -> Any:
    n = types.int64
    return types.void(_DOUBLES, n, n, types.float64, _DOUBLES), _series_sum(False)


@intrinsic
def _slopes(typing: Any, rows: Any, stride: Any, order: Any, tau: Any, out: Any) -> Any:
    n = types.int64
    return types.void(_DOUBLES, n, n, types.float64, _DOUBLES), _series_sum(True)


@intrinsic
def _halve(typing: Any, b: Any, right: Any) -> Any:
    # Coefficient j of a half is the sum over i ≤ j of C(j, i) b_i / 2ʲ; of the other one, mirrored.
    shares = [[math.comb(j, i) / 2.0**j for i in range(16)] for j in range(16)]

    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        b, right = args
        each = [_spread(builder, _number(builder, b, _word(i))) for i in range(16)]

        def block(low: bool, mirrored: bool) -> Any:
            """Eight of the coefficients; long sums in two parts, as each waits for itself."""
            rows = range(8) if low else range(8, 16)
            parts = []
            for begin in range(0, 8 if low else 16, 8):
                total = _zero()
                for i in range(begin, begin + 8):
                    column = [shares[j][i] for j in rows]
                    if mirrored:
                        column.reverse()
                    one = each[15 - i if mirrored else i]
                    total = _fused(builder, ir.Constant(_EIGHT, column), one, total)
                parts.append(total)
            return builder.fadd(*parts) if len(parts) > 1 else parts[0]

        high = block(False, False)
        middle = builder.extract_element(high, ir.Constant(_LANE, 7))
        _store(builder, block(True, False), b, _word(0))
        _store(builder, high, b, _word(8))
        # Both halves meet in the same number.
        first = builder.insert_element(block(False, True), middle, ir.Constant(_LANE, 0))
        _store(builder, first, right, _word(0))
        _store(builder, block(True, True), right, _word(8))
        return context.get_dummy_value()

    return types.void(_DOUBLES, _DOUBLES), build


def _convolving(weighted: bool) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        plan, a, b, n, *weights = args
        total = _total(builder)
        lanes = ir.Constant(ir.VectorType(_WORD, 8), list(range(8)))
        back = ir.Constant(ir.VectorType(_LANE, 8), list(range(7, -1, -1)))

        def pair(i: Any) -> tuple[Any, Any]:
            x = _eight(builder, plan, builder.add(a, i))
            y = _eight(builder, plan, builder.sub(builder.sub(b, i), _word(7)))
            if weighted:
                begin, by = weights
                first = builder.fadd(begin, builder.fmul(by, builder.sitofp(i, ir.DoubleType())))
                steps = ir.Constant(_EIGHT, [float(k) for k in range(8)])
                here = builder.fmul(_spread(builder, by), steps)
                x = builder.fmul(x, builder.fadd(here, _spread(builder, first)))
            return x, builder.shuffle_vector(y, y, back)

        with cgutils.for_range(builder, builder.lshr(n, _word(3))) as loop:
            _add(builder, total, *pair(builder.shl(loop.index, _word(3))))
        # What stands beyond the ends is not zero, nor need it be a number.
        rest = builder.and_(n, _word(7))
        left = _spread(builder, rest, ir.VectorType(_WORD, 8))
        inside = builder.icmp_signed("<", lanes, left)
        last = builder.select(inside, builder.fmul(*pair(builder.sub(n, rest))), _zero())
        sums = builder.fadd(builder.load(total, typ=_EIGHT), last)
        for width in (4, 2):
            halves = [
                builder.shuffle_vector(
                    sums,
                    sums,
                    ir.Constant(
                        ir.VectorType(_LANE, width), list(range(half * width, (half + 1) * width))
                    ),
                )
                for half in range(2)
            ]
            sums = builder.fadd(*halves)
        ends = [builder.extract_element(sums, ir.Constant(_LANE, k)) for k in range(2)]
        return builder.fadd(*ends)

    return build


@intrinsic
def _convolve(typing: Any, plan: Any, a: Any, b: Any, n: Any) -> Any:
    return types.float64(_DOUBLES, types.int64, types.int64, types.int64), _convolving(False)


@intrinsic
def _convolve_weighted(typing: Any, plan: Any, a: Any, b: Any, n: Any, begin: Any, by: Any) -> Any:
    n_, x = types.int64, types.float64
    return types.float64(_DOUBLES, n_, n_, n_, x, x), _convolving(True)


@intrinsic
def _binary_logarithm(typing: Any, x: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        bits = builder.sitofp(builder.bitcast(args[0], _WORD), ir.DoubleType())
        scaled = builder.fmul(bits, ir.Constant(ir.DoubleType(), 2.0**-52))
        return builder.fsub(scaled, ir.Constant(ir.DoubleType(), 1023.0))

    return types.float64(types.float64), build


@intrinsic
def _binary_power(typing: Any, y: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        shifted = builder.fadd(args[0], ir.Constant(ir.DoubleType(), 1023.0))
        bits = builder.fmul(shifted, ir.Constant(ir.DoubleType(), 2.0**52))
        return builder.bitcast(builder.fptosi(bits, _WORD), ir.DoubleType())

    return types.float64(types.float64), build


def _replaces(plain: Any, made: Any) -> None:
    """Let compiled code call an intrinsic in the place of a function of Python."""
    names = ", ".join(inspect.signature(plain).parameters)
    scope: dict[str, Any] = {"made": made}
    exec(f"def implementation({names}): return made({names})", scope)

    @overload(plain, strict=False)
    def _chosen(*args: Any) -> Any:
        return scope["implementation"]


_replaces(combine, _combine)
_replaces(combine_sixteen, _combine_sixteen)
_replaces(combine_ranges, _combine_ranges)
_replaces(scale, _scale)
_replaces(gains, _gains)
_replaces(slopes, _slopes)
_replaces(halve, _halve)
_replaces(convolve, _convolve)
_replaces(convolve_weighted, _convolve_weighted)
_replaces(binary_logarithm, _binary_logarithm)
_replaces(binary_power, _binary_power)
