"""Each function of a flow's table by itself, for every flow, called as the engine calls it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.flow_tables import GROUPS
from vibroimpact.engine.memory import beyond, pointer
from vibroimpact.engine.observers import growth
from vibroimpact.engine.observers.record import WRITTEN, note_buffer, start_notes
from vibroimpact.engine.one_mass import record as written
from vibroimpact.engine.one_mass import table as one_mass
from vibroimpact.engine.one_mass.extremes import A_MOST, T_MOST, U_MOST
from vibroimpact.engine.parameters import Drive, rig_vector
from vibroimpact.engine.state import (
    FIRST,
    ONE_MASS,
    copy,
    measures_buffer,
    notes_buffer,
    parts_buffer,
    state_buffer,
    width,
    wind,
)
from vibroimpact.law_numbers import IsolatorNumbers

BUMPER = (20.0, 2.0, 0.3)
HARMONICS = Drive(weights=((1.0, 0.0), (0.0, 0.3)))
YIELDS = IsolatorNumbers(hysteretic=1.5, limit=0.3)
RIGS = {
    "Bumpers": rig_vector(1.0, 4.0, 0.1, BUMPER, BUMPER),
    "AnyStops": rig_vector(1.0, 4.0, 0.1, (0.7, 0.3), BUMPER),
    "Several": rig_vector(1.0, 4.0, 0.1, BUMPER, BUMPER, drive=HARMONICS),
    "Curved": rig_vector(1.0, 4.0, 0.1, BUMPER, BUMPER, law=IsolatorNumbers(cubic=1.0)),
    "Yielding": rig_vector(1.0, 4.0, 0.1, BUMPER, BUMPER, law=YIELDS),
}
"""A rig of each flow that the tests have compiled with all its functions."""
AMPLITUDE, FREQUENCY, S, C = 1.0, 0.4, 0.6, 0.8
MOST = 100
SAMPLES = 50

grown = event_loop.observed(growth.grow)

EVENTS, U, V = range(3)
ROW = 3
CYCLE, EXTREMES, RECORDED, DEMAND, MARGIN, TANGENT, GROWTH = range(7)


@entry(
    "void(f8[::1], f8, f8, f8[::1], f8[:, ::1], f8[::1], f8[:, ::1], f8[:, ::1])",
    "recorded",
    "disturbed",
    "measured",
)
def watched(memory, rig, amplitude, frequency, start, rows, low_high, samples, events):
    """The same cycle, unobserved and under each observer."""
    plan = planned(memory, rig)
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    period = 1.0 / frequency
    state, notes, tally = state_buffer(), measures_buffer(), notes_buffer()
    kept, q, w = note_buffer(), np.zeros(25), np.zeros(25)
    for which in range(7):
        copy(pointer(start), state, width(plan))
        wind(plan, state, S, C)
        if which == CYCLE:
            count = flow.cycle(plan, state, S, C, period, MOST)
        elif which == EXTREMES:
            flow.nothing(plan, notes)
            count = event_loop.extremes(plan, state, S, C, period, MOST, notes)
            low_high[0], low_high[1] = notes[0], notes[1]
            low_high[2], low_high[3] = notes[2], notes[3]
        elif which == RECORDED:
            start_notes(kept, samples.shape[1], 0, period / SAMPLES, SAMPLES, 0, 0, MOST, 0)
            count = event_loop.record(
                plan, state, S, C, period, MOST, kept, pointer(samples), pointer(events)
            )
            flow.write(plan, state, pointer(samples), samples.shape[1], SAMPLES)
            low_high[8] = kept[WRITTEN]
        elif which == DEMAND:
            flow.start_demand(plan, tally, 0)
            count = event_loop.demand(plan, state, S, C, period, MOST, tally)
            low_high[4], low_high[5] = tally[0], tally[1]
            low_high[6], low_high[7] = tally[2], tally[3]
        elif which == MARGIN:
            tally[0] = math.inf
            count = event_loop.margin(plan, state, S, C, period, MOST, tally)
        elif which == TANGENT:
            tally[0], tally[1], tally[2] = 0.0, 0.0, 0.0
            flow.unit_disturbances(plan, state, pointer(q))
            count = event_loop.tangent(plan, state, S, C, period, MOST, tally, pointer(q))
        else:
            tally[0], tally[1], tally[2], tally[3], tally[4] = 0.0, 0.0, 0.0, 0.0, 0.0
            flow.units(plan, pointer(w))
            q[:] = 0.0
            grows = growth.rows_of(
                plan, pointer(q), growth.work_buffer(), pointer(w), beyond(tally, 3), 2
            )
            growth.begin_rows(plan, state, grows, 0, 2)
            count = grown(plan, state, S, C, period, MOST, tally, grows)
        rows[which, EVENTS] = count
        rows[which, U], rows[which, V] = state[FIRST], state[FIRST + 1]


@pytest.mark.full
@pytest.mark.parametrize("name", RIGS)
def test_observers_see_the_motion_and_do_not_disturb_it(name: str) -> None:
    rows, low_high = np.zeros((7, ROW)), np.zeros(9)
    samples, events = np.zeros((written.SAMPLE, SAMPLES + 1)), np.zeros((MOST + 1, written.EVENT))
    start = np.array([0.0, 0.0, 0.1, 1.5, 0.0, 0.0, 0.0, 0.0])
    watched(RIGS[name], AMPLITUDE, FREQUENCY, start, rows, low_high, samples, events)
    assert rows[0, EVENTS] >= 2
    for row in rows[1:]:
        assert row.tolist() == rows[0].tolist()
    assert low_high[8] >= 2
    # The extremes hold the samples; the demand's are the same numbers found in another way.
    u, a = samples[written.DISPLACEMENT], samples[written.ACCELERATION]
    assert (samples[0, -1], samples[1, -1]) == (rows[0, U], rows[0, V])
    assert low_high[0] <= u.min() < u.max() <= low_high[1]
    assert low_high[2] <= a.min() < a.max() <= low_high[3]
    assert low_high[1] - u.max() < 0.01
    np.testing.assert_allclose(low_high[4:8], low_high[:4], rtol=1e-12)


@entry("void(f8[::1], f8, f8, f8[::1], f8[::1], f8[:, ::1])", "disturbed")
def asked(memory, rig, amplitude, frequency, start, out, q):
    """What a flow tells of a state without following it."""
    plan = planned(memory, rig)
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    state, numbers = state_buffer(), parts_buffer()
    copy(pointer(start), state, width(plan))
    wind(plan, state, S, C)
    out[0] = flow.parts(plan)
    out[1] = flow.stiff_rate(plan)
    out[2] = flow.size(plan, state)
    out[3] = flow.too_much_work(plan, 1.0 / frequency)
    out[4] = flow.too_much_work(plan, 1e30)
    flow.units(plan, numbers)
    copy(numbers, beyond(pointer(out), 5), flow.parts(plan))
    flow.point(plan, state, numbers)
    copy(numbers, beyond(pointer(out), 10), flow.parts(plan))
    flow.at_point(plan, state, numbers)
    copy(state, beyond(pointer(out), 15), width(plan) + 2)
    out[25] = flow.disturb(plan, state, 0, 1e-3, 1.0)
    out[26] = flow.disturb(plan, state, 1, 1e-3, 1.0)
    out[27] = flow.disturb(plan, state, 2, 1e-3, 0.5)
    out[28] = flow.disturb(plan, state, 2, 1e-3, 1e9)
    out[29] = flow.disturb(plan, state, 4, 1e-3, 1.0)
    flow.mirror(plan, state, pointer(q))
    copy(state, beyond(pointer(out), 30), width(plan))
    flow.mirror(plan, state, pointer(q))
    copy(state, beyond(pointer(out), 40), width(plan))


@pytest.mark.parametrize("name", RIGS)
def test_what_is_said_of_a_state(name: str) -> None:
    out, q = np.zeros(50), np.arange(25.0).reshape(5, 5)
    before = q.copy()
    start = np.array([0.0, 0.0, 0.1, -0.2, 0.01, 0.02, 0.05, 7.0])
    asked(RIGS[name], AMPLITUDE, FREQUENCY, start, out, q)
    hysteretic = name == "Yielding"
    rate = math.sqrt(5.5 if hysteretic else 4.0)
    parts, stiff_rate, size, slow, endless = out[:5]
    assert (parts, slow, endless) == (5, 0, 1)
    assert stiff_rate == pytest.approx(rate, rel=1e-15)
    assert size == pytest.approx(max(0.1 * rate, 0.2), rel=1e-15)
    np.testing.assert_allclose(out[5:10], [rate, 1.0, rate, rate, rate], rtol=1e-15)
    # A point has the signs of the paper; a rigid stop has no deformation.
    right = 0.0 if name == "AnyStops" else 0.01
    assert out[10:15].tolist() == [0.1, -0.2, 0.01, -0.02, 0.05]
    assert out[15:25].tolist() == [0, 0, 0.1, -0.2, right, 0.02, 0.05, 0.0, S, C]
    grown = [1e-3, 1e-3, 0.0 if name == "AnyStops" else 1e-3, 0.0, -1e-3 if hysteretic else 0.0]
    np.testing.assert_allclose(out[25:30], grown, rtol=1e-12, atol=0.0)
    moved, again = out[30:38], out[40:48]
    assert again[2:7].tolist() == [-moved[2], -moved[3], moved[5], moved[4], -moved[6]]
    assert q.tolist() == before.tolist()


@entry("i8(f8[::1], f8, f8, f8[::1], f8[::1])")
def freely(memory, rig, amplitude, frequency, start, out):
    plan = planned(memory, rig)
    flow.begin(plan, amplitude, 2.0 * math.pi * frequency)
    state, measures = state_buffer(), measures_buffer()
    copy(pointer(start), state, width(plan))
    wind(plan, state, S, C)
    free = flow.undisturbed(plan, state, 0.999, measures)
    out[0], out[1], out[2] = measures[U_MOST], measures[A_MOST], measures[T_MOST]
    out[3], out[4] = state[FIRST], state[FIRST + 1]
    return free


def test_free_flight_in_closed_form() -> None:
    out = np.zeros(5)
    start = np.zeros(ONE_MASS.width)
    omega = math.tau * FREQUENCY
    response = -0.1 / (4.0 - omega**2 + 0.1j * omega)
    assert freely(RIGS["Bumpers"], 0.1, FREQUENCY, start, out) == 1
    angle = complex(C, S)
    expected = [(response * angle).imag, (1j * omega * response * angle).imag]
    np.testing.assert_allclose(out[3:], expected, rtol=1e-13)
    assert out[0] == pytest.approx(abs(response), rel=1e-13)
    assert out[1] == pytest.approx(out[2], rel=1e-15)
    assert out[1] == pytest.approx(abs(response) * abs(complex(4.0, 0.1 * omega)), rel=1e-13)
    # It would touch a stop; and curved laws have no closed form.
    assert freely(RIGS["Bumpers"], 10.0, FREQUENCY, start, out) == 0
    assert freely(RIGS["Curved"], 0.1, FREQUENCY, start, out) == 0


def test_every_function_belongs_to_one_group() -> None:
    names = [name for group in flow.GROUPS.values() for name in group]
    assert sorted(names) == sorted(flow.SIGNATURES)
    assert all(hasattr(one_mass, name) for name in names)
    assert flow.GROUPS.keys() == GROUPS.keys()
