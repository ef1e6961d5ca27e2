"""``vibroimpact map``."""

from __future__ import annotations

import json

import numpy as np
import pytest
import xarray as xr

from samples import sample
from vibroimpact.cli.map import _NODES, _axis

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


def test_without_the_border(run):
    facts = json.loads(run(*WORDS, "--refine", "0", "--no-border", "--json")[1])
    assert facts["border"] == []


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
    assert errors.startswith(
        "vibroimpact: error: --vary: amplitude: '0.1g' is a mass; use a length"
    )
    assert errors.count("\n") == 1


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0:1:3", [0.0, 0.5, 1.0]),
        ("0.01:1:log:3", [0.01, 0.1, 1.0]),
        ("0.1:0.2", np.linspace(0.1, 0.2, 21)),
    ],
)
def test_ranges(text, expected):
    one = _axis("gap-ratio", text, "acceleration")
    assert (one.name, one.logarithmic) == ("gap_ratio", "log" in text)
    np.testing.assert_allclose(one.values(_NODES), expected, rtol=1e-12)


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
            "--vary: stiffness_ratio: the first value, 2, is not below the second, 1",
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
def test_wrong_input_is_one_line_and_exit_2_and_nothing_written(refused, words, named):
    assert named in refused(*words)
