"""Curves made for the purpose, as a sweep's dataset, and the scenario that they are named."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

import vibroimpact as vi
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.scenarios.classification import scenario
from vibroimpact.scenarios.evidence import evidence
from vibroimpact.scenarios.thresholds import Thresholds

GRID = np.round(np.arange(0.40, 3.01, 0.01), 10)


RIG = one_sine(
    vi.from_dimensionless(20.0, 0.3, 0.01, 0.15, mass=1.0, stiffness=(2.0 * math.pi) ** 2), "RIG"
)


GAP = RIG.oscillator.right.gap


def bump(centre: float, width: float, height: float) -> np.ndarray:
    return height * np.exp(-(((GRID - centre) / width) ** 2))


def slope(jump_at: float) -> np.ndarray:
    """A primary resonance that rises to a jump and is small beyond it."""
    return np.where(jump_at + 1e-9 >= GRID, 0.3 + GRID, 0.2)


def inside(low: float, high: float) -> np.ndarray:
    return (low - 1e-9 <= GRID) & (high + 1e-9 >= GRID)


def made(forward, backward=None, *, touching=None, period=1, uneven=False, depth=0.3):
    """A sweep's dataset with given η_a; η_d is in proportion, regular unless told otherwise."""
    backward = forward if backward is None else backward
    eta = np.array([forward, backward])
    shape, dims = eta.shape, ("direction", "frequency")
    touching = np.broadcast_to(eta > 0.25 if touching is None else touching, shape)
    period = np.broadcast_to(period, shape)
    reach = np.where(touching, (1.0 + depth) * GAP, 0.5 * GAP)
    free = np.abs(1.0 / (1.0 - GRID**2 + 0.3j * GRID))
    return xr.Dataset(
        {
            "eta_a": (dims, eta),
            "eta_d": (dims, 0.3 * eta),
            "motion": (dims, np.where(period > 0, "periodic", "undecided")),
            "period": (dims, period),
            "impacts": ((*dims, "stop"), np.stack([touching.astype(float)] * 2, axis=-1)),
            "displacement_max": (dims, reach),
            "displacement_min": (dims, -reach),
            "displacement_excursion": (dims, 2.0 * reach),
            "eccentricity": (dims, np.where(uneven, 0.1 * GAP, 0.0) * np.ones(shape)),
            "free_displacement_excursion": ("frequency", 2.0 * GAP / 0.3 * free / free.max()),
        },
        coords={
            "direction": ["forward", "backward"],
            "frequency": GRID,
            "stop": ["right", "left"],
        },
    )


def named(data: xr.Dataset, oscillator=RIG.oscillator, **thresholds: float) -> str:
    used = Thresholds(**thresholds)
    return scenario(evidence(vi.Rig(oscillator, RIG.sine), data, 0.5 * used.prominence), used).label


def primary() -> tuple[np.ndarray, np.ndarray]:
    return slope(2.2), slope(1.6)
