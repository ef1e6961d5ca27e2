"""The registry of the parameters of a rig and its shaking.

For each parameter, the registry contains the name, the unit and the meaning, and functions that
read its value from a rig and set another value. Branches, curves, maps and the command line use
this registry. A new parameter is a new entry of `PARAMETERS`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple, cast

from vibroimpact.arguments import is_pair
from vibroimpact.errors import InputError, shown, unknown
from vibroimpact.model import access
from vibroimpact.model.access import Read, Vary
from vibroimpact.model.excitation import QUANTITIES, Of
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.quantities import (
    ACCELERATION,
    DAMPING,
    DECAY,
    DIMENSIONLESS,
    DISSIPATION,
    FORCE,
    FREQUENCY,
    LENGTH,
    MASS,
    PERIOD,
    STIFFNESS,
    UNBALANCE,
    Quantity,
    power_stiffness,
)
from vibroimpact.model.units import to_si, with_si_unit

_UNITS = {
    FREQUENCY: "Hz",
    ACCELERATION: "m s-2",
    LENGTH: "m",
    STIFFNESS: "N m-1",
    DAMPING: "N s m-1",
    DIMENSIONLESS: "1",
    FORCE: "N",
    UNBALANCE: "kg m",
    MASS: "kg",
    PERIOD: "s",
    DISSIPATION: "s m-1",
    DECAY: "m-1",
    power_stiffness(3.0): "N m-3",
    power_stiffness(5.0): "N m-5",
}
"""Units as they are written in datasets. For other quantities, the symbol is written."""


def in_units(units: str) -> Quantity:
    """Return the quantity that has these units in a dataset."""
    return next(quantity for quantity, text in _UNITS.items() if text == units)


_BOTH_STOPS = re.compile(r"\b(?:both|each|the) (bumpers|stops|side)\b")
"""Words in names of parameters that refer to the stops on both sides."""

_PEAKS = {
    "displacement": "peak base displacement",
    "force": "peak force on the mass",
    "unbalance": "rotating unbalance of the mass",
}


class Parameter(NamedTuple):
    """A parameter of a rig that can be varied."""

    name: str
    quantity: Quantity
    long_name: str
    read: Read
    """Function that returns the value in a rig, or raises an error if the rig has no such value."""
    vary: Vary
    """Function that returns the rig with another value."""
    zero: bool = True
    """Whether the value 0 is accepted."""
    comment: str = ""
    """Definition of the parameter."""
    least: float | None = 0.0
    most: float | None = None
    """Lowest and highest accepted value. None if there is no bound."""
    measured: Callable[[Oscillator], Quantity] | None = None
    """Function that returns the quantity in a rig, if an exponent of the rig sets the unit."""
    straight: bool = True
    """Whether the numbers of the rig depend linearly on the parameter. Branches require this."""

    @property
    def units(self) -> str:
        """The SI unit, as it is written in datasets."""
        return _UNITS.get(self.quantity, self.quantity.symbol)

    def of(self, rig: Oscillator) -> Parameter:
        """Return the parameter with its unit and its name in a rig.

        An exponent of the rig may set the unit. If the rig has only one stop, a name that refers to
        both stops becomes that of this stop.
        """
        found = self if self.measured is None else self._replace(quantity=self.measured(rig))
        sides = [side for side in ("right", "left") if getattr(rig, side) is not None]
        if len(sides) != 1:
            return found
        return found._replace(
            long_name=_BOTH_STOPS.sub(
                lambda both: f"the {sides[0]} {both[1].removesuffix('s')}", found.long_name
            )
        )

    def beside(self, value: float, factor: float = 2.0) -> float:
        """Return another accepted value: `factor` times as large or as small, or for 0 near 1."""
        larger = factor * value if value else factor - 1.0
        if self.most is None or larger <= self.most:
            return larger
        return value / factor if value else self.most

    @property
    def physical(self) -> bool:
        """Whether the parameter has a unit."""
        return self.quantity is not DIMENSIONLESS


def parameter(name: str, field: str = "parameter", of: Of = "acceleration") -> Parameter:
    """Return the parameter with a given name. `of` is the quantity of an amplitude.

    Raises
    ------
    InputError
        If no parameter has this name.
    """
    key = name.replace("-", "_") if isinstance(name, str) else ""
    if key not in PARAMETERS:
        symbol = name.strip().lower().replace("_", "") if isinstance(name, str) else ""
        if symbol in _SYMBOLS:
            raise InputError(
                f"{field}: {name!r} is not a name of a parameter; use {_SYMBOLS[symbol]}"
            )
        raise InputError(f"{field}: {unknown(name, PARAMETERS)}")
    if key == "amplitude" and of != "acceleration":
        return PARAMETERS[key]._replace(quantity=QUANTITIES[of], long_name=_PEAKS[of])
    return PARAMETERS[key]


_SYMBOLS = {
    **dict.fromkeys(
        ("omega", "ω", "w", "angular frequency", "angularfrequency"),
        "'frequency', in Hz or with a unit, such as '6.3 rad/s'",
    ),
    **dict.fromkeys(("f", "ν", "nu"), "'frequency'"),
    **dict.fromkeys(
        ("a", "a0", "f0", "p", "p0", "pga", "forceamplitude", "forcingamplitude", "acceleration"),
        "'amplitude', the amplitude of the shaking: of an acceleration, a displacement or a force",
    ),
    "k": "'stiffness' (isolator) or 'bumper_stiffness'",
    "c": "'damping' (isolator) or 'bumper_damping'",
    **dict.fromkeys(("xi", "ξ", "zeta", "ζ"), "'damping_ratio'"),
    **dict.fromkeys(("lambda", "λ"), "'stiffness_ratio'"),
    **dict.fromkeys(("delta", "δ", "delta0", "δ0"), "'gap_ratio'"),
    **dict.fromkeys(("tau", "τ"), "'relaxation_time'"),
    **dict.fromkeys(("e", "cor", "coefficientofrestitution"), "'restitution'"),
    **dict.fromkeys(("g", "g0", "clearance"), "'gap'"),
    **dict.fromkeys(("t", "period", "naturalperiod"), "'isolator_period'"),
}
"""The usual symbol of a parameter, and what to write instead."""


def read_span(varied: Parameter, span: object, field: str = "span") -> tuple[float, float]:
    """Read the lowest and the highest value of a parameter.

    Raises
    ------
    InputError
        If the range is not a pair, if a value is invalid, or if the range is empty.
    """
    if not is_pair(span):
        raise InputError(
            f"{field}: {shown(span)}; pass the lowest and the highest value of {varied.name} as "
            "(low, high)"
        )
    ends = list(cast("Iterable[float | str]", span))
    low, high = (
        to_si(end, varied.quantity, f"{field}[{i}]", minimum=varied.least, maximum=varied.most)
        for i, end in enumerate(ends)
    )
    if not low < high:
        first, last = (with_si_unit(end, varied.quantity) for end in (low, high))
        raise InputError(
            f"{field}[1]: {last} is not greater than {field}[0], {first}; pass the lowest value "
            "first, and then the highest"
        )
    return low, high


def _of_stops(
    field: str,
    both: str,
    quantity: Quantity,
    zero: bool = True,
    stop: str = "bumper",
    least: float = 0.0,
    most: float | None = None,
    powers: bool = False,
) -> Iterator[Parameter]:
    """Yield the parameters of a field of both stops and of each; an exponent may set the unit."""

    def measured(side: str) -> Callable[[Oscillator], Quantity] | None:
        def of(rig: Oscillator) -> Quantity:
            stops = [getattr(rig, side)] if side in ("right", "left") else rig.stops
            having = (stop for stop in stops if stop and field in type(stop).model_fields)
            return next((access.quantity(stop, field) for stop in having), quantity)

        return of if powers else None

    words = field.replace("_", " ")

    def made(name: str, whose: str, how: tuple[Read, Vary], side: str) -> Parameter:
        named = f"{words} of {whose}"
        return Parameter(
            name, quantity, named, *how, zero, least=least, most=most, measured=measured(side)
        )

    yield made(both, f"both {stop}s", access.bumpers(field), "both")
    for side in ("right", "left"):
        how = access.one_bumper(side, field)
        yield made(f"{side}_{field}", f"the {side} {stop}", how, side)


def _of_isolator(
    field: str,
    quantity: Quantity,
    zero: bool = True,
    least: float | None = 0.0,
    long_name: str = "",
    powers: bool = False,
) -> Parameter:
    """Return the parameter of a field of the isolator; the unit may depend on an exponent."""

    def measured(rig: Oscillator) -> Quantity:
        return access.quantity(rig.isolator, field, "isolator has")

    named = f"{long_name or field.replace('_', ' ')} of the isolator"
    read, write = access.isolator(field)
    return Parameter(
        field,
        quantity,
        named,
        read,
        write,
        zero,
        least=least,
        measured=measured if powers else None,
    )


def _of_formula(name: str) -> Parameter | None:
    """The parameter of a number of a user's formula, such as ``isolator_k3``."""
    whose, _, number = name.partition("_")
    if whose not in _FORMULAS or not number.isidentifier():
        return None

    def registered() -> list[str]:
        return list(PARAMETERS)

    def measured(rig: Oscillator) -> Quantity:
        law = next(iter(access.formulas(rig, whose, number, registered).values()))
        return law.quantities.get(number, DIMENSIONLESS)

    return Parameter(
        name,
        DIMENSIONLESS,
        f"number {number} in the formula of {_FORMULAS[whose]}",
        *access.formula_number(whose, number, registered),
        comment="in SI units",
        least=None,
        measured=measured,
        straight=False,
    )


