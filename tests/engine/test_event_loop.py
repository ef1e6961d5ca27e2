"""An observer sees each stretch of a motion once, joined to the one before."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine import batch, flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.event import at_stop, begins_contact
from vibroimpact.engine.event_loop import observed
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import kernel
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.observers.record import DETACHMENT
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.state import EVENT, ONE_MASS, STEP, T, copy, load, state_buffer, width
from vibroimpact.response.engine_system import engine_rig

AMPLITUDE, FREQUENCY, PHASE, CYCLES, MOST = 0.6, 1.2 / math.tau, 0.3, 20, 100


CONTACTS, DETACHMENTS, TIME, GAPS, LAST_U, LAST_V = range(6)
U, V = ONE_MASS.displacement(), ONE_MASS.velocity()


@kernel
def see(plan, before, ended, after, notes):
    event = int(ended[EVENT])
    if begins_contact(event):
        notes[CONTACTS] += 1
    elif at_stop(event):
        notes[DETACHMENTS] += 1
    if ended[T] > 0.0 and (before[U] != notes[LAST_U] or before[V] != notes[LAST_V]):
        notes[GAPS] += 1
    notes[TIME] += ended[STEP]
    notes[LAST_U], notes[LAST_V] = after[U], after[V]


seen = observed(see)


@entry("i8(f8[::1], f8[::1], f8, f8, f8, i8, i8, f8[::1])")
def look(memory, rig, state, amplitude, frequency, phase, cycles, max_events, out):
    plan = planned(memory, rig)
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    s, c = math.sin(phase), math.cos(phase)
    here = state_buffer()
    load(plan, pointer(state), here, s, c)
    count = 0
    for _ in range(cycles):
        count += seen(plan, here, s, c, 1.0 / frequency, max_events, pointer(out))
    copy(here, pointer(state), width(plan))
    return count


@pytest.mark.parametrize("stop", [vi.Bumper(20.0, 0.4, 1.0), vi.RigidStop(0.6, 1.0)])
def test_every_event_is_seen_once_and_has_no_influence(stop: vi.Bumper | vi.RigidStop) -> None:
    rig = engine_rig(
        vi.Rig(vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), stop, stop), vi.Harmonic(1.0, 1.0))
    )
    out = np.zeros(6)
    events = look(rig, np.zeros(ONE_MASS.width), AMPLITUDE, FREQUENCY, PHASE, CYCLES, MOST, out)
    contacts, detachments, time, gaps = out[:4]

    state, written = np.zeros(ONE_MASS.width), np.empty(((CYCLES + 1) * MOST, record_layout.EVENT))
    _, count, outcome = batch.trajectory(
        rig, AMPLITUDE, FREQUENCY, PHASE, state, 0.0, float(CYCLES), 0, MOST, np.empty((0, 6)),
        written,
    )  # fmt: skip
    ends = written[:count, record_layout.E_KIND] == DETACHMENT
    assert outcome == 0
    assert events == count > CYCLES
    assert (contacts, detachments) == (count - ends.sum(), ends.sum())
    assert gaps == 0
    assert time == pytest.approx(CYCLES / FREQUENCY, rel=1e-13)
    np.testing.assert_array_equal(out[4:], state[2:4])
