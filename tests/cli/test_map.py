"""``vibroimpact map``."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray as xr

from samples import sample
from vibroimpact.cli.map import _axis

COMMAND = "map"
STEP = ("--step", sample("0.02", "0.04"))
WORDS = ("--vary", "stiffness_ratio=1:64:log:4", "--vary", "gap_ratio=0.2:1:3", *STEP)
NAME = "published-stiffness-ratio-gap-ratio-map"


def test_text_and_files(run, tmp_path):
    code, out, errors = run(*WORDS, "--refine", "1")
    assert (code, errors) == (0, "")
    assert "4 × 3 nodes, refined once: " in out
    assert "of 35 computed" in out
    assert "constant: τ = 0.01, ξ = 0.15" in out
    assert "primary resonance with right hysteresis" in out
    assert {p.name for p in (tmp_path / "out").iterdir()} == {
        f"{NAME}.zarr",
        f"{NAME}.png",
    }
    data = xr.open_zarr(tmp_path / f"out/{NAME}.zarr", consolidated=False)
    np.testing.assert_allclose(data["stiffness_ratio"], np.geomspace(1, 64, 7))
    np.testing.assert_allclose(data["gap_ratio"], np.linspace(0.2, 1, 5))


@pytest.mark.full
def test_json_and_again(run, tmp_path):
    first, again = (json.loads(run(*WORDS, "--refine", "0", "--json")[1]) for _ in range(2))
    assert (first.pop("replaced"), again.pop("replaced")) == ([], [first["files"]["figure"]])
    assert first == again
    assert (first["nodes"], first["computed"]) == (12, 12)
    assert sum(first["shares"].values()) == pytest.approx(1.0)
    data = xr.open_zarr(tmp_path / first["files"]["data"], consolidated=False)
    for name, share in first["shares"].items():
        number = data["scenario"].attrs["flag_meanings"].split().index(name)
        assert float((data["scenario"] == number).mean()) == pytest.approx(share)
    for point in first["border"]:
        assert 1.0 < point["stiffness_ratio"] < 4.0


def test_without_the_border(run):
    facts = json.loads(run(*WORDS, "--refine", "0", "--no-border", "--json")[1])
    assert facts["border"] == []


@pytest.mark.full
def test_physical_axes_of_a_case(run, tmp_path):
    words = ("--vary", "gap=5mm:15mm:3", "--vary", "proportional_stiffness=100kN/m:1MN/m:log:3")
    code, out, _ = run("B2-G1-A3", *words, "--refine", "0", *STEP, "--json")
    assert code == 0
    data = xr.open_zarr(tmp_path / json.loads(out)["files"]["data"], consolidated=False)
    np.testing.assert_allclose(data["gap"], [0.005, 0.01, 0.015])
    np.testing.assert_allclose(data["proportional_stiffness"], [1e5, 10**5.5, 1e6])


def test_an_amplitude_has_the_unit_of_what_shakes_the_rig(run, tmp_path):
    (tmp_path / "moved.toml").write_text(
        'case = "B2-G1-A3"\n[excitation]\namplitude = "5 mm"\n', encoding="utf-8"
    )
    words = ("--vary", "amplitude=2mm:4mm:2", "--vary", "damping_ratio=0.15:0.2:2", *STEP)
    code, out, _ = run("moved", *words, "--refine", "0", "--no-border")
    assert code == 0
    assert "constant: gap 7.5 mm, bumpers 510 kN/m, τ = 0.01" in out
    name = "moved-amplitude-damping-ratio-map.zarr"
    data = xr.open_zarr(tmp_path / "out" / name, consolidated=False)
    np.testing.assert_allclose(data["amplitude"], [2e-3, 4e-3])
    assert data["amplitude"].attrs["units"] == "m"
    code, out, errors = run("moved", "--vary", "amplitude=0.1g:0.2g", "--refine", "0")
    assert (code, out) == (2, "")
    assert errors.startswith("vibroimpact: error: --vary: amplitude: '0.1g' is a mass; a length")
    assert errors.count("\n") == 1


@pytest.mark.full
def test_a_command_that_was_killed_goes_on(tmp_path, told):
    program = "import sys; from vibroimpact.cli import main; sys.exit(main(sys.argv[1:]))"
    asked = (*WORDS, "--refine", sample("2", "1"), "--no-border")
    words = [sys.executable, "-c", program, "map", *asked, "-o", "killed"]
    child = subprocess.Popen(words, cwd=tmp_path, stdout=subprocess.DEVNULL)
    waited = time.monotonic()
    while child.poll() is None and time.monotonic() - waited < 600.0:
        if (tmp_path / f"killed/{NAME}.zarr").exists():
            time.sleep(0.3)
            os.kill(child.pid, signal.SIGKILL)
            break
        time.sleep(0.01)
    assert child.wait() == -signal.SIGKILL
    folder = tmp_path / "whole"
    folder.mkdir()
    again = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True)
    assert again.returncode == 0, again.stderr
    whole = json.loads(told(folder, *asked, "--json")[1])
    first = xr.open_zarr(tmp_path / f"killed/{NAME}.zarr", consolidated=False).load()
    second = xr.open_zarr(folder / whole["files"]["data"], consolidated=False).load()
    xr.testing.assert_identical(first, second)


@pytest.mark.full
def test_another_map_in_the_same_place_is_refused(run):
    assert run(*WORDS, "--refine", "0")[0] == 0
    code, out, errors = run(*WORDS, "--refine", "1")
    assert (code, out) == (2, "")
    assert "--output: " in errors
    assert "contains a map with other values of refine" in errors
    assert run(*WORDS, "--refine", "1", "--name", "finer")[0] == 0


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0:1:3", [0.0, 0.5, 1.0]),
        ("0.01:1:log:3", [0.01, 0.1, 1.0]),
        ("0.1:0.2", np.linspace(0.1, 0.2, 21)),
    ],
)
def test_ranges(text, expected):
    name, values, spacing = _axis("gap-ratio", text, "acceleration")
    assert (name, spacing) == ("gap_ratio", "log" if "log" in text else "linear")
    np.testing.assert_allclose(values, expected, rtol=1e-12)


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (
            ["--vary", "gip=0:1"],
            "--vary: 'gip' is not an axis of a map; pass one of gap, amplitude, stops.stiffness",
        ),
        (
            ["--vary", "gap=0:1", "--vary", "gap_ratio=0:1"],
            "'gap_ratio' varies the same quantity as 'gap'",
        ),
        (["--vary", "gap=0:1"], "--vary: a map has two axes; pass the option twice"),
        (["--vary", "gap=0:1", "--vary", "gap=0:1"], "--vary: 'gap' is given twice"),
        (
            ["--vary", "stiffness_ratio=1", "--vary", "gap_ratio=0:1"],
            "--vary: stiffness_ratio: '1' is not a range; pass LOW:HIGH[:log][:NUMBER], such as",
        ),
        (
            ["--vary", "stiffness_ratio=1:2:lag", "--vary", "gap_ratio=0:1"],
            "--vary: stiffness_ratio: the number of values, 'lag', is not a whole number",
        ),
        (
            ["--vary", "stiffness_ratio=1:2:1", "--vary", "gap_ratio=0:1"],
            "--vary: stiffness_ratio: the number of values, '1', is not a whole number",
        ),
        (
            ["--vary", "stiffness_ratio=1:2:²", "--vary", "gap_ratio=0:1"],
            "--vary: stiffness_ratio: the number of values, '²', is not a whole number",
        ),
        (
            ["--vary", "stiffness_ratio=2:1", "--vary", "gap_ratio=0:1"],
            "--vary: stiffness_ratio: the lower end of the range, 2, is not below the upper end, 1",
        ),
        (["--vary", "stiffness_ratio=0:1", "--vary", "gap_ratio=0:1"], "--vary: stiffness_ratio"),
        (
            ["--vary", "damping_ratio=0.1:0.9", "--vary", "gap_ratio=0:1"],
            "at a damping ratio of 0.9",
        ),
        (
            ["--vary", "stiffness_ratio=1:2", "--vary", "gap_ratio=0:1", "--refine", "-1"],
            "--refine: -1",
        ),
        (
            ["--vary", "stiffness_ratio=1:2:999999", "--vary", "gap_ratio=0:1", "--refine", "4"],
            "more than the maximum of",
        ),
        (["--vary", "stiffness_ratio=1:2", "--vary", "gap_ratio=0:1", "--step", "0"], "--step"),
        (
            ["--vary", "stiffness_ratio=1:2", "--vary", "gap_ratio=0:1", "--extent", "7"],
            "--extent: 7.0",
        ),
        (["B2-Ginf-A3"], "CASE|STUDY.toml: there is no stop"),
    ],
)
def test_wrong_input_is_one_line_and_exit_2_and_nothing_written(run, tmp_path, words, named):
    code, out, errors = run(*words)
    assert (code, out) == (2, "")
    assert errors.startswith("vibroimpact: error: ")
    assert errors.count("\n") == 1
    assert named in errors
    assert list(tmp_path.iterdir()) == []
