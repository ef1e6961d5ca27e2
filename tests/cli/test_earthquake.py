"""``vibroimpact earthquake`` from the words typed to the files written."""

from __future__ import annotations

import json

import numpy as np
import pytest

import vibroimpact as vi
from earthquakes.rigs import noise
from vibroimpact.cli.records import record_stems

COMMAND = "earthquake"


@pytest.fixture
def quake(tmp_path):
    record = noise(8, count=200)
    rows = [f"{t:.2f},{a:.9g}" for t, a in zip(record.time, record.acceleration, strict=True)]
    (tmp_path / "quake.csv").write_text("\n".join(["Time (s),North (m/s^2)", *rows]) + "\n")
    return "quake.csv"


def test_words_figure_and_data(run, tmp_path, quake):
    code, out, errors = run("B2-G1-A3", quake, "--scale", "0.3")
    assert (code, errors) == (0, "")
    stem = "B2-G1-A3-quake-earthquake"
    assert {p.name for p in (tmp_path / "out").iterdir()} == {
        f"{stem}.nc",
        f"{stem}.png",
        "B2-G1-A3-earthquake.csv",
    }
    record = vi.Record.read(tmp_path / quake).scaled(0.3)
    direct = vi.seismic_response(vi.Rig(vi.laboratory.case("B2-G1-A3").oscillator, record))
    counts = [int(direct["impact_count"].sel(stop=side)) for side in ("right", "left")]
    assert min(counts) > 1
    assert f"{counts[0]} right, {counts[1]} left" in out
    assert "The mass hits the right stop" in out
    free = "times the acceleration without stops. Without stops, it would move"
    assert free in " ".join(out.split())
    path = tmp_path / f"out/{stem}.nc"
    held = vi.load(path, "response")
    for name in direct.data_vars:
        np.testing.assert_array_equal(held[name], direct[name])
    floor = vi.floor_record(vi.load(path, "motion"))
    periods = vi.load(path, "floor")["natural_period"].values
    np.testing.assert_array_equal(
        vi.response_spectrum(floor, periods)["spectral_acceleration"],
        vi.load(path, "floor")["spectral_acceleration"],
    )
    head, row = (tmp_path / "out/B2-G1-A3-earthquake.csv").read_text().splitlines()
    values = dict(zip(head.split(","), row.split(","), strict=True))
    assert values["record"] == "quake.csv"
    for stop in ("right", "left"):
        force = float(direct["peak_force"].sel(stop=stop))
        assert float(values[f"peak_force.{stop} (N)"]) == force


def test_file_names_leave_out_suffixes_that_distinguish_nothing():
    names = ["a.csv", "A.txt", "b.AT2 90", "c.V2", "d.5", "e.HNE", "f-2.txt"]
    stems = ["a.csv", "A.txt", "b_90", "c.V2", "d.5", "e.HNE", "f-2"]
    assert record_stems(names) == dict(zip(names, stems, strict=True))


@pytest.mark.full
def test_several_records_options_and_json(run, tmp_path, quake):
    (tmp_path / "weak.csv").write_text((tmp_path / quake).read_text())
    code, out, _ = run(
        *("B2-G1-A3", quake, "weak.csv", "--peak", "0.01 g", "--tail", "3 s", "--gap", "40mm"),
        *("--json", "--name", "made", "--figure", "svg", "--samples", "1"),
    )
    assert code == 0
    facts = json.loads(out)
    assert [one["name"] for one in facts["records"]] == ["quake.csv", "weak.csv"]
    for one in facts["records"]:
        assert not any(one["impact_count"].values())
        assert one["verdict"].startswith("The mass hits no stop: ")
        assert one["status"] == "done"
        assert one["without_stops"]["peak_acceleration"] == one["peak_acceleration"]
    assert facts["oscillator"]["right"]["gap"] == 0.04
    assert facts["files"]["table"] == "out/made-earthquake.csv"
    for path in facts["files"].values():
        assert (tmp_path / path).is_file()


