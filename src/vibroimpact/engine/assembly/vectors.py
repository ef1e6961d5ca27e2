"""Sums of rows of eight numbers, which the compiler does not vectorize by itself."""

from __future__ import annotations

from typing import Any

from llvmlite import ir

from vibroimpact.engine.compiler import cgutils, intrinsic, overload, types
from vibroimpact.engine.jit import Vector

_EIGHT = ir.VectorType(ir.DoubleType(), 8)
_FUSED = ("contract",)
_DOUBLES = types.CPointer(types.float64)  # type: ignore[no-untyped-call]


def combine(rows: Vector, stride: int, x: Vector, n: int, out: Vector) -> None:
    """Out = Σ x_i rows_i for eight numbers; row i begins at i · stride."""
    for r in range(8):
        out[r] = sum(rows[i * stride + r] * x[i] for i in range(n))


@intrinsic
def _combine(typing: Any, rows: Any, stride: Any, x: Any, n: Any, out: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        rows, stride, x, n, out = args
        double = ir.DoubleType()
        total = cgutils.alloca_once(builder, _EIGHT)  # type: ignore[no-untyped-call]
        builder.store(ir.Constant(_EIGHT, [0.0] * 8), total)
        with cgutils.for_range(builder, n) as loop:
            at = builder.gep(rows, [builder.mul(loop.index, stride)], source_etype=double)
            eight = builder.bitcast(at, _EIGHT.as_pointer())
            row = builder.load(eight, typ=_EIGHT, align=8)
            one = builder.load(builder.gep(x, [loop.index], source_etype=double), typ=double)
            lane = ir.Constant(ir.IntType(32), 0)
            first = builder.insert_element(ir.Constant(_EIGHT, ir.Undefined), one, lane)
            every = ir.Constant(ir.VectorType(ir.IntType(32), 8), [0] * 8)
            spread = builder.shuffle_vector(first, first, every)
            product = builder.fmul(row, spread, flags=_FUSED)
            before = builder.load(total, typ=_EIGHT)
            builder.store(builder.fadd(before, product, flags=_FUSED), total)
        target = builder.bitcast(out, _EIGHT.as_pointer())
        builder.store(builder.load(total, typ=_EIGHT), target, align=8)
        return context.get_dummy_value()

    return types.void(_DOUBLES, types.int64, _DOUBLES, types.int64, _DOUBLES), build


@overload(combine)
def _combined(rows: Any, stride: Any, x: Any, n: Any, out: Any) -> Any:
    def implementation(rows: Any, stride: Any, x: Any, n: Any, out: Any) -> None:
        _combine(rows, stride, x, n, out)  # type: ignore[call-arg]

    return implementation
