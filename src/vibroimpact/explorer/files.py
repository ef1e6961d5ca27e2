"""Files that a page can save: the study, a program, and the resonance curves."""

from __future__ import annotations

import base64
from collections.abc import Callable
from typing import Any

import xarray as xr

from vibroimpact.datasets.files import sealed_bytes
from vibroimpact.datasets.tables import to_table
from vibroimpact.errors import InputError, shown
from vibroimpact.explorer import share
from vibroimpact.explorer.state import PageState
from vibroimpact.model.names import file_stem


def made(kind: str, state: PageState, swept: Callable[[], xr.Dataset]) -> dict[str, Any]:
    """Return a file: its name, its media type and its bytes (as Base64 text).

    `swept` returns the fine sweep of the state.

    Raises
    ------
    InputError
        If the kind is unknown.
    """
    ways: dict[str, tuple[str, str, Callable[[], bytes]]] = {
        "study": (".toml", "application/toml", lambda: share.study(state).encode()),
        "python": (".py", "text/x-python", lambda: share.program(state).encode()),
        "netcdf": ("-sweep.nc", "application/x-netcdf", lambda: sealed_bytes(swept())),
        "csv": ("-sweep.csv", "text/csv", lambda: to_table(swept()).to_csv().encode()),
    }
    if kind not in ways:
        raise InputError(f"file: {shown(kind)} is unknown; use one of {', '.join(ways)}")
    ending, mime, write = ways[kind]
    return {
        "file": file_stem(state.name) + ending,
        "mime": mime,
        "bytes": base64.b64encode(write()).decode(),
    }
