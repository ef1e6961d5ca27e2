"""Every compiler option of the engine, and why; and the cache of compiled code.

Two decorators: `kernel` for the functions that the physics is made of, `entry` for the few
that Python calls. An entry carries the kernels that it calls, so only entries are compiled
and cached.
"""

from __future__ import annotations

import hashlib
import os
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import llvmlite
import numba
import numpy as np
from filelock import FileLock
from numba.core import config
from numpy.typing import NDArray
from platformdirs import user_cache_path

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

announce: Callable[[str], None] = lambda text: print(text, file=sys.stderr, flush=True)  # noqa: E731
"""Called with one line before the first compilation of a process, which takes seconds."""

_compiling = threading.Lock()
_announced = threading.Event()


def kernel(function: F) -> F:
    """Compile a function that only other compiled functions call."""
    return numba.njit(**OPTIONS)(function)  # type: ignore[no-any-return]


def cache_directory() -> Path:
    """Folder of the compiled code of exactly these sources, compilers and processor.

    numba looks at the file of an entry only, not at the kernels that it calls, and would run
    stale code after an edit elsewhere; a folder named after everything cannot be stale.
    """
    here = Path(__file__).parent
    digest = hashlib.sha256(str(here).encode())  # numba's index names the folder, too
    for path in sorted(here.rglob("*.py")):
        digest.update(path.read_bytes())
    host = numba.core.registry.cpu_target.target_context.codegen().magic_tuple()
    for part in (numba.__version__, llvmlite.__version__, sys.version, host, OPTIONS):
        digest.update(repr(part).encode())
    root = os.environ.get("VIBROIMPACT_CACHE_DIR")
    base = Path(root) if root else user_cache_path("vibroimpact", appauthor=False)
    return base / f"engine-{digest.hexdigest()[:16]}"


class Entry:
    """A compiled function that Python calls, compiled for one signature at its first call."""

    def __init__(self, function: Callable[..., Any], signature: str) -> None:
        self.function = function
        self.signature = signature
        self.__doc__ = function.__doc__
        self.__name__ = function.__name__
        self._compiled: Callable[..., Any] | None = None

    def __call__(self, *args: Any) -> Any:
        """Run, compiling or loading first if this is the first call of the process."""
        if self._compiled is None:
            self.prepare()
            assert self._compiled is not None
        return self._compiled(*args)

    def prepare(self) -> None:
        """Compile, or load from the cache, one process and one thread at a time.

        Two processes that write numba's cache at once can leave a pair of files that do not
        belong together, which crashes whoever loads them; hence the lock between processes.
        """
        with _compiling:
            if self._compiled is not None:
                return
            if config.DISABLE_JIT:  # type: ignore[attr-defined]
                self._compiled = self.function
                return
            directory = cache_directory()
            try:
                directory.mkdir(parents=True, exist_ok=True)
                lock = FileLock(directory / "lock")
                lock.acquire()
            except OSError:  # nowhere to write
                self._compile_for_this_process()
                return
            try:
                self._compiled = self._from_cache(directory)
            except Exception:  # a damaged file, a full disk: numba raises whatever it meets
                for path in directory.rglob("*.nb[ic]"):
                    path.unlink(missing_ok=True)
                self._compile_for_this_process()
            finally:
                lock.release()

    def _from_cache(self, directory: Path) -> Callable[..., Any]:
        if not any(directory.glob(f"**/*.{self.__name__}-*.nbi")):
            _say()
        before = config.CACHE_DIR  # type: ignore[attr-defined]
        # Read when the decorator runs.
        config.CACHE_DIR = str(directory)  # type: ignore[attr-defined]
        try:
            dispatcher = numba.njit(cache=True, **OPTIONS)(self.function)
        finally:
            config.CACHE_DIR = before  # type: ignore[attr-defined]
        dispatcher.compile(self.signature)
        return dispatcher  # type: ignore[no-any-return]

    def _compile_for_this_process(self) -> None:
        _say()
        dispatcher = numba.njit(**OPTIONS)(self.function)
        dispatcher.compile(self.signature)
        self._compiled = dispatcher


def _say() -> None:
    """Announce once; further parts of the engine compile without a word."""
    if not _announced.is_set():
        _announced.set()
        announce(
            "vibroimpact: compiling the engine, once per installation; each part takes about "
            "10 s when it is first used ..."
        )


def entry(signature: str) -> Callable[[Callable[..., Any]], Entry]:
    """Mark a function that Python calls with arguments of one numba signature."""
    return lambda function: Entry(function, signature)
