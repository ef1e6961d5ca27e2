"""Running one command as a user would, in a folder of its own."""

from __future__ import annotations

import contextlib
import io
import math
from collections.abc import Callable
from pathlib import Path

import pytest

from vibroimpact.cli import main


@pytest.fixture(scope="module", autouse=True)
def no_lines_of_progress():
    """Where the engine has to be compiled a command may take long enough for one."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("vibroimpact.tasks.progress.LINES", math.inf)
        yield


@pytest.fixture(scope="module", autouse=True)
def no_pictures(blank_pictures):
    """What is in PNG files is tested in `figures`."""


@pytest.fixture(scope="module")
def run_in(request) -> Callable[..., tuple[int, str, str]]:
    """Run the module's ``COMMAND`` in a folder; return exit code, stdout and stderr."""

    def run_in(folder: Path, *words: str) -> tuple[int, str, str]:
        out, errors = io.StringIO(), io.StringIO()
        with (
            contextlib.chdir(folder),
            contextlib.redirect_stdout(out),
            contextlib.redirect_stderr(errors),
        ):
            code = main((request.module.COMMAND, *words))
        # The first run ever says that it compiles the engine.
        lines = errors.getvalue().splitlines(keepends=True)
        return code, out.getvalue(), "".join(line for line in lines if "compiling" not in line)

    return run_in


@pytest.fixture
def run(tmp_path, run_in):
    """Run the module's ``COMMAND`` in an empty folder."""
    return lambda *words: run_in(tmp_path, *words)


@pytest.fixture
def refused(run, tmp_path) -> Callable[..., str]:
    """Run a command that ends with one line, which is returned, and writes nothing."""

    def refused(*words: str) -> str:
        before = sorted(tmp_path.iterdir())
        code, printed, errors = run(*words)
        assert (code, printed) == (2, "")
        assert errors.startswith("vibroimpact: error: ")
        assert errors.count("\n") == 1
        assert sorted(tmp_path.iterdir()) == before
        return errors

    return refused
