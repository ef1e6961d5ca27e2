"""``vibroimpact branch`` from the words typed to the files written."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi

COMMAND = "branch"
CASE = vi.laboratory.case("B2-G1-A3")
GAPS = ("--vary", "gap=1mm:20mm")
STUDY = Path(__file__).parents[2] / "examples" / "study.toml"


def swing(rig: vi.Oscillator, frequency: float) -> float:
    """How far the free mass swings: |A/(k − ω² + icω)| with k = K/M and c = C/M."""
    k, c = rig.isolator.stiffness / rig.mass, rig.isolator.damping / rig.mass
    omega = 2.0 * math.pi * frequency
    return CASE.amplitude / abs(k - omega**2 + 1j * c * omega)


@pytest.fixture(scope="module")
def whole(tmp_path_factory, run_in):
    """Of all frequencies: the folder and what is printed."""
    folder = tmp_path_factory.mktemp("whole")
    code, out, errors = run_in(folder, "B2-G1-A3")
    assert (code, errors) == (0, "")
    return folder, out


@pytest.fixture(scope="module")
def gaps(tmp_path_factory, run_in):
    """Over the gap: the facts, and the folder of the files."""
    folder = tmp_path_factory.mktemp("gaps")
    code, out, errors = run_in(folder, "B2-G1-A3", *GAPS, "--frequency", "2Hz", "--json")
    assert (code, errors) == (0, "")
    return json.loads(out), folder


def of_kind(facts: dict, kind: str) -> list[dict]:
    return [one for one in facts["bifurcations"] if one["kind"] == kind]


def test_summary(whole):
    folder, out = whole
    lines = [line.rstrip() for line in out.splitlines()]
    for line in (
        "B2-G1-A3",
        "beginning: the range ends at 0.3 Hz; end: the range ends at 5 Hz",
        "Files",
        "  out/B2-G1-A3-frequency-branches.nc",
        "  out/B2-G1-A3-frequency-branches.png",
    ):
        assert lines.count(line) == 1
    rows = [line.split() for line in lines if line.startswith(("fold ", "grazing "))]
    points = [(kind, value) for kind, value, *_ in rows]
    assert points[-3:] == [
        ("fold", "2.659478881"),
        ("fold", "1.665006975"),
        ("grazing", "1.665211522"),
    ]
    for line in lines:
        if line.startswith(("fold ", "grazing ")):
            assert line.endswith("turns back") == line.startswith("fold ")
    assert "frequency (Hz)" in out
    assert "nan" not in out
    names = {path.name for path in (folder / "out").iterdir()}
    assert names == {"B2-G1-A3-frequency-branches.nc", "B2-G1-A3-frequency-branches.png"}


def test_json(run, tmp_path):
    code, out, errors = run("B2-G1-A3", "--vary", "frequency=1Hz:4Hz", "--json")
    assert (code, errors) == (0, "")
    facts = json.loads(out)
    assert facts["parameter"] == "frequency"
    (branch,) = facts["branches"]
    assert (branch["branch"], branch["period"], branch["closed"]) == (0, 1, False)
    assert (branch["ended_low"], branch["ended_high"]) == (
        "the range ends at 1 Hz",
        "the range ends at 4 Hz",
    )
    data = vi.load(tmp_path / facts["files"]["data"])
    assert branch["points"] == data.sizes["point"]
    assert [one["kind"] for one in facts["bifurcations"]] == ["fold", "fold", "grazing"]
    for i, one in enumerate(facts["bifurcations"]):
        row = data.isel(bifurcation=i)
        assert one["turns"] is (one["kind"] == "fold")
        assert (one["branch"], one["period"]) == (0, 1)
        assert one["value"] == float(row["bifurcation_value"])
        assert one["eta_d"] == float(row["bifurcation_eta_d"])
        assert len(one["multipliers"]) == 4
        modulus = [math.hypot(*pair) for pair in one["multipliers"]]
        assert modulus == sorted(modulus, reverse=True)
        if one["kind"] == "fold":
            assert one["multipliers"][0] == pytest.approx([1.0, 0.0], abs=1e-6)
    values = [one["value"] for one in facts["bifurcations"]]
    assert values == pytest.approx([2.659478881, 1.665006975, 1.665211522], abs=6e-10)
    assert (tmp_path / facts["files"]["figure"]).is_file()


def test_along_the_gap(gaps):
    facts, folder = gaps
    assert facts["parameter"] == "gap"
    assert facts["files"]["data"] == "out/B2-G1-A3-2Hz-gap-branches.nc"
    data = vi.load(folder / facts["files"]["data"])
    assert (data["gap"].min(), data["gap"].max()) == (1e-3, 20e-3)
    # The mass that flies freely at 2 Hz grazes a gap of just its swing.
    (grazing,) = (one for one in of_kind(facts, "grazing") if one["branch"] == 0)
    assert grazing["value"] == pytest.approx(swing(CASE.oscillator, 2.0), rel=1e-9)
    # From there on nothing changes with the gap.
    free = data["impacts"].sel(stop="right").values == 0
    np.testing.assert_allclose(
        data["displacement_max"].values[free], swing(CASE.oscillator, 2.0), rtol=1e-9
    )


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["--vary", "colour=1:2"], "--vary: 'colour' is unknown; use frequency, amplitude"),
        (["--vary", "gap"], "pass PATH=VALUE in one word, such as gap=9mm"),
        (["--vary", "gap=1mm"], "--vary: gap: '1mm' is not a range"),
        (["--vary", "gap=1mm:2mm", "--vary", "mass=1:2"], "--vary: given 2 times, but"),
        (["--vary", "gap=1mm:2mm", "--vary", "stops.gap=1mm:3mm"], "'stops.gap' is given twice"),
        (["--vary", "frequency=1Hz:2Hz:5"], "--vary: frequency: a curve is followed through the"),
        (["--vary", "frequency=1Hz:2Hz:log"], "--vary: frequency: a curve is followed through"),
        (["--vary", "frequency=3Hz:1Hz"], "is not below the second"),
        (["--vary", "frequency=2Hz:2Hz"], "is not below the second"),
        (["--vary", "frequency=abc:2Hz"], "--vary: frequency: 'abc'"),
        (["--vary", "frequency=:2Hz"], "is not a range"),
        (["--vary", "frequency=-1Hz:2Hz"], "--vary: frequency: '-1Hz'"),
        (["--vary", "frequency=nanHz:2Hz"], "--vary: frequency: 'nanHz'"),
        (["--vary", "frequency=1Hz:2kg"], "--vary: frequency: '2kg' is a mass"),
        (["--vary", "frequency=1Hz:infHz"], "--vary: frequency: 'infHz'"),
        ([*GAPS], "--frequency: missing"),
        ([*GAPS, "--frequency", "abc"], "--frequency: 'abc'"),
        ([*GAPS, "--frequency", "0Hz"], "--frequency"),
        ([*GAPS, "--frequency", "2kg"], "--frequency: '2kg' is a mass"),
        (["--vary", "gap=1Hz:2Hz", "--frequency", "2Hz"], "--vary: gap: '1Hz'"),
        (
            ["--vary", "gap=10mm:20mm", "--frequency", "2Hz", "--period", "1"],
            "error: --vary: gap: 10 mm to 20 mm does not contain the rig's gap of 7.5 mm",
        ),  # without the rig's own gap
        (
            ["--vary", "right.gap=1mm:2mm", "--set", "right=none", "--frequency", "2Hz"],
            "--vary: 'right.gap' is not a parameter of this rig",
        ),
        (
            ["--set", "left.gap=9mm", *GAPS, "--frequency", "2Hz"],
            "the stops have different values of gap",
        ),
        (["--longest", "0"], "longest: 0"),
        (["--longest", "1.5"], "--longest"),
        (["--quantity", "velocity"], "--quantity"),
    ],
)
def test_wrong_input_is_one_line_and_exit_2_and_nothing_written(refused, words, named):
    assert named in refused("B2-G1-A3", *words)


@pytest.mark.full
def test_the_branch_of_another_motion(run, tmp_path):
    """Period 5 beside the motion from rest, over the frequency and over another parameter."""
    (tmp_path / "soft.toml").write_text(
        "[oscillator]\nmass = 1\nisolator = {stiffness = 1, damping = 0.02}\n"
        "right = {stiffness = 29, damping = 0, gap = 1.26}\n"
        f"[excitation]\namplitude = {0.7 * 0.81**2}\nphase = {math.pi}\n"
    )
    shaken = ("--frequency", "0.81rad/s", "--json")
    span = ("--vary", "frequency=0.8rad/s:0.82rad/s")
    note = "the computed orbit has period 1 and is not the motion from rest, which has period 5"
    code, out, errors = run("soft.toml", *shaken, *span, "--period", "1")
    assert json.loads(out)["branches"][0]["period"] == 1
    assert (code, note in errors) == (0, True)
    code, out, errors = run("soft.toml", *shaken, *span, "--period", "5")
    assert (code, errors) == (0, "")
    (branch,) = json.loads(out)["branches"]
    assert branch["period"] == 5
    # The same branch from one of its states.
    state = vi.load(next(tmp_path.rglob("*.nc")))["section"].isel(point=branch["points"] // 2)
    where = f"{float(state[0])!r},{float(state[1])!r}"  # the rig has no units
    code, out, errors = run("soft.toml", *shaken, *span, "--start", where, "--period", "5")
    assert (code, errors) == (0, "")


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--start", "5mm"), "--start: '5mm'; pass a displacement and a velocity"),
        (("--start", "5mm,1kg"), "--start: "),
        (("--period", "0"), "--period: 0"),
    ],
)
def test_a_first_orbit_that_cannot_be(run, words, named):
    code, _, errors = run("B2-G1-A3", "--frequency", "2Hz", *words)
    assert code == 2
    assert named in errors
    assert errors.count("\n") == 1


@pytest.mark.full
def test_own_outputs_have_a_figure_each(run, tmp_path):
    span = ("--vary", "frequency=2.4Hz:2.6Hz", "--start", "8mm,0mm/s", "--frequency", "2.5Hz")
    power = ("--compute", "power [W] = mean(isolator.damping*velocity**2)")
    code, _, errors = run("B2-G1-A3", *span, *power)
    assert (code, errors) == (0, "")
    names = {p.name for p in (tmp_path / "out").iterdir()}
    assert "B2-G1-A3-frequency-branches-power.png" in names
    data = vi.load(tmp_path / "out/B2-G1-A3-frequency-branches.nc")
    assert float(data["power"].min()) > 0.0
