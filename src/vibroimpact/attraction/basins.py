"""Basins of attraction on a grid of the plane of displacement and velocity."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.attraction.assembly_basins import assembly_basins, read_plane
from vibroimpact.attraction.attractor_variables import (
    basin_variables,
    lattice_words,
    ranked,
    renamed,
    variables,
)
from vibroimpact.attraction.basin_metrics import border_distances
from vibroimpact.attraction.find_attractors import Search
from vibroimpact.attraction.label_states import SectionSetup
from vibroimpact.attraction.node_labels import NodeLabels, label_nodes
from vibroimpact.attraction.state_grid import lattice
from vibroimpact.attraction.state_window import read_window, walls, window
from vibroimpact.datasets.description import (
    describe,
    rig_parameters,
)
from vibroimpact.errors import InputError, shown
from vibroimpact.grids.refinement import Nodes
from vibroimpact.model import AssemblyState, Oscillator, State, to_si
from vibroimpact.model.argument_types import MaxEvents, PositiveInt, Refinements, whole
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.public import public
from vibroimpact.model.quantities import LENGTH
from vibroimpact.model.read_rig import AnyRig, as_rig_of_any_masses
from vibroimpact.response.engine_system import engine_system
from vibroimpact.tasks.executors import THREADS, workers_for
from vibroimpact.tasks.threads import Progress

MOST_NODES = 100_000_000


@public
def basins(
    rig: AnyRig,
    displacement: Sequence[float | str] | None = None,
    velocity: Sequence[float | str] | None = None,
    *,
    plane: Mapping[str, tuple[float | str, float | str]] | None = None,
    start: State | AssemblyState | xr.DataArray | xr.Dataset | None = None,
    frequency: float | str | None = None,
    nodes: int | tuple[int, int] = 200,
    refine: Refinements = 0,
    deformation: Mapping[str, float | str] | None = None,
    isolator: float | str = 0.0,
    max_cycles: PositiveInt = 2000,
    max_events: MaxEvents = 10_000,
    threads: int | None = None,
    where: Any = THREADS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute the basins of attraction: which initial states lead to which steady motion.

    The initial states form a grid of displacements and velocities. In each of them the excitation
    has its initial phase. You need not know the steady motions in advance. The motion from each
    state is simulated until it enters a region from which no trajectory leads to another steady
    motion. The steady motion in this region is then identified (docs/how-to/map-basins.md).

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    displacement, velocity
        Lowest and highest displacement (m) and velocity (m/s) of the grid. Default: 1.6 times the
        range of the steady motions, which are first searched from a coarse grid of initial states.
    plane
        Of an assembly, which has no default plane: two coordinates of its state with their lowest
        and highest value, such as ``{"displacement.base": (-0.1, 0.1), "velocity.base": (-1, 1)}``.
    start
        Of an assembly, a state with the values of all other coordinates. Default: at rest at the
        equilibrium.
    frequency
        Forcing frequency (Hz). Default: the frequency of the rig.
    nodes
        Number of grid nodes along each axis, or a pair of numbers: along the displacement axis and
        along the velocity axis.
    refine
        Number of times that the grid is refined near the borders of basins. Each time, the spacing
        of the grid is halved there. No states are added between neighbouring states that lead to
        the same motion. Therefore parts of a basin that are narrower than the spacing of the first
        grid may be missed.
    deformation
        Initial deformations of bumpers (m), as a mapping such as ``{"right": "2 mm"}``. If the
        initial displacement compresses the bumper further, the larger deformation is used. Default:
        the bumpers are relaxed.
    isolator
        Initial internal variable (memory) of the isolator in m, if its law has one; see `State`.
    max_cycles
        Number of forcing cycles to wait for a periodic motion. A motion that has not settled by
        then is treated as not periodic.
    max_events
        Largest number of events (contacts, detachments, yielding and turning points) in one forcing
        cycle. When the motion from a state reaches this number, its simulation stops and the state
        is given up.
    threads
        Number of threads (default: one per processor).
    where
        ``"threads"``, ``"processes"``, or a dask cluster: a ``distributed.Client`` or the address
        of its scheduler (docs/how-to/many-machines.md). Neither ``where`` nor ``threads`` affects
        the result.
    progress
        A `progress_bar`, or a function that is called in the calling thread with the completed and
        the total number of states.

    Returns
    -------
    xarray.Dataset
        Over the dims ``velocity`` and ``displacement`` of the initial states:

        - ``basin``, the number of the steady motion (-1: the state was given up, -2: the state lies
          beyond a rigid stop);
        - ``capture_cycles``, the number of forcing cycles until the motion was identified;
        - ``level``, the level of refinement at which the node was computed.

        Over the dim ``attractor``, which counts the steady motions from the largest to the
        smallest:

        - ``motion``, the type of the motion, and its ``period``, extremes and excursions;
        - ``share``, the share of the states that lead to it, with its 95% interval;
        - ``border_distance``, the distance of the motion from the border of its basin;
        - ``mirror_image``, the number of the motion that is its mirror image.

        The dim ``point`` counts the points of the motions at the stroboscopic section. The single
        numbers ``basin_entropy``, ``border_entropy`` and ``uncertainty_exponent`` measure how
        strongly the basins are intermingled.

        Of an assembly, the dims are the two coordinates of ``plane``, the second one first. Each
        motion is followed until it repeats itself, so each state takes some milliseconds. The
        motions have ``final_state`` in place of the points, and no borders and mirror images.

    Raises
    ------
    InputError
        If a value is invalid. Also if the rig has no dissipation, because then every initial state
        has its own motion.
    """
    rig = as_rig_of_any_masses(rig, frequency=frequency)
    rig.check_frequency()
    engine_system(rig.system).check_bounded(rig)
    workers = workers_for(threads, where)
    first = _nodes(nodes)
    plan = Nodes((((first[1] - 1) << refine) + 1, ((first[0] - 1) << refine) + 1), refine)
    if plan.shape[0] * plan.shape[1] > MOST_NODES:
        raise InputError(
            f"nodes: {plan.shape[1]} × {plan.shape[0]} after refinement; lower nodes or refine "
            f"until there are at most {MOST_NODES} in total"
        )
    if rig.system.by_mass:
        engine_system(rig.system).check_size()
        for name, value in (("displacement", displacement), ("velocity", velocity)):
            if value is not None:
                raise InputError(f"{name}: an Assembly has several; remove it, and pass plane")
        for name, one in (("deformation", deformation), ("isolator", isolator or None)):
            if one is not None:
                raise InputError(f"{name}: {shown(one)}, but the rig is an Assembly; pass start")
        chosen = read_plane(plane, rig.assembly)
        data = assembly_basins(rig, chosen, start, plan, max_cycles, max_events, workers, progress)
        parameters = {**rig_parameters(rig), "refine": refine, "max_cycles": max_cycles}
        return describe(data, "vibroimpact.basins", parameters, varied=chosen)
    for name, argument in (("plane", plane), ("start", start)):
        if argument is not None:
            raise InputError(
                f"{name}: only for an Assembly; remove it, and pass displacement and velocity"
            )
    others = _others(rig.oscillator, deformation, isolator)
    stage = SectionSetup(rig, max_events)
    search = Search(stage, max_cycles, workers)
    ranges = read_window(displacement, velocity, lambda: window(search))
    points = lattice(*ranges, plan.shape[::-1], others)
    low, high = walls(stage)
    outside = (points.displacement < low) | (points.displacement > high)

    def label(at: slice | NDArray[np.int64]) -> tuple[NDArray[np.int8], NDArray[np.int32]]:
        from_search = search.label(points[at], progress)
        return from_search.owner, from_search.cycles

    data = _dataset(search, ranges, plan, label_nodes(plan, label, outside))
    return describe(
        data,
        "vibroimpact.basins",
        {
            **rig_parameters(rig),
            "deformation": dict(zip(SIDES, others[:2].tolist(), strict=True)),
            "isolator": float(others[2]),
            "refine": refine,
            "max_cycles": max_cycles,
        },
    )


