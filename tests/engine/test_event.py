"""An event is a kind and a stop, whatever both are."""

from __future__ import annotations

import pytest

from vibroimpact.engine import event as events
from vibroimpact.engine.assembly.layout import MOST_STOPS

KINDS = {name: value for name, value in vars(events).items() if name.isupper() and name[0] != "_"}


def test_kinds_are_told_apart() -> None:
    assert sorted(KINDS.values()) == list(range(len(KINDS)))


def test_a_kind_without_a_stop_is_the_event_itself() -> None:
    for kind in KINDS.values():
        assert events.event_of(kind, 0) == kind


@pytest.mark.parametrize("kind", list(KINDS.values()))
@pytest.mark.parametrize("stop", [0, 1, 2, MOST_STOPS - 1])
def test_kind_and_stop_are_found_again(kind: int, stop: int) -> None:
    event = events.event_of(kind, stop)
    assert int(float(event)) == event
    assert (events.kind_of(event), events.stop_of(event)) == (kind, stop)
    of_a_stop = {"CONTACT", "IMPACT", "DETACHMENT", "REST_ENDS"}
    assert events.at_stop(event) == (kind in {KINDS[name] for name in of_a_stop})
    assert events.begins_contact(event) == (kind in {events.CONTACT, events.IMPACT})
