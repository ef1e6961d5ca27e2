"""Datasets to NetCDF files and back, never half-written."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from pathlib import Path

import xarray as xr

from vibroimpact.errors import InputError


def write_whole(path: Path | str, write: Callable[[Path], None]) -> Path:
    """Let `write` write a file beside `path`, then rename it: the old file or the new, whole.

    Raises
    ------
    InputError
        If the folder is missing or cannot be written to.
    """
    target = Path(path)
    try:
        handle, name = tempfile.mkstemp(
            dir=target.parent, prefix=f".{target.stem}-", suffix=target.suffix
        )
        os.close(handle)
        beside = Path(name)
        try:
            write(beside)
            mask = os.umask(0)
            os.umask(mask)
            beside.chmod(0o666 & ~mask)  # mkstemp's files are private
            beside.replace(target)
        finally:
            beside.unlink(missing_ok=True)
    except OSError as error:
        raise InputError(
            f"output: {str(target)!r} cannot be written ({error.strerror or error}); "
            "a file in an existing folder that you may write to is accepted"
        ) from None
    return target


def save(dataset: xr.Dataset, path: Path | str) -> Path:
    """Write a dataset to a NetCDF file.

    Raises
    ------
    InputError
        If the file cannot be written; a file that was there is then as it was.
    """
    return write_whole(path, lambda beside: dataset.to_netcdf(beside, engine="h5netcdf"))


def load(path: Path | str) -> xr.Dataset:
    """Read a dataset that `save` wrote.

    Raises
    ------
    InputError
        If the file is missing, truncated, or not one of this package's.
    """
    if not Path(path).is_file():
        raise InputError(f"file: {str(path)!r} does not exist; a NetCDF file is accepted")
    try:
        data: xr.Dataset = xr.load_dataset(path, engine="h5netcdf")
    except (OSError, ValueError, KeyError, RuntimeError) as error:
        reason = str(error).splitlines()[0]
        raise InputError(
            f"file: {str(path)!r} is damaged or not a NetCDF file ({reason}); "
            "a file written by vibroimpact is accepted"
        ) from None
    if "vibroimpact_version" not in data.attrs:
        raise InputError(
            f"file: {str(path)!r} was not written by vibroimpact; a file that it wrote is accepted"
        )
    return data
