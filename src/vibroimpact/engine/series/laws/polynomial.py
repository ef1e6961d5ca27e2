"""Springs that harden or soften: cubic u³ + quintic u⁵."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import parameters as par


def shape(rig: Any) -> tuple[Any, ...]:
    """Return which powers there are."""
    powers = ((3, par.CUBIC), (5, par.QUINTIC))
    return tuple(power for power, at in powers if rig[at] != 0.0)


def force(law: Any, powers: tuple[Any, ...], u: Any, v: Any, z: Any) -> Any:
    """Return what pulls back."""
    terms = [(law.cubic if power == 3 else law.quintic) * u**power for power in powers]
    return sum(terms[1:], terms[0])
