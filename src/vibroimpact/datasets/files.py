"""Write datasets to NetCDF files in one step, and check the files when they are read."""

from __future__ import annotations

import hashlib
import io
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path

import xarray as xr

from vibroimpact._version import __version__
from vibroimpact.arguments import check_mapping, check_path, check_variables
from vibroimpact.datasets.tables import as_text
from vibroimpact.errors import InputError, shown, warn_of_input
from vibroimpact.model.argument_types import File
from vibroimpact.model.public import public

_SEAL = b"\nvibroimpact sha256 "
"""Mark before the digest at the end of a file. HDF5 knows the length of its data and ignores
both."""
_SEAL_LENGTH = len(_SEAL) + 2 * hashlib.sha256().digest_size


def write_whole(path: Path | str, content: bytes | str) -> Path:
    """Write a file next to `path`, then rename it, so that `path` is always a complete file.

    The content is complete before anything is written. Therefore, if the disk is full, the
    operating system raises an error here, and not within the library of a file format.

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
            beside.write_bytes(content.encode() if isinstance(content, str) else content)
            mask = os.umask(0)
            os.umask(mask)
            beside.chmod(0o666 & ~mask)  # mkstemp's files are private
            beside.replace(target)
        finally:
            beside.unlink(missing_ok=True)
    except OSError as error:
        raise InputError(
            f"output: {str(target)!r} cannot be written ({error.strerror or error}); "
            "choose an existing folder that you may write to"
        ) from None
    return target


@public
def save(dataset: xr.Dataset | Mapping[str, xr.Dataset], path: File) -> Path:
    """Write one dataset, or several named datasets, to a file.

    Parameters
    ----------
    dataset
        A dataset, or a mapping from names to datasets. Each dataset of a mapping becomes a group of
        the file. A blank or a slash in a name is replaced by an underscore.
    path
        File name, whose ending selects the format. ``.nc`` writes a NetCDF file with all variables
        and attributes. ``.csv`` writes the table of `to_table` for a spreadsheet; such a file can
        hold only one dataset.

    Raises
    ------
    InputError
        If the file name has another ending, or if the file cannot be written. In both cases an
        existing file is left unchanged.
    """
    ending = Path(path).suffix.lower()
    if ending not in (".nc", ".csv"):
        wrong = f"has the ending {ending!r}" if ending else "has no ending"
        raise InputError(
            f"path: {str(path)!r} {wrong}; use the ending .nc (NetCDF) or .csv (table)"
        )
    if not isinstance(dataset, xr.Dataset):
        check_mapping(dataset, "dataset", "a dataset, or a dict of datasets by name")
    if ending == ".csv":
        if not isinstance(dataset, xr.Dataset):
            raise InputError(
                f"path: {str(path)!r} can hold only one dataset, not a dict of datasets; save each "
                "dataset to its own .csv file, or use the ending .nc"
            )
        return write_whole(path, as_text(dataset))
    if isinstance(dataset, xr.Dataset):
        return write_whole(path, sealed_bytes(dataset))

    for name, one in dataset.items():
        check_variables(one, (), f"dataset[{name!r}]", "a dataset, such as the result of sweep")
    names = {name: name.replace(" ", "_").replace("/", "_") for name in dataset}
    written = list(names.values())
    if equal := [repr(name) for name, new in names.items() if written.count(new) > 1]:
        raise InputError(
            f"dataset: the names {', '.join(equal)} become equal in the file, because '_' replaces "
            "blanks and slashes there; rename one of these datasets"
        )
    tree = xr.DataTree.from_dict({names[name]: data for name, data in dataset.items()})
    tree.attrs["vibroimpact_version"] = __version__
    return write_whole(path, sealed_bytes(tree))


def sealed_bytes(data: xr.Dataset | xr.DataTree) -> bytes:
    """Return the bytes of the NetCDF file that `save` writes, with their digest appended.

    The checksums of HDF5 do not protect names and attributes: with them, of 1,500 random flips of
    a bit in a file, 48 changed the dataset that was read, without an error.
    """
    file = io.BytesIO()
    data.to_netcdf(file, engine="h5netcdf")
    content = file.getvalue()
    return content + _SEAL + hashlib.sha256(content).hexdigest().encode()


def _unsealed(content: bytes) -> tuple[bytes, bool]:
    """Return the bytes of a NetCDF file without the digest, and whether there was a digest.

    Raises
    ------
    ValueError
        If the digest does not match the content.
    """
    seal = content[-_SEAL_LENGTH:]
    if not seal.startswith(_SEAL):
        if _SEAL in seal or any(seal.endswith(_SEAL[:n]) for n in range(2, len(_SEAL))):
            raise ValueError("it is cut off within its checksum")
        return content, False
    content = content[:-_SEAL_LENGTH]
    if hashlib.sha256(content).hexdigest().encode() != seal.removeprefix(_SEAL):
        raise ValueError("its content does not match its checksum")
    return content, True


@public
def load(path: Path | str, group: str | None = None) -> xr.Dataset:
    """Read a dataset from a file that `save` has written.

    Parameters
    ----------
    path
        The file.
    group
        Name of the dataset. It is required if the file holds several datasets.

    Raises
    ------
    InputError
        If the file is missing or damaged, or if it was not written by this package. Also if the
        file holds several datasets, and ``group`` is not the name of one of them.

    Warns
    -----
    InputWarning
        If the file has no checksum, which means that another program has changed it.
    """
    file_path = check_path(path, "file")
    if file_path.is_dir():
        raise InputError(
            f"file: {str(path)!r} is a folder; pass a NetCDF file, or, to read the store of a map "
            "or of demands, call scenario_map or demands again with the same store"
        )
    if not file_path.is_file():
        raise InputError(f"file: {str(path)!r} does not exist; pass the path of a NetCDF file")
    try:
        content, is_sealed = _unsealed(Path(path).read_bytes())
        file = io.BytesIO(content)
        groups = [part.strip("/") for part in xr.open_groups(file, engine="h5netcdf")]
        groups = [part for part in groups if part]
        exists = group in groups if isinstance(group, str) else group is None and not groups
        if exists:
            data: xr.Dataset = xr.load_dataset(file, engine="h5netcdf", group=group)
    except (OSError, ValueError, KeyError, RuntimeError, TypeError, AttributeError) as error:
        reason = (str(error).splitlines() or [type(error).__name__])[0]
        raise InputError(
            f"file: {str(path)!r} is damaged or not a NetCDF file ({reason}); "
            "pass a complete file that vibroimpact wrote"
        ) from None
    if not exists:
        known = f"pass one of {', '.join(groups)}" if groups else "leave group out"
        if group is None:
            raise InputError(f"group: missing, but {str(path)!r} has several groups; {known}")
        raise InputError(f"group: {str(path)!r} has no group {shown(group)}; {known}")
    if "vibroimpact_version" not in data.attrs:
        raise InputError(
            f"file: {str(path)!r} was not written by vibroimpact; use xarray.open_dataset to read "
            "files of other programs"
        )
    if not is_sealed:
        warn_of_input(
            f"file {str(path)!r}",
            ["it has no checksum because another program changed it, so damage cannot be detected"],
        )
    return data
