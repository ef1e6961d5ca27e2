"""Labels of all figures: they fit, have no units if the rigs have none, and know a base at rest.

A figure function draws millimetres, g or kN. If it has the decorator `finished`, and if its
data were computed from rigs without units, `in_unit` returns 1, the labels of the axes lose their
units, and the frequencies in the data are angular, ω = 2π f.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import wraps
from typing import Any, TypeVar, cast

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from vibroimpact.datasets.description import base_at_rest
from vibroimpact.figures.legends import fit_labels
from vibroimpact.model import GRAVITY
from vibroimpact.model.written_units import unitless, written_for
from vibroimpact.response.resonance import Features

_Draw = TypeVar("_Draw", bound=Callable[..., Any])

_UNIT = re.compile(r"\s\((?:mm|m|m/s²|m s-2|g|m/s|mm/s|s|ms|1/s|–|1|[kM]?N(?: s)?|[mk]?J|)\)")
_HERTZ = re.compile(r"(\s)(?:\$f\$\s)?\(Hz\)")


def finished(draw: _Draw) -> _Draw:
    """Fit the labels, and draw without units if the first dataset or mapping of them has none."""

    @wraps(draw)
    def drawn(*arguments: Any, **options: Any) -> Any:
        every = (*arguments, *options.values())
        data = next((one for one in every if isinstance(one, Mapping)), None)
        with written_for(data):
            if unitless():
                arguments = tuple(map(_turned, arguments))
                options = {name: _turned(one) for name, one in options.items()}
            made = draw(*arguments, **options)
            fit_labels(*np.ravel(made))
            for ax in _axes(made) if unitless() else ():
                ax.set_xlabel(without_unit(ax.get_xlabel()))
                ax.set_ylabel(without_unit(ax.get_ylabel()))
            return made

    return cast("_Draw", drawn)


def base_label(label: str, data: Iterable[xr.Dataset]) -> str:
    """Return the label of an axis. If a force or nothing shakes all rigs, the base is at rest.

    Then the displacement and the velocity are absolute, and the absolute acceleration is ü.
    """
    if not all(base_at_rest(one) for one in data):
        return label
    for moving, still in (("relative", "absolute"), (" + A_t", "")):
        label = label.replace(moving, still)
    return label


def in_unit(factor: float) -> float:
    """Return the factor from SI to the unit of an axis; 1 if the rigs have no units."""
    return 1.0 if unitless() else factor


def acceleration_text(value: float) -> str:
    """Return an acceleration in m/s² and in g, or as a number if the rigs have no units."""
    if unitless():
        return f"{value:.4g}"
    return f"{value:.4g} m/s² = {value / GRAVITY:.3g} g"


def without_unit(label: str) -> str:
    """Return the label of an axis without its unit, and with ω for a frequency."""
    return _UNIT.sub("", _HERTZ.sub(r"\1$\\omega$", label))


def _turned(value: Any) -> Any:
    """Return data with angular frequencies, anything else as it is."""
    if isinstance(value, Features):
        return value.scaled(math.tau)
    if isinstance(value, Mapping) and not isinstance(value, xr.Dataset):
        return {name: _turned(one) for name, one in value.items()}
    if not isinstance(value, xr.Dataset):
        return value
    names = ["frequency"]
    if value.attrs.get("parameter") == "frequency":
        names += ["bifurcation_value", "cusp_first"]
    if value.attrs.get("other_parameter") == "frequency":
        names += ["cusp_second"]
    turned = value.copy()
    for name in names:
        if name in value.variables:
            turned[name] = value[name].copy(data=math.tau * value[name].values)
    if "frequency" in turned.variables:
        turned["frequency"].attrs["long_name"] = "excitation frequency $\\omega$"
    return turned


def _axes(made: Any) -> Iterator[Any]:
    """Yield the axes that a figure function returns, and their second scales."""
    for ax in np.ravel(cast("Any", made)):
        if isinstance(ax, Axes):
            yield ax
            yield from ax.child_axes  # such as a second scale
