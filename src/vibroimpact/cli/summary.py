"""What a command found, for people and for programs."""

from __future__ import annotations

import json
import math
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from vibroimpact._version import __version__
from vibroimpact.cli import largest
from vibroimpact.cli.numbers import plain
from vibroimpact.cli.rig import Subject
from vibroimpact.errors import InputError
from vibroimpact.model import (
    Bumper,
    Dimensionless,
    Isolator,
    Model,
    Periodic,
    Record,
    Repeated,
    RigidStop,
    Stop,
    to_dimensionless,
)
from vibroimpact.model.access import scale_of
from vibroimpact.model.quantities import (
    ACCELERATION,
    DAMPING,
    FORCE,
    LENGTH,
    MASS,
    STIFFNESS,
    VELOCITY,
)
from vibroimpact.model.units import pretty
from vibroimpact.response.resonance import Features, Range
from vibroimpact.response.variables import excitation_parameters

_CURVES = {"eta_a": "η_a", "eta_d": "η_d"}
_LATELY = 10.0
"""Cycles at the end over which contacts are counted."""


def rig_facts(subject: Subject) -> dict[str, Any]:
    """Return the rig in SI units and, where they exist, in dimensionless parameters."""
    scaled = _dimensionless(subject)
    return {
        "name": subject.name,
        "vibroimpact_version": __version__,
        "oscillator": subject.oscillator.model_dump(),
        **_shaking_facts(subject.shaking),
        "natural_frequency": subject.oscillator.angular_frequency / math.tau or None,
        "dimensionless": None if scaled is None else scaled.model_dump(),
    }


def rig_text(subject: Subject, shaking: bool = True) -> RenderableType:
    """Return the rig with every parameter that was used, and what shakes it if it is asked for."""
    oscillator = subject.oscillator
    isolator = oscillator.isolator
    scaled, sprung = _dimensionless(subject), isolator.initial_stiffness > 0.0
    damped = sprung and isolator.damping_exponent == 1.0
    table = plain_table()
    table.add_row(
        "mass",
        pretty(oscillator.mass, MASS),
        f"natural frequency {plain(oscillator.natural_frequency, 4)} Hz" if sprung else "",
    )
    table.add_row(
        "isolator",
        f"K = {pretty(isolator.stiffness, STIFFNESS)}, C = {pretty(isolator.damping, DAMPING)}"
        if isinstance(isolator, Isolator) and isolator.linear
        else _law(isolator),
        f"ξ = {plain(oscillator.damping_ratio, 4)}" if damped else "",
    )
    for side in ("right", "left"):
        bumper: Stop | None = getattr(oscillator, side)
        if bumper is None:
            table.add_row(f"{side} bumper", "none", "")
            continue
        group = getattr(scaled, side) if scaled else None
        if isinstance(bumper, RigidStop):
            table.add_row(
                f"{side} stop",
                f"rigid, e = {plain(bumper.restitution, 4)}, gap {pretty(bumper.gap, LENGTH)}",
                f"λ = ∞, δ0 = {plain(group.gap, 4)}" if group else "",
            )
            continue
        if not isinstance(bumper, Bumper):
            table.add_row(f"{side} bumper", _law(bumper), "")
            continue
        table.add_row(
            f"{side} bumper",
            f"K = {pretty(bumper.stiffness, STIFFNESS)}, C = {pretty(bumper.damping, DAMPING)}, "
            f"gap {pretty(bumper.gap, LENGTH)}",
            f"λ = {plain(group.stiffness_ratio, 4)}, δ0 = {plain(group.gap, 4)}, "
            f"τ = {plain(group.relaxation_time, 3)}"
            if group
            else "",
        )
    if oscillator.force:
        table.add_row("constant force", pretty(oscillator.force, FORCE), "")
    if shaking:
        table.add_row(*_shaking_words(subject.shaking), "")
    return Group(Text(subject.name, style="bold"), table)


def _law(part: Model) -> str:
    """A law with all its numbers, by the names that a study file gives them."""
    rows = dict(part.rows())
    kind = rows.pop("kind", "linear")
    return ", ".join([kind, *(f"{name.replace('_', ' ')} {text}" for name, text in rows.items())])


