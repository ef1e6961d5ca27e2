"""One command from a file to a report and a rig."""

import json

import pytest

import vibroimpact as vi
from identification.twins import curves
from vibroimpact.cli import main


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    case = vi.laboratory.case("B2-G2-A2", "identified")
    data = curves(case.oscillator, case.amplitude, 0.02, seed=2)
    rows = ["# amplitude = 0.04 g", "f (Hz),sweep,Ed [mm],Ea [g]"]
    for way in ("forward", "backward"):
        one = data.sel(direction=way)
        for f, d, a in zip(one.frequency.values, one.displacement_excursion.values,
                           one.acceleration_excursion.values, strict=True):  # fmt: skip
            rows.append(f"{f},{way},{1e3 * d:.5f},{a / 9.80665:.6f}")
    path = tmp_path_factory.mktemp("test") / "test.csv"
    path.write_text("\n".join(rows))
    return path


def test_one_command_makes_a_report_and_a_rig_that_sweep_takes(file, tmp_path, capsys):
    words = ["identify", str(file), "--rig", "B2-G2-A2", "--free",
             "isolator.stiffness", "--starts", "1",
             "--output", str(tmp_path), "--json"]  # fmt: skip
    assert main(words) == 0
    facts = json.loads(capsys.readouterr().out)
    stiffness = facts["parameters"]["isolator.stiffness"]
    assert abs(stiffness["value"] - 31900.0) < 4.0 * stiffness["standard_error"]
    low, high = stiffness["interval"]
    assert low < stiffness["value"] < high
    assert facts["amplitudes"] == {"test": "0.04 g, from test.csv"}
    assert "0.04 g, from test.csv" in (tmp_path / "B2-G2-A2-fit.md").read_text()
    assert {"report", "markdown", "data"} < set(facts["files"])
    assert any("next test" in line for line in facts["next"])
    study = tmp_path / "B2-G2-A2-fit.toml"
    assert main(["sweep", str(study), "--step", "0.5Hz", "-o", str(tmp_path), "--json"]) == 0


