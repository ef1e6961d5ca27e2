"""The changes of a rig by options, which are shown in its title and in file names."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

from vibroimpact.cli.options import RigOptions, by_path
from vibroimpact.errors import InputError
from vibroimpact.model import GRAVITY, Oscillator
from vibroimpact.model.excitation import QUANTITIES, sized
from vibroimpact.model.names import kept_letters
from vibroimpact.model.parameters import canonical, parameters
from vibroimpact.model.rig import Rig, System
from vibroimpact.model.units import pretty, to_si
from vibroimpact.model.written_units import unitless

_PARTS = ("masses", "links", "stops", "forces")
"""Parts of an assembly, with which the paths of its parameters begin."""
_LONGEST = 120
"""Largest number of bytes of a file name, without the ending that a command adds. File systems
allow 255."""


class Change(NamedTuple):
    """An option that changes the rig."""

    words: str
    """Text in titles, such as "left gap 9 mm"."""
    slug: str
    """Text in file names, such as "left-gap-9mm"."""


def changes(
    options: RigOptions, rig_of: Callable[[RigOptions], Any], rig: System
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
    # Start with the last value: if that of both sides is set, that of one may be superfluous.
    for text in reversed(options.values):
        without = replace(kept, values=tuple(one for one in kept.values if one != text))
        if _same(rig_of, without, wanted):
            kept = without
    if _same(rig_of, replace(kept, gap=None), wanted):
        kept = replace(kept, gap=None)
    if _same(rig_of, replace(kept, amplitude=None), wanted):
        kept = replace(kept, amplitude=None)
    found = {} if kept.amplitude is None else {"amplitude": kept.amplitude}
    found |= {} if kept.gap is None else {"gap": kept.gap}
    found |= by_path("--set", kept.values)
    return tuple(_change(path, text, rig) for path, text in found.items())


def _same(rig_of: Callable[[RigOptions], Any], options: RigOptions, wanted: Any) -> bool:
    try:
        return bool(rig_of(options) == wanted)
    except InputError:  # a new stop requires all its values
        return False


def _change(path: str, value: str, rig: System) -> Change:
    known = parameters(Rig(rig))
    name = canonical(path, known)
    words = name.removeprefix("oscillator.")
    if isinstance(rig, Oscillator) and (
        words.count(".") == 2 or words in ("stops.right", "stops.left")
    ):
        words = words.removeprefix("stops.")
    part, _, rest = ("", "", "") if isinstance(rig, Oscillator) else words.partition(".")
    if part in _PARTS and value.lower() != "none" and part != "masses":
        words = rest
    elif part in _PARTS:
        words = f"{part.removesuffix('es' if part == 'masses' else 's')} {rest}"
    words = re.sub(r"[._-]", " ", words)
    if name == "amplitude":
        size, of = sized(value, None, path)
        in_g = of == "acceleration" and not unitless()
        text = f"{size / GRAVITY:.6g} g" if in_g else pretty(size, QUANTITIES[of])
    elif value.lower() == "none":
        is_whole = words == "isolator" or part in _PARTS
        words, text = "no", words if is_whole else f"{words} stop"
    elif name in known:
        quantity = known[name].quantity
        text = pretty(to_si(value, quantity, path), quantity)
    else:
        text = value
    slug = "-".join((words.replace(" ", "-"), text.replace(" ", "-" if words == "no" else "")))
    return Change(f"{words} {text}", kept_letters(slug))


def joined(first: str, found: tuple[Change, ...]) -> str:
    """Return the beginning of the file names of a changed rig."""
    name = "-".join((first, *(change.slug for change in found)))
    if len(name.encode()) <= _LONGEST:
        return name
    cut = name.encode()[:_LONGEST].decode(errors="ignore")
    return f"{cut}-{hashlib.sha256(name.encode()).hexdigest()[:8]}"
