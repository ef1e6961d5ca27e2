"""Commands with a study file of several masses."""

from __future__ import annotations

import contextlib
import csv
import io
import json
from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi
from earthquakes.rigs import noise
from vibroimpact.cli import main
from vibroimpact.cli.options import RigOptions
from vibroimpact.cli.rig import subject

NEIGHBOURS = """
name = "neighbours"

[assembly.masses]
west = "200 t"
east = "250 t"

[assembly.links]
frame_west = { left = "ground", right = "west", stiffness = "30 MN/m", damping = "0.2 MN s/m" }
frame_east = { left = "ground", right = "east", stiffness = "90 MN/m", damping = "0.4 MN s/m" }

[assembly.stops.pounding]
left = "west"
right = "east"
stiffness = "500 MN/m"
damping = "2 MN s/m"
gap = "2 cm"

[assembly.stops.wall]
left = "east"
right = "ground"
kind = "rigid"
restitution = 0.6
gap = "1 cm"

[excitation]
amplitude = "0.1 g"

[sweep]
from = "1.5 Hz"
to = "2.5 Hz"
step = "0.1 Hz"

[simulate]
frequency = "1.9 Hz"
cycles = 5
"""


BASINS = (
    *("basins", "neighbours"),
    *("--plane", "displacement.west=-4cm:4cm", "--plane", "velocity.west=0:0.6"),
)


@pytest.fixture
def run(tmp_path):
    """Run a command in a folder with the study file of the neighbours."""
    (tmp_path / "neighbours.toml").write_text(NEIGHBOURS, encoding="utf-8")

    def run(*words: str) -> tuple[int, str, str]:
        out, errors = io.StringIO(), io.StringIO()
        with (
            contextlib.chdir(tmp_path),
            contextlib.redirect_stdout(out),
            contextlib.redirect_stderr(errors),
        ):
            code = main(words)
        return code, out.getvalue(), errors.getvalue()

    return run


def rig() -> vi.Rig:
    spring = vi.Isolator
    return vi.Rig(
        vi.Assembly(
            {"west": "200 t", "east": "250 t"},
            {
                "frame_west": vi.Link("ground", "west", spring("30 MN/m", "0.2 MN s/m")),
                "frame_east": vi.Link("ground", "east", spring("90 MN/m", "0.4 MN s/m")),
            },
            {
                "pounding": vi.Link("west", "east", vi.Bumper("500 MN/m", "2 MN s/m", "2 cm")),
                "wall": vi.Link("east", "ground", vi.RigidStop(0.6, "1 cm")),
            },
        ),
        "0.1 g",
    )


def files(folder: Path) -> set[str]:
    return {path.name for path in (folder / "out").iterdir()}


def test_simulate(run, tmp_path):
    code, out, _ = run("simulate", "neighbours", "--animation", "html")
    assert code == 0
    stem = "neighbours-1.9Hz"
    pictures = ("history", "accelerations", "forces")
    assert files(tmp_path) == {
        f"{stem}-history.nc",
        f"{stem}.html",
        *(f"{stem}-{name}.png" for name in pictures),
    }
    motion = vi.simulate(rig(), 5, frequency=1.9)
    data = vi.load(tmp_path / f"out/{stem}-history.nc")
    np.testing.assert_array_equal(data["displacement"], motion["displacement"])
    rows = [line.split() for line in out.splitlines()]
    totals = vi.totals(motion)
    for mass in ("west", "east"):
        shown = next(row for row in rows if row[:1] == [mass])
        assert float(shown[1]) == pytest.approx(
            1e3 * float(totals["displacement_max"].sel(mass=mass)), rel=1e-3
        )
        assert float(shown[2]) == pytest.approx(
            -1e3 * float(totals["displacement_min"].sel(mass=mass)), rel=1e-3
        )
    assert "frame_west        K = 30 MN/m, C = 200 kN s/m" in out
    assert "natural frequencies    1.949, 3.02 Hz" in out


