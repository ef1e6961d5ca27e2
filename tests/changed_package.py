"""A copy of the package with edits, as plain Python, that answers a script."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import vibroimpact

Edits = Mapping[str, Sequence[tuple[str, str]]]
"""By file of the package, what is replaced, and by what; a new file is one of an empty text."""


def answers_of(folder: Path, edits: Edits, script: str) -> dict[str, Any]:
    """What a script prints as JSON with the edited package. Nothing is compiled."""
    source, target = Path(vibroimpact.__path__[0]), folder / "vibroimpact"
    shutil.copytree(source, target, ignore=shutil.ignore_patterns("libraries", "__pycache__"))
    for name, replacements in edits.items():
        path = target / name
        text = path.read_text() if path.exists() else ""
        for before, after in replacements:
            assert text.count(before) == 1  # an empty text has one empty place
            text = text.replace(before, after)
        path.write_text(text)
    where = os.pathsep.join([str(folder), str(Path(__file__).parent)])
    plain = {"NUMBA_DISABLE_JIT": "1", "VIBROIMPACT_ENGINE": "numba", "PYTHONPATH": where}
    command = [sys.executable, "-c", script]
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=900, env=os.environ | plain
    )
    assert done.returncode == 0, done.stderr
    result: dict[str, Any] = json.loads(done.stdout)
    return result
