"""Stable and unstable manifolds of saddle orbits in the plane of displacement and velocity."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.arguments import check_list
from vibroimpact.attraction.adaptive_curve import (
    CONTINUES,
    CYCLES,
    IMAGES,
    LONGEST,
    Curve,
    CurveMetric,
)
from vibroimpact.attraction.crossings import crossings
from vibroimpact.attraction.find_attractors import Search
from vibroimpact.attraction.label_states import SectionSetup
from vibroimpact.attraction.saddles import Saddle, border_saddles, given_saddle, saddle_points
from vibroimpact.attraction.section_coordinates import remembered
from vibroimpact.attraction.stable_manifold import stable_curve
from vibroimpact.attraction.state_window import read_window, window
from vibroimpact.attraction.unstable_manifold import unstable_curve
from vibroimpact.datasets.description import (
    describe,
    rig_parameters,
)
from vibroimpact.errors import InputError
from vibroimpact.model import State
from vibroimpact.model.argument_types import (
    MaxEvents,
    Period,
    PositiveInt,
    Share,
)
from vibroimpact.model.public import public
from vibroimpact.model.quantities import DIMENSIONLESS
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.model.units import to_si
from vibroimpact.response.analytic_free_response import check_bounded
from vibroimpact.tasks.executors import workers_for
from vibroimpact.tasks.progress import shown_by_default
from vibroimpact.tasks.threads import DONE, Progress, Tally, Workers, each

_IMAGES = 400
"""Largest number of images of the first piece of a curve."""
_SIDES = (("stable", 1), ("stable", -1), ("unstable", 1), ("unstable", -1))
"""The curves of a saddle."""
_PARTS = 100
"""Steps of progress of a curve."""


@public
def manifolds(
    rig: AnyRig,
    saddles: xr.Dataset | State | Sequence[xr.Dataset | State] | None = None,
    displacement: Sequence[float | str] | None = None,
    velocity: Sequence[float | str] | None = None,
    *,
    frequency: float | str | None = None,
    period: Period = 1,
    spacing: Share = 0.01,
    longest: float = 30.0,
    curve_cycles: PositiveInt = 400_000,
    max_cycles: PositiveInt = 2000,
    max_events: MaxEvents = 1000,
    threads: int | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute the stable and unstable manifolds of saddle orbits, and their crossings.

    The manifolds are curves in the stroboscopic section at the initial phase of the excitation. A
    motion that starts on a stable curve converges to the saddle orbit. The borders of basins of
    attraction are such stable curves. A motion that starts next to the saddle moves away from it
    along its unstable curve. If a stable and an unstable curve cross, the stroboscopic map has
    horseshoes, and transients look chaotic.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    saddles
        Saddle orbits, as datasets of `orbit` or as states near the orbits. Default: up to four
        saddles, which are found along the borders between basins.
    displacement, velocity
        Lowest and highest displacement (m) and velocity (m/s) of the window in which the curves are
        computed. Default: as in `basins`.
    frequency
        Forcing frequency (Hz). Default: the frequency of the rig.
    period
        Period of the saddle orbits that are passed as states, in forcing cycles.
    spacing
        Largest distance between neighbouring points of a curve. The distance is dimensionless:
        displacement and velocity are each divided by the width of their range.
    longest
        Largest length of a curve. The length is dimensionless: displacement and velocity are each
        divided by the width of their range.
    curve_cycles
        Largest number of forcing cycles that are simulated for all curves together. Each curve has
        the same share, and ends where its share is used.
    max_cycles, max_events, threads
        As in `basins`.
    progress
        A `progress_bar`, or a function that is called in the calling thread. During the search for
        saddles it gets the number of completed states (then: of places on borders) and the number
        of all. After that it gets the completed part and the total of all curves, in hundredths of
        a curve. Default: `progress_bar` on a terminal or in a notebook, if the computation takes
        more than two seconds; otherwise, nothing is shown.

    Returns
    -------
    xarray.Dataset
        The dataset has four dims:

        - ``point`` counts the points of all curves, one curve after the other. Its variables are
          ``curve_displacement``, ``curve_velocity`` and ``curve_number``. Displacement and velocity
          are NaN where a curve jumps at a rigid stop.
        - ``curve`` counts the curves. Its variables are ``curve_kind`` ("stable" or "unstable"),
          ``curve_saddle`` (the number of the saddle), ``curve_length``, and ``curve_ended`` (the
          reason why the curve ends).
        - ``saddle`` counts the points of the saddle orbits. Its variables are displacement,
          velocity, period and Floquet multipliers.
          If curves continue beyond their ends, or if not all saddles were found or used, the
          attribute ``notes`` reports it.
        - ``crossing`` counts the points at which a stable and an unstable curve cross. Its
          variables are the displacement and the velocity there, and the numbers of both curves.

    Raises
    ------
    InputError
        If a value is invalid, or if an orbit is not a saddle. Also if the state of the rig consists
        of more than displacement and velocity. This is the case for bumpers that relax slowly and
        for hysteretic isolators. It is also the case for a power-law stop with a coefficient of
        restitution, if the saddle orbit compresses the stop at the phase of the section.
    """
    rig = as_rig(rig, frequency)
    rig.check_frequency()
    check_bounded(rig)
    progress = progress or shown_by_default("manifolds")
    workers = workers_for(threads)
    longest = to_si(longest, DIMENSIONLESS, "longest", above=0.0)
    stage = SectionSetup(rig, max_events)
    *bumpers, isolator = remembered(stage)[2:]
    if isolator or any(bumpers):
        why, change = "the isolator is hysteretic", "use an isolator without hysteresis"
        if not isolator:
            why = "a bumper needs more than one cycle to relax"
            change = "raise the stiffness of the bumpers, or lower their damping or the frequency"
        raise InputError(
            f"oscillator: {why}, so the manifolds of saddles do not lie in the plane of "
            f"displacement and velocity; {change}"
        )
    search = Search(stage, max_cycles, workers)
    wide, fast = read_window(displacement, velocity, lambda: window(search, progress))
    corners = np.array([wide, fast])
    left_out: list[str] = []
    if saddles is None:
        orbits, left_out = border_saddles(search, (wide, fast), progress)
    else:
        alone = isinstance(saddles, xr.Dataset | State)
        saddle_list: list[Any] = [saddles] if alone else list(check_list(saddles, "saddles"))
        orbits = [
            given_saddle(stage, one, period, f"saddles[{i}]") for i, one in enumerate(saddle_list)
        ]
    points = [p for i, one in enumerate(orbits) for p in saddle_points(one, f"saddles[{i}]")]
    share_of_cycles = max(curve_cycles // max(len(_SIDES) * len(points), 1), 1)
    measure = CurveMetric(corners[:, 0], corners[:, 1], spacing, longest, _IMAGES, share_of_cycles)
    curves = _curves(stage, points, measure, workers, progress)
    data = _dataset(points, curves, measure)
    return describe(
        data,
        "vibroimpact.manifolds",
        {
            **rig_parameters(rig),
            "displacement": list(wide),
            "velocity": list(fast),
            "spacing": spacing,
            "longest": longest,
            "curve_cycles": curve_cycles,
        },
        [*left_out, *_continuing(curves)],
    )


def _curves(
    stage: SectionSetup,
    saddles: list[Saddle],
    measure: CurveMetric,
    workers: Workers,
    progress: Progress | None,
) -> list[list[tuple[str, Curve]]]:
    """Return both sides of the stable curve of each saddle, then both sides of the unstable one."""
    total = _PARTS * len(_SIDES) * len(saddles)

    def stable(item: tuple[Saddle, int], tally: Tally) -> Curve:
        saddle, side = item
        curve = stable_curve(saddle, side, measure, partial(_tell, tally))
        tally[DONE] = _PARTS
        return curve

    # Stable curves are long computations, which run at once; an unstable one uses all threads.
    sides = [(saddle, side) for saddle in saddles for kind, side in _SIDES if kind == "stable"]
    first = each(
        stable,
        sides,
        steps=_PARTS * len(sides),
        threads=workers,
        progress=progress and (lambda done, _: progress(done, total)),
    )
    curves: list[list[tuple[str, Curve]]] = []
    done = _PARTS * len(sides)
    for number, saddle in enumerate(saddles):
        curves.append([("stable", curve) for curve in first[2 * number : 2 * number + 2]])
        for kind, side in _SIDES:
            if kind == "stable":
                continue

            def tell(share: float, done: int = done) -> None:
                if progress:
                    progress(done + int(_PARTS * min(share, 1.0)), total)

            curve = unstable_curve(stage, saddle, side, measure, workers, tell)
            curves[-1].append((kind, curve))
            done += _PARTS
            if progress:
                progress(done, total)
    return curves


def _tell(tally: Tally, share: float) -> None:
    tally[DONE] = int(_PARTS * min(share, 1.0))


def _continuing(curves: list[list[tuple[str, Curve]]]) -> list[str]:
    """Say how many curves continue beyond their ends, and what to do."""
    every = [curve.ended for some in curves for _, curve in some]
    what = {
        LONGEST: "reach the maximum length; raise longest",
        CYCLES: "used their share of the forcing cycles; raise curve_cycles",
        IMAGES: f"were ended after {_IMAGES} images of their first piece",
    }
    return [
        f"{count} of {len(every)} curves continue beyond their ends, because they {what[ended]}"
        for ended, count in Counter(every).items()
        if ended in CONTINUES
    ]


def _dataset(
    saddles: list[Saddle], curves: list[list[tuple[str, Curve]]], measure: CurveMetric
) -> xr.Dataset:
    every = [(i, kind, one) for i, some in enumerate(curves) for kind, one in some]
    points = np.vstack([*(one.points for _, _, one in every), np.empty((0, 2))])
    met, pairs = [np.empty((0, 2))], []
    for a, (_, kind, one) in enumerate(every):
        for b, (_, other_kind, other) in enumerate(every):
            if kind == "stable" and other_kind == "unstable":
                # Where both begin, at the saddle, they meet and do not cross.
                here = crossings(one.points[1:], other.points[1:])
                met.append(here)
                pairs += [(a, b)] * len(here)
    crossed = np.vstack(met)
    both = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    numbers = np.repeat(np.arange(len(every)), [len(one.points) for _, _, one in every])
    values: dict[str, Any] = {
        "curve_number": ("point", numbers),
        "curve_displacement": ("point", points[:, 0]),
        "curve_velocity": ("point", points[:, 1]),
        "curve_kind": ("curve", np.array([kind for _, kind, _ in every], dtype=str)),
        "curve_saddle": ("curve", np.array([i for i, _, _ in every], dtype=np.int64)),
        "curve_length": ("curve", np.array([_length(one, measure) for _, _, one in every])),
        "curve_ended": ("curve", np.array([one.ended for _, _, one in every], dtype=str)),
        "saddle_displacement": ("saddle", np.array([one.point[0] for one in saddles])),
        "saddle_velocity": ("saddle", np.array([one.point[1] for one in saddles])),
        "saddle_period": (
            "saddle",
            np.array([one.orbit.section.count for one in saddles], dtype=np.int64),
        ),
        "multiplier_growing": ("saddle", np.array([one.growing for one in saddles])),
        "multiplier_dying": ("saddle", np.array([one.dying for one in saddles])),
        "crossing_displacement": ("crossing", crossed[:, 0]),
        "crossing_velocity": ("crossing", crossed[:, 1]),
        "crossing_stable": ("crossing", both[:, 0]),
        "crossing_unstable": ("crossing", both[:, 1]),
    }
    return xr.Dataset(values)


def _length(curve: Curve, measure: CurveMetric) -> float:
    steps = np.linalg.norm(measure.scaled(np.diff(curve.points, axis=0)), axis=1)
    return float(np.nansum(steps))
