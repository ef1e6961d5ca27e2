"""What is said about words that cannot be used: in the words of the command line."""

from __future__ import annotations

import shutil
import subprocess

import pytest

from vibroimpact.cli import _app, main

CASE = "B2-G1-A3"
FEW = ("--frequencies", "1Hz,2Hz")


@pytest.fixture
def refused(tmp_path, monkeypatch, capsys):
    """Run words that are refused; return the one line."""
    monkeypatch.chdir(tmp_path)

    def refused(*words: str) -> str:
        assert main(words) == 2
        output = capsys.readouterr()
        assert (output.out, output.err.count("\n")) == ("", 1)
        assert output.err.startswith("vibroimpact: error: ")
        assert "Traceback" not in output.err
        return output.err.removeprefix("vibroimpact: error: ").rstrip("\n")

    return refused


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        (
            ("sweep", CASE, "--set", "isolator.damping=1.2", "kN", "s/m"),
            '--set "isolator.damping=1.2 kN s/m"',
        ),
        (
            ("sweep", CASE, "--set", "stops.damping=900", "N", "s", "m^-1", "--json"),
            '--set "stops.damping=900 N s m^-1"',
        ),
        (("sweep", "--gap", "9", "mm", CASE), '--gap "9 mm"'),
        (("simulate", CASE, "--frequency", "2.5", "Hz"), '--frequency "2.5 Hz"'),
        (("map", "--set", "mass=600", "kg"), '--set "mass=600 kg"'),
    ],
)
def test_values_with_blanks_need_quotes(refused, words, hint):
    assert refused(*words).endswith(f"; put quotes around a value with blanks, as in {hint}")


def test_no_hint_where_none_is_needed(refused):
    assert "quotes" not in refused("sweep", CASE, "more")
    assert "quotes" not in refused("sweep", CASE, "--gap", "1", "--set", "mass=-5kg")
    assert "quotes" not in refused("sweep", "--gap", "1", "B9-G1-A3")


@pytest.mark.parametrize(
    ("words", "begins"),
    [
        (("sweep", CASE, "--max-cycles", "0"), "--max-cycles: 0; pass a whole number"),
        (("sweep", CASE, "--gap", "nan"), "--gap: "),
        (("sweep", CASE, "--gap", "9mm", "--set", "left.gap=nan"), "--set: left.gap: "),
        (("sweep", CASE, "--max-cycles=0"), "--max-cycles: 0; pass a whole number"),
        (("sweep", CASE, "--tolerance", "2"), "--tolerance: 2"),
        (("sweep", CASE, "--threads", "-1"), "--threads: -1"),
        (("sweep", CASE, "--frequencies", "1Hz,0Hz"), "--frequencies[1]: '0Hz'"),
        (
            ("sweep", "B2-G2-A3", "--parameters", "identified"),
            "--parameters: 'identified' exists only for the cases B2-G1-A3 and B2-G2-A2",
        ),
        (("classify", CASE, "--threads", "0"), "--threads: 0"),
        (("branch", CASE, "--vary", "colour=1:2"), "--vary: 'colour'"),
        (("branch", CASE, "--longest", "0"), "--longest: 0"),
        (("map", "--threads", "0"), "--threads: 0"),
    ],
)
def test_options_are_named_as_they_are_written(refused, words, begins):
    assert refused(*words).startswith(begins)


@pytest.mark.parametrize(
    ("words", "advice"),
    [
        (("--unbalance", "0.4 kg m"), 'write it as --amplitude "0.4 kg m"'),
        (("--unbalance=0.4 kg m",), 'write it as --amplitude "0.4 kg m"'),
        (("--F0", "450N"), "write it as --amplitude 450N"),
        (("--force", "450N"), "write it as --amplitude 450N"),
        (("--acceleration", "0.1g"), "write it as --amplitude 0.05g"),
        (("--displacement", "3mm"), "write it as --amplitude 5mm"),
        (("--natural-frequency", "2Hz"), "write its reciprocal as --set isolator_period=2.5s"),
    ],
)
def test_quantities_that_another_option_states(refused, words, advice):
    line = refused("sweep", CASE, *words)
    name = words[0].partition("=")[0]
    assert line == f"Unknown option: {name}; {advice}; see --help"


