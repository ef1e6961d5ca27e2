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

import itertools
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import margin
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator
from vibroimpact.response.variables import COMPONENTS, describe, oscillator_parameters
from vibroimpact.stability.bifurcations import (
    BREAKING,
    DOUBLING,
    FOLD,
    GRAZING,
    NEIMARK,
    half_plus,
    spiral,
)
from vibroimpact.stability.branch import scales, state_of
from vibroimpact.stability.family import bounds
from vibroimpact.stability.orbits import MAX_EVENTS, Orbit, Section, evaluated
from vibroimpact.stability.plane import Plane, plane

_Array = NDArray[np.float64]

KINDS = (FOLD, BREAKING, DOUBLING, NEIMARK, GRAZING)

_SEEN = np.array([1.0, 1.0, 0.0, 0.0, 1.0, 1.0])
_STEP = 1e-7
_FIRST, _LEAST, _MOST = 5e-3, 1e-8, 0.05
_NEWTON = 12
_GOOD = 1e-10
_TURN = 0.95


class _Spot(NamedTuple):
    """A point on a curve."""

    y: _Array
    """z, p, q."""
    orbit: Orbit
    jacobian: _Array
    """Of the defining system in scaled components, shape (5, 6)."""


class _System(NamedTuple):
    """The defining system of one curve."""

    plane: Plane
    kind: str
    cycles: int
    mirror: bool
    mode: float
    scale: _Array
    """Of z, p, q."""

    def section(self, q: float) -> Section:
        return Section(self.plane.at_vectors(q), self.cycles, self.mirror, self.scale[:5])

    def value(self, y: _Array) -> tuple[Orbit, _Array] | None:
        """The orbit that y stands for, and the residual in scaled components."""
        section = self.section(y[5])
        status, orbit, image = evaluated(section, y[:5], self.mode)
        if status is not Status.DONE:
            return None
        residual = np.empty(5)
        residual[:4] = (image[:4] - orbit.point[:4]) / self.scale[:4]
        residual[4] = self.test(orbit)
        return orbit, residual

    def test(self, orbit: Orbit) -> float:
        """The condition φ."""
        if self.kind == FOLD:
            return float(np.linalg.det(orbit.columns - np.eye(4)))
        if self.kind == NEIMARK:
            return spiral(orbit)
        if self.kind == GRAZING:
            found: float = margin.grazing_margin(
                orbit.section.family.system(orbit.value),
                orbit.section.family.phase,
                orbit.section.period,
                MAX_EVENTS,
                orbit.point,
                orbit.facts,
            )
            return found / float(self.scale[0])
        return half_plus(orbit)

    def spot(self, y: _Array) -> _Spot | None:
        """A point with the derivative of the system there."""
        here = self.value(y)
        if here is None:
            return None
        orbit, residual = here
        jacobian = np.empty((5, 6))
        jacobian[:4, :5] = orbit.jacobian
        for j in range(6):
            beside = y.copy()
            beside[j] += _STEP * self.scale[j]
            there = self.value(beside)
            if there is None:
                return None
            change = (there[1] - residual) / _STEP
            jacobian[4, j] = change[4]
            if j == 5:
                jacobian[:4, 5] = change[:4]
        return _Spot(y, orbit, jacobian)


def bifurcation_curve(
    oscillator: Oscillator,
    excitation: Harmonic,
    start: xr.Dataset,
    *,
    parameters: tuple[str, str],
    low: tuple[float | str, float | str],
    high: tuple[float | str, float | str],
    most_points: int = 2000,
) -> xr.Dataset:
    """Follow a bifurcation in two parameters.

    Parameters
    ----------
    oscillator, excitation
        The rig and the forcing for which the bifurcation was found; the first parameter may have
        any value.
    start
        One bifurcation of a dataset of `branch` or `resonance_diagram` along the first
        parameter: ``data.isel(bifurcation=i)``.
    parameters
        The two parameters, by the names that `branch` takes.
    low, high
        Range of each.
    most_points
        Points in each direction after which it is given up.

    Returns
    -------
    xarray.Dataset
        Dim ``point`` along the curve: both parameters by name, the ``section`` of the orbit and
        its multipliers. ``cusp`` tells at which points the projection turns back on itself;
        ``cusp_first`` and ``cusp_second`` are the parameters of the cusps, interpolated. The
        attributes ``ended_low`` and ``ended_high`` say why it ends.

    Raises
    ------
    InputError
        If a value cannot be used, or the start is no bifurcation of this rig.
    """
    if "bifurcation_kind" not in start or start["bifurcation_kind"].ndim:
        raise InputError(
            "start: this is not one bifurcation; data.isel(bifurcation=i) of a branch is accepted"
        )
    if start.attrs.get("parameter") != parameters[0].replace("-", "_"):
        raise InputError(
            f"parameters: {parameters[0]!r} is not what the start was found along; "
            f"{start.attrs.get('parameter')!r} is accepted first"
        )
    kind = start["bifurcation_kind"].item()
    over = plane(oscillator, excitation, (parameters[0], parameters[1]))
    spans = [
        bounds(varied, low[i], high[i])
        for i, varied in enumerate((over.family.parameter, over.other))
    ]
    system, y = _start(over, kind, start, spans)
    first = _corrected(system, y, np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0]))
    if first is None:
        first = _corrected(system, y, np.array([0.0, 0.0, 0.0, 0.0, 1.0, 0.0]))
    if first is None:
        raise InputError(
            f"start: no {kind} of this rig near {float(start['bifurcation_value']):.9g}; one that "
            "was found for it is accepted"
        )
    traces = [_follow(system, first, sense, spans, most_points) for sense in (-1.0, 1.0)]
    spots = [*reversed(traces[0][0]), *traces[1][0][1:]]
    return _dataset(spots, over, kind, spans, (traces[0][1], traces[1][1]))


