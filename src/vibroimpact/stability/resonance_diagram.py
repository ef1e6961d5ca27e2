"""Full resonance diagrams: all branches of periodic orbits that sweeps and bifurcations lead to."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from functools import partial
from typing import Annotated

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.arguments import check_list
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, shown
from vibroimpact.model.argument_types import (
    MOST_STARTS,
    NonNegativeInt,
    Period,
    PositiveInt,
    RandomStarts,
    whole,
)
from vibroimpact.model.parameter_ranges import Ranges, read_ranges
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.response.outputs import Outputs, read_outputs
from vibroimpact.stability.bifurcations import BREAKING, DOUBLING, Bifurcation, bifurcating_orbits
from vibroimpact.stability.branch import follow_both_ways
from vibroimpact.stability.branch_dataset import BranchRecord, as_dataset
from vibroimpact.stability.fixed_points import Orbit, at_phase, corrected, images
from vibroimpact.stability.parameter_family import family
from vibroimpact.stability.starting_orbits import free, in_basins, settled, values
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]

_SAME = 1e-6
_CLOSE = 0.1


@public
def resonance_diagram(
    rig: AnyRig,
    vary: Ranges,
    *,
    frequency: float | str | None = None,
    phase: float = 0.0,
    longest: Period = 4,
    most_branches: PositiveInt = 30,
    most_points: PositiveInt = 5000,
    starts: Annotated[int, partial(whole, most=MOST_STARTS)] = 40,
    random: RandomStarts = 8,
    seed: NonNegativeInt = 0,
    basins: xr.Dataset | Sequence[xr.Dataset] = (),
    outputs: Outputs | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute all branches of periodic orbits over a range of the frequency or another parameter.

    Branches start from the steady motions of sweeps up and down the range, from the motion without
    contact, and from each symmetry breaking and each period doubling on these branches. A branch
    that is not connected to any of these is called isolated. ``random`` initial states find an
    isolated branch if some of its orbits are stable. Datasets of basins of attraction (``basins``)
    find it more reliably, even if its basins are small.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    vary
        Parameter that is varied, and its lowest and highest value, as in `branch`.
    frequency
        Forcing frequency (Hz), if another parameter is varied. Default: the frequency of the rig.
    phase
        Phase of the forcing at the stroboscopic section (rad).
    longest
        Longest period of the orbits, in forcing cycles.
    most_branches, most_points
        Largest number of branches, and largest number of orbits in each direction along a branch.
    starts
        Number of starting values of the parameter: values at which motions are simulated to find
        branches.
    random
        Number of random initial states at each starting value of the parameter, that is, at each
        value at which simulations search for branches. By default, there are 40 starting values.
        The random states help to find isolated branches that have stable orbits.
    seed
        Seed of the random initial states. The same seed gives the same initial states.
    basins
        Datasets of `basins` at some values of the parameter. Their steady motions are continued as
        well. Default: none.
    outputs
        Own outputs, as in `sweeps`, of one period of each orbit and of each bifurcation.
    progress
        A `progress_bar`, or a function that is called at each point with the number of completed
        branches and the number of branches that are known so far.

    Returns
    -------
    xarray.Dataset
        As in `branch`. ``branch`` is the number of the branch to which each point belongs. If two
        branches are mirror images of each other, only one of them is computed. The attribute
        ``complete`` is 0 if ``most_branches`` was reached.

    Raises
    ------
    InputError
        If a value is invalid.
    """
    rig = as_rig(rig, frequency)
    (along,) = read_ranges(vary, rig)
    if along.parameter.name == "frequency":
        if frequency is not None:
            raise InputError(
                f"frequency: {shown(frequency)}, but the frequency is the varied parameter; remove "
                "frequency, or vary another parameter"
            )
        rig = rig.at(along.high)
    shaken = rig.with_parts(rig.oscillator, rig.harmonic.replace(phase=phase))
    fam, ends = family(shaken, along.parameter.name), along.ends
    own = read_outputs(outputs, rig)
    datasets = [basins] if isinstance(basins, xr.Dataset) else check_list(basins, "basins")
    begin = values(fam, ends, starts)
    followed: list[BranchRecord] = []
    waiting: list[tuple[Orbit, Bifurcation | None]] = [
        (first, None)
        for first in itertools.chain(
            free(begin),
            settled(begin, longest, random, seed),
            in_basins(fam, ends, datasets, longest),
        )
    ]
    complete = True
    while waiting:
        first, origin = waiting.pop(0)
        if any(on_branch(first, one) for one in followed) or _used(origin, followed, ends):
            continue
        if len(followed) >= most_branches:
            complete = False
            break
        # Called at each point as well: a branch may take minutes.
        point = progress and (lambda *_: progress(len(followed), len(followed) + 1 + len(waiting)))
        done = follow_both_ways(first, ends, most_points, point)
        followed.append(done)
        for bifurcation in done.bifurcations:
            if bifurcation.turns or bifurcation.kind not in (BREAKING, DOUBLING):
                continue
            for station in bifurcating_orbits(bifurcation):
                inside = ends[0] <= station.orbit.value <= ends[1]
                if station.orbit.section.count <= longest and inside:
                    waiting.append((station.orbit, bifurcation))
        if progress:
            progress(len(followed), len(followed) + len(waiting))
    if progress:  # what still waited was on branches that had been followed
        progress(len(followed), len(followed))
    if not followed:
        between = f"{ends[0]:g} and {ends[1]:g} {fam.parameter.units}"
        raise InputError(
            f"{along.field}: no periodic orbit was found between {between}; widen this range, or "
            "pass a larger number of starts"
        )
    data = as_dataset(followed, fam, ends, "resonance_diagram", own)
    data.attrs["complete"] = int(complete)
    return data


def _used(
    origin: Bifurcation | None, followed: list[BranchRecord], span: tuple[float, float]
) -> bool:
    """Return whether a computed branch has already turned in a bifurcation."""
    if origin is None:
        return False
    return any(
        other.turns
        and other.kind == origin.kind
        and abs(other.orbit.value - origin.orbit.value) <= _SAME * (span[1] - span[0])
        for one in followed
        for other in one.bifurcations
    )


def on_branch(orbit: Orbit, one: BranchRecord) -> bool:
    """Return whether an orbit lies on a branch, up to whole cycles and its mirror image."""
    section = one.stations[0].orbit.section
    if section.count != orbit.section.count or section.mirror != orbit.section.mirror:
        return False
    seen_there: dict[float, list[_Array]] = {}
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
        reach = _CLOSE + np.linalg.norm(section.scaled(there.orbit.point - here.orbit.point))
        if phase not in seen_there:
            seen = at_phase(orbit, phase)
            mirrored = orbit.section.family.symmetric
            there_too = () if seen is None else images(seen, mirrored=mirrored)
            seen_there[phase] = [point for point, _ in there_too]
        near = [z for z in seen_there[phase] if np.linalg.norm(section.scaled(z - guess)) <= reach]
        if not near:
            continue
        status, branch_orbit = corrected(here.orbit.section, guess, here.orbit.mode)
        if status is Status.DONE and any(
            np.linalg.norm(section.scaled(branch_orbit.point - z)) <= _SAME for z in near
        ):
            return True
    return False
