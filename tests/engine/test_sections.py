"""One loop follows motions through cycles and records: where it stops, it can go on."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

from vibroimpact.engine import flow
from vibroimpact.engine.flow_tables import plan_of
from vibroimpact.engine.jit import kernel
from vibroimpact.engine.parameters import free_rig
from vibroimpact.engine.sections import FULL, ROW, Schedule, loop
from vibroimpact.engine.status import DONE, NOT_FINITE, STOPPED, TOO_MANY_EVENTS

U, V, AGE = 2, 3, 7


class Diary(NamedTuple):
    """Numbers of the sections, the room for them, and the events that are reported."""

    notes: np.ndarray
    buffer: int
    events: int


@kernel
def _keep(plan, state, section, leg, diary):
    number, s, c, length, max_events = leg
    if number >= diary.buffer:
        return FULL
    diary.notes[number] = length
    flow.cycle(plan, state, s, c, length, max_events)
    return diary.events


follow = loop(_keep)


@kernel
def begun(plan, rig, amplitude, omega):
    for i in range(len(rig)):
        plan[i] = rig[i]
    flow.build(plan, amplitude, omega)


def followed(rows, first, last, state, *, changes=False, buffer=100, events=0, progress=None):
    """The section to go on with and the outcome; then the lengths that were followed."""
    plan = plan_of(free_rig(), ("motion",))
    begun(plan, free_rig(), 1.0, 2.0)
    table = np.array(rows, dtype=float).ravel()
    notes = np.full(100, np.nan)
    schedule = Schedule(table, len(table) // ROW, changes)
    diary = Diary(notes, buffer, events)
    number, outcome = follow(plan, state, schedule, first, float(last), 50, diary, progress)
    return number, outcome, notes


def rest() -> np.ndarray:
    return np.zeros(80)


CYCLE = [(0.0, 1.0, np.pi)]


def test_rows_begin_anew_and_the_last_section_may_be_incomplete() -> None:
    number, outcome, lengths = followed([(0.0, 1.0, 1.0), (1.0, 0.0, 2.0)], 0, 4.25, rest())
    assert (number, outcome) == (5, DONE)
    np.testing.assert_array_equal(lengths[:6], [1.0, 2.0, 1.0, 2.0, 0.25, np.nan])


def test_many_calls_are_one_to_the_last_bit() -> None:
    whole, parts = rest(), rest()
    followed(CYCLE, 0, 7.5, whole)
    for first, last in ((0, 3), (3, 4), (4, 7.5)):
        assert followed(CYCLE, first, last, parts)[1] == DONE
    assert whole[U] != 0.0
    np.testing.assert_array_equal(parts, whole)


def test_without_room_to_note_it_a_section_is_left_for_later() -> None:
    later, at_once = rest(), rest()
    assert followed(CYCLE, 0, 6, later, buffer=4)[:2] == (4, DONE)
    assert followed(CYCLE, 4, 6, later)[:2] == (6, DONE)
    followed(CYCLE, 0, 6, at_once)
    np.testing.assert_array_equal(later, at_once)


def test_a_motion_that_is_given_up_stays_at_its_section() -> None:
    state, before = rest(), rest()
    followed(CYCLE, 0, 1, state)
    followed(CYCLE, 0, 1, before)
    number, outcome, _ = followed(CYCLE, 1, 9, state, events=51)
    assert (number, outcome) == (2, TOO_MANY_EVENTS)
    np.testing.assert_array_equal(state[: AGE + 1], before[: AGE + 1])


def test_what_leaves_the_range_of_numbers_is_not_followed_on() -> None:
    state = rest()
    state[V] = np.nan
    assert followed(CYCLE, 0, 9, state)[:2] == (1, NOT_FINITE)


def test_it_stops_on_request() -> None:
    asked = np.array([0, 1], dtype=np.int64)
    assert followed(CYCLE, 0, 9, rest(), progress=asked)[:2] == (1, STOPPED)
    asked[1] = 0
    assert followed(CYCLE, 0, 9, rest(), progress=asked)[:2] == (9, DONE)


@pytest.mark.parametrize(("changes", "age"), [(False, 4.0 * np.pi), (True, np.pi)])
def test_where_the_forcing_changes_a_transient_begins(changes: bool, age: float) -> None:
    state = rest()
    followed(CYCLE, 0, 4, state, changes=changes)
    assert state[AGE] == pytest.approx(age)