@pytest.mark.full
def test_each_record_of_a_suite_has_its_own_component_and_scale(run, tmp_path, quake):
    head, *rows = (tmp_path / quake).read_text().splitlines()
    both = [f"{row},{2.0 * float(row.split(',')[1]):.9g}" for row in rows]
    (tmp_path / "two.csv").write_text("\n".join([f"{head},East (m/s^2)", *both]) + "\n")
    words = ("B2-G1-A3", "two.csv", "two.csv", "--component", "North,East", "--json")
    code, out, errors = run(*words, "--scale", "0.2, 0.3")
    assert (code, errors) == (0, "")
    first, second = json.loads(out)["records"]
    assert (first["name"], second["name"]) == ("two.csv North", "two.csv East")
    for one, name, scale in ((first, "North", 0.2), (second, "East", 0.3)):
        record = vi.Record.read(tmp_path / "two.csv", name).scaled(scale)
        direct = vi.seismic_response(vi.Rig(vi.laboratory.case("B2-G1-A3").oscillator, record))
        assert one["displacement_max"] == float(direct["displacement_max"])
    code, out, _ = run(*words, "--peak", "0.02g,0.01g")
    peaks = [one["record"]["peak"] for one in json.loads(out)["records"]]
    assert peaks == ["0.02 g", "0.01 g"]
    for option, value in (("--scale", "1,2,3"), ("--peak", "1,2,3"), ("--component", "1,2,3")):
        arguments = [*words[:4], value] if option == "--component" else [*words, option, value]
        assert run(*arguments)[::2] == (
            2,
            f"vibroimpact: error: {option}: '1,2,3' has 3 values for 2 records; pass one value for "
            "all records, or 2 values\n",
        )


def test_two_files_of_one_name_are_refused(run, tmp_path, quake):
    (tmp_path / "b").mkdir()
    (tmp_path / "b" / quake).write_text((tmp_path / quake).read_text())
    code, out, errors = run("B2-G1-A3", quake, f"b/{quake}")
    assert (code, out) == (2, "")
    assert errors.startswith(f"vibroimpact: error: RECORD: 'b/{quake}' has the same file name as")


@pytest.mark.full
def test_what_is_said_in_place_of_a_file_is_told(run, tmp_path):
    head = ["PEER", "Made, 2000", "ACCELERATION TIME SERIES IN UNITS OF G"]
    values = [f"{0.01 * (i % 3 - 1):.7E}" for i in range(50)]
    lines = [*head, "NPTS=  50, DT=  .0100 SEC", *values]
    (tmp_path / "made.AT2").write_text("\n".join(lines) + "\n")
    code, _, errors = run("B2-G1-A3", "made.AT2", "--step", "33ms", "--unit", "cm/s^2")
    assert code == 0
    noted = (
        "the step 33 ms replaces the step in the file, 0.01 s; the unit cm/s^2 replaces the unit "
        "in the file, g; the peak is "
    )
    assert errors.startswith(f"vibroimpact: warning: record 'made.AT2': {noted}")
    assert errors.count("\n") == 1
    (tmp_path / "bare.csv").write_text("\n".join(f"{i % 3 - 1}" for i in range(50)) + "\n")
    code, _, errors = run("B2-G1-A3", "bare.csv", "--step", "10ms", "--unit", "m/s^2")
    assert (code, errors) == (0, "")


def test_a_unit_that_is_stated_nowhere_is_asked_for(run, tmp_path):
    (tmp_path / "bare.csv").write_text("\n".join(f"{i % 3 - 1}" for i in range(50)) + "\n")
    (tmp_path / "rig.toml").write_text(
        '[oscillator]\nmass = "550 kg"\nisolator = { stiffness = "26 kN/m", damping = 1000 }\n'
        '[excitation]\nrecord = "bare.csv"\nstep = "10 ms"\n'
    )
    for words in (["B2-G1-A3", "bare.csv", "--step", "10ms"], ["rig.toml"]):
        code, out, errors = run(*words)
        assert (code, out) == (2, "")
        assert "unit: missing, because 'bare.csv' states no unit of its values" in errors
        assert errors.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["--scale", "0"], "scale: 0"),
        (["--scale", "2", "--peak", "1"], "peak: '1' is given together"),
        (["--tail", "-1s"], "--tail: '-1s' is less than 0"),
        (["--samples", "0"], "--samples: 0; pass a whole number of at least 1"),
        (["--amplitude", "0.1g"], "--amplitude: '0.1g', but a record shakes this rig"),
        (["--component", "Up"], "component: 'Up' is not a component of 'quake.csv'"),
        (["nothing.AT2"], "record: 'nothing.AT2' cannot be read"),
    ],
)
def test_wrong_input_is_one_line_and_nothing_is_written(refused, quake, words, line):
    assert line in refused("B2-G1-A3", quake, *words)


@pytest.mark.full
def test_a_residual_that_nothing_damps_is_not_called_settled(run, tmp_path, quake):
    study = """
[oscillator]
mass = 1.0
[oscillator.isolator]
stiffness = 40.0
damping = %s
"""
    for damping, expected in ((0.0, True), (1.0, False)):
        (tmp_path / "rig.toml").write_text(study % damping)
        code, out, _ = run("rig.toml", quake)
        assert code == 0
        assert ("not settled: the isolator has no damping" in " ".join(out.split())) == expected
