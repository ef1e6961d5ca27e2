"""Scenarios over two parameters, computed block by block."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.arguments import check_progress
from vibroimpact.datasets.description import rig_parameters
from vibroimpact.errors import InputError
from vibroimpact.grids.refinement import UNKNOWN, Nodes, Scenarios
from vibroimpact.model import from_dimensionless
from vibroimpact.model.count_checks import share, whole
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.scenarios.axes import Axis, Base, axis, check_pair, one_sine
from vibroimpact.scenarios.map_node import RIG, classified
from vibroimpact.scenarios.map_store import MapStore, map_store
from vibroimpact.scenarios.sweep_frequencies import STEP
from vibroimpact.scenarios.thresholds import Thresholds, checked
from vibroimpact.tasks.executors import PROCESSES, THREADS, placed
from vibroimpact.tasks.processes import may_start
from vibroimpact.tasks.threads import Progress, Tally, Workers, breadth, each

DAMPING_RATIO, RELAXATION_TIME = 0.15, 0.01
"""ξ and τ of the published rig (the paper's Section 7)."""
MOST_REFINED = 8
"""Levels of refinement: nodes 256 times as dense as those of the first grid."""
_FEW = 10
"""Rigs that a thread sweeps at a time, at most."""
_LAST = 3
"""By how much smaller the last tasks of a block are."""
_MANY = 500
"""Nodes of the first grid for which it pays to start processes: a third of what a rig takes is
Python's, which threads do in turn."""


MOST_NODES = 4_000_000
"""Nodes of the finest grid."""


def scenario_map(
    rig: AnyRig | None,
    x: tuple[Any, ...],
    y: tuple[Any, ...],
    *,
    step: float = STEP,
    refine: int = 0,
    thresholds: Thresholds | None = None,
    max_cycles: int | None = None,
    store: Path | str | None = None,
    block: int = 20,
    threads: int | None = None,
    where: Any = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Name the scenarios over two parameters.

    Parameters
    ----------
    rig
        What has all other parameters: a `Rig`, a laboratory case, its code, or the path of a study
        file, shaken by one sine. None for ξ = 0.15, τ = 0.01, λ = 25.9 and δ0 = 0.5, on two sides.
    x, y
        Name and rising values of a parameter. Physical: ``"gap"`` (m, of each side),
        ``"amplitude"`` (in the unit of the rig's), ``"bumper_stiffness"`` (N/m, at the rig's
        damping C_j), ``"proportional_stiffness"`` (N/m, at the rig's C_j/K_j).
        Dimensionless: ``"stiffness_ratio"`` λ, ``"gap_ratio"`` δ0, ``"relaxation_time"`` τ,
        ``"damping_ratio"`` ξ, ``"restitution"`` e. They are set on both sides alike, where the
        stop has them: a rigid one has only a gap and a restitution. Between dimensionless ones
        δ0 is kept where it is not varied, beside a physical one the gap.
        ``"log"`` or ``"linear"`` behind the values says how they are refined, if they do not.
    step
        Step of the sweeps, as a share of the natural frequency.
    refine
        Number of times that the nodes near a border are made twice as dense. Nothing is computed
        between nodes of the same scenario: regions smaller than a square of the first grid may be
        missed.
    thresholds
        See `Thresholds`.
    max_cycles
        Forcing cycles to wait for a steady motion. None for 300, and more where damping is light;
        what is plainly chaotic when its transient has died is then not waited for.
    store
        Folder for the map as a Zarr group, written block by block. If it holds the same map,
        unfinished, that is completed. None keeps the map in memory.
    block
        Nodes of the first grid along each side of a block. So much is lost at most when the
        computation is stopped, and held in memory at a time.
    threads
        How many rigs are computed at once; None for one a processor. No result depends on it.
    where
        ``"threads"``, ``"processes"``, or a dask cluster: a ``distributed.Client`` or the address
        of its scheduler (docs/how-to/many-machines.md). None for processes where the first grid
        has at least 500 nodes and more than one may run, else threads. No result depends on it.
    progress
        Called from the calling thread with the nodes done and those known so far to be wanted.

    Returns
    -------
    xarray.Dataset
        Dims are the names of y and x. ``scenario`` (0 to 6, or 7 for unclassified;
        ``flag_meanings`` names them), ``confidence``, ``level`` and features: peaks, jumps,
        counts of left hystereses, of regular and of non-regular ranges. With a store, values
        are read from it when they are used.

    Raises
    ------
    InputError
        If a value cannot be used, or the store holds something else.
    """
    check_progress(progress)
    start = _base(rig)
    first, second = (
        axis(given, where, start.base.sine.of) for given, where in ((x, "x"), (y, "y"))
    )
    check_pair(first, second)
    used = checked(thresholds)
    settings = {
        "x": {"name": first.name, "values": first.values.tolist(), "log": first.logarithmic},
        "y": {"name": second.name, "values": second.values.tolist(), "log": second.logarithmic},
        "base": {
            **rig_parameters(start.base, "frequency", "phase"),
        },
        "step": (fine_step := share(step, "step")),
        "refine": (refine := _refinement(refine)),
        "thresholds": {name: getattr(used, name) for name in Thresholds.names()},
        "max_cycles": None if max_cycles is None else whole(max_cycles, "max_cycles"),
        "block": (block := whole(block, "block")),
    }
    workers = map_workers(len(first.values) * len(second.values), threads, where)
    nodes = (len(first.values) << refine) * (len(second.values) << refine)
    if nodes > MOST_NODES:
        raise InputError(f"refine: {refine} makes {nodes} nodes; at most {MOST_NODES} are accepted")
    fine = first.refined(refine), second.refined(refine)
    for end in (0, -1):  # refused before anything is computed
        start.rig({one.name: float(one.values[end]) for one in fine})
    plan = _Plan(
        fine,
        Nodes((len(fine[1].values), len(fine[0].values)), refine),
        block << refine,
    )

    def compute(nodes: list[Values], tally: Tally) -> dict[str, NDArray[Any]]:
        return classified([start.rig(one) for one in nodes], used, fine_step, max_cycles, tally)

    with map_store(store, fine, plan.chunk, refine + 1, settings) as held:
        if not held.finished():
            ready = 0
            for level in range(refine + 1):
                ready = _level(plan, held, level, compute, workers, progress, ready)
            held.inherit(_known(plan, held, refine))
            held.finish()
        data = held.dataset()
    return data.load() if store is None else data


def map_workers(nodes: int, threads: int | None, where: Any) -> Workers:
    """Where the work for a map with so many nodes in its first grid is done."""
    if where is None:
        several = breadth(placed(threads)) > 1 and may_start()
        where = PROCESSES if nodes >= _MANY and several else THREADS
    return placed(threads, where)


Values: TypeAlias = dict[str, float]
"""The parameters of a node."""


class _Plan(NamedTuple):
    axes: tuple[Axis, Axis]
    """x and y, with the values of the finest grid."""
    nodes: Nodes
    chunk: int
    """Nodes of the finest grid along each side of a block."""

    def blocks(self) -> Iterator[tuple[int, int, tuple[slice, slice]]]:
        """Row, column and place of each block."""
        rows, columns = (range(0, n, self.chunk) for n in self.nodes.shape)
        for r, row in enumerate(rows):
            for c, column in enumerate(columns):
                yield r, c, (slice(row, row + self.chunk), slice(column, column + self.chunk))

    def values(self, row: int, column: int) -> Values:
        """Of the two parameters at a node."""
        x, y = self.axes
        return {x.name: float(x.values[column]), y.name: float(y.values[row])}


Compute = Callable[[list[Values], Tally], dict[str, NDArray[Any]]]


def _level(
    plan: _Plan,
    held: MapStore,
    level: int,
    compute: Compute,
    workers: Workers,
    progress: Progress | None,
    done: int,
) -> int:
    """Compute the nodes of one level that are wanted; return how many are done by then."""
    chosen = plan.nodes.wanted(level, _known(plan, held, level - 1))
    total = done + int(chosen.sum())
    for row, column, place in plan.blocks():
        mine = chosen[place]
        if mine.any() and not held.done(level, row, column):
            at = np.argwhere(mine) + np.array([place[0].start, place[1].start])
            nodes = [plan.values(int(i), int(j)) for i, j in at]
            found = _parallel(nodes, compute, workers, progress, done, total)
            held.write(place, mine, level, found)
            held.mark(level, row, column)
        done += int(mine.sum())
        if progress:
            progress(done, total)
    return done


def _known(plan: _Plan, held: MapStore, level: int) -> Scenarios:
    """Scenario of the nodes that are known when a level is complete."""
    scenarios, levels = held.computed()
    known = np.full(plan.nodes.shape, UNKNOWN, dtype=np.int8)
    for one in range(level + 1):
        mine = levels == one
        known[mine] = scenarios[mine]
        if one:
            plan.nodes.fill(one, known)
    return known


def _parallel(
    nodes: list[Values],
    compute: Compute,
    workers: Workers,
    progress: Progress | None,
    before: int,
    total: int,
) -> dict[str, NDArray[Any]]:
    """Compute some nodes, a few at a time on each thread."""
    few = max(1, min(_FEW, len(nodes) // (4 * breadth(workers))))
    # Smaller ones at the end, where the others wait for the last.
    last = max(0, len(nodes) - 2 * few * breadth(workers))
    starts = [*range(0, last, few), *range(last, len(nodes), max(1, few // _LAST))]
    parts = [nodes[i:j] for i, j in itertools.pairwise([*starts, len(nodes)])]

    told = progress and (lambda done, _: progress(before + done // RIG, total))
    results = each(compute, parts, steps=len(nodes) * RIG, threads=workers, progress=told)
    return {name: np.concatenate([r[name] for r in results]) for name in results[0]}


def _refinement(given: object) -> int:
    refine = whole(given, "refine", 0)
    if refine > MOST_REFINED:
        raise InputError(f"refine: {refine}; a whole number of at most {MOST_REFINED} is accepted")
    return refine


def _base(given: AnyRig | None) -> Base:
    if given is None:
        given = from_dimensionless(25.9, 0.5, RELAXATION_TIME, DAMPING_RATIO)
    return Base(one_sine(as_rig(given)))
