"""The files of compiled code: where they are, who may have written them, and whether they changed.

numba keeps code as pickles, so whoever can write to them can run code, and it loads a damaged file
without noticing. A folder that others may write to is therefore not used, and each file has its
digest next to it.
"""

from __future__ import annotations

import hashlib
import os
import stat
import sys
from collections.abc import Container, Iterable, Iterator
from pathlib import Path

from platformdirs import user_cache_path

_DIGEST = ".sha256"


def own_folder() -> Path:
    """Folder of the compiled code of exactly these sources, compilers and processor.

    numba checks the file of an entry only, not at the kernels that it calls, and would run
    stale code after an edit elsewhere; a folder named after everything cannot be stale. Without
    numba nothing is compiled, so the folder does not exist.
    """
    root = os.environ.get("VIBROIMPACT_CACHE_DIR")
    base = Path(root) if root else user_cache_path("vibroimpact", appauthor=False)
    try:
        import llvmlite
        import numba
    except ImportError:
        return base / "engine-none"
    here = Path(__file__).parent
    digest = hashlib.sha256(str(here).encode())  # numba's index names the folder, too
    for path in sorted(here.rglob("*.py")):
        digest.update(path.read_bytes())
    host = numba.core.registry.cpu_target.target_context.codegen().magic_tuple()
    for part in (numba.__version__, llvmlite.__version__, sys.version, host):
        digest.update(repr(part).encode())
    return base / f"engine-{digest.hexdigest()[:16]}"


def make_folder(folder: Path, base: Path) -> None:
    """Create a folder, and those above it up to `base`, that only the user may write to."""
    missing = [one for one in (folder, *folder.parents) if not one.exists()]
    for one in reversed(missing):
        one.mkdir(exist_ok=True, mode=0o755 if one.is_relative_to(base) else 0o777)


def writable_by_others(paths: Iterable[Path], owners: Container[int] = ()) -> Path | None:
    """The first of some files and folders that a user who is not trusted may write to.

    Trusted are the user, root and further `owners`. None where the operating system has no such
    owners and modes.
    """
    if not hasattr(os, "getuid"):
        return None
    for path in paths:
        held = path.stat()
        by_group = held.st_mode & stat.S_IWGRP and not _is_private(held.st_gid, held.st_uid)
        if is_foreign(path, owners) or by_group or held.st_mode & stat.S_IWOTH:
            return path
    return None


def is_foreign(path: Path, owners: Container[int] = ()) -> bool:
    """Whether neither the user nor root nor one of `owners` owns a file."""
    owner = path.stat().st_uid
    return owner not in (0, os.getuid()) and owner not in owners


def _is_private(group: int, owner: int) -> bool:
    """Whether a group has its owner's name and no other member, as umask 002 presupposes."""
    import grp
    import pwd

    try:
        name, members = pwd.getpwuid(owner).pw_name, grp.getgrgid(group)
    except KeyError:
        return False
    others = {one.pw_name for one in pwd.getpwall() if one.pw_gid == group}.union(members.gr_mem)
    return members.gr_name == name and others <= {name}


def seal(directory: Path, name: str) -> None:
    """Write the digests of an entry's files; keep them and their folders from others."""
    for path in _code(directory, name):
        _write_protected(path.with_name(path.name + _DIGEST), _digest(path))
        for one in (path, path.parent):
            if one.stat().st_mode & (stat.S_IWGRP | stat.S_IWOTH):
                one.chmod(stat.S_IMODE(one.stat().st_mode) & ~(stat.S_IWGRP | stat.S_IWOTH))


def remove_damaged(directory: Path, name: str) -> Path | None:
    """Remove an entry's files if one has changed, or if another user may write to it.

    Returns
    -------
    Path or None
        The file or folder that another user may write to.
    """
    files = list(_code(directory, name))
    unsafe = next((at for path in files if (at := _unsafe(path))), None)
    if unsafe or not all(_is_sealed(path) for path in files):
        remove(files)
    return unsafe


def remove(files: Iterable[Path]) -> None:
    """Remove compiled code with its digests."""
    for path in files:
        path.unlink(missing_ok=True)
        path.with_name(path.name + _DIGEST).unlink(missing_ok=True)


def _code(directory: Path, name: str) -> Iterator[Path]:
    """The files of an entry: numba's index, and the machine code."""
    yield from directory.glob(f"**/*.{name}-*.nb[ic]")


def _unsafe(path: Path) -> Path | None:
    """The file, its digest or their folder, if another user may write to it."""
    sealed = path.with_name(path.name + _DIGEST)
    return writable_by_others(one for one in (path.parent, path, sealed) if one.exists())


def _is_sealed(path: Path) -> bool:
    try:
        return path.with_name(path.name + _DIGEST).read_text() == _digest(path)
    except OSError:
        return False


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _write_protected(path: Path, text: str) -> None:
    path.unlink(missing_ok=True)
    handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o644)
    with os.fdopen(handle, "w") as file:
        file.write(text)
