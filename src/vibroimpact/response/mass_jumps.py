"""Jumps in the sweep of several masses: those of an oscillator, in the curves of each mass."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from vibroimpact.response.curve_pair import Direction, Swept, directions_of
from vibroimpact.response.resonance import Place, hysteresis, jumps_beside, share_of_change

_OF_MASSES = {"eta_a": "peak_acceleration", "eta_d": "peak_displacement"}


class MassJump(NamedTuple):
    """A sudden change of the motion between two neighbouring frequencies."""

    direction: Direction
    before: float
    """Last frequency, in the order of the sweep, on the old motion (Hz)."""
    after: float
    """First frequency on the new motion (Hz)."""
    upward: bool
    """Whether the curve that shows it most rises."""
    mass: str
    """The mass with this curve."""
    peak_displacement: tuple[float, float]
    """Of the mass, before and after (m)."""
    peak_acceleration: tuple[float, float]
    """Of the mass, before and after (m/s²)."""
    settled: bool
    """False if the motions beside it did not settle, so that a transient may look like it."""


class MassJumps(NamedTuple):
    """The jumps of a sweep of several masses."""

    jumps: tuple[MassJump, ...]
    """Those of each direction in the order of its sweep, forward first."""
    steep: tuple[MassJump, ...] = ()
    """Steps that could not be proved to be jumps."""


class MassSteps(NamedTuple):
    """What curves of several masses suggest before anything is confirmed."""

    jumps: dict[Place, MassJump]
    apart: frozenset[Place]
    """Those beside which the directions differ."""
    curves: dict[Place, list[tuple[str, str]]]
    """The curves that show each: variable and mass."""


def mass_steps(data: xr.Dataset) -> MassSteps:
    """Find what `resonance.jumps_beside` finds in the largest values of each mass."""
    directions = directions_of(data)
    swept = data.sel(direction=list(directions)).transpose("direction", "frequency", ...)
    periodic = swept["motion"].values == "periodic"
    touching = (swept["peak_force"] > 0.0).any("stop").values
    steps: dict[Place, tuple[float, MassJump]] = {}
    apart: set[Place] = set()
    curves: dict[Place, list[tuple[str, str]]] = {}
    for mass in swept["mass"].values.tolist():
        of = {curve: swept[name].sel(mass=mass).values for curve, name in _OF_MASSES.items()}
        a, d = (one / (np.nanmax(one, initial=0.0) or 1.0) for one in of.values())
        frequency = swept["frequency"].values
        both = Swept(frequency, directions, a, d, periodic, swept["period"].values, touching)
        loops = hysteresis(both)
        ends = set[Place]().union(*(one.jumps for one in loops))
        for jump in jumps_beside(loops, both):
            place = jump[:3]
            k = directions.index(jump.direction)
            at = frequency.searchsorted(place[1:])
            values = {curve: (float(y[k, at[0]]), float(y[k, at[1]])) for curve, y in of.items()}
            if place in ends:
                apart.add(place)
                by = max(values, key=lambda curve: share_of_change(*values[curve]))
            else:
                by = jump.by
            curves.setdefault(place, []).append((_OF_MASSES[by], mass))
            change = share_of_change(*values[by])
            if place not in steps or steps[place][0] < change:
                steps[place] = (
                    change,
                    MassJump(
                        *place,
                        values[by][1] > values[by][0],
                        mass,
                        values["eta_d"],
                        values["eta_a"],
                        jump.settled,
                    ),
                )
    sign = {"forward": 1.0, "backward": -1.0}
    order = sorted(steps, key=lambda place: (place[0] != "forward", sign[place[0]] * place[1]))
    return MassSteps({place: steps[place][1] for place in order}, frozenset(apart), curves)
