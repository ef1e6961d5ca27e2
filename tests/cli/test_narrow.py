"""Terminals of 80 and 60 columns: words move to other lines, none is cut."""

from __future__ import annotations

import contextlib
import io
import re
from collections import Counter

import pytest

from samples import sample
from vibroimpact.cli import main


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def words(text: str) -> Counter[str]:
    return Counter(re.sub("\x1b\\[[0-9;]*m", "", text).split())


@pytest.fixture
def run_at(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def run_at(columns: int, *line: str) -> str:
        monkeypatch.setenv("COLUMNS", str(columns))
        with contextlib.redirect_stdout(Terminal()) as out:
            assert main(line) == 0
        return out.getvalue().replace(" (replaced)", "")

    return run_at


@pytest.mark.parametrize(
    "line",
    [
        ("sweep", "B2-G1-A3", "--step", "0.05Hz", "--set", "left.damping=1234567.89 N s/m"),
        *sample(
            [
                ("simulate", "B2-G1-A3", "--frequency", "2.5Hz", "--set", "left.gap=9.12345mm"),
                ("motion", "B3-10mm-A3", "--frequency", "1.12Hz", "--random", "0"),
                ("branch", "B2-G1-A3", "--vary", "frequency=1.6Hz:1.8Hz"),
                ("classify", "B2-G1-A3"),
            ],
            [],
        ),
    ],
    ids=lambda line: line[0],
)
def test_no_digit_is_lost(run_at, line):
    wide = run_at(200, *line)
    assert "…" not in wide
    for columns in (80, 60):
        assert words(run_at(columns, *line)) == words(wide)


def test_a_long_path_is_whole(run_at):
    name = "a-name-of-a-file-that-is-longer-than-any-terminal-is-wide-"
    text = run_at(60, "sweep", "B2-G1-A3", "--frequencies", "1Hz,2Hz", "--name", name)
    assert f"  out/{name.rstrip('.')}-sweep.txt\n" in text


@pytest.mark.parametrize("columns", [80, 60])
@pytest.mark.parametrize("command", ["sweep", "motion", "map"])
def test_help_is_whole(run_at, command, columns):
    narrow = run_at(columns, command, "--help")
    assert "…" not in narrow
    for option in re.findall(r"--[a-z-]+", run_at(200, command, "--help")):
        assert option in narrow
