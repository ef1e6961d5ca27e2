"""The functions that Python calls with a plan of several masses."""

from __future__ import annotations

from typing import Any

import numpy as np

from vibroimpact.engine.assembly import advance as motion
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.plain_entries import single


@single("i8(f8[::1], f8, f8, f8[::1], f8[:, ::1], i8, f8[:, ::1])")
def follow(
    given: Any,
    memory: Vector,
    amplitude: float,
    omega: float,
    state: Vector,
    lines: Vector,
    max_events: int,
    log: Vector,
) -> int:
    """Follow a motion over sections and write its events down.

    Parameters
    ----------
    lines : ndarray, shape (section, 3)
        Clock s, c at the beginning of each, and its length (s).
    log : ndarray, shape (event, 4)
        Section, time since it began (s), stop, and what happened; what does not fit is dropped.

    Returns
    -------
    Number of events, or −1 − the section where the motion was given up.
    """
    plan = pointer(memory)
    motion.build(plan, amplitude, omega)
    here = pointer(state)
    count = 0
    for k in range(len(lines)):
        s, c, length = lines[k, 0], lines[k, 1], lines[k, 2]
        if len(log) == 0:
            events = motion.cycle(plan, here, s, c, length, max_events)
            if events > max_events:
                return -1 - k
            count += events
            continue
        motion.load(plan, here, s, c)
        t, events = 0.0, 0
        while t < length:
            left = length - t
            event = motion.advance(plan, left)
            if event == at.GIVEN_UP:
                return -1 - k
            t = length if plan[at.LENGTH] == left else t + plan[at.LENGTH]
            if event != at.LIMIT:
                events += 1
                if count < len(log):
                    log[count, 0], log[count, 1] = k, t
                    log[count, 2], log[count, 3] = plan[at.EVENT_STOP], event
                count += 1
                if events > max_events:
                    return -1 - k
        motion.store(plan, here)
    return count


def sections(phase: float, length: float, count: int) -> Vector:
    """Lines of `follow` for harmonic forcing."""
    return np.tile([np.sin(phase), np.cos(phase), length], (count, 1))
