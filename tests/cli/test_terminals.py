"""Terminals, pipes and disks as they are: narrow, without Unicode, full."""

from __future__ import annotations

import contextlib
import io
import os
import subprocess
import sys

import pytest

from samples import sample
from vibroimpact.cli import main
from vibroimpact.cli.terminal import in_columns

PROGRAM = [sys.executable, "-m", "vibroimpact"]
FEW = ["sweep", "B2-G1-A3", "--frequencies", "1Hz,2Hz,3Hz"]


def program(tmp_path, words, **options):
    environment = {**os.environ, **options.pop("environment", {})}
    return subprocess.run(
        [*PROGRAM, *words], cwd=tmp_path, capture_output=True, env=environment, **options
    )


def in_process(tmp_path, words, encoding):
    """The same command on pipes of this encoding, without the seconds of a start."""
    out, errors = (io.TextIOWrapper(io.BytesIO(), encoding) for _ in range(2))
    with (
        contextlib.chdir(tmp_path),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(errors),
    ):
        code = main(words)
    for stream in (out, errors):
        stream.flush()
    return subprocess.CompletedProcess(words, code, out.buffer.getvalue(), errors.buffer.getvalue())


def told_in(tmp_path, words, encoding, process):
    if process:
        return program(tmp_path, words, environment={"PYTHONIOENCODING": encoding})
    return in_process(tmp_path, words, encoding)


def check_columns(text):
    lines = text.splitlines()
    assert all(line == line.rstrip() for line in lines)
    table = lines[lines.index("Resonances") + 1 :]
    head, rows = table[0], table[1 : table.index("")]
    assert rows
    for row in rows:
        assert row.index("ward") - len("for" if "forward" in row else "back") == head.index("sweep")


@pytest.mark.parametrize("encoding", sample(["ascii", "cp1252", "utf-8"], ["cp1252", "utf-8"]))
def test_any_encoding(tmp_path, encoding):
    """A pipe gets what it can show, in straight columns and without blanks at the end."""
    for words in (FEW, ["--help"], ["sweep", "--help"]):
        # ASCII lacks the most.
        process = sample(True, encoding == "ascii" and words is FEW)
        done = told_in(tmp_path, words, encoding, process)
        out, errors = done.stdout.decode(encoding), done.stderr.decode(encoding)
        assert done.returncode == 0, errors
        assert "Traceback" not in errors
        if words is FEW:
            check_columns(out)
        if words is FEW and encoding == "ascii":
            assert "eta_a" in out
            assert "A = 0.4903325 m/s^2 = 0.05 g" in out
            assert "lambda = 19.4, delta0 = 0.2169, tau = 0.01" in out
            assert "?" not in out
    wrong = told_in(tmp_path, ["sweep", "B2-Gη-A3"], encoding, sample(True, encoding == "ascii"))
    assert (wrong.returncode, b"Traceback" in wrong.stderr) == (2, False)


def test_plain_letters_take_their_room_from_the_gaps():
    assert in_columns("η_d      forward    1", "ascii") == "eta_d    forward    1"
    assert in_columns("η   η   2", "ascii") == "eta  eta  2"
    assert in_columns("u\u0307 in    out", "ascii") == "u' in   out"
    assert in_columns("η_d      forward", "utf-8") == "η_d      forward"


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no full disk at hand")
@pytest.mark.parametrize(
    "words",
    [
        FEW,
        *sample([[*FEW, "--json"], ["sweep", "--help"]], []),
        ["--help"],
        *sample([["--version"]], []),
    ],
)
def test_a_full_disk_behind_stdout(tmp_path, words):
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [*PROGRAM, *words], cwd=tmp_path, stdout=full, stderr=subprocess.PIPE, text=True
        )
    lines = [line for line in done.stderr.splitlines() if "compiling" not in line]
    assert lines == ["vibroimpact: error: the output cannot be written (No space left on device)"]
    assert done.returncode == 1


@pytest.mark.full
def test_a_closed_stdout(tmp_path):
    line = f"{sys.executable} -m vibroimpact sweep B2-G1-A3 --frequencies 1Hz,2Hz >&-"
    done = subprocess.run(["sh", "-c", line], cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, "Traceback" in done.stderr) == (0, False)
    assert (tmp_path / "out/B2-G1-A3-sweep.nc").is_file()


@pytest.mark.parametrize("stream", sample(["2>&-", "2>&- >&-", "2>/dev/full"], ["2>&- >&-"]))
def test_a_closed_stderr(tmp_path, stream):
    if "full" in stream and not os.path.exists("/dev/full"):
        pytest.skip("no full disk at hand")
    # A gap that nobody means is doubted in a warning.
    line = f"{' '.join(PROGRAM)} sweep B2-G1-A3 --frequencies 1Hz,2Hz --gap 5m {stream}"
    done = subprocess.run(["sh", "-c", line], cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert ("Resonances" in done.stdout) == (">&-" not in stream.removeprefix("2>&-"))
    (written,) = (tmp_path / "out").glob("*-sweep.nc")
    assert written.read_bytes()[1:4] in (b"HDF", b"DF\x01")
    wrong = subprocess.run(
        ["sh", "-c", f"{' '.join(PROGRAM)} sweep B9 {stream}"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert (wrong.returncode, wrong.stdout) == (2, "")


NAME = "o\x1b[31m\x1b]0;x\x07\nut"
"""Of a folder: colours, which rich writes itself, a title of the window, a line of its own."""


@pytest.mark.skipif(os.name == "nt", reason="no such names of files")
def test_names_of_files_steer_no_terminal(tmp_path, capsys):
    assert main([*FEW, "--output", str(tmp_path / NAME)]) == 0
    output = capsys.readouterr()
    assert output.out.count(r"o\x1b[31m\x1b]0;x\x07\nut/B2-G1-A3") == 3
    assert "\x1b" not in output.out + output.err


def test_a_file_that_fails_beneath(tmp_path, monkeypatch, capsys):
    def broken(*_, **__):
        raise PermissionError(13, "Permission denied", "cache")

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("vibroimpact.response.sweep.sweeps", broken)
    assert main(FEW) == 1
    assert capsys.readouterr() == (
        "",
        "vibroimpact: error: 'cache' cannot be used (Permission denied)\n",
    )