def test_facts_of_a_motion_are_exact(run):
    code, out, _ = run("simulate", "neighbours", "--json")
    assert code == 0
    facts = json.loads(out)
    motion = vi.simulate(rig(), 5, frequency=1.9)
    totals, log = vi.totals(motion), vi.contacts(motion)
    largest = facts["largest"]
    assert largest["masses"]["west"]["peak_acceleration"] == float(
        totals["peak_acceleration"].sel(mass="west")
    )
    assert largest["links"]["frame_east"]["peak_drift"] == float(
        totals["peak_drift"].sel(link="frame_east")
    )
    pounding, wall = largest["stops"]["pounding"], largest["stops"]["wall"]
    assert pounding["peak_force"] == float(totals["peak_force"].sel(stop="pounding"))
    mine = log["contact_stop"].values == "wall"
    assert wall == {
        "contacts": int(mine.sum()),
        "peak_impulse": float(log["contact_impulse"].values[mine].max()),
    }
    assert wall["contacts"] > 0
    assert pounding["contacts"] == int((log["contact_stop"] == "pounding").sum()) > 0
    assert facts["natural_frequencies"] == rig().system.natural_frequencies.tolist()


def test_sweep(run, tmp_path):
    code, out, _ = run("sweep", "neighbours", "--json")
    assert code == 0
    assert files(tmp_path) == {
        "neighbours-sweep.nc",
        "neighbours-sweep.txt",
        *(f"neighbours-sweep{name}.png" for name in ("", "-accelerations", "-forces")),
    }
    facts = json.loads(out)
    data = vi.load(tmp_path / "out/neighbours-sweep.nc")
    direct = vi.sweep(rig(), np.round(np.arange(1.5, 2.51, 0.1), 10))
    np.testing.assert_array_equal(data["peak_displacement"], direct["peak_displacement"])
    west = facts["largest"]["masses"]["west"]["peak_displacement"]
    assert west["value"] == float(direct["peak_displacement"].sel(mass="west").max())
    at = direct["peak_displacement"].sel(mass="west", direction=west["direction"])
    assert float(at.sel(frequency=west["frequency"])) == west["value"]
    for stop in ("pounding", "wall"):
        for direction in ("forward", "backward"):
            hit = direct["impacts"].sel(stop=stop, direction=direction) > 0.0
            ranges = [
                (one["low"], one["high"])
                for one in facts["contact"]
                if (one["stop"], one["direction"]) == (stop, direction)
            ]
            inside = [
                any(low <= f <= high for low, high in ranges) for f in direct["frequency"].values
            ]
            assert inside == hit.values.tolist()
            assert hit.any()
    assert facts["resonances"]
    for one in facts["resonances"]:
        curve = direct["peak_displacement"].sel(mass=one["mass"], direction=one["direction"])
        i = int(np.flatnonzero(curve["frequency"] == one["frequency"])[0])
        assert curve[i - 1] < curve[i] > curve[i + 1]
    summary = (tmp_path / "out/neighbours-sweep.txt").read_text(encoding="utf-8")
    assert "Resonances, by mass" in summary
    assert "Largest, by stop" in summary


def test_branch(run, tmp_path):
    words = ("branch", "neighbours", "--vary", "frequency=1.5Hz:2Hz", "--set", "stops.wall=none")
    code, out, _ = run(*words)
    assert code == 0
    stem = "neighbours-no-stop-wall-frequency-branches"
    assert files(tmp_path) == {f"{stem}.nc", f"{stem}.png"}
    data = vi.load(tmp_path / f"out/{stem}.nc")
    assert float(data["frequency"].min()) == 1.5
    assert float(data["frequency"].max()) == 2.0
    assert "grazing" in out
    assert "η_d" not in out


def test_jumps_of_a_sweep(run):
    words = ("sweep", "neighbours", "--to", "2.7Hz", "--set", "stops.wall=none")
    code, out, _ = run(*words)
    assert code == 0
    data = vi.sweep(rig_without_wall(), [1.5 + k / 10 for k in range(13)])
    west = data["peak_displacement"].sel(mass="west")
    rows = [line.split() for line in out.splitlines()]
    (down,) = [row for row in rows if row[:2] == ["forward", "downward"]]
    (up,) = [row for row in rows if row[:2] == ["backward", "upward"]]
    assert down[2:6] == ["2.4", "and", "2.5", "west"]
    assert up[2:6] == ["2.4", "and", "2.3", "west"]
    ends = west.sel(direction="forward").sel(frequency=[2.4, 2.5], method="nearest").values
    np.testing.assert_allclose([float(down[6]), float(down[8])], 1e3 * ends, rtol=1e-3)
    assert "vibroimpact branch locates the folds" in out
    facts = json.loads(run(*words, "--json")[1])["jumps"]
    assert [one["direction"] for one in facts] == ["forward", "backward"]
    assert "Jumps: none" in run(*words[:2], "--to", "1.9Hz", *words[4:])[1]


