"""Contents of the panels of resonance curves: η, or physical quantities in g, mm and kN."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from vibroimpact.datasets.description import (
    base_at_rest,
    excitation_from,
    own_outputs,
    parameters_of_rigs,
)
from vibroimpact.datasets.stops import over_stops
from vibroimpact.errors import InputError
from vibroimpact.figures.axis_labels import axis_label
from vibroimpact.figures.finish import base_label, in_unit
from vibroimpact.model import Oscillator, equilibrium
from vibroimpact.model.quantities import FORCE, GRAVITY, IMPULSE, Scale
from vibroimpact.model.rig import Rig
from vibroimpact.model.unbounded import has_no_bound
from vibroimpact.model.units import plain
from vibroimpact.model.written_units import unit as unit_of

_Array = NDArray[np.float64]

SEEN = 2.0
"""A gap is drawn unless it is larger than all displacements by this factor."""

_NIL = 1e-9
"""Equilibrium displacement (m) that counts as 0."""


class Level(NamedTuple):
    """A horizontal line."""

    value: float
    label: str
    style: dict[str, Any]

    def entry(self) -> Line2D:
        """Return the legend entry of the line."""
        return Line2D([], [], label=self.label, **self.style)


class Drawn(NamedTuple):
    """The contents of one panel, in the units of its axis."""

    name: str
    label: str
    curves: dict[str, _Array]
    """Curves by direction of the sweep."""
    free: _Array | None
    """The curve of the motion without stops."""
    levels: tuple[Level, ...] = ()
    spike: bool = False
    """Whether the motion without stops is unbounded, so that its curve leaves the panel."""

    @property
    def bottom(self) -> float:
        """Smallest value of all curves, at most 0."""
        return min(float(np.nanmin(curve, initial=0.0)) for curve in self.curves.values())

    @property
    def top(self) -> float:
        """Largest value of all curves."""
        free = [] if self.free is None or self.spike else [self.free]
        curves = [*self.curves.values(), *free]
        highest = [float(np.nanmax(curve, initial=0.0)) for curve in curves]
        return max([*highest, *(level.value for level in self.levels)])


def normalised(data: xr.Dataset) -> list[Drawn]:
    """Return the panels of η_a and η_d, and of the transmissibility under a force on the mass."""
    panels = []
    for symbol, kind, words in (
        ("a", "acceleration", "absolute acceleration"),
        ("d", "displacement", "relative displacement"),
    ):
        free = f"free_{kind}_excursion"
        panels.append(
            Drawn(
                f"η_{symbol}",
                base_label(f"normalised excursion of\n{words} $\\eta_{symbol}$ (–)", [data]),
                _curves(data, f"eta_{symbol}", 1.0),
                data[free].values / data[f"largest_{free}"].values,
            )
        )
    if base_at_rest(data):
        exciting = (data["transmitted_force_excursion"] / data["transmissibility"]).max("direction")
        carried = data["free_transmitted_force_excursion"].values / exciting.values
        curves = _curves(data, "transmissibility", 1.0)
        label = "transmissibility\nof the force (–)"
        panels.append(Drawn("transmissibility", label, curves, carried))
    return panels


def outputs(data: xr.Dataset) -> list[Drawn]:
    """Return the panels of own outputs."""
    panels = []
    for name in own_outputs(data):
        factor, label = axis_label(data[name], name)
        panels.append(Drawn(name, label, _curves(data, name, factor), None))
    return panels


def draws_eta(data: xr.Dataset) -> bool:
    """Return whether figures show η by default, instead of physical quantities.

    They do if all rigs are those of published cases (see `Rig.published`) and η has a meaning; see
    `has_eta`.
    """
    return all(rig.get("published") for rig in parameters_of_rigs(data)) and has_eta(data)


def has_eta(data: xr.Dataset) -> bool:
    """Return whether η has a meaning: it has values, and the motion without stops is bounded.

    If the curves are divided by the response of an undamped isolator near its resonance, they are
    almost flat.
    """
    return "eta_d" in data and bool(data["eta_d"].notnull().any()) and not _spikes(data)


def _spikes(data: xr.Dataset) -> bool:
    """Return whether the motion without stops is unbounded, if the dataset is of only one rig."""
    rig = _rig(data)
    if rig is None:
        return False
    (about,) = parameters_of_rigs(data)
    sizes = about.get("amplitude")
    most = {"amplitude": max(sizes)} if isinstance(sizes, list) else {}
    return has_no_bound(Rig(rig, excitation_from(about, frequency=1.0, **most)))


def physical_curves(data: xr.Dataset, halves: Collection[str] = ()) -> list[Drawn]:
    """Return panels of the largest absolute acceleration, displacement and, if any, contact force.

    Under a force on the mass, there is also a panel of the force transmitted to the base. For the
    quantities in ``halves``, half the excursion is drawn. If a motion goes further to one
    side than to the other, half the excursion is smaller than the largest value.

    Raises
    ------
    InputError
        If a dataset of an older version does not contain the quantities.
    """
    if "peak_acceleration" not in data:
        raise InputError(
            "physical: this sweep has no peak_acceleration, which older versions did not compute; "
            "run the sweep again"
        )
    rig = _rig(data)
    spike = _spikes(data)
    rest = _rest(rig)
    swing = in_unit(1e3) * 0.5 * data["free_displacement_excursion"].values
    swings = _curves(data, "peak_displacement", in_unit(1e3))
    gaps = _gaps(rig, SEEN * max(np.nanmax(one, initial=0.0) for one in swings.values()))
    panels = [
        Drawn(
            "acceleration",
            "largest absolute\nacceleration (g)",
            _curves(data, "peak_acceleration", in_unit(1.0 / GRAVITY)),
            0.5 * in_unit(1.0 / GRAVITY) * data["free_acceleration_excursion"].values,
            spike=spike,
        ),
        Drawn(
            "displacement",
            base_label("largest relative\ndisplacement (mm)", [data]),
            swings,
            None if rest is None else swing + in_unit(1e3) * abs(rest),
            gaps,
            spike,
        ),
    ]
    if "acceleration" in halves:
        panels[0] = panels[0]._replace(
            label="half the excursion of\nabsolute acceleration (g)",
            curves=_curves(data, "acceleration_excursion", 0.5 * in_unit(1.0 / GRAVITY)),
        )
    if "displacement" in halves:  # whose middle is that between the stops where all is symmetric
        even = rig is not None and rig.left == rig.right and rest is not None and abs(rest) < _NIL
        panels[1] = panels[1]._replace(
            label=base_label("half the excursion of\nrelative displacement (mm)", [data]),
            curves=_curves(data, "displacement_excursion", 0.5 * in_unit(1e3)),
            free=swing,
            levels=gaps if even else (),
        )
    if base_at_rest(data):
        unit = peak_force_unit(data)
        curves = _curves(data, "peak_transmitted_force", 1.0 / unit.size)
        load = 0.0 if rig is None else abs(rig.force)
        free = (0.5 * data["free_transmitted_force_excursion"].values + load) / unit.size
        label = f"largest transmitted\nforce ({unit.symbol})"
        panels.append(Drawn("transmitted force", label, curves, free, spike=spike))
    for words, quantity in (("force", FORCE), ("impulse", IMPULSE)):
        sizes = _curves(data, f"peak_{words}", 1.0)
        # No impact on a rigid stop has a finite force.
        known = {key: np.where(np.isfinite(size), size, np.nan) for key, size in sizes.items()}
        largest = max(float(np.nanmax(size, initial=0.0)) for size in known.values())
        if largest > 0.0:
            unit = quantity.unit(largest)
            curves = {key: size / unit.size for key, size in known.items()}
            panels.append(Drawn(words, f"largest contact\n{words} ({unit.symbol})", curves, None))
    return panels


def peak_force_unit(data: xr.Dataset) -> Scale:
    """Return the unit in which the transmitted forces of a sweep are drawn."""
    return FORCE.unit(float(np.nanmax(data["peak_transmitted_force"].values, initial=0.0)))


def _curves(data: xr.Dataset, name: str, factor: float) -> dict[str, _Array]:
    return {
        str(direction): factor * over_stops(data[name].sel(direction=direction)).values
        for direction in data["direction"].values
    }


def _rig(data: xr.Dataset) -> Oscillator | None:
    """Return the rig that was swept, if the dataset holds only one rig."""
    rigs = parameters_of_rigs(data)
    return Oscillator.model_validate(rigs[0]["oscillator"]) if len(rigs) == 1 else None


def _rest(rig: Oscillator | None) -> float | None:
    """Return the equilibrium displacement on the isolator alone (m), or None if it is unknown."""
    if rig is None:
        return None
    try:
        return equilibrium(rig.without_bumpers()).displacement
    except InputError:  # stops hold it
        return None


def _gaps(rig: Oscillator | None, farthest: float) -> tuple[Level, ...]:
    """Return the gaps that lie within the range of the panel (mm)."""
    if rig is None:
        return ()
    gaps = {side: getattr(rig, side) for side in ("right", "left")}
    known = {side: in_unit(1e3) * stop.gap for side, stop in gaps.items() if stop is not None}
    if len(known) == 2 and known["right"] == known["left"]:
        known = {"": known["right"]}
    dashes = {"": ":", "right": ":", "left": (0, (1, 3))}
    return tuple(
        Level(
            gap,
            f"{side} gap, {plain(gap, 4)}{unit_of(' mm')}".strip(),
            {"color": "0.3", "linewidth": 1.1, "linestyle": dashes[side]},
        )
        for side, gap in known.items()
        if 0.0 < gap <= farthest
    )
