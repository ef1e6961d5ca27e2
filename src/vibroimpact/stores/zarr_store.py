"""A Zarr group in a folder: written block by block, by one writer, with checksums.

The group exists with all its arrays or not at all. Each block has a mark in the array ``done``,
which is set when the block is complete. Each chunk carries a checksum. When a store is opened,
every block that is marked is read once; a damaged one is marked as not done, so that whoever
completes the store computes it again.
"""

from __future__ import annotations

import json
import os
import shutil
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from filelock import FileLock, Timeout
from numpy.typing import NDArray

from vibroimpact._version import __version__
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.errors import InputError, InputWarning, outside

if TYPE_CHECKING:  # it takes long to load: only where a store is made or read
    import zarr


class Kind(NamedTuple):
    """What is in a store."""

    word: str
    """Such as "map"."""
    created_by: str
    arrays: frozenset[str]
    """Names of those that are written block by block, all of them in the same chunks."""

    def arrays_of(self, group: zarr.Group) -> list[zarr.Array[Any]]:
        """Return these arrays."""
        return [group[name] for name in self.arrays]  # type: ignore[misc]


class StorePart(NamedTuple):
    """A part of a store that is written at once."""

    marks: tuple[tuple[int, ...], ...]
    """Where the array ``done`` marks it; several if it is written in several passes."""
    place: tuple[slice, ...]
    """Its part of each other array: one chunk."""


def finished(group: zarr.Group) -> bool:
    """Whether the store is complete."""
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
            f"store: {group.store} is damaged ({name}: {error}); use another folder, or "
            f"delete this {word}"
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
    """Create an array with checksums, described as the registry describes its variable."""
    from zarr.codecs import Crc32cCodec, ZstdCodec

    array = group.create_array(
        name,
        shape=shape,
        chunks=chunks,
        dtype=dtype,
        fill_value=fill,
        dimension_names=dims,
        compressors=[ZstdCodec(), Crc32cCodec()],
    )
    if name in VARIABLES:
        known = VARIABLES[name]
        array.attrs.update(units=known.units, long_name=known.long_name)
        if known.comment:
            array.attrs.update(comment=known.comment)


def write_block(
    group: zarr.Group, place: tuple[slice, ...], values: Mapping[str, NDArray[Any]]
) -> None:
    """Write one block of some arrays."""
    for name, part in values.items():
        group[name][place] = part  # type: ignore[index]


