"""Which parameters a design chart varies, and over which values, if nothing else is wanted."""

from __future__ import annotations

from vibroimpact.errors import InputError
from vibroimpact.model.system import System


def usual_ranges(system: System, gap: float) -> dict[str, list[float]]:
    """Return gaps up to 14/12 of the required gap (m), and stiffnesses of the bumpers.

    The stiffnesses reach from a tenth to ten times that of the stiffer bumper.

    Raises
    ------
    InputError
        If the rig has no stops.
    """
    stops = system.stop_laws.values()
    if not stops:
        raise InputError(
            "vary: missing; for a rig without stops there is no default; pass a parameter and its "
            "range, such as --vary damping_ratio=0.05:0.3"
        )
    gaps = [gap * (i + 1) / 12.0 for i in range(14)]
    bumpers = [pair for stop in stops if (pair := stop.spring_and_dashpot)]
    if len(bumpers) < len(stops):
        return {"gap": gaps}
    middle = max(stiffness for stiffness, _ in bumpers)
    return {"gap": gaps, "stops.stiffness": [middle * 10.0 ** (i / 6.0) for i in range(-6, 7)]}
