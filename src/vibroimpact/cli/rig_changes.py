"""The changes of a rig by options, which are shown in its title and in file names."""

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
from vibroimpact.model.quantities import (
    DAMPING,
    DIMENSIONLESS,
    FORCE,
    LENGTH,
    MASS,
    PERIOD,
    STIFFNESS,
)
from vibroimpact.model.units import pretty, to_si
from vibroimpact.model.written_units import unitless

_LONGEST = 120
"""Largest number of bytes of a file name, without the ending that a command adds. File systems
allow 255."""


_OTHERS = {"mass": MASS, "weight": FORCE, "isolator_period": PERIOD, "damping_ratio": DIMENSIONLESS}
"""Quantities of options that are not parameters of the registry."""


class Change(NamedTuple):
    """An option that changes the rig."""

    words: str
    """Text in titles, such as "left gap 9 mm"."""
    slug: str
    """Text in file names, such as "left-gap-9mm"."""


def changes(
    options: RigOptions, rig_of: Callable[[RigOptions], Any], rig: Oscillator | None = None
) -> tuple[Change, ...]:
    """Return the options that change the rig.

    Parameters
    ----------
    options
        The options of the command.
    rig_of
        Function that returns a comparable rig for some options.
    rig
        The rig with the options. Units may depend on its laws.
    """
    wanted = rig_of(options)
    kept = options
    # Start with the last option: if --gap is set, --left-gap may be superfluous.
    for field in reversed(fields(RigOptions)):
        if field.name == "parameters" or getattr(kept, field.name) == field.default:
            continue
        without = replace(kept, **{field.name: field.default})
        try:
            if rig_of(without) == wanted:
                kept = without
        except InputError:  # a new bumper requires all its values
            pass
    return tuple(
        _change(field.name, getattr(kept, field.name), rig)
        for field in fields(RigOptions)
        if field.name != "parameters" and getattr(kept, field.name) != field.default
    )


def _change(option: str, value: str | bool, rig: Oscillator | None) -> Change:
    flag = option.replace("_", "-")
    if isinstance(value, bool):
        what = "" if option == "no_isolator" else " bumper"
        return Change(f"{flag.replace('-', ' ')}{what}", flag)
    if option == "amplitude":
        size, of = sized(value, None, option)
        in_g = of == "acceleration" and not unitless()
        text = f"{size / GRAVITY:.6g} g" if in_g else pretty(size, QUANTITIES[of])
    else:
        end = option.rpartition("_")[2]
        quantity = (
            _OTHERS.get(option) or {"stiffness": STIFFNESS, "damping": DAMPING, "gap": LENGTH}[end]
        )
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
