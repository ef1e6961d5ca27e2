"""What stands for a rig is one thing, and the first argument of all functions."""

from __future__ import annotations

import json
import pickle

import numpy as np
import pint
import pytest
import xarray as xr

import arguments
import vibroimpact as vi
from vibroimpact.scenarios.classify import classify

CODE = "B2-G1-A3"
CASE = vi.laboratory.case(CODE)
OSCILLATOR, AMPLITUDE = CASE.oscillator, CASE.amplitude
SHAKEN = vi.Harmonic(AMPLITUDE, 2.0)
GRID = [1.0, 2.0]


@pytest.mark.parametrize("rig", [CODE, CASE, vi.Rig(OSCILLATOR, AMPLITUDE)])
def test_sweeps(rig):
    expected = vi.sweep(vi.Rig(OSCILLATOR, "0.05 g"), GRID)
    for curves in (
        vi.sweep(rig, GRID),
        vi.sweep(rig, np.array(GRID), ["forward", "backward"]),
        vi.sweep(rig=rig, frequencies=GRID),
        vi.sweeps([rig], GRID).isel(rig=0, drop=True),
        vi.sweeps({"mine": rig}, GRID).isel(rig=0, drop=True),
        vi.sweeps((one for one in [rig]), GRID).isel(rig=0, drop=True),
    ):
        xr.testing.assert_equal(curves, expected)


def test_names_of_rigs():
    assert vi.sweeps(["b2-g1-a3"], [2.0])["rig"].item() == CODE
    named = vi.Rig(OSCILLATOR, AMPLITUDE, name="mine")
    assert vi.sweeps([named, CODE], [2.0])["rig"].values.tolist() == ["mine", CODE]
    growth = vi.lyapunov_exponents(CODE, [2.0], cycles=50, transient=50)
    again = vi.lyapunov_exponents({CODE: named}, [2.0], cycles=50, transient=50)
    xr.testing.assert_equal(growth, again)


def test_one_motion():
    rig = vi.Rig(OSCILLATOR, SHAKEN)
    expected = vi.simulate(rig, 5)
    for one in (CODE, CASE):
        for frequency in ("2 Hz", 2.0, np.float64(2.0)):
            motion = vi.simulate(one, 5, frequency=frequency)
            xr.testing.assert_identical(motion, expected)
    xr.testing.assert_identical(vi.simulate(CASE.rig.at("2 Hz"), 5), expected)
    xr.testing.assert_identical(vi.steady(CODE, frequency=2.0), vi.steady(rig))
    xr.testing.assert_identical(vi.orbit(CODE, frequency=2.0), vi.orbit(rig))
    other = vi.steady(rig, frequency=1.5)
    xr.testing.assert_identical(other, vi.steady(vi.Rig(OSCILLATOR, vi.Harmonic(AMPLITUDE, 1.5))))


def test_branches():
    rig = vi.Rig(OSCILLATOR, SHAKEN)
    expected = vi.branch(rig, vary={"frequency": (1.98, 2.02)})
    branch = vi.branch(CODE, frequency=2.0, vary={"frequency": ("1.98 Hz", "2.02 Hz")})
    xr.testing.assert_identical(not_published(branch), expected)
    lowest = vi.branch(CODE, vary={"frequency": (1.98, 2.02)})
    assert float(lowest["frequency"].min()) == pytest.approx(1.98)
    diagram = vi.resonance_diagram(rig, {"frequency": (1.4, 2.0)}, starts=3)
    again = vi.resonance_diagram(CODE, {"frequency": ("1.4 Hz", "2 Hz")}, starts=3)
    xr.testing.assert_identical(not_published(again), diagram)


def not_published(data: xr.Dataset) -> xr.Dataset:
    """As of a rig that is no published case, which is all that a code tells besides."""
    parameters = json.loads(data.attrs["parameters"])
    assert parameters.pop("published") is True
    return data.assign_attrs(parameters=json.dumps(parameters))


