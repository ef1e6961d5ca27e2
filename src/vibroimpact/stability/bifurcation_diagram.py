"""Bifurcation diagrams by simulation ("brute force"): the steady motions over any parameter."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Annotated, Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.arguments import (
    MOST_LISTED,
    STARTS,
    check_list,
    check_mapping,
    check_name,
)
from vibroimpact.datasets.description import (
    describe,
    excitation_parameters,
    system_parameters,
)
from vibroimpact.datasets.stops import part_names, stop_names
from vibroimpact.engine import batch, lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, shown
from vibroimpact.model import Rig, State
from vibroimpact.model.argument_types import (
    MaxEvents,
    NonNegativeInt,
    PositiveInt,
    RandomStarts,
    Share,
    whole,
)
from vibroimpact.model.parameter_ranges import Ranges, read_ranges
from vibroimpact.model.periodic_shaking import as_periodic
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyRig, as_rig_of_any_masses, from_lowest
from vibroimpact.model.system import System
from vibroimpact.response.engine_system import EngineSystem, engine_rig, engine_system
from vibroimpact.response.hold_rows import Settling
from vibroimpact.response.outputs import Outputs, about, add_outputs, read_outputs
from vibroimpact.stability.diagram_point import Kind, SectionRecording, Seen, look_at, point_width
from vibroimpact.stability.parameter_sweep import random_states, rigs_along, stepped
from vibroimpact.tasks.executors import THREADS, workers_for
from vibroimpact.tasks.threads import Progress, Tally, each

_Array = NDArray[np.float64]

CREATED_BY = "vibroimpact.bifurcation_diagram"
DIRECTIONS = ("up", "down")
_BLOCK = 32
"""Number of values per task, if motions are not continued to the next value."""


@public
def bifurcation_diagram(
    rig: AnyRig,
    vary: Ranges,
    steps: Annotated[int, partial(whole, least=2, most=MOST_LISTED)] = 200,
    *,
    frequency: float | str | None = None,
    directions: Sequence[str] = DIRECTIONS,
    starts: Mapping[str, State | xr.DataArray | xr.Dataset] | None = None,
    random: RandomStarts = 0,
    seed: NonNegativeInt = 0,
    section: Kind = "stroboscopic",
    log: bool = False,
    points: PositiveInt = 200,
    exponent_cycles: PositiveInt = 1000,
    tolerance: Share = 1e-12,
    max_cycles: PositiveInt = 2000,
    max_events: MaxEvents = 10_000,
    outputs: Outputs | None = None,
    threads: int | None = None,
    where: Any = THREADS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute a bifurcation diagram: the steady motions at a series of values of a parameter.

    The diagram shows only attractors (periodic or not) to which the initial states lead. To also
    follow unstable orbits, use `branch`.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    vary
        Parameter that is varied, and its lowest and highest value, as in `branch`.
    steps
        Number of values of the parameter, including both ends.
    frequency
        Forcing frequency (Hz), if another parameter is varied. Default: the frequency of the rig.
    directions
        Directions along the values: ``"up"``, ``"down"`` or both. The motion at the first value
        starts from rest. The motion at each other value starts from the final state at the previous
        value.
    starts
        Further initial states, by name. From each of them a motion is started at every value.
    random
        Number of random initial states from which further motions start. The same states are used
        at every value. Their displacements are at most D, which is 1.5 times the largest
        displacement of all motions that do not start from random states, or 1.5 times the widest
        gap, whichever is larger. Their velocities are at most D times the angular forcing
        frequency. If the frequency is varied, the median of its values is used.
    seed
        Seed of the random initial states. The same seed gives the same initial states.
    section
        Poincaré section: ``"stroboscopic"``, once per forcing cycle; or ``"impacts"``, at the start
        of each contact.
    log
        Whether the values are evenly spaced on a logarithmic axis.
    points
        Number of forcing cycles whose section points are stored, if a motion does not become
        periodic.
    exponent_cycles
        Number of forcing cycles over which the growth of disturbances is averaged, if a motion does
        not become periodic. Up to 20 times as many are simulated while a quasi-periodic and a
        weakly chaotic motion cannot be distinguished.
    tolerance, max_cycles, max_events
        As in `sweeps`.
    outputs
        Own outputs, as in `sweeps`, of each motion: over one period, or over ``points`` cycles of a
        motion that did not become periodic.
    threads
        Number of threads (default: one per processor).
    where
        ``"threads"``, ``"processes"``, or a dask cluster: a ``distributed.Client`` or the address
        of its scheduler (docs/how-to/many-machines.md). Neither ``where`` nor ``threads`` affects
        the result.
    progress
        A `progress_bar`, or a function that is called in the calling thread with the completed and
        the total number of motions.

    Returns
    -------
    xarray.Dataset
        The dims are ``start`` (the direction or the initial state), the parameter, and
        ``section_point``. A stroboscopic section has the variables ``section_displacement``,
        ``section_velocity`` and the deformations of the bumpers. A section at impacts has the
        variables ``contact_stop``, ``contact_start_phase`` and ``contact_start_velocity``. If a
        motion is periodic, the section has the points of one period, and the other entries are NaN.

        ``motion`` and ``period`` describe the type of each motion. ``exponents`` (1/s) are its two
        largest Lyapunov exponents, with ``exponents_uncertainty``. Extremes and forces are the same
        as in `sweep`; the ``outputs`` have their names. ``section`` is the final state of each
        motion. You can pass it to `branch` as the start.

        Of an assembly, the sizes have the dims ``mass`` and ``stop`` as in `sweep`, and
        ``section_displacement``, ``section_velocity`` and ``section_deformation`` have the last dim
        ``mass`` or ``stop``.

    Raises
    ------
    InputError
        If a value is invalid.
    """
    rig = as_rig_of_any_masses(rig, frequency=frequency)
    system = rig.system
    engine_system(system).check_size()
    if system.by_mass and section != "stroboscopic":
        raise InputError(f"section: {shown(section)}; for an Assembly, use 'stroboscopic'")
    (along,) = read_ranges(vary, rig)
    rig, varied, ends = from_lowest(rig, along), along.parameter, along.ends
    excitation = as_periodic(rig.harmonic, "shaking")[0]
    if log and ends[0] <= 0.0:
        raise InputError(
            f"{along.field}[0]: {ends[0]:g} is not possible on a logarithmic axis; pass a value "
            "above 0, or use a linear axis"
        )
    values: _Array = np.geomspace(*ends, steps) if log else np.linspace(*ends, steps)
    values[0], values[-1] = ends
    settling = Settling(tolerance, max_cycles, points, max_events)
    look = SectionRecording(section, points, exponent_cycles, max_events)
    workers = workers_for(threads, where)
    own = () if outputs is None else read_outputs(outputs, rig)
    ways = _ways(directions, starts, random, system)
    every = rigs_along(varied, rig, values)
    vectors = [engine_rig(one) for one in every]
    for entry in (batch.sweep, lyapunov.growth, lyapunov.monodromy):
        entry.prepare(*vectors)

    def seen(item: tuple[list[Rig], _Part], tally: Tally) -> list[Seen]:
        mine, part = item
        motions: list[Seen] = []
        order = slice(None, None, -1 if part.down else 1)
        stepped(
            mine[order],
            part.start,
            settling,
            lambda held: motions.append(look_at(held, look, own)),
            tally,
            carry=part.start is None,
        )
        return motions[order]

    def done(parts: list[_Part], before: int) -> dict[str, list[Seen]]:
        report = progress and (lambda ready, _: progress(before + ready, total))
        items = [(every[part.values], part) for part in parts]
        held = sum(len(mine) for mine, _ in items)
        lists = each(seen, items, steps=held, threads=workers, progress=report)
        motions: dict[str, list[Seen]] = {part.name: [] for part in parts}
        for part, one in zip(parts, lists, strict=True):
            motions[part.name] += one
        return motions

    total = steps * (len(ways) + random)
    motions = done(_parts(ways, steps), 0)
    if random:
        met = [one.held for seen in motions.values() for one in seen]
        states = random_states(met, every, random, seed)
        drawn = {f"random {i}": state for i, state in enumerate(states, start=1)}
        motions |= done(_parts(drawn, steps), steps * len(ways))
    about_motions = {
        **system_parameters(system),
        **excitation_parameters(excitation),
        "parameter": varied.name,
        "low": ends[0],
        "high": ends[1],
        "seed": seed,
        **settling._asdict(),
        **look._asdict(),
        **about(own),
    }
    data, notes = _dataset(system, varied.name, values, motions, section, excitation.phase)
    numbers = [one.outputs for some in motions.values() for one in some]
    add_outputs(data, own, np.reshape(numbers, (*data["period"].shape, len(own))))
    data.attrs["parameter"] = varied.name
    return describe(data, CREATED_BY, about_motions, notes, varied=[varied, *own])


