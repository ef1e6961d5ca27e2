"""``vibroimpact basins``."""

from __future__ import annotations

import json

import numpy as np
import pytest

import vibroimpact as vi

COMMAND = "basins"
WORDS = ("B3-10mm-A3", "--frequency", "0.7Hz", "--nodes", "60")
NAME = "B3-10mm-A3-0.7Hz-basins"


def test_text_and_files(run, tmp_path):
    code, out, errors = run(*WORDS)
    assert (code, errors) == (0, "")
    assert "each of 60 × 60 states was computed; states without a result: 0" in out
    assert "uncertainty exponent" in out
    first = next(line for line in out.splitlines() if line.startswith("1 "))
    assert first.split()[1:4] == ["periodic", "1", "13.79"]
    assert {p.name for p in (tmp_path / "out").iterdir()} == {f"{NAME}.nc", f"{NAME}.png"}
    data = vi.load(tmp_path / f"out/{NAME}.nc")
    assert data["basin"].shape == (60, 60)
    assert data.attrs["title"] == "B3-10mm-A3"


def test_json_and_options(run, tmp_path):
    words = ("--displacement", "-12mm:12mm", "--velocity", "-0.1:0.1", "--phase", "90deg")
    code, out, _ = run(*WORDS[:3], "--nodes", "8", "--refine", "1", *words, "--json")
    assert code == 0
    facts = json.loads(out)
    data = vi.load(tmp_path / facts["files"]["data"])
    np.testing.assert_allclose(data["displacement"], np.linspace(-0.012, 0.012, 15))
    assert json.loads(data.attrs["parameters"])["phase"] == pytest.approx(np.pi / 2.0)
    assert facts["states"] == 225
    assert [one["share"] for one in facts["motions"]] == pytest.approx(list(data["share"].values))
    assert "refined 1 times near borders, to 15 × 15" in facts["lattice"]


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--displacement", "12mm"), "--displacement: '12mm' is not a range; pass LOW:HIGH"),
        (
            ("--displacement", "12mm:3mm"),
            "--displacement: the first value, 12 mm, is not below the second, 3 mm",
        ),
        (("--velocity", "1m:2m"), "--velocity[0]: "),
        (("--nodes", "1"), "--nodes: 1"),
        (("--refine", "20"), "--refine: 20"),
        (("--phase", "2kg"), "--phase: "),
    ],
)
def test_what_is_refused(run, tmp_path, words, named):
    code, out, errors = run(*WORDS[:3], *words)
    assert (code, out) == (2, "")
    assert named in errors
    assert list(tmp_path.iterdir()) == []


def test_one_frequency_is_taken(run):
    code, _, errors = run("B3-10mm-A3", "--frequency", "1Hz,2Hz")
    assert code == 2
    assert "--frequency: '1Hz,2Hz' has a unit that cannot be read" in errors