def test_scenarios_and_parameters():
    grid = np.linspace(0.8, 3.0, 12)
    rig = vi.Rig(OSCILLATOR, AMPLITUDE)
    assert classify(CODE, grid).features == classify(rig, grid).features
    axes = {"gap": [0.005, 0.02], "stiffness_ratio": [2.0, 10.0]}
    scenarios = vi.scenario_map(CODE, axes, step=0.2)
    xr.testing.assert_identical(scenarios, vi.scenario_map(rig, axes, step=0.2))
    assert vi.to_dimensionless(CODE) == vi.to_dimensionless(rig)


STUDY = """
name = "studied rig"
[oscillator]
mass = "550 kg"
isolator = { stiffness = "26.8 kN/m", damping = "1.1 kN s/m" }
right = { stiffness = "510 kN/m", damping = "0.9 kN s/m", gap = "7.5 mm" }
%s
[sweep]
step = "0.01 Hz"
"""
STUDIED = vi.Oscillator(
    "550 kg",
    vi.Isolator("26.8 kN/m", "1.1 kN s/m"),
    vi.Bumper("510 kN/m", "0.9 kN s/m", gap="7.5 mm"),
)


@pytest.fixture
def study(tmp_path):
    def write(shaking='[excitation]\namplitude = "0.04 g"'):
        path = tmp_path / "file.toml"
        path.write_text(STUDY % shaking, encoding="utf-8")
        return path

    return write


def test_a_study_file(study):
    path = study()
    expected = vi.sweep(vi.Rig(STUDIED, "0.04 g"), GRID)
    for source in (path, str(path)):
        xr.testing.assert_equal(vi.sweep(source, GRID), expected)
        assert vi.sweeps([CODE, source], GRID)["rig"].values.tolist() == [CODE, "studied rig"]
        motion = vi.simulate(source, 5, frequency="2 Hz")
        one = vi.simulate(vi.Rig(STUDIED, vi.Harmonic("0.04 g", 2.0)), 5)
        xr.testing.assert_identical(motion, one)
    guess = vi.identify(path, expected, "isolator.stiffness", tried=0, starts=1, profiles=False)
    assert vi.fitted_rig(guess).oscillator.right == STUDIED.right


def test_a_study_of_a_case(tmp_path):
    path = tmp_path / "one.toml"
    path.write_text(f'case = "{CODE}"\nparameters = "identified"\n', encoding="utf-8")
    expected = vi.sweep(vi.laboratory.case(CODE, "identified"), GRID)
    xr.testing.assert_equal(vi.sweep(path, GRID), expected)


def test_a_study_that_is_shaken_by_several_harmonics_or_not_at_all(study):
    path = study('[excitation]\namplitudes = ["0.03 g", "0.01 g"]')
    rig = vi.Rig(STUDIED, vi.Periodic(1.0, ["0.03 g", "0.01 g"]))
    xr.testing.assert_equal(vi.sweep(path, GRID), vi.sweep(rig, GRID))
    with pytest.raises(vi.InputError, match=r"^frequency: missing, and the rig does not state it"):
        vi.steady(path)
    with pytest.raises(vi.InputError, match=r"^shaking: missing, and the rig has no shaking"):
        vi.sweep(study(""), GRID)


@pytest.mark.filterwarnings("ignore::vibroimpact.errors.InputWarning")
def test_a_study_that_is_shaken_by_a_record(study, tmp_path):
    (tmp_path / "quake.txt").write_text("0.1\n0.2\n-0.1\n", encoding="utf-8")
    path = study('[excitation]\nrecord = "quake.txt"\nstep = "0.1 s"\nunit = "g"')
    record = vi.Record.read(tmp_path / "quake.txt", step="0.1 s", unit="g")
    rig = vi.Rig(STUDIED, record)
    xr.testing.assert_equal(vi.simulate(path, tail=1.0), vi.simulate(rig, tail=1.0))
    xr.testing.assert_equal(vi.seismic_response(path), vi.seismic_response(rig))
    for call in (
        lambda: vi.sweep(path, GRID),
        lambda: vi.steady(rig),
        lambda: vi.simulate(path, 5, frequency="2 Hz"),
    ):
        with pytest.raises(vi.InputError, match=r"^shaking: a Record has no period"):
            call()


