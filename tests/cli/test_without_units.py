"""What commands print and draw of a rig without units."""

from __future__ import annotations

import json
import re

import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact.cli import main
from vibroimpact.model.study import read_rig_study
from vibroimpact.model.written_units import unitless

ONE = """
[oscillator]
mass = 1
isolator = { stiffness = 1, damping = 0.1 }
right = { stiffness = 20, damping = 0, gap = 2 }

[excitation]
amplitude = 0.5
"""
UNIT = re.compile(r"\d (?:mm|m|µm|kg|g|mg|t|[kM]?N|[kM]?N/m|k?N s/m|m/s|mm/s|m/s²|Hz|s|[mk]?J)\b")
"""A number with a unit."""


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    path = tmp_path_factory.mktemp("none") / "one.toml"
    path.write_text(ONE)
    return path


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("sweep", "--from", "0.1", "--to", "0.3", "--step", "0.02"), "frequencies from ω = 0.628"),
        (("simulate", "--frequency", "0.2", "--cycles", "5"), "State after 5 cycles (25)"),
        (("branch", "--vary", "frequency=0.1:0.25"), "the range ends at ω = 1.57079633"),
        *sample(
            [
                (("motion", "--frequency", "1 rad/s", "--random", "2"), "ω = 1: "),
                (("branch", "--vary", "gap=1:3", "--frequency", "0.2"), "gap"),
                (("basins", "--frequency", "0.2", "--nodes", "12"), "excursion "),
                (("bifurcation", "--vary", "frequency=0.1:0.2:4"), "largest exponent\n"),
            ],
            [],
        ),
    ],
    ids=lambda words: " ".join(words[:2]) if isinstance(words, tuple) else "",
)
def test_no_unit_is_printed(study, tmp_path, capsys, words, expected):
    command, *options = words
    assert main([command, str(study), *options, "-o", str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    summary = printed.partition("\nFiles\n")[0]
    assert "none; frequencies are angular, ω = 2π f" in summary
    assert expected in summary
    assert not UNIT.findall(summary)
    assert not re.search(r"\((?:mm|m/s|mm/s|N|kN|Hz|g|J|mJ|1/s|N s)\)", summary)
    assert "Hz" not in printed
    assert not unitless()  # any more


def test_a_unit_of_an_option_makes_a_kilogram_of_1(study, tmp_path, capsys):
    words = ("--gap", "2 m", "--from", "0.1", "--to", "0.3", "--step", "0.02")
    assert main(["sweep", str(study), *words, "-o", str(tmp_path)]) == 0
    assert re.search(r"mass +1 kg", capsys.readouterr().out)
    stated = tmp_path / "two.toml"
    stated.write_text(ONE.replace("mass = 1", 'mass = 2\nunits = "none"'))
    assert main(["sweep", str(stated), *words, "-o", str(tmp_path)]) == 2
    assert "--gap: '2 m' has a unit, but the rig has none" in capsys.readouterr().err


def test_json_keeps_hertz_and_says_that_there_are_no_units(study, tmp_path, capsys):
    words = ("--frequency", "0.2", "--cycles", "5", "--json")
    assert main(["simulate", str(study), *words, "-o", str(tmp_path)]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["oscillator"]["units"] == "none"
    assert facts["frequency"] == 0.2


def _none(tmp_path):
    stated = tmp_path / "none.toml"
    stated.write_text(ONE.replace("mass = 1", 'mass = 1\nunits = "none"'))
    return stated


@pytest.mark.parametrize(
    "words",
    [
        ("sweep", "--amplitude", "5mm"),
        ("sweep", "--gap", "2 m"),
        ("branch", "--frequency", "0.2", "--vary", "gap=5mm:3"),
        ("design", "--vary", "gap=5mm:6mm"),
    ],
)
def test_stated_none_refuses_a_unit_of_an_option(tmp_path, capsys, words):
    command, *options = words
    assert main([command, str(_none(tmp_path)), *options, "-o", str(tmp_path)]) == 2
    error = capsys.readouterr().err
    assert "has a unit, but the rig has none" in error
    assert len(error.strip().splitlines()) == 1


@pytest.mark.parametrize("of", ["force", "displacement", "unbalance"])
def test_a_study_states_the_quantity_of_a_plain_amplitude(tmp_path, of):
    path = tmp_path / "one.toml"
    path.write_text(f'{ONE}of = "{of}"\n')
    rig = read_rig_study(path)
    assert rig.oscillator.units == "none"
    assert rig.periodic.of == of
    assert rig.periodic.amplitude == 0.5
    path.write_text(ONE.replace("amplitude = 0.5", f'amplitudes = [0.5, 0.1]\nof = "{of}"'))
    assert read_rig_study(path).periodic.of == of


@pytest.mark.full
def test_an_option_keeps_the_quantity_of_the_study(tmp_path, capsys):
    path = tmp_path / "one.toml"
    path.write_text(f'{ONE}of = "force"\n')
    options = ("--amplitude", "0.7", "--frequency", "0.2", "--cycles", "2", "--json")
    assert main(["simulate", str(path), *options, "-o", str(tmp_path)]) == 0
    printed = json.loads(capsys.readouterr().out)
    data = vi.load(printed["files"]["data"])
    parameters = json.loads(data.attrs["parameters"])
    assert (parameters["of"], parameters["amplitude"]) == ("force", 0.7)


@pytest.mark.parametrize(
    ("excitation", "error"),
    [
        ('of = "forces"', "excitation.of: 'forces'"),
        ('of = "force"\namplitude = "1 mm"', "excitation.amplitude: '1 mm' is a length"),
        ('of = "force"', "of is given without amplitude; add amplitude, or remove of"),
    ],
)
def test_wrong_quantities_of_an_amplitude(tmp_path, excitation, error):
    path = tmp_path / "one.toml"
    path.write_text(ONE.replace("amplitude = 0.5", excitation))
    with pytest.raises(vi.InputError, match=re.escape(error)):
        read_rig_study(path)
