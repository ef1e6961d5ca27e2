"""Branches of stable and unstable periodic orbits along a parameter, with their bifurcations."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.continuation import arclength
from vibroimpact.model import Rig, State
from vibroimpact.model.argument_types import Period, PositiveInt
from vibroimpact.model.parameter_ranges import ParameterRange, Ranges, read_ranges
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyRig, as_rig_of_any_masses, from_lowest
from vibroimpact.response.outputs import Outputs, read_outputs
from vibroimpact.stability import bifurcations
from vibroimpact.stability.branch_dataset import BranchRecord, as_dataset
from vibroimpact.stability.fixed_points import Orbit
from vibroimpact.stability.folds import FREE, InContact, bounded_by_flight, turns_into_flight
from vibroimpact.stability.initial_orbit import first_orbit
from vibroimpact.stability.orbit_curve import CLOSED, OrbitBranch, Station
from vibroimpact.stability.parameter_family import Family, family
from vibroimpact.tasks.threads import Progress, counted

_GROWN = 3.0
"""Growth relative to the first orbit from which a motion is reported as still growing."""


@public
def branch(
    rig: AnyRig,
    start: State | xr.DataArray | xr.Dataset | None = None,
    *,
    frequency: float | str | None = None,
    vary: Ranges,
    period: Period | None = None,
    most_points: PositiveInt = 5000,
    outputs: Outputs | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Continue a branch of periodic orbits along a parameter, in both directions from one orbit.

    The method is pseudo-arclength continuation with the exact derivative of the stroboscopic map.
    It follows the branch around folds, and through changes of the sequence of contacts. A motion
    that is its own mirror image is continued as a symmetric motion.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    start
        A state near the first orbit, at the initial phase of the excitation. Default: the steady
        motion that is reached from rest.
    frequency
        Forcing frequency of the first orbit (Hz). Default: the frequency of the rig. If the rig
        leaves the frequency open and the frequency is varied, the default is the lowest frequency
        of the range.
    vary
        Parameter that is varied, and its lowest and highest value in SI units or as texts with
        units, such as ``{"gap": ("3 mm", "7 mm")}``. Parameters are named by path:

        - of the excitation: "frequency", "amplitude" or "force" (a constant force);
        - of the stops on both sides: "gap", "stops.stiffness", "stops.damping",
          "stops.restitution", "stops.dissipation", "stops.exponent" or "stops.mass";
        - of the stop on one side: "right.gap", "left.gap", "right.stiffness" and so on;
        - of the isolator: "isolator.stiffness", "isolator.damping" or any other number of
          its law, such as "isolator.yield_force";
        - of an assembly: numbers of its parts, such as "masses.roof", "links.storey.stiffness",
          "stops.moat.gap" or "forces.roof"; "gap" and "stops.stiffness" are those of all stops;
        - the stiffness of the bumpers at a fixed C_j/K_j: "proportional_stiffness" or
          "stiffness_ratio" (λ);
        - the stiffness of the bumpers at a fixed coefficient of restitution:
          "stiffness_at_restitution";
        - dimensionless: "gap_ratio" (δ0), "relaxation_time" (τ) or "damping_ratio" (ξ).
    period
        Period of the orbits, in forcing cycles. Default: the period of the motion that is reached
        from rest, or 1 if there is a ``start``.
    most_points
        Largest number of orbits in each direction along the branch.
    outputs
        Own outputs, as in `sweeps`, of one period of each orbit and of each bifurcation.
    progress
        A `progress_bar`, or a function that is called with the number of computed orbits and None,
        because the total is unknown until the end.

    Returns
    -------
    xarray.Dataset
        The dim ``point`` counts the orbits along the branch. The variables of each orbit are:

        - the parameter by its name, and ``arclength``;
        - extremes and excursions of the displacement, of the absolute acceleration and of the
          transmitted force, and ``eccentricity``;
        - ``transmissibility``, as in `sweep`;
        - ``eta_d`` and ``eta_a``, the excursions divided by the largest excursion without stops at
          any frequency;
        - the impacts per cycle, and the ``outputs`` by their names;
        - ``multiplier_real`` and ``multiplier_imag``, the Floquet multipliers (dim ``multiplier``,
          the largest first), and ``stable``;
        - ``section``, the state of the orbit at the stroboscopic section.

        Of an assembly, the sizes have the dims ``mass`` and ``stop`` as in `sweep`.

        The dim ``bifurcation`` counts the bifurcations, with the kind, the parameter, the state and
        the multipliers of each. The attributes ``ended_low`` and ``ended_high`` state why the
        branch ends at either end.

    Raises
    ------
    InputError
        If a value is invalid, or if Newton's method finds no orbit near the start.
    """
    rig = as_rig_of_any_masses(rig, frequency=frequency)
    (along,) = read_ranges(vary, rig)
    fam, first = _first_orbit(from_lowest(rig, along), start, along, period)
    own = () if outputs is None else read_outputs(outputs, rig)
    followed = follow_both_ways(first, along.ends, most_points, progress)
    data = as_dataset([followed], fam, along.ends, own=own)
    if progress is not None:
        progress(data.sizes["point"], data.sizes["point"])
    return data


