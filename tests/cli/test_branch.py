"""``vibroimpact branch`` from the words typed to the files written."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi
from cli.studies import ISOLA, QUAY

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
def whole(tmp_path_factory, told):
    """Of all frequencies: the folder and what is printed."""
    folder = tmp_path_factory.mktemp("whole")
    code, out, errors = told(folder, "B2-G1-A3")
    assert (code, errors) == (0, "")
    return folder, out


@pytest.fixture(scope="module")
def gaps(tmp_path_factory, told):
    """Over the gap: the facts, and the folder of the files."""
    folder = tmp_path_factory.mktemp("gaps")
    code, out, errors = told(folder, "B2-G1-A3", *GAPS, "--frequency", "2Hz", "--json")
    assert (code, errors) == (0, "")
    return json.loads(out), folder


@pytest.mark.full
def test_basins_find_an_isolated_branch(run, tmp_path):
    (tmp_path / "isola.toml").write_text(ISOLA)
    words = ("isola.toml", "--vary", "frequency=0.94Hz:0.97Hz", "--longest", "5", "--json")
    counts = []
    for basins in ("0", "1"):
        code, out, _ = run(*words, "--random", "0", "--basins", basins)
        assert code == 0
        data = vi.load(tmp_path / json.loads(out)["files"]["data"])
        counts.append([int((data["period"] == period).any()) for period in (1, 5)])
    assert counts == [[1, 0], [1, 1]]


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
    found = [(kind, value) for kind, value, *_ in rows]
    assert found[-3:] == [
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


def test_the_file_holds_the_diagram(whole):
    data = vi.load(whole[0] / "out/B2-G1-A3-frequency-branches.nc")
    assert data.attrs.pop("title") == "B2-G1-A3"
    made = vi.resonance_diagram(CASE, {"frequency": (0.3, 5.0)})
    assert {k: str(v) for k, v in data.attrs.items()} == {k: str(v) for k, v in made.attrs.items()}
    assert set(data.variables) == set(made.variables)
    for name in made.variables:
        np.testing.assert_array_equal(data[name].values, made[name].values, err_msg=name)
        assert data[name].attrs["long_name"] == made[name].attrs["long_name"]
    # Grazing of free flight, in closed form.
    value = float(data["bifurcation_value"][-1])
    assert swing(CASE.oscillator, value) == pytest.approx(7.5e-3, rel=1e-9)


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


def test_the_fold_over_the_gap_is_where_the_motion_with_contacts_ends(gaps):
    """The mass that hits the bumpers goes on to do so just below the fold, and not above."""
    facts, folder = gaps
    data = vi.load(folder / facts["files"]["data"])
    i = next(i for i, one in enumerate(facts["bifurcations"]) if one["kind"] == "fold")
    fold = facts["bifurcations"][i]["value"]
    assert float(data["bifurcation_value"][i]) == fold
    motion, shaken = None, vi.Harmonic(CASE.amplitude, 2.0)
    for gap in [*np.linspace(7.5e-3, 0.9995 * fold, 40), 1.0005 * fold]:
        rig = CASE.oscillator
        rig = rig.replace(left=rig.left.replace(gap=gap), right=rig.right.replace(gap=gap))
        # A whole number of cycles and a quarter: there the mass is off the bumpers.
        motion = vi.simulate(vi.Rig(rig, shaken), 40 if motion else 40.25, motion, samples=4)
        if gap < fold:
            assert (motion["event_time"] > motion["time"][-1] - 0.5).sum() == 4
    motion = vi.simulate(vi.Rig(rig, shaken), 400, motion, samples=4)
    assert not (motion["event_time"] > motion["time"][-1] - 50.0).any()


@pytest.mark.full
def test_quantity_period_name_and_format(run, tmp_path):
    words = ("--vary", "frequency=0.99Hz:1.27Hz", "--quantity", "eccentricity", "--longest", "1")
    code, out, _ = run("B3-10mm-A3", *words, "--name", "pair", "--figure", "svg", "--json")
    assert code == 0
    facts = json.loads(out)
    assert facts["files"] == {
        "data": "out/pair-frequency-branches.nc",
        "figure": "out/pair-frequency-branches.svg",
    }
    assert {one["period"] for one in facts["branches"]} == {1}
    assert of_kind(facts, "period doubling")  # found, but what is born there is not followed
    data = vi.load(tmp_path / facts["files"]["data"])
    pair = ~data["antisymmetric"].values
    assert 1e3 * float(np.abs(data["eccentricity"].values[pair]).max()) == pytest.approx(0.61, 0.02)
    svg = (tmp_path / facts["files"]["figure"]).read_text()
    assert "eccentricity (mm)" in svg
    assert ">B3-10mm-A3<" in svg
    assert len(list((tmp_path / "out").iterdir())) == 2


@pytest.mark.full
def test_excursion_is_a_quantity(run):
    words = ("--vary", "frequency=1.8Hz:4Hz", "--quantity", "displacement_excursion")
    assert run("B2-G1-A3", *words)[0] == 0


@pytest.mark.full
def test_free_flight_is_found_in_a_narrow_range(run):
    """It is stable from 1.6652 Hz on, though both ends of a sweep to 2 Hz hit the bumpers."""
    code, out, _ = run("B2-G1-A3", "--vary", "frequency=1.5Hz:2Hz", "--json")
    assert code == 0
    assert {one["kind"] for one in json.loads(out)["bifurcations"]} == {"fold", "grazing"}


@pytest.mark.full
def test_study_with_unequal_sides(run, tmp_path):
    code, out, errors = run(str(STUDY), "--vary", "frequency=1.4Hz:2.4Hz", "--json")
    assert (code, errors) == (0, "")
    facts = json.loads(out)
    assert facts["files"]["data"] == "out/moat-wall-frequency-branches.nc"
    data = vi.load(tmp_path / facts["files"]["data"])
    assert not data["antisymmetric"].any()
    rig = vi.Oscillator(**json.loads(data.attrs["parameters"])["oscillator"])
    assert (rig.right.gap, rig.left.gap) == (pytest.approx(7.5e-3), pytest.approx(9e-3))
    # Free flight grazes the nearer wall, and on the way to it the orbits that hit one the other.
    last = of_kind(facts, "grazing")[-1]["value"]
    assert swing(rig, last) == pytest.approx(7.5e-3, rel=1e-9)
    hits = {
        (int(r), int(left))
        for r, left in zip(
            data["impacts"].sel(stop="right"), data["impacts"].sel(stop="left"), strict=True
        )
    }
    assert hits == {(0, 0), (1, 0), (1, 1)}


@pytest.mark.full
def test_a_phase_and_a_value_typed_over_a_study(run, tmp_path):
    """The orbits are cut at the study's phase, but they are the same."""
    (tmp_path / "late.toml").write_text(
        'case = "B2-G1-A3"\n[excitation]\nphase = "90 deg"\n[simulate]\nfrequency = "2 Hz"\n'
    )
    found = []
    for rig, phase in (("late.toml", math.pi / 2), ("B2-G1-A3", 0.0)):
        words = ("--vary", "amplitude=0.005g:0.15g")
        code, out, _ = run(rig, *words, "--frequency", "2Hz", "--gap", "5mm", "--json")
        assert code == 0
        facts = json.loads(out)
        found.append([(one["kind"], one["value"]) for one in facts["bifurcations"]])
        data = vi.load(tmp_path / facts["files"]["data"])
        assert data["section"].sel(component="phase").values[0] == pytest.approx(phase)
    assert [kind for kind, _ in found[0]] == [kind for kind, _ in found[1]]
    late, now = ([value for _, value in one] for one in found)
    assert late == pytest.approx(now, rel=1e-7)
    # Free flight is in proportion to the amplitude.
    (grazing,) = (value for kind, value in found[1] if kind == "grazing")
    exact = CASE.amplitude * 5e-3 / swing(CASE.oscillator, 2.0)
    assert grazing == pytest.approx(exact, rel=1e-8)


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["--vary", "colour=1:2"], "--vary: 'colour' is unknown; one of frequency, amplitude"),
        (["--vary", "gap"], "pass PATH=VALUE in one word, such as gap=9mm"),
        (["--vary", "gap=1mm"], "--vary: gap: '1mm' is not a range"),
        (["--vary", "gap=1mm:2mm", "--vary", "mass=1:2"], "--vary: given 2 times, but"),
        (["--vary", "gap=1mm:2mm", "--vary", "stops.gap=1mm:3mm"], "'stops.gap' is given twice"),
        (["--vary", "frequency=1Hz:2Hz:5"], "--vary: frequency: a curve is followed through the"),
        (["--vary", "frequency=1Hz:2Hz:log"], "--vary: frequency: a curve is followed through"),
        (["--vary", "frequency=3Hz:1Hz"], "is not below the upper end"),
        (["--vary", "frequency=2Hz:2Hz"], "is not below the upper end"),
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
        (["--figure", "bmp"], "--figure"),
        (["--gap", "15 kg"], "--gap"),
        (["--output", "/proc/vibroimpact"], "--output"),
        (["--paramter", "gap"], "--paramter"),
    ],
)
def test_wrong_input_is_one_line_and_exit_2_and_nothing_written(run, tmp_path, words, named):
    code, out, errors = run("B2-G1-A3", *words)
    assert (code, out) == (2, "")
    assert errors.startswith("vibroimpact: error: ")
    assert errors.count("\n") == 1
    assert named in errors
    assert list(tmp_path.iterdir()) == []


