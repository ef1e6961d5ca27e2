"""Ranges of parameters, as they are written on the command line."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from vibroimpact.errors import InputError
from vibroimpact.model import to_si
from vibroimpact.model.parameters import Parameter, canonical, parameter, usual
from vibroimpact.model.units import pretty

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject
    from vibroimpact.model.excitation import Of

MOST = 4_000_000
"""Largest number of values in a range."""
_NODES = 21
"""Default number of nodes on an axis of a map."""
_VALUES = 15
"""Default number of values of a parameter in a design chart."""


def spread(option: str, varied: Parameter, text: str, nodes: int) -> tuple[list[float], str]:
    """Read ``LOW:HIGH[:log][:NODES]``.

    Returns
    -------
    values, spacing
        Values in SI units, and "log" or "linear". There are `nodes` values, unless the text states
        another number.

    Raises
    ------
    InputError
        If the text is not such a range. The message contains the name of the option.
    """
    parts = [part.strip() for part in text.split(":")]
    logarithmic = "log" in parts[2:3]
    rest = parts[3:] if logarithmic else parts[2:]
    if len(parts) < 2 or len(rest) > 1 or not all(parts):
        raise InputError(
            f"{option}: {text!r} is not a range; pass LOW:HIGH[:log][:NUMBER], such as 0.5:100 or "
            "0.5:100:log:21"
        )
    above = None if varied.zero and not logarithmic else 0.0
    least = 0.0 if above is None else None
    low, high = (
        to_si(part, varied.quantity, option, above=above, minimum=least, maximum=varied.most)
        for part in parts[:2]
    )
    if not low < high:
        raise InputError(
            f"{option}: the lower end of the range, {pretty(low, varied.quantity)}, is not below "
            f"the upper end, {pretty(high, varied.quantity)}; write the lower end first"
        )
    if rest:
        if not (rest[0].isascii() and rest[0].isdecimal()) or int(rest[0]) < 2:
            log = "" if logarithmic else ", or log for a logarithmic range"
            raise InputError(
                f"{option}: the number of values, {rest[0]!r}, is not a whole number of at least "
                f"2; pass such a number{log}"
            )
        nodes = int(rest[0])
    if nodes > MOST:
        raise InputError(f"{option}: {nodes} values; pass at most {MOST}")
    shares = [i / (nodes - 1) for i in range(nodes)]
    if logarithmic:
        ratio = math.log(high / low)
        values = [low * math.exp(share * ratio) for share in shares]
    else:
        values = [low + share * (high - low) for share in shares]
    return [low, *values[1:-1], high], "log" if logarithmic else "linear"


def map_axis(option: str, name: str, text: str, of: Of) -> tuple[str, list[float], str]:
    """Read an axis of a map: its name, its values in SI units, and "log" or "linear".

    Raises
    ------
    InputError
        If a map has no such axis, or if the text is not a range.
    """
    from vibroimpact.scenarios.axes import NAMES

    key = canonical(name, NAMES)
    if key not in NAMES:
        known = ", ".join(name.replace("_", "-") for name in NAMES)
        raise InputError(f"{option}: {name!r} is not an axis of a map; pass one of {known}")
    return key, *spread(option, usual(key, of), text, _NODES)


def parameter_values(
    what: Subject, option: str, texts: Mapping[str, str]
) -> dict[str, list[float]]:
    """Read ranges of parameters of a rig, and return their values in SI units.

    Raises
    ------
    InputError
        If a parameter is unknown, or if a text is not a range.
    """
    found = {}
    for name, text in texts.items():
        varied = parameter(name, what.rig, option)
        found[varied.name], _ = spread(option, varied, text, _VALUES)
    return found
