"""Only entries become machine code, and it is what it would be if their kernels did, too."""

from __future__ import annotations

import subprocess
import sys

import llvmlite.binding as llvm
import numba
import pytest
from numba.core.itanium_mangler import mangle

from vibroimpact.engine import flow_tables, jit, kernel_linking

_SCRIPT = """
import re
import sys
import numba
from numba.core.codegen import JITCPUCodegen

made = []
add = JITCPUCodegen._add_module
JITCPUCodegen._add_module = lambda self, module: (made.append(module.name), add(self, module))[1]

from vibroimpact.engine import kernel_linking
from vibroimpact.engine.rigless_entry import RiglessEntry
from vibroimpact.engine.jit import kernel

kernel_linking.KNOWN = sys.argv[1]

@kernel
def cubed(x):
    return x * x * x + 1.0 / (x + 3.0)

def first(given, x):
    return cubed(x) + cubed(x + 1.0)

made.clear()
print(RiglessEntry(first, "f8(f8)")(0.3).hex())
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


def test_only_a_kernel_that_is_marked_is_kept_apart() -> None:
    """One of the same name in another module, or in another function, is not."""
    name = "vibroimpact.engine.assembly.series.expanding.<locals>.expand_masses"
    assert flow_tables.GROUPS  # whose module has all kernels defined
    assert name in jit.NOT_INLINED
    others = (name.replace("series", "tables"), name.rpartition(".")[2], f"{name}_2")
    symbols = [
        mangle(one, (numba.float64,), abi_tags=(), uid=3)
        for one in (name, f"{name}.inner", *others)
    ]
    code = "".join(f'define void @"{one}"() {{ ret void }}\n' for one in symbols)
    module = llvm.parse_assembly(code)
    kernel_linking.forbid_inlining(module)
    marked = [one.name for one in module.functions if b"noinline" in set(one.attributes)]
    assert marked == symbols[:1]