RECORD = vi.Record([0.1, 0.2], 0.01)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: vi.sweep("B9-G1-A3", GRID), r"^rig: 'B9-G1-A3' is not a rig; .*bumper 'B9'"),
        (lambda: vi.sweep(OSCILLATOR, GRID), r"^rig: an Oscillator alone has no shaking"),
        (lambda: vi.sweep(SHAKEN, GRID), r"^rig: a Harmonic alone has no oscillator"),
        (
            lambda: vi.sweep(GRID, CASE),
            r"^rig: \[1.0, 2.0\] is not a rig; pass a Rig, a laboratory",
        ),
        (lambda: vi.sweep(None, GRID), r"^rig: None is not a rig"),
        (lambda: vi.sweep("somewhere/rig", GRID), "path of a study file, such as "),
        (lambda: vi.sweep("none.toml", GRID), r"none\.toml' cannot be read .*study file"),
        (lambda: vi.sweep(CASE, 2.0), r"^frequencies: 2.0 is not a list"),
        (lambda: vi.sweep(CASE, "2 Hz"), r"^frequencies: '2 Hz' is not a list; pass a list"),
        (lambda: vi.simulate(CASE, 5), r"^frequency: missing, and the rig does not state it"),
        (lambda: vi.simulate(CASE, 5, frequency="2 kg"), r"'2 kg' is a mass; use a frequency"),
        (lambda: vi.seismic_response(CASE), r"^shaking: Harmonic\(.*is not a Record"),
        (lambda: vi.sweeps([OSCILLATOR], GRID), r"^rigs\[0\]: an Oscillator alone"),
        (lambda: vi.sweeps(3, GRID), r"^rigs: 3 is not a rig"),
        (lambda: vi.sweeps([], GRID), r"^rigs: the list is empty"),
        (lambda: vi.sweeps(["B9-G1-A3"], GRID), r"^rigs\[0\]: .*bumper 'B9'"),
        (lambda: vi.Rig(SHAKEN, OSCILLATOR), r"^system: a Harmonic is a shaking, which is"),
        (
            lambda: vi.Rig(550.0, AMPLITUDE),
            r"^system: 550.0 is not an Oscillator or an Assembly; write Rig\(",
        ),
        (lambda: vi.Rig(OSCILLATOR, OSCILLATOR), r"^shaking: .* is not an excitation; write Rig\("),
        (lambda: vi.Rig(OSCILLATOR, -1.0), r"^shaking: -1"),
        (lambda: vi.Rig(OSCILLATOR, "2 kg"), r"^shaking: '2 kg' is a mass"),
        (lambda: vi.Rig(OSCILLATOR, []), r"^shaking: the list is empty"),
        (lambda: vi.Rig(OSCILLATOR, RECORD, 2.0), r"^frequency: 2 Hz, but the shaking is a Record"),
        (
            lambda: vi.classify_scenario(vi.Rig(OSCILLATOR, [0.1, 0.2])),
            r"^shaking: 2 amplitudes, but a scenario is defined for one amplitude",
        ),
        (
            lambda: vi.branch(CASE, vary={"frequency": (2.0, 1.0)}),
            r"^vary\['frequency'\]: the first value, 2 Hz, is not below the second, 1 Hz",
        ),
        (
            lambda: vi.branch(CASE, frequency=2.0, vary={"frequency": 2.0}),
            r"^vary\['frequency'\]: 2.0; pass the lowest and the high",
        ),
    ],
)
def test_what_is_not_a_rig(call, message):
    with pytest.raises(vi.InputError, match=message) as caught:
        call()
    assert "\n" not in str(caught.value)


