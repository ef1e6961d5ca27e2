"""Checks of whole numbers, such as numbers of samples, cycles and rigs."""

from __future__ import annotations

from numbers import Integral

from vibroimpact.errors import InputError, shown

LARGEST = 2**62
"""Largest number that the engine can count to."""

MOST_SAMPLES = 20_000_000
"""Largest number of samples of a time history, about 3 GB."""


def check_samples(cycles: float, samples: int, field: str, what: str = "cycles") -> None:
    """Raise an error if a time history has more samples than fit in the memory.

    Raises
    ------
    InputError
        If there are more than `MOST_SAMPLES` samples in total.
    """
    if cycles * samples > MOST_SAMPLES:
        raise InputError(
            f"{field}: {cycles:g} {what} of {samples} samples are too many; reduce {field}, so "
            f"that there are at most {MOST_SAMPLES} samples in total"
        )


MOST_CYCLES = 10_000
"""Largest period of an orbit, in forcing cycles."""

MOST_EVENTS = 10_000_000
"""Largest accepted ``max_events``: contacts and detachments in one forcing cycle."""


MOST_TAIL = 1e8
"""Largest duration of free vibration after a record (s)."""

MOST_DRAWS, MOST_RESAMPLES = 2**20, 100_000
"""Largest number of random rigs, and of bootstrap samples of them."""

MOST_STARTS = 1_000_000
"""Largest number of random initial states."""


def whole(value: object, field: str, least: int = 1, most: int = LARGEST) -> int:
    """Return a whole number, which may be an integer of numpy.

    Raises
    ------
    InputError
        If the value is not a whole number, or if it is less than `least` or greater than `most`.
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or int(value) < least:
        raise InputError(f"{field}: {shown(value)}; a whole number of at least {least} is accepted")
    if int(value) > most:
        raise InputError(f"{field}: {shown(value)}; a whole number up to {most} is accepted")
    return int(value)


def check_max_events(value: object) -> int:
    """Return the largest number of contacts and detachments in one forcing cycle.

    Raises
    ------
    InputError
        If it is not a whole number from 1 to `MOST_EVENTS`.
    """
    return whole(value, "max_events", most=MOST_EVENTS)


def share(value: object, field: str) -> float:
    """Return a number that is greater than 0 and less than 1.

    Raises
    ------
    InputError
        If the value is not such a number.
    """
    from vibroimpact.model.quantities import DIMENSIONLESS
    from vibroimpact.model.units import to_si

    number = to_si(value, DIMENSIONLESS, field, above=0.0)
    if not number < 1.0:
        raise InputError(f"{field}: {shown(value)}; a number between 0 and 1 is accepted")
    return number
