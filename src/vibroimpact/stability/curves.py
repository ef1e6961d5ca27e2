"""Curves of bifurcations in two parameters, as solutions of their defining systems.

An orbit with P(z; p, q) = z and one more condition φ(z; p, q) = 0 is followed by pseudo-arclength:

=====================  ====================================================================
fold                   φ = det(M − I), or det(H − I) where the orbit is its own mirror image
symmetry breaking      φ = det(H + I)
period doubling        φ = det(M + I)
Neimark–Sacker         φ = log of the modulus of the complex pair
grazing                φ = the least clearance at a turning point, or minus the least depth
=====================  ====================================================================

In (z, p, q) the curve of folds is smooth where its projection has a cusp.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator
from vibroimpact.model.counts import whole
from vibroimpact.model.rigs import takes_rig
from vibroimpact.response.variables import COMPONENTS, describe, oscillator_parameters
from vibroimpact.stability.bifurcations import (
    BREAKING,
    DOUBLING,
    FOLD,
    GRAZING,
    NEIMARK,
)
from vibroimpact.stability.branch import scales, state_of
from vibroimpact.stability.defining import SEEN, Defining, Spot, solve, tangent_of
from vibroimpact.stability.family import bounds
from vibroimpact.stability.orbits import seen_at
from vibroimpact.stability.plane import Plane, plane

_Array = NDArray[np.float64]

KINDS = (FOLD, BREAKING, DOUBLING, NEIMARK, GRAZING)

_FIRST, _LEAST, _MOST = 5e-3, 1e-8, 0.05
_TURN = 0.95
_NOTHING = xr.DataArray([np.nan])
_TURNED = 1.0  # rad, by which the section is moved
_PARAMETERS = np.array([0.0, 0.0, 0.0, 0.0, 1.0, 1.0])


@takes_rig
def bifurcation_curve(
    oscillator: Oscillator,
    excitation: Harmonic,
    start: xr.Dataset,
    *,
    parameters: tuple[str, str],
    low: tuple[float | str, float | str],
    high: tuple[float | str, float | str],
    most_points: int = 2000,
    progress: Callable[[float, float], None] | None = None,
) -> xr.Dataset:
    """Follow a bifurcation in two parameters.

    Parameters
    ----------
    oscillator, excitation
        The rig and the forcing for which the bifurcation was found; the first parameter may have
        any value. Or a laboratory case or its code, and a frequency.
    start
        One bifurcation of a dataset of `branch` or `resonance_diagram` along the first
        parameter: ``data.isel(bifurcation=i)``.
    parameters
        The two parameters, by the names that `branch` takes.
    low, high
        Range of each.
    most_points
        Points in each direction after which it is given up.
    progress
        Called with both parameters as the curve is followed.

    Returns
    -------
    xarray.Dataset
        Dim ``point`` along the curve: both parameters by name, the ``section`` of the orbit and
        its multipliers. Dim ``cusp_number``: the parameters ``cusp_first`` and ``cusp_second`` of
        each cusp, where the curve turns back on itself. The attributes ``ended_low`` and
        ``ended_high`` say why it ends.

    Raises
    ------
    InputError
        If a value cannot be used, or the start is no bifurcation of this rig.
    """
    if not isinstance(start, xr.Dataset) or start.get("bifurcation_kind", _NOTHING).ndim:
        raise InputError(
            "start: this is not one bifurcation; data.isel(bifurcation=i) of a branch is accepted"
        )
    if start.attrs.get("parameter") != parameters[0].replace("-", "_"):
        raise InputError(
            f"parameters: {parameters[0]!r} is not what the start was found along; "
            f"{start.attrs.get('parameter')!r} is accepted first"
        )
    most_points = whole(most_points, "most_points")
    kind = start["bifurcation_kind"].item()
    phase = float(start["bifurcation_section"].sel(component="phase"))
    over = plane(oscillator, excitation.replace(phase=phase), (parameters[0], parameters[1]))
    spans = [
        bounds(varied, low[i], high[i])
        for i, varied in enumerate((over.family.parameter, over.other))
    ]
    if not spans[1][0] <= over.value <= spans[1][1]:
        raise InputError(
            f"low: {spans[1][0]:g} to {spans[1][1]:g} leaves out the rig's {parameters[1]}, "
            f"{over.value:g}; a range that holds it is accepted"
        )
    system, y = _start(over, kind, start, spans)
    first = solve(system, y, np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0]))
    if first is None:
        first = solve(system, y, np.array([0.0, 0.0, 0.0, 0.0, 1.0, 0.0]))
    if first is None:
        raise InputError(
            f"start: no {kind} of this rig near {float(start['bifurcation_value']):.9g}; one that "
            "was found for it is accepted"
        )
    back, ahead = (
        _follow(system, first, sense, spans, most_points, progress) for sense in (-1.0, 1.0)
    )
    spots = [*reversed(back[0]), *ahead[0][1:]]
    return _dataset(spots, back[1] + ahead[1], over, kind, spans, (back[2], ahead[2]))


def _start(
    over: Plane, kind: str, start: xr.Dataset, spans: list[tuple[float, float]]
) -> tuple[Defining, _Array]:
    state = start["bifurcation_section"].values
    p = float(start["bifurcation_value"])
    point = np.append(state[:4], p)
    scale = np.append(scales(over.family, spans[0], point), spans[1][1] - spans[1][0])
    own = kind == BREAKING or bool(int(start["bifurcation_antisymmetric"]))
    mode = {1: 1.0, -1: 2.0}.get(int(state[5]), 0.0)
    period = int(start["bifurcation_period"])
    return Defining(over, kind, period, own, mode, scale), np.append(point, over.value)


def _follow(
    system: Defining,
    first: Spot,
    sense: float,
    spans: list[tuple[float, float]],
    most_points: int,
    progress: Callable[[float, float], None] | None,
) -> tuple[list[Spot], list[Spot], str]:
    """Points in one direction, the cusps among them, and why they end."""
    spots = [first]
    cusps: list[Spot] = []
    tangent = tangent_of(first, sense * np.array([0.0, 0.0, 0.0, 0.0, 0.3, 1.0]))
    length = _FIRST
    moved = False
    while len(spots) < most_points:
        here = spots[-1]
        spot = solve(system, here.y + length * tangent * system.scale, tangent)
        if spot is not None:
            new = tangent_of(spot, tangent)
            turned = float((new * SEEN) @ tangent)
            far = np.linalg.norm((spot.y - here.y) / system.scale * SEEN)
            if turned >= _TURN and far <= 3.0 * length:
                for i, span in enumerate(spans):
                    if not span[0] <= spot.y[4 + i] <= span[1]:
                        bound = span[0] if spot.y[4 + i] < span[0] else span[1]
                        last = _on_bound(system, here, spot, i, bound)
                        ended = (system.plane.family.parameter, system.plane.other)[i].name
                        return spots + last, cusps, f"the range of {ended} ends at {bound:.9g}"
                if new[4:] @ tangent[4:] < 0.0:
                    cusps += _cusp(system, here, tangent, length)
                spots.append(spot)
                if progress:
                    progress(float(spot.y[4]), float(spot.y[5]))
                tangent = new
                moved = False
                length = min(1.5 * length, _MOST) if turned > 0.995 else length
                if len(spots) > 10 and _closed(spots, system.scale):
                    return spots, cusps, "it is closed"
                continue
        length *= 0.5
        if length < _LEAST:
            elsewhere = None if moved else _at_another_phase(system, here, tangent)
            if elsewhere is None:
                where = ", ".join(f"{value:.9g}" for value in here.y[4:])
                return spots, cusps, f"no {system.kind} found beyond ({where}): least step"
            system, spots[-1], tangent = elsewhere
            moved, length = True, _FIRST
    return spots, cusps, f"{most_points} points were reached"


def _on_bound(system: Defining, here: Spot, there: Spot, which: int, bound: float) -> list[Spot]:
    """The point at the end of the range, if there is one."""
    share = (bound - here.y[4 + which]) / (there.y[4 + which] - here.y[4 + which])
    y = here.y + share * (there.y - here.y)
    y[4 + which] = bound
    normal = np.zeros(6)
    normal[4 + which] = 1.0
    spot = solve(system, y, normal)
    return [spot] if spot is not None else []


def _cusp(system: Defining, here: Spot, tangent: _Array, length: float) -> list[Spot]:
    """The point within a step at which both parameters turn back, by bisection."""
    good, bad = 0.0, length
    found: list[Spot] = []
    for _ in range(26):
        middle = 0.5 * (good + bad)
        spot = solve(system, here.y + middle * tangent * system.scale, tangent)
        if spot is None:
            return []
        found = [spot]
        if tangent_of(spot, tangent)[4:] @ tangent[4:] < 0.0:
            bad = middle
        else:
            good = middle
    return found


def _at_another_phase(
    system: Defining, here: Spot, tangent: _Array
) -> tuple[Defining, Spot, _Array] | None:
    """The same curve with the section elsewhere: where an event falls on it, no step goes on."""
    over = system.plane
    turned = over.family.excitation.replace(phase=over.family.phase + _TURNED)
    point, mode = seen_at(here.orbit, turned.phase)
    system = system._replace(
        plane=over._replace(family=over.family._replace(excitation=turned)), mode=mode
    )
    spot = solve(system, np.append(point[:4], here.y[4:]), tangent * _PARAMETERS)
    if spot is None:
        return None
    return system, spot, tangent_of(spot, tangent * _PARAMETERS)


def _closed(spots: list[Spot], scale: _Array) -> bool:
    gap = np.linalg.norm((spots[-1].y - spots[0].y) / scale * SEEN)
    last = np.linalg.norm((spots[-1].y - spots[-2].y) / scale * SEEN)
    return bool(gap <= last)


def _dataset(
    spots: list[Spot],
    cusps: list[Spot],
    over: Plane,
    kind: str,
    spans: list[tuple[float, float]],
    ended: tuple[str, str],
) -> xr.Dataset:
    names = (over.family.parameter.name, over.other.name)
    values = np.array([spot.y[4:] for spot in spots])
    multipliers = np.array([spot.orbit.multipliers for spot in spots])
    sections = np.array([state_of(spot.orbit) for spot in spots])
    data = xr.Dataset(
        {
            "section": (("point", "component"), sections),
            "multiplier_real": (("point", "multiplier"), multipliers.real),
            "multiplier_imag": (("point", "multiplier"), multipliers.imag),
            "cusp_first": ("cusp_number", np.array([c.y[4] for c in cusps], dtype=float)),
            "cusp_second": ("cusp_number", np.array([c.y[5] for c in cusps], dtype=float)),
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
        "amplitude": over.family.excitation.amplitude,
        "frequency": over.family.excitation.frequency,
        "phase": over.family.phase,
        "parameters": names,
        "low": [span[0] for span in spans],
        "high": [span[1] for span in spans],
    }
    return describe(data, "vibroimpact.bifurcation_curve", parameters)