def turning_points(
    rig: Rig,
    start: State | xr.DataArray | xr.Dataset,
    span: tuple[float, float],
    most_points: int = 5000,
) -> list[float]:
    """Return the frequencies (Hz) of a span at which a branch of period-1 orbits turns back.

    The other arguments are those of `branch`.
    """
    (along,) = read_ranges({"frequency": span}, rig)
    _, first = _first_orbit(rig, start, along, 1)
    path = InContact if bounded_by_flight(first) else OrbitBranch
    stations, ended, _ = _both_ways(first, span, most_points, path=path)
    frequencies = [
        one.orbit.value for one in bifurcations.find(stations, turning=True) if one.turns
    ]
    for last, why, sense in ((stations[0], ended[0], -1.0), (stations[-1], ended[1], 1.0)):
        if why == FREE and turns_into_flight(last, sense):
            frequencies.append(last.orbit.value)
    return frequencies


def _first_orbit(
    rig: Rig,
    start: State | xr.DataArray | xr.Dataset | None,
    along: ParameterRange,
    period: int | None,
) -> tuple[Family, Orbit]:
    """Return the rig along the varied parameter, and the first orbit."""
    fam = family(rig.with_parts(rig.system, rig.harmonic), along.parameter.name)
    along.check_contains(fam.value, ", at which the first orbit lies")
    return fam, first_orbit(fam, along.ends, start, period)


def follow_both_ways(
    first: Orbit, span: tuple[float, float], most_points: int, progress: Progress | None = None
) -> BranchRecord:
    """Continue a branch in both directions from an orbit, and locate its bifurcations."""
    stations, ended, closed = _both_ways(first, span, most_points, progress)
    return BranchRecord(stations, list(bifurcations.find(stations)), ended, closed)


def _both_ways(
    first: Orbit,
    span: tuple[float, float],
    most_points: int,
    progress: Progress | None = None,
    path: type[OrbitBranch] = OrbitBranch,
) -> tuple[list[Station], tuple[str, str], bool]:
    """Return the orbits of a branch in order, why it ends, and whether it is closed."""
    traces, report = [], counted(progress)
    for sense in (-1.0, 1.0):
        start = Station(first, first.tangent(sense * first.section.held), 0.0, 0)
        trace = arclength.follow(path(start, *span), start, most_points, report)
        traces.append(trace)
        if trace.ended == CLOSED:
            break
    ended, closed = (_why(traces[0]), _why(traces[-1])), len(traces) == 1
    if closed:
        return traces[0].points, ended, closed
    return bifurcations.joined(traces[0].points, traces[1].points), ended, closed


def _why(trace: arclength.Trace[Station]) -> str:
    """Return why a branch ends, and after the last point whether its motion still grows."""
    if trace.is_complete:
        return trace.ended
    chosen = (trace.points[0], trace.points[len(trace.points) // 2], trace.points[-1])
    first, middle, last = (
        float(np.linalg.norm(one.orbit.section.scaled(one.y)[:-1])) for one in chosen
    )
    if last > _GROWN * first and last > middle:
        times = last / first
        return (
            f"{trace.ended}; the motion is {times:.3g} times as large as the first orbit and still "
            "grows"
        )
    return trace.ended
