"""Every compiler option of the engine, and why; and what is announced when code is compiled.

Two decorators: `kernel` for the functions that the physics is made of, `entry` for the few
that Python calls. An entry carries the kernels that it calls, so only entries are compiled
and cached.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.compiler import njit
from vibroimpact.stderr import print_line

F = TypeVar("F", bound=Callable[..., Any])

Vector = NDArray[np.float64]
"""What kernels read and write."""

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

CHOSEN: dict[str, Any] = {**OPTIONS, "no_cfunc_wrapper": True}
"""Of what is chosen by a type, which numba itself gives no wrapper for Python."""

WITHIN: dict[str, Any] = {**CHOSEN, "no_cpython_wrapper": True}
"""Of kernels, which only compiled code calls. Tests, which call them, ask for the second wrapper
before the engine is imported."""

announce: Callable[[str], None] = print_line
"""Called with one line before the first compilation of a process, which takes seconds."""

compiling = threading.Lock()
_announced = threading.Event()
_distrusted = threading.Event()


def kernel(function: F) -> F:
    """Compile a function that only other compiled functions call."""
    return _within(njit(**WITHIN)(function))  # type: ignore[no-any-return]


def inlined(function: F) -> F:
    """As `kernel`, merged into each function that calls it: for what a hot loop consists of."""
    return _within(njit(**WITHIN, forceinline=True)(function))  # type: ignore[no-any-return]


NOT_INLINED: set[str] = set()
"""Kernels that are not merged into their callers (see `not_inlined`): a module and a name each."""


def not_inlined(function: F) -> F:
    """As `kernel`, but never merged into its callers: for what a hot loop seldom does.

    Merged, it takes the loop's registers, and parts of it are computed in advance for nothing.
    """
    NOT_INLINED.add(f"{function.__module__}.{function.__qualname__}")
    # What an inlined function calls would be inlined, too, unless it says otherwise.
    return _within(njit(**WITHIN, forceinline=False)(function))  # type: ignore[no-any-return]


def _within(dispatcher: Any) -> Any:
    """Refuse calls from Python, which without a wrapper would crash it."""
    if WITHIN["no_cpython_wrapper"]:
        dispatcher._compile_for_args = _refused
    return dispatcher


def _refused(*args: Any, **kwargs: Any) -> Any:
    raise TypeError("a kernel was called from Python; only entries may be")


def say(why: str = "") -> None:
    """Announce once, with a reason; further parts of the engine compile without a word."""
    if not _announced.is_set():
        _announced.set()
        announce(
            f"compiling the engine{f', because {why}' if why else ''}: each part is compiled once, "
            "when it is first used, and takes 10 to 30 s ..."
        )


def say_refused(path: Path) -> None:
    """Announce once that compiled code was removed, because others may write to it."""
    if not _distrusted.is_set():
        _distrusted.set()
        announce(
            f"other users may write to {str(path)!r}, and whoever can write compiled code can run "
            "it as you; such files are removed and compiled again."
        )


def say_unsafe(path: Path) -> None:
    """Announce once that the cache is not used, because others may write to this part of it."""
    if not _distrusted.is_set():
        _distrusted.set()
        announce(
            f"other users may write to {str(path)!r}, and whoever can write compiled "
            "code can run it as you; the cache is not used. Remove the write permission of group "
            "and others (chmod go-w), or set VIBROIMPACT_CACHE_DIR to a folder of your own."
        )