def test_a_step_of_a_smooth_curve_is_no_jump(run):
    assert run("init", "frame.toml", "--kind", "frame")[0] == 0
    for step in ("0.02Hz", "0.01Hz"):
        assert "Jumps: none" in run("sweep", "frame.toml", "--step", step, "--to", "0.34Hz")[1]
    out = run("sweep", "frame.toml")[1]
    assert "refine --step\n  forward: 0.74 to 0.76 Hz" in out
    assert "0.84 and 0.86" in out


def rig_without_wall() -> vi.Rig:
    stops = {"pounding": rig().system.stops["pounding"]}
    return vi.Rig(rig().system.replace(stops=stops), "0.1 g")


def test_a_branch_along_a_path(run, tmp_path):
    words = ("--vary", "stops.pounding.gap=1cm:2cm", "--set", "stops.wall=none")
    code, _, _ = run("branch", "neighbours", *words)
    assert code == 0
    data = vi.load(tmp_path / "out/neighbours-no-stop-wall-1.9Hz-stops-pounding-gap-branches.nc")
    assert data.attrs["parameter"] == "stops.pounding.gap"


def test_motion(run, tmp_path):
    code, out, _ = run("motion", "neighbours", "--json", "--set", "stops.wall=none")
    assert code == 0
    facts = json.loads(out)
    stops = {"pounding": rig().system.stops["pounding"]}
    steady = vi.steady(vi.Rig(rig().system.replace(stops=stops), "0.1 g"), frequency=1.9)
    assert facts["motion"] == str(steady["motion"].values) == "periodic"
    assert facts["largest"]["masses"]["west"]["displacement_max"] == pytest.approx(
        float(steady["displacement_max"].sel(mass="west")), rel=1e-12
    )
    stem = "neighbours-no-stop-wall-1.9Hz-motion"
    assert {f"{stem}-accelerations.png", f"{stem}-spectrum.png"} <= files(tmp_path)
    saved = vi.load(tmp_path / f"out/{stem}.nc")
    assert saved["section_displacement"].sizes == {"section_point": 1, "mass": 2}
    lines = vi.fourier_spectrum(steady)["acceleration_amplitude"]
    np.testing.assert_allclose(saved["acceleration_amplitude"], lines, atol=1e-9 * lines.max())
    code, _, errors = run("motion", "neighbours", "--frequency", "1Hz,2Hz")
    assert code == 2
    assert "2 frequencies, but 'neighbours' has several masses" in errors


def test_bifurcation(run, tmp_path):
    words = ("--vary", "frequency=2.3Hz:2.5Hz:5", "--set", "stops.wall=none", "--branches")
    code, out, _ = run("bifurcation", "neighbours", *words)
    assert code == 0
    stem = "neighbours-no-stop-wall-frequency-diagram"
    assert files(tmp_path) == {f"{stem}.nc", f"{stem}.png"}
    data = vi.load(tmp_path / f"out/{stem}.nc")
    stops = {"pounding": rig().system.stops["pounding"]}
    alone = vi.Rig(rig().system.replace(stops=stops), "0.1 g")
    direct = vi.bifurcation_diagram(alone, {"frequency": (2.3, 2.5)}, 5)
    np.testing.assert_array_equal(data["section_displacement"], direct["section_displacement"])
    # Two motions coexist, so the sweeps differ between the folds.
    assert not np.array_equal(*data["displacement_max"].sel(mass="west").values)
    rows = [line.split() for line in out.splitlines()]
    folds = [float(row[1]) for row in rows if row[:1] == ["fold"]]
    branch = vi.branch(alone, vary={"frequency": (2.3, 2.5)}, frequency=2.3)
    exact = branch["bifurcation_value"].values[branch["bifurcation_kind"].values == "fold"]
    np.testing.assert_allclose(folds, np.sort(exact), rtol=1e-9)
    assert len(folds) == 2


