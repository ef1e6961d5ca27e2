"""Folders of compiled code: one for each version of the engine and installation."""

from __future__ import annotations

import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal, NamedTuple

from filelock import FileLock, Timeout


class CompiledCode(NamedTuple):
    """The code that one version of the engine has compiled in one installation."""

    folder: Path
    own: bool
    """Whether it is that of the running version."""
    size: int
    """Bytes."""
    flows: tuple[str, ...]
    age: float
    """Time since code was last compiled into the folder (s)."""


def list_compiled_code(own: Path) -> list[CompiledCode]:
    """Return the code of all versions, the most recent first; `own` is this version's folder."""
    return sorted(
        (_compiled(one, own) for one in own.parent.glob("engine-*")), key=lambda code: code.age
    )


def _compiled(folder: Path, own: Path) -> CompiledCode:
    size, last = 0, 0.0
    flows = set()
    for path in folder.rglob("*.nb[ic]"):  # numba's index and machine code
        try:
            status = path.stat()
        except OSError:  # removed meanwhile
            continue
        flows.add(path.relative_to(folder).parts[0])
        size, last = size + status.st_size, max(last, status.st_mtime)
    age = max(0.0, time.time() - (last or folder.stat().st_mtime))
    return CompiledCode(folder, folder == own, size, tuple(sorted(flows)), age)


def remove(one: CompiledCode, which: Literal["others", "all"]) -> bool:
    """Remove code of other versions, or all; return whether no part of it was in use."""
    if one.own and which == "others":
        return True
    free = True
    for flow in [path for path in one.folder.iterdir() if path.is_dir()]:
        with _locked(flow) as got:
            free = free and got
            # The lock stays as long as somebody may wait for it.
            for path in [p for p in flow.iterdir() if got and p.is_dir()]:
                shutil.rmtree(path, ignore_errors=True)
    if free and not one.own:
        shutil.rmtree(one.folder, ignore_errors=True)
    return free


@contextmanager
def _locked(flow: Path) -> Iterator[bool]:
    """Take the lock of who compiles or loads (`engine.entry`); yield whether it was free."""
    try:
        with FileLock(flow / "lock", timeout=0):
            yield True
    except Timeout:
        yield False
