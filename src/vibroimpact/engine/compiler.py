"""numba; where the engine is machine code already and no kernel is compiled, nothing in its place.

What is marked for numba then stays a function of Python, which nobody calls.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from vibroimpact.engine import native
from vibroimpact.errors import InputError

COMPILES = native.find_library() is None or bool(os.environ.get("VIBROIMPACT_KERNELS"))
"""Whether kernels are compiled: tests call them besides the entries of a library."""

if TYPE_CHECKING or COMPILES:
    try:
        import numba
    except ImportError:
        _why = native.choose().why or "VIBROIMPACT_KERNELS is set"
        raise InputError(
            f"engine: {_why}, so numba has to compile it, and numba is not installed; install it "
            "with: pip install numba"
        ) from None
    from numba import njit
    from numba.core import cgutils, types
    from numba.core.callconv import excinfo_t
    from numba.core.datamodel import models
    from numba.extending import intrinsic, overload, register_jitable, register_model

    PLAIN = bool(numba.config.DISABLE_JIT)  # type: ignore[attr-defined]
    """Whether numba leaves all functions to Python."""
else:

    class _Absent:
        def __getattr__(self, name: str) -> Any:
            return self

        def __call__(self, *args: Any, **options: Any) -> Any:
            return self

        def __mro_entries__(self, bases: Any) -> tuple[type, ...]:
            return (object,)

    def _marked(*args: Any, **options: Any) -> Callable[[Any], Any]:
        return lambda function: function

    cgutils = types = models = excinfo_t = _Absent()
    njit = overload = register_model = register_jitable = _marked

    PLAIN = False

    def intrinsic(function: Any) -> Any:
        """Leave it a function of Python."""
        return function


__all__ = [
    "COMPILES",
    "PLAIN",
    "cgutils",
    "excinfo_t",
    "intrinsic",
    "models",
    "njit",
    "overload",
    "register_jitable",
    "register_model",
    "types",
]
