"""The libraries of other systems give what this machine's gives, as far as they run here."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from engine import replay
from vibroimpact.engine import native

LIMIT = 1e-13
"""Over the size of a column: other mathematical libraries, and other fused products."""
CURRENT = (native.FOLDER / native.DIGEST).read_text() == native.digest()
OWN = native.shipped() if CURRENT else None
OTHERS = {
    "linux-aarch64-v8.so": (
        "aarch64-linux-gnu",
        ("qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"),
        "qemu-user and libc6-arm64-cross",
    ),
    "win32-x86_64-v3.dll": ("x86_64-windows-gnu", ("wine",), "wine"),
}

pytestmark = [
    pytest.mark.skipif(OWN is None, reason="no library: make kernels"),
    pytest.mark.skipif(importlib.util.find_spec("ziglang") is None, reason="no ziglang to link"),
]


@pytest.fixture(scope="module")
def recorded(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("calls")
    # The library is recorded in the full run, too, which has numba compile.
    environment = {**os.environ, "VIBROIMPACT_ENGINE": ""}
    environment["PYTHONPATH"] = str(Path(replay.__file__).parents[1])
    environment.pop("VIBROIMPACT_KERNELS", None)
    command = [sys.executable, replay.__file__, str(folder)]
    subprocess.run(command, env=environment, check=True, timeout=600)
    return folder


def differences(recorded: Path, library: Path, target: str, emulator: tuple[str, ...]) -> list:
    program = replay.build(recorded, target)
    command = [*emulator, str(program), str(library), "calls.bin", "answers.bin"]
    done = subprocess.run(command, cwd=recorded, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    return list(replay.largest_difference(recorded, recorded / "answers.bin").values())


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the driver of this machine")
def test_a_repeated_call_leaves_the_same_numbers(recorded) -> None:
    changes = differences(recorded, OWN, f"{native.machine()}-linux-gnu", ())
    assert len(changes) > 8
    assert max(changes) == 0.0


@pytest.mark.full
@pytest.mark.parametrize("name", OTHERS)
def test_another_system_gives_the_same_numbers(recorded, name) -> None:
    target, emulator, packages = OTHERS[name]
    library = native.FOLDER / name
    if not library.exists():
        pytest.skip(f"{name} is not made: make dist")
    if shutil.which(emulator[0]) is None or not all(Path(p).exists() for p in emulator[2:]):
        pytest.skip(f"it runs with {packages}")
    assert max(differences(recorded, library, target, emulator)) < LIMIT
