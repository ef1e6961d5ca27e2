"""The full resonance diagram: every branch of orbits that sweeps and bifurcations lead to."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import section_map
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Oscillator, State
from vibroimpact.model.counts import whole
from vibroimpact.model.parameters import bounds
from vibroimpact.model.rigs import AnyShaking, as_shaking, takes_rig
from vibroimpact.response.free_flight import extremes, harmonics
from vibroimpact.response.sweep import DIRECTIONS, sweep
from vibroimpact.response.threads import Progress
from vibroimpact.stability.bifurcations import BREAKING, DOUBLING, Bifurcation, born
from vibroimpact.stability.branch import follow_both_ways
from vibroimpact.stability.family import Family, family
from vibroimpact.stability.first import first_orbit
from vibroimpact.stability.fixed_points import SEEN, Orbit, at_phase, corrected, images
from vibroimpact.stability.labelled import Followed, as_dataset

_Array = NDArray[np.float64]

_SAME = 1e-6
_CLOSE = 0.1


@takes_rig
def resonance_diagram(
    oscillator: Oscillator,
    amplitude: AnyShaking,
    low: float | str,
    high: float | str,
    *,
    phase: float = 0.0,
    longest: int = 4,
    most_branches: int = 30,
    most_points: int = 5000,
    starts: int = 40,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Follow all branches of periodic orbits over a range of frequencies.

    Branches are begun from where a forward and a backward sweep settle, free flight among them,
    and from every symmetry breaking and period doubling that is found on the way.

    Parameters
    ----------
    oscillator
        What vibrates; or a laboratory case or its code, and then the amplitude may be left out.
    amplitude
        As in `sweep`, the same at all frequencies.
    low, high
        Range of the frequency in Hz.
    phase
        Forcing phase of the sections, rad.
    longest
        Longest period, in forcing cycles, of a branch that is followed.
    most_branches, most_points
        Branches, and orbits in each direction of one, after which it is given up.
    starts
        Frequencies of the sweeps.
    progress
        Called with the branches done and those known.

    Returns
    -------
    xarray.Dataset
        As `branch`, with the number of the ``branch`` of each point. Of a mirrored pair of
        branches one is followed. The attribute ``complete`` is 0 if `most_branches` was reached.

    Raises
    ------
    InputError
        If a value cannot be used.
    """
    shaken, several = as_shaking(amplitude, "amplitude")
    if several:
        raise InputError("amplitude: a list; one amplitude for all frequencies is accepted")
    fam = family(oscillator, shaken.replace(frequency=high, phase=phase), "frequency")
    span = bounds(fam.parameter, low, high)
    longest, starts = whole(longest, "longest"), whole(starts, "starts")
    most_branches = whole(most_branches, "most_branches")
    most_points = whole(most_points, "most_points")
    followed: list[Followed] = []
    waiting: list[tuple[Orbit, Bifurcation | None]] = [
        (first, None)
        for first in itertools.chain(_free(fam, span, starts), _settled(fam, span, starts, longest))
    ]
    complete = True
    while waiting:
        first, origin = waiting.pop(0)
        if any(on_branch(first, one) for one in followed) or _used(origin, followed, span):
            continue
        if len(followed) >= most_branches:
            complete = False
            break
        done = follow_both_ways(first, span, most_points)
        followed.append(done)
        for found in done.bifurcations:
            if found.turns or found.kind not in (BREAKING, DOUBLING):
                continue
            for station in born(found):
                inside = span[0] <= station.orbit.value <= span[1]
                if station.orbit.section.period <= longest and inside:
                    waiting.append((station.orbit, found))
        if progress:
            progress(len(followed), len(followed) + len(waiting))
    if progress:  # what still waited was on branches that had been followed
        progress(len(followed), len(followed))
    data = as_dataset(followed, fam, span, "resonance_diagram")
    data.attrs["complete"] = int(complete)
    return data


def _at(fam: Family, frequency: float) -> Family:
    """The family along the frequency, made at another one."""
    return fam._replace(value=frequency, excitation=fam.excitation.replace(frequency=frequency))


