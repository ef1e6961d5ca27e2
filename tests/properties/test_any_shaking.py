"""Moved bases, forces, several harmonics, records, a constant force and no spring among the rigs.

What holds for one sine of acceleration holds for all.
"""

from __future__ import annotations

import math
import warnings

import numpy as np
from hypothesis import assume, example, given
from hypothesis import strategies as st

import vibroimpact as vi
from properties.strategies import (
    SAMPLES,
    Motion,
    distance,
    examples,
    motions,
    recorded,
    simulated,
    states,
    tame,
)
from properties.test_energy import imbalance, unbalanced
from properties.test_restart import CYCLES, end_of_cut_run
from reference.linear_phases import lines
from reference.paper_signs import signed_parts

ROUNDING = 1e-11
ULPS = 16
ANY = motions(any_shaking=True)


@examples(60)
@given(ANY)
def test_work_is_dissipated_or_stored(motion: Motion) -> None:
    assert imbalance(motion) < 1e-11


@examples(40)
@given(ANY, st.floats(1e-6, CYCLES * (1 - 1e-6)))
def test_a_run_may_be_cut_anywhere(motion: Motion, cut: float) -> None:
    assert distance(tame(motion, CYCLES), end_of_cut_run(motion, cut)) < ROUNDING


@examples(40)
@given(ANY)
def test_the_mirrored_rig_moves_mirrored(motion: Motion) -> None:
    data = tame(motion, CYCLES)
    shaken, start = motion.excitation, motion.start
    if isinstance(shaken, vi.Periodic):
        turned = shaken.replace(phases=[angle + math.pi for angle in shaken.phases])
    else:
        turned = shaken.replace(phase=shaken.phase + math.pi)
    mirror = Motion(
        motion.oscillator.mirrored(), turned, vi.State(-start.displacement, -start.velocity)
    )
    image = states(simulated(mirror, CYCLES, SAMPLES))
    assert distance(data, -image[[0, 1, 3, 2]]) < ROUNDING


def through(rig: vi.Oscillator, record: vi.Record, start, samples: int = 1):
    """The motion through a record, of those only that are not given up for chattering."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        data = vi.simulate(
            vi.Rig(rig, record),
            start=start,
            samples=samples,
            tail=2.5 * record.step,
            max_events=1000,
        )
    assume(data["status"] == 0)
    return data


def tame_record(rig: vi.Oscillator, record: vi.Record, start: vi.State):
    """The motion, of those only that do not blow up small disturbances, and how far rounding goes.

    Each line of the record and each event rounds by some units in the last place, which grow as
    disturbances of the start and of the record do; a phase may last long besides. Where the mass
    comes to a stop so slowly that it all but grazes it, at a share w of its largest speed, what the
    displacement rounds shifts the impact by 1/w of that, though the start's error may matter less.
    """
    data = through(rig, record, start)
    speed = float(np.abs(data["velocity"]).max())
    growth = 1.0
    for sign in (1e-9, -1e-9):
        other = vi.Record(record.acceleration * (1 + sign), record.step)
        beside = start.replace(velocity=start.velocity - sign * speed)
        growth = max(growth, distance(data, states(through(rig, other, beside))) / 1e-9)
    assume(growth < 1000.0)
    events = data.sizes["event"] + len(record.time)
    arrivals = np.abs(data["event_velocity"].values[data["event_contact"].values > 0])
    grazing = float(np.max(speed / arrivals[arrivals > 0.0], initial=1.0))
    return data, max(1e-12, ULPS * np.finfo(float).eps * max(growth * events, grazing))


@examples(60)
@given(recorded())
def test_the_work_of_a_record_is_dissipated_or_stored(
    case: tuple[vi.Oscillator, vi.Record, vi.State],
) -> None:
    rig, record, start = case
    data = through(rig, record, start)
    walk = list(lines(rig, record, data))
    assert unbalanced(rig, walk) < 1e-11


GRAZING = (
    vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), vi.RigidStop(1.0, 0.0), vi.RigidStop(0.0625, 5.0)),
    vi.Record([0.0, 0.0, 0.0], math.pi),
    vi.State(0.0, 10.0),
)
"""Each impact on the left is slower by a factor of sixteen; the last one is at 0.1 mm/s."""


@examples(40)
@given(recorded(), st.integers(0), st.integers(1, 5))
@example(GRAZING, 0, 2)
def test_a_record_may_be_cut_anywhere(
    case: tuple[vi.Oscillator, vi.Record, vi.State], where: int, parts: int
) -> None:
    """At a sample, or within a line: there the record has samples once it is made finer."""
    rig, record, start = case
    whole, rounding = tame_record(rig, record, start)
    count = (len(record.acceleration) - 1) * parts
    assume(count > 1)
    step = record.step / parts
    fine = np.interp(
        np.arange(count + 1) / parts, np.arange(count // parts + 1), record.acceleration
    )
    at = 1 + where % (count - 1)
    first = vi.simulate(vi.Rig(rig, vi.Record(fine[: at + 1], step)), start=start, samples=0)
    rest = vi.simulate(
        vi.Rig(rig, vi.Record(fine[at:], step)), start=first, samples=0, tail=2.5 * record.step
    )
    assert distance(whole, signed_parts(rest["final_state"].values)) < rounding


@examples(40)
@given(recorded())
def test_the_mirrored_record(case: tuple[vi.Oscillator, vi.Record, vi.State]) -> None:
    rig, record, start = case
    data, rounding = tame_record(rig, record, start)
    turned = vi.Record(-record.acceleration, record.step)
    back = vi.State(-start.displacement, -start.velocity)
    image = states(through(rig.mirrored(), turned, back))
    assert distance(data, -image[[0, 1, 3, 2]]) < rounding
