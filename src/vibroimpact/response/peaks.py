"""Peaks of a pair of resonance curves: the primary resonance and the secondary ones."""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

import numpy as np
import xarray as xr

from vibroimpact.response.swept import Array, Direction, Swept, swept

PROMINENCE = 0.02
"""Least prominence of a peak, as a share of its height.

Smaller ripples would be lost in any measurement, and unsettled motions make them by chance.
"""

PRIMARY_HEIGHT = 0.5
"""Least height of the primary resonance, as a share of the curve's maximum."""

Curve: TypeAlias = Literal["eta_a", "eta_d"]

CURVES: tuple[Curve, ...] = ("eta_a", "eta_d")


class Peak(NamedTuple):
    """A local maximum of one curve, or its end where the curve is highest."""

    direction: Direction
    curve: Curve
    frequency: float
    """In Hz, one of those held."""
    value: float
    prominence: float
    """Height above the higher one of the valleys that part it from higher ground."""
    primary: bool
    """The primary resonance: the peak at the highest frequency that has at least
    `PRIMARY_HEIGHT` of the curve's maximum and a period of one forcing cycle. A secondary
    resonance of the backward sweep can be higher than what is left of the primary one, but
    it lies below it."""
    at_end: bool
    """The curve still rises at the end of the range: the resonance lies beyond it."""


def peaks(data: xr.Dataset | Swept, *, prominence: float = PROMINENCE) -> tuple[Peak, ...]:
    """Find the maxima of η_a and η_d of each direction, by frequency.

    Parameters
    ----------
    data
        Dataset of a sweep.
    prominence
        See `PROMINENCE`.

    Returns
    -------
    tuple of Peak
        The highest point of each curve is always among them.

    Raises
    ------
    InputError
        If the dataset is not that of a sweep of one rig.
    """
    both = data if isinstance(data, Swept) else swept(data)
    found: list[Peak] = []
    for k, direction in enumerate(both.directions):
        for name in CURVES:
            curve: Array = getattr(both, name)[k]
            known = np.flatnonzero(np.isfinite(curve))
            if not len(known):
                continue
            y = curve[known]
            top = int(np.argmax(y))
            places = [i for i in _summits(y) if i == top or _prominence(y, i) > prominence * y[i]]
            if top not in places:  # at an end of the range
                places = sorted([*places, top])
            period = both.period[k][known]
            primary = max(
                (i for i in places if y[i] >= PRIMARY_HEIGHT * y[top] and period[i] <= 1),
                default=top,
            )
            frequency = both.frequency[known]
            found += [
                Peak(
                    direction,
                    name,
                    float(frequency[i]),
                    float(y[i]),
                    float(_prominence(y, i)),
                    i == primary,
                    i in (0, len(y) - 1),
                )
                for i in places
            ]
    return tuple(found)


def _summits(y: Array) -> list[int]:
    """Interior local maxima; of a plateau, its first point."""
    change = np.flatnonzero(np.diff(y) != 0.0)
    rises = np.diff(y)[change] > 0.0
    return [int(change[k]) + 1 for k in np.flatnonzero(rises[:-1] & ~rises[1:])]


def _prominence(y: Array, i: int) -> float:
    """Height of y[i] above the higher one of the valleys beside it; an end has one valley."""
    valleys = []
    for side in (y[i::-1], y[i:]):
        higher = np.flatnonzero(side > y[i])
        stretch = side[: higher[0]] if len(higher) else side
        if len(stretch) > 1:
            valleys.append(float(stretch.min()))
    return float(y[i]) - max(valleys, default=float(y[i]))