def test_an_output_that_is_a_file_is_refused_and_kept(run, tmp_path):
    (tmp_path / "taken").write_text("kept")
    code, out, errors = run("B2-G1-A3", "--output", "taken")
    assert (code, out) == (2, "")
    assert errors.startswith("vibroimpact: error: --output: 'taken' cannot be written to")
    assert errors.count("\n") == 1
    assert (tmp_path / "taken").read_text() == "kept"


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
    told = "the computed orbit has period 1 and is not the motion from rest, which has period 5"
    code, out, errors = run("soft.toml", *shaken, *span, "--period", "1")
    assert json.loads(out)["branches"][0]["period"] == 1
    assert (code, told in errors) == (0, True)
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
def test_an_isolator_without_stiffness(run, tmp_path):
    """Between two springs that both touch the mass it is linear, and its swing known."""
    (tmp_path / "study.toml").write_text(
        "[oscillator]\nmass = 1.0\nisolator = { stiffness = 0, damping = 1.0 }\n"
        "right = { stiffness = 100, damping = 0, gap = 0 }\n"
        "left = { stiffness = 100, damping = 0, gap = 0 }\n[excitation]\namplitude = 1.0\n"
    )
    span = ("--vary", "frequency=0.8Hz:1.2Hz")
    code, _, errors = run("study.toml", *span, "--frequency", "1Hz", "--period", "1")
    assert (code, errors) == (0, "")
    data = vi.load(tmp_path / "out/study-frequency-branches.nc")
    omega = 2.0 * np.pi * data["frequency"].values
    swing = 1.0 / np.hypot(100.0 - omega**2, omega)
    np.testing.assert_allclose(data["peak_displacement"], swing, rtol=1e-7)
    assert run("study.toml", *span[:2]) == (
        2,
        "",
        "vibroimpact: error: --to: missing; the isolator has no stiffness, so there is no "
        "natural frequency and no default; pass a frequency greater than 0\n",
    )


@pytest.mark.full
def test_a_rigid_stop_and_a_preload_from_a_study_file(run, tmp_path):
    (tmp_path / "quay.toml").write_text(QUAY, encoding="utf-8")
    code, _, errors = run("quay.toml", "--vary", "frequency=1.9Hz:2Hz")
    assert (code, errors) == (0, "")
    data = vi.load(tmp_path / "out/quay-frequency-branches.nc")
    assert float(data["displacement_max"].max()) == pytest.approx(5e-3, rel=1e-12)


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
