"""Branches of periodic orbits along a parameter, stable or not, with their bifurcations."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.arguments import check_progress
from vibroimpact.continuation import arclength
from vibroimpact.errors import InputError
from vibroimpact.model import Rig, State
from vibroimpact.model.count_checks import MOST_CYCLES, whole
from vibroimpact.model.parameters import read_span
from vibroimpact.model.read_rig import AnyRig, as_rig, from_lowest
from vibroimpact.model.units import pretty
from vibroimpact.stability import bifurcations
from vibroimpact.stability.branch_dataset import Followed, as_dataset
from vibroimpact.stability.fixed_points import HELD, Orbit
from vibroimpact.stability.folds import FREE, InContact, bounded_by_flight, turns_into_flight
from vibroimpact.stability.initial_orbit import first_orbit
from vibroimpact.stability.orbit_curve import CLOSED, Branch, Station
from vibroimpact.stability.parameter_family import Family, family
from vibroimpact.tasks.threads import Progress, counted

_GROWN = 3.0
"""Size over that of the first orbit from which a motion that still grows is reported as such."""


def branch(
    rig: AnyRig,
    start: State | xr.DataArray | xr.Dataset | None = None,
    *,
    frequency: float | str | None = None,
    parameter: str = "frequency",
    span: tuple[float | str, float | str],
    period: int | None = None,
    most_points: int = 5000,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Follow a branch of periodic orbits in both directions from one of its orbits.

    Pseudo-arclength continuation with the exact derivative of the map from section to section;
    it goes round folds and through changes of the contacts. A motion that is its own mirror image
    is followed as such.

    Parameters
    ----------
    rig
        The rig: a `Rig`, a laboratory case, its code, or the path of a study file.
    start
        A state near that orbit, at the excitation's phase; None for where the motion from rest
        settles.
    frequency
        Forcing frequency of the first orbit (Hz). Default: that of the rig; where it is open and
        the frequency is varied, the lowest of the span.
    parameter
        What is varied: "frequency", "amplitude", "force" (constant); "gap", "bumper_stiffness",
        "bumper_damping" or "restitution" of both sides, "right_gap", "left_gap",
        "right_stiffness" and so on of one; "stiffness", "damping" and whatever other number the
        isolator has, such as "yield_force"; what other numbers the stops have, such as
        "dissipation", "bumper_exponent" or "bumper_mass"; "proportional_stiffness" and
        "stiffness_ratio" (λ) of the bumpers at a fixed C_j/K_j, "stiffness_at_restitution" at a
        fixed restitution, "gap_ratio" (δ0), "relaxation_time" (τ) or "damping_ratio" (ξ).
    span
        Lowest and highest value of the parameter, in SI units or as text.
    period
        Of the orbits, in forcing cycles; None for that of the motion from rest, or 1 with a start.
    most_points
        Orbits in each direction after which it is given up.
    progress
        Called with the number of orbits so far as the branch is followed, and with None until
        it has been.

    Returns
    -------
    xarray.Dataset
        Dim ``point`` along the branch: the parameter by its name, ``arclength``, extremes,
        excursions, ``eta_d`` and ``eta_a`` (over the largest free flight of the isolator at any
        frequency), ``eccentricity``, impacts per cycle, ``multiplier_real`` and ``_imag`` (dim
        ``multiplier``, the largest first), ``stable`` and ``section``. Dim ``bifurcation``: kind,
        parameter, state and multipliers of each. The attributes ``ended_low`` and ``ended_high``
        say why the branch ends at its beginning and at its end.

    Raises
    ------
    InputError
        If a value cannot be used, or Newton's method finds no orbit near the start.
    """
    check_progress(progress)
    rig = from_lowest(as_rig(rig, frequency), parameter, span)
    fam, ends, first = _first_orbit(rig, start, parameter, span, period)
    most_points = whole(most_points, "most_points")
    data = as_dataset([follow_both_ways(first, ends, most_points, progress)], fam, ends)
    if progress is not None:
        progress(data.sizes["point"], data.sizes["point"])
    return data


def turning_points(
    rig: Rig,
    start: State | xr.DataArray | xr.Dataset,
    span: tuple[float, float],
    most_points: int = 5000,
) -> list[float]:
    """Frequencies (Hz) at which a branch of orbits of one cycle turns back.

    Where nothing else is asked of it: the arguments are those of `branch`.
    """
    _, span, first = _first_orbit(rig, start, "frequency", span, 1)
    path = InContact if bounded_by_flight(first) else Branch
    stations, ended, _ = _both_ways(first, span, most_points, path=path)
    found = [one.orbit.value for one in bifurcations.find(stations, turning=True) if one.turns]
    for last, why, sense in ((stations[0], ended[0], -1.0), (stations[-1], ended[1], 1.0)):
        if why == FREE and turns_into_flight(last, sense):
            found.append(last.orbit.value)
    return found


def _first_orbit(
    rig: Rig,
    start: State | xr.DataArray | xr.Dataset | None,
    parameter: str,
    span: tuple[float | str, float | str],
    period: int | None,
) -> tuple[Family, tuple[float, float], Orbit]:
    """What is varied, over which range, and the first orbit."""
    fam = family(Rig(rig.oscillator, rig.harmonic), parameter)
    ends = read_span(fam.parameter, span)
    if not ends[0] <= fam.value <= ends[1]:
        low, high, own = (pretty(value, fam.parameter.quantity) for value in (*ends, fam.value))
        raise InputError(
            f"span: {low} to {high} leaves out the first orbit's {parameter}, {own}; a range that "
            "holds it is accepted"
        )
    period = None if period is None else whole(period, "period", most=MOST_CYCLES)
    return fam, ends, first_orbit(fam, ends, start, period)


def follow_both_ways(
    first: Orbit, span: tuple[float, float], most_points: int, progress: Progress | None = None
) -> Followed:
    """Follow a branch both ways from an orbit, and find its bifurcations."""
    stations, ended, closed = _both_ways(first, span, most_points, progress)
    return Followed(stations, list(bifurcations.find(stations)), ended, closed)


def _both_ways(
    first: Orbit,
    span: tuple[float, float],
    most_points: int,
    progress: Progress | None = None,
    path: type[Branch] = Branch,
) -> tuple[list[Station], tuple[str, str], bool]:
    """The orbits of a branch in its order, why it ends on either side, and whether it is closed."""
    traces, told = [], counted(progress)
    for sense in (-1.0, 1.0):
        start = Station(first, first.tangent(sense * HELD), 0.0, 0)
        trace = arclength.follow(path(start, *span), start, most_points, told)
        traces.append(trace)
        if trace.ended == CLOSED:
            break
    ended, closed = (_why(traces[0]), _why(traces[-1])), len(traces) == 1
    if closed:
        return traces[0].points, ended, closed
    return bifurcations.joined(traces[0].points, traces[1].points), ended, closed


def _why(trace: arclength.Trace[Station]) -> str:
    """Why a branch ends; where its points were used up, whether its motion still grows."""
    if trace.is_complete:
        return trace.ended
    chosen = (trace.points[0], trace.points[len(trace.points) // 2], trace.points[-1])
    first, middle, last = (
        float(np.hypot(*(one.y[:2] / one.orbit.section.scale[:2]))) for one in chosen
    )
    if last > _GROWN * first and last > middle:
        times = last / first
        return f"{trace.ended}; the motion is {times:.3g} times the first and still grows"
    return trace.ended
