"""What the holds of sweeps measured, as a labelled dataset."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.stops import dims_of, stops_of
from vibroimpact.model import Oscillator
from vibroimpact.response.assembly_rows import measured_variables
from vibroimpact.response.engine_input import components
from vibroimpact.response.hold_rows import HoldRows


def sweep_dataset(
    oscillators: Sequence[Oscillator],
    results: NDArray[np.float64],
    states: NDArray[np.float64],
    free: NDArray[np.float64],
    largest: NDArray[np.float64],
    exciting: NDArray[np.float64],
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
        Excursions in free flight, of each rig at each frequency: of the displacement (m), of the
        absolute acceleration (m/s²) and of the transmitted force per unit mass (m/s²).
    largest
        The largest ones, of each rig.
    exciting
        Excursion of the exciting force per unit mass (m/s²), of each rig at each frequency.
    phase
        That of the section, rad.
    """
    dims = ("rig", "direction", "frequency")
    stops = stops_of(*oscillators)
    found = [
        measured_variables(one, part, dims[1:], stops=stops)
        for one, part in zip(oscillators, results, strict=True)
    ]
    # What is stacked is not kept a second time.
    told = {name: np.stack([one.pop(name)[1] for one in found]) for name in list(found[0])}
    reference = largest[..., np.newaxis, np.newaxis]
    rows = HoldRows(results)
    values = {
        **told,
        "eta_d": told["displacement_excursion"] / reference[0],
        "eta_a": told["acceleration_excursion"] / reference[1],
        "transmissibility": rows.transmitted_excursion / exciting[:, np.newaxis],
        "motion": np.where(rows.period > 0, "periodic", "undecided"),
        "period": rows.period,
        "cycles": rows.cycles,
        "status": rows.status.astype(np.int64),
    }
    data = xr.Dataset({name: (dims_of(name, dims), value) for name, value in values.items()})
    data = data.assign_coords(stop=stops)
    data["section"] = ((*dims, "component"), components(states, phase))
    data["free_displacement_excursion"] = (("rig", "frequency"), free[0])
    data["free_acceleration_excursion"] = (("rig", "frequency"), free[1])
    masses = np.array([[one.mass] for one in oscillators])
    data["free_transmitted_force_excursion"] = (("rig", "frequency"), masses * free[2])
    data["largest_free_displacement_excursion"] = ("rig", largest[0])
    data["largest_free_acceleration_excursion"] = ("rig", largest[1])
    return data
