"""Arrays of a store that are read when they are used, and then still checked."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
import zarr
from numpy.typing import NDArray
from xarray.backends import BackendArray
from xarray.core import indexing

from vibroimpact.errors import InputError


class _LazyArray(BackendArray):
    """An array of a finished store."""

    def __init__(self, array: zarr.Array[Any]) -> None:
        self._stored = array
        self.shape, self.dtype = array.shape, np.dtype(array.dtype)

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        return indexing.explicit_indexing_adapter(
            key, self.shape, indexing.IndexingSupport.OUTER, self._read
        )

    def _read(self, key: tuple[Any, ...]) -> NDArray[Any]:
        stored = self._stored
        try:
            # A chunk without a file would be read as the fill value.
            missing = stored.nchunks - stored.nchunks_initialized
            if missing:
                raise ValueError(f"files of chunks that are missing: {missing}")
            return np.asarray(stored.oindex[key])
        except (OSError, RuntimeError, ValueError) as error:
            reason = (str(error).splitlines() or [type(error).__name__])[0]
            raise InputError(
                f"store: {str(getattr(stored.store, 'root', stored.store))!r} was damaged after it "
                f"was opened ({stored.basename}: {reason}); repeat the call that opened it: "
                "this computes the damaged parts again"
            ) from None


def lazy_dataset(group: zarr.Group, names: list[str]) -> xr.Dataset:
    """Return arrays of a finished store; values are read when they are used.

    Whatever is damaged by then raises an `InputError`.
    """
    data: xr.Dataset = xr.open_zarr(group.store, consolidated=False, chunks=None)
    for name in names:
        array, plain = group[name], data[name].variable
        assert isinstance(array, zarr.Array)
        lazy = indexing.LazilyIndexedArray(_LazyArray(array))
        data[name] = xr.Variable(plain.dims, lazy, plain.attrs, plain.encoding)
    return data[names]
