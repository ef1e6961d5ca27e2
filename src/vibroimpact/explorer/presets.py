"""Initial states: the published tests, an example of each rarer scenario, and a building."""

from __future__ import annotations

from functools import cache

from vibroimpact.errors import InputError, shown
from vibroimpact.explorer.state import PageState, begin
from vibroimpact.model import Bumper, Isolator, Oscillator, Rig, laboratory

FIRST = "B2-G1-A3"
"""Default preset of a page: its resonance curves have a distinct right hysteresis."""

_CASES = {
    "S4: motions that are not regular (B3, 10 mm, A3)": "B3-10mm-A3",
    "S5: bumpers attached (B3, 0 mm, A3)": "B3-0mm-A3",
    "S6: soft bumpers (20 kN/m, G1, A3)": "20kN/m-G1-A3",
}
BUILDING = "building with moat"


@cache
def _codes() -> tuple[str, ...]:
    return tuple(case.code for case in laboratory.campaign())


def names() -> list[tuple[str, list[str]]]:
    """Return the names of the presets, by group."""
    return [
        ("examples", [*_CASES, BUILDING]),
        ("published tests", list(_codes())),
    ]


def preset(name: str) -> PageState:
    """Return the initial state of a preset.

    Raises
    ------
    InputError
        If no preset has this name.
    """
    if name == BUILDING:
        state = begin(_building(), BUILDING)
        return state._replace(shaking=state.shaking.replace(frequency=0.55))  # its hysteresis
    if name in _CASES or name in _codes():
        case = laboratory.case(_CASES.get(name, name))
        return begin(case, name, (case.frequencies[0], case.frequencies[-1]))
    raise InputError(f"preset: {shown(name)} is unknown; choose a name in the list of the page")


def _building() -> Rig:
    """5000 t on a period of 2.5 s, walls at 300 mm, shaken by 0.12 g."""
    isolator = Isolator.from_period("5000 t", period="2.5 s", damping_ratio=0.15)
    wall = Bumper("500 MN/m", "5 MN s/m", gap="300 mm")
    return Rig(Oscillator("5000 t", isolator, wall, wall), 0.12 * 9.80665)
