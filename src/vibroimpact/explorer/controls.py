"""The knobs of a state: one for each number of the rig, in physical and in dimensionless form."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

from vibroimpact.errors import InputError
from vibroimpact.explorer.change import DIMENSIONLESS, OF_RIG, one_sided
from vibroimpact.explorer.laws import free_displacement
from vibroimpact.explorer.state import PageState
from vibroimpact.model import Model, Oscillator
from vibroimpact.model.excitation import Of
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.model.quantities import DAMPING, FORCE, LENGTH, Quantity
from vibroimpact.model.quantities import (
    DIMENSIONLESS as NUMBER,
)
from vibroimpact.model.rig import Rig
from vibroimpact.model.units import pretty
from vibroimpact.model.validation import in_order

TENFOLD = 10.0
WIDE = 60.0
"""Reach of a knob that turns by factors: to either side of where it began; of stops more."""
RANGES = {
    "stiffness_ratio": (0.2, 500.0, True),
    "gap_ratio": (0.0, 1.5, False),
    "relaxation_time": (1e-4, 10.0, True),
    "damping_ratio": (0.01, 0.7, True),
    "exponent": (1.0, 3.0, False),
    "damping_exponent": (0.2, 2.0, False),
    "restitution": (0.0, 1.0, False),
    "beta": (0.0, 1.0, False),
    "gamma": (-1.0, 1.0, False),
}
"""Ends, and whether it turns by factors; of numbers without a unit."""
SYMBOLS = {
    "mass": "M",
    "isolator.stiffness": "K",
    "isolator.damping": "C",
    "stiffness": "K_j",
    "damping": "C_j",
    "gap": "G",
    "damping_ratio": "ξ",
    "isolator_period": "T",
    "stiffness_ratio": "λ",
    "gap_ratio": "δ0",
    "relaxation_time": "τ",
    "restitution": "e",
}


LABELS = {"force": "constant force"}
"""Labels of knobs whose fields do not distinguish them from others."""
AMPLITUDES: dict[Of, tuple[str, str]] = {
    "acceleration": ("base acceleration", "A"),
    "displacement": ("base displacement", "X"),
    "force": ("force amplitude", "F"),
    "unbalance": ("unbalance", "m e"),
}
"""Label and symbol of the amplitude."""


class Control(NamedTuple):
    """One knob."""

    path: str
    group: str
    label: str
    symbol: str
    value: float
    text: str
    """The value with its unit."""
    low: float
    high: float
    log: bool
    """Whether the scale of the knob is logarithmic."""


def controls(state: PageState, first: PageState) -> list[Control]:
    """Return the knobs of a state. Their ranges contain the initial values of the page.

    Raises
    ------
    ArithmeticError
        If a number of the rig, or an end of a range, is not finite.
    """
    knobs = [*_physical(state, first), *_dimensionless(state)]
    for knob in knobs:
        if not (math.isfinite(knob.value) and math.isfinite(knob.high - knob.low)):
            raise OverflowError(knob.path)
        if knob.log and not knob.low > 0.0:
            raise FloatingPointError(knob.path)
    return knobs


def _physical(state: PageState, first: PageState) -> Iterator[Control]:
    rig, old = state.oscillator, first.oscillator
    shaken = state.shaking
    sizes = _Sizes(state)
    begun = first.shaking.amplitude if first.shaking.of == shaken.of else shaken.amplitude
    ends = (begun / TENFOLD, begun * TENFOLD, True)
    label, symbol = AMPLITUDES[shaken.of]
    yield _control("amplitude", "shaking", label, shaken.amplitude, shaken.quantity, ends)._replace(
        symbol=symbol
    )
    yield from _fields(rig, old, "", "mass and isolator", sizes)
    yield from _fields(rig.isolator, old.isolator, "isolator", "mass and isolator", sizes)
    if rig.right == rig.left and state.together:
        if rig.right is not None:
            yield from _fields(rig.right, old.right, "stops", "both stops", sizes)
        return
    for side in SIDES:
        if (stop := getattr(rig, side)) is not None:
            yield from _fields(stop, getattr(old, side), side, f"{side} stop", sizes)


def _fields(
    part: Model, old: Model | None, name: str, group: str, sizes: _Sizes
) -> Iterator[Control]:
    """The numbers of a part of the rig."""
    for field in in_order(type(part)):
        accepts = part._accepts(field)
        value = getattr(part, field)
        if accepts is None or value is None:
            continue
        begun = getattr(old, field) if type(old) is type(part) else value
        stop = name not in ("", "isolator")
        ends = _ends(field, accepts.quantity, begun or 0.0, accepts, sizes, WIDE if stop else None)
        path = f"{name}.{field}" if name else field
        label = LABELS.get(path, field.replace("_", " "))
        yield _control(path, group, label, value, accepts.quantity, ends)


class _Sizes:
    """What is a large value of a quantity where a knob stands at 0: by the free resonance."""

    def __init__(self, state: PageState) -> None:
        rig = state.oscillator
        u, k = free_displacement(state), rig.isolator.initial_stiffness
        self._units = (rig.mass, u, 1.0 / rig.angular_frequency)
        self._known = {FORCE: k * u, LENGTH: 1.2 * u, DAMPING: (k * rig.mass) ** 0.5}

    def of(self, quantity: Quantity, value: float) -> float:
        """Return a large value of a quantity: at least twice the initial value of the knob."""
        return max(self._known.get(quantity) or quantity.size(*self._units), 2.0 * abs(value))


def _ends(
    field: str, quantity: Quantity, begun: float, accepts: Any, sizes: _Sizes, wide: float | None
) -> tuple[float, float, bool]:
    """Range of a knob, and whether it turns by factors."""
    if field in RANGES:
        return RANGES[field]
    factor = wide if wide and field != "mass" else TENFOLD
    if begun > 0.0 and quantity is not LENGTH:
        return begun / factor, begun * factor, True
    large = sizes.of(quantity, begun)
    below = accepts.minimum is None and accepts.above is None and field != "gap"
    return (-large if below else 0.0), large, False


def _dimensionless(state: PageState) -> Iterator[Control]:
    """The numbers of the paper's Section 7, where the rig has them."""
    rig, group = state.oscillator, "dimensionless"
    for name in OF_RIG:
        value = _read(rig, state, name)
        if value is not None:
            ends = RANGES.get(name, (value / TENFOLD, value * TENFOLD, True))
            yield _control(
                name, group, name.replace("_", " "), value, PARAMETERS[name].quantity, ends
            )
    both = rig.right == rig.left and state.together
    for side in ("stops",) if both else SIDES:
        alone = rig if both else one_sided_or_none(rig, side)
        for name in DIMENSIONLESS:
            value = None if alone is None else _read(alone, state, name)
            if value is None:
                continue
            words = name.replace("_", " ")
            label = words if both else f"{words}, {side}"
            yield _control(f"{side}.{name}", group, label, value, NUMBER, RANGES[name])


