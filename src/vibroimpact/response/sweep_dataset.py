"""What the holds of sweeps measured, as a labelled dataset."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import hold
from vibroimpact.model import Oscillator
from vibroimpact.response.engine_input import components


def held(
    oscillators: Sequence[Oscillator],
    results: NDArray[np.float64],
    states: NDArray[np.float64],
    free: NDArray[np.float64],
    largest: NDArray[np.float64],
    phase: float,
) -> xr.Dataset:
    """Label what holds measured.

    Parameters
    ----------
    oscillators
        One for each rig.
    results
        Rows of `hold`, with the dims rig, direction, frequency and column.
    states
        At the end of each hold, likewise.
    free
        Excursions (m, m/s²) in free flight, of each rig at each frequency.
    largest
        The largest ones, of each rig.
    phase
        That of the section, rad.
    """
    dims = ("rig", "direction", "frequency")
    found = [sizes(one, rows) for one, rows in zip(oscillators, results, strict=True)]
    # What is stacked is not kept a second time.
    told = {name: np.stack([one.pop(name) for one in found]) for name in list(found[0])}
    reference = largest[..., np.newaxis, np.newaxis]
    period = results[..., hold.PERIOD].astype(np.int64)
    values = {
        **told,
        "eta_d": told["displacement_excursion"] / reference[0],
        "eta_a": told["acceleration_excursion"] / reference[1],
        "motion": np.where(period > 0, "periodic", "undecided"),
        "period": period,
        "cycles": results[..., hold.CYCLES].astype(np.int64),
        "status": results[..., hold.OUTCOME].astype(np.int64),
    }
    data = xr.Dataset({name: (dims, value) for name, value in values.items()})
    data["section"] = ((*dims, "component"), components(states, phase))
    data["free_displacement_excursion"] = (("rig", "frequency"), free[0])
    data["free_acceleration_excursion"] = (("rig", "frequency"), free[1])
    data["largest_free_displacement_excursion"] = ("rig", largest[0])
    data["largest_free_acceleration_excursion"] = ("rig", largest[1])
    return data


def sizes(oscillator: Oscillator, rows: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """Extremes, contacts per cycle and contact forces of one rig, by the names of variables.

    Parameters
    ----------
    oscillator
        The rig.
    rows
        Rows of `hold`, their columns last.
    """
    low, high = rows[..., hold.U_LEAST], rows[..., hold.U_MOST]
    floor, ceiling = rows[..., hold.A_LEAST], rows[..., hold.A_MOST]
    found = {
        "displacement_excursion": high - low,
        "acceleration_excursion": ceiling - floor,
        "displacement_max": high,
        "displacement_min": low,
        "acceleration_max": ceiling,
        "acceleration_min": floor,
        "peak_displacement": np.maximum(np.abs(high), np.abs(low)),
        "peak_acceleration": np.maximum(np.abs(ceiling), np.abs(floor)),
        "eccentricity": 0.5 * (high + low),
        "impacts_right": rows[..., hold.HITS_RIGHT],
        "impacts_left": rows[..., hold.HITS_LEFT],
    }
    for side, force, impulse in (
        ("right", hold.FORCE_RIGHT, hold.IMPULSE_RIGHT),
        ("left", hold.FORCE_LEFT, hold.IMPULSE_LEFT),
    ):
        found[f"peak_force_{side}"] = oscillator.mass * rows[..., force]
        found[f"peak_impulse_{side}"] = oscillator.mass * rows[..., impulse]
    return found