def sweep_facts(data: xr.Dataset, found: Features, advice: list[str]) -> dict[str, Any]:
    """Return what a sweep shows as nested plain values, frequencies in Hz."""
    frequency = data["frequency"].values
    return {
        "frequencies": {
            "from": float(frequency[0]),
            "to": float(frequency[-1]),
            "count": len(frequency),
        },
        "directions": [str(direction) for direction in data["direction"].values],
        "peaks": [peak._asdict() for peak in found.peaks],
        "jumps": [
            {**jump._asdict(), "frequency": jump.frequency, "upward": jump.upward}
            for jump in found.jumps
        ],
        "hysteresis": [item._asdict() for item in found.hysteresis],
        "unsettled": [item._asdict() for item in found.unsettled],
        "contact": [item._asdict() for item in found.contact],
        "largest": largest.facts(data),
        "advice": advice,
    }


def sweep_text(data: xr.Dataset, found: Features, advice: list[str]) -> RenderableType:
    """Return what a sweep shows as tables."""
    frequency = data["frequency"].values
    directions = " and ".join(str(d) for d in data["direction"].values)
    parts: list[RenderableType] = [
        Text(
            f"{len(frequency)} frequencies from "
            f"{_span(frequency[0], frequency[-1])} Hz, {directions}"
            if len(frequency) > 1
            else f"1 frequency, {plain(frequency[0])} Hz, {directions}"
        ),
        Text(),
        largest.text(data),
        Text(),
        _peaks(found),
        Text(),
        _jumps(found),
        Text(),
        _hysteresis(data, found),
        _ranges("Contact with a bumper", found.contact, "nowhere"),
        _ranges("Not settled", found.unsettled, "nowhere"),
    ]
    parts += [Text(f"Advice: {line}", style="yellow") for line in advice]
    return Group(*parts)


def motion_facts(data: xr.Dataset) -> dict[str, Any]:
    """Return where a motion ended and how often it touched the bumpers lately, in SI units."""
    if "cycle" not in data:
        return _record_facts(data)
    last = float(data["cycle"].values[-1])
    lately = min(_LATELY, last)
    frequency = json.loads(data.attrs["parameters"])["frequency"]
    when = data["event_cycle"] + data["event_cycle_time"] * frequency
    begins = (data["event_contact"] >= 1) & (when > last - lately)
    return {
        "frequency": frequency,
        "cycles": last,
        "time": float(data["time"].values[-1]),
        "final_state": _final(data),
        "contacts": {
            "over_cycles": lately,
            "right_per_cycle": int((begins & (data["event_side"] == 1)).sum()) / lately,
            "left_per_cycle": int((begins & (data["event_side"] == -1)).sum()) / lately,
        },
        "status": data.attrs["status"],
    }


def _final(data: xr.Dataset) -> dict[str, float]:
    """The state at the end, by component."""
    values = zip(data["component"].values, data["final_state"].values.tolist(), strict=True)
    return {str(component): value + 0.0 for component, value in values}  # no negative zeros


def _record_facts(data: xr.Dataset) -> dict[str, Any]:
    """The same of a motion through a record, which has no cycles."""
    begins = data["event_contact"] >= 1
    return {
        "time": float(data["time"].values[-1]),
        "final_state": _final(data),
        "contacts": {
            side: int((begins & (data["event_side"] == sign)).sum())
            for side, sign in (("right", 1), ("left", -1))
        },
        "status": data.attrs["status"],
    }


def motion_text(facts: dict[str, Any]) -> RenderableType:
    """Return what `motion_facts` found as lines."""
    state, contacts = facts["final_state"], facts["contacts"]
    touching = {1: "right stop", -1: "left stop", 0: "none", 2: "both stops"}[int(state["contact"])]
    table = plain_table()
    rows = [
        ("displacement", pretty(state["displacement"], LENGTH)),
        ("velocity", pretty(state["velocity"], VELOCITY)),
        ("right bumper", f"deformed by {pretty(state['right_bumper'], LENGTH)}"),
        ("left bumper", f"deformed by {pretty(state['left_bumper'], LENGTH)}"),
        ("contact", touching),
    ]
    if "cycles" in facts:
        rows.insert(-1, ("phase", f"{plain(state['phase'], 6)} rad"))
    for row in rows:
        table.add_row(*row, "")
    if "cycles" not in facts:
        return Group(
            Text(f"State after {plain(facts['time'], 6)} s"),
            table,
            Text(f"Contacts: {contacts['right']} right, {contacts['left']} left"),
        )
    return Group(
        Text(f"State after {plain(facts['cycles'])} cycles ({plain(facts['time'], 6)} s)"),
        table,
        Text(
            f"Contacts per cycle, over the last {plain(contacts['over_cycles'])}: "
            f"{plain(contacts['right_per_cycle'])} right, {plain(contacts['left_per_cycle'])} left"
        ),
    )


