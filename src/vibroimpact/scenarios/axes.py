"""The quantities over which a map can be drawn, and the rig of each of its nodes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.arguments import check_list, check_mapping, check_name
from vibroimpact.errors import InputError, alternatives, unknown
from vibroimpact.model import Harmonic
from vibroimpact.model.derived_parameters import largest_free_displacement
from vibroimpact.model.excitation import Of
from vibroimpact.model.parameter_ranges import entries, field_of
from vibroimpact.model.parameters import PARAMETERS, canonical, set_values, usual
from vibroimpact.model.periodic_shaking import ANY_FREQUENCY, as_periodic
from vibroimpact.model.quantity_lists import check_stated_units, read_rising
from vibroimpact.model.rig import Rig

_Array = NDArray[np.float64]


NAMES = (
    "gap",
    "amplitude",
    "stops.stiffness",
    "proportional_stiffness",
    "stops.restitution",
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
    {"stops.stiffness", "stiffness_ratio"},
    {"stops.stiffness", "proportional_stiffness"},
)
"""Pairs that say the same of one rig."""

_SPACING = 'a dict of "log" or "linear" by parameter, such as {"stiffness_ratio": "log"}'

_OF_BUMPERS = ("stops.stiffness", "proportional_stiffness", "stiffness_ratio", "relaxation_time")


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


def read_axes(vary: object, spacing: object, of: Of = "acceleration") -> tuple[Axis, Axis]:
    """Read the axes x and y of a map: parameters and values, and spacings that are not clear.

    `of` is the quantity of amplitudes. The two parameters must go together.
    """
    grids = entries(vary, 2, 2)
    names = [_name(name, "vary") for name in grids]
    if names[0] == names[1]:
        raise InputError(
            f"vary: {' and '.join(map(repr, grids))} are the same parameter; replace one of the two"
        )
    spaced = check_mapping({} if spacing is None else spacing, "spacing", _SPACING)
    kinds: dict[str, str] = {}
    for name, kind in spaced.items():
        known = _name(name, "spacing")
        if known not in names:
            raise InputError(
                f"spacing: {name!r} is not an axis of this map; use {alternatives(names)}"
            )
        kinds[known] = check_name(kind, ("log", "linear"), f"spacing[{name!r}]")
    x, y = (
        _axis(name, values, field_of(written), kinds.get(name), of)
        for name, (written, values) in zip(names, grids.items(), strict=True)
    )
    check_pair(x, y)
    return x, y


def _name(name: str, field: str) -> str:
    known = canonical(name, NAMES)
    if known not in NAMES:
        raise InputError(f"{field}: {unknown(name, NAMES)}")
    return known


def _axis(name: str, values: object, field: str, spacing: str | None, of: Of) -> Axis:
    varied = usual(name, of)
    limits: dict[str, Any] = {"minimum": 0.0} if varied.zero else {"above": 0.0}
    numbers = read_rising(values, varied.quantity, field, 2, **limits, maximum=varied.most)
    check_stated_units(check_list(values, field), varied.quantity, field)
    if name == "damping_ratio" and numbers[-1] >= math.sqrt(0.5):
        raise InputError(
            f"{field}[{len(numbers) - 1}]: at a damping ratio of {numbers[-1]:g}, there is no "
            "resonance peak; pass values below 0.707107"
        )
    spaced = spacing == "log" if spacing else logarithmic(numbers)
    if spaced and numbers[0] <= 0.0:
        raise InputError(
            f"{field}[0]: 0 is not possible on a logarithmic axis; pass values above 0, or use a "
            "linear axis"
        )
    return Axis(name, numbers, spaced)


def check_pair(x: Axis, y: Axis) -> None:
    """Refuse two axes of one quantity."""
    if {x.name, y.name} in ONE_QUANTITY:
        raise InputError(
            f"vary: {y.name!r} varies the same quantity as {x.name!r}; choose another parameter "
            "for y"
        )


def one_sine(rig: Rig, where: str = "shaking") -> Rig:
    """Check that one sine shakes a rig; its frequency is left open.

    The mass must have a spring.
    """
    oscillator = rig.oscillator
    shaken, _ = as_periodic(rig.shaking, where)
    if rig.amplitudes is not None:
        raise InputError(
            f"{where}: {len(rig.amplitudes)} amplitudes, but a scenario is defined for one "
            "amplitude at all frequencies; pass one amplitude"
        )
    if not isinstance(shaken, Harmonic):
        raise InputError(
            f"{where}: scenarios are not defined for a Periodic, because its harmonics cause "
            "further resonances even without stops; pass a Harmonic"
        )
    if oscillator.isolator.initial_stiffness == 0.0:
        raise InputError(
            "isolator.stiffness: 0, but a scenario requires a natural frequency; set a stiffness "
            "greater than 0"
        )
    open_sine = shaken.replace(frequency=ANY_FREQUENCY, phase=0.0)
    return Rig.of_open_frequency(oscillator, open_sine, rig.name)


def rig_at(base: Rig, values: Mapping[str, float]) -> Rig:
    """The rig at a node, whose other parameters are those of a base.

    Parameters are set on both sides, where the stop has them, each as `PARAMETERS` does. If all of
    them are dimensionless, the gap ratio is kept where it is not varied.

    Raises
    ------
    InputError
        If there is no stop to set, or the base has no dimensionless parameters.
    """
    _check_stops(base, values)
    made = set_values(base, values)
    physical = any(PARAMETERS[name].physical for name in values)
    if physical or "gap_ratio" in values or "damping_ratio" not in values:
        return made
    grown = largest_free_displacement(made) / largest_free_displacement(base)
    sides = {
        side: stop.replace(gap=grown * stop.gap) for side, stop in made.oscillator.stops.items()
    }
    return made.with_parts(made.oscillator.replace(**sides))


def _check_stops(base: Rig, values: Mapping[str, float]) -> None:
    stops = base.oscillator.stops.values()
    if not stops:
        raise InputError("rig: there is no stop; pass a rig with one or two stops")
    for name in values:
        if name in _OF_BUMPERS and not any(stop.spring_and_dashpot for stop in stops):
            raise InputError(
                f"rig: {name!r} applies to bumpers, but this rig has none; vary 'gap', "
                "'gap_ratio', 'stops.restitution', 'amplitude' or 'damping_ratio' instead"
            )
        if name == "stops.restitution" and not PARAMETERS[name].numbers(base):
            raise InputError(
                "rig: 'stops.restitution' applies to rigid stops and other laws that have it, "
                "but this rig has none; vary another parameter, or pass a rig with such a stop"
            )
