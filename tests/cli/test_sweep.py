"""``vibroimpact sweep`` from the words typed to the files written."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.cli import output

COMMAND = "sweep"

COARSE = ["--step", "0.1Hz"]


def test_summary_and_files(run, tmp_path):
    code, out, errors = run("B2-G1-A3", "--parameters", "identified")
    assert code == 0
    assert "error" not in errors
    assert "K = 26.8 kN/m" in out
    assert "K = 510 kN/m, C = 0.9 kN s/m, gap 7.5 mm" in out
    lines = [" ".join(line.split()) for line in out.splitlines()]
    assert any(line.startswith("forward downward 2.65 and 2.66") for line in lines)
    assert any(line.startswith("backward upward 1.68 and 1.67") for line in lines)
    assert any(line.startswith("η_a forward secondary 0.57") for line in lines)
    assert "1.68 to 2.65 Hz: right (forward curve above backward curve)" in lines
    files = {p.name for p in (tmp_path / "out").iterdir()}
    assert files == {f"B2-G1-A3-identified-sweep.{ending}" for ending in ("nc", "png", "txt")}
    for name in files:
        assert f"out/{name}" in out
    written = (tmp_path / "out/B2-G1-A3-identified-sweep.txt").read_text(encoding="utf-8")
    assert [line.rstrip() for line in out.splitlines()][: len(written.splitlines())] == (
        written.splitlines()
    )
    data = vi.load(tmp_path / "out/B2-G1-A3-identified-sweep.nc")
    case = vi.laboratory.case("B2-G1-A3", "identified")
    direct = vi.sweep(vi.Rig(case.oscillator, case.amplitude), data["frequency"].values)
    np.testing.assert_array_equal(data["eta_a"], direct["eta_a"])
    assert data.attrs["title"] == "B2-G1-A3, identified parameters"


def test_json_and_nothing_else(run, tmp_path):
    code, out, _ = run("B2-G1-A3", *COARSE, "--json", "-o", "deep/folder")
    assert code == 0
    facts = json.loads(out)
    assert facts["oscillator"]["isolator"]["stiffness"] == 26290.0
    assert facts["frequencies"] == {"from": 0.5, "to": 5.0, "count": 46}
    assert facts["dimensionless"]["right"]["stiffness_ratio"] == pytest.approx(19.4, abs=0.05)
    down = next(j for j in facts["jumps"] if j["direction"] == "forward")
    assert (down["upward"], down["after"] - down["before"]) == (False, pytest.approx(0.1))
    assert [h["side"] for h in facts["hysteresis"]] == ["right"]
    for path in facts["files"].values():
        assert (tmp_path / path).is_file()


def test_left_hysteresis_and_advice(run):
    words = ("B3-10mm-A3", "--from", "0.6Hz", "--to", "1.2Hz", "--step", "0.01Hz")
    _, out, _ = run(*words)
    assert "0.68 to 0.72 Hz: left (backward curve above forward curve)" in out
    assert "Motion not settled\n" in out
    assert "raise --max-cycles" in out
    assert "Advice: " in out


@pytest.mark.parametrize("code", ["B2-Ginf-A3", "B3-0mm-A3"])
def test_smooth_rigs(run, code):
    status, out, _ = run(code, *COARSE)
    assert status == 0
    assert "Jumps: none" in out
    assert "Hysteresis: none" in out


def test_one_direction(run):
    code, out, _ = run("B2-G1-A3", *COARSE, "--direction", "backward")
    assert code == 0
    assert "Hysteresis: not computed" in out
    assert "forward" not in out


def test_listed_frequencies_are_held_as_they_are(run, tmp_path):
    run("B2-G1-A3", "--frequencies", "0.5Hz, 700 mHz,1.1")
    data = vi.load(tmp_path / "out/B2-G1-A3-sweep.nc")
    assert data["frequency"].values.tolist() == [0.5, 0.7, 1.1]


def test_options_reach_the_sweep(run, tmp_path):
    options = (
        "--max-cycles",
        "60",
        "--tolerance",
        "1e-8",
        "--threads",
        "1",
        "--set",
        "mass=600 kg",
    )
    rest = (
        "--set",
        "left.gap=9mm",
        "--set",
        "right=none",
        "--name",
        "one sided",
        "--figure",
        "svg",
    )
    code, _, _ = run("B2-G1-A3", *COARSE, *options, *rest)
    assert code == 0
    svg = (tmp_path / "out/one_sided-sweep.svg").read_text()
    assert "B2-G1-A3, mass 600 kg" in svg
    assert "one sided" not in svg
    parameters = json.loads(vi.load(tmp_path / "out/one_sided-sweep.nc").attrs["parameters"])
    assert (parameters["max_cycles"], parameters["tolerance"]) == (60, 1e-8)
    oscillator = parameters["rigs"][0]["oscillator"]
    assert (oscillator["mass"], oscillator["right"]) == (600.0, None)
    assert oscillator["left"]["gap"] == 9e-3


def test_study(run, tmp_path):
    (tmp_path / "wall.toml").write_text(
        'case = "B2-G1-A3"\n[excitation]\nphase = "90 deg"\n'
        '[sweep]\nfrequencies = ["1 Hz", "2 Hz"]\ndirection = "forward"\nmax_cycles = 70\n'
    )
    code, _, _ = run("wall.toml")
    assert code == 0
    data = vi.load(tmp_path / "out/wall-sweep.nc")
    assert data["direction"].values.tolist() == ["forward"]
    parameters = json.loads(data.attrs["parameters"])
    assert parameters["phase"] == pytest.approx(np.pi / 2)
    assert parameters["max_cycles"] == 70


def test_no_bar_where_nobody_sees_it(monkeypatch, capsys):
    with output.progress_bar("sweeping") as progress:
        progress(1, 2)
    assert capsys.readouterr().err == ""
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    with output.progress_bar("sweeping") as progress:
        progress(1, 2)


WRONG = [
    (["--set", "mass=-5kg"], "--set: mass"),
    (["--set", "isolator.stiffness=-1"], "--set: isolator.stiffness"),
    (["--set", "stops.stiffness=nan"], "--set: right.stiffness"),
    (["--gap", "15 kg"], "'15 kg' is a mass"),
    (["--gap", "nan"], "--gap"),
    (["--amplitude", "0.05 kg"], "is a mass"),
    (["--from", "0Hz"], "--from"),
    (["--from", "3Hz", "--to", "2Hz"], "--from"),
    (["--step", "-0.1Hz"], "--step"),
    (["--frequencies", "1Hz,0.5Hz"], "frequencies[1]"),
    (["--frequencies", "1Hz,1Hz"], "frequencies[1]"),
    (["--frequencies", "1Hz,0Hz"], "frequencies[1]"),
    (["--frequencies", ""], "empty"),
    (["--frequencies", "1Hz", "--step", "1Hz"], "--step"),
    (["--direction", "up"], "direction"),
    (["--parameters", "guessed"], "parameters"),
    (["--tolerance", "2"], "tolerance"),
    (["--tolerance", "nan"], "tolerance"),
    (["--max-cycles", "0"], "--max-cycles"),
    (["--max-cycles", "1.5"], "--max-cycles"),
    (["--threads", "-1"], "threads"),
    (["--threads", "many"], "--threads"),
    (["--threads", "1e400"], "--threads"),
    (["--figure", "bmp"], "--figure"),
    (["--gap"], "--gap"),
    (["--gup", "1mm"], "--gup"),
    (["more"], "more"),
    (["--set", "right=none", "--set", "right.gap=1mm"], "--set: right.gap"),
    (
        [
            "--set",
            "isolator.damping=0",
            "--set",
            "right=none",
            "--set",
            "left=none",
            "--frequencies",
            "1Hz,1.1003621Hz",
        ],
        None,
    ),
]


@pytest.mark.parametrize(("words", "named"), WRONG)
def test_wrong_input_is_one_line_and_exit_2_and_nothing_written(refused, words, named):
    if named is None:
        # Undamped resonance of a mass that nothing stops, found only in the sweep itself.
        f0 = vi.laboratory.case("B2-G1-A3").oscillator.natural_frequency
        words, named = [*words[:-1], f"1,{f0!r}"], "natural frequency"
    assert named in refused("B2-G1-A3", *words)


@pytest.mark.parametrize("case", ["B9-G1-A3", "B2-G1", "nonsense", "B2-G1-9kg", "none.toml", ""])
def test_unknown_rig(run, tmp_path, case):
    code, _, errors = run(case)
    assert code == 2
    assert errors.startswith("vibroimpact: error: ")
    assert errors.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("folder", ["file", "file/below", "/proc/vibroimpact/out"])
def test_folder_that_cannot_be_written_to(run, tmp_path, monkeypatch, folder):
    (tmp_path / "file").write_text("mine")

    def never(*_, **__):
        raise AssertionError("computed before the folder was tried")

    monkeypatch.setattr("vibroimpact.response.sweep.sweeps", never)
    code, _, errors = run("B2-G1-A3", "--output", folder)
    assert code == 2
    assert errors.startswith("vibroimpact: error: --output: ")
    assert errors.count("\n") == 1
    assert [p.name for p in tmp_path.iterdir()] == ["file"]
    assert (tmp_path / "file").read_text() == "mine"


def test_interrupted(run, tmp_path, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("vibroimpact.response.sweep.sweeps", interrupted)
    code, out, errors = run("B2-G1-A3")
    assert (code, out, errors) == (130, "", "vibroimpact: interrupted\n")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.full
def test_own_outputs_are_computed_printed_and_drawn(run, tmp_path):
    power = "power [W] = mean(isolator.damping*velocity**2)"
    words = ("B2-G1-A3", "--frequencies", "1.5Hz,2Hz", "--compute", power)
    code, out, errors = run(*words, "--compute", "touch=mean(abs(contact) > 0)")
    assert (code, errors) == (0, "")
    assert re.search(r"^power +9\.\d+ W +at 2 Hz", out, re.M)
    data = vi.load(tmp_path / "out/B2-G1-A3-sweep.nc")
    assert data["power"].attrs["units"] == "W"
    assert data["touch"].attrs["output"] == "mean(abs(contact) > 0)"
    for formula, message in (
        ("power", "--compute: 'power' is not a name with a formula"),
        ("power=velocity", "--compute['power']: 'velocity' is a time history"),
        ("power=max(velocty)", "--compute['power']: 'velocty' is neither"),
    ):
        code, _, errors = run("B2-G1-A3", "--frequencies", "2Hz", "--compute", formula)
        assert code == 2
        assert message in errors
    code, _, errors = run(*words, "--compute", power)
    assert (code, "'power' is given twice" in errors) == (2, True)