def _nodes(nodes: int | tuple[int, int]) -> tuple[int, int]:
    pair = nodes if isinstance(nodes, tuple | list) else (nodes, nodes)
    if len(pair) != 2:
        raise InputError(
            f"nodes: {shown(nodes)}; pass one number for both axes, or a pair of numbers for "
            "displacement and velocity, such as (200, 100)"
        )
    return whole(pair[0], "nodes", 2), whole(pair[1], "nodes", 2)


def _others(
    oscillator: Oscillator,
    deformation: Mapping[str, float | str] | None,
    isolator: float | str,
) -> NDArray[np.float64]:
    """Return the deformations of untouched bumpers and the memory of the isolator."""
    stated = {} if deformation is None else {"deformation": deformation}
    deformations = State.model_validate(stated).deformation
    for side, value in deformations.items():
        stop = getattr(oscillator, side)
        if value and (stop is None or stop.spring_and_dashpot is None):
            raise InputError(
                f"deformation.{side}: {value:g} m, but the {side} side has no bumper that keeps a "
                f"deformation; pass 0, or leave {side} out"
            )
    memory = to_si(isolator, LENGTH, "isolator")
    return np.array([*(deformations.get(side, 0.0) for side in SIDES), memory])


def _dataset(
    search: Search,
    ranges: tuple[tuple[float, float], tuple[float, float]],
    plan: Nodes,
    nodes: NodeLabels,
) -> xr.Dataset:
    order = ranked([one.motion for one in search.known])
    # Motions that no state of the grid leads to, but one of the search's own, are left out.
    order = [number for number in order if (nodes.motion == number).any()]
    known = [search.known[number] for number in order]
    u, v = (np.linspace(*one, n) for one, n in zip(ranges, plan.shape[::-1], strict=True))
    omega = search.stage.excitation.angular_frequency
    nodes = nodes._replace(motion=renamed(nodes.motion, order))
    points = [one.points[:, :2] / [1.0, omega] for one in known]
    dims, motions = ("velocity", "displacement"), [one.motion for one in known]
    values: dict[str, Any] = {
        **basin_variables(nodes, plan, dims, motions),
        **variables(search.stage.oscillator, known),
        "border_distance": ("attractor", border_distances(nodes.motion, u, v / omega, points)),
    }
    data = xr.Dataset(
        values, {"velocity": v, "displacement": u, "attractor": np.arange(len(known))}
    )
    data.attrs["lattice"] = lattice_words(plan)
    return data
