"""How a parameter is read from a rig and its forcing, and written into them."""

from __future__ import annotations

import math
from collections.abc import Callable

from vibroimpact.errors import InputError
from vibroimpact.model.excitation import Harmonic, Repeated
from vibroimpact.model.isolators.law import spring_and_dashpot
from vibroimpact.model.largest_free_response import peak_displacement
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.quantities import Quantity
from vibroimpact.model.stops import Bumper, Stop
from vibroimpact.model.validation import Model

Setting = tuple[Oscillator, Repeated]
"""A rig and its forcing."""

Read = Callable[[Oscillator, Repeated], float]
Write = Callable[[Oscillator, Repeated, float], Setting]


def number(part: Model, name: str, whose: str = "stops have") -> float:
    """A number of an isolator or a stop, if it has it."""
    value = getattr(part, name) if name in type(part).model_fields else None
    if value is None or isinstance(value, str | int):
        numbers = [key for key, held in dict(part).items() if isinstance(held, float)]
        raise InputError(
            f"parameter: {part} has no {name} that can be varied; "
            f"its {' or '.join(numbers)} is accepted, or a rig whose {whose} one"
        )
    return float(value)


def quantity(part: Model, name: str, whose: str = "stops have") -> Quantity:
    """What a number of an isolator or a stop is."""
    number(part, name, whose)
    accepts = part.accepts(name)
    assert accepts is not None
    return accepts.quantity


def bumpers(name: str) -> tuple[Read, Write]:
    """Read and write a number that both bumpers share."""

    def read(rig: Oscillator, shaken: Repeated) -> float:
        stops = [stop for stop in rig.stops if name in type(stop).model_fields] or rig.stops
        values = {number(stop, name) for stop in stops}
        kinds = {quantity(stop, name) for stop in stops}
        if len(values) != 1 or len(kinds) != 1:
            told = (
                "there is no bumper"
                if not values
                else f"they are {sorted(values)}"
                if len(kinds) == 1
                else f"they are in {' and '.join(sorted(kind.symbol for kind in kinds))}"
            )
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


def one_bumper(side: str, name: str) -> tuple[Read, Write]:
    """Read and write a number of the stop on one side."""

    def bumper(rig: Oscillator) -> Stop:
        found: Stop | None = getattr(rig, side)
        if found is None:
            raise InputError(f"parameter: there is no {side} bumper; one that is there is accepted")
        return found

    def read(rig: Oscillator, shaken: Repeated) -> float:
        return number(bumper(rig), name)

    def write(rig: Oscillator, shaken: Repeated, value: float) -> Setting:
        return rig.replace(**{side: bumper(rig).replace(**{name: value})}), shaken

    return read, write


def rig(name: str) -> tuple[Read, Write]:
    """Read and write a number of the oscillator itself."""
    return (
        lambda rig, shaken: float(getattr(rig, name)),
        lambda rig, shaken, value: (rig.replace(**{name: value}), shaken),
    )


def isolator(name: str) -> tuple[Read, Write]:
    """Read and write a number of the isolator."""
    return (
        lambda rig, shaken: number(rig.isolator, name, "isolator has"),
        lambda rig, shaken, value: (
            rig.replace(isolator=rig.isolator.replace(**{name: value})),
            shaken,
        ),
    )


def forcing(name: str) -> tuple[Read, Write]:
    """Read and write a number of what shakes the rig."""
    return (
        lambda rig, shaken: float(getattr(shaken, name)),
        lambda rig, shaken, value: (rig, shaken.replace(**{name: value})),
    )


def spring(rig: Oscillator, name: str) -> float:
    """The isolator's K, for a ratio that only linear laws have."""
    rig.check_linear(f"{name!r}")
    return rig.isolator.initial_stiffness


def in_proportion(unit: Callable[[Oscillator], float]) -> tuple[Read, Write]:
    """The bumpers' stiffness over a unit, at a fixed relaxation time C_j/K_j."""
    stiffness_of, _ = bumpers("stiffness")

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


def at_restitution() -> tuple[Read, Write]:
    """The bumpers' stiffness at a fixed restitution: C_j as √(K_j M), as `from_restitution`."""
    stiffness_of, _ = bumpers("stiffness")

    def read(rig: Oscillator, shaken: Repeated) -> float:
        for stop in rig.stops:
            if "stiffness" in type(stop).model_fields and not isinstance(stop, Bumper):
                raise InputError(
                    f"parameter: {stop} keeps its restitution at any stiffness; "
                    "'bumper_stiffness' is accepted"
                )
        return stiffness_of(rig, shaken)

    def write(rig: Oscillator, shaken: Repeated, value: float) -> Setting:
        changed = {
            side: bumper.replace(
                stiffness=value, damping=bumper.damping * math.sqrt(value / bumper.stiffness)
            )
            for side, bumper in (("right", rig.right), ("left", rig.left))
            if isinstance(bumper, Bumper)
        }
        return rig.replace(**changed), shaken

    return read, write


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


def gap_ratio() -> tuple[Read, Write]:
    """δ0 = G0_j/u_max at a fixed peak of free flight."""
    gap_of, with_gap = bumpers("gap")

    def read(rig: Oscillator, shaken: Repeated) -> float:
        return gap_of(rig, shaken) / peak_displacement(rig, scale_of(rig, shaken))

    def write(rig: Oscillator, shaken: Repeated, value: float) -> Setting:
        return with_gap(rig, shaken, value * peak_displacement(rig, scale_of(rig, shaken)))

    return read, write


def relaxation_time() -> tuple[Read, Write]:
    """τ = ω0 C_j/K_j at a fixed stiffness."""

    def read(rig: Oscillator, shaken: Repeated) -> float:
        rig.check_linear("'relaxation_time'")
        times = [number(stop, "damping") / number(stop, "stiffness") for stop in rig.stops]
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


def isolator_period() -> tuple[Read, Write]:
    """T = 2π √(M/K) at fixed mass and damping ratio."""

    def read(rig: Oscillator, shaken: Repeated) -> float:
        number(rig.isolator, "stiffness", "isolator has")
        return 1.0 / rig.natural_frequency

    def write(rig: Oscillator, shaken: Repeated, value: float) -> Setting:
        made = spring_and_dashpot(rig.mass, value, rig.damping_ratio)
        return rig.replace(isolator=rig.isolator.replace(**made)), shaken

    return read, write


def damping_ratio() -> tuple[Read, Write]:
    """ξ = C/(2√(K M)) at fixed stiffness and mass."""

    def write(rig: Oscillator, shaken: Repeated, value: float) -> Setting:
        damping = value * rig.critical_damping
        return rig.replace(isolator=rig.isolator.replace(damping=damping)), shaken

    return lambda rig, shaken: rig.damping_ratio, write
