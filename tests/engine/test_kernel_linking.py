"""Only entries become machine code, and it is what it would be if their kernels did, too."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numba
import pytest

from vibroimpact.engine import flow_dispatch, jit, kernel_linking

_SCRIPT = """
import re
import sys
import numba
from numba.core.codegen import JITCPUCodegen

made = []
add = JITCPUCodegen._add_module
JITCPUCodegen._add_module = lambda self, module: (made.append(module.name), add(self, module))[1]

from vibroimpact.engine import kernel_linking
from vibroimpact.engine.plain_entries import Single
from vibroimpact.engine.jit import kernel

kernel_linking.KNOWN = sys.argv[1]

@kernel
def cubed(x):
    return x * x * x + 1.0 / (x + 3.0)

def first(given, x):
    return cubed(x) + cubed(x + 1.0)

made.clear()
print(Single(first, "f8(f8)")(0.3).hex())
print(sum("cubed" in one for one in made), sum("first" in one for one in made))
own = numba.njit(lambda x: x + 1.0)  # of a user of the package
print(own(2.0))
"""


def _ran(tmp_path, known: str) -> list[str]:
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", _SCRIPT, known],
        env={"VIBROIMPACT_CACHE_DIR": str(tmp_path), "PYTHONPATH": ":".join(sys.path)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


@pytest.mark.full
def test_only_the_entry_becomes_machine_code(tmp_path):
    if not numba.__version__.startswith(kernel_linking.KNOWN):
        pytest.skip(f"numba {numba.__version__} compiles all of it")
    number, kernels, entries, own = _ran(tmp_path / "one", kernel_linking.KNOWN)
    assert (kernels, entries, own) == ("0", "1", "3.0")
    # The second time it comes from the cache.
    assert _ran(tmp_path / "one", kernel_linking.KNOWN)[0] == number
    same, kernels, entries, own = _ran(tmp_path / "all", "no such version")
    assert (kernels, entries, own) == ("1", "1", "3.0")
    assert same == number


def test_kernels_that_are_kept_apart_have_names_of_their_own() -> None:
    """They are found by name: another one of that name would be kept apart, and round otherwise."""
    folder = Path(flow_dispatch.__file__).parent  # which has all kernels defined
    sources = [path.read_text(encoding="utf-8") for path in folder.rglob("*.py")]
    assert jit.APART
    for name in jit.APART:
        made = re.compile(rf"^ *def {name}\(", re.MULTILINE)
        assert sum(len(made.findall(source)) for source in sources) == 1, name
