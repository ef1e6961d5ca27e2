"""``vibroimpact design`` from the words typed to the files written."""

from __future__ import annotations

import json

import numpy as np
import pytest

import vibroimpact as vi
from earthquakes.rigs import noise
from vibroimpact.facts import design

COMMAND = "design"
STUDY = """
name = "building"

[oscillator]
mass = "5000 t"
isolator = { period = "2.5 s", damping_ratio = 0.15 }
right = { stiffness = "500 MN/m", damping = "5 MN s/m", gap = "300 mm" }
left = { stiffness = "500 MN/m", damping = "5 MN s/m", gap = "300 mm" }
"""
DESIGN = """
[design]
records = ["a.csv", "b.csv"]
vary = { gap = "20 mm:200 mm:3", stops.stiffness = "50 MN/m:1000 MN/m:log:4" }
limits = { penetration = "40 mm" }
fractile = 0.5
"""
RECORDS = {"a.csv": noise(1, 5.0, 200), "b.csv": noise(2, 6.0, 150)}
SIZES = ("peak_displacement", "peak_acceleration", "peak_force")


@pytest.fixture
def study(tmp_path):
    for name, one in RECORDS.items():
        rows = [f"{t:.2f},{a:.9g}" for t, a in zip(one.time, one.acceleration, strict=True)]
        (tmp_path / name).write_text("\n".join(["Time (s),North (m/s^2)", *rows]) + "\n")
    (tmp_path / "building.toml").write_text(STUDY + DESIGN)
    return tmp_path


def _rig() -> vi.Oscillator:
    wall = vi.Bumper("500 MN/m", "5 MN s/m", "300 mm")
    isolator = vi.Isolator.from_period("5000 t", period="2.5 s", damping_ratio=0.15)
    return vi.Oscillator("5000 t", isolator, wall, wall)


def test_a_study_with_records(run, study):
    code, printed, errors = run("building.toml")
    assert (code, errors) == (0, "")
    out = study / "out"
    assert {p.name for p in out.iterdir()} == {
        "building-design.nc",
        "building-design.csv",
        "building-design.png",
        "building-pareto.png",
    }
    records = {name: vi.Record.read(study / name) for name in RECORDS}
    vary = {"gap": np.linspace(0.02, 0.2, 3), "stops.stiffness": np.geomspace(5e7, 1e9, 4)}
    direct = vi.design_chart(
        _rig(), vary, records=records, fractile=0.5, limits={"penetration": 0.04}
    )
    held = vi.load(out / "building-design.nc")
    for name in SIZES:
        np.testing.assert_allclose(held[name], direct[name], rtol=1e-12)
    need = vi.required_gap(_rig(), records=records, fractile=0.5)
    words = " ".join(printed.split())
    every = vi.required_gap(_rig(), records=records)
    gap, right, left = (1e3 * float(one) for one in (need["common_gap"], *need["required_gap"]))
    assert (
        f"Required gap: {gap:.4g} mm, the 50 % fractile over a.csv, b.csv (each side separately: "
        f"{right:.4g} mm to the right, {left:.4g} mm to the left); "
        f"{1e3 * float(every['common_gap']):.4g} mm for no contact under all of them. "
    ) in words
    assert (
        "All values are 50 % fractiles over the records, for each quantity separately; limits "
        "apply to these fractiles."
    ) in words
    within, front = (int(direct[name].sum()) for name in ("within_limits", "pareto"))
    assert 0 < front <= within < 12
    assert (
        f"Designs: 3 × 4, over gap and stops.stiffness; {within} are within penetration 40 mm, "
        f"and of these {front} are not dominated by another design in displacement and acceleration"
    ) in words
    rows = (out / "building-design.csv").read_text().splitlines()
    assert len(rows) == 13
    assert "stops.damping (N s m-1)" in rows[0]
    assert (
        "All designs keep the bumpers' damping of 5 MN s/m; --vary stiffness_at_restitution keeps "
        "their restitution instead."
    ) in words


def test_where_no_gap_is_enough_for_all_it_is_told():
    """As of a spring that lets go of the mass under the stronger of two records."""
    gap = vi.required_gap(_rig(), records=RECORDS, fractile=0.0)
    gap["displacement_min"][1] = -np.inf
    data = vi.design_chart(_rig(), {"gap": [0.02, 0.06]}, records=RECORDS, fractile=0.0)
    text = " ".join(str(line) for line in design.text(_rig(), gap, data, None, list(RECORDS)))
    assert "; no gap is sufficient for all of them. " in text
    assert "the mass hits a stop under 1 of the 2 records." in text
    assert design.facts(gap, data, None)["common_gap_of_all_records"] is None