def test_curve(run, tmp_path):
    vary = ("--vary", "frequency=2.3Hz:2.5Hz", "--vary", "stops.pounding.gap=18mm:22mm")
    code, out, _ = run("curve", "neighbours", *vary, "--set", "stops.wall=none", "--json")
    assert code == 0
    stem = "neighbours-no-stop-wall-fold-frequency-stops-pounding-gap"
    assert files(tmp_path) == {f"{stem}.nc", f"{stem}.png"}
    (one,) = json.loads(out)["curves"]  # both folds of the branch lie on one curve
    assert one["points"] > 3
    assert {one["ended_low"], one["ended_high"]} & {
        f"the range of stops.pounding.gap ends at {end} mm" for end in (18, 22)
    }


def test_basins(run, tmp_path):
    words = ("--frequency", "2.4Hz", "--set", "stops.wall=none", "--start", "velocity.east=0.1m/s")
    code, out, _ = run(*BASINS, *words, "--nodes", "9")
    assert code == 0
    stem = "neighbours-no-stop-wall-2.4Hz-basins"
    assert files(tmp_path) == {f"{stem}.nc", f"{stem}.png"}
    data = vi.load(tmp_path / f"out/{stem}.nc")
    stops = {"pounding": rig().system.stops["pounding"]}
    direct = vi.basins(
        vi.Rig(rig().system.replace(stops=stops), "0.1 g"),
        plane={"displacement.west": (-0.04, 0.04), "velocity.west": (0.0, 0.6)},
        start=vi.State(velocity={"east": 0.1}),
        frequency=2.4,
        nodes=9,
    )
    np.testing.assert_array_equal(data["basin"], direct["basin"])
    shares = [line.split()[4] for line in out.splitlines() if line[:2] in ("1 ", "2 ")]
    assert shares == [f"{one:.1%}" for one in direct["share"].values]
    largest = direct["displacement_excursion"].max("mass").values
    excursions = [float(line.split()[3]) for line in out.splitlines() if line[:2] in ("1 ", "2 ")]
    np.testing.assert_allclose(excursions, 1e3 * largest, rtol=1e-3)


def test_earthquake(run, tmp_path):
    time = np.arange(400) * 0.01
    ground = 3.0 * np.sin(12.0 * time) * np.exp(-0.3 * time)
    rows = "".join(f"{t:.2f},{a:.6f}\n" for t, a in zip(time, ground, strict=True))
    path = tmp_path / "quake.csv"
    path.write_text(f"time (s),acceleration (m/s^2)\n{rows}", encoding="utf-8")
    code, out, _ = run("earthquake", "neighbours", "quake.csv", "--peak", "0.3g", "--json")
    assert code == 0
    stem = "neighbours-quake-earthquake"
    pictures = ("displacements", "accelerations", "forces", "spectra")
    assert files(tmp_path) == {
        "neighbours-earthquake.csv",
        f"{stem}.nc",
        *(f"{stem}-{name}.png" for name in pictures),
    }
    record = vi.Record.read(path).scaled(peak="0.3 g")
    response = vi.seismic_response(vi.Rig(rig().system, record))
    with (tmp_path / "out/neighbours-earthquake.csv").open(encoding="utf-8") as file:
        (row,) = csv.DictReader(file)
    assert row["record"] == "quake.csv"
    for mass in ("west", "east"):
        exact = float(response["peak_displacement"].sel(mass=mass))
        assert float(row[f"peak_displacement_{mass}"]) == exact
        (one,) = json.loads(out)["records"]
        shown = one["largest"]["masses"][mass]["peak_displacement"]
        assert shown == pytest.approx(exact, rel=1e-9)
    assert float(row["peak_force_pounding"]) == float(response["peak_force"].sel(stop="pounding"))
    groups = ("response", "motion", "floor")
    saved = {name: vi.load(tmp_path / f"out/{stem}.nc", name) for name in groups}
    for mass in ("west", "east"):
        floor = saved["floor"].sel(mass=mass)["spectral_acceleration"]
        periods = floor["natural_period"].values
        exact = vi.response_spectrum(vi.floor_record(saved["motion"], mass), periods)
        np.testing.assert_array_equal(floor, exact["spectral_acceleration"])
        assert one["floor_spectra"][mass]["spectral_acceleration"] == float(floor.max())
    assert saved["response"]["peak_drift"].equals(response["peak_drift"])
    assert saved["motion"].sizes["mass"] == 2


