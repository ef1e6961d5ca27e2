"""What each flow measures of its stretches, against many samples of the same motion."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.observers import fourier
from vibroimpact.engine.observers import phases as layout
from vibroimpact.engine.observers.phases import ONE_MASS, begin_row
from vibroimpact.engine.observers.record import IMPACT, WRITTEN, note_buffer, start_notes
from vibroimpact.engine.one_mass import record_layout as written
from vibroimpact.engine.parameters import Drive, rig_vector
from vibroimpact.engine.state import copy, state_buffer, width, wind
from vibroimpact.law_numbers import IsolatorNumbers, PowerLaw

STIFFNESS, DAMPING, GAP = 20.0, 2.0, 0.3
BUMPER = (STIFFNESS, DAMPING, GAP)
OVERLAPPING = (STIFFNESS, DAMPING, -0.35)
"""Pressed together with the other one."""
EXPONENT, DISSIPATION = 1.5, 1.5
CURVED = PowerLaw(STIFFNESS, EXPONENT, DISSIPATION, 0.0, GAP)
WALL = (0.7, GAP)
YIELDS = IsolatorNumbers(hysteretic=1.5, limit=0.3)
FRICTION = 0.2
WEIGHTS = ((1.0, 0.0), (0.0, 0.3))


def rigs(base):
    """A rig of each flow, whose base moves or not."""
    one = Drive(base=base)
    several, line = Drive(base=base, weights=WEIGHTS), Drive(base=base, interval=3.0)
    of = {
        "Bumpers": (BUMPER, BUMPER, one, None),
        "AnyStops": (WALL, BUMPER, one, None),
        "AnyStops, both pressed": (BUMPER, OVERLAPPING, one, None),
        "Several": (BUMPER, BUMPER, several, None),
        "Recorded": (BUMPER, BUMPER, line, None),
        "Curved": (BUMPER, BUMPER, one, IsolatorNumbers(cubic=1.0)),
        "Curved, both pressed": (BUMPER, OVERLAPPING, one, IsolatorNumbers(cubic=1.0)),
        "Curved, friction": (BUMPER, BUMPER, one, IsolatorNumbers(cubic=1.0, friction=FRICTION)),
        "Curved, powers": (CURVED, CURVED, one, None),
        "Yielding": (BUMPER, BUMPER, one, YIELDS),
        "Yielding, friction": (BUMPER, BUMPER, one, IsolatorNumbers(friction=FRICTION)),
        "YieldingSeveral": (BUMPER, BUMPER, several, YIELDS),
        "YieldingRecorded": (BUMPER, BUMPER, line, YIELDS),
    }
    return {
        name: rig_vector(1.0, 4.0, 0.1, right, left, 0.2, drive, *([law] if law else []))
        for name, (right, left, drive, law) in of.items()
    }


FLOWS = [*rigs(1.0)]
AMPLITUDE, FREQUENCY, S, C = 1.0, 0.4, 0.6, 0.8
LENGTH = 1.0 / FREQUENCY
MOST, SAMPLES = 40, 4000
LATER = 1.3
"""When the cycle begins (s)."""


@entry(
    "void(f8[::1], f8, f8, f8[::1], f8[::1], f8[:, ::1], f8[:, ::1], f8[:, ::1], f8[::1],"
    " f8[::1], f8[:, ::1])",
    "recorded",
    "measured",
)
def followed(memory, rig, amplitude, omega, start, notes, rows, samples, events, since, lines, out):
    """The same cycle, measured, written down and integrated."""
    plan = planned(memory, rig)
    flow.build(plan, amplitude, omega)
    state, kept = state_buffer(), note_buffer()
    copy(pointer(start), state, width(plan))
    wind(plan, state, S, C)
    begin_row(pointer(rows), 1, 0, int(notes[layout.WIDTH]))
    event_loop.phases(plan, state, S, C, LENGTH, MOST, pointer(notes), pointer(rows))
    copy(pointer(start), state, width(plan))
    wind(plan, state, S, C)
    columns = samples.shape[1]
    start_notes(kept, columns, 0, LENGTH / SAMPLES, SAMPLES, 0, 0, MOST, 0)
    event_loop.record(plan, state, S, C, LENGTH, MOST, kept, pointer(samples), pointer(events))
    flow.write(plan, state, pointer(samples), columns, SAMPLES)
    notes[layout.NUMBER] = kept[WRITTEN]
    copy(pointer(start), state, width(plan))
    wind(plan, state, S, C)
    fourier.integrate(plan, state, S, C, LENGTH, MOST, pointer(since), pointer(lines), pointer(out))


def shaking(name, time):
    """The acceleration of the base."""
    if "Recorded" in name:
        return S + C * time
    angle = math.atan2(S, C) + math.tau * FREQUENCY * time
    values = AMPLITUDE * np.sin(angle)
    return values + 0.3 * AMPLITUDE * np.cos(2.0 * angle) if "Several" in name else values


@pytest.mark.parametrize("base", [1.0, 0.0])
@pytest.mark.parametrize("name", FLOWS)
def test_a_flow_measures_what_its_samples_tell(name: str, base: float) -> None:
    notes, rows = np.zeros(layout.NOTES), np.full((MOST + 3, ONE_MASS.width), np.nan)
    notes[:] = ONE_MASS.width, 1, 0, 0, MOST + 3, 0
    samples = np.zeros((written.SAMPLE, SAMPLES + 1))
    events = np.zeros((MOST + 1, written.EVENT))
    start = np.array([0.0, 0.0, 0.1, 1.5, 0.0, 0.0, 0.0, 0.0])
    omega = C / S if "Recorded" in name else math.tau * FREQUENCY
    lines = math.tau * FREQUENCY * np.array([0.0, 1.0, 7.0])
    since, out = np.array([LATER, float(len(lines))]), np.zeros((fourier.QUANTITIES, len(lines)))
    followed(
        rigs(base)[name],
        AMPLITUDE,
        omega,
        start,
        notes,
        rows,
        samples,
        events,
        since,
        lines,
        out,
    )
    count = int(notes[layout.WRITTEN])
    assert count == int(notes[layout.NUMBER]) >= 3
    rows, events = rows[: count + 1], events[:count]
    np.testing.assert_array_equal(rows[:-1, layout.SINCE], events[:, written.E_TIME])
    np.testing.assert_array_equal(rows[:-1, layout.KIND], events[:, written.E_KIND])
    np.testing.assert_array_equal(rows[:-1, layout.AT_STOP], events[:, written.E_STOP])
    arrival = rows[:-1, ONE_MASS.mass(layout.ARRIVAL)]
    np.testing.assert_array_equal(arrival, events[:, written.E_V])
    sharp = np.abs(events[:, [written.E_BEFORE, written.E_BEHIND]]).max(axis=1)
    np.testing.assert_array_equal(rows[:-1, ONE_MASS.mass(layout.A_EVENT)], sharp)
    assert rows[:, layout.LENGTH].sum() == pytest.approx(LENGTH, rel=1e-14)
    touched = {int(mode) for mode in rows[:, layout.TOUCHED]}
    assert touched >= ({0, 2} if name == "AnyStops" else {2, 3} if "both" in name else {0, 1, 2})

    time = np.arange(SAMPLES + 1) * (LENGTH / SAMPLES)
    bounds = np.concatenate([[0.0], events[:, written.E_TIME], [LENGTH]])
    for i, row in enumerate(rows):
        inside = (time >= bounds[i]) & (time <= bounds[i + 1])
        if inside.sum() > 100:  # of a shorter one, sums over samples are too coarse
            of_phase(name, row, samples[:, inside], time[inside], base, events, i)
    u, v, a = samples[[written.DISPLACEMENT, written.VELOCITY, written.ACCELERATION]]
    for (real, imaginary), values in zip(out.reshape(3, 2, -1), (u, v, a), strict=True):
        turned = values * np.exp(-1j * lines[:, np.newaxis] * (LATER + time))
        coarse = 1e-3 * np.trapezoid(np.abs(values), time)
        np.testing.assert_allclose(real + 1j * imaginary, np.trapezoid(turned, time), atol=coarse)


def of_phase(name, row, seen, time, base, events, i):
    u, v, a = (seen[k] for k in (written.DISPLACEMENT, written.VELOCITY, written.ACCELERATION))
    pull = shaking(name, time)
    carried = a if base else a + pull
    coarse = 2e-2  # of what is between the samples at the ends and the phase's own ends

    def total(values):
        # To the ends of the phase, at which the first and last sample do not lie.
        mean = np.trapezoid(values, time) / (time[-1] - time[0])
        return mean * row[layout.LENGTH]

    def near(integral, values):
        assert integral == pytest.approx(total(values), abs=coarse * total(np.abs(values)) + 1e-9)

    for values, least in (
        (u, ONE_MASS.mass(layout.U_LEAST)),
        (a, ONE_MASS.mass(layout.A_LEAST)),
        (carried, layout.CARRIED_LEAST),
    ):
        low, high = row[least], row[least + 1]
        wide = 1e-9 + coarse * np.ptp(values)
        assert low - 1e-12 <= values.min() <= low + wide
        assert high - wide <= values.max() <= high + 1e-12
    assert 0.0 <= row[ONE_MASS.mass(layout.A_TIME)] <= row[layout.LENGTH] * (1.0 + 1e-12)
    sharpest = time[0] + row[ONE_MASS.mass(layout.A_TIME)]
    largest = max(-row[ONE_MASS.mass(layout.A_LEAST)], row[ONE_MASS.mass(layout.A_MOST)])
    there = np.interp(sharpest, time, np.abs(a))
    assert there == pytest.approx(largest, abs=1e-6 + coarse * np.ptp(a))
    near(row[layout.WORK], v * pull)
    if "friction" in name:
        near(row[layout.LOST], 0.1 * v**2 + FRICTION * np.abs(v))
    elif not name.startswith("Yielding"):
        near(row[layout.LOST], 0.1 * v**2)
    for number, sign in enumerate((1.0, -1.0)):
        depth = seen[written.DEFORMATION + number]
        stop = {k: row[ONE_MASS.stop(k, number)] for k in range(layout.STOP)}
        if name == "AnyStops" and number == 0:
            assert stop[layout.IMPULSE] == stop[layout.FORCE] == 0.0
            hit = row[layout.KIND] == IMPACT
            lost = 0.5 * (1.0 - 0.7**2) * events[i, written.E_V] ** 2 if hit else 0.0
            assert stop[layout.HIT] == pytest.approx(lost, rel=1e-12)
            continue
        assert stop[layout.HIT] == 0.0
        if int(row[layout.TOUCHED]) >> number & 1:
            spring, dashpot = STIFFNESS * depth, DAMPING * sign * v
            if "powers" in name:
                spring = STIFFNESS * np.maximum(depth, 0.0) ** EXPONENT
                # It does not pull: what its spring holds is lost then.
                dashpot = np.maximum(DISSIPATION * spring * sign * v, -spring)
            push = spring + dashpot
            near(stop[layout.IMPULSE], push)
            near(stop[layout.LOSES], dashpot * sign * v)
            assert push.max() <= stop[layout.FORCE] + 1e-12
            assert stop[layout.FORCE] <= push.max() + coarse * np.ptp(push)
            assert depth.max() <= stop[layout.DEPTH] + 1e-12
            assert stop[layout.DEPTH] <= depth.max() + coarse * np.ptp(depth)
        else:
            assert stop[layout.IMPULSE] == stop[layout.FORCE] == stop[layout.DEPTH] == 0.0
            held = 0.5 * STIFFNESS * (depth[0] ** 2 - depth[-1] ** 2)
            assert stop[layout.LOSES] == pytest.approx(held, abs=coarse * abs(held) + 1e-9)
            rate = 0.0 if "powers" in name else STIFFNESS / DAMPING
            closing = sign * v[-1] + rate * depth[-1]
            size = abs(v[-1]) + rate * abs(depth[-1])
            assert stop[layout.CLOSING] == pytest.approx(closing, abs=coarse * size)
