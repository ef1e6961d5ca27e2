"""The engine as machine code that `make kernels` made: nothing is compiled, numba is not needed.

One shared library holds all entries and the functions of all flows, with numba's own calling
convention: room for the result, room for an exception, then the arguments, of which an array is
seven words or more. It is used only with exactly the sources that it was made of.
"""

from __future__ import annotations

import ctypes
import functools
import hashlib
import os
import platform
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from vibroimpact.engine import cache

FOLDER = Path(__file__).with_name("libraries")
"""Of the libraries, one for each system and level of processors, and the digest of the sources."""

DIGEST = "digest"

SOURCE = Path(__file__)
"""Whoever owns it can run code as the user anyway."""

_LOADING = ("cache.py", "compilation.py", "compiled_code.py", "compiler.py", "native.py")
"""Sources that find compiled code, and have no influence on it."""

LEVELS: dict[str, dict[str, tuple[str, ...]]] = {
    "x86_64": {"v4": ("AVX512_SKX",), "v3": ("AVX2", "FMA3"), "v2": ("SSE42",)},
    "aarch64": {"v8": ()},
}
"""Of each kind of processor the levels that code is made for, with the features that each needs,
the most capable first."""

_SUFFIX = {"linux": "so", "darwin": "dylib", "win32": "dll"}
_MACHINES = {"amd64": "x86_64", "arm64": "aarch64"}
_NUMBERS = {"f8": ctypes.c_double, "i8": ctypes.c_int64, "boolean": ctypes.c_bool}
_ARGUMENT = re.compile(r"(?:UniTuple\((?:f8|i8), (\d)\))|(f8|i8|boolean|void)(\[[:, 1]*\])?")


def name_of(system: str, machine: str, level: str) -> str:
    """File of the library for a system (as `sys.platform`), a machine and a level."""
    return f"{system}-{machine}-{level}.{_SUFFIX.get(system, 'so')}"


def machine() -> str:
    """The kind of this machine's processor, a key of `LEVELS` if it is known."""
    name = platform.machine().lower()
    return _MACHINES.get(name, name)


def digest() -> str:
    """Digest of the sources of the engine's code."""
    here = Path(__file__).parent
    made = hashlib.sha256()
    for path in sorted(path for path in here.rglob("*.py") if path.name not in _LOADING):
        made.update(path.relative_to(here).as_posix().encode())
        made.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return made.hexdigest()


def levels() -> list[str]:
    """The levels that this processor can run, the most capable first."""
    from numpy._core import _multiarray_umath  # type: ignore[attr-defined]

    features: dict[str, bool] = _multiarray_umath.__cpu_features__
    known: dict[str, tuple[str, ...]] = LEVELS.get(machine(), {})
    return [level for level, needed in known.items() if all(features.get(one) for one in needed)]


class LibraryChoice(NamedTuple):
    """Whether a library is used."""

    path: Path | None
    why: str = ""
    """Reason why none is used."""
    unexpected: bool = False
    """Whether there is one that would fit this machine."""


def shipped() -> Path | None:
    """The library for this machine, if there is one, of whichever sources."""
    names = [name_of(sys.platform, machine(), level) for level in levels()]
    return next((FOLDER / name for name in names if (FOLDER / name).exists()), None)


@functools.cache
def choose() -> LibraryChoice:
    """Choose the library for this machine and these sources, if there is one."""
    if os.environ.get("VIBROIMPACT_ENGINE") == "numba":
        return LibraryChoice(None, "VIBROIMPACT_ENGINE is numba")
    if os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0"):
        return LibraryChoice(None, "NUMBA_DISABLE_JIT is set")
    path = shipped()
    if path is None:
        return LibraryChoice(None, f"there is no machine code for {sys.platform}, {machine()}")
    if (FOLDER / DIGEST).read_text().strip() != digest():
        return LibraryChoice(None, f"{path.name} was made of other sources (make kernels)", True)
    # Whoever can write to it can run code as the user.
    owners = (SOURCE.stat().st_uid,)
    if writable := cache.writable_by_others((FOLDER, path), owners):
        why = f"other users may write to {str(writable)!r} (chmod go-w)"
        if cache.is_foreign(writable, owners):
            why = f"{str(writable)!r} belongs to another user (chown it, or install it yourself)"
        return LibraryChoice(None, why, True)
    return LibraryChoice(path)


def find_library() -> Path | None:
    """The library that is used; None if numba compiles."""
    return choose().path


def described() -> str:
    """How the engine runs, in words."""
    library, why, _ = choose()
    return library.name if library else f"compiled by numba at first use; {why}"


@functools.cache
def _loaded() -> ctypes.CDLL:
    return ctypes.CDLL(str(find_library()))


def has(symbol: str) -> bool:
    """Whether there is a library that has this function."""
    return find_library() is not None and hasattr(_loaded(), symbol)


def function(symbol: str, signature: str, first: str) -> Callable[..., Any]:
    """Return a function of the library as one of Python.

    Parameters
    ----------
    symbol
        Its name in the library.
    signature
        As numba reads it: what is returned, then the arguments but the first.
    first
        The first argument, or of a tuple its only field.
    """
    matches = _ARGUMENT.finditer(signature)
    result = next(matches)
    kinds = [first, *(one.group() for one in matches)]
    flat: list[Any] = [ctypes.c_void_p, ctypes.c_void_p]
    for kind in kinds:
        flat += [_NUMBERS[kind]] if kind in _NUMBERS else _array_words(kind)
    call = getattr(_loaded(), symbol)
    call.argtypes, call.restype = flat, ctypes.c_int32
    count = int(result.group(1) or 0)
    buffer = ctypes.c_int64 * (count or 1)
    if result.group(2) == "f8":
        buffer = ctypes.c_double * 1  # type: ignore[assignment]
    checks = [_array if kind not in _NUMBERS else _number for kind in kinds]
    types = [np.dtype(kind.partition("[")[0]) if kind not in _NUMBERS else None for kind in kinds]

    def called(*arguments: Any) -> Any:
        returned, raised = buffer(), ctypes.c_void_p()
        one = arguments[0]
        values = (*one, *arguments[1:]) if isinstance(one, tuple) else arguments
        words: list[Any] = []
        for argument, check, kind in zip(values, checks, types, strict=True):
            check(words, argument, kind)
        status = call(ctypes.byref(returned), ctypes.byref(raised), *words)
        if status not in (0, -2):  # -2: it returns nothing
            raise RuntimeError(f"{symbol} ended with status {status}")
        return tuple(returned) if count else returned[0]

    return called


def _array_words(kind: str) -> list[Any]:
    rank = kind.count(",") + 1
    head = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p]
    return head + [ctypes.c_int64] * 2 * rank


def _array(words: list[Any], array: Any, kind: Any) -> None:
    if array.dtype != kind or not array.flags.c_contiguous:
        raise TypeError(f"array of {array.dtype}, strides {array.strides}; {kind} in C order")
    words += (None, None, array.size, array.itemsize, array.ctypes.data)
    words += array.shape
    words += array.strides


def _number(words: list[Any], number: Any, kind: Any) -> None:
    words.append(number)