LISTED = [2.0, 1.0]
TAKES_A_LIST = {"sweep", "sweeps", "lyapunov_exponents"}
"""Functions with frequencies, to which the amplitudes of a list belong one by one."""
IGNORES_SHAKING = {
    "demands",
    "design_chart",
    "identify",
    "least_acceleration",
    "modes",
    "required_gap",
    "seismic_response",
}
"""Functions of records, of measured data or of the system alone, as they are called here."""


def _takes_a_rig():
    for name in arguments.public():
        keys = {"rig", "rigs"} & set(arguments.parameters(name))
        if keys and name not in TAKES_A_LIST | IGNORES_SHAKING | {"Rig"}:
            yield name, *keys


@pytest.mark.parametrize(("name", "key"), [*_takes_a_rig()])
def test_one_of_several_amplitudes_is_never_chosen(name, key, tmp_path):
    """A list has one amplitude for each frequency of a sweep, and no other function knows which."""
    function, keywords = arguments.calls(tmp_path).get(name, (getattr(vi, name), {}))
    keywords = {**keywords, key: vi.Rig(arguments.rig(), LISTED)}
    with pytest.raises(
        vi.InputError, match=r"^(shaking|amplitude): (a list of )?2 ampl.* pass one"
    ):
        function(**keywords)


@pytest.mark.parametrize(
    ("oscillator", "listed"),
    [
        (OSCILLATOR, ["0.05 g", "0.04 g"]),
        (OSCILLATOR, ["5 mm", "4 mm"]),
        (OSCILLATOR, ["120 N", "100 N"]),
        (OSCILLATOR, ["0.4 kg m", "0.1 kg m"]),
        (OSCILLATOR, [0.25, 0.5]),
        (vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), units="none"), [0.25, 0.5]),
    ],
)
def test_the_example_in_the_message_about_a_list_works_as_it_stands(oscillator, listed):
    """It is the first amplitude of the list, in the quantity and the units of the rig."""
    with pytest.raises(vi.InputError) as caught:
        vi.steady(vi.Rig(oscillator, listed), frequency="2 Hz")
    example = str(caught.value).split("such as ")[1]
    rig = eval(example, {"Rig": vi.Rig, "oscillator": oscillator})
    assert rig.periodic.of == vi.Rig(oscillator, listed[0]).periodic.of
    assert rig.amplitude == pytest.approx(vi.Rig(oscillator, listed[0]).amplitude, rel=1e-5)
    assert vi.simulate(rig, 1, frequency="2 Hz")["status"] == 0


def test_functions_of_a_motion_need_one_amplitude():
    assert {name for name, _ in _takes_a_rig()} >= {"steady", "simulate", "orbit", "branch"}
    rig = vi.Rig(arguments.rig(), LISTED)
    for call in (
        lambda: rig.at("5 Hz"),
        lambda: rig.amplitude,
        lambda: vi.Rig(arguments.rig(), LISTED, "5 Hz"),
        lambda: vi.required_gap(rig),
        lambda: vi.design_chart(rig, {"gap": [0.01, 0.02]}),
    ):
        with pytest.raises(vi.InputError, match=r"2 amplitudes.*pass one amplitude"):
            call()
    with pytest.raises(vi.InputError, match=r"^shaking: 2 amplitudes for 3 frequencies"):
        vi.lyapunov_exponents(rig, [1.0, 1.2, 1.5], cycles=10, transient=0)


