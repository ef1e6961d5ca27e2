"""Several masses: the rig, and the largest responses of a motion by mass, link and stop."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.datasets.description import motion_parameters, parameters_of_rigs, status_facts
from vibroimpact.facts.number_format import written
from vibroimpact.facts.tables import Column, sheet, table_of
from vibroimpact.model import Assembly
from vibroimpact.model.quantities import FORCE, MASS
from vibroimpact.model.units import plain, pretty
from vibroimpact.model.written_units import unit, unitless
from vibroimpact.response.contacts import contacts
from vibroimpact.response.totals import totals

_MASSES = ("peak_displacement", "displacement_max", "displacement_min", "peak_acceleration")
_LARGEST = {
    "masses": (
        Column("mass", "mass", left=True),
        Column("to the right", "displacement_max"),
        Column("to the left", lambda one: 0.0 - one["displacement_min"], units="m"),
        Column("acceleration", "peak_acceleration"),
    ),
    "links": (Column("link", "link", left=True), Column("deformation", "peak_drift")),
    "stops": (
        Column("stop", "stop", left=True),
        Column("force", "peak_force"),
        Column("impulse", "peak_impulse"),
        Column("contacts", "contacts"),
    ),
}


def rig_facts(assembly: Assembly) -> dict[str, Any]:
    """Return an assembly in SI units, and its natural frequencies (Hz)."""
    return {
        "assembly": assembly.model_dump(),
        "natural_frequencies": assembly.natural_frequencies.tolist(),
        "damping_ratios": assembly.damping_ratios.tolist(),
    }


def rig_text(assembly: Assembly, shaking: Sequence[str] = ()) -> RenderableType:
    """Return the masses, the links and the stops of an assembly, and its natural frequencies."""
    turn = math.tau if unitless() else 1.0
    frequencies = ", ".join(plain(turn * one, 4) for one in assembly.natural_frequencies)
    rows = [
        *(_mass(assembly, name) for name in assembly.names),
        *(
            (f"{word} {name}", link.law.summary(), f"{link.left} → {link.right}")
            for word, parts in (("link", assembly.links), ("stop", assembly.stops))
            for name, link in parts.items()
        ),
        *([("units", "none; frequencies are angular, ω = 2π f")] if unitless() else []),
        *([tuple(shaking)] if shaking else []),
        ("natural frequencies", f"{frequencies}{unit(' Hz')}"),
    ]
    return sheet(rows)


def _mass(assembly: Assembly, name: str) -> tuple[str, ...]:
    size = pretty(assembly.masses[name], MASS) if name in assembly.masses else "of the matrices"
    force = assembly.forces.get(name, 0.0)
    return f"mass {name}", size, f"constant force {pretty(force, FORCE)}" if force else ""


def largest(motion: xr.Dataset) -> dict[str, Any]:
    """Return the exact extremes of a motion by mass, link and stop, in SI units.

    A rigid stop has the largest impulse of an impact, and no force.
    """
    extrema, log = totals(motion), contacts(motion)
    assembly = assembly_of(motion)
    stops = {}
    for name, stop in assembly.stops.items():
        mine = log["contact_stop"].values == name
        of: dict[str, Any] = {"contacts": int(mine.sum())}
        if stop.stop.rigid:
            of["peak_impulse"] = float(log["contact_impulse"].values[mine].max(initial=0.0))
        else:
            of["peak_force"] = float(extrema["peak_force"].sel(stop=name))
        stops[name] = of
    return {
        "masses": {
            name: {what: float(extrema[what].sel(mass=name)) + 0.0 for what in _MASSES}
            for name in assembly.names
        },
        "links": {
            str(name): {"peak_drift": float(extrema["peak_drift"].sel(link=name))}
            for name in extrema["link"].values
        },
        "stops": stops,
        "peak_transmitted_force": float(extrema["peak_transmitted_force"]),
    }


def assembly_of(data: xr.Dataset) -> Assembly:
    """Return the assembly of a dataset."""
    return Assembly.model_validate(parameters_of_rigs(data)[0]["assembly"])


def largest_text(values: Mapping[str, Any]) -> RenderableType:
    """Return largest values as tables: by mass, link and stop."""
    tables: list[RenderableType] = []
    for parts, (name, *columns) in _LARGEST.items():
        rows = [{name.name: part, **one} for part, one in values[parts].items()]
        some = {key for row in rows for key in row}
        chosen = [one for one in columns if callable(one.value) or one.value in some]
        if rows:
            tables += [Text(), table_of(rows, (name, *chosen), f"Largest, by {name.name}")]
    return Group(*tables[1:])


def motion_facts(motion: xr.Dataset) -> dict[str, Any]:
    """Return the end of a motion of an assembly, and its exact extremes, in SI units."""
    cycles = {}
    if "cycle" in motion:
        frequency = motion_parameters(motion)["frequency"]
        cycles = {"frequency": frequency, "cycles": float(motion["cycle"].values[-1])}
    values = zip(motion["component"].values, motion["final_state"].values.tolist(), strict=True)
    return {
        **cycles,
        "time": float(motion["time"].values[-1]),
        "final_state": {str(name): value + 0.0 for name, value in values},
        "largest": largest(motion),
        "simultaneous_impacts": int(motion["simultaneous_impacts"]),
        **status_facts(motion),
    }


def motion_text(summary: Mapping[str, Any]) -> RenderableType:
    """Return the facts of a motion as text."""
    span = f"{plain(summary['time'], 6)}{unit(' s')}"
    if "cycles" in summary:
        span = f"{plain(summary['cycles'])} cycles ({span})"
    force = written("peak_transmitted_force", summary["largest"]["peak_transmitted_force"])
    parts: list[RenderableType] = [
        Text(f"Motion over {span}"),
        Text(),
        largest_text(summary["largest"]),
        Text(),
        Text(f"Largest force on the base: {force}"),
    ]
    if count := summary["simultaneous_impacts"]:
        parts.append(Text(f"Note: the order of the stops decided {count} simultaneous impacts"))
    return Group(*parts)


_FLOOR = (
    Column("mass", "mass", left=True),
    Column("acceleration", "spectral_acceleration"),
    Column("at period", "natural_period"),
)


def floor_facts(floor: xr.Dataset) -> dict[str, dict[str, float]]:
    """Return the largest value of the floor spectrum of each mass, and its natural period."""
    peaks = {}
    for mass in floor["mass"].values.tolist():
        curve = floor["spectral_acceleration"].sel(mass=mass)
        largest = curve.isel(natural_period=int(np.argmax(curve.values)))
        peaks[mass] = {
            "spectral_acceleration": float(largest),
            "natural_period": float(largest["natural_period"]),
        }
    return peaks


def floor_text(peaks: Mapping[str, Mapping[str, float]]) -> RenderableType:
    """Return the largest values of floor spectra as a table."""
    rows = [{"mass": name, **one} for name, one in peaks.items()]
    return table_of(rows, _FLOOR, "Largest of the floor spectrum, ζ = 0.05")


def steady_facts(motion: xr.Dataset) -> dict[str, Any]:
    """Return the type of a steady motion of an assembly, its evidence and its extremes."""
    exponents = motion["exponents"].values.tolist()
    return {
        "frequency": motion_parameters(motion)["frequency"],
        "motion": str(motion["motion"].values),
        "period": int(motion["period"]),
        "evidence": motion.attrs.get("evidence", ""),
        "exponents": exponents,
        "largest": largest(motion),
        **status_facts(motion),
    }


def steady_text(summary: Mapping[str, Any]) -> RenderableType:
    """Return the facts of a steady motion as text."""
    period = f" of period {summary['period']}" if summary["period"] else ""
    return Group(
        Text(f"The motion that is reached from the start is {summary['motion']}{period}"),
        Text(f"Evidence: {summary['evidence']}"),
        Text(),
        largest_text(summary["largest"]),
    )
