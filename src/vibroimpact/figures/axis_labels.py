"""Axis labels of the quantities of sweeps, branches and ensembles."""

from __future__ import annotations

import re

import xarray as xr

from vibroimpact.figures.finish import in_unit
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.quantities import FORCE, GRAVITY, IMPULSE

_LABELS = {
    "eta_d": (1.0, "$\\eta_d$ (–)"),
    "eta_a": (1.0, "$\\eta_a$ (–)"),
    "displacement_excursion": (1e3, "excursion of displacement (mm)"),
    "eccentricity": (1e3, "eccentricity (mm)"),
    "peak_displacement": (1e3, "largest displacement (mm)"),
    "peak_acceleration": (1.0 / GRAVITY, "largest absolute acceleration (g)"),
    "peak_transmitted_force": (0.0, "largest transmitted force ({})"),
    "transmissibility": (1.0, "transmissibility of the force (–)"),
    "peak_force.right": (0.0, "largest force of the right stop ({})"),
    "peak_force.left": (0.0, "largest force of the left stop ({})"),
    "peak_force": (0.0, "largest contact force ({})"),
    "peak_impulse": (0.0, "largest impulse ({})"),
}
"""Factor and label. A force or an impulse is drawn in a unit of fitting size."""


def axis_label(values: xr.DataArray, quantity: str) -> tuple[float, str]:
    """Return factor and label of a quantity. Without an own label, its ``long_name`` is used."""
    base, _, part = quantity.partition(".")
    if quantity not in _LABELS and base in _LABELS and part and part not in SIDES:
        factor, label = axis_label(values, base)
        return factor, f"{part}: {label}"
    if quantity not in _LABELS:
        units = {"m": "mm", "m s-2": "m/s²", "1": "–"}
        unit = str(values.attrs.get("units", "1"))
        name = str(values.attrs.get("long_name", quantity.partition(".")[0].replace("_", " ")))
        if "stop" not in values.dims:
            name = of_part(name, quantity)
        return in_unit(1e3) if unit == "m" else 1.0, f"{name} ({units.get(unit, unit)})"
    factor, label = _LABELS[quantity]
    if factor == 0.0:
        fits = (IMPULSE if quantity == "peak_impulse" else FORCE).unit(*values.values.ravel())
        return 1.0 / fits.size, label.format(fits.symbol)
    return in_unit(factor), label


def of_part(name: str, quantity: str) -> str:
    """Name the stop, mass or link of a quantity, such as ``"impact_count.right"``."""
    part = quantity.partition(".")[2]
    kind = re.search(r"the ((?:rigid )?stop)\b", name)
    if kind is None:
        return f"{part}: {name}" if part else name
    stop = kind[1]
    which = f"the {part} {stop}" if part in SIDES else f"{stop} {part}" if part else f"any {stop}"
    return name.replace(kind[0], which)