class _Part(NamedTuple):
    """Values that one task computes in sequence."""

    name: str
    start: _Array | None
    """Initial state of every value; None if each value starts from the previous one."""
    values: slice
    down: bool = False


def _ways(
    directions: Sequence[str], starts: Mapping[str, Any] | None, random: int, system: System
) -> dict[str, _Array | None]:
    """Return the initial states: None for directions, in which motions are continued."""
    direction_names = (
        (directions,) if isinstance(directions, str) else check_list(directions, "directions")
    )
    for direction in direction_names:
        check_name(direction, DIRECTIONS, "directions")
    named = check_mapping({} if starts is None else starts, "starts", STARTS)
    for name in named:
        if name in DIRECTIONS:
            raise InputError(f"starts: {name!r} is the name of a direction; use another name")
    if not (direction_names or named or random):
        raise InputError(
            "directions: neither a direction nor a start is given; pass at least one direction, "
            "such as 'up', or a start"
        )
    states = engine_system(system)
    ways: dict[str, _Array | None] = dict.fromkeys(direction_names)
    return ways | {str(name): states.vector_of(states.read(one)) for name, one in named.items()}


def _parts(ways: Mapping[str, _Array | None], count: int) -> list[_Part]:
    """Split the values into tasks: one per direction, and blocks for each initial state."""
    blocks = [slice(i, i + _BLOCK) for i in range(0, count, _BLOCK)]
    return [
        _Part(name, start, values, down=start is None and name == "down")
        for name, start in ways.items()
        for values in (blocks if start is not None else [slice(None)])
    ]


