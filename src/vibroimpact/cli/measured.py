"""Functions that read the options of a fit: the shaking of the tests, and pairs of values."""

from __future__ import annotations

from typing import TYPE_CHECKING

import vibroimpact as vi
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr


def shaking_of_tests(tests: list[xr.Dataset]) -> vi.Harmonic | None:
    """Return the shaking of the base that the files state, or None if a file does not state it."""
    if any("amplitude" not in t.attrs and "base_acceleration" not in t for t in tests):
        return None
    return vi.Harmonic(float(tests[0].attrs.get("amplitude", 1.0)), 1.0)


def base_acceleration(amplitude: str | None) -> str | None:
    """Return the amplitude of the option if it is an acceleration, as `read_measurement` takes it.

    An amplitude of a displacement or of a force is set by `with_amplitude` only.
    """
    from vibroimpact.model.quantities import ACCELERATION
    from vibroimpact.model.units import to_si

    try:
        to_si(amplitude, ACCELERATION, "--amplitude")
    except InputError:
        return None
    return amplitude


def with_amplitude(test: xr.Dataset, amplitude: str | None) -> xr.Dataset:
    """Return a test with the amplitude of the option, which replaces the amplitude in the file."""
    from vibroimpact.measurements.read import CALL

    if amplitude is None:
        return test
    return test.assign_attrs(amplitude=amplitude, amplitude_source=CALL)


def pair(text: str, option: str) -> tuple[str, str]:
    """Read two values that are separated by a colon.

    Raises
    ------
    InputError
        If there is no colon.
    """
    low, mark, high = text.partition(":")
    if not mark:
        what, example = "the lowest and the highest value", "5mm:8mm"
        if option == "--prior":
            what, example = "a mean and a standard deviation", "7mm:1mm"
        raise InputError(
            f"{option}: {text!r}; pass {what} with a colon between them, such as {example}"
        )
    return low, high
