"""``vibroimpact cache``: where compiled code is kept, how much of it, and its removal."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple

from cyclopts import Group, Parameter

from vibroimpact.cli.options import OUTPUT

if TYPE_CHECKING:
    from rich.console import RenderableType

_CACHE = Group("Cache", sort_key=1)
_MOST = 12
"""Folders that are listed, the youngest."""


class Kept(NamedTuple):
    """What one version of the engine has compiled in one installation."""

    folder: Path
    own: bool
    """Whether it is the one that runs here."""
    size: int
    """Bytes."""
    flows: tuple[str, ...]
    age: float
    """Since something was last compiled into it (s)."""


def cache(
    *,
    clean: Annotated[
        Literal["others", "all"] | None,
        Parameter(
            group=_CACHE,
            help=(
                "Remove what other versions and installations have compiled, or all. What is gone "
                "is compiled again when it is needed."
            ),
        ),
    ] = None,
    json: Annotated[
        bool,
        Parameter(
            group=OUTPUT,
            negative="",
            show_default=False,
            help="Print it as JSON, for other programs, and nothing else.",
        ),
    ] = False,
) -> int:
    """Say where the engine's compiled code is kept, how much it is and how old; remove it.

    The engine is compiled when it is first used, and kept in the user's cache folder or in that
    which VIBROIMPACT_CACHE_DIR names, a folder a version. It may be cleaned at any time: a part
    that another process is compiling or loading is left.

    For example:

        vibroimpact cache
        vibroimpact cache --clean others
        vibroimpact cache --clean all
    """
    from json import dumps

    from vibroimpact.engine.jit import cache_directory
    from vibroimpact.facts.tables import as_text

    own = cache_directory()
    before = found(own)
    left = [one.folder.name for one in before if clean and not _cleaned(one, clean)]
    after = found(own) if clean else before
    facts = {
        "folder": str(own.parent),
        "kept": [one._asdict() | {"folder": one.folder.name} for one in after],
        "size": sum(one.size for one in after),
        "removed": sum(one.size for one in before) - sum(one.size for one in after),
        "in_use": left,
    }
    if json:
        print(dumps(facts, indent=2))
    else:
        print(as_text(_text(facts, bool(clean))), end="")
    return 0


def found(own: Path) -> list[Kept]:
    """What is kept beside the folder of this version, the youngest first."""
    return sorted((_kept(one, own) for one in own.parent.glob("engine-*")), key=lambda k: k.age)


def _kept(folder: Path, own: Path) -> Kept:
    import time

    size, last = 0, 0.0
    flows = set()
    for path in folder.rglob("*.nb[ic]"):  # numba's index and machine code
        try:
            told = path.stat()
        except OSError:  # removed meanwhile
            continue
        flows.add(path.relative_to(folder).parts[0])
        size, last = size + told.st_size, max(last, told.st_mtime)
    age = max(0.0, time.time() - (last or folder.stat().st_mtime))
    return Kept(folder, folder == own, size, tuple(sorted(flows)), age)


def _cleaned(one: Kept, which: Literal["others", "all"]) -> bool:
    """Remove a folder if it is asked for; whether no part of it was in use."""
    import shutil

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
    """The lock that whoever compiles or loads holds (`engine.entry`); whether it is free."""
    from filelock import FileLock, Timeout

    try:
        with FileLock(flow / "lock", timeout=0):
            yield True
    except Timeout:
        yield False


def _text(facts: dict[str, Any], cleaned: bool) -> RenderableType:
    from rich.console import Group as Together
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, padding=(0, 2), header_style="dim")
    table.add_column("compiled code")
    for heading in ("size", "parts", "compiled"):
        table.add_column(heading, justify="right")
    table.add_column("")
    for one in facts["kept"][:_MOST]:
        table.add_row(
            one["folder"],
            _bytes(one["size"]),
            str(len(one["flows"])),
            _ago(one["age"]),
            "of this version" if one["own"] else "",
        )
    count = len(facts["kept"])
    lines = [f"{facts['folder']}: {count} folders, {_bytes(facts['size'])}"]
    if count > _MOST:
        lines.insert(0, f"and {count - _MOST} older ones")
    if cleaned:
        lines.append(f"removed: {_bytes(facts['removed'])}")
    lines += [f"left, for another process uses it: {name}" for name in facts["in_use"]]
    return Together(table, Text(), Text("\n".join(lines)))


def _bytes(size: int) -> str:
    return f"{size / 1e6:.1f} MB"


def _ago(age: float) -> str:
    for length, name in ((86400.0, "day"), (3600.0, "hour"), (60.0, "minute")):
        if age >= length:
            count = int(age / length)
            return f"{count} {name}{'s' if count > 1 else ''} ago"
    return "just now"
