"""Suites of records whose demands are known: datasets like those of `demands`."""

from __future__ import annotations

import json

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe


def suite(peaks: NDArray[np.float64], scales: NDArray[np.float64]) -> xr.Dataset:
    """Peak displacements over records and scales, all runs done."""
    data = xr.Dataset(
        {
            "peak_displacement": (("record", "scale"), peaks),
            "status": (("record", "scale"), np.zeros(peaks.shape, dtype=np.int64)),
        },
        {"record": [str(i) for i in range(len(peaks))], "scale": scales},
    )
    return describe(data, "made up", json.loads("{}"))


def lognormal(
    rng: np.random.Generator, records: int, scales: NDArray[np.float64], beta: float
) -> xr.Dataset:
    """Demands scale · exp(β N): a record exceeds 1 from a scale on that is lognormal about 1."""
    strength = np.exp(beta * rng.standard_normal(records))
    return suite(scales * strength[:, np.newaxis], scales)
