"""A rig and its forcing along one parameter: what a branch of orbits is followed in.

Each parameter moves the rig's numbers along a straight line, so that the engine needs only where
the line begins and where it goes.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import parameters as par
from vibroimpact.engine import section_map
from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Harmonic, Oscillator, Stop, to_si
from vibroimpact.model.dimensionless import peak_displacement
from vibroimpact.model.units import (
    ACCELERATION,
    DAMPING,
    DIMENSIONLESS,
    FREQUENCY,
    LENGTH,
    STIFFNESS,
    Quantity,
)
from vibroimpact.response.start import engine_rig

_Array = NDArray[np.float64]

Setting = tuple[Oscillator, Harmonic]

_BUMPERS = (par.BUMPER, par.BUMPER + par.WIDTH)
RATES = [at + par.RATE for at in _BUMPERS]
"""Where the bumpers' rates of relaxation stand in the engine's vector."""


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


class Family(NamedTuple):
    """A rig and its forcing along one parameter."""

    parameter: Parameter
    oscillator: Oscillator
    excitation: Harmonic
    value: float
    """The parameter where the family was made."""
    base: _Array
    direction: _Array
    """The engine's system vector is base + p · direction."""

    @property
    def phase(self) -> float:
        """Forcing phase of the section, rad."""
        return self.excitation.phase

    @property
    def symmetric(self) -> bool:
        """Whether each motion's mirror image is a motion, all along."""
        return self.oscillator.symmetric and not (
            self.parameter.name.startswith(("right_", "left_"))
        )

    def at(self, value: float) -> Setting:
        """The rig and its forcing at a value of the parameter."""
        return self.parameter.write(self.oscillator, self.excitation, value)

    def system(self, value: float) -> _Array:
        """The engine's vector at a value of the parameter."""
        vector = self.base.copy()
        moving = self.direction != 0.0
        vector[moving] += value * self.direction[moving]
        for at in _BUMPERS:
            if vector[at + par.PRESENT] and vector[at + par.BUMPER_DAMPING] > 0.0:
                rate = vector[at + par.BUMPER_STIFFNESS] / vector[at + par.BUMPER_DAMPING]
                vector[at + par.RATE] = rate
        return vector


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


def family(oscillator: Oscillator, excitation: Harmonic, name: str) -> Family:
    """Prepare a rig for being followed along a parameter.

    Raises
    ------
    InputError
        If there is no such parameter, or the rig has none.
    """
    varied = parameter(name)
    value = varied.read(oscillator, excitation)
    step = value or 1.0
    here = system_vector(oscillator, excitation)
    there = system_vector(*varied.write(oscillator, excitation, value + step))
    # A rate follows from stiffness and damping, and is infinite without damping.
    here[RATES] = there[RATES] = np.inf
    same = here == there
    difference = np.subtract(there, here, out=np.zeros_like(here), where=~same)
    direction = difference / step
    base = np.subtract(here, value * direction, out=here.copy(), where=~same)
    return Family(varied, oscillator, excitation, value, base, direction)


def system_vector(oscillator: Oscillator, excitation: Harmonic) -> _Array:
    """The engine's system vector."""
    vector = np.empty(section_map.SYSTEM)
    vector[: section_map.AMPLITUDE] = engine_rig(oscillator)
    vector[section_map.AMPLITUDE] = excitation.amplitude
    vector[section_map.FREQUENCY] = excitation.frequency
    return vector


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