def test_only_options_of_the_command_are_recommended(refused):
    assert "--amplitude" not in refused("record", "quake.csv", "--force", "450N")


def test_a_suggestion_ends_its_sentence(refused):
    line = refused("sweep", CASE, "--directio", "forward")
    assert line.endswith("Did you mean --direction? See --help")


def test_unused_words_are_told_plainly(refused):
    assert refused("sweep", CASE, "more") == ("'more' is one word too many; see --help")


def test_an_unknown_command_lists_all_of_them(refused):
    line = refused("swep")
    assert line.startswith('Unknown command "swep". Did you mean "sweep"? ')
    listed = line.partition("? Use ")[2].partition("; ")[0].replace(" or ", ", ").split(", ")
    assert len(listed) == 21
    assert set(listed) == {name for name in _app() if not name.startswith("-")}


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_is_installed(tmp_path, monkeypatch, capsys, shell):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("SHELL", f"/bin/{shell}")
    for name in ("XDG_DATA_HOME", "XDG_CONFIG_HOME", "ZSH_CUSTOM", "ZDOTDIR"):
        monkeypatch.delenv(name, raising=False)
    assert main(["--install-completion", "--shell", shell]) == 0
    assert "Completion" in capsys.readouterr().out or "ompletion" in str(list(tmp_path.rglob("*")))
    scripts = "".join(p.read_text() for p in tmp_path.rglob("*") if p.is_file())
    assert "sweep" in scripts
    assert "--amplitude" in scripts


@pytest.fixture(scope="module")
def script(tmp_path_factory):
    """What bash completes words by."""
    home = tmp_path_factory.mktemp("home")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HOME", str(home))
        assert main(["--install-completion", "--shell", "bash"]) == 0
    files = [p for p in home.rglob("vibroimpact") if p.is_file()]
    return next(path for path in files if "complete -F" in path.read_text())


@pytest.mark.skipif(shutil.which("bash") is None, reason="no bash is installed")
@pytest.mark.parametrize(
    ("words", "completed"),
    [
        (["sweep", "stu"], "study.toml"),
        (["record", "qua"], "quake.AT2"),
        (["earthquake", CASE, "quake.AT2", "qua"], "quake.AT2"),
        (["identify", "test.csv", "--rig", "stu"], "study.toml"),
        (["identify", "qua"], "quake.AT2"),
        (["map", "stu"], "study.toml"),
        (["sweep", CASE, "--output", "res"], "results"),
    ],
)
def test_file_names_are_completed(tmp_path, script, words, completed):
    for name in ("study.toml", "quake.AT2"):
        (tmp_path / name).touch()
    (tmp_path / "results").mkdir()
    typed = " ".join(["vibroimpact", *words])
    asked = f"source {script}; COMP_WORDS=({typed}); COMP_CWORD={len(words)}; _vibroimpact"
    done = subprocess.run(
        ["bash", "-c", f'{asked}; printf "%s\\n" "${{COMPREPLY[@]}}"'],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.stdout.split() == [completed], done.stderr


def test_a_name_and_a_value_are_two_words(refused):
    assert refused("design", CASE, "--limit", "penetration=5mm").startswith(
        "--limit: 'penetration=5mm' is one word; write the name and the value as two words: "
        "--limit penetration 5mm"
    )
    assert refused("design", CASE, "--limit", "peak-force").startswith(
        "--limit: a name and a value are required, as two words"
    )


@pytest.mark.parametrize("command", ["sweep", "design", "earthquake"])
def test_titles_of_the_help_fit_into_80_columns(command, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    assert main([command, "--help"]) == 0
    titles = [line for line in capsys.readouterr().out.splitlines() if line.startswith("╭")]
    assert len(titles) > 3
    assert all(line.endswith((" ─╮", "──╮")) for line in titles)
    assert any(line.startswith("╭─ Rig (details: vibroimpact help rigs) ") for line in titles)
