"""The meaning of a column, from its name and its unit. Guesses are reported."""

from __future__ import annotations

import re
from typing import Literal, NamedTuple

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.measurements.columns import Array, Column
from vibroimpact.model.quantities import (
    ACCELERATION,
    DIMENSIONLESS,
    FORCE,
    FREQUENCY,
    LENGTH,
    TIME,
    VELOCITY,
    Quantity,
)
from vibroimpact.model.units import to_si
from vibroimpact.tables.units import ending, plain, spelled, words_of

Direction = Literal["forward", "backward"]

CURVES: dict[str, Quantity] = {
    "displacement_excursion": LENGTH,
    "acceleration_excursion": ACCELERATION,
    "displacement_max": LENGTH,
    "displacement_min": LENGTH,
    "acceleration_max": ACCELERATION,
    "acceleration_min": ACCELERATION,
    "eta_d": DIMENSIONLESS,
    "eta_a": DIMENSIONLESS,
}
"""Quantities that are measured at each frequency of a stepped sine."""

HISTORIES: dict[str, Quantity] = {
    "displacement": LENGTH,
    "velocity": VELOCITY,
    "acceleration": ACCELERATION,
    "base_acceleration": ACCELERATION,
    "mass_displacement": LENGTH,
    "base_displacement": LENGTH,
    "contact_force": FORCE,
}
"""Quantities that are measured over time. Displacement and velocity are relative to the base."""

AXES: dict[str, Quantity] = {"frequency": FREQUENCY, "time": TIME}
QUANTITIES: dict[str, Quantity] = {**AXES, **CURVES, **HISTORIES}

_FORWARD = {"forward", "fwd", "fw", "up", "upward", "upwards", "rising", "increasing", "increase"}
_BACKWARD = {
    "backward", "bwd", "bw", "down", "downward", "downwards", "falling", "decreasing", "decrease",
}  # fmt: skip
_KINDS = {
    "max": {"max", "maximum", "most", "maxima", "highest"},
    "min": {"min", "minimum", "least", "minima", "lowest"},
    "excursion": {"excursion", "exc", "pp", "p2p", "pkpk", "range", "e", "ed", "ea", "peaktopeak"},
    "half": {"amplitude", "amp", "semiamplitude", "halfrange"},
}
_WHAT = {
    "displacement": {
        "displacement", "displacements", "disp", "displ", "d", "u", "x", "ed", "position", "pos",
        "defl", "deflection",
    },
    "acceleration": {"acceleration", "acc", "accel", "a", "ea", "accn", "accelerations"},
    "velocity": {"velocity", "vel", "v"},
    "force": {"force", "f_contact"},
}  # fmt: skip
_BASE = {"base", "table", "ground", "input", "shaker", "shaketable", "g", "t"}
_MASS = {"mass", "absolute", "abs"}


class Meaning(NamedTuple):
    """The meaning of a column."""

    variable: str
    """Name of the variable: one of `QUANTITIES`, or ``direction``."""
    direction: Direction | None = None
    """Sweep direction, if the name of the column states it."""
    unit: str | None = None
    """Unit at the end of the name."""
    factor: float = 1.0
    """Factor of the values: 2 for an amplitude, because it is half an excursion."""


