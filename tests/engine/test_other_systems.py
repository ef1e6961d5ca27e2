"""The libraries of other systems give what this machine's gives, as far as they run here.

Of those of macOS, only the machine code runs, as `mach_o` states.
"""

from __future__ import annotations

import ctypes
import importlib.util
import math
import os
import shutil
import struct
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from engine import mach_o, replay
from vibroimpact.engine import native

LIMIT = 1e-13
"""Over the size of a column: other mathematical libraries, and other fused products."""
CURRENT = (native.FOLDER / native.DIGEST).read_text() == native.digest()
OWN = native.shipped() if CURRENT else None
_ARM = ("aarch64-linux-gnu", ("qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"))
OTHERS = {
    "linux-aarch64-v8.so": (*_ARM, "qemu-user and libc6-arm64-cross"),
    "win32-x86_64-v3.dll": ("x86_64-windows-gnu", ("wine",), "wine"),
    "darwin-x86_64-v3.dylib": ("x86_64-linux-gnu", (), "Linux on x86-64 v3"),
    "darwin-aarch64-v8.dylib": (*_ARM, "qemu-user and libc6-arm64-cross"),
}
SAMPLE = """
#include <math.h>
static double half(double x) { return 0.5 * x; }
double (*table[])(double) = {half, exp};
double scale = 1.7;
double sample(double x, double *filled, long count) {
    for (long k = 0; k < count; k++) filled[k] = 0.3;
    return scale * table[0](x) + table[1](x) + 2.0 * sin(x) + cos(x);
}
"""
"""It has pointers to a function of its own and to an imported one, numbers, and calls of functions
that Linux has not."""

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


def differences(
    recorded: Path,
    library: Path,
    target: str,
    emulator: tuple[str, ...],
    imports: Mapping[str, str] | None = None,
) -> list[float]:
    program = replay.build(recorded, target)
    if library.suffix == ".dylib":
        # On ARM, macOS would pass the second in the same word of the stack (see `mach_o`).
        assert "_Bool, _Bool" not in (recorded / "calls.h").read_text()
        relinked = recorded / f"{library.stem}.so"
        mach_o.relink(library, target, relinked, imports)
        library = relinked
    command = [*emulator, str(program), str(library), "calls.bin", "answers.bin"]
    done = subprocess.run(command, cwd=recorded, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    return list(replay.largest_difference(recorded, recorded / "answers.bin").values())


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the driver of this machine")
def test_a_repeated_call_leaves_the_same_numbers(recorded) -> None:
    changes = differences(recorded, OWN, f"{native.machine()}-linux-gnu", ())
    assert len(changes) > 8
    assert max(changes) == 0.0


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="Linux loads what is linked")
def test_machine_code_of_macos_runs_here_with_its_faults(tmp_path) -> None:
    pytest.importorskip("lief", reason="no lief to read it")
    (tmp_path / "sample.c").write_text(SAMPLE)
    library = tmp_path / "sample.dylib"
    machine = native.machine()
    replay.zig(f"{machine}-macos.11.0", "-shared", "-o", library, tmp_path / "sample.c")

    def result(name: str, imports: Mapping[str, str] | None = None) -> float:
        path = tmp_path / f"{name}.so"
        mach_o.relink(library, f"{machine}-linux-gnu", path, imports)
        function, filled = ctypes.CDLL(str(path)).sample, (ctypes.c_double * 40)()
        function.restype = ctypes.c_double
        value = function(ctypes.c_double(0.4), filled, ctypes.c_long(39))
        assert list(filled) == [0.3] * 39 + [0.0]
        return value

    rest = 2.0 * math.sin(0.4) + math.cos(0.4)
    assert result("right") == pytest.approx(0.34 + math.exp(0.4) + rest, rel=1e-15, abs=0.0)
    assert result("bound", {"exp": "exp2"}) == pytest.approx(
        0.34 + 2**0.4 + rest, rel=1e-15, abs=0.0
    )
    raw = library.read_bytes()
    assert raw.count(struct.pack("<d", 1.7)) == 1
    library.write_bytes(raw.replace(struct.pack("<d", 1.7), struct.pack("<d", 1.8)))
    assert result("changed") == pytest.approx(0.36 + math.exp(0.4) + rest, rel=1e-15, abs=0.0)


def available(name: str) -> tuple[Path, str, tuple[str, ...]]:
    """A library of another system, the target of its driver, and how that runs; or skip."""
    target, emulator, needed = OTHERS[name]
    library = native.FOLDER / name
    if not library.exists():
        pytest.skip(f"{name} is not made: make dist")
    here = sys.platform.startswith("linux") and "v3" in native.levels()
    if emulator:
        here = bool(shutil.which(emulator[0])) and all(Path(p).exists() for p in emulator[2:])
    if not here:
        pytest.skip(f"it runs with {needed}")
    if library.suffix == ".dylib":
        pytest.importorskip("lief", reason="no lief to read it")
    return library, target, emulator


@pytest.mark.full
@pytest.mark.parametrize("name", OTHERS)
def test_another_system_gives_the_same_numbers(recorded, name) -> None:
    assert max(differences(recorded, *available(name))) < LIMIT


@pytest.mark.full
@pytest.mark.parametrize("name", [name for name in OTHERS if name.endswith(".dylib")])
def test_a_function_bound_to_another_is_noticed(recorded, name) -> None:
    assert max(differences(recorded, *available(name), {"exp": "exp2"})) > 1e-3