def _chunk_number(array: Any, place: tuple[slice, ...]) -> tuple[int, ...]:
    """Return the number of the chunk at a place along each dim."""
    sizes = zip(place, array.chunks, strict=False)
    number = [(part.start or 0) // size for part, size in sizes]
    # Dims beyond those of the place, such as the stops, are in one chunk.
    return (*number, *[0] * (len(array.chunks) - len(number)))


@contextmanager
def folder(
    path: Path | str | None,
    kind: Kind,
    parameters: dict[str, Any],
    make: Callable[[zarr.Group], None],
    blocks: Iterable[StorePart],
) -> Iterator[zarr.Group]:
    """Open a store, or make it; None keeps it in memory.

    If blocks are damaged, a warning reports how many; they are then marked as not done.

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
    blocks
        The parts in which it is written.

    Raises
    ------
    InputError
        If the folder holds something else, cannot be written to, or is in use.
    """
    import zarr

    # A chunk is there even where all its values are the fill value: one that is not is lost.
    every = {"array.write_empty_chunks": True}
    if path is None:
        from zarr.storage import MemoryStore

        with zarr.config.set(every):
            yield Template(kind, parameters, make, []).create(MemoryStore())
        return
    try:
        there = Path(path).expanduser().resolve()
    except (TypeError, ValueError, RuntimeError):
        raise InputError(f"store: {path!r} is not a path; pass the path of a folder") from None
    try:
        if not there.parent.is_dir():
            raise FileNotFoundError(2, "the folder that contains it does not exist")
        template = Template(kind, parameters, make, list(blocks))
        if there.is_dir() and (done := _whole(there, template)) is not None:
            yield done
            return
        # Taken first: of two processes that would make the store, one is refused.
        lock = there.with_name(f".{there.name}.lock")
        with FileLock(lock).acquire(timeout=0), zarr.config.set(every):
            try:
                yield _opened(there, template)
            finally:
                with suppress(OSError):  # Windows keeps a file that is open
                    lock.unlink(missing_ok=True)
    except Timeout:
        raise InputError(
            f"store: {str(there)!r} is being written by another process; wait until that process "
            "has ended, or use another folder"
        ) from None
    except OSError as error:
        raise InputError(
            f"store: {str(there)!r} cannot be written ({error.strerror or error}); pass a new "
            "folder in a place where you may write and where the disk has free space"
        ) from None


class Template(NamedTuple):
    """What a store must be, without what is computed."""

    kind: Kind
    parameters: dict[str, Any]
    make: Callable[[zarr.Group], None]
    blocks: list[StorePart]

    def create(self, store: Any) -> zarr.Group:
        """Write it to an empty store."""
        import zarr

        group = zarr.open_group(store, mode="w")
        self.make(group)
        group.attrs.update(
            created_by=self.kind.created_by,
            vibroimpact_version=__version__,
            parameters=json.dumps(self.parameters),
        )
        return group

    def files(self) -> dict[str, bytes]:
        """Its files by their names within the folder, but for that of the group itself."""
        from zarr.storage import MemoryStore

        kept: dict[str, Any] = {}
        self.create(MemoryStore(kept))
        return {name: value.to_bytes() for name, value in kept.items() if name != _GROUP}


_GROUP = "zarr.json"
"""File of the group's own attributes, and of each array's description."""


def _whole(there: Path, template: Template) -> zarr.Group | None:
    """The store if all of it is there: to read it takes no lock, and no right to write."""
    if not any(there.iterdir()):
        return None
    _check(there, template)
    if _altered(there, template):
        return None
    group = _group(there, "r")
    return group if finished(group) and not _damaged(there, group, template) else None


def _opened(there: Path, template: Template) -> zarr.Group:
    """The store to be completed; made where there is none, mended where it is damaged."""
    if not there.exists() or (there.is_dir() and not any(there.iterdir())):
        from zarr.storage import LocalStore

        # Made beside it and renamed: the store is there with all its arrays, or not at all.
        beside = there.with_name(f".{there.name}.making")
        shutil.rmtree(beside, ignore_errors=True)  # one that was killed may have left it
        try:
            template.create(LocalStore(beside))
            os.replace(beside, there)
        except BaseException:
            shutil.rmtree(beside, ignore_errors=True)
            raise
        return _group(there, "r+")
    _check(there, template)
    altered = _altered(there, template)
    for name, content in altered.items():
        _clear(there / name)
        (there / name).parent.mkdir(parents=True, exist_ok=True)
        (there / name).write_bytes(content)
    group = _group(there, "r+")
    damaged = _damaged(there, group, template)
    for block in damaged:
        _forget(there, group, template, block)
    if damaged or altered:
        group.attrs["finished"] = False
        warnings.warn(
            f"store: {str(there)!r} is damaged; {len(damaged)} of its {len(template.blocks)} "
            "parts are computed again",
            InputWarning,
            stacklevel=outside(),
        )
    return group


def _group(there: Path, mode: Literal["r", "r+"]) -> zarr.Group:
    import zarr
    from zarr.storage import LocalStore

    return zarr.open_group(LocalStore(there, read_only=mode == "r"), mode=mode)


def _altered(there: Path, template: Template) -> dict[str, bytes]:
    """The files that are not as they were made, with what they should hold."""
    return {
        name: content
        for name, content in template.files().items()
        if not _holds(there / name, content)
    }


def _holds(path: Path, content: bytes) -> bool:
    """Whether a file holds this; of a description, whether it says the same."""
    try:
        held = path.read_bytes()
        return held == content or (path.name == _GROUP and json.loads(held) == json.loads(content))
    except (OSError, ValueError, RecursionError):
        return False


def _damaged(there: Path, group: zarr.Group, template: Template) -> list[StorePart]:
    """The blocks that were begun and cannot be read."""
    arrays = template.kind.arrays_of(group)
    return [block for block in template.blocks if not _is_intact(there, group, arrays, block)]


def _is_intact(there: Path, group: zarr.Group, arrays: list[Any], block: StorePart) -> bool:
    """Whether a block can be read, or is not there yet."""
    try:
        marks = [group["done"][mark] == 1 for mark in block.marks]  # type: ignore[index]
        if not any(marks):
            return not finished(group)
        for array in arrays:
            array[block.place]  # raises an error if a checksum differs
    except (OSError, RuntimeError, ValueError):
        return False
    # A chunk without a file would be read as the fill value.
    return all(path.is_file() for path in _chunks(there, arrays, block))


def _chunks(there: Path, arrays: list[Any], block: StorePart) -> Iterator[Path]:
    """The files of a block in some arrays."""
    for array in arrays:
        number = _chunk_number(array, block.place)
        yield there / array.basename / array.metadata.encode_chunk_key(number)


def _forget(there: Path, group: zarr.Group, template: Template, block: StorePart) -> None:
    """Remove a block and its marks."""
    done: Any = group["done"]
    arrays = template.kind.arrays_of(group)
    for mark in block.marks:
        _clear(there / "done" / done.metadata.encode_chunk_key(mark))
    for path in _chunks(there, arrays, block):
        _clear(path)


def _clear(path: Path) -> None:
    """Remove a file, or a folder that stands in its place."""
    if path.is_dir():
        shutil.rmtree(path)
    path.unlink(missing_ok=True)


def _check(there: Path, template: Template) -> None:
    """Refuse a folder that holds something else."""
    kind = template.kind
    try:
        held = _group(there, "r").attrs.asdict()
        if held.get("created_by") != kind.created_by:
            raise ValueError(there)
        known = dict(json.loads(str(held["parameters"])))
        version = held["vibroimpact_version"]
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise InputError(
            f"store: {str(there)!r} exists, but contains no readable {kind.word}; pass the "
            f"path of a new folder, or of an unfinished {kind.word}"
        ) from None
    wanted = json.loads(json.dumps(template.parameters))
    differing = [name for name in wanted if known.get(name) != wanted[name]]
    if not differing and version != __version__:
        raise InputError(
            f"store: {str(there)!r} contains a {kind.word} of version {version} of vibroimpact, "
            f"but this is version {__version__}; use another folder"
        )
    if differing:
        raise InputError(
            f"store: {str(there)!r} contains a {kind.word} with other values of "
            f"{', '.join(differing)}; use another folder, or the same values"
        )
