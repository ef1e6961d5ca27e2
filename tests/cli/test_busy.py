"""What is shown on a terminal while the engine is compiled."""

from __future__ import annotations

import os
import re
import select
import subprocess
import sys
import time
from pathlib import Path

import pytest

from samples import sample

pytest.importorskip("pty", reason="no pseudo-terminals here")

ENTRY = """\
from vibroimpact.engine.rigless_entry import rigless_entry


@rigless_entry("f8(f8[::1])")
def first(values, rig):
    return rig[0]
"""
COMPILE = """\
from contextlib import nullcontext
from vibroimpact import stderr
from vibroimpact.cli import output
from small import first
stderr.busy = output.busy
with output.progress_bar("sweep") if {inside} else nullcontext(lambda done, total: None) as show:
    show(1, 4)
    first.prepare()
"""


def seen(code: str, folder: Path) -> str:
    """What a process writes on a terminal."""
    ours, theirs = os.openpty()
    (folder / "small.py").write_text(ENTRY)
    own = {"VIBROIMPACT_ENGINE": "numba", "VIBROIMPACT_CACHE_DIR": str(folder), "TERM": "xterm"}
    process = subprocess.Popen(
        [sys.executable, "-c", code],
        cwd=folder,
        stderr=theirs,
        env={**os.environ, "COLUMNS": "100", **own},
    )
    os.close(theirs)
    written, last = b"", time.monotonic() + 300.0
    while time.monotonic() < last:
        if select.select([ours], [], [], 1.0)[0]:
            try:
                part = os.read(ours, 65536)
            except OSError:  # the other end is closed
                break
            if not part:
                break
            written += part
    os.close(ours)
    assert process.wait(timeout=60) == 0, written
    return re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", written.decode())


@pytest.mark.parametrize("inside", sample([False, True], [True]))
def test_a_bar_moves_while_the_engine_is_compiled(tmp_path, inside) -> None:
    text = seen(COMPILE.format(inside=inside), tmp_path)
    assert text.count("compiling the engine") == 1
    frames = re.findall(r"compiling first for NoRig.*?\d:\d\d:\d\d", text)
    assert len(frames) > 2, text  # drawn again and again
    assert ("sweep" in text) == inside
    # What was compiled is loaded: nothing moves.
    assert "compiling" not in seen(COMPILE.format(inside=inside), tmp_path)
