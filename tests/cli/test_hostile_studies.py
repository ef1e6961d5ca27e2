"""Study files that are damaged or hostile: one line, and nothing that a terminal obeys."""

import re

import matplotlib as mpl
import pytest

import vibroimpact as vi
from vibroimpact.cli import main
from vibroimpact.figures import resonance_curves, save_figure

RIG = """
[oscillator]
mass = "550 kg"
isolator = { stiffness = "26.8 kN/m", damping = "1.1 kN s/m" }
right = { stiffness = "510 kN/m", damping = "0.9 kN s/m", gap = "7.5 mm" }
[excitation]
amplitude = "0.05 g"
"""
SWEEP = ["--from", "1Hz", "--to", "1.2Hz", "--step", "0.1Hz"]


def study(tmp_path, text, name="study.toml"):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return str(path)


DEEP = "nests tables or lists more than 20 levels deep"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x = " + "[" * 2000 + "]" * 2000 + RIG, DEEP),
        ("x = " + "{a=" * 2000 + "1" + "}" * 2000 + RIG, DEEP),
        ("x" + ".a" * 2000 + " = 1" + RIG, DEEP),
        (RIG.replace('"550 kg"', "1" + "0" * 5000), "a whole number of more than 4300 digits"),
        (RIG.replace('"550 kg"', "1" + "0" * 400), "is not finite"),
        (RIG + "[sweep]\nmax_cycles = 1" + "0" * 30, "sweep.max_cycles"),
        (RIG + "[simulate]\nsamples = 1" + "0" * 30, "simulate.samples"),
        (RIG + "[ensemble]\nseed = 1" + "0" * 30, "ensemble.seed"),
        ('name = "a\\u0000b"' + RIG, "name: 'a\\x00b' has the control character"),
        ('name = "a\\u001b[2J"' + RIG, "name: 'a\\x1b[2J' has the control character"),
        ('name = "' + "n" * 10_000 + '"' + RIG, "name: 10000 characters"),
        ('"k\\u001b[31m" = 1' + RIG, "k\\x1b[31m: unknown key"),
    ],
)
def test_what_cannot_be_read_is_one_line(tmp_path, capsys, text, message):
    assert main(["sweep", study(tmp_path, text), *SWEEP, "-o", str(tmp_path)]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert len(error.splitlines()) == 1
    assert "\x1b" not in error


def test_a_name_is_never_mathematics(tmp_path, capsys):
    path = study(tmp_path, 'name = "bad $\\\\frac$ name"' + RIG)
    assert main(["sweep", path, *SWEEP, "-o", str(tmp_path), "--figure", "svg"]) == 0
    assert "bad $\\frac$ name" in next(tmp_path.glob("bad_frac_name-*-sweep.svg")).read_text()
    capsys.readouterr()


@pytest.mark.full
def test_studies_in_other_scripts_have_files_of_their_own(tmp_path, capsys):
    for name in ("防撞", "隔震"):
        path = study(tmp_path, f'name = "{name}"' + RIG, f"{name}.toml")
        assert main(["sweep", path, *SWEEP, "-o", str(tmp_path)]) == 0
        assert (tmp_path / f"{name}-sweep.nc").is_file()
    output = capsys.readouterr()
    assert "replaced" not in output.out
    (line,) = [line for line in output.err.splitlines() if "隔" in line]
    assert "boxes are drawn" in line


@pytest.mark.full
def test_studies_of_similar_names_have_files_of_their_own(tmp_path, capsys):
    for number, name in enumerate(("a b", "a/b", "a:b")):
        path = study(tmp_path, f'name = "{name}"' + RIG, f"{number}.toml")
        assert main(["sweep", path, *SWEEP, "-o", str(tmp_path)]) == 0
    assert "replaced" not in capsys.readouterr().out
    assert len(list(tmp_path.glob("a_b*-sweep.nc"))) == 3


def test_a_font_that_is_missing_is_reported_once(tmp_path, capsys):
    with mpl.rc_context({"font.family": "No Such Font"}):
        assert main(["sweep", study(tmp_path, RIG), *SWEEP, "-o", str(tmp_path)]) == 0
    lines = [line for line in capsys.readouterr().err.splitlines() if "No Such Font" in line]
    assert 1 <= len(lines) == len(set(lines))
    assert all(line.startswith("vibroimpact: warning: ") for line in lines)


@pytest.mark.full
def test_no_figure_needs_latex(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with mpl.rc_context({"text.usetex": True}):
        axes = resonance_curves(vi.sweep("B2-G1-A3", [1.0, 1.1, 1.2]), title="50 % of $5")
        save_figure(axes[0], tmp_path / "curves.svg")
        assert axes[0]._repr_png_()
    assert "50 % of $5" in re.sub(r"\s+", " ", (tmp_path / "curves.svg").read_text())
