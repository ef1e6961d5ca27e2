"""Parameters that set several numbers of a rig at once, such as ratios and the period.

Each is defined by a formula over the numbers of the rig, whose other parts are kept as the
definition states.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from vibroimpact.errors import InputError
from vibroimpact.model.excitation import Harmonic
from vibroimpact.model.isolators.law import spring_and_dashpot
from vibroimpact.model.largest_free_response import peak_displacement
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.quantities import DIMENSIONLESS, PERIOD, STIFFNESS, Quantity
from vibroimpact.model.rig import Rig
from vibroimpact.model.units import pretty
from vibroimpact.model.validation import Model


class Derived(NamedTuple):
    """A parameter that sets several numbers."""

    quantity: Quantity
    long_name: str
    read: Callable[[Rig], float]
    vary: Callable[[Rig, float], Rig]
    zero: bool = True
    comment: str = ""
    least: float | None = 0.0


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


def _fields(law: Model) -> dict[str, float]:
    """Return the numbers of a law whose meaning the package knows.

    A number in the formula of a user is none of them, whatever its name.
    """
    known = type(law).model_fields
    return {name: value for name, (value, _) in law.knobs().items() if name in known}


def _numbers(oscillator: Oscillator, name: str) -> dict[str, dict[str, float]]:
    """Return the numbers of the stops that have a number of this name, by side.

    At least one stop must have it.
    """
    by_side = {}
    for side in ("right", "left"):
        stop = getattr(oscillator, side)
        numbers = {} if stop is None else _fields(stop)
        if name in numbers:
            by_side[side] = numbers
    if not by_side:
        raise InputError(f"{name}: the rig has no stop with a {name}; use a rig with such a stop")
    return by_side


def _common(oscillator: Oscillator, name: str) -> float:
    by_side = _numbers(oscillator, name)
    values = sorted({one[name] for one in by_side.values()})
    if len(values) > 1:
        _, accepts = oscillator.stops[next(iter(by_side))].knobs()[name]
        raise InputError(
            f"{name}: the stops have different values of {name}, "
            f"{' and '.join(pretty(one, accepts.quantity) for one in values)}; use 'right.{name}' "
            f"or 'left.{name}', or a rig with equal stops"
        )
    return values[0]


def _bumpers(oscillator: Oscillator, name: str) -> dict[str, tuple[float, float]]:
    """Return stiffness and damping of the bumpers, by side.

    A stop of another law must not have a stiffness.
    """
    by_side = {}
    for side in _numbers(oscillator, "stiffness"):
        stop = getattr(oscillator, side)
        pair = stop.spring_and_dashpot
        if pair is None:
            raise InputError(
                f"{name!r} sets stiffness and damping of bumpers, but the {side} stop "
                f"has the law {stop.kind!r}; use 'stops.{side}.stiffness'"
            )
        by_side[side] = pair
    return by_side


def _stiffness(oscillator: Oscillator, name: str) -> float:
    """Return the stiffness of the bumpers."""
    _bumpers(oscillator, name)
    return _common(oscillator, "stiffness")


def _with_stops(rig: Rig, changes: dict[str, dict[str, float]]) -> Rig:
    oscillator = rig.oscillator
    changed = {side: getattr(oscillator, side).replace(**new) for side, new in changes.items()}
    return rig.with_parts(oscillator.replace(**changed))


def _with_bumpers(
    rig: Rig, name: str, stiffness: float | None, damping: Callable[[float, float], float]
) -> Rig:
    """Return the rig with another stiffness of the bumpers, and a damping that K_j and C_j give."""
    changes = {
        side: {"stiffness": k if stiffness is None else stiffness, "damping": damping(k, c)}
        for side, (k, c) in _bumpers(rig.oscillator, name).items()
    }
    return _with_stops(rig, changes)


def _in_proportion(rig: Rig, name: str, stiffness: float) -> Rig:
    """Return the rig with another stiffness of the bumpers at a constant C_j/K_j."""
    return _with_bumpers(rig, name, stiffness, lambda k, c: stiffness * (c / k))


def _spring(rig: Rig) -> float:
    """Return the stiffness of the isolator, if all laws are linear."""
    rig.oscillator.check_linear("'stiffness_ratio'")
    return rig.oscillator.isolator.initial_stiffness


def largest_free_displacement(rig: Rig) -> float:
    """Return the largest displacement without stops (m), which scales the gaps."""
    return peak_displacement(rig.oscillator, scale_of(rig))


def _vary_gap_ratio(rig: Rig, value: float) -> Rig:
    gap = value * largest_free_displacement(rig)
    return _with_stops(rig, {side: {"gap": gap} for side in _numbers(rig.oscillator, "gap")})


def _relaxation_time(rig: Rig) -> float:
    oscillator = rig.oscillator
    oscillator.check_linear("'relaxation_time'")
    bumpers = _bumpers(oscillator, "relaxation_time").values()
    times = sorted(damping / stiffness for stiffness, damping in bumpers)
    if not math.isclose(times[0], times[-1], rel_tol=1e-12):
        raise InputError(
            "'relaxation_time' applies to both bumpers, but their ratios of damping to "
            f"stiffness are {' and '.join(f'{one:g}' for one in times)} s; use 'right.damping' or "
            "'left.damping', or a rig with equal ratios"
        )
    return oscillator.angular_frequency * times[0]


def _vary_relaxation_time(rig: Rig, value: float) -> Rig:
    omega = rig.oscillator.angular_frequency
    return _with_bumpers(rig, "relaxation_time", None, lambda k, _: value * k / omega)


def _check_isolator(oscillator: Oscillator, field: str, name: str) -> None:
    """Refuse an isolator without a field that a parameter sets."""
    if field not in _fields(oscillator.isolator):
        kind = oscillator.isolator.kind
        raise InputError(
            f"{name!r} sets the {field} of the isolator, but its law, {kind}, has none; "
            f"use an isolator with a {field}"
        )


def _period(rig: Rig) -> float:
    _check_isolator(rig.oscillator, "stiffness", "isolator_period")
    return 1.0 / rig.oscillator.natural_frequency


def _vary_period(rig: Rig, value: float) -> Rig:
    oscillator = rig.oscillator
    _check_isolator(oscillator, "stiffness", "isolator_period")
    made = spring_and_dashpot(oscillator.mass, value, oscillator.damping_ratio)
    return rig.with_parts(oscillator.replace(isolator=oscillator.isolator.replace(**made)))


def _damping_ratio(rig: Rig) -> float:
    _check_isolator(rig.oscillator, "damping", "damping_ratio")
    return rig.oscillator.damping_ratio


def _vary_damping_ratio(rig: Rig, value: float) -> Rig:
    oscillator = rig.oscillator
    _check_isolator(oscillator, "damping", "damping_ratio")
    damping = value * oscillator.critical_damping
    return rig.with_parts(oscillator.replace(isolator=oscillator.isolator.replace(damping=damping)))


DERIVED = {
    "proportional_stiffness": Derived(
        STIFFNESS,
        "stiffness of both bumpers, with damping in proportion",
        lambda rig: _stiffness(rig.oscillator, "proportional_stiffness"),
        lambda rig, value: _in_proportion(rig, "proportional_stiffness", value),
        zero=False,
    ),
    "stiffness_at_restitution": Derived(
        STIFFNESS,
        "stiffness of both bumpers, with constant restitution",
        lambda rig: _stiffness(rig.oscillator, "stiffness_at_restitution"),
        lambda rig, value: _with_bumpers(
            rig, "stiffness_at_restitution", value, lambda k, c: c * math.sqrt(value / k)
        ),
        zero=False,
        comment="C_j / √(K_j M) is kept",
    ),
    "isolator_period": Derived(
        PERIOD,
        "natural period on the isolator",
        _period,
        _vary_period,
        zero=False,
        comment="2π √(M/K); the damping ratio is kept",
    ),
    "stiffness_ratio": Derived(
        DIMENSIONLESS,
        "stiffness ratio of the bumpers",
        lambda rig: _stiffness(rig.oscillator, "stiffness_ratio") / _spring(rig),
        lambda rig, value: _in_proportion(rig, "stiffness_ratio", value * _spring(rig)),
        zero=False,
        comment="K_j / K",
    ),
    "gap_ratio": Derived(
        DIMENSIONLESS,
        "gap ratio of each side",
        lambda rig: _common(rig.oscillator, "gap") / largest_free_displacement(rig),
        _vary_gap_ratio,
        comment="G / u_max",
        least=None,
    ),
    "relaxation_time": Derived(
        DIMENSIONLESS,
        "relaxation time of the bumpers",
        _relaxation_time,
        _vary_relaxation_time,
        comment="ω0 C_j / K_j",
    ),
    "damping_ratio": Derived(
        DIMENSIONLESS,
        "damping ratio of the isolator",
        _damping_ratio,
        _vary_damping_ratio,
        comment="C / (2 √(K M))",
    ),
}
"""Derived parameters by name. `proportional_stiffness` and `stiffness_ratio` keep C_j/K_j,
`stiffness_at_restitution` keeps C_j/√K_j, `isolator_period` keeps the damping ratio, and the ratios
keep the other quantities in their definitions."""
