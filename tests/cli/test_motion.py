"""``vibroimpact motion`` from the words typed to the files written."""

from __future__ import annotations

import io
import json
import math
from pathlib import Path

import h5py
import numpy as np
import pytest
from rich.console import Console

import vibroimpact as vi
from vibroimpact.facts import motions as verdict

COMMAND = "motion"
CASE = vi.laboratory.case("B2-G1-A3")
AS_PDF = ("--figure", "pdf", "--json")
STUDY = Path(__file__).parents[2] / "examples" / "study.toml"


def groups(path: Path) -> set[str]:
    with h5py.File(path) as file:
        return set(file)


@pytest.fixture(scope="module")
def two(tmp_path_factory, run_in):
    """Two motions that coexist: the facts, and the folder of the files."""
    folder = tmp_path_factory.mktemp("two")
    words = ("B2-G1-A3", "--frequency", "2Hz", "--random", "3", "--json")
    code, out, errors = run_in(folder, *words)
    assert (code, errors) == (0, "")
    return json.loads(out), folder


@pytest.fixture(scope="module")
def settled():
    """The motion that rest leads to, from a plain simulation: its last cycle of 200."""
    return vi.simulate(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 2.0)), 200, samples=1024)


def test_summary_and_files(run, tmp_path):
    code, out, errors = run("B2-G1-A3", "--frequency", "2Hz", "--random", "1")
    assert (code, errors) == (0, "")
    lines = [line.rstrip() for line in out.splitlines()]
    for line in (
        "B2-G1-A3",
        "2 Hz: 2 motions coexist",
        "forward branch: periodic, period 1, stable, antisymmetric",
        "backward branch: periodic, period 1, stable, antisymmetric",
        "exponents       -1.0371 and -1.0371 1/s, from the multipliers of the orbit",
        "displacement    -4.3332 to 4.3332 mm",
        "impacts         1 right, 1 left per cycle",
        "impacts         0 right, 0 left per cycle",
        "reached from    backward branch",
        "no contact",
        "Files",
        "  out/B2-G1-A3-2Hz-motion.nc",
        "  out/B2-G1-A3-2Hz-motion.png",
    ):
        assert lines.count(line) == 1
    rows = [line.split() for line in lines if line.startswith(("right  ", "left  "))]
    assert [row[0] for row in rows] == ["left", "right"]
    assert "nan" not in out
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert names == {"B2-G1-A3-2Hz-motion.nc", "B2-G1-A3-2Hz-motion.png"}


def test_json_says_which_motions_there_are(two, settled):
    facts, folder = two
    forward, backward = facts["motions"]
    for motion in (forward, backward):
        assert motion["frequency"] == 2.0
        assert (motion["motion"], motion["period"], motion["stable"]) == ("periodic", 1, 1)
        assert motion["antisymmetric"] is True
        assert motion["mirror_pair"] is False
        assert motion["status"] == "done"
    # The same as a sweep on its way up and down.
    swept = vi.sweep(vi.Rig(CASE.oscillator, CASE.amplitude), np.arange(0.5, 4.0, 0.05))
    there = swept.sel(frequency=2.0, method="nearest")
    for motion, direction in ((forward, "forward"), (backward, "backward")):
        assert motion["name"] == f"{direction} branch"
        for name in ("displacement_excursion", "acceleration_excursion"):
            exact = float(there[name].sel(direction=direction))
            assert motion[name] == pytest.approx(exact, rel=1e-7)
    # The same as a motion that was followed from rest.
    last = settled.isel(time=slice(-1025, None))
    assert forward["displacement_max"] == pytest.approx(float(last["displacement"].max()), 1e-5)
    assert forward["acceleration_min"] == pytest.approx(float(last["acceleration"].min()), 1e-4)
    for path in facts["files"].values():
        assert (folder / path).is_file()


def test_json_says_from_where(two):
    facts, _ = two
    forward, backward = (set(motion["starts"].split(", ")) for motion in facts["motions"])
    assert {"rest", "forward branch"} <= forward
    assert "backward branch" in backward
    every = {"rest", "forward branch", "backward branch", "random 1", "random 2", "random 3"}
    assert forward | backward == every
    assert not forward & backward
    assert [motion["mirrored_starts"] for motion in facts["motions"]] == ["", ""]


def test_json_exponents(two):
    """Liouville: together they are what phase space loses, the mean damping over the mass."""
    forward, backward = two[0]["motions"]
    isolator, right = CASE.oscillator.isolator, CASE.oscillator.right
    decay = isolator.damping / (2.0 * CASE.oscillator.mass)
    assert backward["exponents"] == pytest.approx([-decay, -decay], rel=1e-6)
    assert backward["effective_damping"] == pytest.approx(2.0 * decay, rel=1e-6)
    # In contact the bumper's dashpot adds to the isolator's.
    pressed = sum(contact["duration_share"] for contact in forward["contacts"])
    mean = (isolator.damping + right.damping * pressed) / CASE.oscillator.mass
    assert forward["effective_damping"] == pytest.approx(mean, rel=1e-9)
    assert -sum(forward["exponents"]) == pytest.approx(mean, rel=1e-9)


