"""Datasets to NetCDF files and back, never half-written."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path

import xarray as xr

from vibroimpact._version import __version__
from vibroimpact.errors import InputError
from vibroimpact.response.table import as_text


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


def save(dataset: xr.Dataset | Mapping[str, xr.Dataset], path: Path | str) -> Path:
    """Write a dataset, or several by name, to a file.

    Parameters
    ----------
    dataset
        Several become the groups of the file. A blank or a slash in a name becomes an underscore.
    path
        ``.nc`` is NetCDF, which keeps everything; ``.csv`` is the table of `to_table`, for a
        spreadsheet, and holds one dataset.

    Raises
    ------
    InputError
        If the ending is another, or the file cannot be written; a file that was there is then as
        it was.
    """
    ending = Path(path).suffix.lower()
    if ending not in (".nc", ".csv"):
        raise InputError(
            f"path: {str(path)!r} ends in {ending or 'nothing'!r}; .nc (NetCDF) or .csv (a table) "
            "is accepted"
        )
    if ending == ".csv":
        if not isinstance(dataset, xr.Dataset):
            raise InputError(
                f"path: {str(path)!r} would hold several datasets; a table for each, or .nc, is "
                "accepted"
            )
        text = as_text(dataset)
        return write_whole(path, lambda beside: _write(beside, text))
    if isinstance(dataset, xr.Dataset):
        return write_whole(path, lambda beside: dataset.to_netcdf(beside, engine="h5netcdf"))
    names = {name: name.replace(" ", "_").replace("/", "_") for name in dataset}
    if len(set(names.values())) < len(names):
        raise InputError(
            f"dataset: the names {', '.join(map(repr, names))} are not different as groups of a "
            "file; names that differ otherwise than by blanks and slashes are accepted"
        )
    tree = xr.DataTree.from_dict({names[name]: data for name, data in dataset.items()})
    tree.attrs["vibroimpact_version"] = __version__
    return write_whole(path, lambda beside: tree.to_netcdf(beside, engine="h5netcdf"))


def _write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")


def load(path: Path | str, group: str | None = None) -> xr.Dataset:
    """Read a dataset that `save` wrote.

    Parameters
    ----------
    path
        The file.
    group
        Which of several datasets.

    Raises
    ------
    InputError
        If the file is missing, truncated, or not one of this package's; or if it holds several
        datasets, and ``group`` names none of them.
    """
    if not Path(path).is_file():
        raise InputError(f"file: {str(path)!r} does not exist; a NetCDF file is accepted")
    try:
        groups = [part.strip("/") for part in xr.open_groups(path, engine="h5netcdf")]
        groups = [part for part in groups if part]
        if group in groups or (group is None and not groups):
            data: xr.Dataset = xr.load_dataset(path, engine="h5netcdf", group=group)
    except (OSError, ValueError, KeyError, RuntimeError) as error:
        reason = str(error).splitlines()[0]
        raise InputError(
            f"file: {str(path)!r} is damaged or not a NetCDF file ({reason}); "
            "a file written by vibroimpact is accepted"
        ) from None
    if group not in groups and (groups or group is not None):
        given = "it holds several datasets" if group is None else f"it has no group {group!r}"
        accepted = f"{', '.join(groups)} are accepted" if groups else "None is accepted"
        raise InputError(f"group: {group!r} of {str(path)!r}: {given}; {accepted}")
    if "vibroimpact_version" not in data.attrs:
        raise InputError(
            f"file: {str(path)!r} was not written by vibroimpact; a file that it wrote is accepted"
        )
    return data