def _shaking_facts(shaken: Repeated | Record) -> dict[str, Any]:
    if isinstance(shaken, Record):
        return {"record": dict(shaken.rows())}
    return excitation_parameters(shaken, "frequency", "phase")


def _shaking_words(shaken: Repeated | Record) -> tuple[str, str]:
    """What shakes it, and how much."""
    if isinstance(shaken, Record):
        return "base", ", ".join(f"{name} {text}" for name, text in shaken.rows())
    if isinstance(shaken, Periodic):
        sizes = ", ".join(pretty(size, shaken.quantity) for size in shaken.amplitudes)
        return _SHAKEN[shaken.of], f"harmonics of {sizes}"
    size = shaken.amplitude
    if shaken.of == "acceleration":
        return "base", f"A = {plain(size, 7)} m/s² = {pretty(size, ACCELERATION)}"
    return _SHAKEN[shaken.of], pretty(size, shaken.quantity)


_SHAKEN = {"acceleration": "base", "displacement": "base", "force": "force on the mass"}


def _dimensionless(subject: Subject) -> Dimensionless | None:
    try:
        return to_dimensionless(subject.oscillator, scale_of(subject.oscillator, subject.repeated))
    except InputError:  # nothing to scale a gap by, or another kind of shaking
        return None


def _peaks(found: Features) -> RenderableType:
    table = _table("Resonances", "curve", "sweep", "kind")
    for name in ("frequency (Hz)", "value", "prominence"):
        table.add_column(name, justify="right")
    for curve, symbol in _CURVES.items():
        for peak in found.peaks:
            if peak.curve == curve:
                kind = "primary" if peak.primary else "secondary"
                table.add_row(
                    symbol,
                    peak.direction,
                    f"{kind}, at the end" if peak.at_end else kind,
                    f"{plain(peak.frequency)}",
                    f"{plain(peak.value, 4)}",
                    f"{plain(peak.prominence, 3)}",
                )
    return table


def _jumps(found: Features) -> RenderableType:
    if not found.jumps:
        return Text("Jumps: none")
    table = _table("Jumps", "sweep", "jump", "between (Hz)", "η_a", "η_d", "")
    for jump in found.jumps:
        table.add_row(
            jump.direction,
            "upward" if jump.upward else "downward",
            f"{plain(jump.before)} and {plain(jump.after)}",
            f"{plain(jump.eta_a[0], 4)} → {plain(jump.eta_a[1], 4)}",
            f"{plain(jump.eta_d[0], 4)} → {plain(jump.eta_d[1], 4)}",
            "" if jump.settled else "not settled",
        )
    return table


def _hysteresis(data: xr.Dataset, found: Features) -> RenderableType:
    if data.sizes["direction"] < 2:
        return Text("Hysteresis: not sought, needs both directions")
    if not found.hysteresis:
        return Text("Hysteresis: none")
    lines = []
    for item in found.hysteresis:
        above = "forward above backward" if item.side == "right" else "backward above forward"
        notes = [f"{item.side} ({above})"]
        if item.below is None or item.above is None:
            notes.append("goes on beyond the range")
        if not item.settled:
            notes.append("not settled")
        lines.append(f"  {_span(item.low, item.high)} Hz: {', '.join(notes)}")
    return Text("\n".join(["Hysteresis", *lines]))


def _ranges(title: str, ranges: tuple[Range, ...], none: str) -> RenderableType:
    if not ranges:
        return Text(f"{title}: {none}")
    lines = []
    for direction in dict.fromkeys(item.direction for item in ranges):
        spans = [_span(item.low, item.high) for item in ranges if item.direction == direction]
        lines.append(f"  {direction}: {', '.join(spans)} Hz")
    return Text("\n".join([title, *lines]))


def _span(low: float, high: float) -> str:
    return f"{plain(low)}" if low == high else f"{plain(low)} to {plain(high)}"


def plain_table() -> Table:
    """Return an empty table of names, values and remarks, without lines."""
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2))
    for style in ("bold", "", "dim"):
        table.add_column(style=style)
    return table


def _table(title: str, *columns: str) -> Table:
    table = Table(
        *columns,
        title=title,
        title_justify="left",
        title_style="",
        box=None,
        pad_edge=False,
        padding=(0, 2, 0, 2),
        header_style="dim",
    )
    return table