SINK = """
name = "sink"
[assembly]
units = "none"
[assembly.masses]
host = 1.0
ball = 0.05
[assembly.links]
spring = { left = "ground", right = "host", stiffness = 1.0, damping = 0.02 }
[assembly.stops]
right = { left = "ball", right = "host", kind = "rigid", restitution = 0.75, gap = 15.0 }
left = { left = "host", right = "ball", kind = "rigid", restitution = 0.75, gap = 15.0 }
[excitation]
of = "force"
on = "host"
amplitude = 1.0
[simulate]
frequency = 0.15915494309189535
cycles = 400
"""


def test_an_impact_damper_starts_from_a_state(run, tmp_path):
    """Its closed form: two impacts a cycle, the speed of the ball in between V."""
    (tmp_path / "sink.toml").write_text(SINK, encoding="utf-8")
    speed = 14.78340654
    words = ("motion", "sink.toml", "--start", "velocity.ball=14", "--start", "velocity.host=3")
    code, _, errors = run(*words)
    assert (code, errors) == (0, "")
    steady = vi.load(tmp_path / "out/sink-omega1-motion.nc")
    assert float(abs(steady["velocity"].sel(mass="ball")).max()) == pytest.approx(speed, rel=1e-6)
    code, _, errors = run("simulate", "sink.toml", *words[2:], "--cycles", "1")
    assert (code, errors) == (0, "")
    motion = vi.load(tmp_path / "out/sink-omega1-history.nc")
    assert float(motion["velocity"].sel(mass="ball")[0]) == 14.0
    names = [f"{part}.{mass}" for part in ("displacement", "velocity") for mass in ("host", "ball")]
    end = steady["final_state"]
    near = ",".join(f"{name}={float(end.sel(component=name)):.3g}" for name in names)
    varied = ("--vary", "amplitude=0.9:1.1")
    code, out, errors = run("branch", "sink.toml", "--start", near, *varied)
    assert (code, errors) == (0, "")
    assert "Branch 0: period 1" in out


def test_design(run, tmp_path):
    quake = noise(3, 4.0, 180)
    columns = np.column_stack([quake.time, quake.acceleration])
    head = "time (s),acceleration (m/s2)"
    np.savetxt(tmp_path / "a.csv", columns, delimiter=",", header=head, comments="")
    words = ("design", "neighbours", "a.csv", "--vary", "stops.pounding.gap=5mm:40mm:4")
    code, out, errors = run(*words)
    assert (code, errors) == (0, "")
    chart = vi.load(tmp_path / "out/neighbours-design.nc")
    assert chart.sizes["stops.pounding.gap"] == 4
    gap = vi.required_gap(rig().system, records=vi.Record.read(tmp_path / "a.csv"))
    needed = 1e3 * float(gap["required_gap"].sel(stop="pounding"))
    row = next(line for line in out.splitlines() if line.startswith("pounding"))
    assert f"{needed:.4g} mm" in row
    for name in ("design.csv", "pareto.png"):
        assert (tmp_path / f"out/neighbours-{name}").exists()
    code, out, errors = run(*words, "--json", "--limit", "peak-force.pounding", "1N")
    assert (code, errors) == (0, "")
    facts = json.loads(out)
    assert facts["required_gap"]["pounding"] == pytest.approx(1e-3 * needed)
    hit = chart["peak_force"].sel(stop="pounding") > 1.0
    assert facts["designs_within_limits"] == int((~hit).sum())
    code, _, errors = run(*words, "--best")
    assert (code, errors.count("\n")) == (2, 1)
    assert "--best: set, but" in errors