@pytest.mark.full
def test_an_amplitude_replaces_that_of_the_file(file, tmp_path, capsys):
    words = ["identify", str(file), "--rig", "B2-G2-A2", "--free", "gap", "--starts", "1"]
    assert main([*words, "--amplitude", "0.05g", "-o", str(tmp_path), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["amplitudes"]["test"].startswith("0.05 g")


@pytest.mark.full
def test_names_of_files_and_columns_stay_text(file, tmp_path, capsys):
    """They may hold colours of terminals, line breaks and tags."""
    test = tmp_path / "a\x1b[31m\n# b <i>.csv"
    test.write_text(file.read_text().replace("Ea [g]", "Ea \x1b[32m [g]"))
    words = ["identify", str(test), "--rig", "B2-G2-A2", "--free", "gap", "--starts", "1"]
    assert main([*words, "-o", str(tmp_path)]) == 0
    output = capsys.readouterr()
    written = [(tmp_path / f"B2-G2-A2-fit.{ending}").read_text() for ending in ("md", "html")]
    assert r"a\x1b[31m # b" in output.out
    assert r"a\\x1b[31m # b" in written[0]
    assert r"a\x1b[31m # b" in written[1]
    for text in (output.out, output.err, *written):
        assert "\x1b" not in text
        assert "\n# b" not in text
    assert "<i>" not in written[1]


@pytest.mark.full
def test_a_study_need_not_say_the_amplitude_that_the_file_says(file, tmp_path, capsys):
    guess = tmp_path / "guess.toml"
    guess.write_text(
        """
        [oscillator]
        mass = "550 kg"
        isolator = { stiffness = "31 kN/m", damping = "1.1 kN s/m" }
        right = { stiffness = "510 kN/m", damping = "0.9 kN s/m", gap = "10 mm" }
        left = { stiffness = "510 kN/m", damping = "0.9 kN s/m", gap = "10 mm" }
        """
    )
    words = [
        "identify",
        str(file),
        "--rig",
        str(guess),
        "--free",
        "isolator.stiffness",
        "--starts",
        "1",
    ]
    assert main([*words, "-o", str(tmp_path), "--json"]) == 0
    stiffness = json.loads(capsys.readouterr().out)["parameters"]["isolator.stiffness"]
    assert stiffness["value"] == pytest.approx(31900.0, rel=0.01)


@pytest.mark.full
def test_an_amplitude_of_the_study_that_the_file_replaces_is_reported(file, tmp_path, capsys):
    words = [
        "identify",
        str(file),
        "--rig",
        "B2-G2-A3",
        "--free",
        "isolator.stiffness",
        "--starts",
        "1",
    ]
    assert main([*words, "-o", str(tmp_path)]) == 0
    printed = capsys.readouterr()
    line = "the amplitude is 0.04 g, from test.csv; the amplitude of the rig, 0.05 g, is not used"
    assert line in " ".join(printed.err.split())
    assert line in " ".join(printed.out.split())


@pytest.mark.full
def test_an_amplitude_without_a_unit_is_asked_for(file, tmp_path, capsys):
    path = tmp_path / "bare.csv"
    path.write_text(file.read_text().replace("0.04 g", "0.04", 1))
    words = [
        "identify",
        str(path),
        "--rig",
        "B2-G2-A2",
        "--free",
        "isolator.stiffness",
        "--starts",
        "1",
    ]
    assert main([*words, "-o", str(tmp_path)]) == 2
    text = " ".join(capsys.readouterr().err.split())
    assert "amplitude = 0.04 has no unit; pass amplitude= (--amplitude) with a unit" in text
    assert main([*words, "-o", str(tmp_path), "--amplitude", "0.04 g", "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["amplitudes"] == {"bare": "0.04 g, from the call"}
    assert not any("the fit used the amplitude" in line for line in facts["findings"])
    path.write_text(file.read_text().replace("0.04 g", "0.04 m/s^2", 1))
    assert main([*words, "-o", str(tmp_path)]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "amplitude of bare: 0.004079 g, from bare.csv" in text
    assert "the fit used the amplitude 0.004079 g, from bare.csv" in text


def test_the_model_that_wins_has_values_a_report_and_a_study(tmp_path, capsys):
    case = vi.laboratory.case("B2-G2-A2", "identified")
    isolator = vi.PolynomialIsolator("31.9 kN/m", "1.1 kN s/m", cubic=4e7, quintic=0.0)
    rig = vi.Oscillator("550 kg", isolator)
    data = curves(rig, case.amplitude, 0.005, frequencies=[0.8, 1.0, 1.1, 1.2, 1.3, 1.4, 1.6, 2.0])
    vi.save(data.assign_attrs(vibroimpact_version=vi.__version__), tmp_path / "test.nc")
    guess = tmp_path / "guess.toml"
    guess.write_text(
        '[oscillator]\nmass = "550 kg"\n'
        'isolator = { stiffness = "35 kN/m", damping = "1.1 kN s/m" }\n'
    )
    words = [
        "identify",
        str(tmp_path / "test.nc"),
        "--rig",
        str(guess),
        "--free",
        "isolator.stiffness",
        "--bounds",
        "isolator.stiffness",
        "20e3:50e3",
        "--compare",
        "softening",
        "--starts",
        "1",
    ]
    assert main([*words, "-o", str(tmp_path), "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    best = facts["best_model"]
    assert best["model"] == "softening"
    for name, value in (("isolator.stiffness", 31900.0), ("isolator.cubic", 4e7)):
        parameter = best["parameters"][name]
        low, high = parameter["interval"]
        assert low < parameter["value"] < high
        assert abs(parameter["value"] - value) < 4.0 * parameter["standard_error"]
    assert {"softening: report", "softening: data"} < set(facts["files"])
    assert "isolator.cubic" in (tmp_path / "guess-fit-softening.toml").read_text()


def test_a_model_that_the_rig_cannot_have_is_refused_before_the_fit(file, tmp_path, capsys):
    rig = tmp_path / "wall.toml"
    rig.write_text(
        '[oscillator]\nmass = "550 kg"\n'
        'isolator = { stiffness = "31 kN/m", damping = "1.1 kN s/m" }\n'
        'right = { kind = "rigid", restitution = 0.8, gap = "10 mm" }\n'
    )
    words = ["identify", str(file), "--rig", str(rig), "--free", "gap", "--compare", "hertz"]
    assert main([*words, "-o", str(tmp_path)]) == 2
    assert "it has no linear bumper" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--free", "gap", "--compare", "plastic"], "--compare"),
        (
            ["--free", "gap", "--bounds", "isolator.stiffness", "1:2"],
            "is not one of the free parameters, gap",
        ),
        (
            ["--free", "gap", "--bounds", "gap", "2"],
            "pass the lowest and the highest value with a colon",
        ),
        (["--free", "nothing"], "free: 'nothing'"),
        (["--free", "stops.stifness,gap"], "did you mean stops.stiffness?"),
        (["--free", "stiffness"], "did you mean 'isolator.stiffness' or 'stops.stiffness'?"),
    ],
)
def test_wrong_words_are_told(file, tmp_path, capsys, words, message):
    line = ["identify", str(file), "--rig", "B2-G2-A2", "-o", str(tmp_path), *words]
    assert main(line) == 2
    assert message in capsys.readouterr().err
