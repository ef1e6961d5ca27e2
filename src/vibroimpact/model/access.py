"""Read the value of a parameter from a rig, and make the rig at another value."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable

from vibroimpact.errors import InputError, meant
from vibroimpact.model.excitation import Harmonic
from vibroimpact.model.isolators.law import spring_and_dashpot
from vibroimpact.model.largest_free_response import peak_displacement
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.own_law import Law
from vibroimpact.model.quantities import DIMENSIONLESS, Quantity
from vibroimpact.model.rig import Rig
from vibroimpact.model.stops import Bumper, Stop
from vibroimpact.model.validation import Model

Read = Callable[[Rig], float]
"""Function that returns the value of a parameter in a rig."""
Vary = Callable[[Rig, float], Rig]
"""Function that returns the rig with another value of a parameter."""


def number(part: Model, name: str, whose: str = "stops have") -> float:
    """Return the value of a field of an isolator or a stop.

    Raises
    ------
    InputError
        If the part has no such field, or if the field is not a number.
    """
    value = getattr(part, name) if name in type(part).model_fields else None
    if value is None or isinstance(value, str | int):
        own = " or ".join(_numbers(part))
        own = f"vary its {own}, or " if own else ""
        raise InputError(
            f"parameter: {part} has no {name} that can be varied; {own}use a rig whose {whose} "
            f"{'an' if name[0] in 'aeiou' else 'a'} {name}"
        )
    return float(value)


def _numbers(part: Model) -> list[str]:
    return [key for key, value in dict(part).items() if isinstance(value, float)]


def quantity(part: Model, name: str, whose: str = "stops have") -> Quantity:
    """Return the quantity of a field of an isolator or a stop."""
    number(part, name, whose)
    accepts = part.accepts(name)
    assert accepts is not None
    return accepts.quantity


def shared(name: str, values: set[float], kinds: set[Quantity]) -> float:
    """Return the value that both bumpers have in common.

    Raises
    ------
    InputError
        If there is no bumper, or if the values or the units of the bumpers differ.
    """
    if not values:
        raise InputError(
            f"parameter: the rig has no bumper whose {name} can be varied; use a rig with a bumper"
        )
    if len(values) != 1 or len(kinds) != 1:
        symbols = sorted(kind.symbol for kind in kinds)
        told = (
            f"values of {name}, {' and '.join(map(str, sorted(values)))} {symbols[0]}".rstrip()
            if len(kinds) == 1
            else f"units of {name}, {' and '.join(symbols)}"
        )
        raise InputError(
            f"parameter: the two bumpers have different {told}; use 'right_{name}' or "
            f"'left_{name}', or a rig with equal bumpers"
        )
    return float(next(iter(values)))


def bumpers(name: str) -> tuple[Read, Vary]:
    """Return the functions that read and vary a value of both bumpers."""

    def read(rig: Rig) -> float:
        oscillator = rig.oscillator
        stops = [
            stop for stop in oscillator.stops if name in type(stop).model_fields
        ] or oscillator.stops
        return shared(
            name,
            {number(stop, name) for stop in stops},
            {quantity(stop, name) for stop in stops},
        )

    def vary(rig: Rig, value: float) -> Rig:
        oscillator = rig.oscillator
        changed = {
            side: stop.replace(**{name: value})
            for side, stop in (("right", oscillator.right), ("left", oscillator.left))
            if stop is not None and name in type(stop).model_fields
        }
        return rig.with_parts(oscillator.replace(**changed))

    return read, vary


def one_bumper(side: str, name: str) -> tuple[Read, Vary]:
    """Return the functions that read and vary a value of the stop on one side."""

    def bumper(rig: Oscillator) -> Stop:
        found: Stop | None = getattr(rig, side)
        if found is None:
            raise InputError(
                f"parameter: '{side}_{name}' applies to the {side} stop, but the rig has none; use "
                f"a rig with a {side} stop"
            )
        return found

    def read(rig: Rig) -> float:
        oscillator = rig.oscillator
        return number(bumper(oscillator), name)

    def vary(rig: Rig, value: float) -> Rig:
        oscillator = rig.oscillator
        return rig.with_parts(
            oscillator.replace(**{side: bumper(oscillator).replace(**{name: value})})
        )

    return read, vary


def oscillator_number(name: str) -> tuple[Read, Vary]:
    """Return the functions that read and vary a value of the oscillator itself."""
    return (
        lambda rig: float(getattr(rig.oscillator, name)),
        lambda rig, value: rig.with_parts(rig.oscillator.replace(**{name: value})),
    )


def isolator(name: str) -> tuple[Read, Vary]:
    """Return the functions that read and vary a value of the isolator."""

    def vary(rig: Rig, value: float) -> Rig:
        law = rig.oscillator.isolator.replace(**{name: value})
        return rig.with_parts(rig.oscillator.replace(isolator=law))

    return lambda rig: number(rig.oscillator.isolator, name, "isolator has"), vary


def formula_number(
    whose: str, name: str, registered: Callable[[], Iterable[str]]
) -> tuple[Read, Vary]:
    """Return the functions that read and vary a number in the formula of a law.

    `whose` is ``"isolator"``, ``"right"``, ``"left"``, or ``"bumper"`` for both stops.
    """

    def laws_of(rig: Rig) -> dict[str, Law]:
        return formulas(rig.oscillator, whose, name, registered)

    def read(rig: Rig) -> float:
        laws = laws_of(rig).values()
        return shared(
            name,
            {dict(law.numbers)[name] for law in laws},
            {law.quantities.get(name, DIMENSIONLESS) for law in laws},
        )

    def vary(rig: Rig, value: float) -> Rig:
        try:
            changed = {field: law.replace(**{name: value}) for field, law in laws_of(rig).items()}
        except InputError as error:
            raise InputError(f"parameter: '{whose}_{name}' at {value:.6g}: {error}") from None
        return rig.with_parts(rig.oscillator.replace(**changed))

    return read, vary


def formulas(
    oscillator: Oscillator, whose: str, name: str, registered: Callable[[], Iterable[str]]
) -> dict[str, Law]:
    """Return the laws whose formula has a number of this name, by their field in the oscillator.

    Raises
    ------
    InputError
        If no formula has such a number.
    """
    fields = ("right", "left") if whose == "bumper" else (whose,)
    laws = {field: getattr(oscillator, field) for field in fields}
    given = {field: law for field, law in laws.items() if isinstance(law, Law)}
    found = {field: law for field, law in given.items() if name in dict(law.numbers)}
    if not found:
        names = list(
            dict.fromkeys(f"{whose}_{one}" for law in given.values() for one, _ in law.numbers)
        )
        owner = {"isolator": "isolator", "bumper": "stop"}.get(whose, f"{whose} stop")
        law = next((one for one in laws.values() if one is not None), None)
        if names:
            why = f"the formula of the {owner} has no number {name!r}"
        elif law is None:
            why = f"the rig has no {owner}"
        else:
            why = f"the {owner} is of the class {type(law).__name__}, not a formula"
            names = _fields(law, whose, list(registered()))
        one_of = " or ".join(map(repr, names))
        accepted = f"{one_of} is accepted" if names else f"use a rig with a {owner}"
        hint = meant(f"{whose}_{name}", registered())
        raise InputError(
            f"parameter: '{whose}_{name}' is not a parameter of this rig, because {why}; "
            f"{hint}{accepted[0].upper() + accepted[1:] if hint else accepted}"
        )
    return found


def _fields(part: Model, whose: str, registered: Collection[str]) -> list[str]:
    """Return the parameters of an isolator or a stop that is not defined by a formula."""
    named = [f"{whose}_{key}" if f"{whose}_{key}" in registered else key for key in _numbers(part)]
    return [one for one in named if one in registered]


def forcing(name: str) -> tuple[Read, Vary]:
    """Return the functions that read and vary a value of the shaking."""
    return (
        lambda rig: float(getattr(rig.periodic, name)),
        lambda rig, value: rig.with_parts(
            rig.system, rig.periodic.replace(**{name: value}), keep_open=name != "frequency"
        ),
    )


def spring(rig: Oscillator, name: str) -> float:
    """Return the stiffness K of the isolator. `name` is a ratio that requires linear laws."""
    rig.check_linear(f"{name!r}")
    return rig.isolator.initial_stiffness


def in_proportion(unit: Callable[[Oscillator], float]) -> tuple[Read, Vary]:
    """Return the functions for the bumper stiffness at a constant relaxation time C_j/K_j.

    The stiffness is divided by `unit`, a function of the oscillator.
    """
    stiffness_of, _ = bumpers("stiffness")

    def read(rig: Rig) -> float:
        oscillator = rig.oscillator
        return stiffness_of(rig) / unit(oscillator)

    def vary(rig: Rig, value: float) -> Rig:
        oscillator = rig.oscillator
        changed = {}
        for side, bumper in (("right", oscillator.right), ("left", oscillator.left)):
            if isinstance(bumper, Bumper):
                stiffness = value * unit(oscillator)
                time = bumper.damping / bumper.stiffness
                changed[side] = bumper.replace(stiffness=stiffness, damping=stiffness * time)
        return rig.with_parts(oscillator.replace(**changed))

    return read, vary


def at_restitution() -> tuple[Read, Vary]:
    """Return the functions for the bumper stiffness at a constant coefficient of restitution.

    C_j is then proportional to √(K_j M), as in `Bumper.from_restitution`.
    """
    stiffness_of, _ = bumpers("stiffness")

    def read(rig: Rig) -> float:
        oscillator = rig.oscillator
        for stop in oscillator.stops:
            if "stiffness" in type(stop).model_fields and not isinstance(stop, Bumper):
                raise InputError(
                    f"parameter: {stop} has the same restitution at any stiffness; use "
                    "'bumper_stiffness'"
                )
        return stiffness_of(rig)

    def vary(rig: Rig, value: float) -> Rig:
        oscillator = rig.oscillator
        changed = {
            side: bumper.replace(
                stiffness=value, damping=bumper.damping * math.sqrt(value / bumper.stiffness)
            )
            for side, bumper in (("right", oscillator.right), ("left", oscillator.left))
            if isinstance(bumper, Bumper)
        }
        return rig.with_parts(oscillator.replace(**changed))

    return read, vary


def scale_of(rig: Rig) -> float:
    """Return the peak base acceleration (m/s²) that scales the gaps.

    For a displacement X of the base it is X ω0², for a force F on the mass F/M, and for an
    unbalance m e it is m e ω0²/M. The largest displacement without stops is then the same as for
    this base acceleration (see `peak_displacement`).

    Raises
    ------
    InputError
        If several harmonics shake the rig.
    """
    oscillator, shaken = rig.oscillator, rig.periodic
    if not isinstance(shaken, Harmonic):
        raise InputError(
            "gap_ratio: gaps are scaled by the peak displacement without stops under one sine, "
            "but several harmonics shake the mass; use a Harmonic, or pass the gap in metres"
        )
    return float(shaken.acceleration(oscillator.mass, oscillator.angular_frequency))


def gap_ratio() -> tuple[Read, Vary]:
    """Return the functions for the gap ratio δ0 = G0_j/u_max, at a constant u_max."""
    gap_of, with_gap = bumpers("gap")

    def read(rig: Rig) -> float:
        return gap_of(rig) / peak_displacement(rig.oscillator, scale_of(rig))

    def vary(rig: Rig, value: float) -> Rig:
        return with_gap(rig, value * peak_displacement(rig.oscillator, scale_of(rig)))

    return read, vary


def relaxation_time() -> tuple[Read, Vary]:
    """Return the functions for the relaxation time τ = ω0 C_j/K_j, at a constant stiffness."""

    def read(rig: Rig) -> float:
        oscillator = rig.oscillator
        oscillator.check_linear("'relaxation_time'")
        times = [number(stop, "damping") / number(stop, "stiffness") for stop in oscillator.stops]
        if not times:
            raise InputError(
                "parameter: 'relaxation_time' applies to the bumpers, but the rig has none; use a "
                "rig with a bumper"
            )
        if not math.isclose(min(times), max(times), rel_tol=1e-12):
            raise InputError(
                "parameter: 'relaxation_time' applies to both bumpers, but their ratios of damping "
                f"to stiffness are {' and '.join(f'{one:g}' for one in sorted(times))} s; use "
                "'right_damping' or 'left_damping', or a rig with equal ratios"
            )
        return oscillator.angular_frequency * times[0]

    def vary(rig: Rig, value: float) -> Rig:
        oscillator = rig.oscillator
        changed = {
            side: bumper.replace(damping=value * bumper.stiffness / oscillator.angular_frequency)
            for side, bumper in (("right", oscillator.right), ("left", oscillator.left))
            if isinstance(bumper, Bumper)
        }
        return rig.with_parts(oscillator.replace(**changed))

    return read, vary


def isolator_period() -> tuple[Read, Vary]:
    """Return the functions for the period T = 2π √(M/K), at a constant mass and damping ratio."""

    def read(rig: Rig) -> float:
        oscillator = rig.oscillator
        number(oscillator.isolator, "stiffness", "isolator has")
        return 1.0 / oscillator.natural_frequency

    def vary(rig: Rig, value: float) -> Rig:
        oscillator = rig.oscillator
        made = spring_and_dashpot(oscillator.mass, value, oscillator.damping_ratio)
        return rig.with_parts(oscillator.replace(isolator=oscillator.isolator.replace(**made)))

    return read, vary


def damping_ratio() -> tuple[Read, Vary]:
    """Return the functions for the damping ratio ξ = C/(2√(K M)), at a constant K and M."""

    def vary(rig: Rig, value: float) -> Rig:
        oscillator = rig.oscillator
        damping = value * oscillator.critical_damping
        return rig.with_parts(
            oscillator.replace(isolator=oscillator.isolator.replace(damping=damping))
        )

    return lambda rig: rig.oscillator.damping_ratio, vary
