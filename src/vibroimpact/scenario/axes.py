"""The quantities over which a map can be drawn, and the rig of each of its nodes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.model import Dimensionless, Oscillator, Rig, to_dimensionless, to_si
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.scenario.bumpers import bumpers

_Array = NDArray[np.float64]


NAMES = (
    "gap",
    "amplitude",
    "bumper_stiffness",
    "stiffness_ratio",
    "gap_ratio",
    "relaxation_time",
    "damping_ratio",
)
"""Parameters over which a map can be drawn; lengths and stiffnesses are those of each side."""

ONE_QUANTITY = ({"gap", "gap_ratio"}, {"bumper_stiffness", "stiffness_ratio"})
"""Pairs that say the same."""


class Axis(NamedTuple):
    """Values of one parameter."""

    name: str
    values: _Array
    """In SI units, rising."""
    logarithmic: bool
    """Whether it is refined by geometric means."""

    def refined(self, times: int) -> Axis:
        """With a value half-way between any two, done so many times; the old values stay."""
        values = self.values
        for _ in range(times):
            low, high = values[:-1], values[1:]
            middle = np.sqrt(low * high) if self.logarithmic else 0.5 * (low + high)
            finer = np.empty(2 * len(values) - 1)
            finer[0::2], finer[1::2] = values, middle
            values = finer
        return self._replace(values=values)


def logarithmic(values: _Array) -> bool:
    """Whether neighbouring values have one ratio, up to rounded digits, and not one difference."""
    if values[0] <= 0.0 or len(values) < 3:
        return False
    steps, ratios = np.diff(values), np.diff(np.log(values))
    uneven, spread = np.ptp(steps) / steps.max(), np.ptp(ratios) / ratios.max()
    return bool(spread < 0.05 and spread < 0.1 * uneven)


def axis(given: Any, field: str) -> Axis:
    """Read an axis: the name of a parameter, its values, and "linear" or "log" if it is not clear.

    Raises
    ------
    InputError
        If it is no such pair, or a value cannot be used.
    """
    pair = isinstance(given, tuple | list) and len(given) in (2, 3) and isinstance(given[0], str)
    if not pair or given[2:] not in ((), [], ("log",), ["log"], ("linear",), ["linear"]):
        raise InputError(
            f"{field}: {given!r} is no axis; a pair of a name and values is accepted, such as "
            '("gap_ratio", [0, 0.5, 1]), and "log" or "linear" behind it'
        )
    name, values = given[:2]
    if name not in NAMES:
        raise InputError(f"{field}: {name!r}; one of {', '.join(NAMES)} is accepted")
    parameter = PARAMETERS[name]
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise InputError(f"{field}: {values!r} is no list of values; at least two are accepted")
    limits: dict[str, Any] = {"minimum": 0.0} if parameter.zero else {"above": 0.0}
    numbers = np.array(
        [
            to_si(value, parameter.quantity, f"{field}[{i}]", **limits)
            for i, value in enumerate(values)
        ]
    )
    if len(numbers) < 2:
        raise InputError(f"{field}: {len(numbers)} values given; at least two are accepted")
    for i in np.flatnonzero(np.diff(numbers) <= 0.0):
        raise InputError(
            f"{field}[{i + 1}]: {numbers[i + 1]:g} follows {numbers[i]:g}; "
            "rising values are accepted"
        )
    if name == "damping_ratio" and numbers[-1] >= math.sqrt(0.5):
        raise InputError(
            f"{field}[{len(numbers) - 1}]: a damping ratio of {numbers[-1]:g} has no resonance "
            "peak; values below 0.707107 are accepted"
        )
    spaced = given[2] == "log" if len(given) == 3 else logarithmic(numbers)
    if spaced and numbers[0] <= 0.0:
        raise InputError(f"{field}[0]: 0 on a logarithmic axis; values above 0 are accepted")
    return Axis(name, numbers, spaced)


def check_pair(x: Axis, y: Axis) -> None:
    """Refuse two axes of one parameter, or of one quantity.

    Raises
    ------
    InputError
        If they do not go together.
    """
    if x.name == y.name:
        raise InputError(f"y: {y.name!r} is that of x; another parameter is accepted")
    if {x.name, y.name} in ONE_QUANTITY:
        raise InputError(
            f"y: {y.name!r} is {x.name!r} in other units; another parameter is accepted"
        )


class Base(NamedTuple):
    """The rig whose other parameters all nodes share."""

    oscillator: Oscillator
    amplitude: float
    """m/s²"""

    def rig(self, values: Mapping[str, float]) -> Rig:
        """The rig at a node.

        Physical parameters are set on both sides; of the bumpers' damping the relaxation time
        C_j/K_j is kept. Dimensionless ones are set at the base's mass, isolator stiffness and
        amplitude: between dimensionless ones the gap ratio is kept, beside a physical one the gap.

        Raises
        ------
        InputError
            If there is no bumper to set, or the base has no dimensionless parameters.
        """
        if not bumpers(self.oscillator, "base"):
            raise InputError("base: there is no bumper; a rig with one or two is accepted")
        physical = {name for name in values if PARAMETERS[name].physical}
        rig = self._physical(values) if physical else Rig(self.oscillator, self.amplitude)
        if len(physical) == len(values):
            return rig
        scaled = Base(*rig)._dimensionless(values)
        if not physical or "gap_ratio" in values:
            return scaled
        sides = {}
        for side in ("right", "left"):
            bumper = getattr(scaled.oscillator, side)
            if bumper is not None:
                sides[side] = bumper.replace(gap=getattr(rig.oscillator, side).gap)
        return Rig(scaled.oscillator.replace(**sides), scaled.amplitude)

    def _physical(self, values: Mapping[str, float]) -> Rig:
        changes = {}
        for side, bumper in bumpers(self.oscillator).items():
            stiffness = values.get("bumper_stiffness", bumper.stiffness)
            changes[side] = bumper.replace(
                gap=values.get("gap", bumper.gap),
                stiffness=stiffness,
                damping=bumper.damping * (stiffness / bumper.stiffness),
            )
        return Rig(self.oscillator.replace(**changes), values.get("amplitude", self.amplitude))

    def _dimensionless(self, values: Mapping[str, float]) -> Rig:
        group = to_dimensionless(self.oscillator, self.amplitude)
        own = {
            name: values[key]
            for key, name in (
                ("stiffness_ratio", "stiffness_ratio"),
                ("gap_ratio", "gap"),
                ("relaxation_time", "relaxation_time"),
            )
            if key in values
        }
        sides = {
            side: None if bumper is None else bumper.replace(**own)
            for side, bumper in (("right", group.right), ("left", group.left))
        }
        changed = Dimensionless(values.get("damping_ratio", group.damping_ratio), **sides)
        return changed.to_physical(
            mass=self.oscillator.mass,
            stiffness=self.oscillator.isolator.stiffness,
            amplitude=self.amplitude,
        )
