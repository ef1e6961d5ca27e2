"""Made-up tests of known rigs."""

from __future__ import annotations

import numpy as np
import xarray as xr

import vibroimpact as vi
from vibroimpact.measurements.read import as_measured

FREQUENCIES = np.round(np.arange(0.5, 5.01, 0.1), 10)
FREE = ("isolator.stiffness", "isolator.damping", "stops.stiffness", "stops.damping", "gap")
EXCURSIONS = ("displacement_excursion", "acceleration_excursion")
PEAKS = ("displacement_max", "displacement_min", "acceleration_max", "acceleration_min")


def truth(rig: vi.Oscillator) -> np.ndarray:
    """The five values of a symmetric rig."""
    one = rig.right
    return np.array(
        [rig.isolator.stiffness, rig.isolator.damping, one.stiffness, one.damping, one.gap]
    )


def off(rig: vi.Oscillator, factors: tuple[float, ...]) -> vi.Oscillator:
    """A symmetric rig with its five values multiplied."""
    k, c, bumper_k, bumper_c, gap = truth(rig) * factors
    bumper = vi.Bumper(bumper_k, bumper_c, gap)
    return vi.Oscillator(rig.mass, vi.Isolator(k, c), bumper, bumper)


def curves(
    rig: vi.Oscillator,
    amplitude: float | str,
    noise: float = 0.0,
    seed: int = 0,
    names: tuple[str, ...] = EXCURSIONS,
    frequencies: np.ndarray = FREQUENCIES,
    cycles: int = 1,
) -> xr.Dataset:
    """A stepped-sine test, each value of each cycle of a hold with its own normal noise."""
    data = vi.sweep(vi.Rig(rig, amplitude), frequencies)
    draw = np.random.default_rng(seed)
    if cycles > 1:
        data = data[list(names)].expand_dims(repeat=cycles, axis=-1)
    noisy = {n: data[n] * (1.0 + noise * draw.normal(size=data[n].shape)) for n in names}
    return as_measured(
        xr.Dataset(noisy).assign_attrs(amplitude=vi.Harmonic(amplitude, 1).amplitude)
    )
