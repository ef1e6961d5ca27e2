"""Types of arguments whose values `public` checks, and checks of whole numbers and shares.

Such a type is ``Annotated[type, check]``: ``check(value, name of the argument)`` returns the value
that the function gets, or raises `InputError`.
"""

from __future__ import annotations

from functools import partial
from numbers import Integral
from pathlib import Path
from typing import Annotated, Any, TypeAlias

from vibroimpact.arguments import check_path, check_text
from vibroimpact.errors import InputError, shown
from vibroimpact.model.quantities import DIMENSIONLESS, TIME, Quantity
from vibroimpact.model.units import to_si

LARGEST = 2**62
"""Largest number that the engine can count to."""

MOST_SAMPLES = 20_000_000
"""Largest number of samples of a time history, about 3 GB."""


def check_samples(cycles: float, samples: int, field: str, what: str = "cycles") -> None:
    """Raise an error if a time history has more samples than fit in the memory."""
    if cycles * samples > MOST_SAMPLES:
        raise InputError(
            f"{field}: {cycles:g} {what} of {samples} samples are too many; reduce {field}, so "
            f"that there are at most {MOST_SAMPLES} samples in total"
        )


MOST_CYCLES = 10_000
"""Largest period of an orbit, in forcing cycles."""

MOST_EVENTS = 10_000_000
"""Largest accepted ``max_events`` in one forcing cycle."""


MOST_TAIL = 1e8
"""Largest duration of free vibration after a record (s)."""

MOST_DRAWS, MOST_RESAMPLES = 2**20, 100_000
"""Largest number of random rigs, and of bootstrap samples of them."""

MOST_REFINED = 8
"""Largest number of refinements of a grid: nodes 256 times as dense as at first."""

MOST_STARTS = 1_000_000
"""Largest number of random initial states."""


def whole(value: object, field: str, least: int = 1, most: int = LARGEST) -> int:
    """Return a whole number, which may be an integer of numpy.

    It must be from `least` to `most`.
    """
    is_whole = isinstance(value, Integral) and not isinstance(value, bool)
    if not is_whole or not least <= int(value) <= most:  # type: ignore[call-overload]
        range_ = f"of at least {least}" if most == LARGEST else f"from {least} to {most}"
        raise InputError(f"{field}: {shown(value)}; pass a whole number {range_}")
    return int(value)  # type: ignore[call-overload, no-any-return]


def share(value: object, field: str) -> float:
    """Return a number that is greater than 0 and less than 1."""
    number = to_si(value, DIMENSIONLESS, field, above=0.0)
    if not number < 1.0:
        raise InputError(f"{field}: {shown(value)}; pass a number between 0 and 1")
    return number


def number(value: object, field: str, quantity: Quantity, **bounds: float) -> float:
    """Return a number in SI units, within the bounds of `to_si`."""
    return to_si(value, quantity, field, **bounds)


def function_of(value: object, field: str, what: str) -> Any:
    """Return a function. `what` describes accepted functions."""
    if isinstance(value, type) or not callable(value):
        raise InputError(f"{field}: {shown(value)}; pass {what}")
    return value


PositiveInt: TypeAlias = Annotated[int, whole]
NonNegativeInt: TypeAlias = Annotated[int, partial(whole, least=0)]
MaxEvents: TypeAlias = Annotated[int, partial(whole, most=MOST_EVENTS)]
"""Largest number of events in one forcing cycle."""
Period: TypeAlias = Annotated[int, partial(whole, most=MOST_CYCLES)]
"""Period of an orbit, in forcing cycles."""
RandomStarts: TypeAlias = Annotated[int, partial(whole, least=0, most=MOST_STARTS)]
"""Number of random initial states."""
Draws: TypeAlias = Annotated[int, partial(whole, most=MOST_DRAWS)]
"""Number of random rigs."""
Refinements: TypeAlias = Annotated[int, partial(whole, least=0, most=MOST_REFINED)]
"""Number of times that a grid is refined."""
Share: TypeAlias = Annotated[float, share]
"""A number between 0 and 1."""
Positive: TypeAlias = Annotated[float, partial(number, quantity=DIMENSIONLESS, above=0.0)]
NonNegative: TypeAlias = Annotated[float, partial(number, quantity=DIMENSIONLESS, minimum=0.0)]
Seconds: TypeAlias = Annotated[float, partial(number, quantity=TIME, minimum=0.0)]
"""A time in s, at least 0."""
String: TypeAlias = Annotated[str, check_text]
File: TypeAlias = Annotated[Path | str, check_path]
"""Path of a file."""
Fractile: TypeAlias = Annotated[
    float, partial(number, quantity=DIMENSIONLESS, minimum=0.0, maximum=1.0)
]
"""A number from 0 to 1."""
Tail: TypeAlias = Annotated[
    float | str, partial(number, quantity=TIME, minimum=0.0, maximum=MOST_TAIL)
]
"""Duration of free vibration after a record, in s or with a unit."""
