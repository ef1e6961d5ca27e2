"""Resonance curves of the published rig, and curves made to try the definitions."""

from __future__ import annotations

from functools import cache

import numpy as np
import xarray as xr

import vibroimpact as vi
from vibroimpact.response.resonance import (
    Features,
)


def grid(start: float, stop: float, step: float) -> list[float]:
    return [round(start + k * step, 9) for k in range(round((stop - start) / step) + 1)]


@cache
def swept(code: str, start: float, stop: float, step: float, parameters="table") -> xr.Dataset:
    case = vi.laboratory.case(code, parameters)
    return vi.sweep(vi.Rig(case.oscillator, case.amplitude), grid(start, stop, step))


def made(frequency, forward, backward=None, *, settled=True, period=1) -> xr.Dataset:
    """A dataset as a sweep makes it, from given curves (η_a and η_d alike)."""
    curves = {"forward": forward} | ({} if backward is None else {"backward": backward})
    shape = (len(curves), len(frequency))
    dims = ("direction", "frequency")
    eta = np.array(list(curves.values()), dtype=float)
    settled = np.broadcast_to(settled, shape)
    return xr.Dataset(
        {
            "eta_a": (dims, eta),
            "eta_d": (dims, eta),
            "motion": (dims, np.where(settled, "periodic", "undecided")),
            "period": (dims, np.broadcast_to(period, shape)),
            "impacts": ((*dims, "stop"), np.zeros((*shape, 2))),
        },
        coords={
            "direction": list(curves),
            "frequency": np.asarray(frequency, dtype=float),
            "stop": ["right", "left"],
        },
    )


def primary(curve_features: Features, direction: str, curve: str = "eta_a") -> float:
    (only,) = (
        p
        for p in curve_features.peaks
        if (p.direction, p.curve, p.primary) == (direction, curve, True)
    )
    return only.frequency
