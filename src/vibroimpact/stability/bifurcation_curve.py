"""Curves of bifurcations in the plane of two parameters, as solutions of their defining systems.

A periodic orbit satisfies P(z; p, q) = z, and at a bifurcation one more condition φ(z; p, q) = 0.
The solutions are continued by the pseudo-arclength method:

=====================  ====================================================================
fold                   φ = det(M − I), or det(H − I) where the orbit is its own mirror image
symmetry breaking      φ = det(H + I)
period doubling        φ = det(M + I)
Neimark–Sacker         φ = log of the modulus of the complex pair
grazing                φ = the least clearance at a turning point, or minus the least depth
=====================  ====================================================================

In the space of (z, p, q) the curve of folds is smooth where its projection has a cusp.
"""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.continuation import arclength
from vibroimpact.continuation.arclength import unit_tangent
from vibroimpact.datasets.description import (
    describe,
    excitation_parameters,
    system_parameters,
)
from vibroimpact.errors import InputError
from vibroimpact.model.argument_types import PositiveInt
from vibroimpact.model.parameter_ranges import Ranges, read_ranges
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyRig, as_rig_of_any_masses
from vibroimpact.model.rig import Rig
from vibroimpact.model.units import pretty
from vibroimpact.stability.bifurcation_locus import Locus, LocusPoint
from vibroimpact.stability.bifurcations import BREAKING, GRAZING
from vibroimpact.stability.branch_dataset import state_of
from vibroimpact.stability.defining_system import Defining, Spot, solve
from vibroimpact.stability.initial_orbit import scales
from vibroimpact.stability.orbit_curve import CLOSED
from vibroimpact.stability.two_parameters import ParameterPlane, plane
from vibroimpact.tasks.threads import Progress, counted

_Array = NDArray[np.float64]