def one_sided_or_none(rig: Oscillator, side: str) -> Oscillator | None:
    """Return the oscillator with the stop of one side only.

    Return None if there is no such stop, or if nothing would then hold the mass.
    """
    try:
        return one_sided(rig, side) if getattr(rig, side) is not None else None
    except InputError:
        return None


def _read(rig: Oscillator, state: PageState, name: str) -> float | None:
    """A dimensionless number of the rig, if it has it."""
    bumpers = all(stop.spring_and_dashpot for stop in rig.stops.values())
    if name in ("stiffness_ratio", "relaxation_time") and not bumpers:
        return None
    try:
        return PARAMETERS[name].read(Rig(rig, state.shaking))
    except InputError:
        return None


def _control(
    path: str,
    group: str,
    label: str,
    value: float,
    quantity: Quantity,
    ends: tuple[float, float, bool],
) -> Control:
    """A knob, its range wide enough for the value."""
    low, high, log = ends
    low, high = min(low, value) if value > 0.0 or not log else low, max(high, value)
    symbol = SYMBOLS.get(path) or SYMBOLS.get(path.rpartition(".")[2], "")
    if path.startswith("isolator.") and path not in SYMBOLS:
        symbol = ""
    text = pretty(value, quantity, 4)
    return Control(path, group, label, symbol, value, text, low, high, log)
