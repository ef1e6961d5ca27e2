"""The meaning of a column, from its name and its unit. Guesses are reported."""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.measurements.columns import Array, ChannelColumn
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
from vibroimpact.response.curve_pair import Direction
from vibroimpact.tables.units import ending, plain, spelled, time_unit, words_of

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

_FORWARD = {
    "forward", "fwd", "fw", "up", "upward", "upwards", "rising", "increasing", "increase",
    "aufwarts", "aufwaerts",
}  # fmt: skip
_BACKWARD = {
    "backward", "bwd", "bw", "down", "downward", "downwards", "falling", "decreasing", "decrease",
    "abwarts", "abwaerts",
}  # fmt: skip
_KINDS = {
    "max": {"max", "maximum", "most", "maxima", "highest"},
    "min": {"min", "minimum", "least", "minima", "lowest"},
    "excursion": {"excursion", "exc", "pp", "p2p", "pkpk", "range", "e", "ed", "ea", "peaktopeak"},
    "half": {"amplitude", "amp", "semiamplitude", "halfrange"},
}
_WHAT = {
    "displacement": {
        "displacement", "displacements", "disp", "displ", "ed", "position", "pos", "defl",
        "deflection", "weg", "verschiebung", "auslenkung", "deplacement", "desplazamiento",
        "spostamento",
    },
    "acceleration": {
        "acceleration", "acc", "accel", "ea", "accn", "accelerations", "accelerometer",
        "beschleunigung", "aceleracion", "accelerazione",
    },
    "velocity": {"velocity", "vel", "geschwindigkeit", "vitesse", "velocidad", "velocita"},
    "force": {"force", "f_contact", "kraft", "fuerza", "forza"},
}  # fmt: skip
_COMPOUND = re.compile(
    r"(?P<first>[a-z]*?)(?P<what>beschleunigung|verschiebung|auslenkung|geschwindigkeit|kraft|weg)"
)
"""German joins words: Tischbeschleunigung, Relativverschiebung."""
_LETTERS = {
    "d": "displacement", "u": "displacement", "x": "displacement", "a": "acceleration",
    "v": "velocity",
}  # fmt: skip
"""Quantities of one letter. After a quantity, an x is the axis of a sensor."""
_ALONG = {"x", "y", "z"}
_BASE = {
    "base", "table", "ground", "input", "shaker", "shaketable", "g", "t", "tisch", "boden",
    "fusspunkt",
}  # fmt: skip
_MASS = {"mass", "masse", "absolute", "absolut", "abs"}
_BESIDE = {"rel", "relative", "channel", "ch", "sensor", "axis", "measured", "p2p"}
"""Words beside a letter that leave its meaning."""
_NOT_LINEAR = {"angular", "rotation", "rotational", "gyro", "gyroscope"}
_GLUED = re.compile(
    r"(acceleration|accelerometer|accel|acc|displacement|displ|disp|velocity|vel|force)([xyz])"
)
_NO_UNIT = ("-", "–", "1", "")
_EXAMPLES = {LENGTH: "mm", ACCELERATION: "g", VELOCITY: "mm/s", FORCE: "N"}


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


def meaning(name: str, stated: str | None = None) -> Meaning | None:
    """Return the meaning of a column from its name, or None if it is not understood.

    Parameters
    ----------
    name
        The name, which may end in a unit.
    stated
        Unit that the file states elsewhere. It distinguishes an acceleration along x
        from a displacement x.
    """
    sure = re.search(r"/ *[A-Za-z0-9]+$", plain(name)) is not None
    words = words_of(name)
    key = "_".join(words)
    if key in QUANTITIES or key == "direction":
        return Meaning(key)
    if words in (["dir"], ["sweep"], ["sense"], ["sweep", "direction"], ["richtung"]):
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
    below_1_s = time_unit(name)
    named = said & {"time", "zeit", "timestamp", "timestamps", "datetime"}
    if below_1_s or named or words in (["t"], ["s"], ["sec"]):
        return Meaning("time", None, below_1_s or unit)
    if "eta" in said or said & {"etad", "etaa"}:
        end = words[-1][-1]
        return Meaning(f"eta_{end}", direction, unit) if end in "ad" else None
    glued = re.fullmatch(r"(u|x|d|a)(max|min|pp)", "".join(words))
    if glued:
        words = [glued[1], glued[2]]
        said = set(words)
    words = [part for word in words for part in _axis_apart(word, len(words))]
    said = set(words)
    what = next((key for key, some in _WHAT.items() if said & some), None)
    if said & _NOT_LINEAR:
        return None
    if words in (["ag"], ["at"], ["a", "t"], ["a", "g"]):
        return Meaning("base_acceleration", None, unit)
    if what is None:
        what = _of_letters(words, stated or unit)
    if what is None:
        if not said & (_BASE - {"t", "g"}) or said & _ALONG:
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