def meaning(name: str) -> Meaning | None:
    """Return the meaning of a column from its name, or None if it is not understood."""
    sure = re.search(r"/ *[A-Za-z0-9]+$", plain(name)) is not None
    words = words_of(name)
    key = "_".join(words)
    if key in QUANTITIES or key == "direction":
        return Meaning(key)
    if words in (["dir"], ["sweep"], ["sense"], ["sweep", "direction"]):
        return Meaning("direction")
    unit = ending(words, sure=sure)
    if unit is not None:
        words = words[:-1]
    elif len(words) > 2 and words[-2:] == ["m", "s2"]:
        unit, words = "m/s^2", words[:-2]
    said = set(words)
    direction: Direction | None = None
    for way, some in (("forward", _FORWARD), ("backward", _BACKWARD)):
        if said & some:
            direction = way  # type: ignore[assignment]
            words = [word for word in words if word not in some]
    if len(words) > 1 and words[-1] in ("f", "b") and direction is None:
        direction = "forward" if words[-1] == "f" else "backward"
        words = words[:-1]
    said = set(words)
    if said & {"frequency", "freq", "fexc", "frequenz"} or words in (["f"], ["hz"]):
        return Meaning("frequency", None, "Hz" if words == ["hz"] else unit)
    if said & {"time", "zeit"} or words in (["t"], ["s"], ["sec"]):
        return Meaning("time", None, unit)
    if "eta" in said or said & {"etad", "etaa"}:
        end = words[-1][-1]
        return Meaning(f"eta_{end}", direction, unit) if end in "ad" else None
    glued = re.fullmatch(r"(u|x|d|a)(max|min|pp)", "".join(words))
    if glued:
        words = [glued[1], glued[2]]
        said = set(words)
    what = next((key for key, some in _WHAT.items() if said & some), None)
    if words in (["ag"], ["at"], ["a", "t"], ["a", "g"]):
        return Meaning("base_acceleration", None, unit)
    if what is None:
        if "accelerometer" not in said and not said & (_BASE - {"t", "g"}):
            return None
        what = "acceleration"
    kind = next((key for key, some in _KINDS.items() if said & some), None)
    if kind in ("max", "min") and what in ("displacement", "acceleration"):
        return Meaning(f"{what}_{kind}", direction, unit)
    if kind in ("excursion", "half") and what in ("displacement", "acceleration"):
        return Meaning(f"{what}_excursion", direction, unit, 2.0 if kind == "half" else 1.0)
    if what == "force":
        return Meaning("contact_force", direction, unit)
    if said & (_BASE - {"t", "g"}) and what in ("displacement", "acceleration"):
        return Meaning(f"base_{what}", direction, unit)
    if said & _MASS and what == "displacement":
        return Meaning("mass_displacement", direction, unit)
    return Meaning(what, direction, unit)


def in_si(column: Column, found: Meaning, said: str | None, path: str) -> tuple[Array, str | None]:
    """Return the values of a column in SI units, and a note if the unit was guessed.

    Raises
    ------
    InputError
        If the unit cannot be read, or if it belongs to another quantity.
    """
    quantity = QUANTITIES[found.variable]
    unit = said or column.unit or found.unit
    if unit is not None and unit.strip().upper() == "SI":
        unit = quantity.symbol or "1"
    values = np.asarray(column.values, dtype=float) * found.factor
    notes = []
    if found.factor != 1.0:
        notes.append(f"{column.name!r} was read as an amplitude, which is half an excursion")
    if unit == column.unit and unit and found.unit and not alike(unit, found.unit):
        notes.append(f"{column.name!r} was read in {unit}, although its name states {found.unit}")
    if unit is not None and unit.strip() not in ("-", "–", "1", ""):
        where = f"measurement: {path!r}, column {column.name!r}"
        if quantity is DIMENSIONLESS and unit.strip() == "%":
            return values / 100.0, None
        size = to_si(f"1 {spelled(unit)}", quantity, where)
        return values * size, "; ".join(notes) or None
    if quantity is not DIMENSIONLESS:
        largest = float(np.nanmax(np.abs(values), initial=0.0))
        if quantity is LENGTH and largest > 2.0:
            notes.append(
                f"{column.name!r} has no unit, and its values reach {largest:.4g}, so millimetres "
                "were assumed"
            )
            values = values * 1e-3
        else:
            notes.append(f"{column.name!r} has no unit, so {quantity.symbol} was assumed")
    return values, "; ".join(notes) or None


def alike(one: str, other: str) -> bool:
    """Return whether two texts are the same unit."""
    if spelled(one) == spelled(other):
        return True
    return any(
        (size := _size(one, quantity)) is not None and size == _size(other, quantity)
        for quantity in {each.name: each for each in QUANTITIES.values()}.values()
    )


def _size(unit: str, quantity: Quantity) -> float | None:
    try:
        return to_si(f"1 {spelled(unit)}", quantity, "unit")
    except InputError:
        return None


def direction_of(word: object, path: str, where: str) -> Direction:
    """Read the direction of a sweep, which is a word, 1 or −1.

    Raises
    ------
    InputError
        If it is none of these.
    """
    text = str(word).strip().lower()
    if text in _FORWARD | {"f", "1", "1.0", "+1"}:
        return "forward"
    if text in _BACKWARD | {"b", "-1", "-1.0", "0", "0.0", "2", "2.0"}:
        return "backward"
    raise InputError(
        f"measurement: {path!r}, {where}: the direction {text!r} is unknown; use forward or "
        "backward, up or down, or 1 or -1"
    )
