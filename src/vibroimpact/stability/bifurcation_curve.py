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

from vibroimpact.arguments import check_list, check_progress, is_pair
from vibroimpact.continuation import arclength
from vibroimpact.continuation.arclength import unit_tangent
from vibroimpact.datasets.description import (
    COMPONENTS,
    describe,
    excitation_parameters,
    oscillator_parameters,
)
from vibroimpact.engine.observers import record
from vibroimpact.engine.section_map import PARAMETER
from vibroimpact.errors import InputError, shown
from vibroimpact.model.count_checks import whole
from vibroimpact.model.parameters import parameter, read_span
from vibroimpact.model.read_rig import AnyRig, as_rig, in_units_of_rig
from vibroimpact.model.rig import Rig
from vibroimpact.model.units import pretty
from vibroimpact.stability.bifurcation_locus import Locus, Place
from vibroimpact.stability.bifurcations import BREAKING
from vibroimpact.stability.branch_dataset import state_of
from vibroimpact.stability.defining_system import SEEN, Defining, Spot, solve
from vibroimpact.stability.initial_orbit import scales
from vibroimpact.stability.orbit_curve import CLOSED
from vibroimpact.stability.two_parameters import Plane, plane
from vibroimpact.tasks.threads import Progress, counted

_Array = NDArray[np.float64]

_NAMES = 'pass the names of two parameters, such as ("frequency", "gap")'
_NOTHING = xr.DataArray([np.nan])