def _axis_apart(word: str, count: int) -> list[str]:
    """A word without the axis at its end, as in ``accx`` or, alone, ``ax``; and the axis.

    A German compound is its two words.
    """
    if joined := _COMPOUND.fullmatch(word):
        return [part for part in joined.groups() if part]
    match = _GLUED.fullmatch(word) or (
        re.fullmatch("([uadv])([xyz])", word) if count == 1 else None
    )
    return [match[1], match[2]] if match else [word]


def _of_letters(words: list[str], unit: str | None) -> str | None:
    """The quantity of which a name has only a letter, or None."""
    usual = set().union(*_KINDS.values(), _BASE, _MASS, _BESIDE, _ALONG, _LETTERS)
    letters = [word for word in words if word in {*_LETTERS, *_ALONG}]
    if not letters or any(word not in usual and not word.isdigit() for word in words):
        return None
    if set(letters) <= _ALONG and unit is not None:
        # The axis of a sensor, whose unit states what it measures.
        for what, quantity in (("acceleration", ACCELERATION), ("velocity", VELOCITY)):
            if size_of(unit, quantity) is not None:
                return what
    if letters == ["u"] and unit is not None and size_of(unit, ACCELERATION) is not None:
        return None  # upwards, beside N and E
    return _LETTERS.get(letters[0])


def in_si(
    column: ChannelColumn, column_meaning: Meaning, said: str | None, path: str
) -> tuple[Array, str | None]:
    """Return the values of a column in SI units, and what is noted of its unit.

    Times without a unit are in s, and frequencies in Hz, which is noted.

    Raises
    ------
    InputError
        If the unit cannot be read, or if it belongs to another quantity.
    """
    quantity = QUANTITIES[column_meaning.variable]
    unit = said or column.unit or column_meaning.unit
    if unit is not None and unit.strip().upper() == "SI":
        unit = quantity.symbol or "1"
    values = np.asarray(column.values, dtype=float) * column_meaning.factor
    notes = []
    if column_meaning.factor != 1.0:
        notes.append(f"{column.name!r} was read as an amplitude, which is half an excursion")
    if (
        unit == column.unit
        and unit
        and column_meaning.unit
        and not alike(unit, column_meaning.unit)
    ):
        notes.append(
            f"{column.name!r} was read in {unit}, although its name states {column_meaning.unit}"
        )
    if unit is not None and unit.strip() not in _NO_UNIT:
        where = f"measurement: {path!r}, column {column.name!r}"
        if quantity is DIMENSIONLESS and unit.strip() == "%":
            return values / 100.0, None
        try:
            size = to_si(f"1 {spelled(unit)}", quantity, where)
        except InputError as error:
            if said is not None:
                raise
            raise InputError(
                f"{error}; if the file states a wrong unit, pass the right one as "
                f"units={{{column.name!r}: UNIT}} (--units)"
            ) from None
        return values * size, "; ".join(notes) or None
    if quantity is not DIMENSIONLESS:
        notes.append(f"{column.name!r} has no unit, so {quantity.symbol} was assumed")
    return values, "; ".join(notes) or None


def missing_unit(column: ChannelColumn, column_meaning: Meaning, said: str | None) -> str | None:
    """Return a usual unit of a column if its unit is needed and not stated, or None.

    Times are in s, frequencies in Hz and ratios have no unit, if none is stated.
    """
    quantity = QUANTITIES[column_meaning.variable]
    unit = said or column.unit or column_meaning.unit
    return None if unit and unit.strip() not in _NO_UNIT else _EXAMPLES.get(quantity)


def alike(one: str, other: str) -> bool:
    """Return whether two texts are the same unit."""
    if spelled(one) == spelled(other):
        return True
    return any(
        (size := size_of(one, quantity)) is not None and size == size_of(other, quantity)
        for quantity in {each.name: each for each in QUANTITIES.values()}.values()
    )


def size_of(unit: str, quantity: Quantity) -> float | None:
    """Return the size of a unit of a quantity in SI units, or None if it is another quantity's."""
    try:
        return to_si(f"1 {spelled(unit)}", quantity, "unit")
    except InputError:
        return None


def direction_of(word: object, path: str, where: str) -> Direction:
    """Read the direction of a sweep, which is a word, 1 or −1."""
    text = plain(str(word).lower())
    if text in _FORWARD | {"f", "1", "1.0", "+1"}:
        return "forward"
    if text in _BACKWARD | {"b", "-1", "-1.0", "0", "0.0", "2", "2.0"}:
        return "backward"
    raise InputError(
        f"measurement: {path!r}, {where}: the direction {text!r} is unknown; use forward or "
        "backward, up or down, or 1 or -1"
    )
