"""The curves of one rig in both directions, from which its scenario is determined.

They come from a dataset, or from a sweep of their own without one: a map has ten thousand.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import COMPONENTS
from vibroimpact.engine import steady_response
from vibroimpact.engine.settling import PATIENT
from vibroimpact.engine.status import NOT_SETTLED
from vibroimpact.errors import InputError
from vibroimpact.model import State
from vibroimpact.model.rig import Rig
from vibroimpact.response.curve_pair import (
    DIRECTIONS,
    Array,
    Direction,
    Flags,
    Swept,
    each_swept,
)
from vibroimpact.response.engine_input import components, state_of
from vibroimpact.response.hold_rows import HoldRows, Settling
from vibroimpact.response.sweep_arrays import plan_sweep, rows
from vibroimpact.tasks.threads import Tally

UNEVEN = 1e-6
"""Eccentricity, as a share of the excursion, that rounding does not explain."""
_TOLERANCE, _MAX_EVENTS = 1e-12, 10_000
"""As of `sweeps`."""


class Curves(NamedTuple):
    """What the sweep of one rig in both directions shows."""

    both: Swept
    uneven: Flags
    """Whether the motion goes farther to one side than to the other."""
    free: Array
    """Half the excursion of free flight at each frequency (m)."""
    most: float
    """How far the mass goes to the right at any frequency (m)."""
    least: float
    """The lowest displacement at any frequency (m)."""


class Holds(NamedTuple):
    """Where the holds of one rig ended, forward first: what motions are followed on from."""

    frequency: Array
    """In Hz, rising."""
    period: NDArray[np.int64]
    """0 where the motion did not settle."""
    section: Array
    """`COMPONENTS` of the state at the end of each."""
    plain: Flags
    """Whether the motion was seen to be chaotic while it was held."""
    contacts: Array
    """With each stop per forcing cycle."""

    def state(self, direction: Direction, i: int) -> State:
        """The state at the end of a hold."""
        return state_of(self.section[DIRECTIONS.index(direction), i].tolist())


def each_curves(data: xr.Dataset) -> Iterator[Curves]:
    """The curves of each rig of `sweeps`, one after the other.

    Raises
    ------
    InputError
        If the dataset has one direction only.
    """
    if data.sizes["direction"] != 2:
        raise InputError(
            f"data: the sweep has only the directions {data['direction'].values.tolist()}; sweep "
            "in both directions, 'forward' and 'backward', to detect hysteresis"
        )
    most = data["displacement_max"].max(["direction", "frequency"]).values
    least = data["displacement_min"].min(["direction", "frequency"]).values
    free = 0.5 * data["free_displacement_excursion"].values
    order = ["rig", "direction", "frequency"]
    ordered = data.sel(direction=list(DIRECTIONS)).transpose(*order, ...)
    off, excursion = (ordered[name].values for name in ("eccentricity", "displacement_excursion"))
    for r, both in enumerate(each_swept(data)):
        uneven = _uneven(off[r], excursion[r])
        yield Curves(both, uneven, free[r], float(most[r]), float(least[r]))


def holds(data: xr.Dataset) -> Holds:
    """Where the holds of the sweep of one rig ended."""
    one = data.sel(direction=list(DIRECTIONS))
    section = one["section"].sel(component=list(COMPONENTS))
    return Holds(
        one["frequency"].values,
        one["period"].transpose("direction", "frequency").values,
        section.transpose("direction", "frequency", "component").values,
        np.zeros((2, one.sizes["frequency"]), dtype=bool),
        one["impacts"].transpose("direction", "frequency", "stop").values,
    )


def swept_alone(
    rig: Rig,
    frequencies: Array,
    max_cycles: int,
    window: int,
    tally: Tally,
    transient: float = PATIENT,
) -> tuple[Curves, Holds]:
    """Sweep a rig on this thread, as `sweeps` does; of no use if the tally has stopped it.

    A motion that is clearly chaotic after its transient (s) is measured at once.
    """
    ready = plan_sweep(rig, frequencies)
    settling = Settling(_TOLERANCE, max_cycles, window, _MAX_EVENTS)
    shape = (2, len(frequencies))
    hold_rows, states = np.empty((*shape, steady_response.RESULTS)), []
    for k, direction in enumerate(DIRECTIONS):
        hold_rows[k], reached = rows(ready, direction, 0.0, settling, tally, transient)
        states.append(reached)
    # One quantity after the other in memory.
    each = HoldRows(np.moveaxis(hold_rows.transpose(2, 0, 1).copy(), 0, -1))
    low, high = each.displacement_min, each.displacement_max
    excursion = high - low
    period = each.period
    touched = (each.impacts, each.peak_force)
    both = Swept(
        frequencies,
        DIRECTIONS,
        each.acceleration_excursion / ready.largest[1],
        excursion / ready.largest[0],
        period > 0,
        period,
        np.logical_or.reduce(
            [(one > 0.0).any(axis=-1) for one in touched]
        ),  # as `in_contact` of a dataset
    )
    curves = Curves(
        both,
        _uneven(0.5 * (high + low), excursion),
        0.5 * ready.free[0],
        float(np.fmax.reduce(high, axis=None)),
        float(np.fmin.reduce(low, axis=None)),
    )
    section = components(np.array(states), 0.0)
    plain = (each.status == NOT_SETTLED) & (each.cycles < max_cycles)
    return curves, Holds(frequencies, period, section, plain, each.impacts)


def _uneven(eccentricity: Array, excursion: Array) -> Flags:
    return np.abs(eccentricity) > UNEVEN * excursion
