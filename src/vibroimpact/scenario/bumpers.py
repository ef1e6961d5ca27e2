"""The bumpers of a rig whose scenario is asked for."""

from __future__ import annotations

from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Oscillator


def bumpers(oscillator: Oscillator, field: str = "oscillator") -> dict[str, Bumper]:
    """The bumpers that are there, by side.

    Raises
    ------
    InputError
        If a stop is rigid: the scenarios are those of the plane of λ and δ0.
    """
    found = {}
    for side in ("right", "left"):
        stop = getattr(oscillator, side)
        if isinstance(stop, Bumper):
            found[side] = stop
        elif stop is not None:
            raise InputError(
                f"{field}.{side}: {stop} is no bumper, and scenarios are defined for those; "
                "a Bumper is accepted"
            )
    return found
