"""Frequencies as text: in Hz, or as angular frequencies if the rig has no units."""

from __future__ import annotations

import math

from vibroimpact.model.units import plain
from vibroimpact.model.written_units import unitless


def forcing(frequency: float, digits: int = 6) -> str:
    """Write a frequency (Hz) with its unit, or as ``"ω = 2"`` if the rig has no units."""
    return forcings(frequency, frequency, digits=digits)


def forcings(low: float, high: float, digits: int = 6, to: str = " to ") -> str:
    """Write a range of frequencies (Hz), such as ``"0.5 to 5 Hz"`` or ``"ω = 0.5 to 5"``."""
    turn = math.tau if unitless() else 1.0
    ends = dict.fromkeys(plain(turn * end, digits) for end in (low, high))
    span = to.join(ends)
    return f"ω = {span}" if unitless() else f"{span} Hz"


def forcing_heading(name: str = "frequency") -> tuple[float, str]:
    """Return factor and heading of a column of frequencies: in Hz, or ω of a rig without units."""
    return (math.tau, "ω") if unitless() else (1.0, f"{name} (Hz)")


def forcing_slug(frequency: float) -> str:
    """Return a frequency (Hz) as a part of a file name, such as ``"2.5Hz"`` or ``"omega1"``."""
    return forcing(frequency, 10).replace("ω = ", "omega").replace(" ", "")
