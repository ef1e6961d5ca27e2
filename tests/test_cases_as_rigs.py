"""A case stands where a rig and an amplitude are asked for, in all functions alike."""

from __future__ import annotations

import inspect

import numpy as np
import pint
import pytest
import xarray as xr

import vibroimpact as vi

CODE = "B2-G1-A3"
CASE = vi.laboratory.case(CODE)
RIG, AMPLITUDE = CASE.oscillator, CASE.amplitude
SHAKEN = vi.Harmonic(AMPLITUDE, 2.0)
GRID = [1.0, 2.0]
ALIKE = [CODE, CASE, vi.Rig(RIG, AMPLITUDE), (RIG, AMPLITUDE)]


@pytest.mark.parametrize("case", ALIKE, ids=["code", "case", "rig", "pair"])
def test_sweeps(case):
    expected = vi.sweep(RIG, AMPLITUDE, GRID)
    for found in (
        vi.sweep(case, GRID),
        vi.sweep(case, np.array(GRID)),
        vi.sweep(case, AMPLITUDE, GRID),
        vi.sweep(case, "0.05 g", GRID, ["forward", "backward"]),
        vi.sweep(case, GRID, ["forward", "backward"]),
        vi.sweep(case, frequencies=GRID),
        vi.sweep(case, frequencies=GRID, amplitude="0.05 g"),
        vi.sweep(oscillator=case, frequencies=GRID),
        vi.sweeps([case], GRID).isel(rig=0, drop=True),
        vi.sweeps({"mine": case}, GRID).isel(rig=0, drop=True),
    ):
        xr.testing.assert_equal(found, expected)


def test_another_amplitude_than_that_of_the_case():
    expected = vi.sweep(RIG, "0.04 g", GRID)
    xr.testing.assert_equal(vi.sweep(CODE, "0.04 g", GRID), expected)
    xr.testing.assert_equal(vi.sweep(CODE, frequencies=GRID, amplitude="0.04 g"), expected)


def test_one_rig_where_several_are_asked():
    several = vi.sweeps([CASE], GRID)
    for one in (CODE, CASE, vi.Rig(RIG, AMPLITUDE)):
        np.testing.assert_array_equal(vi.sweeps(one, GRID)["eta_a"], several["eta_a"])
    assert vi.sweeps(["b2-g1-a3"], [2.0])["rig"].item() == CODE
    growth = vi.lyapunov_exponents([CODE], [2.0], cycles=50, transient=50)
    xr.testing.assert_equal(
        growth, vi.lyapunov_exponents({CODE: (RIG, AMPLITUDE)}, [2.0], cycles=50, transient=50)
    )


STUDY = """
name = "found"
[oscillator]
mass = "550 kg"
isolator = { stiffness = "26.8 kN/m", damping = "1.1 kN s/m" }
right = { stiffness = "510 kN/m", damping = "0.9 kN s/m", gap = "7.5 mm" }
%s
[sweep]
step = "0.01 Hz"
"""


@pytest.fixture
def study(tmp_path):
    def write(shaking='[excitation]\namplitude = "0.04 g"'):
        path = tmp_path / "file.toml"
        path.write_text(STUDY % shaking, encoding="utf-8")
        return path

    return write


def test_a_study_file(study):
    path = study()
    bumper = vi.Bumper("510 kN/m", "0.9 kN s/m", gap="7.5 mm")
    rig = vi.Oscillator("550 kg", vi.Isolator("26.8 kN/m", "1.1 kN s/m"), bumper)
    expected = vi.sweep(rig, "0.04 g", GRID)
    for given in (path, str(path)):
        xr.testing.assert_equal(vi.sweep(given, GRID), expected)
        xr.testing.assert_equal(vi.sweep(given, "0.05 g", GRID), vi.sweep(rig, "0.05 g", GRID))
        assert vi.sweeps(given, GRID)["rig"].values.tolist() == ["found"]
        assert vi.sweeps([CODE, given], GRID)["rig"].values.tolist() == [CODE, "found"]
        motion = vi.simulate(given, "2 Hz", 5)
        xr.testing.assert_identical(motion, vi.simulate(rig, vi.Harmonic("0.04 g", 2.0), 5))
    guess = vi.identify(
        expected, path, "stiffness", tried=0, starts=1, profiles=False, amplitude="0.04 g"
    )
    assert vi.fitted(guess).oscillator.right == bumper


def test_a_study_of_a_case(tmp_path):
    path = tmp_path / "one.toml"
    path.write_text(f'case = "{CODE}"\nparameters = "identified"\n', encoding="utf-8")
    expected = vi.sweep(vi.laboratory.case(CODE, "identified"), GRID)
    xr.testing.assert_equal(vi.sweep(path, GRID), expected)


