"""The examples run as they are."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from vibroimpact.cli import main

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_first_sweep(tmp_path):
    script = EXAMPLES / "first_sweep.py"
    done = subprocess.run(
        [sys.executable, "-W", "error", script, tmp_path / "out"], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert "forward sweep jumps down between 2.65 and 2.66 Hz" in done.stdout
    assert "backward sweep jumps up between 1.68 and 1.67 Hz" in done.stdout
    assert (tmp_path / "out/B2-G1-A3-sweep.png").is_file()
    assert (tmp_path / "out/B2-G1-A3-sweep.nc").is_file()


@pytest.mark.full
def test_study(tmp_path, capsys):
    for command in ("sweep", "simulate"):
        assert main([command, str(EXAMPLES / "study.toml"), "-o", str(tmp_path)]) == 0
    assert "moat-wall" in capsys.readouterr().out
    assert {p.name for p in tmp_path.iterdir()} == {
        *(f"moat-wall-sweep.{ending}" for ending in ("nc", "png", "txt")),
        *(f"moat-wall-1.5Hz-history.{ending}" for ending in ("nc", "png")),
    }
