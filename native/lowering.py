"""The engine's functions as numba lowers them, before anything is optimised for a processor."""

from __future__ import annotations

import gc
import hashlib
import importlib
import pkgutil
import shutil
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from operator import attrgetter
from pathlib import Path
from typing import Any

import llvmlite
import llvmlite.binding as llvm
import numba
import numpy as np
from numba.core.sigutils import normalize_signature

from vibroimpact import engine
from vibroimpact.engine import flow_dispatch, flow_tables, jit, kernel_linking, native
from vibroimpact.engine.compilation import Compiled
from vibroimpact.engine.entry import Entry
from vibroimpact.engine.rigless_entry import NoRig, RiglessEntry

KEPT = Path(__file__).parents[1] / "out" / "lowered"
"""Lowered code of these sources: each further target needs only LLVM."""


_module_of = attrgetter("library._final_module")
"""Of a compiled kernel: the code that numba has lowered."""


def functions() -> Iterator[tuple[Compiled, Any]]:
    """Each function of the engine that is compiled, with a first argument of each of its types."""
    names = [info.name for info in pkgutil.walk_packages(engine.__path__, f"{engine.__name__}.")]
    for name in names:
        for value in vars(importlib.import_module(name)).values():
            if isinstance(value, Entry | RiglessEntry) and value.function.__module__ == name:
                yield value, np.empty(8) if isinstance(value, Entry) else NoRig()
    for flow in flow_dispatch.FLOWS:
        for group in flow_tables.GROUPS.values():
            yield group, flow(np.empty(8))


def lower_all(pool: Executor, wanted: Callable[[str], bool]) -> Iterator[tuple[str, bytes]]:
    """Names and code of the functions that are wanted; what has been lowered is read."""
    folder = KEPT / _digest()
    if not folder.exists():
        shutil.rmtree(KEPT, ignore_errors=True)
        folder.mkdir(parents=True)
    names = [compiled.symbol(type(first)) for compiled, first in functions()]
    missing = [
        k for k, name in enumerate(names) if wanted(name) and not (folder / f"{name}.bc").exists()
    ]
    for symbol, code in pool.map(lowered, missing):
        print(f"{symbol}: {len(code) // 1024} kB", flush=True)
        part = folder / f"{symbol}.part"
        part.write_bytes(code)
        part.rename(folder / f"{symbol}.bc")
    for name in filter(wanted, names):
        yield name, (folder / f"{name}.bc").read_bytes()


def _digest() -> str:
    made = hashlib.sha256(Path(__file__).read_bytes())
    for part in (native.digest(), numba.__version__, llvmlite.__version__):
        made.update(part.encode())
    return made.hexdigest()[:16]


def lowered(index: int) -> tuple[str, bytes]:
    """Name and code of a function as numba lowers it, with all that it calls."""
    compiled, first = list(functions())[index]
    arguments, result = normalize_signature(compiled.signature)
    dispatcher = numba.njit(**jit.OPTIONS)(compiled.function)
    gc.disable()
    # Of no name: nothing is optimised, which would be for this processor, and nothing is emitted.
    with kernel_linking.only(""):
        dispatcher.compile(result(numba.typeof(first), *arguments))
    gc.enable()
    (made,) = dispatcher.overloads.values()
    module = llvm.parse_assembly(_without_places(str(_module_of(made))))
    kernel_linking.forbid_inlining(module)
    name = made.fndesc.llvm_func_name
    for one in (*module.functions, *module.global_variables):
        if not one.is_declaration and one.name != name:
            one.linkage = "internal"
    symbol = compiled.symbol(type(first))
    module.get_function(name).name = symbol
    return symbol, module.as_bitcode()


def _without_places(code: str) -> str:
    """Blank the folders of this machine, which stand in exceptions that no kernel raises.

    Here, because a system that verifies signatures refuses a library that was altered.
    """
    for package in (numba, engine):
        place = str(Path(str(package.__file__)).parents[1])
        code = code.replace(place, "." * len(place))
    return code
