"""Motions: kind, evidence, extremes, energies and contacts, as plain values and as text."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.datasets.description import base_at_rest, noted, status_facts, stop_word
from vibroimpact.datasets.stops import plain_values
from vibroimpact.facts.number_format import written
from vibroimpact.facts.tables import (
    Column,
    Row,
    sheet_of,
    table_of,
    values_along,
    values_text,
)
from vibroimpact.model.frequency_text import forcing
from vibroimpact.model.written_units import unit
from vibroimpact.response.plausibility import STIFF

_MOST_CONTACTS = 12
"""Contacts that are printed of a motion; the file has them all."""

_STATUS = ("status", "mirror_distance")

_SPEEDS = ("contact_start_velocity", "contact_end_velocity")
_CONTACTS = (
    Column("side", lambda one: _side(one), left=True),
    Column("phase (°)", lambda one: math.degrees(one["contact_start_phase"]), "{:.1f}"),
    Column("length/T", "contact_duration_share", "{:.4f}"),
    Column("u̇ in", "contact_start_velocity", "{:.2f}", like=_SPEEDS),
    Column("u̇ out", "contact_end_velocity", "{:.2f}", like=_SPEEDS),
    Column("force", "contact_peak_force", 3),
    Column("J", "contact_impulse", 3),
    Column("depth", "contact_penetration", 3),
    Column("lost", "contact_dissipated", 3),
    Column("e (–)", "contact_restitution", "{:.3f}"),
)

_ENDS = ("displacement_min", "displacement_max")
_FORCES = ("transmitted_force_min", "transmitted_force_max")
_ENERGIES = ("energy_supplied", "energy_bumpers")
_ROWS = (
    Row("evidence", lambda data: str(data.attrs["evidence"])),
    Row("note", lambda data: _slow(data), applies=lambda data: _slow(data)),
    Row("exponents", lambda data: _exponents(data), of=("exponents_cycles",)),
    Row("displacement", _ENDS, 5),
    Row("eccentricity", "eccentricity", like=_ENDS),
    Row("acceleration", ("acceleration_min", "acceleration_max"), 5, words="{} (absolute)"),
    Row(  # if the base moves, it is in proportion to the absolute acceleration
        "transmitted force",
        lambda data: _force(data),
        applies=base_at_rest,
        of=(*_FORCES, "transmissibility"),
    ),
    Row(
        "impacts",
        lambda data: f"{values_text(data, 'impacts')} per cycle{_pressed(data)}",
        of=("impacts",),
    ),
)
"""Rows of a motion. Other numbers of it, which no row has, follow before `_LAST_ROWS`."""
_LAST_ROWS = (
    Row("energy", lambda data: _energy(data), of=_ENERGIES),
    Row(
        "reached from",
        lambda data: str(data.attrs["starts"]),
        applies=lambda data: data.attrs.get("starts"),
    ),
    Row(
        "mirror image",
        lambda data: str(data.attrs["mirrored_starts"]),
        words="reached from {}",
        applies=lambda data: data.attrs.get("mirrored_starts"),
    ),
)
_UNWRITTEN = (
    *("motion", "period", "stable", "antisymmetric", "mirror_pair"),  # in the heading
    *("displacement_excursion", "acceleration_excursion", "transmitted_force_excursion"),
    *("energy_isolator", "effective_damping", "cycles"),
)
"""Numbers of a motion that no row has, and that are only in the JSON output."""

_STABILITY = {1: "stable", 0: "unstable", -1: "neutral (disturbances neither grow nor decay)"}

_BRANCHES = ("forward branch", "backward branch")
"""Names of motions that a sweep leads to."""

Found = dict[float, dict[str, xr.Dataset]]
"""Motions by name, by frequency."""


def facts(by_frequency: Found) -> list[dict[str, Any]]:
    """Return kind, extremes and contacts of the motions, in SI units."""
    return [
        {"frequency": hertz, "name": name, **_facts(data)}
        for hertz, motions in by_frequency.items()
        for name, data in motions.items()
    ]


def text(by_frequency: Found) -> RenderableType:
    """Return the same as tables."""
    parts: list[RenderableType] = []
    for hertz, motions in by_frequency.items():
        many = f"{len(motions)} motions coexist" if len(motions) > 1 else _only(motions)
        parts += [Text(), Text(f"{forcing(hertz, 10)}: {many}", style="bold")]
        for name, data in motions.items():
            parts += [Text(), *_motion(name, data)]
    return Group(*parts)


def columns(by_frequency: Found, most: int) -> dict[str, dict[str, xr.Dataset]]:
    """Return the columns of a page: motions of one frequency (so many at most), or frequencies."""
    if len(by_frequency) > 1:
        return {forcing(hertz): motions for hertz, motions in by_frequency.items()}
    ((hertz, motions),) = by_frequency.items()
    named = list(motions.items())[:most]
    return {f"{forcing(hertz)}, {name}": {name: data} for name, data in named}


def _only(motions: dict[str, xr.Dataset]) -> str:
    """Return the heading of a single motion; others may coexist unless all starts were tried."""
    ((name, data),) = motions.items()
    if name in _BRANCHES and "starts" not in data.attrs:
        return f"the motion of the {name}; others may coexist with it"
    return "one motion found"


def _facts(data: xr.Dataset) -> dict[str, Any]:
    values: dict[str, Any] = {name: plain_values(data[name]) for name in _numbers(data)}
    values["exponents"] = data["exponents"].values.tolist()
    values["exponents_uncertainty"] = data["exponents_uncertainty"].values.tolist()
    values |= {**status_facts(data), "evidence": data.attrs["evidence"]}
    values["starts"] = data.attrs.get("starts", "")
    values["mirrored_starts"] = data.attrs.get("mirrored_starts", "")
    values["contacts"] = values_along(data, "contact_number", prefix="contact_")
    return values


def _numbers(data: xr.Dataset) -> list[str]:
    """Return the numbers of a motion, by stop or of the whole motion."""
    return [
        str(name)
        for name, values in data.data_vars.items()
        if set(values.dims) <= {"stop"} and name not in _STATUS
    ]


def _by_stop(data: xr.Dataset, name: str) -> str:
    """Return a number of a motion with its unit, or that of each stop."""
    numbers = plain_values(data[name])
    values = numbers if isinstance(numbers, dict) else {"": numbers}
    finite = [one for one in values.values() if math.isfinite(one)]
    return ", ".join(
        f"{written(name, one, like=finite or (one,))} {stop}".rstrip()
        for stop, one in values.items()
    )


def words(data: xr.Dataset) -> str:
    """Return the kind of a motion and the evidence for it in one line."""
    return f"{', '.join(_kind(data))}: {data.attrs['evidence']}"


def _kind(data: xr.Dataset) -> list[str]:
    kind = data["motion"].item()
    said = [f"{kind}, period {int(data['period'])}" if kind == "periodic" else kind]
    if kind == "periodic":
        said.append(_STABILITY[int(data["stable"])])
    said.append("antisymmetric" if bool(data["antisymmetric"]) else "not antisymmetric")
    if "mirror_pair" in data and bool(data["mirror_pair"]):
        said.append("its mirror image is another motion")
    return said


def _motion(name: str, data: xr.Dataset) -> list[RenderableType]:
    written_ones = {one for row in (*_ROWS, *_LAST_ROWS) for one in row.variables}
    others = [
        Row(one.replace("_", " "), partial(_by_stop, name=one))
        for one in _numbers(data)
        if one not in written_ones and one not in _UNWRITTEN
    ]
    heading = Text(f"{name}: {', '.join(_kind(data))}", style="bold")
    return [heading, sheet_of(data, (*_ROWS, *others, *_LAST_ROWS)), contact_table(data)]


def _slow(data: xr.Dataset) -> str:
    """Return the notes on stops that make the computation slow, a line each."""
    return "\n".join(line for line in noted(data) if line.startswith(STIFF))


def _force(data: xr.Dataset) -> str:
    """Return the force on the base, and its ratio to the exciting force."""
    forces = values_text(data, _FORCES, digits=5)
    return f"{forces}, transmissibility {values_text(data, 'transmissibility')}"


def _energy(data: xr.Dataset) -> str:
    """Return the energy that is supplied, and what of it is lost in the stops."""
    supplied, lost = (values_text(data, one, like=_ENERGIES) for one in _ENERGIES)
    return f"{supplied} per cycle, {lost} of it lost in the {stop_word(data)}s"


def _pressed(data: xr.Dataset) -> str:
    """Return a remark on stops that the mass never leaves."""
    pressed = (data["impacts"] == 0) & data["touching"].all("time")
    sides = data["stop"].values[pressed.values].tolist()
    if len(sides) == 2:
        return "; both stops stay pressed"
    return f"; the {sides[0]} stop stays pressed" if sides else ""


def _exponents(data: xr.Dataset) -> str:
    """The Lyapunov exponents, with their uncertainty where they are averages."""
    values, spreads = data["exponents"].values, data["exponents_uncertainty"].values
    if int(data["period"]) and int(data["exponents_cycles"]) <= 2 * int(data["period"]):
        both = f"{values[0]:+.5g} and {values[1]:+.5g}"
        return f"{both}{unit(' 1/s')}, from the multipliers of the orbit"
    first, second = (
        f"{value:+.4g} ± {spread:.1g}" for value, spread in zip(values, spreads, strict=True)
    )
    return f"{first} and {second}{unit(' 1/s')}, over {int(data['exponents_cycles'])} cycles"


def contact_table(data: xr.Dataset) -> RenderableType:
    """The contacts of a motion, in units that fit the largest of each."""
    count = data.sizes["contact_number"]
    if not count:
        return Text("no contact")
    title = "Contacts" if count <= _MOST_CONTACTS else f"Contacts, {_MOST_CONTACTS} of {count}"
    rows = values_along(data.isel(contact_number=slice(_MOST_CONTACTS)), "contact_number")
    return table_of(rows, _CONTACTS, title, padding=1)


def _side(one: dict[str, Any]) -> str:
    return f"{one['contact_stop']}{', grazing' if one['contact_grazing'] else ''}"
