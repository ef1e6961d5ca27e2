"""Design values, such as periods, which define an isolator for a given mass."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from vibroimpact.errors import DependentError, InputError, shown
from vibroimpact.model.quantities import (
    DIMENSIONLESS,
    FORCE,
    GRAVITY,
    LENGTH,
    MASS,
    PERIOD,
)
from vibroimpact.model.size_checks import doubt_damping_ratio
from vibroimpact.model.units import one_of
from vibroimpact.model.unknown_keys import unknown_key
from vibroimpact.model.validation import Accepts

if TYPE_CHECKING:
    from vibroimpact.model.isolators.law import IsolatorLaw

_ACCEPTS = {
    "mass": Accepts(MASS, above=0.0),
    "period": Accepts(PERIOD, above=0.0),
    "damping_ratio": Accepts(DIMENSIONLESS, minimum=0.0),
    "strength": Accepts(DIMENSIONLESS, above=0.0),
    "yield_displacement": Accepts(LENGTH, above=0.0),
    "post_yield_period": Accepts(PERIOD, above=0.0),
    "post_yield_damping_ratio": Accepts(DIMENSIONLESS, minimum=0.0),
    "radius": Accepts(LENGTH, above=0.0),
    "coefficient": Accepts(DIMENSIONLESS, minimum=0.0),
}


def design(**values: object) -> list[float]:
    """Read design values by name, in SI units."""
    numbers = []
    for name, value in values.items():
        number = _ACCEPTS[name].at(value, name)
        if name.endswith("damping_ratio"):
            doubt_damping_ratio(number, name)
        numbers.append(number)
    return numbers


def force_of_strength(mass: float, strength: object) -> float:
    """Return a strength in N. It is read as a force, or as a share of the weight of a mass (kg).

    Raises
    ------
    InputError
        If it is invalid.
    """
    number, quantity = one_of(strength, (DIMENSIONLESS, FORCE), "strength", above=0.0)
    if quantity is FORCE:
        return number
    if number > 1.0:
        raise InputError(
            f"strength: {shown(strength)} times the weight; use a share of the weight up to 1, "
            'such as 0.05, or a force with its unit, such as "250 kN"'
        )
    return number * mass * GRAVITY


def designed(table: Mapping[str, Any], law: type[IsolatorLaw], mass: float | None) -> Any:
    """Return the isolator of a table that has the arguments of one of its law's `designs`.

    Parameters
    ----------
    mass
        Mass on the isolator (kg). None if the mass is invalid.

    Returns
    -------
    IsolatorLaw
        The isolator, or the table itself if it has none of these arguments.

    Raises
    ------
    InputError
        If an argument is missing or invalid. `DependentError` if only the mass is.
    """
    asked = [(name, _arguments(law, name)) for name in law.designs]
    asked.sort(key=lambda one: -sum(p.name in table for p in one[1]))
    name, own = asked[0] if asked else ("", [])
    keys = [p.name for p in own if p.name in table]
    if not keys:
        return table
    _check_keys(table, law)
    if mass is None:
        raise DependentError(
            f'{keys[0]}: requires the mass of the oscillator; add the mass, such as "550 kg"'
        )
    for p in own:
        if p.default is p.empty and p.name not in table:
            if p.name == "period" and "stiffness" in table:
                raise InputError(
                    f"{keys[0]}: given together with stiffness; replace stiffness by period, or "
                    f"{keys[0]} by damping"
                )
            raise InputError(
                f"{p.name}: missing, but {keys[0]} requires it; add {_ACCEPTS[p.name].words()}"
            )
    values = {key: value for key, value in table.items() if key != "kind"}
    return getattr(law, name)(mass, **values)


def _check_keys(table: Mapping[str, Any], law: type[IsolatorLaw]) -> None:
    """Raise an error if a table has an unknown key, which may be a misspelt one of the design."""
    for key in table:
        if key != "kind" and key not in law._table_keys():
            raise InputError(f"{key}: {unknown_key(law._table_keys(), key, law._laws_with(key))}")


def design_keys(law: type[IsolatorLaw]) -> list[str]:
    """Return the keys that a table of this law may have instead of its fields."""
    return list(dict.fromkeys(p.name for name in law.designs for p in _arguments(law, name)))


def keys_of_mass(table: Mapping[str, Any], law: type[IsolatorLaw]) -> list[str]:
    """Return the keys of a table that use the mass on the isolator, such as a period.

    If it has none of these, but other design values, return those.

    Raises
    ------
    InputError
        If a strength is invalid.
    """
    own = design_keys(law)
    keys = [key for key in table if key in own and key not in law.model_fields]
    free = {"yield_displacement"}
    if "strength" in keys and force_of_strength(0.0, table["strength"]):
        free.add("strength")  # a force; a share of the weight of no mass is 0
    return [key for key in keys if key not in free] or keys


def _arguments(law: type[IsolatorLaw], name: str) -> list[inspect.Parameter]:
    """Return the arguments of one of its designs, other than the mass."""
    takes = inspect.signature(getattr(law, name)).parameters.values()
    return [p for p in takes if p.name in _ACCEPTS and p.name != "mass"]