def _dataset(
    system: System,
    name: str,
    values: _Array,
    motions: Mapping[str, list[Seen]],
    section: Kind,
    phase: float,
) -> tuple[xr.Dataset, list[str]]:
    """Return a dataset with names, and what was doubted of it.

    The points of each value are padded with NaN.
    """
    states = engine_system(system)
    seen = list(itertools.chain.from_iterable(motions.values()))
    shape, dims = (len(motions), len(values)), ("start", name)
    most = max((len(one.points) for one in seen), default=0)
    width = point_width(section, states)
    padded: _Array = np.full((len(seen), most, width), np.nan)
    for row, one in zip(padded, seen, strict=True):
        row[: len(one.points)] = one.points
    padded = padded.reshape(*shape, most, width)
    measured = np.array([one.held.measured.array for one in seen])
    measured[[one.status not in (Status.DONE, Status.NOT_SETTLED) for one in seen]] = np.nan
    measured = measured.reshape(*shape, -1)
    frequency = np.array([[one.held.motion.excitation.frequency] for one in seen])
    scalars = {
        "motion": np.array([one.kind.motion for one in seen]),
        "period": np.array([one.kind.period for one in seen], dtype=np.int64),
        "cycles": np.array([one.held.motion.cycles for one in seen], dtype=np.int64),
        "status": np.array([int(one.status) for one in seen], dtype=np.int64),
    }
    rates = {
        "exponents": frequency * np.array([one.kind.exponents[:2] for one in seen]),
        "exponents_uncertainty": frequency * np.array([one.kind.uncertainty[:2] for one in seen]),
    }
    ends = states.components(np.array([one.held.motion.state for one in seen]), phase)
    variables: dict[str, Any] = {
        **states.measured(measured, dims),
        **{key: (dims, value.reshape(shape)) for key, value in scalars.items()},
        **{key: ((*dims, "exponent"), v.reshape(*shape, 2)) for key, v in rates.items()},
        **_points(states, padded, section, (*dims, "section_point")),
        "section": ((*dims, "component"), ends.reshape(*shape, -1)),
    }
    coordinates = {
        "start": list(motions),
        name: values,
        "component": states.names,
        **part_names(system, "mass", "stop"),
    }
    return xr.Dataset(variables, coordinates), states.doubts_of_rows(measured, "motions")


def _points(
    states: EngineSystem, points: _Array, section: Kind, dims: tuple[str, ...]
) -> dict[str, Any]:
    """Return the points of a section as variables; of those that are padded nothing is known."""
    if section == "stroboscopic":
        return states.section_variables(points, dims)
    stop, phase, velocity = np.moveaxis(points, -1, 0)
    return {
        "contact_stop": (dims, np.where(np.isnan(stop), "", stop_names(stop))),
        "contact_start_phase": (dims, phase),
        "contact_start_velocity": (dims, velocity),
    }