@pytest.mark.full
def test_what_keeps_the_gap_is_told_where_the_chart_varies_it(run, study):
    narrow = ("--vary", "gap=20mm:60mm:2")
    code, out, _ = run("building.toml", "--gap", "50mm", *narrow)
    assert code == 0
    assert "The designs vary the gap; the gap of 50 mm does not affect them." in out
    code, out, _ = run("building.toml", *narrow)
    assert "The designs vary" not in out
    limit = ("--limit", "penetration", "800mm")
    code, out, _ = run("building.toml", "--best", "--gap", "50mm", *narrow, *limit)
    assert code == 0
    assert "The designs vary the gap; only the search keeps the gap of 50 mm." in out
    assert out.rstrip().count("as 50 % fractiles.") == 1
    note = "Note on this design: the design stays below the limit of penetration: "
    assert note in " ".join(out.split())
    stiff = ("--vary", "stops.stiffness=50MN/m:60MN/m:2")
    code, out, _ = run("building.toml", "--gap", "50mm", *stiff)
    assert "The designs vary" not in out


@pytest.mark.full
def test_dampings_follow_at_a_restitution_and_are_told(run, study):
    returning = STUDY.replace('damping = "5 MN s/m"', "restitution = 0.6")
    (study / "wall.toml").write_text(returning)
    vary = ("--vary", "stiffness_at_restitution=50 MN/m:500 MN/m:2")
    code, out, errors = run("wall.toml", "a.csv", "--gap", "20mm", *vary, "--json")
    assert (code, errors) == (0, "")
    data = vi.load(study / json.loads(out)["files"]["data"])
    made = [vi.Bumper.from_restitution("5000 t", k, 0.6, 0.0).damping for k in (5e7, 5e8)]
    np.testing.assert_allclose(data["stops.damping"], made, rtol=1e-12)
    assert data["stops.damping"].attrs["units"] == "N s m-1"
    code, out, _ = run("wall.toml", "a.csv", "--gap", "20mm", *vary)
    assert code == 0
    assert "stops.stiffness    stops.damping" in out
    assert "designs keep" not in out
    code, out, _ = run("wall.toml", "a.csv", "--vary", "gap=20mm:60mm:2")
    assert "damping of" not in out


@pytest.mark.full
def test_sines_best_and_json(run, study):
    (study / "sines.toml").write_text(STUDY + '[excitation]\namplitude = "0.1 g"\n')
    words = ("--gap", "200mm", "--vary", "gap=0.1:0.4:3", "--vary", "frequency=0.3Hz:0.5Hz")
    code, out, errors = run(
        "sines.toml", *words, "--best", "--limit", "penetration", "60mm", "--json"
    )
    assert (code, errors) == (0, "")
    facts = json.loads(out)
    rig = _rig()
    rig = rig.replace(**{side: getattr(rig, side).replace(gap=0.2) for side in ("right", "left")})
    need = vi.required_gap(vi.Rig(rig, "0.1 g"), {"frequency": (0.3, 0.5)})
    assert facts["common_gap"] == float(need["common_gap"])
    assert facts["designs"] == 3
    assert facts["best"]["penetration"] <= 0.06
    limits = {"penetration": 0.06}
    best = vi.least_acceleration(vi.Rig(rig, "0.1 g"), {"frequency": (0.3, 0.5)}, limits=limits)
    assert facts["best"]["stops.damping"] == pytest.approx(float(best["stops.damping"]))
    assert facts["best"]["notes"] == best.attrs.get("notes", "").splitlines()
    for path in facts["files"].values():
        assert (study / path).is_file()


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (("--vary", "length=1:2"), "--vary: 'length' is unknown; use "),
        (("--vary", "gap=2"), "--vary: gap: '2' is not a range; pass LOW:HIGH"),
        (
            ("--vary", "gap=0.2:0.1"),
            "--vary: gap: the first value, 200 mm, is not below the second, 100 mm",
        ),
        (("--vary", "gap=1kg:2"), "--vary: gap: '1kg'"),
        (
            ("--vary", "isolator.yield_force=1:2"),
            "--vary: 'isolator.yield_force' is not a parameter of this rig",
        ),
        (("--limit", "speed", "1"), "--limit: 'speed' is unknown; use "),
        (("--best", "--limit", "speed", "1"), "--limit: 'speed' is unknown; use "),
        (("--fractile", "2"), "--fractile: '2'"),
        (("--scale", "0"), "scale: 0"),
        (("none.csv",), "record: 'none.csv' cannot be read"),
    ],
)
def test_wrong_input_is_one_line_and_nothing_is_written(refused, study, words, line):
    assert line in refused("building.toml", *words)


