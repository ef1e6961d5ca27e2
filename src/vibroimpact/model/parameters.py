"""The parameters of a rig and its forcing: one registry for all that varies them.

Branches, curves, maps and the command line ask here for the name, the unit and the meaning of a
parameter, and for its value in a rig and the rig at another value. A new one is one entry of
`PARAMETERS`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from vibroimpact.errors import InputError
from vibroimpact.model.dimensionless import peak_displacement
from vibroimpact.model.excitation import QUANTITIES, Harmonic, Of, Repeated
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.quantities import (
    ACCELERATION,
    DAMPING,
    DIMENSIONLESS,
    FORCE,
    FREQUENCY,
    LENGTH,
    STIFFNESS,
    Quantity,
)
from vibroimpact.model.stops import Bumper, Stop
from vibroimpact.model.units import to_si

Setting = tuple[Oscillator, Repeated]
"""A rig and its forcing."""

Read = Callable[[Oscillator, Repeated], float]
Write = Callable[[Oscillator, Repeated, float], Setting]

_UNITS = {
    FREQUENCY: "Hz",
    ACCELERATION: "m s-2",
    LENGTH: "m",
    STIFFNESS: "N m-1",
    DAMPING: "N s m-1",
    DIMENSIONLESS: "1",
    FORCE: "N",
}
"""As datasets write them."""


_PEAKS = {"displacement": "peak base displacement", "force": "peak force on the mass"}


class Parameter(NamedTuple):
    """One quantity that can be varied."""

    name: str
    quantity: Quantity
    long_name: str
    read: Read
    """Its value in a rig; refused where the rig has none."""
    write: Write
    """The rig and the forcing at another value."""
    zero: bool = True
    """Whether it may be 0."""
    comment: str = ""
    """Its definition."""
    least: float | None = 0.0
    most: float | None = None
    """What it may not fall below and not exceed; None for no bound."""

    @property
    def units(self) -> str:
        """The SI unit, as datasets write it."""
        return _UNITS[self.quantity]

    def beside(self, value: float, factor: float = 2.0) -> float:
        """Another value that it may have, so many times as large or as small; 0 counts as 1."""
        larger = factor * value if value else factor - 1.0
        if self.most is None or larger <= self.most:
            return larger
        return value / factor if value else self.most

    @property
    def physical(self) -> bool:
        """Whether it has a unit."""
        return self.quantity is not DIMENSIONLESS


def parameter(name: str, field: str = "parameter", of: Of = "acceleration") -> Parameter:
    """Look a parameter up; `of` says what an amplitude is one of.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    key = name.replace("-", "_") if isinstance(name, str) else name
    if key not in PARAMETERS:
        raise InputError(f"{field}: {name!r}; one of {', '.join(PARAMETERS)} is accepted")
    if key == "amplitude" and of != "acceleration":
        return PARAMETERS[key]._replace(quantity=QUANTITIES[of], long_name=_PEAKS[of])
    return PARAMETERS[key]


def bounds(varied: Parameter, low: float | str, high: float | str) -> tuple[float, float]:
    """Read the ends of a range.

    Raises
    ------
    InputError
        If one cannot be used, or the range is empty.
    """
    ends = [
        to_si(given, varied.quantity, field, minimum=varied.least, maximum=varied.most)
        for given, field in ((low, "low"), (high, "high"))
    ]
    if not ends[0] < ends[1]:
        raise InputError(
            f"high: {ends[1]:g} does not lie above low, {ends[0]:g}; a larger value is accepted"
        )
    return ends[0], ends[1]


def scale_of(oscillator: Oscillator, shaken: Repeated) -> float:
    """Return the peak base acceleration (m/s²) by which gaps are scaled whatever shakes the mass.

    Of a displacement X of the base it is X ω0², of a force F on the mass F/M: the largest
    displacement in free flight is the same under it (see `peak_displacement`).

    Raises
    ------
    InputError
        If several harmonics shake it.
    """
    if not isinstance(shaken, Harmonic):
        raise InputError(
            "gap_ratio: gaps are scaled by the peak of free flight under one sine, and several "
            "harmonics shake the mass; a Harmonic, or a gap in metres, is accepted"
        )
    return float(shaken.acceleration(oscillator.mass, oscillator.angular_frequency))