def test_exponents_have_the_amplitude_of_each_frequency():
    grid = [1.2, 1.5]
    growth = vi.lyapunov_exponents(vi.Rig(OSCILLATOR, [0.4, 0.1]), grid, cycles=40, transient=300)
    for frequency, size in zip(grid, (0.4, 0.1), strict=True):
        alone = vi.lyapunov_exponents(
            vi.Rig(OSCILLATOR, size), [frequency], cycles=40, transient=300
        )
        here = growth.sel(frequency=[frequency])
        np.testing.assert_array_equal(here["exponents"], alone["exponents"])
    assert '"amplitude": [0.4, 0.1]' in growth.attrs["parameters"]


def test_a_list_is_shown_as_one():
    rig = vi.Rig(OSCILLATOR, ["0.05 g", "0.04 g"])
    assert str(rig).endswith("shaking=(0.05 g, 0.04 g))")
    assert "(0.05 g, 0.04 g)" in rig._repr_html_()


def test_a_sweep_of_a_list_states_no_amplitude_of_a_fit():
    swept = vi.sweep(vi.Rig(OSCILLATOR, [0.3, 0.4]), GRID)
    with pytest.raises(vi.InputError, match=r"^data: 2 amplitudes.*one amplitude"):
        vi.identify(vi.Rig(OSCILLATOR, 0.4), swept, "stiffness", tried=0, starts=1, profiles=False)


def test_a_rig_shows_what_it_is_and_travels():
    for rig in (
        vi.Rig(OSCILLATOR, "0.05 g"),
        vi.Rig(OSCILLATOR, ["0.05 g", "0.04 g"]),
        vi.Rig(OSCILLATOR, SHAKEN, name="one"),
        vi.Rig(OSCILLATOR),
    ):
        names = {name: getattr(vi, name) for name in ("Rig", "Oscillator", "Isolator", "Bumper")}
        assert eval(repr(rig), {**names, "Harmonic": vi.Harmonic}) == rig
        assert pickle.loads(pickle.dumps(rig)) == rig
        assert "Rig" in rig._repr_html_()
    assert str(vi.Rig(OSCILLATOR, "5 mm")).endswith("shaking=5 mm)")
    assert CASE.rig.frequency is None
    assert CASE.rig.at("2 Hz").frequency == 2.0
    assert CASE.rig.at("2 Hz").name == CODE


def test_a_misspelt_keyword_is_that_of_the_function_called():
    with pytest.raises(TypeError, match=r"\bsweep\(\).*tolerence"):
        vi.sweep(CODE, GRID, tolerence=1e-9)
    with pytest.raises(TypeError, match=r"sweep\(\) missing"):
        vi.sweep(CODE)


def test_gram_for_gravity():
    mass = pint.UnitRegistry().Quantity("0.05 g")
    with pytest.raises(
        vi.InputError, match=r'is a mass, because g is the gram in pint; .*"0.05 g"'
    ):
        vi.Rig(OSCILLATOR, mass)
    with pytest.raises(vi.InputError, match=r"standard_gravity"):
        vi.Harmonic(mass, 2.0)


def test_records_of_any_size_are_refused_alike():
    with pytest.raises(vi.InputError, match=r"^cycles: 1e\+07 cycles of 256 samples.*20000000"):
        vi.simulate(CODE, 1e7, frequency="2 Hz")
    with pytest.raises(vi.InputError, match=r"^window: .*20000000"):
        vi.steady(CODE, frequency="2 Hz", window=10_000_000)


def test_a_free_vibration_has_an_amplitude_of_0():
    """The frequency only counts its cycles; a resonance curve of it would mean nothing."""
    free = vi.Rig(vi.Oscillator(1.0, vi.Isolator(4.0 * np.pi**2, 0.0)), vi.Harmonic(0.0, 0.5))
    end = vi.simulate(free, 1, vi.State(0.3, 0.0), samples=0)["final_state"]
    assert float(end.sel(component="displacement")) == pytest.approx(0.3, rel=1e-12)
    with pytest.raises(vi.InputError, match="amplitude greater than 0"):
        vi.sweep(free, [1.0, 2.0])
