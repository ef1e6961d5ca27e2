"""Where tasks are done is told by a word, a client or an address; all else is refused."""

from __future__ import annotations

import re

import pytest

import vibroimpact as vi
from vibroimpact.tasks.executors import workers_for
from vibroimpact.tasks.processes import Processes


def test_words():
    assert workers_for(None) is None
    assert workers_for(3, "threads") == 3
    assert workers_for(3, "processes") == Processes(3)
    assert workers_for(None, "processes").width() >= 1


@pytest.mark.parametrize("where", ["threads", "processes"])
def test_their_number_is_whole(where):
    with pytest.raises(vi.InputError, match="threads: 0; pass a whole number"):
        workers_for(0, where)


ACCEPTED = "'threads', 'processes', a dask Client, or the address of a scheduler"


@pytest.mark.parametrize(
    ("where", "said"),
    [
        ("treads", f"where: 'treads' is unknown; pass {ACCEPTED}"),
        (3, f"where: 3 is unknown; pass {ACCEPTED}"),
        ("tcp://127.0.0.1:9", "where: no scheduler answers at tcp://127.0.0.1:9"),
    ],
)
def test_anything_else_is_refused(where, said, monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr("vibroimpact.tasks.executors._PATIENCE", "1s")
    with pytest.raises(vi.InputError, match=re.escape(said)):
        workers_for(None, where)


def test_a_daemon_starts_no_processes(monkeypatch):
    monkeypatch.setattr("vibroimpact.tasks.executors.may_start", lambda: False)
    with pytest.raises(vi.InputError, match="may not start others"):
        workers_for(2, "processes")
