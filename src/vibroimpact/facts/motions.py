"""Motions: kind, evidence, extremes, energies and contacts, as plain values and as text."""

from __future__ import annotations

import math
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from vibroimpact.datasets.description import base_at_rest, noted, stop_word
from vibroimpact.datasets.stops import SIDES, of_stop, plain_values
from vibroimpact.facts.number_format import with_unit
from vibroimpact.facts.status import status_facts
from vibroimpact.model.frequency_text import forcing
from vibroimpact.model.quantities import (
    ACCELERATION,
    ENERGY,
    FORCE,
    IMPULSE,
    LENGTH,
    VELOCITY,
    fitting,
)
from vibroimpact.model.units import plain
from vibroimpact.model.written_units import unit
from vibroimpact.response.plausibility import STIFF

_MOST_CONTACTS = 12
"""Contacts that are printed of a motion; the file has them all."""

_SCALARS = (
    "motion",
    "period",
    "stable",
    "antisymmetric",
    "displacement_max",
    "displacement_min",
    "displacement_excursion",
    "acceleration_max",
    "acceleration_min",
    "acceleration_excursion",
    "transmitted_force_max",
    "transmitted_force_min",
    "transmitted_force_excursion",
    "transmissibility",
    "eccentricity",
    "impacts",
    "energy_supplied",
    "energy_isolator",
    "energy_bumpers",
    "effective_damping",
    "cycles",
    "exponents_cycles",
    "mirror_pair",
)

_STABILITY = {1: "stable", 0: "unstable", -1: "neutral (disturbances neither grow nor decay)"}

_BRANCHES = ("forward branch", "backward branch")
"""Names of motions that a sweep leads to."""

Found = dict[float, dict[str, xr.Dataset]]
"""Motions by name, by frequency."""


def facts(found: Found) -> list[dict[str, Any]]:
    """Return kind, extremes and contacts of the motions, in SI units."""
    return [
        {"frequency": hertz, "name": name, **_facts(data)}
        for hertz, motions in found.items()
        for name, data in motions.items()
    ]


def text(found: Found) -> RenderableType:
    """Return the same as tables."""
    parts: list[RenderableType] = []
    for hertz, motions in found.items():
        many = f"{len(motions)} motions coexist" if len(motions) > 1 else _only(motions)
        parts += [Text(), Text(f"{forcing(hertz, 10)}: {many}", style="bold")]
        for name, data in motions.items():
            parts += [Text(), *_motion(name, data)]
    return Group(*parts)


def columns(found: Found, most: int) -> dict[str, dict[str, xr.Dataset]]:
    """Return the columns of a page: motions of one frequency (so many at most), or frequencies."""
    if len(found) > 1:
        return {forcing(hertz): motions for hertz, motions in found.items()}
    ((hertz, motions),) = found.items()
    named = list(motions.items())[:most]
    return {f"{forcing(hertz)}, {name}": {name: data} for name, data in named}


def _only(motions: dict[str, xr.Dataset]) -> str:
    """Return the heading of a single motion; others may coexist unless all starts were tried."""
    ((name, data),) = motions.items()
    if name in _BRANCHES and "starts" not in data.attrs:
        return f"the motion of the {name}; others may coexist with it"
    return "one motion found"


