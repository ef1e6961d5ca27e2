"""Map of scenarios over two parameters, computed block by block."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import rig_parameters
from vibroimpact.errors import InputError
from vibroimpact.grids.refinement import UNKNOWN, Nodes, Scenarios
from vibroimpact.model import from_dimensionless
from vibroimpact.model.argument_types import PositiveInt, Refinements, Share
from vibroimpact.model.parameter_ranges import Values
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.scenarios.axes import Axis, one_sine, read_axes, rig_at
from vibroimpact.scenarios.map_node import RIG, classified
from vibroimpact.scenarios.map_store import MapStore, chunk_slices, map_store
from vibroimpact.scenarios.sweep_frequencies import STEP
from vibroimpact.scenarios.thresholds import Thresholds, checked
from vibroimpact.tasks.executors import PROCESSES, THREADS, workers_for
from vibroimpact.tasks.processes import may_start
from vibroimpact.tasks.threads import Progress, Tally, Workers, each, worker_count

DAMPING_RATIO, RELAXATION_TIME = 0.15, 0.01
"""ξ and τ of the published rig (the paper's Section 7)."""
_FEW = 10
"""Largest number of rigs that a thread sweeps at a time."""
_LAST = 3
"""Factor by which the last tasks of a block are smaller."""
_MANY = 500
"""Least number of nodes of the first grid for which starting processes is worthwhile: a third of
the time per rig is spent in Python, which threads execute in turn."""


MOST_NODES = 4_000_000
"""Nodes of the finest grid."""


@public
def scenario_map(
    rig: AnyRig | None,
    vary: Values,
    *,
    spacing: Mapping[str, Literal["log", "linear"]] | None = None,
    step: Share = STEP,
    refine: Refinements = 0,
    thresholds: Thresholds | None = None,
    max_cycles: PositiveInt | None = None,
    store: Path | str | None = None,
    block: PositiveInt = 20,
    threads: int | None = None,
    where: Any = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute a map of scenarios over two parameters.

    At each node of the map the rig is swept and classified, as in `classify_scenario`.

    Parameters
    ----------
    rig
        The rig, which has all other parameters and is shaken by one sine: a `Rig`, a published case
        or its code such as ``"B2-G1-A3"``, or the path of a study file. If it is None, the rig has
        the dimensionless parameters ξ = 0.15, τ = 0.01, λ = 25.9 and δ0 = 0.5 on both sides.
    vary
        The parameters on the two axes, x first, and rising values of each, such as
        ``{"gap_ratio": [0, 0.5, 1], "stiffness_ratio": [1, 10, 100]}``.

        Physical parameters are ``"gap"`` (m, on each side), ``"amplitude"`` (in the unit of the
        amplitude of the rig), ``"stops.stiffness"`` (N/m, at the damping C_j of the rig) and
        ``"proportional_stiffness"`` (N/m, at the C_j/K_j of the rig). Dimensionless parameters are
        ``"stiffness_ratio"`` λ, ``"gap_ratio"`` δ0, ``"relaxation_time"`` τ, ``"damping_ratio"`` ξ
        and ``"restitution"`` e.

        A parameter of stops is set on both sides, if the stop has it. A rigid stop has only a gap
        and a restitution. If both parameters are dimensionless and δ0 is not one of them, δ0 stays
        constant. If one of the parameters is physical, the gap stays constant.
    spacing
        Spacing of refined values by parameter, ``"log"`` or ``"linear"``. Default: the spacing that
        the values show. It is required only if they show none.
    step
        Frequency step of the sweeps, as a share of the natural frequency.
    refine
        Number of times that the map is refined near the borders between scenarios. Each time, the
        spacing of the grid is halved there. No grid points are added between neighbouring points
        with the same scenario. Therefore regions smaller than a square of the first grid may be
        missed.
    thresholds
        Thresholds between the scenarios; see `Thresholds`.
    max_cycles
        Number of forcing cycles to wait for a steady motion. Default: 300, or more if the damping
        is light. With the default, a motion that is clearly chaotic after its transient is not
        continued.
    store
        Folder in which the map is stored as a Zarr group. It is written block by block. If the
        folder holds an unfinished computation of the same map, that computation is resumed.
        Default: the map is kept in memory.
    block
        Number of nodes of the first grid along each side of a block. If the computation is stopped,
        at most the unfinished blocks are lost. Only one block is kept in memory at a time.
    threads
        Number of threads (default: one per processor).
    where
        ``"threads"``, ``"processes"``, or a dask cluster: a ``distributed.Client`` or the address
        of its scheduler (docs/how-to/many-machines.md). Default: processes if the first grid has at
        least 500 nodes and more than one process may run, and threads otherwise. Neither ``where``
        nor ``threads`` affects the result.
    progress
        A `progress_bar`, or a function that is called in the calling thread with the number of
        completed nodes and the number of nodes that are known to be required so far.

    Returns
    -------
    xarray.Dataset
        The dims are the names of the parameters y and x. ``scenario`` is 0 to 6, or 7 for
        unclassified; its attribute ``flag_meanings`` contains their names. ``confidence`` is
        defined as in `classify_scenario`. ``level`` is the level of refinement at which a node was
        computed. The other variables are features of the resonance curves: peaks, jumps, and
        numbers of left hystereses, of regular secondary resonances and of ranges with non-regular
        motions. If there is a ``store``, values are read from it on demand.

    Raises
    ------
    InputError
        If a value is invalid, or if the folder ``store`` holds another computation.
    """
    if rig is None:
        rig = from_dimensionless(25.9, 0.5, RELAXATION_TIME, DAMPING_RATIO)
    start = one_sine(as_rig(rig))
    first, second = read_axes(vary, spacing, start.sine.of)
    used = checked(thresholds)
    settings = {
        "x": {"name": first.name, "values": first.values.tolist(), "log": first.logarithmic},
        "y": {"name": second.name, "values": second.values.tolist(), "log": second.logarithmic},
        "base": rig_parameters(start, "frequency", "phase"),
        "step": step,
        "refine": refine,
        "thresholds": {name: getattr(used, name) for name in Thresholds.names()},
        "max_cycles": max_cycles,
        "block": block,
    }
    workers = map_workers(len(first.values) * len(second.values), threads, where)
    nodes = (len(first.values) << refine) * (len(second.values) << refine)
    if nodes > MOST_NODES:
        raise InputError(
            f"refine: {refine} gives {nodes} points, more than the maximum of {MOST_NODES}; lower "
            "refine, or pass fewer values"
        )
    fine = first.refined(refine), second.refined(refine)
    for end in (0, -1):  # refused before anything is computed
        rig_at(start, {one.name: float(one.values[end]) for one in fine})
    plan = _Plan(
        fine,
        Nodes((len(fine[1].values), len(fine[0].values)), refine),
        block << refine,
    )

    def compute(nodes: list[Node], tally: Tally) -> dict[str, NDArray[Any]]:
        return classified([rig_at(start, one) for one in nodes], used, step, max_cycles, tally)

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
    """Return where to compute a map with this number of nodes in its first grid."""
    if where is None:
        several = worker_count(workers_for(threads)) > 1 and may_start()
        where = PROCESSES if nodes >= _MANY and several else THREADS
    return workers_for(threads, where)


Node: TypeAlias = dict[str, float]
"""The parameters of a node."""


class _Plan(NamedTuple):
    axes: tuple[Axis, Axis]
    """x and y, with the values of the finest grid."""
    nodes: Nodes
    chunk: int
    """Nodes of the finest grid along each side of a block."""

    def blocks(self) -> Iterator[tuple[int, int, tuple[slice, slice]]]:
        """Row, column and place of each block."""
        rows, columns = (chunk_slices(n, self.chunk) for n in self.nodes.shape)
        for (r, row), (c, column) in itertools.product(enumerate(rows), enumerate(columns)):
            yield r, c, (row, column)

    def values(self, row: int, column: int) -> Node:
        """Return the values of both parameters at a node."""
        x, y = self.axes
        return {x.name: float(x.values[column]), y.name: float(y.values[row])}


Compute = Callable[[list[Node], Tally], dict[str, NDArray[Any]]]


def _level(
    plan: _Plan,
    held: MapStore,
    level: int,
    compute: Compute,
    workers: Workers,
    progress: Progress | None,
    done: int,
) -> int:
    """Compute the required nodes of one level; return the total number of nodes done."""
    chosen = plan.nodes.nodes_to_compute(level, _known(plan, held, level - 1))
    total = done + int(chosen.sum())
    for row, column, place in plan.blocks():
        mine = chosen[place]
        if mine.any() and not held.done(level, row, column):
            at = np.argwhere(mine) + np.array([place[0].start, place[1].start])
            nodes = [plan.values(int(i), int(j)) for i, j in at]
            variables = _parallel(nodes, compute, workers, progress, done, total)
            held.write(place, mine, level, variables)
            held.mark(level, row, column)
        done += int(mine.sum())
        if progress:
            progress(done, total)
    return done


def _known(plan: _Plan, held: MapStore, level: int) -> Scenarios:
    """Return the scenarios of the nodes that are known when a level is complete."""
    scenarios, levels = held.computed()
    known = np.full(plan.nodes.shape, UNKNOWN, dtype=np.int8)
    for one in range(level + 1):
        mine = levels == one
        known[mine] = scenarios[mine]
        if one:
            plan.nodes.fill(one, known)
    return known


def _parallel(
    nodes: list[Node],
    compute: Compute,
    workers: Workers,
    progress: Progress | None,
    before: int,
    total: int,
) -> dict[str, NDArray[Any]]:
    """Compute some nodes, a few at a time on each thread."""
    few = max(1, min(_FEW, len(nodes) // (4 * worker_count(workers))))
    # Smaller ones at the end, where the others wait for the last.
    last = max(0, len(nodes) - 2 * few * worker_count(workers))
    starts = [*range(0, last, few), *range(last, len(nodes), max(1, few // _LAST))]
    parts = [nodes[i:j] for i, j in itertools.pairwise([*starts, len(nodes)])]

    report = progress and (lambda done, _: progress(before + done // RIG, total))
    results = each(compute, parts, steps=len(nodes) * RIG, threads=workers, progress=report)
    return {name: np.concatenate([r[name] for r in results]) for name in results[0]}
