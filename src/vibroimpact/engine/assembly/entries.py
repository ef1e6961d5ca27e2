"""The functions that Python calls with a plan of several masses."""

from __future__ import annotations

from typing import Any

import numpy as np

from vibroimpact.engine.assembly import advance as motion
from vibroimpact.engine.assembly import channels
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.tangent import carry_disturbances
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.plain_entries import single


@single("i8(f8[::1], f8, f8, f8[::1], f8[:, ::1], i8, f8[:, ::1], f8[:, ::1], f8[:, ::1], f8)")
def follow(
    given: Any,
    memory: Vector,
    amplitude: float,
    omega: float,
    state: Vector,
    lines: Vector,
    max_events: int,
    log: Vector,
    disturbances: Vector,
    samples: Vector,
    tau: float,
) -> int:
    """Follow a motion over sections; see `follow_sections`."""
    plan = pointer(memory)
    motion.build(plan, amplitude, omega)
    here = pointer(state)
    n, stops = int(plan[at.MASSES]), int(plan[at.STOPS])
    count, written = 0, 0
    for k in range(len(lines)):
        s, c, length = lines[k, 0], lines[k, 1], lines[k, 2]
        motion.load_motion(plan, here, s, c)
        t, events = 0.0, 0
        while t < length:
            left = length - t
            event = motion.next_stretch(plan, left)
            if event == at.GIVEN_UP:
                return -1 - k
            if len(disturbances):
                carry_disturbances(plan, pointer(disturbances), len(disturbances))
            if len(samples):
                channels.open_stretch(plan)
                for i in range(channels.pieces(plan)):
                    channels.open_piece(plan, i)
                    if written < len(samples):
                        samples[written, 0] = k
                        samples[written, 1] = t + (i + tau) * channels.piece_length(plan)
                        column = 2
                        for channel in range(7):
                            of = n if channel < channels.CLEARANCE else stops
                            for index in range(of):
                                found = channels.value(plan, channel, index, tau)
                                samples[written, column] = found
                                column += 1
                        written += 1
                channels.close_stretch(plan)
            t = length if plan[at.LENGTH] == left else t + plan[at.LENGTH]
            if event != at.LIMIT:
                events += 1
                if count < len(log):
                    log[count, 0], log[count, 1] = k, t
                    log[count, 2], log[count, 3] = plan[at.EVENT_STOP], event
                count += 1
                if events > max_events:
                    return -1 - k
        motion.store_motion(plan, here)
    return count


def follow_sections(
    plan: Vector,
    amplitude: float,
    omega: float,
    state: Vector,
    lines: Vector,
    *,
    max_events: int = 10_000,
    log: Vector | None = None,
    disturbances: Vector | None = None,
    samples: Vector | None = None,
    tau: float = 0.5,
) -> int:
    """Follow a motion over sections, in place.

    Parameters
    ----------
    plan
        From `plan.make_plan`.
    state : ndarray
        See `layout`.
    lines : ndarray, shape (section, 3)
        Clock s, c at the beginning of each, and its length (s).
    max_events
        In one section, at which the motion is given up.
    log : ndarray, shape (event, 4)
        Gets of each event its section, the time since this began (s), stop, and what happened
        (`layout.CONTACT`, …); what does not fit is dropped.
    disturbances : ndarray, shape (row, 2 n + stops)
        Are carried along.
    samples : ndarray, shape (piece, 2 + 4 n + 3 stops)
        Gets of each piece its section, a time since this began, and all channels there.
    tau
        Where on a piece, 0 to 1.

    Returns
    -------
    Number of events, or −1 − the section where the motion was given up.
    """
    none = np.zeros((0, 0))
    optional = [none if one is None else one for one in (log, disturbances, samples)]
    count: int = follow(plan, amplitude, omega, state, lines, max_events, *optional, tau)
    return count


def sections(phase: float, length: float, count: int) -> Vector:
    """Lines of `follow_sections` for harmonic forcing, a cycle each."""
    return np.tile([np.sin(phase), np.cos(phase), length], (count, 1))
