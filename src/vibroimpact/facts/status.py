"""How a single computation ended."""

from __future__ import annotations

import xarray as xr

from vibroimpact.engine.status import Status


def status_facts(data: xr.Dataset) -> dict[str, str]:
    """Return the name of a dataset's status, and its message with advice."""
    name = Status(data["status"].item()).name.lower()
    return {"status": name, "message": data.attrs["message"]}
