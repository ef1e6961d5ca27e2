"""A map on disk, as a Zarr group that is written a block at a time.

Every array is written block by block, each block a file of its own that is renamed into place;
only then the block is marked done. A map that was stopped at any moment therefore lacks at most
the block that was in work, and is completed to what it would have been.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.grids.refinement import UNKNOWN
from vibroimpact.model.excitation import Of
from vibroimpact.model.parameters import usual
from vibroimpact.scenarios.axes import Axis
from vibroimpact.scenarios.map_node import COUNTS, VALUES
from vibroimpact.scenarios.scenario import FLAGS
from vibroimpact.stores.zarr_store import (
    Kind,
    StorePart,
    create,
    finished,
    folder,
    read,
    write_block,
)

if TYPE_CHECKING:  # it takes long to load: only where a map is made or read
    import zarr

CREATED_BY = "vibroimpact.scenario_map"

_KIND = Kind("map", CREATED_BY, frozenset({"scenario", "level", *VALUES, *COUNTS}))


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
        parts = {}
        for name, new in {**values, "level": np.full(chosen.sum(), level)}.items():
            if chosen.all():
                parts[name] = np.reshape(new, chosen.shape)
            else:
                parts[name] = self._read(name, block)
                parts[name][chosen] = new
        write_block(self._group, block, parts)

    def inherit(self, scenarios: NDArray[np.int8]) -> None:
        """Put the scenarios of all nodes; the levels show which were computed."""
        array = self._array("scenario")
        for rows, columns in itertools.product(*map(chunk_slices, array.shape, array.chunks)):
            part = {"scenario": scenarios[rows, columns]}
            write_block(self._group, (rows, columns), part)

    def done(self, level: int, row: int, column: int) -> bool:
        """Whether a block of a level is complete."""
        return bool(self._read("done", (level, row, column)) == 1)

    def mark(self, level: int, row: int, column: int) -> None:
        """Say that a block of a level is complete."""
        self._array("done")[level, row, column] = 1

    def finished(self) -> bool:
        """Whether the map is complete."""
        return finished(self._group)

    def finish(self) -> None:
        """Mark the map as complete."""
        self._group.attrs["finished"] = True

    def dataset(self) -> xr.Dataset:
        """The map; values are read when they are used."""
        from vibroimpact.stores.lazy_array import lazy_dataset

        data = lazy_dataset(self._group, ["scenario", *VALUES, *COUNTS, "level"])
        del data.attrs["finished"]
        return data

    def _array(self, name: str) -> zarr.Array[Any]:
        import zarr

        array = self._group[name]
        assert isinstance(array, zarr.Array)
        return array

    def _read(self, name: str, where: Any = ...) -> NDArray[Any]:
        return read(self._group, "map", name, where)


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
    parameters
        What the map is made from. A store with others is refused.

    Raises
    ------
    InputError
        If the folder holds something else, cannot be written to, or is in use.
    """
    of: Of = parameters["base"].get("of", "acceleration")
    make = partial(_make, axes=axes, chunk=chunk, levels=levels, of=of)
    rows, columns = (chunk_slices(len(one.values), chunk) for one in reversed(axes))
    blocks = (
        StorePart(tuple((level, r, c) for level in range(levels)), (row, column))
        for r, row in enumerate(rows)
        for c, column in enumerate(columns)
    )
    with folder(path, _KIND, parameters, make, blocks) as group:
        yield MapStore(group)


def chunk_slices(length: int, chunk: int) -> list[slice]:
    """Return the parts of a dim that are chunks."""
    return [slice(start, start + chunk) for start in range(0, length, chunk)]


def _make(group: zarr.Group, axes: tuple[Axis, Axis], chunk: int, levels: int, of: Of) -> None:
    import zarr

    x, y = axes
    dims = (y.name, x.name)
    shape = (len(y.values), len(x.values))
    for one in axes:
        create(group, one.name, one.values.shape, one.values.shape, "f8", np.nan, (one.name,))
        array = group[one.name]
        assert isinstance(array, zarr.Array)
        array[:] = one.values
        known = usual(one.name, of)
        array.attrs.update(units=known.units, long_name=known.long_name)
    chunks = (min(chunk, shape[0]), min(chunk, shape[1]))
    create(group, "scenario", shape, chunks, "i1", UNKNOWN, dims)
    group["scenario"].attrs.update(FLAGS)
    for name in VALUES:
        create(group, name, shape, chunks, "f8", np.nan, dims)
    for name in (*COUNTS, "level"):
        create(group, name, shape, chunks, "i2", -1, dims)
    blocks = tuple(-(-n // chunk) for n in shape)
    create(group, "done", (levels, *blocks), (1, 1, 1), "i1", 0, ("pass", "row", "column"))
