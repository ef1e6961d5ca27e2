"""Own outputs of the motions at which the holds of sweeps end."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine.status import Status
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.outputs import NamedOutput, add_outputs, computed
from vibroimpact.tasks.threads import Progress, Workers, each

_Array = NDArray[np.float64]


class _Hold(NamedTuple):
    """The motion at which a hold ended."""

    number: int
    """Number of the rig."""
    rig: Rig
    amplitude: float
    frequency: float
    phase: float
    state: _Array

    def outputs(
        self, own: tuple[NamedOutput, ...], cycles: int, periodic: bool
    ) -> tuple[float, ...]:
        """Compute own outputs over some forcing cycles; NaN if there are none."""
        if not cycles:
            return (math.nan,) * len(own)
        shaken = self.rig.hardest.periodic.replace(
            amplitude=self.amplitude, frequency=self.frequency, phase=self.phase
        )
        start = engine_system(self.rig.system).state(self.state, self.phase)
        return computed(own, Rig(self.rig.system, shaken), start, cycles, periodic=periodic)


def add_sweep_outputs(
    data: xr.Dataset,
    own: Sequence[tuple[NamedOutput, ...]],
    rigs: Sequence[Rig],
    levels: Sequence[_Array],
    phase: float,
    states: _Array,
    window: int,
    workers: Workers,
    progress: Progress | None,
) -> None:
    """Add own outputs to the dataset of `sweeps`.

    `own`, `rigs` and `levels` (amplitudes by frequency) are those of each rig.

    Parameters
    ----------
    phase
        Phase of the forcing at the section (rad).
    states : ndarray, shape (rig, direction, frequency, ...)
        States of the engine at the ends of the holds, without the clock of the forcing.
    window
        Cycles of a motion that does not settle.
    workers, progress
        Where the outputs are computed, and the progress, whose first half the sweeps are.
    """
    frequencies = data["frequency"].values
    holds = [
        _Hold(r, rigs[r], float(levels[r][i]), float(frequencies[i]), phase, states[r, d, i])
        for r, d, i in np.ndindex(data["period"].shape)
    ]
    period, status = data["period"].values.ravel(), data["status"].values.ravel()
    lengths = np.where(period > 0, period, window)
    lengths[~np.isin(status, (Status.DONE, Status.NOT_SETTLED))] = 0
    steps = len(holds)
    # Functions travel to other processes with the task, which may be any code; items may not.
    values = each(
        lambda item, _: item[0].outputs(own[item[0].number], *item[1:]),
        list(zip(holds, lengths.tolist(), (period > 0).tolist(), strict=True)),
        threads=workers,
        progress=progress and (lambda done, _: progress(steps + done, 2 * steps)),
    )
    add_outputs(data, own[0], np.reshape(values, (*data["period"].shape, len(own[0]))))
