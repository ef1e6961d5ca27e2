"""The functions that Python calls, compiled for the flow of the rig that is asked about."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
from filelock import FileLock
from numba.core import config
from numba.core.sigutils import normalize_signature

from vibroimpact.engine import cache, emission, jit
from vibroimpact.engine.flow_dispatch import flow_of
from vibroimpact.engine.parameters import free_rig


class Entry:
    """A compiled function whose first argument is a rig's vector.

    It is compiled for one signature and one flow, at its first call; the function itself gets the
    room for a plan as its first argument, whose type is that of the flow.
    """

    def __init__(self, function: Callable[..., Any], signature: str) -> None:
        self.function = function
        self.signature = signature
        self.__doc__ = function.__doc__
        self.__name__ = function.__name__
        self._compiled: dict[type, Callable[..., Any]] = {}

    def __call__(self, rig: Any, *args: Any) -> Any:
        """Run, compiling or loading first if this is the first call of the process."""
        given = flow_of(rig)
        compiled = self._compiled.get(type(given))
        if compiled is None:
            self._prepare(given)
            compiled = self._compiled[type(given)]
        return compiled(given, rig, *args)

    def prepare(self, *rigs: Any) -> None:
        """Compile for the flows of these rigs, or load from the cache; for bumpers if none."""
        for given in {type(g): g for g in map(flow_of, rigs or (free_rig(),))}.values():
            self._prepare(given)

    def _prepare(self, given: Any) -> None:
        """Compile or load, one process at a time.

        Two processes that write numba's cache at once can leave a pair of files that do not
        belong together, which crashes whoever loads them; hence the lock between processes.
        """
        flow = type(given)
        with jit.compiling:
            if flow in self._compiled:
                return
            if config.DISABLE_JIT:  # type: ignore[attr-defined]
                self._compiled[flow] = self.function
                return
            arguments, result = normalize_signature(self.signature)  # type: ignore[no-untyped-call]
            signature = result(numba.typeof(given), *arguments)  # type: ignore[no-untyped-call]
            version = jit.cache_directory()
            directory = version / flow.__name__
            try:
                cache.make_folder(directory, version.parent)
                others = cache.writable_by_others((version.parent, version, directory))
                lock = FileLock(directory / "lock", mode=0o644)
                if others is None:
                    lock.acquire()
            except OSError:  # nowhere to write
                self._compiled[flow] = self._for_this_process(signature)
                return
            if others is not None:
                jit.say_unsafe(others)
                self._compiled[flow] = self._for_this_process(signature)
                return
            try:
                self._compiled[flow] = self._from_cache(directory, signature)
            except Exception:  # a damaged file, a full disk: numba raises whatever it meets
                cache.remove(directory.rglob("*.nb[ic]"))
                self._compiled[flow] = self._for_this_process(signature)
            finally:
                lock.release()

    def _from_cache(self, directory: Path, signature: Any) -> Callable[..., Any]:
        if unsafe := cache.remove_damaged(directory, self.__name__):
            jit.say_refused(unsafe)
        if not any(directory.glob(f"**/*.{self.__name__}-*.nbi")):
            jit.say()
        before = config.CACHE_DIR  # type: ignore[attr-defined]
        # Read when the decorator runs.
        config.CACHE_DIR = str(directory)  # type: ignore[attr-defined]
        try:
            dispatcher = numba.njit(cache=True, **jit.OPTIONS)(self.function)
        finally:
            config.CACHE_DIR = before  # type: ignore[attr-defined]
        compiled = self._compiled_for(signature, dispatcher)
        if dispatcher.stats.cache_misses:
            cache.seal(directory, self.__name__)
        return compiled

    def _for_this_process(self, signature: Any) -> Callable[..., Any]:
        jit.say()
        return self._compiled_for(signature, numba.njit(**jit.OPTIONS)(self.function))

    def _compiled_for(self, signature: Any, dispatcher: Any) -> Callable[..., Any]:
        """Compile for this signature and refuse others, which would take half a minute unseen."""
        with emission.only(self.function.__qualname__):
            dispatcher.compile(signature)
        dispatcher.disable_compile()
        return dispatcher  # type: ignore[no-any-return]


def entry(signature: str) -> Callable[[Callable[..., Any]], Entry]:
    """Mark a function that Python calls; the signature is that of the rig and what follows it."""
    return lambda function: Entry(function, signature)