def test_a_study_that_is_shaken_by_several_harmonics_or_not_at_all(study):
    path = study('[excitation]\namplitudes = ["0.03 g", "0.01 g"]')
    shaken = vi.Periodic(1.0, ["0.03 g", "0.01 g"])
    rig = vi.Oscillator("550 kg", vi.Isolator("26.8 kN/m", "1.1 kN s/m"),
                        vi.Bumper("510 kN/m", "0.9 kN s/m", gap="7.5 mm"))  # fmt: skip
    xr.testing.assert_equal(vi.sweep(path, GRID), vi.sweep(rig, shaken, GRID))
    path = study("")
    xr.testing.assert_equal(vi.sweep(path, "0.04 g", GRID), vi.sweep(rig, "0.04 g", GRID))
    with pytest.raises(vi.InputError, match="amplitude: missing, and the rig does not say it"):
        vi.sweep(path, GRID)


@pytest.mark.filterwarnings("ignore::vibroimpact.errors.InputWarning")
def test_a_study_that_cannot_be_used(study, tmp_path):
    with pytest.raises(vi.InputError, match=r"none\.toml' cannot be read .*study file"):
        vi.sweep(str(tmp_path / "none.toml"), GRID)
    with pytest.raises(vi.InputError, match=r"file\.toml': excitation\.amplitud: unknown key"):
        vi.sweep(study('[excitation]\namplitud = "0.04 g"'), GRID)
    with pytest.raises(vi.InputError, match="path of a study file, such as "):
        vi.sweep("somewhere/rig", GRID)
    (tmp_path / "quake.txt").write_text("0.1\n0.2\n0.1\n", encoding="utf-8")
    path = study('[excitation]\nrecord = "quake.txt"\nstep = "0.01 s"\nunit = "g"')
    with pytest.raises(vi.InputError, match="a Record has no period"):
        vi.sweep(path, GRID)
    with pytest.raises(vi.InputError, match="'2 Hz' beside a study whose shaking is a record"):
        vi.simulate(path, "2 Hz", 5)


@pytest.mark.filterwarnings("ignore::vibroimpact.errors.InputWarning")
def test_a_study_that_is_shaken_by_a_record(study, tmp_path):
    (tmp_path / "quake.txt").write_text("0.1\n0.2\n-0.1\n", encoding="utf-8")
    path = study('[excitation]\nrecord = "quake.txt"\nstep = "0.1 s"\nunit = "g"')
    rig = vi.Oscillator("550 kg", vi.Isolator("26.8 kN/m", "1.1 kN s/m"),
                        vi.Bumper("510 kN/m", "0.9 kN s/m", gap="7.5 mm"))  # fmt: skip
    record = vi.Record.read(tmp_path / "quake.txt", step="0.1 s", unit="g")
    xr.testing.assert_equal(vi.simulate(path, tail=1.0), vi.simulate(rig, record, tail=1.0))
    xr.testing.assert_equal(vi.seismic_response(path), vi.seismic_response(rig, record))


@pytest.mark.parametrize("case", [CODE, CASE])
def test_one_motion(case):
    expected = vi.simulate(RIG, SHAKEN, 5)
    for shaken in (SHAKEN, "2 Hz", 2.0, np.float64(2.0)):
        xr.testing.assert_identical(vi.simulate(case, shaken, 5), expected)
    xr.testing.assert_identical(vi.simulate(case, cycles=5, excitation="2 Hz"), expected)
    xr.testing.assert_identical(vi.steady(case, "2 Hz"), vi.steady(RIG, SHAKEN))
    xr.testing.assert_identical(vi.orbit(case, "2 Hz"), vi.orbit(RIG, SHAKEN))
    for found, one in zip(
        vi.coexisting(case, "2 Hz", random=0), vi.coexisting(RIG, SHAKEN, random=0), strict=True
    ):
        xr.testing.assert_identical(found, one)


def test_branches():
    expected = vi.branch(RIG, SHAKEN, low=1.98, high=2.02)
    xr.testing.assert_identical(vi.branch(CODE, "2 Hz", low=1.98, high=2.02), expected)
    diagram = vi.resonance_diagram(RIG, AMPLITUDE, "1.4 Hz", "2 Hz", starts=3)
    for found in (
        vi.resonance_diagram(CODE, "1.4 Hz", "2 Hz", starts=3),
        vi.resonance_diagram(CASE, 1.4, high=2.0, starts=3),
        vi.resonance_diagram(CASE, AMPLITUDE, 1.4, 2.0, starts=3),
        vi.resonance_diagram(CASE, low=1.4, high=2.0, starts=3),
    ):
        xr.testing.assert_identical(found, diagram)
    fold = diagram.isel(bifurcation=0)
    limits = {"parameters": ("frequency", "gap"), "low": (1.4, 7.4e-3), "high": (2.0, 7.6e-3)}
    xr.testing.assert_identical(
        vi.bifurcation_curve(CODE, "2.65 Hz", fold, **limits),
        vi.bifurcation_curve(RIG, vi.Harmonic(AMPLITUDE, 2.65), fold, **limits),
    )


