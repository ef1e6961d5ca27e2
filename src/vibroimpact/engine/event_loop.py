"""The one event loop: a forcing cycle, from event to event, under the eyes of an observer."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine.flow_dispatch import advance
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import (
    GIVEN_UP,
    LIMIT,
    SETTLING,
    Clock,
    Motion,
    Stretch,
    at_section,
    finite,
)
from vibroimpact.engine.observe import observe


@kernel
def cycle(
    plan: Vector, motion: Motion, clock: Clock, length: float, max_events: int, notes: Any
) -> tuple[int, Motion, Any]:
    """Follow a motion from a section over `length` seconds, one forcing cycle or part of it.

    The phase at the section is the clock exactly, each time: angles do not accumulate.

    Parameters
    ----------
    notes
        What an observer has noted so far; its type says which observer (`observe`).

    Returns
    -------
    events, motion, notes
        `events` is the number of contacts and detachments, or more than `max_events` if the
        cycle was not finished.
    """
    motion = at_section(motion, clock)
    t = 0.0
    events = 0
    while True:
        before = motion
        event, step, arrival, motion = advance(plan, before, max(length - t, 0.0))
        if event == GIVEN_UP:
            if finite(motion):  # otherwise it left the range of numbers, which its caller sees
                events = max_events + 1
            break
        stretch = Stretch(before, t, event, step, arrival, motion)
        notes = observe(plan, notes, stretch)
        if event == LIMIT:
            break
        t += step
        events += 1
        if events > max_events:
            break
        if t >= length and not motion.fresh & SETTLING:  # the rest of a chatter is not cut off
            break
    return events, motion, notes
