"""Progress that a caller of Python asks for: in a notebook, on a terminal, nowhere else."""

from __future__ import annotations

import io
import sys

import numpy as np

import vibroimpact as vi
from vibroimpact.tasks.progress import shown_by_default

CASE = vi.laboratory.case("B2-G1-A3")


class Terminal(io.StringIO):
    def isatty(self):
        return True


class Notebook:
    """What a notebook's kernel offers: an area of the page that can be written anew."""

    kernel = object()

    def __init__(self):
        self.shown = []

    def display(self, data, *, raw, display_id):
        assert raw
        self.shown.append(data)
        return self

    def update(self, data, *, raw):
        assert raw
        self.shown.append(data)


def test_a_terminal_has_one_line_that_is_cleared_at_the_end(monkeypatch):
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    show = vi.progress_bar("sweep", every=0.0)
    show(1, 4)
    assert screen.getvalue().split("\r")[-1].startswith("sweep 1/4")
    show(4, 4)
    assert "4/4" in screen.getvalue()
    assert "\n" not in screen.getvalue()
    assert screen.getvalue().split("\r")[-1].strip() == ""


def test_by_default_a_terminal_shows_what_takes_longer_than_a_moment(monkeypatch):
    now, screen = [0.0], Terminal()
    monkeypatch.setattr("vibroimpact.tasks.progress.time.monotonic", lambda: now[0])
    monkeypatch.setattr(sys, "stderr", screen)
    show = shown_by_default("manifolds")
    show(1, 4)
    assert screen.getvalue() == ""
    now[0] = 3.0
    show(2, 4)
    assert "manifolds 2/4" in screen.getvalue()
    show(4, 4)
    assert screen.getvalue().split("\r")[-1].strip() == ""
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    assert shown_by_default("manifolds") is None
    monkeypatch.setattr("vibroimpact.tasks.progress._notebook", lambda: Notebook().display)
    assert shown_by_default("manifolds") is not None


def test_a_log_has_a_line_now_and_then_with_the_time_left(monkeypatch, capsys):
    now = [1000.0]
    monkeypatch.setattr("vibroimpact.tasks.progress.time.monotonic", lambda: now[0])
    show = vi.progress_bar("map")
    for done in range(1, 81):
        now[0] += 1.0
        show(done, 100)
    assert capsys.readouterr().err == (
        "vibroimpact: map 30/100, 30 s, about 70 s left\n"
        "vibroimpact: map 60/100, 60 s, about 40 s left\n"
    )
    for done in range(1, 31):  # the next job begins anew
        now[0] += 60.0
        show(done, 1000)
    *_, last = capsys.readouterr().err.splitlines()
    assert last == "vibroimpact: map 30/1000, 29 min, about 15.6 h left"


def test_a_terminal_says_how_long_it_will_take(monkeypatch):
    now = [0.0]
    monkeypatch.setattr("vibroimpact.tasks.progress.time.monotonic", lambda: now[0])
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    show = vi.progress_bar("sweep")
    show(0, 100)
    now[0] = 10.0
    show(25, 100)
    assert "sweep 25/100, 10 s, about 30 s left [######" in screen.getvalue()


def test_without_standard_error_nothing_is_printed(monkeypatch, capsys):
    monkeypatch.setattr(sys, "stderr", None)
    show = vi.progress_bar("sweep", every=0.0)
    show(1, 4)
    show(4, 4)
    assert capsys.readouterr().out == ""


def test_a_notebook_has_one_line_that_stays(monkeypatch):
    page = Notebook()
    monkeypatch.setattr("vibroimpact.tasks.progress._notebook", lambda: page.display)
    show = vi.progress_bar("sweep", every=0.0)
    show(1, 4)
    show(4, 4)
    first, *_, last = page.shown
    assert '<progress value="1" max="4">' in first["text/html"]
    assert first["text/plain"].startswith("sweep 1/4")
    assert "<progress" not in last["text/html"]
    assert last["text/plain"].startswith("sweep 4/4")


def test_it_writes_seldom(monkeypatch):
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    show = vi.progress_bar("sweep", every=1e9)
    for done in range(100):
        show(done, 100)
    assert screen.getvalue().count("\r") == 1


def test_elsewhere_nothing_is_written(monkeypatch):
    pipe = io.StringIO()
    monkeypatch.setattr(sys, "stderr", pipe)
    show = vi.progress_bar("sweep", every=0.0)
    show(1, 4)
    show(4, 4)
    assert pipe.getvalue() == ""


def test_where_the_end_is_not_known_it_counts(monkeypatch):
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    show = vi.progress_bar("branch", every=0.0)
    show(7, None)
    assert screen.getvalue().startswith("\rbranch 7, 0 s")
    page = Notebook()
    monkeypatch.setattr("vibroimpact.tasks.progress._notebook", lambda: page.display)
    vi.progress_bar("branch", every=0.0)(7, None)
    assert page.shown[0]["text/html"].startswith("<progress></progress> branch 7")


def counted_and_ended(counts):
    *before, (done, total) = counts
    assert before == [(i, None) for i in range(1, len(before) + 1)]
    assert done == total > 5


def test_all_functions_tell_the_same(monkeypatch):
    counts: list[tuple[int, int | None]] = []

    def note(done, total):
        counts.append((done, total))

    shaken = vi.Harmonic(CASE.amplitude, 2.0)
    diagram = vi.resonance_diagram(
        vi.Rig(CASE.oscillator, CASE.amplitude), {"frequency": (1.0, 3.0)}, progress=note
    )
    assert all(isinstance(total, int) for _, total in counts)
    assert len(counts) >= diagram.sizes["point"] / 2  # at each point: one branch may take minutes
    assert counts[-1][0] == counts[-1][1]
    counts.clear()
    vi.branch(vi.Rig(CASE.oscillator, shaken), vary={"gap": (7e-3, 8e-3)}, progress=note)
    counted_and_ended(counts)
    counts.clear()
    fold = diagram.isel(bifurcation=0)
    vi.bifurcation_curve(
        vi.Rig(CASE.oscillator, shaken),
        fold,
        vary={"frequency": (1.0, 4.0), "gap": (7e-3, 8e-3)},
        progress=note,
    )
    counted_and_ended(counts)


def test_functions_that_take_long_take_it(monkeypatch):
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    vi.sweep(CASE, frequencies=np.arange(2.0, 3.0, 0.1), progress=vi.progress_bar("sweep"))
    assert "sweep" in screen.getvalue()
