"""``vibroimpact simulate`` from the words typed to the files written."""

from __future__ import annotations

import functools
import json

import numpy as np
import pytest

import vibroimpact as vi

COMMAND = "simulate"


def test_summary_and_files(run, tmp_path):
    code, out, _ = run("B2-G1-A3", "--frequency", "0.58Hz")
    assert code == 0
    assert "State after 100 cycles" in out
    assert "Contacts per cycle, over the last 10: 1 right, 1 left" in out
    stem = "B2-G1-A3-0.58Hz-history"
    assert {p.name for p in (tmp_path / "out").iterdir()} == {f"{stem}.nc", f"{stem}.png"}
    data = vi.load(tmp_path / f"out/{stem}.nc")
    case = vi.laboratory.case("B2-G1-A3")
    direct = vi.simulate(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 0.58)), 100)
    np.testing.assert_array_equal(data["displacement"], direct["displacement"])
    np.testing.assert_array_equal(data["event_time"], direct["event_time"])


def test_json_and_options(run, tmp_path):
    code, out, _ = run(
        *("B2-G1-A3", "--frequency", "2.5 Hz", "--cycles", "300", "--samples", "16"),
        *("--displacement", "5mm", "--velocity", "-50 mm/s", "--shown", "2", "--json"),
    )
    assert code == 0
    facts = json.loads(out)
    case = vi.laboratory.case("B2-G1-A3")
    data = vi.simulate(
        vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 2.5)), 300, vi.State(5e-3, -0.05), 16
    )
    assert facts["final_state"]["displacement"] == float(data["final_state"][0])
    assert facts["cycles"] == 300.0
    assert facts["status"] == "done"
    for path in facts["files"].values():
        assert (tmp_path / path).is_file()


def test_a_motion_that_is_given_up_is_said_to_be(run, monkeypatch):
    # The limit of events cannot be reached by an ordinary rig: lower it.
    monkeypatch.setattr(vi, "simulate", functools.partial(vi.simulate, max_events=1))
    code, _, errors = run("B2-G1-A3", "--frequency", "0.58Hz")
    assert "max_events" in errors
    assert "Traceback" not in errors
    assert code in (0, 2)  # with what was found until then, if there is anything


@pytest.mark.parametrize(
    ("words", "named"),
    [
        ([], "--frequency: missing"),
        (["--frequency", "0Hz"], "--frequency"),
        (["--frequency", "-2Hz"], "--frequency"),
        (["--frequency", "2kg"], "is a mass"),
        (["--frequency", "2Hz", "--cycles", "0"], "--cycles"),
        (["--frequency", "2Hz", "--cycles", "nan"], "--cycles"),
        (["--frequency", "2Hz", "--cycles", "inf"], "--cycles"),
        (["--frequency", "2Hz", "--cycles", "1e9"], "--cycles"),
        (["--frequency", "2Hz", "--samples", "0"], "--samples"),
        (["--frequency", "2Hz", "--samples", "16.5"], "--samples"),
        (["--frequency", "2Hz", "--displacement", "5kg"], "--displacement"),
        (["--frequency", "2Hz", "--velocity", "5mm"], "--velocity"),
        (["--frequency", "2Hz", "--shown", "0"], "--shown"),
    ],
)
def test_wrong_input_is_one_line_and_exit_2_and_nothing_written(refused, words, named):
    assert named in refused("B2-G1-A3", *words)


@pytest.mark.full
def test_revolutions_per_minute_in_hertz_are_doubted(run):
    code, out, errors = run("B2-G1-A3", "--frequency", "600", "--cycles", "2")
    assert code == 0
    assert errors == (
        "vibroimpact: warning: --frequency: 600 Hz is 545 times the natural frequency of 1.1 Hz; "
        "is 600 rpm, 10 Hz, meant?\n"
    )
    # The summary has the two frequencies in one column.
    natural = next(line for line in out.splitlines() if "natural frequency 1.1 Hz" in line)
    forced = next(line for line in out.splitlines() if line.startswith("base "))
    assert forced.rstrip().endswith("at 600 Hz")
    assert forced.index("at 600 Hz") == natural.index("natural frequency")
    assert run("B2-G1-A3", "--frequency", "600 rpm", "--cycles", "2")[::2] == (0, "")
