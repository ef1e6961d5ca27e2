"""``vibroimpact classify``."""

from __future__ import annotations

import json

import pytest

import vibroimpact as vi

COMMAND = "classify"


def test_text(run, tmp_path):
    code, out, errors = run("B3-10mm-A3")
    assert (code, errors) == (0, "")
    assert "S4: left hysteresis or non-regular resonances" in out
    for line in ("right hysteresis 1.9–3.3 Hz", "left hysteresis 0.674–0.729 Hz"):
        assert line in out
    assert "Confidence 100%" in out
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "B3-10mm-A3-scenario.nc",
        "B3-10mm-A3-scenario.png",
    }
    data = vi.load(tmp_path / "out/B3-10mm-A3-scenario.nc")
    assert data["frequency"].values[0] == pytest.approx(0.4 * 1.1004, rel=1e-3)


def test_several_harmonics_are_refused(run, tmp_path):
    (tmp_path / "saw.toml").write_text(
        'case = "B2-G1-A3"\n[excitation]\namplitudes = ["0.05 g", "0.02 g"]\n', encoding="utf-8"
    )
    for words in (("saw",), ("saw", "--from", "1Hz")):
        code, out, errors = run(*words)
        assert (code, out) == (2, "")
        assert "excitation: scenarios are not defined for a Periodic" in errors
        assert errors.count("\n") == 1


@pytest.mark.full
def test_thresholds_and_what_they_change(run):
    code, out, _ = run("B2-G4-A1", "--touch", "0.05", "--json")
    assert code == 0
    facts = json.loads(out)
    assert facts["scenario"] == "S2"
    assert facts["alternatives"] == [{"threshold": "touch", "value": 0.1, "scenario": "S1"}]
    assert facts["confidence"] == pytest.approx(7 / 8)
    _, out, _ = run("B2-G4-A1")
    assert "S1: grazing" in out
    assert "with --touch 0.05: S2" in out


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["--touch", "5"], "--touch: 5.0; pass a number greater than 0 and at most 1"),
        (["--extent", "0"], "--extent: 0.0"),
        (["--extent", "wide"], "--extent"),
        (["--from", "6Hz", "--to", "5Hz"], "--from: 6 Hz is above --to, 5 Hz; lower --from"),
        (
            ["--from", "1Hz", "--to", "1.02Hz", "--step", "0.01Hz"],
            "--step: 3 values are too few for a resonance curve; pass at least 4 frequencies",
        ),
        (["--step", "0Hz"], "--step"),
    ],
)
def test_wrong_input_is_one_line_and_exit_2_and_nothing_written(refused, words, named):
    assert named in refused("B2-G1-A3", *words)
