"""The systems and processors that libraries are made for."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vibroimpact.engine import native
from vibroimpact.explorer import engine_layout


class Target(NamedTuple):
    """A system and a level of processors."""

    system: str
    machine: str
    level: str
    cpu: str
    triple: str
    linker: str
    features: str = ""
    symbols: frozenset[str] | None = None
    """Its functions. Default: all."""

    def has(self, symbol: str) -> bool:
        """Whether it has a function."""
        return self.symbols is None or symbol in self.symbols

    @property
    def in_a_page(self) -> bool:
        """Whether it is WebAssembly."""
        return self.machine == "wasm32"


_LEVELS = {"v2": "x86-64-v2", "v3": "x86-64-v3", "v4": "x86-64-v4"}
_SYSTEMS = {
    "linux": ("unknown-linux-gnu", "linux-gnu.2.17"),
    "darwin": ("apple-macosx11.0.0", "macos.11.0"),
    "win32": ("pc-windows-gnu", "windows-gnu"),
}


def _targets() -> Iterator[Target]:
    for system, (triple, linker) in _SYSTEMS.items():
        for level, cpu in _LEVELS.items():
            x86 = ("x86_64", level, cpu, f"x86_64-{triple}", f"x86_64-{linker}")
            yield Target(system, *x86)
        cpu, machine = ("apple-m1", "arm64") if system == "darwin" else ("generic", "aarch64")
        arm = ("aarch64", "v8", cpu, f"{machine}-{triple}", f"aarch64-{linker}")
        yield Target(system, *arm)


_PAGE = Target(
    "wasi",
    "wasm32",
    "",
    "generic",
    # The code has 64-bit integers, but no pointer's size: it is lowered before numba optimises it.
    "wasm32-unknown-unknown",
    "wasm32-wasi",
    "+simd128,+bulk-memory,+nontrapping-fptoint,+sign-ext",
    engine_layout.SYMBOLS,
)
TARGETS = {
    **{native.name_of(one.system, one.machine, one.level): one for one in _targets()},
    engine_layout.WASM: _PAGE,
}
RELEASE = (
    engine_layout.WASM,
    "linux-x86_64-v3.so",
    "linux-aarch64-v8.so",
    "darwin-x86_64-v3.dylib",
    "darwin-aarch64-v8.dylib",
    "win32-x86_64-v3.dll",
)
"""What the wheels of a release contain."""
