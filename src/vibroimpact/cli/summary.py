"""What a command found, for people and for programs."""

from __future__ import annotations

import json
import math
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact._version import __version__
from vibroimpact.cli.rig import Subject
from vibroimpact.datasets.description import excitation_parameters
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.facts.number_format import plain
from vibroimpact.facts.tables import plain_table
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
        "status": Status(data["status"].item()).name.lower(),
        "message": data.attrs["message"],
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
        "status": Status(data["status"].item()).name.lower(),
        "message": data.attrs["message"],
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
        return to_dimensionless(subject.rig)
    except InputError:  # nothing to scale a gap by, or another kind of shaking
        return None