def _facts(data: xr.Dataset) -> dict[str, Any]:
    values: dict[str, Any] = {name: plain_values(data[name]) for name in _SCALARS if name in data}
    values["exponents"] = data["exponents"].values.tolist()
    values["exponents_uncertainty"] = data["exponents_uncertainty"].values.tolist()
    values |= {**status_facts(data), "evidence": data.attrs["evidence"]}
    values["starts"] = data.attrs.get("starts", "")
    values["mirrored_starts"] = data.attrs.get("mirrored_starts", "")
    rows = {
        str(name).removeprefix("contact_"): data[name].values.tolist()
        for name in data
        if data[name].dims == ("contact_number",)
    }
    values["contacts"] = [
        dict(zip(rows, row, strict=True)) for row in zip(*rows.values(), strict=True)
    ]
    return values


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
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2))
    table.add_column(style="bold")
    table.add_column()
    low, high = data["displacement_min"].item(), data["displacement_max"].item()
    middle = _rounded(data["eccentricity"].item(), high - low)
    _, size, metres = fitting((low, high), LENGTH.scales)
    supplied, lost = data["energy_supplied"].item(), data["energy_bumpers"].item()
    _, joule, joules = fitting((supplied, lost), ENERGY.scales)
    floor, ceiling = data["acceleration_min"].item(), data["acceleration_max"].item()
    _, g, gravity = fitting((floor, ceiling), ACCELERATION.scales)
    rows = [
        ("evidence", data.attrs["evidence"]),
        *(("note", line) for line in noted(data) if line.startswith(STIFF)),
        ("exponents", _exponents(data)),
        ("displacement", f"{plain(low / size, 5)} to {plain(high / size, 5)}{_gap(metres)}"),
        ("eccentricity", f"{plain(middle / size, 4)}{_gap(metres)}"),
        (
            "acceleration",
            f"{plain(floor / g, 5)} to {plain(ceiling / g, 5)}{_gap(gravity)} (absolute)",
        ),
        *_transmitted(data),
        (
            "impacts",
            ", ".join(f"{plain(of_stop(data, 'impacts', side).item(), 4)} {side}" for side in SIDES)
            + f" per cycle{_pressed(data)}",
        ),
        (
            "energy",
            f"{plain(supplied / joule, 4)}{_gap(joules)} per cycle, "
            f"{plain(lost / joule, 4)}{_gap(joules)} of it lost in the {stop_word(data)}s",
        ),
    ]
    if data.attrs.get("starts"):
        rows.append(("reached from", data.attrs["starts"]))
    if data.attrs.get("mirrored_starts"):
        rows.append(("mirror image", f"reached from {data.attrs['mirrored_starts']}"))
    for row in rows:
        table.add_row(*row)
    return [Text(f"{name}: {', '.join(_kind(data))}", style="bold"), table, *contact_tables(data)]


def _transmitted(data: xr.Dataset) -> list[tuple[str, str]]:
    """Return the force on the base under a force on the mass.

    If the base moves, it is in proportion to the absolute acceleration.
    """
    if not base_at_rest(data):
        return []
    low, high = (data[f"transmitted_force_{end}"].item() for end in ("min", "max"))
    _, size, newtons = fitting((low, high), FORCE.scales)
    ratio = data["transmissibility"].item()
    told = f"{plain(low / size, 5)} to {plain(high / size, 5)}{_gap(newtons)}"
    return [("transmitted force", f"{told}, transmissibility {plain(ratio, 4)}")]


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


def _gap(symbol: str) -> str:
    """A unit that may be empty, after a number."""
    return f" {symbol}" if symbol else ""


def _rounded(value: float, scale: float) -> float:
    """Zero for what is only rounding."""
    return value if abs(value) > 1e-9 * scale else 0.0


def contact_tables(data: xr.Dataset) -> list[RenderableType]:
    """The contacts of a motion, in units that fit the largest of each."""
    count = data.sizes["contact_number"]
    if not count:
        return [Text("no contact")]
    table = Table(
        "side",
        box=None,
        pad_edge=False,
        padding=(0, 1, 0, 1),
        header_style="dim",
        title="Contacts" if count <= _MOST_CONTACTS else f"Contacts, {_MOST_CONTACTS} of {count}",
        title_justify="left",
        title_style="",
    )
    shown = data.isel(contact_number=slice(_MOST_CONTACTS))

    def values(name: str) -> list[float]:
        return [float(value) for value in shown[f"contact_{name}"].values]

    columns = [
        ("phase (°)", [f"{math.degrees(value):.1f}" for value in values("start_phase")]),
        ("length/T", [f"{value:.4f}" for value in values("duration_share")]),
    ]
    speeds = fitting(values("start_velocity") + values("end_velocity"), VELOCITY.scales)
    for heading, name in (("u̇ in", "start_velocity"), ("u̇ out", "end_velocity")):
        texts = [f"{value / speeds.size:.2f}" for value in values(name)]
        columns.append((with_unit(heading, speeds.symbol), texts))
    for heading, name, scales in (
        ("force", "peak_force", FORCE.scales),
        ("J", "impulse", IMPULSE.scales),
        ("depth", "penetration", LENGTH.scales),
        ("lost", "dissipated", ENERGY.scales),
    ):
        found = values(name)
        _, unit, symbol = fitting(found, scales)
        columns.append((with_unit(heading, symbol), [plain(value / unit, 3) for value in found]))
    columns.append(("e (–)", [f"{value:.3f}" for value in values("restitution")]))
    for heading, _ in columns:
        table.add_column(heading, justify="right")
    for i in range(shown.sizes["contact_number"]):
        side = str(data["contact_stop"].values[i])
        if bool(data["contact_grazing"][i]):
            side += ", grazing"
        table.add_row(side, *(texts[i] for _, texts in columns))
    return [table]
