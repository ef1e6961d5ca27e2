"""A map on disk, as a Zarr group that is written a block at a time.

Every array is written block by block, each block a file of its own that is renamed into place;
only then the block is marked done. A map that was stopped at any moment therefore lacks at most
the block that was in work, and is completed to what it would have been.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import xarray as xr
from filelock import FileLock, Timeout
from numpy.typing import NDArray

from vibroimpact._version import __version__
from vibroimpact.errors import InputError
from vibroimpact.model.parameters import parameter
from vibroimpact.response.variables import VARIABLES
from vibroimpact.scenario.axes import Axis
from vibroimpact.scenario.cell import COUNTS, VALUES
from vibroimpact.scenario.kinds import Scenario
from vibroimpact.scenario.nodes import UNKNOWN

if TYPE_CHECKING:  # it takes long to load: only where a map is made or read
    import zarr

CREATED_BY = "vibroimpact.scenario_map"


class MapStore:
    """The arrays of a map."""

    def __init__(self, group: zarr.Group) -> None:
        self._group = group

    def computed(self) -> tuple[NDArray[np.int8], NDArray[np.int16]]:
        """Scenario at each node, and the level at which it was computed (-1: it was not)."""
        return self._read("scenario"), self._read("level")

    def write(
        self,
        block: tuple[slice, slice],
        chosen: NDArray[np.bool_],
        level: int,
        values: Mapping[str, NDArray[Any]],
    ) -> None:
        """Put what was computed at the chosen nodes of a block, in the order of `np.nonzero`."""
        for name, new in {**values, "level": np.full(chosen.sum(), level)}.items():
            part = self._read(name, block)
            part[chosen] = new
            self._array(name)[block] = part

    def inherit(self, scenarios: NDArray[np.int8]) -> None:
        """Put the scenarios of all nodes; the levels tell which were computed."""
        self._array("scenario")[:] = scenarios

    def done(self, level: int, row: int, column: int) -> bool:
        """Whether a block of a level is complete."""
        return bool(self._read("done", (level, row, column)) == 1)

    def mark(self, level: int, row: int, column: int) -> None:
        """Say that a block of a level is complete."""
        self._array("done")[level, row, column] = 1

    def finished(self) -> bool:
        """Whether the whole map is there."""
        return bool(self._group.attrs.get("finished", False))

    def finish(self) -> None:
        """Say that the whole map is there."""
        self._group.attrs["finished"] = True

    def dataset(self) -> xr.Dataset:
        """The map; values are read when they are used."""
        data: xr.Dataset = xr.open_zarr(self._group.store, consolidated=False, chunks=None)
        del data.attrs["finished"]
        return data[["scenario", *VALUES, *COUNTS, "level"]]

    def _array(self, name: str) -> zarr.Array[Any]:
        import zarr

        array = self._group[name]
        assert isinstance(array, zarr.Array)
        return array

    def _read(self, name: str, where: Any = ...) -> NDArray[Any]:
        try:
            return np.array(self._array(name)[where])
        except (RuntimeError, ValueError) as error:
            raise InputError(
                f"store: {self._group.store} is damaged ({name}: {error}); a map that was written "
                "by this package is accepted"
            ) from None


@contextmanager
def map_store(
    path: Path | str | None,
    axes: tuple[Axis, Axis],
    chunk: int,
    levels: int,
    parameters: dict[str, Any],
) -> Iterator[MapStore]:
    """Open a map's store, or make it; None keeps it in memory.

    Parameters
    ----------
    path
        Folder of the store; it must not exist, or hold the same map.
    axes
        x and y, with the values of the finest grid.
    chunk
        Nodes along each side of a block.
    levels
        How many there are.
    parameters
        What the map is made from. A store with others is refused.

    Raises
    ------
    InputError
        If the folder holds something else, cannot be written to, or is in use.
    """
    if path is None:
        import zarr
        from zarr.storage import MemoryStore

        yield MapStore(
            _make(zarr.open_group(MemoryStore(), mode="w"), axes, chunk, levels, parameters)
        )
        return
    try:
        folder = Path(path).expanduser().resolve()
    except (TypeError, ValueError, RuntimeError):
        raise InputError(f"store: {path!r}; the path of a folder is accepted") from None
    try:
        if not folder.parent.is_dir():
            raise FileNotFoundError(2, "the folder that it lies in does not exist")
        if folder.is_dir() and (done := _whole(folder, parameters)) is not None:
            yield done
            return
        # Taken first: of two processes that would make the store, one is refused.
        lock = folder.with_name(f".{folder.name}.lock")
        with FileLock(lock).acquire(timeout=0):
            store = MapStore(_opened(folder, axes, chunk, levels, parameters))
            yield store
            if store.finished():
                lock.unlink(missing_ok=True)
    except Timeout:
        raise InputError(
            f"store: {str(folder)!r} is being written by another process; when that has ended, or "
            "another folder, is accepted"
        ) from None
    except OSError as error:
        raise InputError(
            f"store: {str(folder)!r} cannot be written ({error.strerror or error}); a folder "
            "beside others that you may write to, on a disk with room, is accepted"
        ) from None


def _whole(folder: Path, parameters: dict[str, Any]) -> MapStore | None:
    """The store if it holds the whole map: to read it takes no lock, and no right to write."""
    if not any(folder.iterdir()):
        return None
    store = MapStore(_checked(folder, parameters, "r"))
    return store if store.finished() else None


def _opened(
    folder: Path, axes: tuple[Axis, Axis], chunk: int, levels: int, parameters: dict[str, Any]
) -> zarr.Group:
    import zarr
    from zarr.storage import LocalStore

    if not folder.exists() or (folder.is_dir() and not any(folder.iterdir())):
        # Made beside it and renamed: the store is there with all its arrays, or not at all.
        beside = folder.with_name(f".{folder.name}.making")
        shutil.rmtree(beside, ignore_errors=True)  # one that was killed may have left it
        _make(zarr.open_group(LocalStore(beside), mode="w"), axes, chunk, levels, parameters)
        os.replace(beside, folder)
    return _checked(folder, parameters, "r+")


def _checked(folder: Path, parameters: dict[str, Any], mode: Literal["r", "r+"]) -> zarr.Group:
    """The group in a folder, if it is this map."""
    import zarr
    from zarr.storage import LocalStore

    try:
        group = zarr.open_group(LocalStore(folder, read_only=mode == "r"), mode=mode)
        held = group.attrs.asdict()
        if held.get("created_by") != CREATED_BY:
            raise ValueError(folder)
        known = json.loads(str(held["parameters"]))
        version = held["vibroimpact_version"]
        missing = {"scenario", "level", "done", *VALUES, *COUNTS} - set(group.array_keys())
        if missing:
            raise KeyError(*missing)
    except (OSError, ValueError, KeyError):
        raise InputError(
            f"store: {str(folder)!r} exists and is no map, or a damaged one; a folder that does "
            "not exist, or a map to be completed, is accepted"
        ) from None
    wanted = json.loads(json.dumps(parameters))
    differing = [name for name in wanted if known.get(name) != wanted[name]]
    if version != __version__:
        differing.append("vibroimpact_version")
    if differing:
        raise InputError(
            f"store: {str(folder)!r} holds another map: {', '.join(differing)} differ; another "
            "folder, or the same values, are accepted"
        )
    return group


def _make(
    group: zarr.Group,
    axes: tuple[Axis, Axis],
    chunk: int,
    levels: int,
    parameters: dict[str, Any],
) -> zarr.Group:
    import zarr

    x, y = axes
    dims = (y.name, x.name)
    shape = (len(y.values), len(x.values))
    for one in axes:
        _create(group, one.name, one.values.shape, one.values.shape, "f8", np.nan, (one.name,))
        array = group[one.name]
        assert isinstance(array, zarr.Array)
        array[:] = one.values
        known = parameter(one.name, of=parameters["base"].get("of", "acceleration"))
        array.attrs.update(units=known.units, long_name=known.long_name)
    chunks = (min(chunk, shape[0]), min(chunk, shape[1]))
    _create(group, "scenario", shape, chunks, "i1", UNKNOWN, dims)
    group["scenario"].attrs.update(
        flag_values=[int(s) for s in Scenario], flag_meanings=" ".join(s.label for s in Scenario)
    )
    for name in VALUES:
        _create(group, name, shape, chunks, "f8", np.nan, dims)
    for name in (*COUNTS, "level"):
        _create(group, name, shape, chunks, "i2", -1, dims)
    blocks = tuple(-(-n // chunk) for n in shape)
    _create(group, "done", (levels, *blocks), (1, 1, 1), "i1", 0, ("pass", "row", "column"))
    group.attrs.update(
        created_by=CREATED_BY,
        vibroimpact_version=__version__,
        parameters=json.dumps(parameters),
    )
    return group


def _create(
    group: zarr.Group,
    name: str,
    shape: tuple[int, ...],
    chunks: tuple[int, ...],
    dtype: str,
    fill: float,
    dims: tuple[str, ...],
) -> None:
    array = group.create_array(
        name, shape=shape, chunks=chunks, dtype=dtype, fill_value=fill, dimension_names=dims
    )
    if name in VARIABLES:
        known = VARIABLES[name]
        array.attrs.update(units=known.units, long_name=known.long_name)
        if known.comment:
            array.attrs.update(comment=known.comment)
