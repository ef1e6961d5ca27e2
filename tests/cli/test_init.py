"""``vibroimpact init`` writes study files that run as they are."""

from __future__ import annotations

import re
from importlib.resources import files
from pathlib import Path
from typing import get_args

import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact.cli import main
from vibroimpact.cli.init import Kind
from vibroimpact.cli.study import read_study

KINDS = get_args(Kind)


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_runs_as_it_is(kind, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["init", "start.toml", "--kind", kind]) == 0
    out = capsys.readouterr().out
    assert out.splitlines()[-1] == "wrote start.toml"
    text = Path("start.toml").read_text(encoding="utf-8")
    assert "{" not in re.sub(r"= \{.*?\}", "", text)  # no name was left open
    read_study(Path("start.toml"))
    commands = re.findall(r"^#   vibroimpact (\w+) (start\S*)((?: --\S+(?: \S+)?)*)", text, re.M)
    assert len(commands) >= 2
    assert main(["simulate", "start.toml"]) == 0
    if kind == "frame":
        assert main(["init", "other.toml", "--kind", "record"]) == 0
    capsys.readouterr()
    done = ["simulate"]
    for command, file, options in commands:
        words = [command, file, *options.split()]
        if command == "earthquake" and kind == "frame":
            words.insert(2, "other-record.csv")
        if command in sample(("branch", "motion"), ("branch", "motion", "sweep", *done)):
            continue  # of the same rigs as `simulate`, and slower
        done.append(command)
        assert main(words) == 0, words
    assert "error" not in capsys.readouterr().err


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_shows_contacts(kind, tmp_path):
    path = tmp_path / "start.toml"
    assert main(["init", str(path), "--kind", kind]) == 0
    rig = read_study(path).rig(path)
    if kind == "record":
        motion = vi.simulate(rig, tail=5.0)
    else:
        study = read_study(path).simulate
        motion = vi.simulate(rig, study.cycles, frequency=study.frequency)
    assert (motion["event_contact"] >= 1).any()


def test_the_isolators_of_the_frame_that_are_comments(tmp_path):
    """Each is read if it replaces the first one, without an assumption."""
    path = tmp_path / "start.toml"
    assert main(["init", str(path), "--kind", "frame"]) == 0
    text = path.read_text(encoding="utf-8")
    first = re.search(r"^isolator = .*\n", text, re.M)[0]
    others = re.findall(r"^# (isolator = .*\n)", text, re.M)
    laws = []
    for other in others:
        path.write_text(text.replace(first, other, 1), encoding="utf-8")
        laws.append(read_study(path).rig(path).system.links["isolator"].law)
    lead = vi.BilinearIsolator.from_strength("1000 t", "500 kN", "1 cm", "2.5 s")
    assert laws == [vi.FrictionIsolator.from_pendulum("1000 t", "1.5 m", 0.05), lead]


def test_the_files_and_the_choices_are_the_same():
    stored = {path.name for path in files("vibroimpact.cli").joinpath("study_files").iterdir()}
    assert stored == {f"{kind}.toml" for kind in KINDS}


def test_nothing_is_replaced(tmp_path, capsys):
    path = tmp_path / "start.toml"
    path.write_text("mine", encoding="utf-8")
    assert main(["init", str(path)]) == 2
    assert "exists already" in capsys.readouterr().err
    assert path.read_text(encoding="utf-8") == "mine"
    other = tmp_path / "other.toml"
    (tmp_path / "other-record.csv").write_text("mine", encoding="utf-8")
    assert main(["init", str(other), "--kind", "record"]) == 2
    assert not other.exists()


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["start.csv"], "'start.csv' does not end in .toml"),
        (["start.toml", "--kind", "bridge"], "bridge"),
        (["nowhere/start.toml"], "nowhere"),
        ([], "FILE"),
    ],
)
def test_wrong_input_is_one_line(words, named, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["init", *words]) == 2
    output = capsys.readouterr()
    assert output.err.count("\n") == 1
    assert named in output.err
    assert list(tmp_path.iterdir()) == []