def test_ensemble(run, tmp_path):
    words = ("ensemble", "neighbours", "--uncertain", "stops.pounding.gap=normal:5%")
    words += ("--uncertain", "masses.west=normal:5%")
    words += ("--draws", "8", "--frequencies", "1.9Hz,2.1Hz")
    code, out, errors = run(*words, "--set", "stops.wall.gap=5mm")
    assert (code, errors) == (0, "")
    assert "largest displacement, west" in out
    assert "largest contact force, pounding" in out
    assert "contact force, wall" not in out  # it is rigid
    assert "largest impulse, wall" in out
    written = {one.name for one in (tmp_path / "out").iterdir()}
    for ending in ("ensemble.nc", "ensemble.png", "ensemble-accelerations.png"):
        assert any(name.endswith(f"-{ending}") for name in written)
    assert any(name.endswith("-ensemble-forces.png") for name in written)
    code, out, errors = run(*words, "--sensitivity", "--set", "stops.wall=none", "--json")
    assert (code, errors) == (0, "")
    facts = json.loads(out)
    assert set(facts["sensitivity"]) == {"peak_acceleration", "peak_displacement", "peak_force"}
    path = tmp_path / "out" / Path(facts["files"]["data"]).name
    data = vi.load(path)
    exact = data["peak_displacement"].sel(mass="west").max(("direction", "frequency"))
    assert facts["peaks"]["peak_displacement.west"][1] == pytest.approx(float(exact.median()))


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("classify", "neighbours"), "assembly: this command computes one mass"),
        (("basins", "neighbours"), "--plane: missing; pass two coordinates"),
        (
            (
                "basins",
                "neighbours",
                "--plane",
                "displacement.wes=0:1",
                "--plane",
                "velocity.east=0:1",
            ),
            "--plane: 'displacement.wes' is unknown; did you mean displacement.west? Use ",
        ),
        (
            ("basins", "neighbours", "--plane", "velocity.east=1"),
            "--plane: velocity.east: '1' is not",
        ),
        ((*BASINS, "--start", "west=1mm"), "--start: 'west'; pass a part and a name"),
        ((*BASINS, "--start", "velocity.west=1mm"), "--start: velocity.west: '1mm'"),
        ((*BASINS, "--start", "velocity.wes=1"), "start.velocity: 'wes' is not"),
        (("basins", "neighbours", "--velocity", "0:1"), "--velocity: '0:1', but"),
        (("simulate", "neighbours", "--displacement", "2mm"), "--displacement: '2mm', but"),
        (("sweep", "neighbours", "--compute", "p = mean(velocity)"), "velocity.west"),
        (("sweep", "neighbours", "--normalised"), "--normalised: set, but"),
        (("branch", "neighbours", "--start", "1mm,0"), "--start: '1mm'"),
        (("simulate", "neighbours", "--start", "velocity.wes=1"), "start.velocity: 'wes'"),
        (("simulate", "B2-G1-A3", "--start", "velocity.a=1", "--frequency", "2Hz"), "has one mass"),
        (("motion", "B2-G1-A3", "--start", "velocity.a=1", "--frequency", "2Hz"), "has one mass"),
        (("simulate", "neighbours", "--set", "stops.pound.gap=1cm"), "did you mean stops.pounding"),
        (
            ("simulate", "neighbours", "--set", "stops.moat=none"),
            "--set: stops.moat: 'moat' is not",
        ),
        (("simulate", "neighbours", "--set", "masses.west=none"), "'west' is not a mass; "),
        (("simulate", "neighbours", "--set", "masses.west=-1t"), "--set: masses.west: '-1t'"),
        (
            ("simulate", "B2-G1-A3", "--frequency", "2Hz", "--animation", "gif"),
            "--animation: 'gif'",
        ),
    ],
)
def test_wrong_input_is_one_line(refused, words, named):
    assert named in refused(*words)


@pytest.mark.parametrize(
    ("values", "words", "slug"),
    [
        (("stops.pounding.gap=1cm",), "pounding gap 10 mm", "pounding-gap-10mm"),
        (("masses.west=300t",), "mass west 300 t", "mass-west-300t"),
        (("links.frame_west=none",), "no link frame west", "no-link-frame-west"),
        (("gap=3cm",), "gap 30 mm", "gap-30mm"),
        (("forces.east=5kN",), "east 5 kN", "east-5kN"),
    ],
)
def test_changes_are_in_the_title(run, tmp_path, values, words, slug):
    path = str(tmp_path / "neighbours.toml")
    what = subject(path, RigOptions(values=values), masses=True)
    assert what.name == f"neighbours, {words}"
    assert what.slug == f"neighbours-{slug}"


def test_a_force_stays_on_its_mass(run, tmp_path):
    text = NEIGHBOURS.replace('amplitude = "0.1 g"', 'amplitude = "10 kN"\non = "west"')
    path = tmp_path / "pushed.toml"
    path.write_text(text, encoding="utf-8")
    what = subject(str(path), RigOptions(amplitude="20kN"), masses=True)
    assert (what.repeated.amplitude, what.repeated.on) == (20e3, "west")
    code, out, _ = run("simulate", "pushed")
    assert code == 0
    assert "force on west" in out
