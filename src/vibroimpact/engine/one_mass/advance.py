"""The motion from event to event, by the flow that the type of the plan names."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import parameters as par
from vibroimpact.engine.compiler import overload
from vibroimpact.engine.flow_dispatch import AnyStops, Curved, OneMassFlow, Yielding
from vibroimpact.engine.jit import CHOSEN, Vector
from vibroimpact.engine.motion import Ended, Motion


def advance(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Go on to the next event, or for the time `limit` if that comes first.

    Returns
    -------
    event, t, arrival, motion
        What ended the stretch (see `event`), its length (s), the velocity just before the event,
        and the motion just after it.
    """
    flows: tuple[type[OneMassFlow], ...] = AnyStops, Curved, Yielding
    ended: Ended = flows[par.laws(plan)].advance(plan, motion, limit)
    return ended


@overload(advance, jit_options=CHOSEN, strict=False)  # type: ignore[arg-type]
def _advance(plan: Any, motion: Any, limit: Any) -> Any:
    return plan.flow.advance.py_func
