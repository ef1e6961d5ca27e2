"""Study files: what they say, and what is said about mistakes in them."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.cli import main
from vibroimpact.cli.options import RigOptions
from vibroimpact.cli.rig import subject
from vibroimpact.cli.study import read_study

RIG = """
[oscillator]
mass = "550 kg"
isolator = { stiffness = "26.8 kN/m", damping = "1.1 kN s/m" }
right = { stiffness = "510 kN/m", damping = 900, gap = "7.5 mm" }
"""


@pytest.fixture
def write(tmp_path):
    def write(text: str, name: str = "wall.toml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_own_oscillator(write):
    path = write(RIG + '[excitation]\namplitude = "0.05 g"\n')
    what = subject(str(path), RigOptions())
    assert what.oscillator == vi.Oscillator(
        550, vi.Isolator(26800, 1100), vi.Bumper(510e3, 900, 7.5e-3)
    )
    assert what.repeated.amplitude == 0.4903325
    assert what[:2] == ("wall", "wall")


def test_an_own_oscillator_by_period_and_damping_ratio(write):
    text = """
    [oscillator]
    weight = "49.03325 MN"
    isolator = { period = "2.5 s", damping_ratio = 0.15 }
    [excitation]
    amplitude = "0.1 g"
    """
    oscillator = subject(str(write(text)), RigOptions()).oscillator
    assert oscillator == vi.Oscillator(5e6, vi.Isolator.from_period(5e6, 2.5, 0.15))


def test_a_rigid_stop_is_named_by_its_kind(write):
    wall = 'left = { kind = "rigid", restitution = 0.8, gap = "-2 mm" }\n'
    path = write(RIG + wall + "[excitation]\namplitude = 1\n")
    assert subject(str(path), RigOptions()).oscillator.left == vi.RigidStop(0.8, -0.002)


@pytest.mark.parametrize("which", ["identified", "refined"])
def test_case_with_changes(write, which):
    path = write(f'name = "my wall"\ncase = "B2-G1-A3"\nparameters = "{which}"\n')
    what = subject(str(path), RigOptions(gap="9mm"))
    expected = vi.laboratory.case("B2-G1-A3", which).oscillator
    assert what.oscillator.isolator == expected.isolator
    assert what.oscillator.right.gap == 9e-3
    assert what[:2] == ("my wall, gap 9 mm", "my_wall-gap-9mm")
    table = subject(str(path), RigOptions(parameters="table"))
    assert table.oscillator == vi.laboratory.case("B2-G1-A3").oscillator


def test_amplitude_of_the_study_comes_before_that_of_the_case(write):
    path = write('case = "B2-G1-A3"\n[excitation]\namplitude = "0.04 g"\n')
    assert subject(str(path), RigOptions()).repeated.amplitude == 0.392266
    assert subject(str(path), RigOptions(amplitude="0.03 g")).repeated.amplitude == 0.2941995


def test_tables_of_the_commands(write):
    study = read_study(
        write(
            'case = "B2-G1-A3"\n[sweep]\nfrom = "300 mHz"\nto = "4 Hz"\ndirection = "forward"\n'
            "max_cycles = 500\ntolerance = 1e-9\n"
            '[simulate]\nfrequency = "2.5 Hz"\nvelocity = "-10 mm/s"\n'
        )
    )
    assert (study.sweep.start, study.sweep.to, study.sweep.step) == (0.3, 4.0, None)
    assert (study.sweep.direction, study.sweep.max_cycles) == ("forward", 500)
    assert (study.simulate.frequency, study.simulate.velocity) == (2.5, -0.01)


def test_the_ending_may_be_left_out(write, monkeypatch, tmp_path):
    path = write('case = "B2-G1-A3"', "wall.toml")
    assert subject(str(path.with_suffix("")), RigOptions()).name == "wall"
    write('case = "B3-G1-A3"', "B2-G1-A3.toml")
    monkeypatch.chdir(tmp_path)
    assert subject("wall", RigOptions()).name == "wall"
    assert subject("B2-G1-A3", RigOptions()).oscillator.right.stiffness == 510e3  # a case first
    with pytest.raises(vi.InputError, match=r"^case: 'wal' .*study file, NAME.toml"):
        subject("wal", RigOptions())


def test_a_mark_before_the_text(write):
    path = write("\ufeff" + 'case = "B2-G1-A3"')
    assert subject(str(path), RigOptions()).oscillator.right.stiffness == 510e3


def test_all_unknown_keys_are_named_and_no_class_of_python(write):
    path = write('case = "B2-G1-A3"\nform = 1\n[sweep]\nstepp = 1\n[simulate]\nfrequncy = 2\n')
    with pytest.raises(vi.InputError) as caught:
        read_study(path)
    message = str(caught.value)
    for key, meant in (("sweep.stepp", "step"), ("simulate.frequncy", "frequency")):
        assert f"{key}: unknown key; " in message
        assert f"; did you mean {meant}? Use " in message
    assert "form: unknown key; " in message
    for name in ("SweepTable", "SimulateTable", "Study", "ExcitationTable", "Oscillator"):
        assert name not in message
    for text in ('case = "B2-G1-A3"\nsweep = 1', 'name = "x"', 'case = "B2-G1-A3"\noscillator = 3'):
        with pytest.raises(vi.InputError) as caught:
            read_study(write(text))
        assert not any(name in str(caught.value) for name in ("SweepTable", "Study", "Oscillator"))


def test_numbers_that_count_something(write):
    for line in ("[sweep]\nmax_cycles = 0", "[simulate]\nsamples = 0"):
        with pytest.raises(vi.InputError, match=r"(max_cycles|samples): 0 is less than 1$"):
            read_study(write('case = "B2-G1-A3"\n' + line))


def test_a_study_needs_no_ending(write):
    assert subject(str(write('case = "B2-G1-A3"', "study")), RigOptions()).name == "study"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('case = "B2-G1-A3"\n[sweep]\nform = 1', r"sweep.form: unknown key; did you mean from\?"),
        (RIG.replace("mass", "mas"), r"oscillator.mas: unknown key; did you mean mass\?"),
        (
            RIG + '[oscillator.stops.right]\ngap = "7 mm"',
            r"oscillator.stops: unknown key; write each stop as right or left, such as the "
            r"table \[oscillator.right\]",
        ),
        (RIG.replace("gap", "gapp"), r"oscillator.right.gapp: unknown key; did you mean gap\?"),
        (
            RIG.replace("7.5 mm", "15 kg"),
            r"oscillator.right.gap: '15 kg' is a mass; use a length",
        ),
        (
            RIG + 'left = { kind = "hertz" }',
            r"oscillator.left.kind: 'hertz' is unknown; use 'kelvin-voigt', 'rigid', ",
        ),
        (
            RIG.replace('stiffness = "26.8 kN/m"', 'period = "2 s"'),
            r"oscillator.isolator.damping_ratio: missing, but period requires it; add a "
            r"dimensionless",
        ),
        (
            RIG.replace("damping =", 'period = "2 s", damping_ratio = 0.1, damping =', 1),
            r"oscillator.isolator.(stiffness|damping): given together with period; "
            r"remove one of the two",
        ),
        (RIG.replace("550 kg", "550 g"), r"oscillator.mass: '550 g' has a g, which is gravity"),
        (RIG.replace("550", "-550"), r"oscillator.mass: '-550 kg' is not greater than 0"),
        (RIG.replace("900", "nan"), r"oscillator.right.damping: nan is not finite"),
        (RIG + '[sweep]\nfrom = "0 Hz"', r"sweep.from: '0 Hz' is not greater than 0"),
        (
            RIG,
            r"excitation.amplitude: missing; set it in the study, or pass --amplitude, such as "
            r"0.05g \(acceleration\), 2mm \(displacement\) or 500N \(force\)",
        ),
        (RIG + 'parameters = "table"', r"oscillator.parameters: unknown key"),
        ('parameters = "table"' + RIG, r"parameters: this key is only for a laboratory case"),
        ('case = "B2-G1-A3"' + RIG, r"both case and oscillator are given; remove one of them"),
        ('name = "x"', r"neither case nor oscillator is given; add case"),
        ('case = "B9-G1-A3"', r"study .*bumper 'B9' is unknown"),
        ('case = "B2-G1-A3"\n[sweep]\ndirection = "up"', r"sweep.direction: 'up' is unknown"),
        ('case = "B2-G1-A3"\n[sweep]\nfrequencies = 1', r"sweep.frequencies: 1 is not a list"),
        (
            'case = "B2-G1-A3"\n[sweep]\nfrequencies = [1]\nto = 2',
            r"sweep: the list 'frequencies' is given together with 'from', 'to' or 'step'; remove "
            r"either",
        ),
        ("case =\n\n", r"is not valid TOML \(.*line 1"),
    ],
)
def test_mistakes_are_named_with_file_and_path(write, text, message):
    path = write(text)
    with pytest.raises(vi.InputError, match=message) as caught:
        subject(str(path), RigOptions())
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_parameter_set_of_an_own_oscillator(write):
    path = write(RIG + "[excitation]\namplitude = 1")
    with pytest.raises(vi.InputError, match="--parameters: 'table', but"):
        subject(str(path), RigOptions(parameters="table"))


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(vi.InputError, match="No such file"):
        read_study(tmp_path / "none.toml")
    (tmp_path / "folder.toml").mkdir()
    with pytest.raises(vi.InputError, match="cannot be read"):
        read_study(tmp_path / "folder.toml")
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(vi.InputError, match="not UTF-8"):
        read_study(tmp_path / "binary.toml")


class TestWhatShakes:
    """Written in a study and read again, the same object."""

    @pytest.mark.parametrize(
        ("text", "expected"),
        [
            ('amplitude = "0.05 g"', vi.Harmonic("0.05 g", 1.0)),
            ("amplitude = 0.3\nphase = 0.25", vi.Harmonic(0.3, 1.0, 0.25)),
            ('amplitude = "5 mm"\nphase = "90 deg"', vi.Harmonic("5 mm", 1.0, "90 deg")),
            ('amplitude = "120 N"', vi.Harmonic("120 N", 1.0)),
            (
                'amplitudes = ["0.05 g", 0, "0.02 g"]\nphases = [0.0, 0.0, "30 deg"]',
                vi.Periodic(1.0, ["0.05 g", 0, "0.02 g"], [0.0, 0.0, "30 deg"]),
            ),
            ('amplitudes = ["5 mm", "1 mm"]', vi.Periodic(1.0, ["5 mm", "1 mm"])),
            (
                'amplitudes = ["120 N", "40 N"]\nphase = 0.5',
                vi.Periodic(1.0, ["120 N", "40 N"], phase=0.5),
            ),
        ],
    )
    def test_amplitudes_of_every_kind(self, write, text, expected):
        what = subject(str(write(RIG + f"[excitation]\n{text}\n")), RigOptions())
        assert what.shaking == expected
        assert what.shaking.of == expected.of
        assert what.at(2.5) == expected.replace(frequency=2.5)

    def test_a_record_beside_the_study(self, write, tmp_path):
        values = [0.0, 0.3, -0.2, -0.1]
        write("\n".join(map(repr, values)), "quake.csv")
        study = '[excitation]\nrecord = "quake.csv"\nstep = "20 ms"\n{}[simulate]\ntail = "5 s"\n'
        with pytest.raises(vi.InputError, match=r"excitation\.unit: missing, because .* states no"):
            subject(str(write(RIG + study.format(""))), RigOptions())
        path = write(RIG + study.format('unit = "m/s^2"\n'))
        what = subject(str(path), RigOptions())
        assert what.shaking == vi.Record(values, 0.02)
        assert what.study.simulate.tail == 5.0
        with pytest.raises(
            vi.InputError, match=r"^excitation.record: this command needs a periodic excitation"
        ):
            _ = what.repeated

    def test_a_record_of_displacements_with_times(self, write):
        time = np.arange(40) * 0.05
        moved = 3.0 * np.sin(4.0 * time)
        rows = (f"{float(t)!r},{float(x)!r}" for t, x in zip(time, moved, strict=True))
        write("\n".join(["t,x", *rows]), "x.csv")
        path = write(RIG + '[excitation]\nrecord = "x.csv"\nunit = "mm"\n')
        with pytest.warns(
            vi.InputWarning, match="the values are displacements, which were differentiated twice"
        ):
            shaking = subject(str(path), RigOptions()).shaking
        expected = vi.Record.from_displacement(1e-3 * moved, 0.05)
        assert shaking.step == pytest.approx(expected.step, rel=1e-14)
        assert shaking.acceleration == pytest.approx(expected.acceleration, abs=1e-11)

    @pytest.mark.parametrize(
        ("text", "csv", "message"),
        [
            ('step = "1 ms"', "0.1\nnan\n0.2", r"line 2: a value is missing"),
            (
                'step = "1 ms"\nunit = "g"',
                "0.1",
                r"acceleration: 1 given; pass one sequence of at least 2 samples",
            ),
            ("step = 0", "0.1\n0.2", r"excitation.step: 0 is not greater than 0"),
            ('step = "-1 ms"', "0.1\n0.2", r"excitation.step: '-1 ms' is not greater than 0"),
            ("", "0.1\n0.2", r"excitation.step: missing, but .* has no times"),
            ("", "0,1\n0,2", r"its rows of 2 numbers have neither names nor times"),
            (
                'step = 1\nunit = "N"',
                "0.1\n0.2",
                r"excitation.unit: '1 N' is a force; use an acceler",
            ),
            (
                'step = 1\nunit = "mm"',
                "\n".join("0" * 20 + "5" * 20),
                r"displacement\[\d+\]: the displacement jumps or is too rough",
            ),
            (
                'step = 1\namplitude = "0.1 g"',
                "1\n2",
                r"amplitude and record are given together; keep one of",
            ),
        ],
    )
    def test_records_that_cannot_be_used(self, write, capsys, text, csv, message):
        write(csv, "quake.csv")
        path = write(RIG + f'[excitation]\nrecord = "quake.csv"\n{text}\n')
        assert main(("simulate", str(path))) == 2
        output = capsys.readouterr()
        assert output.out == ""
        assert output.err.startswith(f"vibroimpact: error: study {str(path)!r}: excitation")
        assert re.search(message, output.err)
        assert output.err.count("\n") == 1

    @pytest.mark.parametrize(
        ("text", "message"),
        [
            (
                'amplitudes = ["1 mm", "2 mm"]\nphases = [0.0]',
                r"phases: 1 given for 2 amplitudes",
            ),
            (
                'amplitudes = ["0.05 g", "20 N"]',
                r"amplitudes\[1\]: '20 N' is a force; use an acceler",
            ),
            (
                'amplitude = "3 kg"',
                r"amplitude: '3 kg' is a mass; use an acceleration greater than 0",
            ),
            ("phases = [0.0]\namplitude = 1", r"phases is given without amplitudes"),
        ],
    )
    def test_amplitudes_that_cannot_be_used(self, write, capsys, text, message):
        path = write(RIG + f"[excitation]\n{text}\n")
        assert main(("sweep", str(path))) == 2
        error = capsys.readouterr().err
        assert re.search(rf"study '.*': excitation[.:] ?{message}", error)
        assert error.count("\n") == 1
