"""Raw memory for kernels to index.

numba passes an array as seven words, counts references to it and checks each index for being
negative. A plan goes through a dozen calls a forcing cycle; that was a third of the time
(docs/decisions/0003-numba-and-cache.md).
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir

from vibroimpact.engine.compiler import PLAIN, cgutils, intrinsic, overload, types
from vibroimpact.engine.jit import Vector

TERMS = 12
"""Length of a workspace: the coefficients of one long series."""

_DOUBLES = types.CPointer(types.float64)  # type: ignore[no-untyped-call]


def pointer(array: Vector) -> Vector:
    """The memory of a contiguous array of floats, indexed like it.

    The array must outlive the pointer: whoever makes one uses the array again afterwards.
    Without the compiler this is the array itself, in one row.
    """
    return array.reshape(-1)


def stack(size: int) -> Callable[[], Vector]:
    """Make a function that gives room for so many numbers, on the stack of the kernel that asks.

    It is an intrinsic itself: behind a function the room would be gone with that function's frame.
    """
    if PLAIN:
        return lambda: np.empty(size)

    @intrinsic
    def buffer(typing: Any) -> Any:
        def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            array = cgutils.alloca_once(  # type: ignore[no-untyped-call]
                builder, ir.ArrayType(ir.DoubleType(), size)
            )
            return builder.bitcast(array, ir.DoubleType().as_pointer())

        return _DOUBLES(), build

    return buffer  # type: ignore[return-value]


workspace = stack(TERMS)
"""Room for the coefficients of a long series."""


@intrinsic
def _address(typing: Any, array: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return context.make_array(signature.args[0])(context, builder, args[0]).data

    return _DOUBLES(array), build


@intrinsic
def _load(typing: Any, memory: Any, index: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        at = builder.gep(args[0], [args[1]], inbounds=True, source_etype=ir.DoubleType())
        return builder.load(at, typ=ir.DoubleType())

    return types.float64(memory, index), build


@intrinsic
def _store(typing: Any, memory: Any, index: Any, value: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        at = builder.gep(args[0], [args[1]], inbounds=True, source_etype=ir.DoubleType())
        builder.store(args[2], at)
        return context.get_dummy_value()

    return types.void(memory, index, types.float64), build


@intrinsic
def _beyond(typing: Any, memory: Any, at: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.gep(args[0], [args[1]], inbounds=True, source_etype=ir.DoubleType())

    return _DOUBLES(memory, types.int64), build


def beyond(memory: Vector, at: int) -> Vector:
    """The memory from a place on."""
    return memory[at:]


@overload(beyond)
def _from(memory: Any, at: Any) -> Any:
    def implementation(memory: Any, at: Any) -> Any:
        return _beyond(memory, at)  # type: ignore[call-arg]

    def of_array(memory: Any, at: Any) -> Any:
        return _beyond(_address(memory), at)  # type: ignore[call-arg]

    return of_array if isinstance(memory, types.Array) else implementation


@overload(pointer)
def _pointer(array: Any) -> Any:
    def implementation(array: Any) -> Any:
        return _address(array)  # type: ignore[call-arg]

    return implementation


@overload(operator.getitem)
def _getitem(memory: Any, index: Any) -> Any:
    def implementation(memory: Any, index: Any) -> Any:
        return _load(memory, index)  # type: ignore[call-arg]

    return (
        implementation
        if isinstance(memory, types.CPointer) and isinstance(index, types.Integer)
        else None
    )


@overload(operator.setitem)
def _setitem(memory: Any, index: Any, value: Any) -> Any:
    def implementation(memory: Any, index: Any, value: Any) -> Any:
        _store(memory, index, value)  # type: ignore[call-arg]

    return (
        implementation
        if isinstance(memory, types.CPointer) and isinstance(index, types.Integer)
        else None
    )
