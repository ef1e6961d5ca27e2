"""Ranges of a parameter, as the command line writes them."""

from __future__ import annotations

import math

from vibroimpact.errors import InputError
from vibroimpact.model import to_si
from vibroimpact.model.parameters import Parameter

MOST = 4_000_000
"""More values than anyone means."""


def spread(option: str, varied: Parameter, text: str, nodes: int) -> tuple[list[float], str]:
    """Read ``LOW:HIGH[:log][:NODES]``.

    Returns
    -------
    values, spacing
        In SI units, `nodes` of them if the text does not say how many; "log" or "linear".

    Raises
    ------
    InputError
        If it is no such range; the line begins with the option.
    """
    parts = [part.strip() for part in text.split(":")]
    logarithmic = "log" in parts[2:3]
    rest = parts[3:] if logarithmic else parts[2:]
    if len(parts) < 2 or len(rest) > 1 or not all(parts):
        raise InputError(
            f"{option}: {text!r}; a range LOW:HIGH[:log][:NODES] is accepted, such as 0.5:100:log"
        )
    above = None if varied.zero and not logarithmic else 0.0
    least = 0.0 if above is None else None
    low, high = (
        to_si(part, varied.quantity, option, above=above, minimum=least, maximum=varied.most)
        for part in parts[:2]
    )
    if not low < high:
        raise InputError(f"{option}: {low:g} is not below {high:g}; a rising range is accepted")
    if rest:
        if not (rest[0].isascii() and rest[0].isdecimal()) or int(rest[0]) < 2:
            raise InputError(
                f"{option}: {rest[0]!r} nodes; a whole number of at least 2 is accepted"
            )
        nodes = int(rest[0])
    if nodes > MOST:
        raise InputError(f"{option}: {nodes} nodes; at most {MOST} are accepted")
    shares = [i / (nodes - 1) for i in range(nodes)]
    if logarithmic:
        ratio = math.log(high / low)
        values = [low * math.exp(share * ratio) for share in shares]
    else:
        values = [low + share * (high - low) for share in shares]
    return [low, *values[1:-1], high], "log" if logarithmic else "linear"
