"""Curves of all bifurcations of one kind in the plane of two parameters."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from vibroimpact.errors import InputError
from vibroimpact.model.parameter_ranges import Ranges, read_ranges
from vibroimpact.model.rig import Rig
from vibroimpact.model.written_units import unitless
from vibroimpact.stability.bifurcation_curve import bifurcation_curve
from vibroimpact.stability.branch import branch
from vibroimpact.stability.resonance_diagram import resonance_diagram
from vibroimpact.stability.two_parameters import plane
from vibroimpact.tasks.threads import Progress


def curves_of_kind(
    rig: Rig,
    kind: str,
    *,
    vary: Ranges,
    progress: Progress | None = None,
) -> dict[str, xr.Dataset]:
    """Find the bifurcations of one kind along the first parameter, and follow each over both.

    Progress is called with the number of points so far.

    Parameters
    ----------
    rig
        The rig at one frequency, which does not matter if the first parameter is the frequency.

    Returns
    -------
    dict of xarray.Dataset
        Datasets of `bifurcation_curve` by the value at which the bifurcation was found, such as
        ``"frequency 1.66501 Hz"``, each curve once.

    Raises
    ------
    InputError
        If a value cannot be used, the second range leaves out the rig's own value, or there is no
        such bifurcation.
    """
    along, beside = read_ranges(vary, rig, 2)
    first, second = names = along.parameter.name, beside.parameter.name
    shaking = rig.harmonic
    one_branch = first != "frequency" or rig.system.by_mass
    if first == "frequency":
        natural = rig.system.angular_frequency / math.tau
        begin = along.low if one_branch else natural or 1.0
        rig = Rig(rig.system, shaking.replace(frequency=begin))
    over = plane(rig, names)
    beside.check_contains(over.value)
    only = {first: along.ends}
    if one_branch:
        data = branch(rig, vary=only)
    else:
        data = resonance_diagram(rig, only, phase=shaking.phase, progress=progress)
    curves: dict[str, xr.Dataset] = {}
    for i in np.flatnonzero(data["bifurcation_kind"].values == kind):
        value = float(data["bifurcation_value"][i])
        if any(_passes(curve, names, value, over.value) for curve in curves.values()):
            continue
        start = data.isel(bifurcation=int(i))
        both = {**only, second: beside.ends}
        curve = bifurcation_curve(rig, start, vary=both, progress=progress)
        curves[_name(curve, first, value)] = curve
    if not curves:
        raise InputError(
            f"kind: no {kind} was found for {first} from {along.low} to {along.high}; choose "
            "another kind, or widen the range of the first parameter"
        )
    return curves


def _name(curve: xr.Dataset, parameter: str, value: float) -> str:
    """Return the parameter and the value at which a bifurcation was found, with its SI unit."""
    if unitless():
        turned = parameter == "frequency"
        return f"ω {math.tau * value:.6g}" if turned else f"{parameter} {value:.6g}"
    units = str(curve[parameter].attrs["units"])
    return f"{parameter} {value:.6g}{'' if units == '1' else f' {units}'}"


def _passes(data: xr.Dataset, names: tuple[str, str], p: float, q: float) -> bool:
    """Whether a curve goes through a point: where it crosses q it is at p."""
    x, y = data[names[0]].values, data[names[1]].values
    low, high = np.minimum(y[:-1], y[1:]), np.maximum(y[:-1], y[1:])
    for i in np.flatnonzero((low <= q) & (q <= high)):
        share = (q - y[i]) / (y[i + 1] - y[i]) if y[i + 1] != y[i] else 0.5
        crossing = x[i] + share * (x[i + 1] - x[i])
        # A chord misses the curve by a part of its own length.
        if abs(crossing - p) <= 0.2 * abs(x[i + 1] - x[i]) + 1e-4 * abs(p):
            return True
    return False
