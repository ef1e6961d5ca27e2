"""``vibroimpact basin-stability``."""

from __future__ import annotations

import json

import numpy as np
import pytest

import vibroimpact as vi

COMMAND = "basin-stability"
RANGE = ("--vary", "frequency=1.6Hz:2.8Hz:4", "--samples", "60")
NAME = "B2-G1-A3-frequency-basin-stability"


def test_text_and_files(run, tmp_path):
    code, out, errors = run("B2-G1-A3", *RANGE)
    assert (code, errors) == (0, "")
    data = vi.load(tmp_path / f"out/{NAME}.nc")
    shares = data["share"].values
    rows = [line for line in out.splitlines() if line.startswith(("1  ", "2  "))]
    assert [row.split()[1:6] for row in rows] == [
        ["periodic", "1", "1.6", "to", "2.4"],
        ["periodic", "1", "2", "to", "2.8"],
    ]
    assert [float(row.split()[7].rstrip("%")) for row in rows] == pytest.approx(
        100.0 * shares.max(axis=0)
    )
    assert {p.name for p in (tmp_path / "out").iterdir()} == {f"{NAME}.nc", f"{NAME}.png"}


def test_json_and_another_parameter(run, tmp_path):
    words = ("--vary", "gap=4mm:6mm:2")
    window = ("--displacement", "-12mm:12mm", "--velocity", "-0.1:0.1", "--frequency", "0.7Hz")
    code, out, _ = run("B3-10mm-A3", *words, *window, "--samples", "40", "--seed", "3", "--json")
    assert code == 0
    facts = json.loads(out)
    data = vi.load(tmp_path / facts["files"]["data"])
    np.testing.assert_allclose(data["gap"], [0.004, 0.006])
    assert facts["parameter"] == "gap"
    assert json.loads(data.attrs["parameters"])["seed"] == 3
    for number, one in enumerate(facts["motions"]):
        here = data["motion"].values[:, number] != ""
        assert one["share"] == list(data["share"].values[here, number])
        assert one["values"] == list(data["gap"].values[here])


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--vary", "gap=1mm:2mm:1"), "the number of values, '1', is not a whole"),
        (("--samples", "0"), "--samples: 0"),
        (("--vary", "gap=4mm:6mm"), "--frequency: missing"),
        (("--velocity", "1"), "--velocity: '1' is not a range; pass LOW:HIGH"),
    ],
)
def test_what_is_refused(run, tmp_path, words, named):
    code, out, errors = run("B2-G1-A3", *words)
    assert (code, out) == (2, "")
    assert named in errors
    assert list(tmp_path.iterdir()) == []
