"""Basin stability: the share of random initial states that lead to each steady motion."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from typing import Annotated, Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.attraction.attractor_variables import POINTS, ranked
from vibroimpact.attraction.attractors import Attractor
from vibroimpact.attraction.basin_fractions import interval
from vibroimpact.attraction.find_attractors import Search
from vibroimpact.attraction.label_states import SectionSetup
from vibroimpact.attraction.match_attractors import matched
from vibroimpact.attraction.state_window import Window, read_window, walls, window
from vibroimpact.datasets.description import describe, rig_parameters
from vibroimpact.errors import InputError
from vibroimpact.model.argument_types import (
    MaxEvents,
    NonNegativeInt,
    PositiveInt,
    whole,
)
from vibroimpact.model.parameter_ranges import Values, read_values
from vibroimpact.model.parameters import Parameter, parameter
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.response.analytic_free_response import check_bounded
from vibroimpact.tasks.executors import THREADS, workers_for
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]

MOST_STATES = 10_000_000
"""States that are drawn."""
MOST_VALUES = 100_000
"""Values of the parameter that is varied."""

_SIZES = ("displacement_excursion", "acceleration_excursion", "eccentricity")


class _ReachedMotions(NamedTuple):
    """Motions that random states lead to, at one value of the parameter."""

    known: list[Attractor]
    counts: NDArray[np.int64]
    given_up: int


@public
def basin_stability(
    rig: AnyRig,
    displacement: Sequence[float | str] | None = None,
    velocity: Sequence[float | str] | None = None,
    *,
    frequency: float | str | None = None,
    vary: Values | None = None,
    states: Annotated[int, partial(whole, most=MOST_STATES)] = 1000,
    seed: NonNegativeInt = 0,
    max_cycles: PositiveInt = 2000,
    max_events: MaxEvents = 10_000,
    threads: int | None = None,
    where: Any = THREADS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Estimate the probability that a random initial state leads to each steady motion.

    This probability is called the basin stability of the motion (P. J. Menck et al., Nature Physics
    9, 89, 2013). It is estimated as the share of the random states that lead to the motion. Initial
    displacements and velocities are drawn from uniform distributions. In every initial state the
    bumpers are relaxed, and the excitation has its initial phase.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    displacement, velocity
        Lowest and highest initial displacement (m) and velocity (m/s). Default: a range around all
        steady motions at all values of the parameter, chosen as in `basins`.
    frequency
        Forcing frequency (Hz). Default: the frequency of the rig.
    vary
        Parameter that is varied, and the values that it takes, such as
        ``{"gap": [5e-3, 6e-3]}``. Parameters are named as in `branch`. A motion keeps its number at
        the next value of the parameter if, at that value, its states lead to a nearby motion.
        Default: no parameter is varied.
    states
        Number of random initial states. The same states are used at each value of the parameter.
    seed
        Seed of the random initial states. The same seed gives the same states.
    max_cycles, max_events, threads, where
        As in `basins`.
    progress
        A `progress_bar`, or a function that is called in the calling thread with the completed and
        the total number of values.

    Returns
    -------
    xarray.Dataset
        The dim ``attractor`` counts the steady motions. If a parameter is varied, there is also a
        dim with the name of the parameter. For each motion the dataset contains:

        - ``share``, the share of the states that lead to it, with the 95% interval from
          ``share_low`` to ``share_high``;
        - ``states``, the number of these states;
        - ``motion``, its type ("" where the motion does not exist), and ``period``;
        - its extremes and excursions.

        ``given_up`` is the number of states whose computation was stopped before their motion was
        identified.

    Raises
    ------
    InputError
        If a value is invalid, or if the rig has no dissipation.
    """
    rig = as_rig(rig, frequency)
    axes = read_values(vary, rig, most=1, longest=MOST_VALUES)
    varied = parameter(axes[0].name, rig) if axes else None
    values = axes[0].values.tolist() if axes else [0.0]
    if rig.frequency is None and varied and varied.name == "frequency":
        rig = rig.at(values[0])
    rig.check_frequency()
    workers = workers_for(threads, where)
    searches = []
    for value in values:
        here = varied.vary(rig, value) if varied else rig
        check_bounded(here)
        searches.append(Search(SectionSetup(here, max_events), max_cycles, workers))

    def around_all() -> Window:
        every = [window(search) for search in searches]
        return _around(w[0] for w in every), _around(w[1] for w in every)

    ranges = wide, fast = read_window(displacement, velocity, around_all)
    reached_motions: list[_ReachedMotions] = []
    numbers: list[list[int]] = []
    for i, search in enumerate(searches):
        points = _drawn(search.stage, ranges, states, seed)
        before = reached_motions[-1].known if reached_motions else []
        leads = search.label(_seeds(before)).owner
        labels = search.label(points)
        order = [
            n
            for n in ranked([a.motion for a in search.known])
            if (labels.owner == n).any() or (leads == n).any()
        ]
        known = [search.known[n] for n in order]
        places = [_places(one, ranges) for one in known]
        going = {
            number: order.index(int(leads[k]))
            for k, number in enumerate(numbers[-1] if numbers else [])
            if leads[k] >= 0
        }
        former = dict(
            zip(numbers[-1] if numbers else [], [_places(a, ranges) for a in before], strict=True)
        )
        free = 1 + max((n for some in numbers for n in some), default=-1)
        numbers.append(matched(former, places, going, free))
        counts = np.array([(labels.owner == n).sum() for n in order], dtype=np.int64)
        reached_motions.append(_ReachedMotions(known, counts, int((labels.owner < 0).sum())))
        if progress is not None:
            progress(i + 1, len(searches))
    data = _dataset(reached_motions, numbers, states, varied, values)
    return describe(
        data,
        "vibroimpact.basin_stability",
        {
            **rig_parameters(rig),
            "displacement": list(wide),
            "velocity": list(fast),
            "parameter": varied.name if varied else None,
            "states": states,
            "seed": seed,
            "max_cycles": max_cycles,
        },
        varied=[varied] if varied else [],
    )


