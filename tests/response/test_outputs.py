"""Own outputs: formulas and functions of one period of each motion."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.response.output_formula import read_output_formula
from vibroimpact.response.outputs import histories_of

RIG = vi.laboratory.case("B2-G1-A3").rig
FREE = vi.Rig(vi.Oscillator(2.0, vi.Isolator(50.0, 3.0)), 1.5)
GRID = [0.7, 0.9, 1.3]
POWER = vi.Output(
    "mean(isolator.damping*velocity**2)", units="W", long_name="mean power of the dashpot"
)


def top_speed(motion: xr.Dataset) -> float:
    return float(np.abs(motion["velocity"]).max())


def test_a_formula_of_free_flight_has_the_value_of_its_closed_form():
    outputs = {
        "power": POWER,
        "fed": "mean(-mass*base_acceleration*velocity)",
        "size": "rms(displacement)*sqrt(2)",
        "work": "integral(isolator.damping*velocity**2)",
        "up": "mean(displacement > 0)",
        "least": "min(min(displacement, -1))",
        "ratio": "2*pi*frequency*mass/isolator.damping",
    }
    data = vi.sweep(FREE, GRID, "forward", outputs=outputs).isel(direction=0)
    omega = 2.0 * np.pi * np.array(GRID)
    size = 1.5 / np.hypot(25.0 - omega**2, 1.5 * omega)
    power = 3.0 * (omega * size) ** 2 / 2.0
    np.testing.assert_allclose(data["size"], size, rtol=1e-9)
    np.testing.assert_allclose(data["power"], power, rtol=1e-9)
    np.testing.assert_allclose(data["fed"], power, rtol=1e-9)
    np.testing.assert_allclose(data["work"], power / GRID, rtol=1e-9)
    np.testing.assert_allclose(data["up"], 0.5, atol=2.0 / 256)
    np.testing.assert_allclose(data["least"], -1.0)
    np.testing.assert_allclose(data["ratio"], omega * 2.0 / 3.0)
    assert data["power"].attrs["units"] == "W"
    assert data["power"].attrs["long_name"] == "mean power of the dashpot"
    assert data["fed"].attrs["long_name"] == "fed"
    assert json.loads(data.attrs["parameters"])["outputs"]["power"] == POWER.function


@pytest.mark.parametrize("where", ["threads", "processes"])
def test_a_function_gets_one_period_wherever_it_runs(where):
    factor = 2.0  # what a lambda refers to travels with it
    data = vi.sweeps(
        {"a": RIG, "b": "B3-10mm-A3"},
        [1.5, 2.2],
        outputs={"fast": lambda motion: factor * top_speed(motion), "top": "max(abs(velocity))"},
        where=where,
    )
    np.testing.assert_allclose(data["fast"], 2.0 * data["top"])
    one = data.sel(rig="a", direction="backward", frequency=2.2)
    start = one["section"]
    steady = vi.steady(RIG, start, frequency=2.2)
    assert float(one["top"]) == pytest.approx(top_speed(steady), rel=1e-9)
    assert data["fast"].dims == data["eta_d"].dims
    assert data["fast"].attrs["output"] == "function <lambda>"


def test_a_motion_that_does_not_settle_is_looked_at_over_the_window():
    lengths = []

    def length(motion: xr.Dataset) -> float:
        lengths.append(float(motion["cycle"][-1]))
        return lengths[-1]

    chaotic = vi.sweep(
        "B3-10mm-A3", [1.06], "forward", max_cycles=200, window=30, outputs={"length": length}
    )
    assert chaotic["motion"].item() == "undecided"
    assert lengths == [30.0]
    given_up = vi.sweep(RIG, [2.0], "forward", max_events=1, outputs={"top": "max(velocity)"})
    assert np.isnan(given_up["top"]).all()


def test_each_frequency_has_its_amplitude():
    rig = vi.Rig(FREE.oscillator, [1.0, 2.0, 3.0])
    data = vi.sweep(rig, GRID, "forward", outputs={"most": "max(abs(base_acceleration))"})
    np.testing.assert_allclose(data["most"][0], [1.0, 2.0, 3.0], rtol=1e-9)


def test_progress_counts_holds_and_then_their_outputs():
    counts = []
    vi.sweep(FREE, GRID, outputs={"top": "max(velocity)"}, progress=lambda *n: counts.append(n))
    assert counts[-1] == (12, 12)
    assert counts == sorted(counts)


def test_files_keep_outputs(tmp_path):
    data = vi.sweep(FREE, GRID, outputs={"power": POWER})
    again = vi.load(vi.save(data, tmp_path / "one.nc"))
    xr.testing.assert_identical(again["power"], data["power"])
    panels = figures.resonance_curves(again)
    assert len(panels) == 3
    assert panels[2].get_ylabel() == "mean power of the dashpot (W)"


def test_a_bifurcation_diagram_has_outputs_and_draws_them():
    data = vi.bifurcation_diagram(
        "B3-10mm-A3", {"frequency": (1.0, 1.3)}, 4, outputs={"power": POWER, "top": top_speed}
    )
    assert data["power"].dims == ("start", "frequency")
    swept = vi.sweep("B3-10mm-A3", [1.3], "forward", outputs={"power": POWER})
    last = data["power"].sel(start="up", frequency=1.3)
    assert float(last) == pytest.approx(float(swept["power"][0, 0]), rel=1e-6)
    panels = figures.section_diagram(data)
    assert len(panels) == 5
    assert "power" in panels[1].get_ylabel()
    np.testing.assert_allclose(panels[1].lines[-1].get_ydata(), data["power"].sel(start="up"))


@pytest.mark.parametrize("function", ["branch", "resonance_diagram"])
def test_branches_have_outputs_of_orbits_and_bifurcations(function):
    outputs = {"power": POWER}
    if function == "branch":
        data = vi.branch(RIG, frequency=2.0, vary={"frequency": (1.6, 2.8)}, outputs=outputs)
    else:
        data = vi.resonance_diagram(
            RIG, {"frequency": (2.4, 2.8)}, starts=3, random=0, outputs=outputs
        )
    assert data["power"].dims == ("point",)
    assert np.isfinite(data["power"]).all()
    here = int(np.abs(data["frequency"].values - 2.45).argmin())
    one = data.isel(point=here)
    orbit = vi.orbit(RIG, one["section"], frequency=float(one["frequency"]))
    speed = orbit["velocity"].values
    damping = RIG.oscillator.isolator.damping
    mean = damping * np.trapezoid(speed**2, orbit["time"]) * float(one["frequency"])
    assert float(one["power"]) == pytest.approx(mean, rel=1e-9)
    assert data["bifurcation_power"].attrs["units"] == "W"
    assert np.isfinite(data["bifurcation_power"]).all()
    ax = figures.branch_diagram(data, quantity="power")
    assert ax.get_ylabel() == "mean power of the dashpot (W)"
    with pytest.raises(vi.InputError, match=r"^sweep: it has no output 'power'"):
        figures.branch_diagram(data, quantity="power", sweep=vi.sweep(RIG, [2.4, 2.5]))


@pytest.mark.parametrize(
    ("output", "message"),
    [
        ("", "it has 0 characters"),
        ("max(velocty)", "'velocty' is neither a time history nor .* did you mean velocity"),
        ("max(damping*velocity)", "did you mean 'isolator.damping'"),
        ("max(applied_force)", "'applied_force' is neither"),
        ("max(friction*velocity)", "'friction' is neither"),
        ("velocity", "'velocity' is a time history, not a number; apply max, min, mean"),
        ("max(velocity", "cannot be read .*; use a formula such as"),
        ("velocity^2", r"\^ is not a power here; write \*\*"),
        ("__import__('os')", "'__import__' is not a function that outputs accept"),
        ("velocity.max()", "is not accepted"),
        ("max(v for v in velocity)", "is not accepted"),
        ("mean(1, 2)", "mean has one argument"),
        ("mean('a')", "is not accepted"),
        ("mean(True)", "is not accepted"),
        (lambda motion: motion["velocity"], "the function returned .*; return one number"),
        (lambda motion: "1", "the function returned '1'; return one number"),
        (lambda motion: motion["nothing"], "the function failed at 0.9 Hz with KeyError"),
        (3.0, "3.0 is neither a formula nor a function"),
        (float, "is neither a formula nor a function"),
    ],
)
def test_what_is_no_output(output, message):
    with pytest.raises(vi.InputError, match=rf"^outputs\['mine'\]: .*{message}") as caught:
        vi.sweep(FREE, [0.9], outputs={"mine": output})
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["eta_d", "period", "2x", "a b", "", "bifurcation_a", "point", 3])
def test_what_is_no_name(name):
    with pytest.raises(vi.InputError, match=r"^outputs"):
        vi.sweep(FREE, [0.9], outputs={name: "max(velocity)"})


def test_what_are_no_outputs():
    with pytest.raises(vi.InputError, match=r"^outputs: .* is not a mapping"):
        vi.sweep(FREE, [0.9], outputs="max(velocity)")
    with pytest.raises(vi.InputError, match=r"^units: 3 is not a string"):
        vi.Output("max(velocity)", units=3)


def test_a_formula_has_the_names_that_a_motion_has():
    for rig in (FREE, vi.Rig(FREE.oscillator, "2 N")):
        motion = vi.simulate(rig, 1, frequency=1.0)
        held = {name for name in motion.variables if motion[name].dims == ("time",)}
        assert held - set(histories_of(rig)) == {"cycle"}


def pounding(law: object) -> vi.Rig:
    links = {
        "first": vi.Link("ground", "west", law),
        "second": vi.Link("ground", "east", vi.Isolator(3e5, 3e3)),
    }
    stops = {"between": vi.Link("west", "east", vi.Bumper(2e5, 3e3, "2 mm"))}
    assembly = vi.Assembly({"west": 1500.0, "east": 1000.0}, links, stops)
    return vi.Rig(assembly, vi.Harmonic("1 m/s2", 1.7))


LAWS = {
    "linear": vi.Isolator(2e5, 4e3),
    "curved": vi.PolynomialIsolator(2e5, 4e3, 2e8),
    "yields": vi.BilinearIsolator(2e5, 1e5, 800.0, 4e3),
}
OWN = {
    "drag": vi.Output("mean(masses.west*velocity.west**2)", units="W"),
    "push": "max(contact_force.between)",
    "spread": lambda motion: float(motion["displacement"].max()),
}


def test_a_formula_has_the_names_that_a_motion_of_several_masses_has():
    rig = pounding(LAWS["linear"])
    motion = vi.simulate(rig, 1)
    held = {
        f"{name}.{part}" if dim != "time" else str(name)
        for name in motion.variables
        if "time" in motion[name].dims
        for dim in [motion[name].dims[0]]
        for part in (motion[dim].values if dim != "time" else [""])
    }
    assert held - set(histories_of(rig)) == {"cycle"}


@pytest.mark.parametrize("law", LAWS)
def test_outputs_of_several_masses_are_those_of_their_steady_motions(law):
    rig = pounding(LAWS[law])
    swept = vi.sweep(rig, [1.6, 1.7], "forward", outputs=OWN)
    assert swept["drag"].attrs["units"] == "W"
    several = vi.sweeps([rig, rig], [1.6, 1.7], "forward", outputs=OWN)
    diagram = vi.bifurcation_diagram(
        rig, {"frequency": (1.6, 1.7)}, 2, directions=["up"], outputs=OWN
    )
    motion = vi.steady(rig)
    moved = motion["velocity"].sel(mass="west").values
    expected = {
        "drag": 1500.0 * np.trapezoid(moved**2, motion["time"]) / float(motion["time"][-1]),
        "push": float(motion["contact_force"].max()),
        "spread": float(motion["displacement"].max()),
    }
    assert expected["push"] > 0.0
    for name, value in expected.items():
        for output in (swept[name][0, 1], several[name][1, 0, 1], diagram[name][0, 1]):
            assert float(output) == pytest.approx(value, rel=1e-6)


def share_of_contact(motion: xr.Dataset) -> float:
    return float(vi.contacts(motion)["contact_duration_share"].sum())


def test_a_contact_that_the_start_of_the_period_cuts_is_whole():
    """Of what a motion says of itself, and of both ends of the only cycle in which it begins."""
    own = {"touched": share_of_contact}
    swept = vi.sweep(RIG, np.arange(2.0, 2.65, 0.05), "forward", outputs=own).isel(direction=0)
    branch = vi.branch(RIG, vary={"frequency": (2.0, 2.3)}, outputs=own)
    diagram = vi.bifurcation_diagram(
        RIG, {"frequency": (2.0, 2.3)}, 7, directions=["up"], outputs=own
    )
    cut_at_start = 0
    for frequency, share in zip(swept["frequency"].values, swept["touched"].values, strict=True):
        at = swept.sel(frequency=frequency)
        motion = vi.steady(RIG, at["section"], frequency=float(frequency))
        touching = motion["touching"].any("stop").values
        cut_at_start += bool(touching[0] and touching[-1])
        assert share == pytest.approx(share_of_contact(motion), rel=1e-6)
    assert cut_at_start > 3
    assert float(diagram["touched"][0, -1]) == pytest.approx(
        float(swept["touched"].sel(frequency=2.3, method="nearest")), rel=1e-6
    )
    point = branch.isel(point=int(np.argmin(abs(branch["frequency"].values - 2.25))))
    orbit = vi.orbit(RIG, point["section"], frequency=float(point["frequency"]))
    assert float(point["touched"]) == pytest.approx(share_of_contact(orbit), rel=1e-9)
    assert share_of_contact(orbit) > 0.4


def test_outputs_of_branches_of_several_masses():
    rig = pounding(LAWS["linear"])
    branch = vi.branch(rig, vary={"frequency": (1.65, 1.75)}, outputs={"push": OWN["push"]})
    at = int(np.argmin(abs(branch["frequency"].values - 1.7)))
    point = branch.isel(point=at)
    expected = vi.orbit(rig, point["section"], frequency=float(point["frequency"]))[
        "contact_force"
    ].max()
    assert float(point["push"]) == pytest.approx(float(expected), rel=1e-9)


def test_names_that_several_masses_have_not():
    rig = pounding(LAWS["linear"])
    problem = r"outputs\['p'\]: 'velocity' is neither .* did you mean velocity.west"
    with pytest.raises(vi.InputError, match=problem):
        vi.sweep(rig, [1.7], outputs={"p": "max(velocity)"})


def test_time_means_are_of_the_time_and_numbers_are_kept():
    time = np.array([0.0, 1.0, 3.0])

    def value(text: str) -> float:
        values = {"velocity": np.array([0.0, 2.0, 0.0]), "mass": 4.0}
        return read_output_formula(text, ("velocity",), ("mass",)).value(time, values)

    assert value("mean(velocity)") == pytest.approx(1.0)
    assert value("integral(velocity)") == pytest.approx(3.0)
    assert value("integral(mass)") == pytest.approx(12.0)
    assert value("mean(mass)") == 4.0
    assert value("max(max(velocity, 1))") == 2.0
    assert value("-min(velocity) + 2**3") == 8.0
    assert math.isnan(value("log(0*mass - 1)"))
