"""The quantities of a rig and its forcing that can be varied, one registry of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from vibroimpact.errors import InputError
from vibroimpact.model.dimensionless import peak_displacement
from vibroimpact.model.excitation import Harmonic
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.stops import Bumper, Stop
from vibroimpact.model.units import (
    ACCELERATION,
    DAMPING,
    DIMENSIONLESS,
    FREQUENCY,
    LENGTH,
    STIFFNESS,
    Quantity,
    to_si,
)

Setting = tuple[Oscillator, Harmonic]


class Parameter(NamedTuple):
    """One quantity that can be varied."""

    name: str
    quantity: Quantity
    units: str
    long_name: str
    read: Callable[[Oscillator, Harmonic], float]
    write: Callable[[Oscillator, Harmonic, float], Setting]


def _number(stop: Stop, name: str) -> float:
    """A field of a stop, if it has it."""
    if name not in type(stop).model_fields:
        raise InputError(
            f"parameter: {stop} has no {name}; "
            f"its {' or '.join(type(stop).model_fields)} is accepted, or a rig with bumpers"
        )
    return float(getattr(stop, name))


def _bumpers(name: str) -> tuple[Callable[..., float], Callable[..., Setting]]:
    """Read and write a number that both bumpers share."""

    def read(rig: Oscillator, shaken: Harmonic) -> float:
        values = {_number(stop, name) for stop in rig.stops}
        if len(values) != 1:
            told = "there is no bumper" if not values else f"they are {sorted(values)}"
            raise InputError(
                f"parameter: {name!r} is that of both bumpers, but {told}; "
                f"'right_{name}' and 'left_{name}' are accepted, or a rig in which they agree"
            )
        return float(values.pop())

    def write(rig: Oscillator, shaken: Harmonic, value: float) -> Setting:
        changed = {
            side: bumper.replace(**{name: value})
            for side, bumper in (("right", rig.right), ("left", rig.left))
            if bumper is not None
        }
        return rig.replace(**changed), shaken

    return read, write


def _one_bumper(side: str, name: str) -> tuple[Callable[..., float], Callable[..., Setting]]:
    def bumper(rig: Oscillator) -> Stop:
        found: Stop | None = getattr(rig, side)
        if found is None:
            raise InputError(f"parameter: there is no {side} bumper; one that is there is accepted")
        return found

    def read(rig: Oscillator, shaken: Harmonic) -> float:
        return _number(bumper(rig), name)

    def write(rig: Oscillator, shaken: Harmonic, value: float) -> Setting:
        return rig.replace(**{side: bumper(rig).replace(**{name: value})}), shaken

    return read, write


def _isolator(name: str) -> tuple[Callable[..., float], Callable[..., Setting]]:
    return (
        lambda rig, shaken: float(getattr(rig.isolator, name)),
        lambda rig, shaken, value: (
            rig.replace(isolator=rig.isolator.replace(**{name: value})),
            shaken,
        ),
    )


def _forcing(name: str) -> tuple[Callable[..., float], Callable[..., Setting]]:
    return (
        lambda rig, shaken: float(getattr(shaken, name)),
        lambda rig, shaken, value: (rig, shaken.replace(**{name: value})),
    )


_READ_STIFFNESS, _ = _bumpers("stiffness")
_READ_GAP, _WRITE_GAP = _bumpers("gap")


def _stiffness_ratio(rig: Oscillator, shaken: Harmonic) -> float:
    return _READ_STIFFNESS(rig, shaken) / rig.isolator.stiffness


def _set_stiffness_ratio(rig: Oscillator, shaken: Harmonic, value: float) -> Setting:
    """λ = K_j/K at a fixed relaxation time C_j/K_j."""
    changed = {}
    for side, bumper in (("right", rig.right), ("left", rig.left)):
        if isinstance(bumper, Bumper):
            stiffness = value * rig.isolator.stiffness
            time = bumper.damping / bumper.stiffness
            changed[side] = bumper.replace(stiffness=stiffness, damping=stiffness * time)
    return rig.replace(**changed), shaken


def _gap_ratio(rig: Oscillator, shaken: Harmonic) -> float:
    return _READ_GAP(rig, shaken) / peak_displacement(rig, shaken.amplitude)


def _set_gap_ratio(rig: Oscillator, shaken: Harmonic, value: float) -> Setting:
    return _WRITE_GAP(rig, shaken, value * peak_displacement(rig, shaken.amplitude))


PARAMETERS: dict[str, Parameter] = {
    p.name: p
    for p in (
        Parameter("frequency", FREQUENCY, "Hz", "excitation frequency", *_forcing("frequency")),
        Parameter(
            "amplitude", ACCELERATION, "m s-2", "peak base acceleration", *_forcing("amplitude")
        ),
        Parameter("gap", LENGTH, "m", "gap of each side", *_bumpers("gap")),
        Parameter("right_gap", LENGTH, "m", "gap of the right side", *_one_bumper("right", "gap")),
        Parameter("left_gap", LENGTH, "m", "gap of the left side", *_one_bumper("left", "gap")),
        Parameter(
            "bumper_stiffness",
            STIFFNESS,
            "N m-1",
            "stiffness of both bumpers",
            *_bumpers("stiffness"),
        ),
        Parameter(
            "bumper_damping", DAMPING, "N s m-1", "damping of both bumpers", *_bumpers("damping")
        ),
        Parameter(
            "stiffness", STIFFNESS, "N m-1", "stiffness of the isolator", *_isolator("stiffness")
        ),
        Parameter("damping", DAMPING, "N s m-1", "damping of the isolator", *_isolator("damping")),
        Parameter(
            "stiffness_ratio",
            DIMENSIONLESS,
            "1",
            "stiffness ratio λ of the bumpers",
            _stiffness_ratio,
            _set_stiffness_ratio,
        ),
        Parameter(
            "gap_ratio", DIMENSIONLESS, "1", "gap ratio δ0 of each side", _gap_ratio, _set_gap_ratio
        ),
    )
}
"""By name. `stiffness_ratio` keeps the bumpers' relaxation time, `gap_ratio` the free-flight peak.
"""


def parameter(name: str, field: str = "parameter") -> Parameter:
    """Look a parameter up.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    key = name.replace("-", "_") if isinstance(name, str) else name
    if key not in PARAMETERS:
        raise InputError(f"{field}: {name!r}; one of {', '.join(PARAMETERS)} is accepted")
    return PARAMETERS[key]


def bounds(varied: Parameter, low: float | str, high: float | str) -> tuple[float, float]:
    """Read the ends of a range.

    Raises
    ------
    InputError
        If one cannot be used, or the range is empty.
    """
    ends = [to_si(v, varied.quantity, f, minimum=0.0) for v, f in ((low, "low"), (high, "high"))]
    if not ends[0] < ends[1]:
        raise InputError(
            f"high: {ends[1]:g} does not lie above low, {ends[0]:g}; a larger value is accepted"
        )
    return ends[0], ends[1]
