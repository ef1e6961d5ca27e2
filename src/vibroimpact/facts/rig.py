"""A rig with every parameter that was used, as plain values and as text."""

from __future__ import annotations

import math
from typing import Any

from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact._version import __version__
from vibroimpact.datasets.description import excitation_parameters
from vibroimpact.errors import InputError
from vibroimpact.facts import assembly
from vibroimpact.facts.tables import sheet
from vibroimpact.model import (
    Dimensionless,
    Oscillator,
    Periodic,
    Record,
    Repeated,
    Rig,
    Stop,
    to_dimensionless,
)
from vibroimpact.model.frequency_text import forcing
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.quantities import FORCE, MASS
from vibroimpact.model.units import plain, pretty
from vibroimpact.model.written_units import unitless


def facts(rig: Rig) -> dict[str, Any]:
    """Return the rig in SI units and, where they exist, in dimensionless parameters."""
    about = {"name": rig.name, "vibroimpact_version": __version__}
    if rig.system.by_mass:
        return {**about, **assembly.rig_facts(rig.assembly), **_shaking_facts(rig.shaking)}
    scaled = _dimensionless(rig)
    return {
        **about,
        "oscillator": rig.oscillator.model_dump(),
        **_shaking_facts(rig.shaking),
        "natural_frequency": rig.oscillator.angular_frequency / math.tau or None,
        "dimensionless": None if scaled is None else scaled.model_dump(),
    }


def text(rig: Rig, shaking: bool = True, frequency: float | None = None) -> RenderableType:
    """Return the rig with every parameter that was used, and with its shaking if that is wanted.

    The forcing frequency (Hz), if one is passed, is below the natural frequency.
    """
    at = "" if frequency is None or not rig.is_shaken else f"at {forcing(frequency)}"
    shaken = (*_shaking_words(rig.shaking), at) if shaking and rig.shaking is not None else ()
    if rig.system.by_mass:
        table = assembly.rig_text(rig.assembly, shaken)
        return Group(Text(rig.name or "", style="bold"), table)
    oscillator = rig.oscillator
    isolator = oscillator.isolator
    scaled, sprung = _dimensionless(rig), isolator.initial_stiffness > 0.0
    damped = sprung and isolator.damping_exponent == 1.0
    rows = [
        (
            "mass",
            pretty(oscillator.mass, MASS),
            # That of a rig without units is ω0.
            f"natural frequency {forcing(oscillator.natural_frequency, 4).replace('ω', 'ω0')}"
            if sprung
            else "",
        ),
        (
            "isolator",
            isolator.summary(),
            f"ξ = {plain(oscillator.damping_ratio, 4)}" if damped else "",
        ),
        *(_side(oscillator, side, scaled) for side in SIDES),
        *([("units", "none; frequencies are angular, ω = 2π f")] if unitless() else []),
        *([("constant force", pretty(oscillator.force, FORCE))] if oscillator.force else []),
        *([shaken] if shaken else []),
    ]
    return Group(Text(rig.name or "", style="bold"), sheet(rows))


def _side(oscillator: Oscillator, side: str, scaled: Dimensionless | None) -> tuple[str, ...]:
    stop: Stop | None = getattr(oscillator, side)
    if stop is None:
        # Beside a rigid stop, no bumper is missing.
        rigid = any(one.rigid for one in oscillator.stops.values())
        return f"{side} {'stop' if rigid else 'bumper'}", "none"
    group = getattr(scaled, side) if scaled else None
    name = f"{side} {'stop' if stop.rigid else 'bumper'}"
    return name, stop.summary(), group.summary() if group else ""


def _shaking_facts(shaken: Repeated | Record | None) -> dict[str, Any]:
    if shaken is None:
        return {}
    if isinstance(shaken, Record):
        return {"record": dict(shaken.rows())}
    return excitation_parameters(shaken, "frequency", "phase")


def _shaking_words(shaken: Repeated | Record) -> tuple[str, str]:
    """What shakes it, and how much."""
    if isinstance(shaken, Record):
        return "base", ", ".join(f"{name} {text}" for name, text in shaken.rows())
    if isinstance(shaken, Periodic):
        sizes = ", ".join(pretty(size, shaken.quantity) for size in shaken.amplitudes)
        return _shaken(shaken), f"harmonics of {sizes}"
    if shaken.amplitude == 0.0:
        return "base", "at rest: free vibration"
    text = pretty(shaken.amplitude, shaken.quantity)
    if shaken.of == "acceleration":
        exact = "" if unitless() else f"{plain(shaken.amplitude, 7)} m/s² = "
        text = f"A = {exact}{text}"
    return _shaken(shaken), text


def _shaken(shaken: Repeated) -> str:
    """What is shaken; of several masses the one on which a force acts."""
    words = _SHAKEN[shaken.of]
    if shaken.on is None:
        return words
    return f"{words.removesuffix(' on the mass')} on {shaken.on}"


_SHAKEN = {
    "acceleration": "base",
    "displacement": "base",
    "force": "force on the mass",
    "unbalance": "rotating unbalance",
}


def _dimensionless(rig: Rig) -> Dimensionless | None:
    try:
        return to_dimensionless(rig)
    except InputError:  # nothing to scale a gap by, or another kind of shaking
        return None