def test_json_contacts(two, settled):
    forward, backward = two[0]["motions"]
    assert backward["contacts"] == []
    assert (backward["impacts"]["right"], backward["impacts"]["left"]) == (0, 0)
    assert (forward["impacts"]["right"], forward["impacts"]["left"]) == (1, 1)
    # The last events of the plain simulation: begin and end on the left, on the right.
    events = settled.isel(event=slice(-4, None))
    assert list(events["event_contact"].values) == [1, 0, 1, 0]
    mass, damping = CASE.oscillator.mass, CASE.oscillator.right.damping
    for contact, i in zip(forward["contacts"], (0, 2), strict=True):
        first, last = events.isel(event=i), events.isel(event=i + 1)
        assert contact["stop"] == first["event_stop"].item()
        length = float(last["event_time"] - first["event_time"])
        assert contact["duration"] == pytest.approx(length, rel=1e-7)
        assert contact["duration_share"] == pytest.approx(length * 2.0, rel=1e-7)
        phase = 2.0 * math.pi * 2.0 * float(first["event_cycle_time"])
        assert contact["start_phase"] == pytest.approx(phase, rel=1e-7)
        speeds = [float(event["event_velocity"]) for event in (first, last)]
        assert contact["start_velocity"] == pytest.approx(speeds[0], rel=1e-7)
        assert contact["end_velocity"] == pytest.approx(speeds[1], rel=1e-7)
        assert contact["restitution"] == pytest.approx(-speeds[1] / speeds[0], rel=1e-7)
        assert contact["grazing"] is False
        # Of the samples within: the deepest, and the trapezoidal sum of C u̇².
        within = (settled["time"] >= first["event_time"]) & (settled["time"] <= last["event_time"])
        inside = settled.isel(time=np.flatnonzero(within.values))
        depth = float(np.abs(inside["displacement"]).max()) - 7.5e-3
        assert contact["penetration"] == pytest.approx(depth, rel=1e-4)
        peak = float(np.abs(inside["acceleration"]).max())
        assert contact["peak_acceleration"] == pytest.approx(peak, rel=1e-4)
        loss = damping * float((inside["velocity"] ** 2).mean()) * length
        assert contact["dissipated"] == pytest.approx(loss, rel=0.03)
        assert 0.0 < contact["peak_force"] < mass * peak


@pytest.mark.full
def test_list_of_frequencies(run, tmp_path):
    words = ("--frequency", "0.58Hz, 2.6Hz", "--random", "0", "--samples", "32")
    code, out, _ = run("B2-G1-A3", *words, "--output", "figure8", "--name", "two", *AS_PDF)
    assert code == 0
    facts = json.loads(out)
    motions = [(motion["frequency"], motion["name"]) for motion in facts["motions"]]
    assert motions == [
        (0.58, "forward and backward branch"),
        (2.6, "forward branch"),
        (2.6, "backward branch"),
    ]
    stem = tmp_path / "figure8/two-0.58Hz-2.6Hz-motion"
    assert {path.name for path in stem.parent.iterdir()} == {
        f"{stem.name}.nc",
        f"{stem.name}.pdf",
    }
    path = stem.with_name(f"{stem.name}.nc")
    names = ["0.58Hz_forward_and_backward_branch", "2.6Hz_forward_branch", "2.6Hz_backward_branch"]
    assert groups(path) == set(names)
    data = vi.load(path, group=names[1])
    assert data.sizes["time"] == 33
    assert json.loads(data.attrs["parameters"])["frequency"] == 2.6
    largest = [1e3 * motion["displacement_max"] for motion in facts["motions"]]
    assert largest[:2] == pytest.approx([9.5511, 12.126], rel=1e-4)
    assert 1e3 * float(data["displacement_max"]) == largest[1]


def test_chaotic_motion(run, tmp_path):
    words = ("--frequency", "1.06Hz", "--branch", "forward", "--window", "7", "--samples", "16")
    code, out, _ = run("B3-10mm-A3", *words, "--figure", "svg")
    assert code == 0
    data = vi.load(tmp_path / "out/B3-10mm-A3-1.06Hz-motion.nc", group="forward_branch")
    assert (data["motion"].item(), int(data["period"]), int(data["stable"])) == ("chaotic", 0, 0)
    assert "forward branch: chaotic, not antisymmetric" in out
    first, second = data["exponents"].values
    spread = float(data["exponents_uncertainty"][0])
    assert 0.0 < 10.0 * spread < first
    # But for what a bumper remembers at the last section: less than one of a logarithm.
    once = 1.06 / data.sizes["section_point"]
    assert first + second == pytest.approx(-float(data["effective_damping"]), abs=once)
    assert f"{first:+.4g} ± {spread:.1g} and {second:+.4g} ± " in out
    assert data.sizes["time"] == 7 * 16 + 1
    assert data.sizes["section_point"] == 5000
    np.testing.assert_array_equal(data["order"], vi.fourier_spectrum(data)["order"])
    svg = (tmp_path / "out/B3-10mm-A3-1.06Hz-motion.svg").read_text()
    assert svg.startswith("<?xml")
    # Of many contacts some are printed; the file has them all.
    rows = [line.split() for line in out.splitlines() if line.startswith(("right  ", "left  "))]
    assert len(rows) == 12
    assert f"Contacts, 12 of {data.sizes['contact_number']}" in out
    phases = np.degrees(data["contact_start_phase"].values[:12])
    assert [float(row[1]) for row in rows] == pytest.approx(phases, abs=0.05)