def _number(stop: Stop, name: str) -> float:
    """A field of a stop, if it has it."""
    if name not in type(stop).model_fields:
        raise InputError(
            f"parameter: {stop} has no {name}; "
            f"its {' or '.join(type(stop).model_fields)} is accepted, or a rig whose stops have one"
        )
    return float(getattr(stop, name))


def _bumpers(name: str) -> tuple[Read, Write]:
    """Read and write a number that both bumpers share."""

    def read(rig: Oscillator, shaken: Repeated) -> float:
        values = {_number(stop, name) for stop in rig.stops}
        if len(values) != 1:
            told = "there is no bumper" if not values else f"they are {sorted(values)}"
            raise InputError(
                f"parameter: {name!r} is that of both bumpers, but {told}; "
                f"'right_{name}' and 'left_{name}' are accepted, or a rig in which they agree"
            )
        return float(values.pop())

    def write(rig: Oscillator, shaken: Repeated, value: float) -> Setting:
        changed = {
            side: stop.replace(**{name: value})
            for side, stop in (("right", rig.right), ("left", rig.left))
            if stop is not None and name in type(stop).model_fields
        }
        return rig.replace(**changed), shaken

    return read, write


def _one_bumper(side: str, name: str) -> tuple[Read, Write]:
    def bumper(rig: Oscillator) -> Stop:
        found: Stop | None = getattr(rig, side)
        if found is None:
            raise InputError(f"parameter: there is no {side} bumper; one that is there is accepted")
        return found

    def read(rig: Oscillator, shaken: Repeated) -> float:
        return _number(bumper(rig), name)

    def write(rig: Oscillator, shaken: Repeated, value: float) -> Setting:
        return rig.replace(**{side: bumper(rig).replace(**{name: value})}), shaken

    return read, write


def _rig(name: str) -> tuple[Read, Write]:
    return (
        lambda rig, shaken: float(getattr(rig, name)),
        lambda rig, shaken, value: (rig.replace(**{name: value}), shaken),
    )


def _isolator(name: str) -> tuple[Read, Write]:
    return (
        lambda rig, shaken: float(getattr(rig.isolator, name)),
        lambda rig, shaken, value: (
            rig.replace(isolator=rig.isolator.replace(**{name: value})),
            shaken,
        ),
    )


def _forcing(name: str) -> tuple[Read, Write]:
    return (
        lambda rig, shaken: float(getattr(shaken, name)),
        lambda rig, shaken, value: (rig, shaken.replace(**{name: value})),
    )


def _in_proportion(unit: Callable[[Oscillator], float]) -> tuple[Read, Write]:
    """The bumpers' stiffness over a unit, at a fixed relaxation time C_j/K_j."""
    stiffness_of, _ = _bumpers("stiffness")

    def read(rig: Oscillator, shaken: Repeated) -> float:
        return stiffness_of(rig, shaken) / unit(rig)

    def write(rig: Oscillator, shaken: Repeated, value: float) -> Setting:
        changed = {}
        for side, bumper in (("right", rig.right), ("left", rig.left)):
            if isinstance(bumper, Bumper):
                stiffness = value * unit(rig)
                time = bumper.damping / bumper.stiffness
                changed[side] = bumper.replace(stiffness=stiffness, damping=stiffness * time)
        return rig.replace(**changed), shaken

    return read, write


def _gap_ratio() -> tuple[Read, Write]:
    """δ0 = G0_j/u_max at a fixed peak of free flight."""
    gap_of, with_gap = _bumpers("gap")

    def read(rig: Oscillator, shaken: Repeated) -> float:
        return gap_of(rig, shaken) / peak_displacement(rig, scale_of(rig, shaken))

    def write(rig: Oscillator, shaken: Repeated, value: float) -> Setting:
        return with_gap(rig, shaken, value * peak_displacement(rig, scale_of(rig, shaken)))

    return read, write


