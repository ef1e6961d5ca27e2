"""What ``vibroimpact motion`` found, for people and for programs."""

from __future__ import annotations

from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

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
    "eccentricity",
    "impacts_right",
    "impacts_left",
    "energy_supplied",
    "energy_isolator",
    "energy_bumpers",
    "effective_damping",
    "cycles",
    "exponents_cycles",
    "mirror_pair",
)

_STABILITY = {1: "stable", 0: "unstable", -1: "neutral (disturbances neither grow nor decay)"}

Found = dict[float, dict[str, xr.Dataset]]
"""Motions by name, by frequency."""


def facts(found: Found) -> list[dict[str, Any]]:
    """Return what the motions are, in SI units."""
    return [
        {"frequency": hertz, "name": name, **_facts(data)}
        for hertz, motions in found.items()
        for name, data in motions.items()
    ]


def text(found: Found) -> RenderableType:
    """Return the verdicts and the contacts as tables."""
    parts: list[RenderableType] = []
    for hertz, motions in found.items():
        many = f"{len(motions)} motions coexist" if len(motions) > 1 else "one motion found"
        parts += [Text(), Text(f"{hertz:.10g} Hz: {many}", style="bold")]
        for name, data in motions.items():
            parts += [Text(), *_motion(name, data)]
    return Group(*parts)


def _facts(data: xr.Dataset) -> dict[str, Any]:
    values: dict[str, Any] = {name: data[name].item() for name in _SCALARS if name in data}
    values["exponents"] = data["exponents"].values.tolist()
    values["exponents_uncertainty"] = data["exponents_uncertainty"].values.tolist()
    values["evidence"], values["status"] = data.attrs["evidence"], data.attrs["status"]
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


def _motion(name: str, data: xr.Dataset) -> list[RenderableType]:
    kind = data["motion"].item()
    words = [f"{kind}, period {int(data['period'])}" if kind == "periodic" else kind]
    if kind == "periodic":
        words.append(_STABILITY[int(data["stable"])])
    words.append("antisymmetric" if bool(data["antisymmetric"]) else "not antisymmetric")
    if "mirror_pair" in data and bool(data["mirror_pair"]):
        words.append("its mirror image is another motion")
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2))
    table.add_column(style="bold")
    table.add_column()
    low, high = data["displacement_min"].item(), data["displacement_max"].item()
    floor, ceiling = data["acceleration_min"].item(), data["acceleration_max"].item()
    rows = [
        ("evidence", data.attrs["evidence"]),
        ("exponents", _exponents(data)),
        ("displacement", f"{1e3 * low:.5g} to {1e3 * high:.5g} mm"),
        ("eccentricity", f"{1e3 * _rounded(data['eccentricity'].item(), high - low):.4g} mm"),
        ("acceleration", f"{floor:.5g} to {ceiling:.5g} m/s² (absolute)"),
        (
            "impacts",
            f"{data['impacts_right'].item():.4g} right, {data['impacts_left'].item():.4g} left "
            "per cycle",
        ),
        (
            "energy",
            f"{data['energy_supplied'].item():.4g} J per cycle, "
            f"{data['energy_bumpers'].item():.4g} J of it lost in the bumpers",
        ),
    ]
    if data.attrs.get("starts"):
        rows.append(("found from", data.attrs["starts"]))
    if data.attrs.get("mirrored_starts"):
        rows.append(("mirror image", f"found from {data.attrs['mirrored_starts']}"))
    for row in rows:
        table.add_row(*row)
    return [Text(f"{name}: {', '.join(words)}", style="bold"), table, *_contacts(data)]


def _exponents(data: xr.Dataset) -> str:
    """The Lyapunov exponents, with their uncertainty where they are averages."""
    values, spreads = data["exponents"].values, data["exponents_uncertainty"].values
    if int(data["period"]) and int(data["exponents_cycles"]) <= 2 * int(data["period"]):
        return f"{values[0]:+.5g} and {values[1]:+.5g} 1/s, from the multipliers of the orbit"
    first, second = (
        f"{value:+.4g} ± {spread:.1g}" for value, spread in zip(values, spreads, strict=True)
    )
    return f"{first} and {second} 1/s, over {int(data['exponents_cycles'])} cycles"


def _rounded(value: float, scale: float) -> float:
    """Zero for what is only rounding."""
    return value if abs(value) > 1e-9 * scale else 0.0


def _contacts(data: xr.Dataset) -> list[RenderableType]:
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
    columns = (
        ("phase (°)", "start_phase", 57.29577951308232, ".1f"),
        ("length/T", "duration_share", 1.0, ".4f"),
        ("u̇ in (mm/s)", "start_velocity", 1e3, ".2f"),
        ("u̇ out (mm/s)", "end_velocity", 1e3, ".2f"),
        ("force (kN)", "peak_force", 1e-3, ".3g"),
        ("J (N s)", "impulse", 1.0, ".3g"),
        ("depth (mm)", "penetration", 1e3, ".3g"),
        ("lost (J)", "dissipated", 1.0, ".3g"),
        ("e (–)", "restitution", 1.0, ".3f"),
    )
    for heading, *_ in columns:
        table.add_column(heading, justify="right")
    for i in range(min(count, _MOST_CONTACTS)):
        side = "right" if int(data["contact_side"][i]) == 1 else "left"
        if bool(data["contact_grazing"][i]):
            side += ", grazing"
        values = [
            format(factor * float(data[f"contact_{name}"][i]), how)
            for _, name, factor, how in columns
        ]
        table.add_row(side, *values)
    return [table]