def _start(
    over: Plane, kind: str, start: xr.Dataset, spans: list[tuple[float, float]]
) -> tuple[_System, _Array]:
    state = start["bifurcation_section"].values
    p = float(start["bifurcation_value"])
    point = np.append(state[:4], p)
    scale = np.append(scales(over.family, spans[0], point), spans[1][1] - spans[1][0])
    own = kind == BREAKING or bool(int(start["bifurcation_antisymmetric"]))
    mode = {1: 1.0, -1: 2.0}.get(int(state[5]), 0.0)
    period = int(start["bifurcation_period"])
    return _System(over, kind, period, own, mode, scale), np.append(point, over.value)


def _corrected(system: _System, y: _Array, normal: _Array) -> _Spot | None:
    """Newton's method on the plane through y normal to `normal`."""
    y = y.copy()
    aim = y.copy()
    spot = None
    for _ in range(_NEWTON):
        here = system.value(y)
        if here is None:
            return None
        residual = here[1]
        if np.abs(residual).max() <= _GOOD and spot is not None:
            return system.spot(y)
        spot = system.spot(y)
        if spot is None:
            return None
        matrix = np.vstack([spot.jacobian, normal * _SEEN])
        right = np.append(-residual, -(normal * _SEEN) @ ((y - aim) / system.scale))
        try:
            change = np.linalg.solve(matrix, right)
        except np.linalg.LinAlgError:
            return None
        longest = np.abs(change).max()
        if not longest < np.inf:
            return None
        y = y + min(1.0, 0.3 / max(longest, 1e-300)) * change * system.scale
    here = system.value(y)
    return system.spot(y) if here is not None and np.abs(here[1]).max() <= 1e-7 else None


def _tangent(spot: _Spot, along: _Array) -> _Array:
    tangent: _Array = np.linalg.svd(spot.jacobian)[2][-1]
    tangent = tangent / np.linalg.norm(tangent * _SEEN)
    return tangent if (tangent * _SEEN) @ along >= 0.0 else -tangent


def _follow(
    system: _System,
    first: _Spot,
    sense: float,
    spans: list[tuple[float, float]],
    most_points: int,
) -> tuple[list[_Spot], str]:
    """Points in one direction, and why they end."""
    spots = [first]
    tangent = _tangent(first, sense * np.array([0.0, 0.0, 0.0, 0.0, 0.3, 1.0]))
    length = _FIRST
    while len(spots) < most_points:
        here = spots[-1]
        spot = _corrected(system, here.y + length * tangent * system.scale, tangent)
        if spot is not None:
            new = _tangent(spot, tangent)
            turned = float((new * _SEEN) @ tangent)
            far = np.linalg.norm((spot.y - here.y) / system.scale * _SEEN)
            if turned >= _TURN and far <= 3.0 * length:
                outside = [
                    not span[0] <= value <= span[1]
                    for span, value in zip(spans, spot.y[4:], strict=True)
                ]
                if any(outside):
                    name = (system.plane.family.parameter, system.plane.other)[
                        outside.index(True)
                    ].name
                    return spots, f"the range of {name} ends"
                spots.append(spot)
                tangent = new
                length = min(1.5 * length, _MOST) if turned > 0.995 else length
                if len(spots) > 10 and _closed(spots, system.scale):
                    return spots, "it is closed"
                continue
        length *= 0.5
        if length < _LEAST:
            where = ", ".join(f"{value:.9g}" for value in here.y[4:])
            return spots, f"no {system.kind} could be found beyond ({where}): least step"
    return spots, f"{most_points} points were reached"


def _closed(spots: list[_Spot], scale: _Array) -> bool:
    gap = np.linalg.norm((spots[-1].y - spots[0].y) / scale * _SEEN)
    last = np.linalg.norm((spots[-1].y - spots[-2].y) / scale * _SEEN)
    return bool(gap <= last)


def _dataset(
    spots: list[_Spot],
    over: Plane,
    kind: str,
    spans: list[tuple[float, float]],
    ended: tuple[str, str],
) -> xr.Dataset:
    names = (over.family.parameter.name, over.other.name)
    values = np.array([spot.y[4:] for spot in spots])
    multipliers = np.array([spot.orbit.multipliers for spot in spots])
    sections = np.array([state_of(spot.orbit) for spot in spots])
    cusps = _cusps(values, np.array([span[1] - span[0] for span in spans]))
    flags = np.zeros(len(spots), dtype=np.int64)
    flags[[i for i, _ in cusps]] = 1
    data = xr.Dataset(
        {
            "section": (("point", "component"), sections),
            "multiplier_real": (("point", "multiplier"), multipliers.real),
            "multiplier_imag": (("point", "multiplier"), multipliers.imag),
            "cusp": ("point", flags),
            "cusp_first": ("cusp_number", np.array([at[0] for _, at in cusps], dtype=float)),
            "cusp_second": ("cusp_number", np.array([at[1] for _, at in cusps], dtype=float)),
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


def _cusps(values: _Array, scale: _Array) -> list[tuple[int, _Array]]:
    """Where the projection turns back: index, and the parameters by a parabola through three."""
    steps = np.diff(values / scale, axis=0)
    found = []
    for i, (one, other) in enumerate(itertools.pairwise(steps)):
        if one @ other < 0.0:
            found.append((i + 1, values[i + 1]))
    return found