def _around(ranges: Iterable[tuple[float, float]]) -> tuple[float, float]:
    every = list(ranges)
    return min(low for low, _ in every), max(high for _, high in every)


def _drawn(stage: SectionSetup, ranges: Window, count: int, seed: int) -> _Array:
    """Draw random states in the part of the window that the mass can reach."""
    low, high = walls(stage)
    begin, end = max(ranges[0][0], low), min(ranges[0][1], high)
    if not begin < end:
        right = ranges[0][1] > low
        side, stop = ("right", high) if right else ("left", low)
        needed = "a lower end to the left" if right else "an upper end to the right"
        raise InputError(
            f"displacement: {ranges[0][0]:g} to {ranges[0][1]:g} m lies beyond the rigid {side} "
            f"stop at {stop:g} m; choose {needed} of this stop"
        )
    share = np.random.default_rng(seed).random((count, 2))
    points = np.zeros((count, 5))
    points[:, 0] = begin + share[:, 0] * (end - begin)
    points[:, 1] = ranges[1][0] + share[:, 1] * (ranges[1][1] - ranges[1][0])
    return points


def _seeds(known: list[Attractor]) -> _Array:
    """Return one state of each motion."""
    return np.array([one.points[0] for one in known]).reshape(-1, 5)


def _places(one: Attractor, ranges: Window) -> _Array:
    """Return the points of a motion at the section, scaled by the sides of the window."""
    points: _Array = one.points[:POINTS, :2] / np.ptp(np.array(ranges), axis=1)
    return points


def _dataset(
    reached_motions: list[_ReachedMotions],
    numbers: list[list[int]],
    drawn: int,
    varied: Parameter | None,
    values: list[float],
) -> xr.Dataset:
    total = 1 + max((n for some in numbers for n in some), default=-1)
    shape = (len(reached_motions), total)
    counts = np.zeros(shape, dtype=np.int64)
    motion = np.full(shape, "", dtype="<U14")
    period = np.zeros(shape, dtype=np.int64)
    sizes = {name: np.full(shape, np.nan) for name in _SIZES}
    for i, (one, names) in enumerate(zip(reached_motions, numbers, strict=True)):
        for known, count, number in zip(one.known, one.counts, names, strict=True):
            counts[i, number] = count
            motion[i, number] = str(known.motion["motion"].values)
            period[i, number] = int(known.motion["period"])
            for name in _SIZES:
                sizes[name][i, number] = float(known.motion[name])
    low, high = interval(counts, drawn)
    dims = (varied.name if varied else "value", "attractor")
    data = xr.Dataset(
        {
            "share": (dims, counts / drawn),
            "share_low": (dims, low),
            "share_high": (dims, high),
            "states": (dims, counts),
            "motion": (dims, motion),
            "period": (dims, period),
            **{name: (dims, values_) for name, values_ in sizes.items()},
            "given_up": (
                dims[0],
                np.array([one.given_up for one in reached_motions], dtype=np.int64),
            ),
        },
        {"attractor": np.arange(total)},
    )
    return data.assign_coords({varied.name: values}) if varied else data.isel(value=0)