@pytest.mark.full
def test_study(run, tmp_path):
    words = ("--frequency", "2.2Hz", "--set", "left.gap=8mm", "--branch", "forward", "--json")
    code, out, _ = run(str(STUDY), *words)
    assert code == 0
    facts = json.loads(out)
    (motion,) = facts["motions"]
    assert motion["frequency"] == 2.2  # not that of [simulate]: what is typed replaces it
    assert facts["files"]["data"] == "out/moat-wall-left-gap-8mm-2.2Hz-motion.nc"
    data = vi.load(tmp_path / facts["files"]["data"], group="forward_branch")
    assert data.attrs["title"] == "moat-wall, left gap 8 mm"
    data = vi.load(tmp_path / facts["files"]["data"], group="forward_branch")
    rig = json.loads(data.attrs["parameters"])["oscillator"]
    assert rig["left"]["stiffness"] == 100e3
    assert rig["left"]["gap"] == pytest.approx(8e-3)
    assert rig["right"]["gap"] == pytest.approx(7.5e-3)


@pytest.mark.full
def test_a_motion_that_is_given_up(run, tmp_path):
    """Nothing takes the energy of a mass that bounces through half of a very slow cycle."""
    words = ("--set", "isolator.damping=0", "--set", "stops.damping=0", "--frequency", "0.0001Hz")
    code, out, errors = run("B2-G1-A3", *words, "--branch", "backward")
    assert code == 0
    assert "undecided" in out
    assert "max_events" in errors
    assert all(line.startswith("vibroimpact: warning: ") for line in errors.splitlines())
    assert len(list((tmp_path / "out").iterdir())) == 2


@pytest.mark.parametrize(
    ("words", "named"),
    [
        ([], "--frequency: missing"),
        (["--frequency", "0Hz"], "--frequency"),
        (["--frequency", "-2Hz"], "--frequency"),
        (["--frequency", "nanHz"], "--frequency"),
        (["--frequency", "2kg"], "is a mass"),
        (["--frequency", ""], "--frequency"),
        (["--frequency", "2Hz,,3Hz"], "--frequency"),
        (["--frequency", "2Hz,-3Hz"], "--frequency"),
        (["--frequency", "2Hz,2.0Hz"], "have the same first six digits; remove one"),
        (
            ["--frequency", "2Hz,2.0000001Hz"],
            "have the same first six digits; remove one",
        ),  # files and columns are one
        (["--frequency", "1Hz,2Hz,3Hz,4Hz,5Hz,6Hz,7Hz"], "7 frequencies; pass at most 6"),
        (["--frequency", "2Hz", "--branch", "sideways"], "sideways"),
        (["--frequency", "0.1Hz", "--branch", "forward"], "--branch: no forward sweep reaches 0.1"),
        (["--frequency", "20Hz", "--branch", "backward"], "--branch: no backward sweep reaches 20"),
        (["--frequency", "2Hz", "--window", "0"], "--window: 0"),
        (["--frequency", "2Hz", "--window", "1.5"], "--window"),
        (["--frequency", "2Hz", "--samples", "0"], "--samples: 0"),
        (["--frequency", "2Hz", "--samples", "-1"], "--samples"),
        (["--frequency", "2Hz", "--random", "-1"], "--random"),
    ],
)
def test_wrong_input_is_one_line_and_exit_2_and_nothing_written(refused, words, named):
    assert named in refused("B2-G1-A3", *words)


def test_a_motion_without_dissipation_is_neutral():
    """Steady flight on an undamped isolator: its disturbances neither grow nor decay."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0))
    shaken = vi.Harmonic(1.0, 2.0 / math.tau)
    with pytest.warns(RuntimeWarning, match="not isolated"):
        flight = vi.steady(vi.Rig(rig, shaken), vi.State(0.0, 2.0 / 3.0), samples=8)
    assert int(flight["stable"]) == -1
    console = Console(width=100, file=io.StringIO())
    console.print(verdict.text({shaken.frequency: {"rest": flight}}))
    assert "rest: periodic, period 1, neutral" in console.file.getvalue()