def _relaxation_time() -> tuple[Read, Write]:
    """τ = ω0 C_j/K_j at a fixed stiffness."""

    def read(rig: Oscillator, shaken: Repeated) -> float:
        times = [_number(stop, "damping") / _number(stop, "stiffness") for stop in rig.stops]
        if not times or not math.isclose(min(times), max(times), rel_tol=1e-12):
            told = "there is no bumper" if not times else f"their C/K are {sorted(times)} s"
            raise InputError(
                f"parameter: 'relaxation_time' is that of both bumpers, but {told}; "
                "'right_damping' and 'left_damping' are accepted, or a rig in which they agree"
            )
        return rig.angular_frequency * times[0]

    def write(rig: Oscillator, shaken: Repeated, value: float) -> Setting:
        changed = {
            side: bumper.replace(damping=value * bumper.stiffness / rig.angular_frequency)
            for side, bumper in (("right", rig.right), ("left", rig.left))
            if isinstance(bumper, Bumper)
        }
        return rig.replace(**changed), shaken

    return read, write


def _damping_ratio() -> tuple[Read, Write]:
    """ξ = C/(2√(K M)) at fixed stiffness and mass."""

    def write(rig: Oscillator, shaken: Repeated, value: float) -> Setting:
        damping = 2.0 * value * math.sqrt(rig.isolator.stiffness * rig.mass)
        return rig.replace(isolator=rig.isolator.replace(damping=damping)), shaken

    return lambda rig, shaken: rig.damping_ratio, write


def _of_stops(
    field: str,
    both: str,
    quantity: Quantity,
    zero: bool = True,
    stop: str = "bumper",
    most: float | None = None,
) -> Iterator[Parameter]:
    """A field of the stops: of both, and of each side."""
    yield Parameter(both, quantity, f"{field} of both {stop}s", *_bumpers(field), zero, most=most)
    for side in ("right", "left"):
        named = f"{field} of the {side} {stop}"
        read, write = _one_bumper(side, field)
        yield Parameter(f"{side}_{field}", quantity, named, read, write, zero, most=most)


PARAMETERS: dict[str, Parameter] = {
    p.name: p
    for p in (
        Parameter("frequency", FREQUENCY, "excitation frequency", *_forcing("frequency"), False),
        Parameter(
            "amplitude", ACCELERATION, "peak base acceleration", *_forcing("amplitude"), False
        ),
        Parameter("force", FORCE, "constant force on the mass", *_rig("force"), least=None),
        Parameter("gap", LENGTH, "gap of each side", *_bumpers("gap"), least=None),
        *(
            Parameter(
                f"{side}_gap",
                LENGTH,
                f"gap of the {side} side",
                *_one_bumper(side, "gap"),
                least=None,
            )
            for side in ("right", "left")
        ),
        *_of_stops("stiffness", "bumper_stiffness", STIFFNESS, False),
        Parameter(
            "proportional_stiffness",
            STIFFNESS,
            "stiffness of both bumpers, their damping in proportion",
            *_in_proportion(lambda rig: 1.0),
            False,
        ),
        *_of_stops("damping", "bumper_damping", DAMPING),
        *_of_stops("restitution", "restitution", DIMENSIONLESS, stop="rigid stop", most=1.0),
        Parameter("stiffness", STIFFNESS, "stiffness of the isolator", *_isolator("stiffness")),
        Parameter("damping", DAMPING, "damping of the isolator", *_isolator("damping")),
        Parameter(
            "stiffness_ratio",
            DIMENSIONLESS,
            "stiffness ratio of the bumpers",
            *_in_proportion(lambda rig: rig.isolator.stiffness),
            False,
            "K_j / K",
        ),
        Parameter(
            "gap_ratio",
            DIMENSIONLESS,
            "gap ratio of each side",
            *_gap_ratio(),
            comment="G / u_max",
            least=None,
        ),
        Parameter(
            "relaxation_time",
            DIMENSIONLESS,
            "relaxation time of the bumpers",
            *_relaxation_time(),
            comment="ω0 C_j / K_j",
        ),
        Parameter(
            "damping_ratio",
            DIMENSIONLESS,
            "damping ratio of the isolator",
            *_damping_ratio(),
            False,
            "C / (2 √(K M))",
        ),
    )
}
"""By name. `bumper_stiffness` keeps the bumpers' damping C_j, `proportional_stiffness` and
`stiffness_ratio` keep their C_j/K_j, the other ratios keep what else they are made of."""