_FORMULAS = {
    "isolator": "the isolator",
    "bumper": "both stops",
    "right": "the right stop",
    "left": "the left stop",
}


class Registry(dict[str, Parameter]):
    """Parameters by name. An iteration leaves out the parameters for the numbers of formulas."""

    def __contains__(self, name: object) -> bool:
        return dict.__contains__(self, name) or (isinstance(name, str) and bool(_of_formula(name)))

    def __missing__(self, name: str) -> Parameter:
        found = _of_formula(name)
        if found is None:
            raise KeyError(name)
        return found

    def get(self, name: str, default: Any = None) -> Any:
        """Return the parameter with this name, or the default if there is none."""
        return dict.get(self, name) or _of_formula(name) or default


PARAMETERS = Registry(
    (p.name, p)
    for p in (
        Parameter(
            "frequency", FREQUENCY, "excitation frequency", *access.forcing("frequency"), False
        ),
        Parameter(
            "amplitude", ACCELERATION, "peak base acceleration", *access.forcing("amplitude"), False
        ),
        Parameter(
            "force",
            FORCE,
            "constant force on the mass",
            *access.oscillator_number("force"),
            least=None,
        ),
        Parameter("gap", LENGTH, "gap of each side", *access.bumpers("gap"), least=None),
        *(
            Parameter(
                f"{side}_gap",
                LENGTH,
                f"gap of the {side} side",
                *access.one_bumper(side, "gap"),
                least=None,
            )
            for side in ("right", "left")
        ),
        *_of_stops("stiffness", "bumper_stiffness", STIFFNESS, False, powers=True),
        Parameter(
            "proportional_stiffness",
            STIFFNESS,
            "stiffness of both bumpers, with damping in proportion",
            *access.in_proportion(lambda rig: 1.0),
            False,
        ),
        Parameter(
            "stiffness_at_restitution",
            STIFFNESS,
            "stiffness of both bumpers, with constant restitution",
            *access.at_restitution(),
            False,
            "C_j / √(K_j M) is kept",
            straight=False,
        ),
        *_of_stops("damping", "bumper_damping", DAMPING),
        *_of_stops("restitution", "restitution", DIMENSIONLESS, stop="stop", most=1.0),
        *_of_stops("exponent", "bumper_exponent", DIMENSIONLESS, False, least=1.0),
        *_of_stops("dissipation", "dissipation", DISSIPATION),
        *_of_stops("mass", "bumper_mass", MASS, False),
        _of_isolator("stiffness", STIFFNESS),
        _of_isolator("damping", DAMPING, powers=True),
        _of_isolator("damping_exponent", DIMENSIONLESS, False),
        _of_isolator("friction", FORCE),
        _of_isolator("elastic_stiffness", STIFFNESS, False),
        _of_isolator("post_yield_stiffness", STIFFNESS, long_name="post-yield stiffness"),
        _of_isolator("yield_force", FORCE, False),
        _of_isolator("cubic", power_stiffness(3.0), least=None, long_name="cubic stiffness"),
        _of_isolator("quintic", power_stiffness(5.0), least=None, long_name="quintic stiffness"),
        _of_isolator("beta", DIMENSIONLESS, long_name="hysteresis number β"),
        _of_isolator("gamma", DIMENSIONLESS, least=None, long_name="hysteresis number γ"),
        _of_isolator("reversal_stiffness", STIFFNESS, False),
        _of_isolator("final_stiffness", STIFFNESS),
        _of_isolator("decay", DECAY, False),
        _of_isolator("hardening", DECAY, least=None),
        _of_isolator("hardening_force", FORCE),
        Parameter(
            "isolator_period",
            PERIOD,
            "natural period on the isolator",
            *access.isolator_period(),
            False,
            "2π √(M/K); the damping ratio is kept",
            straight=False,
        ),
        Parameter(
            "stiffness_ratio",
            DIMENSIONLESS,
            "stiffness ratio of the bumpers",
            *access.in_proportion(lambda rig: access.spring(rig, "stiffness_ratio")),
            False,
            "K_j / K",
        ),
        Parameter(
            "gap_ratio",
            DIMENSIONLESS,
            "gap ratio of each side",
            *access.gap_ratio(),
            comment="G / u_max",
            least=None,
        ),
        Parameter(
            "relaxation_time",
            DIMENSIONLESS,
            "relaxation time of the bumpers",
            *access.relaxation_time(),
            comment="ω0 C_j / K_j",
        ),
        Parameter(
            "damping_ratio",
            DIMENSIONLESS,
            "damping ratio of the isolator",
            *access.damping_ratio(),
            False,
            "C / (2 √(K M))",
        ),
    )
)
"""Parameters by name. `bumper_stiffness` does not change the damping C_j of the bumpers.
`proportional_stiffness` and `stiffness_ratio` do not change their C_j/K_j, and
`stiffness_at_restitution` does not change their C_j/√K_j. `isolator_period` does not change the
damping ratio. The ratios do not change the other quantities in their definitions."""
