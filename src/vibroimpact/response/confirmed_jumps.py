"""Distinguish jumps from steps of a smooth curve that the frequencies of a sweep do not resolve.

Where the directions differ there are two motions, and one of them ends. The interval of any other
step is swept again in smaller steps, from the motion before it, and so is what is still large of
them: the steps of a continuous branch shrink with their intervals, and a jump remains.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Literal, NamedTuple, TypeVar

import numpy as np
import xarray as xr

from vibroimpact.datasets.description import motion_parameters
from vibroimpact.model.read_rig import AnyRig
from vibroimpact.response.mass_jumps import MassJumps, mass_steps
from vibroimpact.response.resonance import APART, STEP, Features, Place, share_of_change
from vibroimpact.response.sweep import sweep

PARTS = 8
"""Intervals into which that of a step is divided."""
DEPTH = 3
"""How often: the last intervals are a 512th of the first."""
MOST_HOLDS = 400
"""Holds after which a step is called steep. A jump needs 24; where a branch rises as a square root
to three times its height, a few hundred show that it is smooth."""

_SETTLING = ("tolerance", "max_cycles", "window", "max_events")

Kind = Literal["jump", "steep", "smooth"]
_Jump = TypeVar("_Jump")


class _Step(NamedTuple):
    """Two neighbouring holds, in the order of the sweep."""

    share: float
    """By which they differ."""
    depth: int
    """How often the interval was divided."""
    last: xr.Dataset
    first: xr.Dataset


def confirm_jumps(rig: AnyRig, data: xr.Dataset, features: Features) -> Features:
    """Keep the jumps that are certain; move to `Features.steep` what may be a smooth step."""
    ends = set[Place]().union(*(one.jumps for one in features.hysteresis))
    kinds = [
        "jump" if one[:3] in ends else _kind(rig, data, one[:3], one.settled, [(one.by, None)])
        for one in features.jumps
    ]
    jumps, steep = _sorted(features.jumps, kinds)
    return features._replace(jumps=jumps, steep=steep)


def confirmed_mass_jumps(rig: AnyRig, data: xr.Dataset) -> MassJumps:
    """Find the jumps in a sweep of several masses, and the steps that may be smooth."""
    steps = mass_steps(data)
    kinds = [
        "jump"
        if place in steps.apart
        else _kind(rig, data, place, one.settled, steps.curves[place])
        for place, one in steps.jumps.items()
    ]
    return MassJumps(*_sorted(steps.jumps.values(), kinds))


def _sorted(
    candidates: Iterable[_Jump], kinds: Iterable[str]
) -> tuple[tuple[_Jump, ...], tuple[_Jump, ...]]:
    """Return those that are jumps, and those that are steep."""
    pairs = list(zip(candidates, kinds, strict=True))
    jumps, steep = (
        tuple(one for one, kind in pairs if kind == wanted) for wanted in ("jump", "steep")
    )
    return jumps, steep


def _kind(
    rig: AnyRig,
    data: xr.Dataset,
    place: Place,
    settled: bool,
    curves: Sequence[tuple[str, str | None]],
) -> Kind:
    """Classify the step of some curves: variables, each with its mass if there are several.

    The largest values of a motion that does not settle depend on the window, so holds between
    would decide nothing.
    """
    if not settled:
        return "steep"
    direction, before, after = place
    parameters = motion_parameters(data)
    settling = {name: parameters[name] for name in _SETTLING}
    held = data.sel(direction=direction)
    steps = [_Step(1.0, 0, held.sel(frequency=before), held.sel(frequency=after))]
    kind: Kind = "smooth"
    left = MOST_HOLDS
    while steps:
        step = steps.pop()
        if left < PARTS:
            return "steep"
        left -= PARTS
        ends = float(step.last["frequency"]), float(step.first["frequency"])
        between = np.linspace(*ends, PARTS + 1)[1:-1]
        start = step.last["section"]
        again = sweep(rig, np.sort(between), [direction], start=start, **settling)
        holds = [again.isel(direction=0).sel(frequency=at) for at in between]
        holds = [step.last, *holds, step.first]
        shares = [_largest_change(one, other, curves) for one, other in pairwise(holds)]
        for i, share in enumerate(shares):
            if share <= APART:
                continue
            if any(one["motion"].item() != "periodic" for one in holds[i : i + 2]):
                kind = "steep"
            elif step.depth + 1 < DEPTH:
                steps.append(_Step(share, step.depth + 1, holds[i], holds[i + 1]))
            elif share > STEP * max(shares[max(i - 1, 0) : i] + shares[i + 1 : i + 2]):
                return "jump"
            else:
                kind = "steep"
        steps.sort(key=lambda one: (one.depth, one.share))
    return kind


def _largest_change(
    one: xr.Dataset, other: xr.Dataset, curves: Sequence[tuple[str, str | None]]
) -> float:
    """Return by how much two holds differ in the curve in which they differ most, as a share."""

    def value(hold: xr.Dataset, name: str, mass: str | None) -> float:
        return float(hold[name] if mass is None else hold[name].sel(mass=mass))

    return max(share_of_change(value(one, *curve), value(other, *curve)) for curve in curves)
