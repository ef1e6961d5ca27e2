"""The functions that Python calls: compiled for the types that they are called with, and cached."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

from filelock import FileLock

from vibroimpact import stderr
from vibroimpact.engine import cache, jit, native
from vibroimpact.engine.compiler import COMPILES, PLAIN
from vibroimpact.errors import InputError


@contextmanager
def _uncollected() -> Iterator[None]:
    """Without the collector of garbage, which takes a seventh of the compiler's time."""
    running = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if running:
            gc.enable()


class Compiled:
    """A function that is compiled for one signature and for each type of its first argument."""

    FIRST = "f8[::1]"
    """The first argument, as the others in the signature; of a tuple, its only field."""

    def __init__(self, function: Callable[..., Any], signature: str) -> None:
        self.function = function
        self.signature = signature
        self.__doc__ = function.__doc__
        self.__name__ = function.__name__
        self._compiled: dict[type, Callable[..., Any]] = {}

    def of(self, first: Any) -> Callable[..., Any]:
        """Compile or load for the type of a first argument, if need be."""
        compiled = self._compiled.get(type(first))
        if compiled is None:
            self._prepare(first)
            compiled = self._compiled[type(first)]
        return compiled

    def symbol(self, flow: type) -> str:
        """Name of the function for a type of its first argument in a library of machine code."""
        module = self.function.__module__.partition("engine.")[2].replace(".", "_")
        return f"{flow.__name__}_{module}_{self.__name__}"

    def _prepare(self, first: Any) -> None:
        """Load from the library of machine code, else compile or load from the cache.

        One process at a time:

        two processes that write numba's cache at once can leave a pair of files that do not
        belong together, which crashes whoever loads them; hence the lock between processes.
        """
        flow = type(first)
        with jit.compiling:
            if flow in self._compiled:
                return
            if PLAIN:
                self._compiled[flow] = self.function
                return
            if native.has(self.symbol(flow)):
                self._compiled[flow] = native.function(
                    self.symbol(flow), self.signature, self.FIRST
                )
                return
            if not COMPILES:
                raise InputError(
                    f"{self.__name__}: the engine's machine code does not contain it, so numba "
                    "has to compile it and the kernels that it calls; set the environment variable "
                    "VIBROIMPACT_KERNELS=1 before vibroimpact is imported"
                )
            import numba
            from numba.core.sigutils import normalize_signature

            arguments, result = normalize_signature(self.signature)  # type: ignore[no-untyped-call]
            signature = result(numba.typeof(first), *arguments)  # type: ignore[no-untyped-call]
            version = cache.own_folder()
            directory = version / flow.__name__
            try:
                cache.make_folder(directory, version.parent)
                others = cache.writable_by_others((version.parent, version, directory))
                lock = FileLock(directory / "lock", mode=0o644)
                if others is None:
                    lock.acquire()
            except OSError:  # nowhere to write
                self._compiled[flow] = self._for_this_process(flow.__name__, signature)
                return
            if others is not None:
                jit.say_unsafe(others)
                self._compiled[flow] = self._for_this_process(flow.__name__, signature)
                return
            try:
                self._compiled[flow] = self._from_cache(directory, signature)
            except Exception:  # a damaged file, a full disk: numba raises whatever it meets
                cache.remove(directory.rglob("*.nb[ic]"))
                self._compiled[flow] = self._for_this_process(flow.__name__, signature)
            finally:
                lock.release()

    def _from_cache(self, directory: Path, signature: Any) -> Callable[..., Any]:
        if unsafe := cache.remove_damaged(directory, self.__name__):
            jit.say_refused(unsafe)
        import numba
        from numba.core import config

        before = config.CACHE_DIR  # type: ignore[attr-defined]
        # Read when the decorator runs.
        config.CACHE_DIR = str(directory)  # type: ignore[attr-defined]
        try:
            dispatcher = numba.njit(cache=True, **jit.OPTIONS)(self.function)
        finally:
            config.CACHE_DIR = before  # type: ignore[attr-defined]
        there = any(directory.glob(f"**/*.{self.__name__}-*.nbi"))
        with nullcontext() if there else self._announced(directory.name):
            compiled = self._compiled_for(signature, dispatcher)
        if dispatcher.stats.cache_misses:
            cache.seal(directory, self.__name__)
        return compiled

    def _for_this_process(self, flow: str, signature: Any) -> Callable[..., Any]:
        import numba

        with self._announced(flow):
            return self._compiled_for(signature, numba.njit(**jit.OPTIONS)(self.function))

    @contextmanager
    def _announced(self, flow: str) -> Iterator[None]:
        """Announce the first part that is compiled; show each while it is."""
        choice = native.choose()
        jit.say(choice.why if choice.unexpected else "")
        with stderr.busy(f"compiling {self.__name__.lstrip('_')} for {flow}"):
            yield

    def _compiled_for(self, signature: Any, dispatcher: Any) -> Callable[..., Any]:
        """Compile for this signature and refuse others, which would take half a minute unseen."""
        from vibroimpact.engine import kernel_linking

        with kernel_linking.only(self.function.__qualname__), _uncollected():
            dispatcher.compile(signature)
        dispatcher.disable_compile()
        return dispatcher  # type: ignore[no-any-return]
