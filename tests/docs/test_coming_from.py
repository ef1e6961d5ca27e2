"""What the pages for users of other programs show of these runs where they are installed."""

from __future__ import annotations

import contextlib
import io
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

import samples
from benchmarks.peers import auto07
from docs.snippets import ROOT

PAGES = ROOT / "docs" / "coming-from"
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks(page: str) -> list[tuple[str, str]]:
    return BLOCK.findall((PAGES / page).read_text(encoding="utf-8"))


def test_opensees() -> None:
    pytest.importorskip(
        "benchmarks.peers.opensees_peer", reason="OpenSeesPy is absent", exc_type=ImportError
    )
    script: dict[str, Any] = {}
    parts = blocks("opensees.md")
    for (kind, code), (_, shown) in zip(parts[::2], parts[1::2], strict=True):
        with contextlib.redirect_stdout(io.StringIO()) as out:
            exec(code, script)
        assert kind in ("python", "py")
        assert out.getvalue() == shown
    numbers = [float(text) for text in re.findall(r"([\d.]+) mm", out.getvalue())]
    ours = 1e3 * float(script["response"]["peak_displacement"])
    errors = [abs(number / ours - 1.0) for number in numbers]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 1e-4


def test_octave_runs_the_file_for_matlab(tmp_path: Path) -> None:
    octave = shutil.which("octave-cli")
    if octave is None or not samples.full:
        pytest.skip("GNU Octave is absent" if octave is None else "it takes seconds; --full")
    (_, ours), (_, code), (_, shown) = blocks("matlab-ode45.md")[1:]
    (tmp_path / "stops.m").write_text(code)
    said = re.search(
        r"^`(\[x, v, hits\] .*)` in GNU", (PAGES / "matlab-ode45.md").read_text(), re.M
    )
    done = subprocess.run(
        [octave, "--no-gui", "-q", "--eval", f"warning off; {said[1]}"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.stdout == shown
    exact, numbers = (re.findall(r"[\d.]+", text) for text in (ours, shown))
    assert numbers[2] == exact[2]
    assert float(numbers[0]) == pytest.approx(float(exact[0]), rel=5e-4)


def test_the_equations_for_auto_are_those_that_are_run() -> None:
    (code,) = (code for kind, code in blocks("auto-coco.md") if kind == "fortran")
    assert code in auto07._EQUATIONS
