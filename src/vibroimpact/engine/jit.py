"""Every compiler option of the engine, and why."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import numba

F = TypeVar("F", bound=Callable[..., Any])

OPTIONS: dict[str, Any] = {
    # A product and a sum may become one fused operation: faster and closer to exact.
    # No other liberty is given: NaN is data here, and reordered sums would make results
    # depend on the compiler.
    "fastmath": {"contract"},
    # Kernels guard their own divisions; Python's zero check would cost a branch in each.
    "error_model": "numpy",
    "boundscheck": False,
    # A sweep is one call; threads run several at once, so the lock must be free.
    "nogil": True,
}


def kernel(function: F) -> F:
    """Compile a function that only other compiled functions call."""
    return numba.njit(**OPTIONS)(function)  # type: ignore[no-any-return]
