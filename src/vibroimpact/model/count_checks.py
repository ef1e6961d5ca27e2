"""Numbers that count something."""

from __future__ import annotations

from numbers import Integral

from vibroimpact.errors import InputError, shown

LARGEST = 2**62
"""What the engine counts with."""

MOST_SAMPLES = 20_000_000
"""Samples of one record: about 3 GB."""


def check_samples(cycles: float, samples: int, field: str) -> None:
    """Refuse a record that no memory holds.

    Raises
    ------
    InputError
        If there are more than `MOST_SAMPLES` in all.
    """
    if cycles * samples > MOST_SAMPLES:
        raise InputError(
            f"{field}: {cycles:g} cycles of {samples} samples are more than {MOST_SAMPLES} "
            "samples in total; fewer cycles or fewer samples per cycle are accepted"
        )


MOST_CYCLES = 10_000
"""Forcing cycles of an orbit's period."""

MOST_EVENTS = 10_000_000
"""Contacts and detachments in one cycle at which a run may be given up."""


MOST_TAIL = 1e8
"""Seconds of free vibration after a record."""

MOST_DRAWS, MOST_RESAMPLES = 2**20, 100_000
"""Random rigs of one call, and sets of them that are drawn again."""

MOST_STARTS = 1_000_000
"""Random initial states of one call."""


def whole(value: object, field: str, least: int = 1, most: int = LARGEST) -> int:
    """Read a whole number, numpy's included.

    Raises
    ------
    InputError
        If it is none, less than `least` or more than `most`.
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or int(value) < least:
        raise InputError(f"{field}: {shown(value)}; a whole number of at least {least} is accepted")
    if int(value) > most:
        raise InputError(f"{field}: {shown(value)}; a whole number up to {most} is accepted")
    return int(value)


def check_max_events(value: object) -> int:
    """Read how many contacts and detachments are followed in one cycle.

    Raises
    ------
    InputError
        If it is not a whole number from 1 to `MOST_EVENTS`.
    """
    return whole(value, "max_events", most=MOST_EVENTS)


def share(value: object, field: str) -> float:
    """Read a number between 0 and 1, both excluded.

    Raises
    ------
    InputError
        If it is none.
    """
    from vibroimpact.model.quantities import DIMENSIONLESS
    from vibroimpact.model.units import to_si

    number = to_si(value, DIMENSIONLESS, field, above=0.0)
    if not number < 1.0:
        raise InputError(f"{field}: {shown(value)}; a number between 0 and 1 is accepted")
    return number
