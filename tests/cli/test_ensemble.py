"""``vibroimpact ensemble`` from the words typed to the files written."""

from __future__ import annotations

import json
from functools import partial

import numpy as np
import pytest

import vibroimpact as vi

COMMAND = "ensemble"
FEW = ("--draws", "8", "--frequencies", "1Hz,2.4Hz")
GAP = ("--uncertain", "gap=normal:5%")
STUDY = """
case = "B2-G1-A3"

[sweep]
frequencies = ["1 Hz", "2.4 Hz"]

[ensemble]
uncertain = { "stops.stiffness" = "lognormal:0.2", gap = "uniform:7 mm:8 mm" }
draws = 4
method = "latin"
seed = 3
"""


def test_in_words(tmp_path, run_in):
    code, out, errors = run_in(tmp_path, "B2-G1-A3", *GAP, *FEW, "--sensitivity", "--physical")
    assert (code, errors) == (0, "")
    lines = [line.rstrip() for line in out.splitlines()]
    for line in (
        "8 rigs: gap normal:5%",
        "100 % of them touch a stop at some frequency.",
        "  out/B2-G1-A3-ensemble.png",
        "  out/B2-G1-A3-sensitivity-peak-acceleration.png",
    ):
        assert lines.count(line) == 1
    assert "variance of the largest displacement" in out
    data = vi.load(tmp_path / "out" / "B2-G1-A3-ensemble.nc")
    response = partial(vi.sweeps, frequencies=[1.0, 2.4])
    same = vi.ensemble("B2-G1-A3", {"gap": "normal:5%"}, response, 8)
    np.testing.assert_array_equal(data["gap"], same["gap"])
    np.testing.assert_array_equal(data["eta_d"], same["eta_d"])


def test_of_a_study_as_json(tmp_path, run_in):
    (tmp_path / "rig.toml").write_text(STUDY, encoding="utf-8")
    code, out, errors = run_in(tmp_path, "rig.toml", "--json")
    assert (code, errors) == (0, "")
    facts = json.loads(out)
    spread = {"stops.stiffness": "lognormal:0.2", "gap": "uniform:7 mm:8 mm"}
    assert facts["uncertain"] == spread
    response = partial(vi.sweeps, frequencies=[1.0, 2.4])
    same = vi.ensemble("B2-G1-A3", spread, response, 4, method="latin", seed=3)
    largest = same["peak_displacement"].max(("direction", "frequency"))
    assert facts["peaks"]["peak_displacement"][1] == pytest.approx(float(largest.median()))
    assert 0.0 <= facts["touching"] <= 1.0


@pytest.mark.parametrize(
    ("words", "told_of"),
    [
        ((), "--uncertain: missing"),
        ((*GAP, *GAP), "--uncertain: 'gap' is given twice"),
        (("--uncertain", "colour=normal:5%"), "--uncertain: 'colour' is unknown"),
        (("--uncertain", "gap=gauss:5%"), "--uncertain['gap']: 'gauss:5%'"),
        ((*GAP, "--draws", "100"), "--draws: 100"),
        ((*GAP, "--draws", "0"), "--draws: 0"),
        ((*GAP, "--seed", "-1"), "--seed: -1"),
        ((*GAP, "--from", "3Hz", "--to", "2Hz"), "--from: 3"),
    ],
)
def test_refused(run, words, told_of):
    code, out, errors = run("B2-G1-A3", *words)
    assert (code, out) == (2, "")
    assert errors.startswith(f"vibroimpact: error: {told_of}")
