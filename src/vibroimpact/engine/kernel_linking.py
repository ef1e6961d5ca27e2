"""Kernels are linked into the entries that call them; only entries are optimised and emitted.

numba optimises every function that it compiles, with all that it calls, and makes machine code of
it, also of one that nothing calls: half of the time in which the engine compiles. The entry, into
which all are merged, is optimised as a whole anyway. numba has no option to leave it out, so its
code generator is set while an entry is compiled, in the versions whose inside is known to be of
this shape; any other compiles the same code in a longer time.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numba
from numba.core.codegen import CPUCodeLibrary, JITCodeLibrary, JITCPUCodegen
from numba.core.itanium_mangler import mangle_identifier

from vibroimpact.engine import jit

KNOWN = "0.68."
"""Versions of numba whose code generator these methods are those of."""
_METHODS: tuple[tuple[Any, str], ...] = (
    (JITCPUCodegen, "_add_module"),
    (CPUCodeLibrary, "_optimize_final_module"),
    (JITCodeLibrary, "_finalize_specific"),
    (JITCodeLibrary, "get_pointer_to_function"),
    (JITCPUCodegen, "set_env"),
)


def forbid_inlining(module: Any) -> None:
    """Forbid to merge the kernels that are marked so (`jit.not_inlined`) into their callers."""
    marks = tuple(
        f"_Z{mangle_identifier(name)[:-1]}B"  # type: ignore[no-untyped-call]
        for name in jit.NOT_INLINED
    )
    for function in module.functions:
        if not function.is_declaration and function.name.startswith(marks):
            function.add_function_attribute("noinline")


@contextmanager
def only(name: str) -> Iterator[None]:
    """While this lasts, this thread optimises and emits only the function of this name.

    Kernels that Python may call, those of tests, are left as they are.
    """
    if not (numba.__version__.startswith(KNOWN) and jit.WITHIN["no_cpython_wrapper"]):
        yield
        return
    here = threading.get_ident()
    own = {key: getattr(*key) for key in _METHODS}
    add, optimise, finish, pointer, place = own.values()

    def linked(library: str) -> bool:
        return library != name and threading.get_ident() == here

    def add_module(self: Any, module: Any) -> Any:
        return None if linked(module.name) else add(self, module)

    def optimise_module(self: Any) -> None:
        if not linked(self.name):
            forbid_inlining(self._final_module)
            optimise(self)
            optimise(self)  # again, what has been merged: once leaves curved laws a fifth slower

    def finalize(self: Any) -> None:
        if not linked(self.name):
            finish(self)

    def get_pointer(self: Any, symbol: str) -> Any:
        self._ensure_finalized()
        return 0 if linked(self.name) else pointer(self, symbol)

    def set_env(self: Any, symbol: str, env: Any) -> None:
        if self._engine.is_symbol_defined(symbol):
            place(self, symbol, env)

    try:
        replacements = (add_module, optimise_module, finalize, get_pointer, set_env)
        for key, method in zip(own, replacements, strict=True):
            setattr(*key, method)
        yield
    finally:
        for key, method in own.items():
            setattr(*key, method)
