"""Read a periodic shaking: an amplitude, one amplitude per frequency, or an excitation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from vibroimpact.arguments import is_list
from vibroimpact.errors import InputError
from vibroimpact.model.excitation import Harmonic, Of, Periodic, Repeated, sized
from vibroimpact.model.record import Record
from vibroimpact.model.units import pretty
from vibroimpact.model.written_units import unitless

ANY_FREQUENCY = 1.0
"""Placeholder (Hz) for the frequency of a periodic shaking whose frequency is open. It has no
meaning."""


def is_nothing(shaking: object) -> bool:
    """Return whether a shaking is an amplitude of 0, such as ``"0 g"``, so that nothing shakes."""
    if not isinstance(shaking, str | float | int) or isinstance(shaking, bool):
        return False
    try:
        return sized(shaking, None, "shaking")[0] == 0.0
    except InputError:  # reported where it is read
        return False


def as_periodic(
    value: object, where: str, of: Of | None = None
) -> tuple[Repeated, tuple[float, ...] | None]:
    """Read a periodic shaking: an amplitude, amplitudes, a `Harmonic` or a `Periodic`.

    Parameters
    ----------
    value
        The shaking.
    where
        Its name in errors.
    of
        Quantity of an amplitude. Default: that of its unit, or an acceleration.

    Returns
    -------
    shaking, amplitudes
        If only an amplitude is passed, the frequency has no meaning. `amplitudes` are those of a
        list; the shaking has the largest one.

    Raises
    ------
    InputError
        If it is invalid, missing, or 0.
    """
    if isinstance(value, Record):
        raise InputError(
            f"{where}: a Record has no period, but a periodic excitation is required; use a "
            "Harmonic or a Periodic, or call simulate for the Record"
        )
    if value is None:
        raise InputError(
            f"{where}: missing, and the rig has no shaking; pass an acceleration greater than 0, "
            'such as "0.05 g", or a displacement, a force or an unbalance'
        )
    if isinstance(value, Harmonic | Periodic):
        if value.amplitude == 0.0:
            raise InputError(
                f"{where}: 0; pass an amplitude greater than 0 (simulate computes free vibrations)"
            )
        return value, None
    if is_list(value):
        sizes = []
        for i, one in enumerate(cast("Sequence[float | str]", value)):
            size, of = sized(one, of, f"{where}[{i}]", positive=True)
            sizes.append(size)
        if not sizes:
            raise InputError(f"{where}: the list is empty; pass one amplitude per frequency")
        return Harmonic(max(sizes), ANY_FREQUENCY, of=of), tuple(sizes)
    size, of = sized(value, of, where, positive=True)
    return Harmonic(size, ANY_FREQUENCY, of=of), None


def several(amplitudes: tuple[float, ...], shaken: Repeated) -> str:
    """Say that one amplitude is needed where a rig has a list of them.

    The example is the first one of the list, which has the quantity and the units of the rig.
    """
    one = pretty(amplitudes[0], shaken.quantity)
    example = one if unitless() else f'"{one}"'
    return (
        f"shaking: a list of {len(amplitudes)} amplitudes belongs to the frequencies of a sweep, "
        "which it does not state; pass one amplitude, that of the frequency of this motion, such "
        f"as Rig(oscillator, {example})"
    )
