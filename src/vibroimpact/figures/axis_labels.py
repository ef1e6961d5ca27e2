"""Axis labels of the quantities of sweeps, branches and ensembles."""

from __future__ import annotations

import xarray as xr

from vibroimpact.figures.own_units import in_unit
from vibroimpact.model.quantities import FORCE, GRAVITY

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
}
"""Factor and label. A force is drawn in a unit of fitting size."""


def axis_label(values: xr.DataArray, quantity: str) -> tuple[float, str]:
    """Return factor and label of a quantity. Without an own label, its ``long_name`` is used."""
    if quantity not in _LABELS:
        units = {"m": "mm", "m s-2": "m/s²", "1": "–"}
        unit = str(values.attrs.get("units", "1"))
        name = values.attrs.get("long_name", quantity.replace("_", " "))
        return in_unit(1e3) if unit == "m" else 1.0, f"{name} ({units.get(unit, unit)})"
    factor, label = _LABELS[quantity]
    if factor == 0.0:
        fits = FORCE.unit(*values.values.ravel())
        return 1.0 / fits.size, label.format(fits.symbol)
    return in_unit(factor), label
