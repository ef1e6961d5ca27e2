"""The functions that Python calls with a plan of several masses."""

from __future__ import annotations

from typing import Any

import numpy as np

from vibroimpact.engine.assembly import advance as motion
from vibroimpact.engine.assembly import channels
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.channels import CLEARANCE
from vibroimpact.engine.assembly.curved import advance as curved
from vibroimpact.engine.assembly.curved import channels as curved_channels
from vibroimpact.engine.assembly.curved.tangent import carry_along_series as carry_curved
from vibroimpact.engine.assembly.tangent import carry_disturbances
from vibroimpact.engine.event import GIVEN_UP, LIMIT, TURN, kind_of, stop_of
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.plain_entries import single

_SIGNATURE = "i8(f8[::1], f8, f8, f8[::1], f8[:, ::1], i8, f8[:, ::1], f8[:, ::1], f8[:, ::1], f8)"


def _follower(flow: Any, seen: Any, carry: Any) -> Any:
    """Make the loop of a flow, with its channels and what carries disturbances along."""
    build, load_motion, store_motion = flow.build, flow.load_motion, flow.store_motion
    next_stretch, open_stretch, close_stretch = (
        flow.next_stretch,
        seen.open_stretch,
        seen.close_stretch,
    )
    open_piece, piece_length, pieces, value = (
        seen.open_piece,
        seen.piece_length,
        seen.pieces,
        seen.value,
    )

    def go(
        plan: Vector,
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
        build(plan, amplitude, omega)
        here = pointer(state)
        n, stops = int(plan[at.MASSES]), int(plan[at.STOPS])
        count, written = 0, 0
        for k in range(len(lines)):
            s, c, length = lines[k, 0], lines[k, 1], lines[k, 2]
            load_motion(plan, here, s, c)
            t, events = 0.0, 0
            while t < length:
                left = length - t
                event = next_stretch(plan, left)
                if event == GIVEN_UP:
                    return -1 - k
                if len(disturbances):
                    carry(plan, pointer(disturbances), len(disturbances))
                if len(samples):
                    open_stretch(plan)
                    for i in range(pieces(plan)):
                        open_piece(plan, i)
                        if written < len(samples):
                            samples[written, 0] = k
                            samples[written, 1] = t + (i + tau) * piece_length(plan)
                            column = 2
                            for channel in range(7):
                                of = n if channel < CLEARANCE else stops
                                for index in range(of):
                                    found = value(plan, channel, index, tau)
                                    samples[written, column] = found
                                    column += 1
                            written += 1
                    close_stretch(plan)
                t = length if plan[at.LENGTH] == left else t + plan[at.LENGTH]
                if event != LIMIT:
                    events += 1
                    if events > max_events:
                        return -1 - k
                    if kind_of(event) == TURN:
                        continue
                    if count < len(log):
                        log[count, 0], log[count, 1] = k, t
                        log[count, 2], log[count, 3] = stop_of(event), kind_of(event)
                    count += 1
            store_motion(plan, here)
        return count

    return kernel(go)


_go = _follower(motion, channels, carry_disturbances)
_go_curved = _follower(curved, curved_channels, carry_curved)


@single(_SIGNATURE)
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
    count: int = _go(
        pointer(memory), amplitude, omega, state, lines, max_events, log, disturbances, samples, tau
    )
    return count


@single(_SIGNATURE)
def follow_curved(
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
    """Follow a motion with curved laws over sections; see `follow_sections`."""
    count: int = _go_curved(
        pointer(memory), amplitude, omega, state, lines, max_events, log, disturbances, samples, tau
    )
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
        (of `event`); what does not fit is dropped.
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
    run = follow_curved if plan[at.CURVED] else follow
    count: int = run(plan, amplitude, omega, state, lines, max_events, *optional, tau)
    return count


def sections(phase: float, length: float, count: int) -> Vector:
    """Lines of `follow_sections` for harmonic forcing, a cycle each."""
    return np.tile([np.sin(phase), np.cos(phase), length], (count, 1))