@public
def bifurcation_curve(
    rig: AnyRig,
    start: xr.Dataset,
    *,
    frequency: float | str | None = None,
    vary: Ranges,
    most_points: PositiveInt = 2000,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Continue a bifurcation as a curve in the plane of two parameters.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    start
        One bifurcation of a dataset of `branch` or `resonance_diagram`, which was computed along
        one of the two parameters: ``data.isel(bifurcation=i)``.
    frequency
        Forcing frequency (Hz). Default: the frequency of the rig.
    vary
        The two parameters, and the lowest and highest value of each, as in `branch`. The parameter
        along which ``start`` was computed is the first, whatever the order of the mapping.
    most_points
        Largest number of points in each direction along the curve.
    progress
        A `progress_bar`, or a function that is called with the number of computed points and None,
        because the total is unknown until the end.

    Returns
    -------
    xarray.Dataset
        The dim ``point`` counts the points along the curve. Its variables are the two parameters by
        name, the ``section`` of the orbit (its state at the stroboscopic section), and the Floquet
        multipliers. The dim ``cusp_number`` counts the cusps, which are points where the curve
        turns back on itself. ``cusp_first`` and ``cusp_second`` are the parameters there. The
        attributes ``ended_low`` and ``ended_high`` state why the curve ends at either end.

    Raises
    ------
    InputError
        If a value is invalid, or if the start is not a bifurcation of this rig. Also if it is a
        grazing of an assembly.
    """
    rig = as_rig_of_any_masses(rig, frequency=frequency)
    ranges = read_ranges(vary, rig, 2)
    excitation = rig.harmonic
    if not isinstance(start, xr.Dataset) or (
        "bifurcation_kind" not in start or start["bifurcation_kind"].ndim
    ):
        raise InputError(
            "start: this is not a single bifurcation; pass one bifurcation of a result of branch, "
            "such as data.isel(bifurcation=0)"
        )
    ranges.sort(key=lambda one: one.parameter.name != start.attrs.get("parameter"))
    first, second = (one.parameter.name for one in ranges)
    if first != start.attrs.get("parameter"):
        raise InputError(
            f"vary: neither {first!r} nor {second!r} is the parameter along which the start was "
            f"computed; pass {start.attrs.get('parameter')!r} and another one"
        )
    kind = start["bifurcation_kind"].item()
    if kind == GRAZING and rig.system.by_mass:
        raise InputError(
            "start: a grazing, of which no curve is followed for an Assembly of several masses; "
            "pass a fold, a symmetry breaking, a period doubling or a Neimark-Sacker bifurcation"
        )
    phase = float(start["bifurcation_section"].sel(component="phase"))
    over = plane(Rig(rig.system, excitation.replace(phase=phase)), (first, second))
    ranges[1].check_contains(over.value)
    ends = [one.ends for one in ranges]
    if kind == BREAKING and not over.symmetric:
        raise InputError(
            f"vary: {second!r} makes the rig asymmetric, but the start is a symmetry "
            "breaking, which requires a symmetric rig; use a parameter that changes both sides "
            "equally, such as 'gap'"
        )
    system, y = _start(over, kind, start, ends)
    spot = solve(system, y, np.eye(len(y))[-1])
    if spot is None:
        own = pretty(float(start["bifurcation_value"]), over.family.parameter.quantity, 9)
        raise InputError(
            f"start: this rig has no {kind} near {first} = {own}; pass a bifurcation that "
            "was computed for this rig"
        )
    traces, report = [], counted(progress)
    for sense in (-1.0, 1.0):
        along = np.append(np.zeros(len(y) - 2), [0.3 * sense, sense])
        begin = LocusPoint(system, spot, unit_tangent(spot.jacobian, along, system.seen), 0.0)
        locus = Locus(begin, ends)
        traces.append(arclength.follow(locus, begin, most_points, report))
        if traces[0].ended == CLOSED:
            break
    cusps = [
        cusp
        for trace in traces
        for pair in itertools.pairwise(trace.points)
        if (cusp := locus.cusp(*pair)) is not None
    ]
    places = traces[0].points
    if len(traces) == 2:
        places = [*reversed(places), *traces[1].points[1:]]
    ended = (traces[0].ended, traces[-1].ended)
    if progress is not None:
        progress(len(places), len(places))
    return _dataset([place.spot for place in places], cusps, over, kind, ends, ended)


def _start(
    over: ParameterPlane, kind: str, start: xr.Dataset, spans: list[tuple[float, float]]
) -> tuple[Defining, _Array]:
    layout, p = over.family.layout, float(start["bifurcation_value"])
    parts, mode = layout.near(layout.read(start["bifurcation_section"]))
    point = np.append(parts, p)
    scale = np.append(scales(over.family, spans[0], point), spans[1][1] - spans[1][0])
    # Its own mirror image it stays only where the second parameter keeps the symmetry.
    own = kind == BREAKING or bool(int(start["bifurcation_antisymmetric"]))
    period = int(start["bifurcation_period"])
    return Defining(over, kind, period, own and over.symmetric, mode, scale), np.append(
        point, over.value
    )


def _dataset(
    spots: list[Spot],
    cusps: list[Spot],
    over: ParameterPlane,
    kind: str,
    spans: list[tuple[float, float]],
    ended: tuple[str, str],
) -> xr.Dataset:
    names = (over.family.parameter.name, over.other.name)
    values = np.array([spot.y[-2:] for spot in spots])
    multipliers = np.array([spot.orbit.multipliers for spot in spots])
    sections = np.array([state_of(spot.orbit) for spot in spots])
    data = xr.Dataset(
        {
            "section": (("point", "component"), sections),
            "multiplier_real": (("point", "multiplier"), multipliers.real),
            "multiplier_imag": (("point", "multiplier"), multipliers.imag),
            "cusp_first": ("cusp_number", np.array([c.y[-2] for c in cusps], dtype=float)),
            "cusp_second": (
                "cusp_number",
                np.array([c.y[-1] for c in cusps], dtype=float),
            ),
        },
        coords={
            names[0]: ("point", values[:, 0]),
            names[1]: ("point", values[:, 1]),
            "component": over.family.layout.names,
        },
    )
    data.attrs |= {
        "kind": kind,
        "parameter": names[0],
        "other_parameter": names[1],
        "ended_low": ended[0],
        "ended_high": ended[1],
    }
    parameters: dict[str, Any] = {
        **system_parameters(over.family.rig.system),
        **excitation_parameters(over.family.excitation),
        "frequency": over.family.excitation.frequency,
        "phase": over.family.phase,
        "parameters": names,
        "low": [span[0] for span in spans],
        "high": [span[1] for span in spans],
    }
    varied = [over.family.parameter, over.other]
    return describe(data, "vibroimpact.bifurcation_curve", parameters, varied=varied)