def test_scenarios_and_parameters():
    grid = np.linspace(0.8, 3.0, 12)
    expected = vi.classify(RIG, AMPLITUDE, grid)
    assert vi.classify(CODE, grid).features == expected.features
    assert vi.classify(CASE, frequencies=grid).scenario == expected.scenario
    axes = ("gap", [0.005, 0.02]), ("stiffness_ratio", [2.0, 10.0])
    found = vi.scenario_map(*axes, CODE, step=0.2)
    xr.testing.assert_identical(found, vi.scenario_map(*axes, (RIG, AMPLITUDE), step=0.2))
    assert vi.to_dimensionless(CODE) == vi.to_dimensionless(RIG, AMPLITUDE)


def test_signatures_and_docstrings_stay():
    assert list(inspect.signature(vi.sweep).parameters)[:3] == [
        "oscillator",
        "amplitude",
        "frequencies",
    ]
    assert "Sweep the frequency" in vi.sweep.__doc__


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: vi.sweep("B9-G1-A3", GRID), r"^oscillator: 'B9-G1-A3' is no rig.*bumper 'B9'"),
        (
            lambda: vi.sweep(550.0, AMPLITUDE, GRID),
            r"^oscillator: 550.0 is no rig; an osc",
        ),
        (lambda: vi.sweep("0.05 g", RIG, GRID), r"^oscillator: '0.05 g' .*are swapped; sweep\("),
        (lambda: vi.sweep(GRID, CASE), r"^oscillator: \[1.0, 2.0\] .*are swapped"),
        (lambda: vi.sweep(RIG, GRID, "0.05 g"), r"^frequencies: .0.05 g. is one text"),
        (lambda: vi.sweep(CASE, 2.0), r"^frequencies: 2.0 is not a list"),
        (lambda: vi.sweep(CASE, "2 Hz"), r"^frequencies: '2 Hz' is one text"),
        (lambda: vi.classify(RIG, GRID), r"^amplitude: 2 of them; a scenario is that of one amp"),
        (lambda: vi.simulate(SHAKEN, RIG, 5), r"^oscillator: .*are swapped; simulate\("),
        (lambda: vi.simulate(RIG, 5, SHAKEN), r"^excitation: 5 is no excitation; Harmonic\("),
        (lambda: vi.simulate(RIG, "2 Hz", 5), r"^excitation: '2 Hz' .*beside a laboratory case"),
        (lambda: vi.simulate(CASE, "2 kg", 5), r"'2 kg' is a mass; a frequency"),
        (lambda: vi.simulate(CASE, None, 5), r"^excitation: None is no excitation"),
        (lambda: vi.steady(RIG, RIG), r"^excitation: .* is no excitation"),
        (lambda: vi.sweeps([RIG], GRID), r"^rigs\[0\]: .* is no rig"),
        (lambda: vi.sweeps(3, GRID), r"^rigs: 3 is no rig"),
        (lambda: vi.sweeps(["B9-G1-A3"], GRID), r"^rigs\[B9-G1-A3\]: .*bumper 'B9'"),
        (
            lambda: vi.scenario_map(("gap", [0.01, 0.02]), ("amplitude", [1, 2]), base=RIG),
            r"^base: .* is no rig",
        ),
    ],
)
def test_what_is_no_rig(call, told):
    with pytest.raises(vi.InputError, match=told) as caught:
        call()
    assert "\n" not in str(caught.value)


def test_a_misspelt_keyword_is_that_of_the_function_called():
    for call in (
        lambda: vi.sweep(RIG, AMPLITUDE, GRID, tolerence=1e-9),
        lambda: vi.sweep(CODE, GRID, tolerence=1e-9),
    ):
        with pytest.raises(TypeError, match=r"\bsweep\(\).*tolerence"):
            call()
    with pytest.raises(TypeError, match=r"\bsimulate\(\).*samplse"):
        vi.simulate(CODE, "2 Hz", 5, samplse=1)
    with pytest.raises(vi.InputError, match=r"^frequencies: missing; sweep\(oscillator, .* is acc"):
        vi.sweep(CODE)
    with pytest.raises(
        vi.InputError, match=r"^excitation: missing; simulate\(oscillator, .* is acc"
    ):
        vi.simulate(RIG)
    with pytest.raises(TypeError, match=r"sweep\(\) missing"):
        vi.sweep()


def test_gram_for_gravity():
    mass = pint.UnitRegistry().Quantity("0.05 g")
    with pytest.raises(vi.InputError, match=r'a mass \(pint.s g is the gram\).*"0.05 g"'):
        vi.sweep(RIG, mass, GRID)
    with pytest.raises(vi.InputError, match=r"standard_gravity"):
        vi.Harmonic(mass, 2.0)


def test_records_of_any_size_are_refused_alike():
    with pytest.raises(vi.InputError, match=r"^cycles: 1e\+07 cycles of 256 samples.*20000000"):
        vi.simulate(CODE, "2 Hz", 1e7)
    with pytest.raises(vi.InputError, match=r"^window: .*20000000"):
        vi.steady(CODE, "2 Hz", window=10_000_000)
