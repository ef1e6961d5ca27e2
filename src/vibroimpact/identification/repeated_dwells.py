"""Values of one hold that lie apart: some of another motion than the hold was to have."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.measurements.features import outliers

_FEW = 3
"""Values of a hold from which on most of them show which are the others."""


def stray_values(name: str, data: xr.Dataset) -> list[str]:
    """Report the holds of a test whose values lie far apart, a line each."""
    off = outliers(data)
    if not off:
        return []
    known = np.any([np.isfinite(_held(data, one)) for one in off], axis=0)
    far = np.any([*off.values()], axis=0)
    lines = []
    for i, j in zip(*np.nonzero(far.any(axis=2)), strict=True):
        way, f = str(data["direction"].values[i]), float(data["frequency"].values[j])
        count, stray = int(known[i, j].sum()), int(far[i, j].sum())
        line = f"{name}: {way}, {f:.4g} Hz: "
        if count >= _FEW and 2 * stray < count:
            line += f"{stray} of {count} values {'lies' if stray == 1 else 'lie'} far from the "
            line += f"others, as if from another motion; leave {'it' if stray == 1 else 'them'} out"
        else:
            line += f"its {count} values lie far apart, as if from two motions; keep the values of "
            line += "one motion"
        lines.append(line)
    return lines


def _held(data: xr.Dataset, name: str) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]
    values = data[name].transpose("direction", "frequency", "repeat").values
    return values
