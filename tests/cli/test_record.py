"""``vibroimpact record`` from the words typed to the files written."""

from __future__ import annotations

import json

import numpy as np
import pytest

import vibroimpact as vi
from records.layouts import VALUES, csmip, peer

COMMAND = "record"


@pytest.fixture
def quake(tmp_path):
    (tmp_path / "quake.AT2").write_text("\n".join(peer()) + "\n")
    return "quake.AT2"


def test_summary_figure_and_data(run, tmp_path, quake):
    code, out, errors = run(quake, "--damping", "0,0.05", "--periods", "50")
    assert (code, errors) == (0, "")
    for words in (
        "PEER AT2, values in g",
        "Nowhere - Main Street",
        "10 × 10 ms",
        "34.3233 m/s² = 3.5 g",
        "at 0.03 s",
        "spectrum, ζ = 0.05",
    ):
        assert words in out
    assert {p.name for p in (tmp_path / "out").iterdir()} == {
        "quake-record.nc",
        "quake-record.png",
    }
    path = tmp_path / "out/quake-record.nc"
    data, spectrum = vi.load(path, "record"), vi.load(path, "spectrum")
    record = vi.Record.read(tmp_path / quake)
    np.testing.assert_array_equal(data["base_acceleration"], record.acceleration)
    assert data["base_acceleration"].attrs["units"] == "m s-2"
    about = json.loads(data.attrs["parameters"])["record"]
    assert (about["station"], about["component"]) == ("Nowhere - Main Street", "045")
    direct = vi.response_spectrum(record, np.geomspace(0.01, 10.0, 50), [0.0, 0.05])
    np.testing.assert_array_equal(spectrum["pseudo_acceleration"], direct["pseudo_acceleration"])


def test_changes_in_their_order_and_json(run, quake):
    code, out, _ = run(
        *(quake, "--unit", "m/s^2", "--step", "20ms", "--station", "elsewhere", "--label", "Z"),
        *("--start", "20ms", "--end", "0.1 s", "--baseline", "mean", "--peak", "0.2 g"),
        *("--periods", "20", "--json", "--name", "made", "--figure", "svg"),
    )
    assert code == 0
    facts = json.loads(out)
    assert facts["samples"] == 5
    assert facts["peak"] == pytest.approx(1.96133)
    assert (facts["station"], facts["component"]) == ("elsewhere", "Z")
    assert [" ".join(note.split(" ")[:2]) for note in facts["notes"]] == [
        "the step",
        "the unit",
        "cut to",
        "mean subtracted:",
        "scaled by",
    ]
    assert facts["files"] == {"data": "out/made-record.nc", "figure": "out/made-record.svg"}
    (largest,) = facts["largest"]
    assert largest["damping"] == 0.05


def test_a_study_takes_a_component(tmp_path, run):
    (tmp_path / "quake.V2").write_text("\n".join([*csmip(1, "90 DEG"), *csmip(2, "UP")]) + "\n")
    from pathlib import Path

    from vibroimpact.model.study import ExcitationTable

    shaking = ExcitationTable(record="quake.V2", component="up").shaking(Path(tmp_path))
    assert isinstance(shaking, vi.Record)
    assert shaking.about.component == "UP"
    np.testing.assert_allclose(shaking.acceleration, 0.01 * np.array(VALUES))


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["--damping", "0.05,1.2"], "damping: 1.2; pass damping ratios from 0 to less than 1"),
        (["--damping", "x"], "--damping: 'x' does not start with a number"),
        (["--periods", "1"], "--periods: 1; pass a whole number of at least 2"),
        (["--shortest", "0"], "--shortest: '0' is not greater than 0"),
        (
            ["--shortest", "2s", "--longest", "1s"],
            "--longest: 1s is not longer than --shortest, 2s; raise --longest",
        ),
        (["--unit", "kg"], "--unit: '1 kg' is a mass"),
        (["--step", "-1s"], "--step: '-1s' is not greater than 0"),
        (["--start", "99s"], "--start: '99s' is greater than"),
        (["--scale", "0"], "--scale: 0"),
        (["--scale", "2", "--peak", "1"], "--peak: '1' is given together"),
        (["--component", "east"], "--component: 'east' is not a component of 'quake.AT2'"),
    ],
)
def test_wrong_input_is_one_line_and_nothing_is_written(run, tmp_path, quake, words, line):
    code, out, errors = run(quake, *words)
    assert (code, out) == (2, "")
    assert errors.startswith("vibroimpact: error: ")
    assert errors.count("\n") == 1
    assert line.removeprefix("--") in errors
    assert [p.name for p in tmp_path.iterdir()] == [quake]


def test_a_file_that_is_missing(run):
    code, _, errors = run("nothing.AT2")
    assert code == 2
    assert "record: 'nothing.AT2' cannot be read (No such file" in errors
