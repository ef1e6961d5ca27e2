"""Labels of quantities of the mass, which are absolute if the base is at rest."""

from __future__ import annotations

from collections.abc import Iterable

import xarray as xr

from vibroimpact.datasets.description import base_at_rest


def base_label(label: str, data: Iterable[xr.Dataset]) -> str:
    """Return the label of an axis. If a force or nothing shakes all rigs, the base is at rest.

    Then the displacement and the velocity are absolute, and the absolute acceleration is ü.
    """
    if not all(base_at_rest(one) for one in data):
        return label
    for moving, still in (("relative", "absolute"), (" + A_t", "")):
        label = label.replace(moving, still)
    return label
