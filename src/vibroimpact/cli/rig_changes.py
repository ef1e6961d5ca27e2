"""The changes of a rig by options, which become part of its title and of the names of files."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any, NamedTuple

from vibroimpact.cli.options import RigOptions
from vibroimpact.errors import InputError
from vibroimpact.model import GRAVITY, Oscillator
from vibroimpact.model.excitation import QUANTITIES, sized
from vibroimpact.model.names import kept_letters
from vibroimpact.model.quantities import FORCE, MASS
from vibroimpact.model.units import pretty, to_si

_LONGEST = 120
"""Bytes of a file name without the ending that a command adds; file systems allow 255."""


_OTHERS = {"mass": MASS, "weight": FORCE}
"""Options that are not parameters of the registry."""


class Change(NamedTuple):
    """One option that changes the rig."""

    words: str
    """For titles, such as "left gap 9 mm"."""
    slug: str
    """For file names, such as "left-gap-9mm"."""


def changes(
    options: RigOptions, rig_of: Callable[[RigOptions], Any], rig: Oscillator | None = None
) -> tuple[Change, ...]:
    """Return the options without which the rig would be another.

    Parameters
    ----------
    options
        As they were given.
    rig_of
        The rig with such options, comparable.
    rig
        The rig with these options, on whose laws units may depend.
    """
    wanted = rig_of(options)
    kept = options
    # From the last: beside --gap, it is --left-gap that may be superfluous.
    for field in reversed(fields(RigOptions)):
        if field.name == "parameters" or getattr(kept, field.name) == field.default:
            continue
        without = replace(kept, **{field.name: field.default})
        try:
            if rig_of(without) == wanted:
                kept = without
        except InputError:  # a new bumper needs all its values
            pass
    return tuple(
        _change(field.name, getattr(kept, field.name), rig)
        for field in fields(RigOptions)
        if field.name != "parameters" and getattr(kept, field.name) != field.default
    )


def _change(option: str, value: str | bool, rig: Oscillator | None) -> Change:
    flag = option.replace("_", "-")
    if isinstance(value, bool):
        return Change(f"{flag.replace('-', ' ')} bumper", flag)
    if option == "amplitude":
        size, of = sized(value, None, option)
        text = f"{size / GRAVITY:.6g} g" if of == "acceleration" else pretty(size, QUANTITIES[of])
    else:
        from vibroimpact.model.parameters import PARAMETERS

        varied = PARAMETERS.get(option)
        if varied is not None and rig is not None:
            varied = varied.of(rig)
        quantity = _OTHERS[option] if varied is None else varied.quantity
        text = pretty(to_si(value, quantity, option), quantity)
    return Change(
        f"{flag.replace('-', ' ')} {text}", f"{flag}-{kept_letters(text.replace(' ', ''))}"
    )


def joined(first: str, found: tuple[Change, ...]) -> str:
    """Return the beginning of the file names of a changed rig."""
    name = "-".join((first, *(change.slug for change in found)))
    if len(name.encode()) <= _LONGEST:
        return name
    cut = name.encode()[:_LONGEST].decode(errors="ignore")
    return f"{cut}-{hashlib.sha256(name.encode()).hexdigest()[:8]}"
