"""What `vi.simulate` reports, in the words of the 50-digit reference."""

from __future__ import annotations

from typing import NamedTuple

import xarray as xr

import vibroimpact as vi
from reference.fifty_digits import Rig, Stop, Wall

WORDS = {0: "detach", 1: "contact", 2: "impact"}
"""By `event_contact`. On a rigid stop contact and detachment are the beginning and end of rest."""


class Seen(NamedTuple):
    kind: str
    """Such as 'impact_right'."""
    time: float
    """s."""
    u: float
    v: float
    """Of an impact, that before it."""


def events(data: xr.Dataset) -> list[Seen]:
    columns = ("event_contact", "event_side", "event_time", "event_displacement", "event_velocity")
    rows = zip(*(data[name].values.tolist() for name in columns), strict=True)
    return [
        Seen(f"{WORDS[what]}_{'right' if side == 1 else 'left'}", time, u, v)
        for what, side, time, u, v in rows
    ]


def reference_rig(rig: vi.Oscillator) -> Rig:
    stops = (
        stop
        and (
            Wall(stop.restitution, stop.gap)
            if isinstance(stop, vi.RigidStop)
            else Stop(stop.stiffness, stop.damping, stop.gap)
        )
        for stop in (rig.right, rig.left)
    )
    return Rig(rig.mass, rig.isolator.stiffness, rig.isolator.damping, *stops)