@in_units_of_rig
def bifurcation_curve(
    rig: AnyRig,
    start: xr.Dataset,
    *,
    frequency: float | str | None = None,
    parameters: tuple[str, str],
    spans: tuple[tuple[float | str, float | str], tuple[float | str, float | str]],
    most_points: int = 2000,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Continue a bifurcation as a curve in the plane of two parameters.

    Parameters
    ----------
    rig
        The rig: a `Rig`, a published laboratory case or its code such as ``"B2-G1-A3"``, or the
        path of a study file.
    start
        One bifurcation of a dataset of `branch` or `resonance_diagram`, which was computed along
        the first parameter: ``data.isel(bifurcation=i)``.
    frequency
        Forcing frequency (Hz). Default: the frequency of the rig.
    parameters
        Names of the two parameters, as in `branch`.
    spans
        Lowest and highest value of each of the two parameters, in SI units or as text with units.
    most_points
        Largest number of points in each direction along the curve.
    progress
        Function that reports progress, such as the result of `progress_bar`. It is called with the
        number of computed points and None, because the total is unknown until the end.

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
        If a value is invalid, or if the start is not a bifurcation of this rig.
    """
    check_progress(progress)
    rig = as_rig(rig, frequency)
    names = check_list(parameters, "parameters", 2, "a list of two parameters")
    for name in (one for one in names if not isinstance(one, str)):
        raise InputError(f"parameters: {shown(name)} is not a name; {_NAMES}")
    if len(names) != 2:
        raise InputError(f"parameters: {shown(parameters)} is not a pair; {_NAMES}")
    for name in names:
        parameter(name, rig, "parameters")
    oscillator, excitation = rig.oscillator, rig.harmonic
    parameters = (names[0], names[1])
    if not isinstance(start, xr.Dataset) or start.get("bifurcation_kind", _NOTHING).ndim:
        raise InputError(
            "start: this is not a single bifurcation; pass one bifurcation of a result of branch, "
            "such as data.isel(bifurcation=0)"
        )
    if start.attrs.get("parameter") != parameters[0].replace("-", "_"):
        raise InputError(
            f"parameters: {parameters[0]!r} is not the parameter along which the start was "
            f"computed; pass {start.attrs.get('parameter')!r} as the first parameter"
        )
    most_points = whole(most_points, "most_points")
    kind = start["bifurcation_kind"].item()
    phase = float(start["bifurcation_section"].sel(component="phase"))
    over = plane(Rig(oscillator, excitation.replace(phase=phase)), (parameters[0], parameters[1]))
    if not is_pair(spans):
        raise InputError(
            f"spans: {shown(spans)}; pass a pair (low, high) for each of the two parameters, such "
            "as ((2, 8), (0.005, 0.02))"
        )
    ends = [
        read_span(varied, span, f"spans[{i}]")
        for i, (varied, span) in enumerate(
            zip((over.family.parameter, over.other), spans, strict=True)
        )
    ]
    if not ends[1][0] <= over.value <= ends[1][1]:
        low, high, own = (pretty(one, over.other.quantity) for one in (*ends[1], over.value))
        raise InputError(
            f"spans[1]: {low} to {high} does not contain the rig's {parameters[1]} of {own}; widen "
            "this range"
        )
    if kind == BREAKING and not over.symmetric:
        raise InputError(
            f"parameters: {parameters[1]!r} makes the rig asymmetric, but the start is a symmetry "
            "breaking, which requires a symmetric rig; use a parameter that changes both sides "
            "equally, such as 'gap'"
        )
    system, y = _start(over, kind, start, ends)
    first = solve(system, y, np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]))
    if first is None:
        first = solve(system, y, np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]))
    if first is None:
        own = pretty(float(start["bifurcation_value"]), over.family.parameter.quantity, 9)
        raise InputError(
            f"start: this rig has no {kind} near {parameters[0]} = {own}; pass a bifurcation that "
            "was computed for this rig"
        )
    traces, told = [], counted(progress)
    for sense in (-1.0, 1.0):
        along = sense * np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.3, 1.0])
        begin = Place(system, first, unit_tangent(first.jacobian, along, SEEN), 0.0)
        locus = Locus(begin, ends)
        traces.append(arclength.follow(locus, begin, most_points, told))
        if traces[0].ended == CLOSED:
            break
    cusps = [
        spot
        for trace in traces
        for pair in itertools.pairwise(trace.points)
        if (spot := locus.cusp(*pair)) is not None
    ]
    places = traces[0].points
    if len(traces) == 2:
        places = [*reversed(places), *traces[1].points[1:]]
    ended = (traces[0].ended, traces[-1].ended)
    if progress is not None:
        progress(len(places), len(places))
    return _dataset([place.spot for place in places], cusps, over, kind, ends, ended)


def _start(
    over: Plane, kind: str, start: xr.Dataset, spans: list[tuple[float, float]]
) -> tuple[Defining, _Array]:
    state = start["bifurcation_section"].values
    p = float(start["bifurcation_value"])
    point = np.array([*state[:4], state[6], p])
    scale = np.append(scales(over.family, spans[0], point), spans[1][1] - spans[1][0])
    # Its own mirror image it stays only where the second parameter keeps the symmetry.
    own = kind == BREAKING or bool(int(start["bifurcation_antisymmetric"]))
    mode = float(record.TOUCHING.index(state[5]))
    period = int(start["bifurcation_period"])
    return Defining(over, kind, period, own and over.symmetric, mode, scale), np.append(
        point, over.value
    )


def _dataset(
    spots: list[Spot],
    cusps: list[Spot],
    over: Plane,
    kind: str,
    spans: list[tuple[float, float]],
    ended: tuple[str, str],
) -> xr.Dataset:
    names = (over.family.parameter.name, over.other.name)
    values = np.array([spot.y[PARAMETER:] for spot in spots])
    multipliers = np.array([spot.orbit.multipliers for spot in spots])
    sections = np.array([state_of(spot.orbit) for spot in spots])
    data = xr.Dataset(
        {
            "section": (("point", "component"), sections),
            "multiplier_real": (("point", "multiplier"), multipliers.real),
            "multiplier_imag": (("point", "multiplier"), multipliers.imag),
            "cusp_first": ("cusp_number", np.array([c.y[PARAMETER] for c in cusps], dtype=float)),
            "cusp_second": (
                "cusp_number",
                np.array([c.y[PARAMETER + 1] for c in cusps], dtype=float),
            ),
        },
        coords={
            names[0]: ("point", values[:, 0]),
            names[1]: ("point", values[:, 1]),
            "component": COMPONENTS,
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
        "oscillator": oscillator_parameters(over.family.oscillator),
        **excitation_parameters(over.family.excitation),
        "frequency": over.family.excitation.frequency,
        "phase": over.family.phase,
        "parameters": names,
        "low": [span[0] for span in spans],
        "high": [span[1] for span in spans],
    }
    varied = [over.family.parameter, over.other]
    return describe(data, "vibroimpact.bifurcation_curve", parameters, varied=varied)
