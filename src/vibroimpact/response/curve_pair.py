"""A pair of resonance curves as plain arrays: what features are found in."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, NamedTuple, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.errors import InputError

Array: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]
Direction: TypeAlias = Literal["forward", "backward"]
DIRECTIONS: tuple[Direction, ...] = ("forward", "backward")

_FIELDS = ("eta_a", "eta_d", "motion", "period")
_CONTACT = ("impacts", "peak_force")


class Swept(NamedTuple):
    """Resonance curves of one rig; arrays have the dims direction and frequency."""

    frequency: Array
    """In Hz, rising."""
    directions: tuple[Direction, ...]
    """Forward first."""
    eta_a: Array
    eta_d: Array
    settled: Flags
    """Whether the motion became periodic."""
    period: NDArray[np.int64]
    touching: Flags
    """Whether the mass touches a bumper."""


_KINDS = ("acceleration", "displacement")


def swept(data: xr.Dataset) -> Swept:
    """Arrays of the sweep of one rig, or of measured curves.

    Of measured curves, η is taken over the largest value of their own where it was not measured:
    of excursions, or of what `judged` names. Their motions count as settled.

    Raises
    ------
    InputError
        If the dataset is not that of a sweep of one rig.
    """
    if data.attrs.get("kind") == "curves" and "motion" not in data:
        return _of_measured(data)
    (one,) = each_swept(as_rigs(data))
    return one


def judged(data: xr.Dataset, kind: str) -> str | None:
    """Name what measured curves are judged by: η, the excursion, or the one side that is known.

    Maximum and minimum together are an excursion, which is the same whichever way the sensor
    points; one of them alone misses what the mass does on the other side. It is judged alone where
    the other was not measured at all its holds.

    Returns
    -------
    str or None
        The name of a variable, which of an excursion need not be in the dataset; None if nothing
        of this kind was measured.
    """
    for name in (f"eta_{kind[0]}", f"{kind}_excursion"):
        if name in data:
            return name
    sides = {
        name: np.isfinite(data[name].values)
        for name in (f"{kind}_max", f"{kind}_min")
        if name in data
    }
    if len(sides) == 2 and np.array_equal(*sides.values()):
        return f"{kind}_excursion"
    # A side that was measured at some holds only would hide the other at the rest.
    return max(sides, key=lambda name: int(sides[name].sum()), default=None)


def _of_measured(data: xr.Dataset) -> Swept:
    """Arrays of measured curves: the mean of what was held more than once."""
    directions = directions_of(data)
    one = data.sel(direction=list(directions))
    one = one.mean("repeat") if "repeat" in one.dims else one
    curves = {}
    for kind in _KINDS:
        name = judged(one, kind)
        if name is None:
            continue
        measured = one[name] if name in one else one[f"{kind}_max"] - one[f"{kind}_min"]
        values = np.abs(measured.transpose("direction", "frequency").values)
        curves[kind[0]] = values / (1.0 if name.startswith("eta") else np.nanmax(values))
    if not curves:
        raise InputError(
            "data: the measured curves have no excursion, maximum, minimum or η; add at least one "
            "of them, such as displacement_excursion"
        )
    a, d = (curves.get(short, next(iter(curves.values()))) for short in "ad")
    return Swept(
        one["frequency"].values,
        directions,
        a,
        d,
        np.isfinite(a),
        np.ones(a.shape, dtype=np.int64),
        np.zeros(a.shape, dtype=bool),
    )


def as_rigs(data: xr.Dataset) -> xr.Dataset:
    """The sweep of one rig as one of `sweeps`.

    Raises
    ------
    InputError
        If the dataset is not that of a sweep of one rig.
    """
    if set(data.get("eta_a", xr.DataArray()).dims) != {"direction", "frequency"}:
        raise InputError(
            f"data: a dataset with the dimensions {dict(data.sizes)} is not the sweep of one "
            "rig; pass the result of sweep, or one rig of sweeps, such as data.isel(rig=0)"
        )
    return data.expand_dims("rig")


def directions_of(data: xr.Dataset) -> tuple[Direction, ...]:
    """The directions of a dataset, forward first."""
    return tuple(one for one in DIRECTIONS if one in data["direction"].values)


def each_swept(data: xr.Dataset) -> Iterator[Swept]:
    """Arrays of each rig of `sweeps`, one after the other."""
    present = [str(d) for d in data["direction"].values]
    directions = directions_of(data)
    order = [present.index(d) for d in directions]
    a, d, motion, period, contact = (
        one.transpose("rig", "direction", "frequency").values[:, order]
        for one in (*(data[name] for name in _FIELDS), in_contact(data))
    )
    frequency = data["frequency"].values
    for r in range(len(a)):
        yield Swept(
            frequency,
            directions,
            a[r],
            d[r],
            motion[r] == "periodic",
            period[r],
            contact[r],
        )


def in_contact(data: xr.Dataset) -> xr.DataArray:
    """Whether the mass touches a stop, of each hold of a dataset of a sweep.

    A stop that stays pressed, as under preload, has a force, though no contact with it begins.
    """
    is_touching, *others = ((data[name] > 0.0).any("stop") for name in _CONTACT if name in data)
    for one in others:
        is_touching = is_touching | one
    return is_touching
