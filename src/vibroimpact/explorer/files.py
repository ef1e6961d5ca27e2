"""Files of what is shown, as a page saves them."""

from __future__ import annotations

import base64
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import xarray as xr

from vibroimpact.datasets.files import save
from vibroimpact.datasets.tables import to_table
from vibroimpact.errors import InputError, shown
from vibroimpact.explorer import share
from vibroimpact.explorer.state import State
from vibroimpact.model.names import file_stem


def made(kind: str, state: State, swept: Callable[[], xr.Dataset]) -> dict[str, Any]:
    """Return a file: its name, its kind and its bytes.

    Parameters
    ----------
    kind
        ``"study"``, ``"python"``, ``"netcdf"`` or ``"csv"``.
    state
        What is shown.
    swept
        Gives its fine sweep.

    Raises
    ------
    InputError
        If there is no such kind.
    """
    ways: dict[str, tuple[str, str, Callable[[], bytes]]] = {
        "study": (".toml", "application/toml", lambda: share.study(state).encode()),
        "python": (".py", "text/x-python", lambda: share.program(state).encode()),
        "netcdf": ("-sweep.nc", "application/x-netcdf", lambda: _netcdf(swept())),
        "csv": ("-sweep.csv", "text/csv", lambda: to_table(swept()).to_csv().encode()),
    }
    if kind not in ways:
        raise InputError(f"file: {shown(kind)} is unknown; one of {', '.join(ways)} is accepted")
    ending, mime, write = ways[kind]
    return {
        "file": file_stem(state.name) + ending,
        "mime": mime,
        "bytes": base64.b64encode(write()).decode(),
    }


def _netcdf(data: xr.Dataset) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "sweep.nc"
        save(data, path)
        return path.read_bytes()
