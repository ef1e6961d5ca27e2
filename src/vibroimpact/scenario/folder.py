"""A Zarr group in a folder that is there with all its arrays, or not at all, and has one writer."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from filelock import FileLock, Timeout
from numpy.typing import NDArray

from vibroimpact._version import __version__
from vibroimpact.errors import InputError
from vibroimpact.response.vocabulary import VARIABLES

if TYPE_CHECKING:  # it takes long to load: only where a store is made or read
    import zarr


class Kind(NamedTuple):
    """What is in a store."""

    word: str
    """Such as "map"."""
    created_by: str
    arrays: frozenset[str]
    """Their names."""


def finished(group: zarr.Group) -> bool:
    """Whether all of it is there."""
    return bool(group.attrs.get("finished", False))


def read(group: zarr.Group, word: str, name: str, where: Any = ...) -> NDArray[Any]:
    """Part of an array.

    Raises
    ------
    InputError
        If the store is damaged.
    """
    try:
        return np.array(group[name][where])
    except (RuntimeError, ValueError) as error:
        raise InputError(
            f"store: {group.store} is damaged ({name}: {error}); a {word} that was written "
            "by this package is accepted"
        ) from None


def create(
    group: zarr.Group,
    name: str,
    shape: tuple[int, ...],
    chunks: tuple[int, ...],
    dtype: str,
    fill: float,
    dims: tuple[str, ...],
) -> None:
    """Make an array, with what the registry says of its variable."""
    array = group.create_array(
        name, shape=shape, chunks=chunks, dtype=dtype, fill_value=fill, dimension_names=dims
    )
    if name in VARIABLES:
        known = VARIABLES[name]
        array.attrs.update(units=known.units, long_name=known.long_name)
        if known.comment:
            array.attrs.update(comment=known.comment)


@contextmanager
def folder(
    path: Path | str | None,
    kind: Kind,
    parameters: dict[str, Any],
    make: Callable[[zarr.Group], None],
) -> Iterator[zarr.Group]:
    """Open a store, or make it; None keeps it in memory.

    Parameters
    ----------
    path
        The folder; it must not exist, or hold the same.
    kind
        What is in it.
    parameters
        What that is made from. A store with others is refused.
    make
        Makes the arrays of an empty group.

    Raises
    ------
    InputError
        If the folder holds something else, cannot be written to, or is in use.
    """
    if path is None:
        from zarr.storage import MemoryStore

        yield _made(MemoryStore(), kind, parameters, make)
        return
    try:
        there = Path(path).expanduser().resolve()
    except (TypeError, ValueError, RuntimeError):
        raise InputError(f"store: {path!r}; the path of a folder is accepted") from None
    try:
        if not there.parent.is_dir():
            raise FileNotFoundError(2, "the folder that it lies in does not exist")
        if there.is_dir() and (done := _whole(there, kind, parameters)) is not None:
            yield done
            return
        # Taken first: of two processes that would make the store, one is refused.
        lock = there.with_name(f".{there.name}.lock")
        with FileLock(lock).acquire(timeout=0):
            group = _opened(there, kind, parameters, make)
            yield group
            if finished(group):
                lock.unlink(missing_ok=True)
    except Timeout:
        raise InputError(
            f"store: {str(there)!r} is being written by another process; when that has ended, or "
            "another folder, is accepted"
        ) from None
    except OSError as error:
        raise InputError(
            f"store: {str(there)!r} cannot be written ({error.strerror or error}); a folder "
            "beside others that you may write to, on a disk with room, is accepted"
        ) from None


def _whole(there: Path, kind: Kind, parameters: dict[str, Any]) -> zarr.Group | None:
    """The store if all of it is there: to read it takes no lock, and no right to write."""
    if not any(there.iterdir()):
        return None
    group = _checked(there, kind, parameters, "r")
    return group if finished(group) else None


def _opened(
    there: Path, kind: Kind, parameters: dict[str, Any], make: Callable[[zarr.Group], None]
) -> zarr.Group:
    from zarr.storage import LocalStore

    if not there.exists() or (there.is_dir() and not any(there.iterdir())):
        # Made beside it and renamed: the store is there with all its arrays, or not at all.
        beside = there.with_name(f".{there.name}.making")
        shutil.rmtree(beside, ignore_errors=True)  # one that was killed may have left it
        _made(LocalStore(beside), kind, parameters, make)
        os.replace(beside, there)
    return _checked(there, kind, parameters, "r+")


def _made(
    store: Any, kind: Kind, parameters: dict[str, Any], make: Callable[[zarr.Group], None]
) -> zarr.Group:
    import zarr

    group = zarr.open_group(store, mode="w")
    make(group)
    group.attrs.update(
        created_by=kind.created_by,
        vibroimpact_version=__version__,
        parameters=json.dumps(parameters),
    )
    return group


def _checked(
    there: Path, kind: Kind, parameters: dict[str, Any], mode: Literal["r", "r+"]
) -> zarr.Group:
    """The group in a folder, if it is this one."""
    import zarr
    from zarr.storage import LocalStore

    try:
        group = zarr.open_group(LocalStore(there, read_only=mode == "r"), mode=mode)
        held = group.attrs.asdict()
        if held.get("created_by") != kind.created_by:
            raise ValueError(there)
        known = json.loads(str(held["parameters"]))
        version = held["vibroimpact_version"]
        missing = kind.arrays - set(group.array_keys())
        if missing:
            raise KeyError(*missing)
    except (OSError, ValueError, KeyError):
        raise InputError(
            f"store: {str(there)!r} exists and is no {kind.word}, or a damaged one; a folder that "
            f"does not exist, or a {kind.word} to be completed, is accepted"
        ) from None
    wanted = json.loads(json.dumps(parameters))
    differing = [name for name in wanted if known.get(name) != wanted[name]]
    if version != __version__:
        differing.append("vibroimpact_version")
    if differing:
        raise InputError(
            f"store: {str(there)!r} holds another {kind.word}: {', '.join(differing)} differ; "
            "another folder, or the same values, are accepted"
        )
    return group