@pytest.mark.parametrize(
    ("table", "line"),
    [
        (
            "[design]\nrecord = 'a.csv'",
            "design.record: unknown key; did you mean records? Use records, vary, limits or fr",
        ),
        ("[design]\nrecords = ['no.csv']", "record: 'no.csv' cannot be read"),
        ("[design]\nrecords = ['a.csv']\nvary = { gap = 3 }", "design.vary.gap"),
        ("[design]\nfractile = 1.5", "design.fractile: 1.5"),
        ("[excitation]\namplitude = 0.1\n[sweep]\nfrom = 0.2", "sweep.to: missing"),
        ("", "excitation.amplitude: missing"),
    ],
)
def test_wrong_studies(run, study, table, line):
    (study / "wrong.toml").write_text(STUDY + table)
    code, out, errors = run("wrong.toml")
    assert (code, out) == (2, "")
    assert errors.count("\n") == 1
    assert line in errors


@pytest.mark.full
def test_a_gap_that_is_enough_for_a_fractile_is_hit_under_the_others(run, study):
    """Between the two records: one reaches it. Each side's fractile alone would not tell."""
    records = {name: vi.Record.read(study / name) for name in RECORDS}
    every = vi.required_gap(_rig(), records=records)
    sides = np.array([every["displacement_max"].values, -every["displacement_min"].values])
    less, more = sorted(1e3 * sides.max(axis=0))
    middle = 0.5 * (less + more)
    narrow = ("--vary", "gap=20mm:60mm:2", "--fractile", "0.5")
    enough, tell = "is sufficient for the 50 % fractile;", " the mass hits a stop under "
    for gap, line in (
        (0.5 * (middle + more), enough + tell + "1 of the 2 records."),
        (1.01 * more, enough + tell + "none of the 2 records."),
        (0.99 * less, f"is {middle - 0.99 * less:.4g} mm short for the 50 % fractile;"),
    ):
        code, out, errors = run("building.toml", *narrow, "--gap", f"{gap:.9g}mm")
        assert (code, errors) == (0, "")
        assert line in " ".join(out.split())
    code, out, _ = run("building.toml", *narrow, "--json")
    facts = json.loads(out)
    assert facts["fractile"] == 0.5
    assert facts["common_gap"] == pytest.approx(1e-3 * middle)
    assert facts["common_gap_of_all_records"] == pytest.approx(1e-3 * more)


def test_a_range_of_frequencies_has_no_values(run, study):
    (study / "sines.toml").write_text(STUDY + '[excitation]\namplitude = "0.1 g"\n')
    code, out, errors = run("sines.toml", "--vary", "frequency=0.3Hz:0.5Hz:3")
    assert (code, out) == (2, "")
    assert "--vary: frequency: the sines cover the range, so it has no number of values" in errors
    code, _, errors = run("sines.toml", "--from", "0.3Hz")
    assert code == 2
    assert "Unknown option: --from; write the range as --vary frequency=0.5Hz:4Hz" in errors


def test_a_study_states_the_range_of_the_sines(run, study):
    table = '[excitation]\namplitude = "0.1 g"\n[design]\nvary = { gap = "0.1:0.4:2"'
    for name, more, options in (
        ("in the study", ', frequency = "0.3 Hz:0.5 Hz"', ()),
        ("beside those of the study", "", ("--vary", "frequency=0.3Hz:0.5Hz")),
    ):
        (study / "sines.toml").write_text(f"{STUDY}{table}{more} }}\n")
        code, out, _ = run("sines.toml", *options, "--json")
        facts = json.loads(out)
        need = vi.required_gap(vi.Rig(_rig(), "0.1 g"), {"frequency": (0.3, 0.5)})
        assert (code, facts["designs"]) == (0, 2), name
        assert facts["common_gap"] == float(need["common_gap"]), name
