"""The quantities over which a map can be drawn, and the rig of each of its nodes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError, unknown
from vibroimpact.model import (
    Bumper,
    Harmonic,
    RigidStop,
    to_si,
)
from vibroimpact.model.access import scale_of
from vibroimpact.model.excitation import Of
from vibroimpact.model.largest_free_response import peak_displacement
from vibroimpact.model.parameters import PARAMETERS, parameter
from vibroimpact.model.rig import ANY_FREQUENCY, Rig, as_periodic

_Array = NDArray[np.float64]


NAMES = (
    "gap",
    "amplitude",
    "bumper_stiffness",
    "proportional_stiffness",
    "restitution",
    "stiffness_ratio",
    "gap_ratio",
    "relaxation_time",
    "damping_ratio",
    "isolator_period",
)
"""Parameters over which a map can be drawn; lengths and stiffnesses are those of each side."""

ONE_QUANTITY = (
    {"gap", "gap_ratio"},
    {"proportional_stiffness", "stiffness_ratio"},
    {"bumper_stiffness", "stiffness_ratio"},
    {"bumper_stiffness", "proportional_stiffness"},
)
"""Pairs that say the same of one rig."""

_OF_BUMPERS = ("bumper_stiffness", "proportional_stiffness", "stiffness_ratio", "relaxation_time")


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


def axis(given: Any, field: str, of: Of = "acceleration") -> Axis:
    """Read an axis: the name of a parameter, its values, and "linear" or "log" if it is not clear.

    `of` is the quantity of amplitudes.

    Raises
    ------
    InputError
        If it is not such a pair, or a value is invalid.
    """
    pair = isinstance(given, tuple | list) and len(given) in (2, 3) and isinstance(given[0], str)
    if not pair or given[2:] not in ((), [], ("log",), ["log"], ("linear",), ["linear"]):
        raise InputError(
            f"{field}: {given!r} is not an axis; a pair of a name and values is accepted, such as "
            '("gap_ratio", [0, 0.5, 1]), optionally followed by "log" or "linear"'
        )
    name, values = given[:2]
    if name not in NAMES:
        raise InputError(f"{field}: {unknown(name, NAMES)}")
    varied = parameter(name, of=of)
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise InputError(f"{field}: {values!r} is not a list of values; at least two are accepted")
    limits: dict[str, Any] = {"minimum": 0.0} if varied.zero else {"above": 0.0}
    limits["maximum"] = varied.most
    numbers = np.array(
        [to_si(value, varied.quantity, f"{field}[{i}]", **limits) for i, value in enumerate(values)]
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
        raise InputError(f"y: {y.name!r} is also the parameter of x; another parameter is accepted")
    if {x.name, y.name} in ONE_QUANTITY:
        raise InputError(
            f"y: {y.name!r} is the same quantity as {x.name!r}; another parameter is accepted"
        )


def one_sine(rig: Rig, where: str = "shaking") -> Rig:
    """Check that one sine shakes a rig; its frequency is left open.

    Raises
    ------
    InputError
        If it is not one sine, or the mass has no spring.
    """
    oscillator = rig.oscillator
    shaken, _ = as_periodic(rig.shaking, where)
    if rig.amplitudes is not None:
        raise InputError(
            f"{where}: {len(rig.amplitudes)} amplitudes; a scenario is defined for one amplitude "
            "at all frequencies"
        )
    if not isinstance(shaken, Harmonic):
        raise InputError(
            f"{where}: the harmonics of a Periodic cause resonances below the primary one even "
            "without stops, so scenarios are not defined; a Harmonic is accepted"
        )
    if oscillator.isolator.initial_stiffness == 0.0:
        raise InputError(
            "isolator.stiffness: 0, so there is no natural frequency to scale scenarios by; a "
            "stiffness greater than 0 is accepted"
        )
    open_sine = shaken.replace(frequency=ANY_FREQUENCY, phase=0.0)
    return Rig.of_open_frequency(oscillator, open_sine, rig.name)


def _turn(name: str) -> int:
    """When a parameter is set: before others, among them, or last."""
    return int(name in ("relaxation_time", "gap_ratio")) - int(name == "isolator_period")


def _peak(rig: Rig) -> float:
    return peak_displacement(rig.oscillator, scale_of(rig))


class Base(NamedTuple):
    """The rig whose other parameters all nodes share."""

    base: Rig

    def rig(self, values: Mapping[str, float]) -> Rig:
        """The rig at a node.

        Parameters are set on both sides, where the stop has them, each as `PARAMETERS` does. If
        all of them are dimensionless, the gap ratio is kept where it is not varied.

        Raises
        ------
        InputError
            If there is no stop to set, or the base has no dimensionless parameters.
        """
        self._check(values)
        made = self.base
        # Ratios are over the stiffness that the period sets; the gap ratio scales by what else is
        # set, and the relaxation time sets the damping last.
        for name in sorted(values, key=_turn):
            made = PARAMETERS[name].vary(made, values[name])
        physical = any(PARAMETERS[name].physical for name in values)
        if physical or "gap_ratio" in values or "damping_ratio" not in values:
            return made
        grown = _peak(made) / _peak(self.base)
        sides = {
            side: stop.replace(gap=grown * stop.gap)
            for side, stop in (("right", made.oscillator.right), ("left", made.oscillator.left))
            if stop is not None
        }
        return made.with_parts(made.oscillator.replace(**sides))

    def _check(self, values: Mapping[str, float]) -> None:
        stops = self.base.oscillator.stops
        if not stops:
            raise InputError("rig: there is no bumper; a rig with one or two bumpers is accepted")
        for name in values:
            if name in _OF_BUMPERS and not any(isinstance(stop, Bumper) for stop in stops):
                raise InputError(
                    f"rig: {name!r} applies to bumpers, but every stop is rigid; 'gap', "
                    "'gap_ratio', 'restitution', 'amplitude' or 'damping_ratio' is accepted"
                )
            if name == "restitution" and not any(isinstance(stop, RigidStop) for stop in stops):
                raise InputError(
                    "rig: 'restitution' applies to rigid stops, but the rig has none; a rig with "
                    "at least one rigid stop is accepted"
                )
