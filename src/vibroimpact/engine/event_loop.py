"""The one event loop: a forcing cycle, from event to event, under the eyes of an observer.

It is compiled once for all flows: a flow goes on to the next event (`flow.advance`), and an
observer, a function of the flow, too, adds what it sees of that stretch to its notes.
"""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import flow
from vibroimpact.engine import state as states
from vibroimpact.engine.event import GIVEN_UP, LIMIT, PASSED, kind_of
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.observers.phases import note
from vibroimpact.engine.state import EVENT, FRESH, SETTLING, STEP, T, state_buffer, stretch_buffer


def loop(advance: Any, load: Any, put: Any, finite: Any, observe: Any) -> Any:
    """Make the loop over a flow's function `advance`, with an observer or None.

    What follows `max_events` is passed on to the observer. `load` and `put` copy a state, `finite`
    returns whether it is within the range of numbers, as those of `state` do for every flow.
    """

    def cycle(
        plan: Vector,
        state: Vector,
        s: float,
        c: float,
        length: float,
        max_events: int,
        *notes: Vector,
    ) -> int:
        here, there, ended = state_buffer(), state_buffer(), stretch_buffer()
        load(plan, state, here, s, c)
        t = 0.0
        events = 0
        while True:
            event = advance(plan, here, max(length - t, 0.0), ended, there)
            kind = kind_of(event)
            if kind == GIVEN_UP:
                if finite(plan, there):  # else it left the range of numbers: its caller sees it
                    events = max_events + 1
                break
            if observe is not None:
                ended[EVENT], ended[T] = event, t
                observe(plan, here, ended, there, *notes)
            if kind == LIMIT:
                break
            t += ended[STEP]
            if kind == PASSED:
                put(plan, there, here)
                continue
            events += 1
            if events > max_events:
                break
            # The rest of a chatter is not cut off.
            if t >= length and not int(there[FRESH]) & SETTLING:
                break
            put(plan, there, here)
        put(plan, there, state)
        return events

    cycle.__doc__ = """Follow a motion from a section, where the clock is s, c, over a length (s).

    The phase at the section is the clock exactly, each time: angles do not accumulate. The state is
    carried on in place.

    Returns
    -------
    events
        The number of events, of which `event` lists the kinds, but for LIMIT and PASSED; or more
        than `max_events` if the cycle was not finished.
    """
    return kernel(cycle)


def observed(observe: Any) -> Any:
    """Make the loop, for all flows, of an observer: a kernel (plan, before, ended, after, *notes).

    None if there is none.

    It is called for each stretch between two events. `before` and `after` are the states at its
    ends, `ended` what is in `state.stretch_buffer`; it adds what it sees to its notes.
    """
    return loop(flow.advance, states.load, states.put, states.finite, observe)


unobserved = observed(None)
extremes = observed(flow.extremes)
demand = observed(flow.demand)
margin = observed(flow.margin)
record = observed(flow.record)
tangent = observed(flow.tangent)
phases = observed(note)
