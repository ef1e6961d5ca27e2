"""Stops that the mass can hit, one law per file.

A stop pushes and never pulls. Its gap is the distance from the mass at u = 0 to the stop at rest: u
= gap on the right, u = -gap on the left. A stop with a negative gap presses the mass away from u =
0.

A new law is a class derived from `StopLaw`, from `FormulaStop` if a formula gives its force,
from `WallLaw` if it is rigid, or from `StopWithMemory`, and an entry of `STOPS`. `FormulaStop`
lists what else a law with a public name takes.
"""

from typing import TypeAlias

from vibroimpact.model.law_registry import Kinds
from vibroimpact.model.own_law import Law
from vibroimpact.model.stops.bumper import Bumper
from vibroimpact.model.stops.jankowski import JankowskiBumper
from vibroimpact.model.stops.law import FormulaStop, StopLaw, StopWithMemory, WallLaw
from vibroimpact.model.stops.power import PowerBumper
from vibroimpact.model.stops.rigid import RigidStop
from vibroimpact.model.stops.zener import ZenerBumper

Stop: TypeAlias = StopLaw | Law
"""Whatever the mass can hit."""

STOPS = Kinds(Bumper, RigidStop, PowerBumper, JankowskiBumper, ZenerBumper, Law)

__all__ = [
    "STOPS",
    "Bumper",
    "FormulaStop",
    "JankowskiBumper",
    "Law",
    "PowerBumper",
    "RigidStop",
    "Stop",
    "StopLaw",
    "StopWithMemory",
    "WallLaw",
    "ZenerBumper",
]
