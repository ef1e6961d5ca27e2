"""An observer sees each stretch of a motion once, joined to the one before."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest

import vibroimpact as vi
from engine.for_flow import for_flow
from samples import sample
from vibroimpact.engine import batch
from vibroimpact.engine.event_loop import cycle
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.linear.tables import build
from vibroimpact.engine.motion import DETACHED, LIMIT, STATE, unpacked
from vibroimpact.engine.observe import observer
from vibroimpact.engine.observers import record
from vibroimpact.response.engine_input import engine_rig

AMPLITUDE, FREQUENCY, PHASE, CYCLES, MOST = 0.6, 1.2 / math.tau, 0.3, 20, 100


class Seen(NamedTuple):
    contacts: int
    detachments: int
    time: float
    gaps: int
    u: float
    v: float


@observer(Seen)
def seen(plan, notes, stretch):
    before, t, event, step, _, after = stretch
    contacts, detachments, time, gaps, u, v = notes
    if event == DETACHED:
        detachments += 1
    elif event != LIMIT:
        contacts += 1
    if t > 0.0 and (before.u != u or before.v != v):
        gaps += 1
    return Seen(contacts, detachments, time + step, gaps, after.u, after.v)


@for_flow("i8(f8[::1], f8[::1], f8, f8, f8, i8, i8, f8[::1])")
def look(given, rig, state, amplitude, frequency, phase, cycles, max_events, out):
    plan = planned(given, rig)
    build(plan, amplitude, 2.0 * math.pi * frequency)
    clock = (math.sin(phase), math.cos(phase))
    motion = unpacked(state, clock)
    notes = Seen(0, 0, 0.0, 0, 0.0, 0.0)
    count = 0
    for _ in range(cycles):
        events, motion, notes = cycle(plan, motion, clock, 1.0 / frequency, max_events, notes)
        count += events
    out[0], out[1], out[2], out[3] = notes.contacts, notes.detachments, notes.time, notes.gaps
    out[4], out[5] = motion.u, motion.v
    return count


# Each flow is compiled once more for it.
@pytest.mark.full
@pytest.mark.parametrize("stop", [*sample([vi.Bumper(20.0, 0.4, 1.0)], []), vi.RigidStop(0.6, 1.0)])
def test_every_event_is_seen_once_and_has_no_influence(stop: vi.Bumper | vi.RigidStop) -> None:
    rig = engine_rig(
        vi.Rig(vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), stop, stop), vi.Harmonic(1.0, 1.0))
    )
    out = np.zeros(6)
    events = look(rig, np.zeros(STATE), AMPLITUDE, FREQUENCY, PHASE, CYCLES, MOST, out)
    contacts, detachments, time, gaps = out[:4]

    state, written = np.zeros(STATE), np.empty(((CYCLES + 1) * MOST, record.EVENT))
    _, count, outcome = batch.trajectory(
        rig, AMPLITUDE, FREQUENCY, PHASE, state, 0.0, float(CYCLES), 0, MOST, np.empty((0, 6)),
        written,
    )  # fmt: skip
    ends = written[:count, record.E_KIND] == record.DETACHMENT
    assert outcome == 0
    assert events == count > CYCLES
    assert (contacts, detachments) == (count - ends.sum(), ends.sum())
    assert gaps == 0
    assert time == pytest.approx(CYCLES / FREQUENCY, rel=1e-13)
    np.testing.assert_array_equal(out[4:], state[2:4])