def _free(fam: Family, span: tuple[float, float], starts: int) -> Iterator[Orbit]:
    """Steady free flight where it reaches no bumper: at the ends of each such range."""
    rig, shaken = fam.oscillator, fam.excitation
    if rig.isolator.initial_stiffness == 0.0 or not rig.isolator.linear:
        return  # the sweeps find what other laws do
    grid, rest = np.linspace(*span, starts), rig.force / rig.isolator.initial_stiffness
    with np.errstate(divide="ignore", invalid="ignore"):
        swings, _ = harmonics(rig, shaken, grid)
    low, high = extremes(swings) + rest
    right, left = (np.inf if stop is None else stop.gap for stop in (rig.right, rig.left))
    flies = (high < right) & (-low < left)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flies, [False]]).astype(int)))
    for i in sorted({int(k) for a, b in edges.reshape(-1, 2) for k in (a, b - 1)}):
        order = np.arange(1, swings.shape[1] + 1)
        turned = swings[i] * np.exp(1j * order * fam.phase)
        u = rest + turned.imag.sum()
        v = 2.0 * np.pi * grid[i] * (order * turned).real.sum()
        here = _at(fam, float(grid[i]))
        try:
            yield first_orbit(here, span, State(float(u), float(v), phase=fam.phase), 1)
        except InputError:
            continue  # undamped, at resonance


def _settled(fam: Family, span: tuple[float, float], starts: int, longest: int) -> Iterator[Orbit]:
    """Orbits on which forward and backward sweeps settle."""
    grid = np.linspace(*span, starts)
    grid[0], grid[-1] = span
    for direction in DIRECTIONS:
        data = sweep(fam.oscillator, fam.excitation, grid, direction, phase=fam.phase).isel(
            direction=0
        )
        # From the far end of the sweep: there free flight and the large motions are simple.
        for i in range(starts)[:: 1 if direction == "backward" else -1]:
            period = int(data["period"][i])
            if not 0 < period <= longest:
                continue
            here = _at(fam, float(grid[i]))
            try:
                yield first_orbit(here, span, data["section"].isel(frequency=i, drop=True), period)
            except InputError:
                continue  # settled to within the sweep's tolerance, but on the edge of a basin


def _used(origin: Bifurcation | None, followed: list[Followed], span: tuple[float, float]) -> bool:
    """Whether a branch that was followed has already turned in a bifurcation."""
    if origin is None:
        return False
    return any(
        other.turns
        and other.kind == origin.kind
        and abs(other.orbit.value - origin.orbit.value) <= _SAME * (span[1] - span[0])
        for one in followed
        for other in one.bifurcations
    )


def on_branch(orbit: Orbit, one: Followed) -> bool:
    """Whether an orbit lies on a branch, up to whole cycles and the mirror."""
    section = one.stations[0].orbit.section
    if section.period != orbit.section.period or section.mirror != orbit.section.mirror:
        return False
    seen_there: dict[float, list[_Array]] = {}
    scale = section.scale
    for here, there in itertools.pairwise(one.stations):
        phase = here.orbit.section.family.phase
        if here.piece != there.piece or there.orbit.section.family.phase != phase:
            continue
        low, high = sorted([here.orbit.value, there.orbit.value])
        if not low <= orbit.value <= high:
            continue
        share = (
            0.5
            if high == low
            else (orbit.value - here.orbit.value) / (there.orbit.value - here.orbit.value)
        )
        guess = here.orbit.point + share * (there.orbit.point - here.orbit.point)
        reach = _CLOSE + np.linalg.norm((there.orbit.point - here.orbit.point) / scale * SEEN)
        if phase not in seen_there:
            seen = at_phase(orbit, phase)
            mirrored = orbit.section.family.symmetric
            there_too = () if seen is None else images(seen, mirrored=mirrored)
            seen_there[phase] = [point for point, _ in there_too]
        near = [z for z in seen_there[phase] if np.linalg.norm((z - guess) / scale * SEEN) <= reach]
        if not near:
            continue
        status, found = corrected(here.orbit.section, guess, here.orbit.facts[section_map.MODE])
        if status is Status.DONE and any(
            np.linalg.norm((found.point - z) / scale * SEEN) <= _SAME for z in near
        ):
            return True
    return False
