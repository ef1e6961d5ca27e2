"""Running one command as a user would, in a folder of its own."""

from __future__ import annotations

import contextlib
import io
import math
from collections.abc import Callable
from pathlib import Path

import pytest

import samples
from vibroimpact.cli import main


@pytest.fixture(scope="module", autouse=True)
def no_lines_of_progress():
    """Where the engine has to be compiled a command may take long enough for one."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("vibroimpact.tasks.progress.LINES", math.inf)
        yield


@pytest.fixture(scope="module", autouse=True)
def blank_pictures():
    """In the daily run PNG files are blank: what is in them is tested in `figures` and `docs`."""
    from vibroimpact.figures.notebook import Drawing

    save = Drawing.savefig

    def blank(figure, file, **how):
        if samples.full or how["format"] != "png":
            save(figure, file, **how)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Drawing, "savefig", blank)
        yield


@pytest.fixture(scope="module")
def told(request) -> Callable[..., tuple[int, str, str]]:
    """Run the module's ``COMMAND`` in a folder; return exit code, stdout and stderr."""

    def told(folder: Path, *words: str) -> tuple[int, str, str]:
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

    return told


@pytest.fixture
def run(tmp_path, told):
    """Run the module's ``COMMAND`` in an empty folder."""
    return lambda *words: told(tmp_path, *words)
