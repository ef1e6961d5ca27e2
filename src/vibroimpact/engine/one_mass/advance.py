# mypy: disable-error-code="empty-body"
"""The motion from event to event, by the flow that the type of the plan names."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine.dispatch import in_place_of
from vibroimpact.engine.flow_dispatch import ONE_MASS, one_mass_flow
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.motion import Ended, Motion


def _plain(plan: Any, *args: Any) -> Any:
    return one_mass_flow(plan).advance(plan, *args)  # a plan begins with the rig's vector


def _of_type(plan: Any) -> Any:
    return plan.flow.advance


@in_place_of([flow.advance for flow in ONE_MASS], _plain, _of_type)
def advance(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Go on to the next event, or for the time `limit` if that comes first.

    Returns
    -------
    event, t, arrival, motion
        What ended the stretch (see `event`), its length (s), the velocity just before the event,
        and the motion just after it.
    """
