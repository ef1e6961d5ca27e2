"""Several masses: the rig, and the largest responses of a motion by mass, link and stop."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from vibroimpact.facts.number_format import plain, shown_in, with_unit
from vibroimpact.facts.status import status_facts
from vibroimpact.facts.tables import plain_table, titled_table
from vibroimpact.model import Assembly, RigidStop
from vibroimpact.model.quantities import FORCE, MASS, Quantity
from vibroimpact.model.units import pretty
from vibroimpact.model.written_units import NONE, unit, unitless
from vibroimpact.response.contacts import contacts
from vibroimpact.response.totals import totals

_DIGITS = 4
_MASSES = ("peak_displacement", "displacement_max", "displacement_min", "peak_acceleration")


def rig_facts(assembly: Assembly) -> dict[str, Any]:
    """Return an assembly in SI units, and its natural frequencies (Hz)."""
    return {
        "assembly": assembly.model_dump(),
        "natural_frequencies": assembly.natural_frequencies.tolist(),
        "damping_ratios": assembly.damping_ratios.tolist(),
    }


def rig_text(assembly: Assembly, shaking: Iterable[str] = ()) -> RenderableType:
    """Return the masses, the links and the stops of an assembly, and its natural frequencies."""
    table = plain_table()
    for name in assembly.names:
        size = pretty(assembly.masses[name], MASS) if name in assembly.masses else "of the matrices"
        force = assembly.forces.get(name, 0.0)
        table.add_row(
            f"mass {name}", size, f"constant force {pretty(force, FORCE)}" if force else ""
        )
    for word, parts in (("link", assembly.links), ("stop", assembly.stops)):
        for name, link in parts.items():
            table.add_row(f"{word} {name}", link.law.summary(), f"{link.left} → {link.right}")
    if assembly.units == NONE:
        table.add_row("units", "none; frequencies are angular, ω = 2π f", "")
    if words := list(shaking):
        table.add_row(*words)
    turn = math.tau if unitless() else 1.0
    found = ", ".join(plain(turn * one, 4) for one in assembly.natural_frequencies)
    table.add_row("natural frequencies", f"{found}{unit(' Hz')}", "")
    return table


def largest(motion: xr.Dataset) -> dict[str, Any]:
    """Return the exact extremes of a motion by mass, link and stop, in SI units.

    A rigid stop has the largest impulse of an impact, and no force.
    """
    found, log = totals(motion), contacts(motion)
    assembly = assembly_of(motion)
    stops = {}
    for name, stop in assembly.stops.items():
        mine = log["contact_stop"].values == name
        of: dict[str, Any] = {"contacts": int(mine.sum())}
        if isinstance(stop.law, RigidStop):
            of["peak_impulse"] = float(log["contact_impulse"].values[mine].max(initial=0.0))
        else:
            of["peak_force"] = float(found["peak_force"].sel(stop=name))
        stops[name] = of
    return {
        "masses": {
            name: {what: float(found[what].sel(mass=name)) + 0.0 for what in _MASSES}
            for name in assembly.names
        },
        "links": {
            str(name): {"peak_drift": float(found["peak_drift"].sel(link=name))}
            for name in found["link"].values
        },
        "stops": stops,
        "peak_transmitted_force": float(found["peak_transmitted_force"]),
    }


def assembly_of(data: xr.Dataset) -> Assembly:
    """Return the assembly of a dataset."""
    parameters = json.loads(data.attrs["parameters"])
    return Assembly.model_validate(parameters.get("rigs", [parameters])[0]["assembly"])


def largest_text(found: Mapping[str, Any], title: str = "Largest") -> RenderableType:
    """Return largest values as tables: by mass, link and stop."""
    parts: list[RenderableType] = [
        by_name(
            f"{title}, by mass",
            "mass",
            found["masses"],
            {
                "displacement_max": ("to the right", "m", 1.0),
                "displacement_min": ("to the left", "m", -1.0),
                "peak_acceleration": ("acceleration", "m s-2", 1.0),
            },
        )
    ]
    if found["links"]:
        columns = {"peak_drift": ("deformation", "m", 1.0)}
        parts += [Text(), by_name(f"{title}, by link", "link", found["links"], columns)]
    if found["stops"]:
        parts += [Text(), stops_table(f"{title}, by stop", found["stops"])]
    return Group(*parts)


def stops_table(
    title: str, stops: Mapping[str, Mapping[str, Any]], contacts: str = "contacts"
) -> Table:
    """Return the forces, the impulses and the contacts of stops as a table."""
    columns = {
        "peak_force": ("force", "N", 1.0),
        "peak_impulse": ("impulse", "N s", 1.0),
        "contacts": (contacts, "1", 1.0),
    }
    some = {key for one in stops.values() for key in one}
    return by_name(title, "stop", stops, {k: v for k, v in columns.items() if k in some})


def by_name(
    title: str,
    what: str,
    rows: Mapping[str, Mapping[str, float]],
    columns: Mapping[str, tuple[str, str, float]],
) -> Table:
    """Return values as a table with a row for each name, and a column for each quantity.

    Parameters
    ----------
    title
        Title of the table.
    what
        Heading of the names.
    rows
        Values by name and quantity, in SI units.
    columns
        Heading, unit and sign of each quantity.
    """
    table = titled_table(title, what)
    scales = {}
    for key, (heading, units, _) in columns.items():
        values = [one[key] for one in rows.values() if key in one]
        scales[key] = shown_in(units, [abs(one) for one in values])
        symbol = scales[key].symbol
        table.add_column(heading if units == "1" else with_unit(heading, symbol), justify="right")
    for name, row in rows.items():
        cells = [
            plain(sign * row[key] / (1.0 if units == "1" else scales[key].size), _DIGITS)
            if key in row
            else ""
            for key, (_, units, sign) in columns.items()
        ]
        table.add_row(name, *cells)
    return table


def motion_facts(motion: xr.Dataset) -> dict[str, Any]:
    """Return the end of a motion of an assembly, and its exact extremes, in SI units."""
    parameters = _parameters(motion)
    found: dict[str, Any] = {"time": float(motion["time"].values[-1])}
    if "cycle" in motion:
        found = {
            "frequency": parameters["frequency"],
            "cycles": float(motion["cycle"].values[-1]),
            **found,
        }
    values = zip(motion["component"].values, motion["final_state"].values.tolist(), strict=True)
    return {
        **found,
        "final_state": {str(name): value + 0.0 for name, value in values},
        "largest": largest(motion),
        "simultaneous_impacts": int(motion["simultaneous_impacts"]),
        **status_facts(motion),
    }


def motion_text(found: Mapping[str, Any]) -> RenderableType:
    """Return the facts of a motion as text."""
    span = f"{plain(found['time'], 6)}{unit(' s')}"
    if "cycles" in found:
        span = f"{plain(found['cycles'])} cycles ({span})"
    parts: list[RenderableType] = [
        Text(f"Motion over {span}"),
        Text(),
        largest_text(found["largest"]),
        Text(),
        Text(f"Largest force on the base: {_size(found['largest']['peak_transmitted_force'])}"),
    ]
    if found["simultaneous_impacts"]:
        parts.append(
            Text(
                f"Note: the order of the stops decided {found['simultaneous_impacts']} "
                "simultaneous impacts"
            )
        )
    return Group(*parts)


def floor_facts(floor: xr.Dataset) -> dict[str, dict[str, float]]:
    """Return the largest value of the floor spectrum of each mass, and its natural period."""
    found = {}
    for mass in floor["mass"].values.tolist():
        curve = floor["spectral_acceleration"].sel(mass=mass)
        largest = curve.isel(natural_period=int(np.argmax(curve.values)))
        found[mass] = {
            "spectral_acceleration": float(largest),
            "natural_period": float(largest["natural_period"]),
        }
    return found


def floor_text(found: Mapping[str, Mapping[str, float]]) -> RenderableType:
    """Return the largest values of floor spectra as a table."""
    columns = {
        "spectral_acceleration": ("acceleration", "m s-2", 1.0),
        "natural_period": ("at period", "s", 1.0),
    }
    return by_name("Largest of the floor spectrum, ζ = 0.05", "mass", found, columns)


def _size(force: float, quantity: Quantity = FORCE) -> str:
    return pretty(float(f"{force:.4g}"), quantity) if math.isfinite(force) else "infinite"


def _parameters(data: xr.Dataset) -> dict[str, Any]:
    parameters: dict[str, Any] = json.loads(data.attrs["parameters"])
    return parameters


def steady_facts(motion: xr.Dataset) -> dict[str, Any]:
    """Return the type of a steady motion of an assembly, its evidence and its extremes."""
    exponents = motion["exponents"].values.tolist()
    return {
        "frequency": _parameters(motion)["frequency"],
        "motion": str(motion["motion"].values),
        "period": int(motion["period"]),
        "evidence": motion.attrs.get("evidence", ""),
        "exponents": exponents,
        "largest": largest(motion),
        **status_facts(motion),
    }


def steady_text(found: Mapping[str, Any]) -> RenderableType:
    """Return the facts of a steady motion as text."""
    period = f" of period {found['period']}" if found["period"] else ""
    return Group(
        Text(f"The motion that is reached from the start is {found['motion']}{period}"),
        Text(f"Evidence: {found['evidence']}"),
        Text(),
        largest_text(found["largest"]),
    )
