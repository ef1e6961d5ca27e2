"""The program as a whole: its help, its version, its installed entry point."""

from __future__ import annotations

import gc
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import vibroimpact as vi
from vibroimpact.cli import main
from vibroimpact.cli.output import progress_bar


def test_version(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"vibroimpact {vi.__version__}\n"


@pytest.mark.parametrize("words", [["--help"], ["-h"], []])
def test_help_names_the_commands_with_examples(capsys, words):
    assert main(words) == 0
    text = capsys.readouterr().out
    assert "sweep " in text
    assert "simulate " in text
    assert "vibroimpact sweep B2-G1-A3" in text


def test_help_of_a_command_names_its_options(capsys):
    assert main(["sweep", "--help"]) == 0
    text = capsys.readouterr().out
    for option in ("--from", "--to", "--step", "--frequencies", "--direction", "--parameters"):
        assert option in text
    for option in ("--set", "PATH=VALUE", "--gap", "--amplitude"):
        assert option in text
    for option in ("--output", "-o", "--json", "--threads", "--tolerance", "--max-cycles"):
        assert option in text
    for hidden in ("--no-json", "--no-set", "--changes", "--start"):
        assert hidden not in text


@pytest.mark.parametrize("words", [["swep"], ["--bogus"], ["sweep"], ["sweep", "--bogus"]])
def test_usage_errors_are_one_line(capsys, words):
    assert main(words) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err.startswith("vibroimpact: error: ")
    assert output.err.count("\n") == 1
    assert "--help" in output.err


def test_help_loads_nothing_that_computes():
    code = (
        "import sys; from vibroimpact.cli import main\n"
        "main(['--help']); main(['sweep', '--help'])\n"
        "main(['help']); main(['help', 'rigs']); main(['help', 'sweep'])\n"
        "heavy = {'numpy', 'numba', 'xarray', 'matplotlib', 'pydantic', 'pint'}\n"
        "assert not heavy & set(sys.modules), heavy & set(sys.modules)\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.DEVNULL)


def test_a_command_imports_no_other_command():
    code = (
        "import sys; from vibroimpact.cli import main\n"
        "main(['record', '--help'])\n"
        "assert 'vibroimpact.cli.record' in sys.modules\n"
        "assert not {'vibroimpact.cli.sweep', 'vibroimpact.cli.map'} & set(sys.modules)\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.DEVNULL)


def test_garbage_is_searched_as_usual_only_while_a_command_computes():
    code = (
        "import gc, sys; usual = gc.get_threshold()\n"
        "import vibroimpact.cli as cli\n"
        "from vibroimpact.cli.output import progress_bar\n"
        "def run(words):\n"
        "    assert gc.get_threshold()[0] > 100 * usual[0]\n"
        "    with progress_bar('computing'):\n"
        "        assert gc.get_threshold() == usual\n"
        "        assert gc.get_freeze_count()\n"
        "    assert gc.get_threshold()[0] > 100 * usual[0]\n"
        "    return 0\n"
        "cli._run = run\n"
        "assert cli.main() == 0\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
    gc.unfreeze()  # of what the session of the tests froze some may go in between
    before = gc.get_threshold(), gc.get_freeze_count()
    with progress_bar("computing"):
        assert (gc.get_threshold(), gc.get_freeze_count()) == before
    assert main(["cache"]) == 0
    assert (gc.get_threshold(), gc.get_freeze_count()) == before


def test_installed_program(tmp_path):
    program = shutil.which("vibroimpact", path=str(Path(sys.executable).parent))
    assert program is not None
    words = ["sweep", "B2-G1-A3", "--frequencies", "1Hz,2Hz", "--json"]
    done = subprocess.run([program, *words], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("{")
    assert (tmp_path / "out/B2-G1-A3-sweep.nc").is_file()
    wrong = subprocess.run(
        [program, "sweep", "B9-G1-A3"], cwd=tmp_path, capture_output=True, text=True
    )
    assert (wrong.returncode, wrong.stdout) == (2, "")
    assert "Traceback" not in wrong.stderr


def test_help_for_a_reader_that_leaves():
    """Until it has left, nothing is written."""
    code = (
        "import sys, time; from vibroimpact.cli import main\ntime.sleep(0.5)\n"
        "sys.exit(main(['--help']))"
    )
    words = [sys.executable, "-c", code]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 0


ENDED = """
import os, signal, sys, time
import vibroimpact.response.sweep as module
from vibroimpact.cli import main
from vibroimpact.cli.output import progress_bar
def computing(*_, **__):
    print("computing", flush=True)
    time.sleep(30)
module.sweeps = computing
sys.argv[1:] = ["sweep", "B2-G1-A3", "--frequencies", "1Hz,2Hz"]
sys.exit(main())
"""


@pytest.mark.skipif(sys.platform == "win32", reason="its processes have no such signals")
@pytest.mark.parametrize(("name", "word", "code"), [("TERM", "terminated", 143)])
def test_a_signal_ends_a_command_and_leaves_nothing(tmp_path, name, word, code):
    with subprocess.Popen(
        [sys.executable, "-c", ENDED],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdout.readline() == "computing\n"
        process.send_signal(getattr(signal, f"SIG{name}"))
        _, errors = process.communicate(timeout=120)
    assert (process.returncode, errors) == (code, f"vibroimpact: {word}\n")
    assert list(tmp_path.iterdir()) == []


LATE = """
import atexit, os, signal, sys
from vibroimpact.cli import main
from vibroimpact.cli.output import progress_bar
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.argv[1:] = ["--version"]
code = main()
os.kill(os.getpid(), signal.SIGINT)
sys.exit(code)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="its processes have no such signals")
def test_an_interrupt_after_the_end_has_its_exit_code():
    done = subprocess.run([sys.executable, "-c", LATE], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (130, "")


@pytest.mark.full
def test_a_reader_that_leaves(tmp_path):
    program = (
        f"{sys.executable} -c 'import sys; from vibroimpact.cli import main; sys.exit(main())'"
    )
    line = f"{program} sweep B2-G1-A3 --step 0.5Hz --json | true; exit ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", line], cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, "Error" in done.stderr) == (0, False)
