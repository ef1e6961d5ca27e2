"""Make the libraries of machine code: ``python -m native [TARGET ...]``, or ``make kernels``.

numba lowers each entry and each flow's functions once, to code for no processor in particular; LLVM
makes machine code of it for each target, and a linker a library of that. Targets are named as in
`TARGETS`; the default is this machine and the explorer's page, whose WebAssembly has only the
functions that the page calls.
"""

from __future__ import annotations

import gc
import importlib
import os
import pkgutil
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

os.environ["VIBROIMPACT_ENGINE"] = "numba"

import llvmlite.binding as llvm
import numba
import numpy as np
from numba.core.codegen import CPUCodeLibrary
from numba.core.sigutils import normalize_signature

from vibroimpact import engine
from vibroimpact.engine import flow_dispatch, flow_tables, jit, kernel_linking, native
from vibroimpact.engine.compilation import Compiled
from vibroimpact.engine.entry import Entry
from vibroimpact.engine.plain_entries import Alone, Single
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


def functions() -> Iterator[tuple[Compiled, Any]]:
    """Each function of the engine that is compiled, with a first argument of each of its types."""
    names = [found.name for found in pkgutil.walk_packages(engine.__path__, f"{engine.__name__}.")]
    for name in names:
        for value in vars(importlib.import_module(name)).values():
            if isinstance(value, Entry | Single) and value.function.__module__ == name:
                yield value, np.empty(8) if isinstance(value, Entry) else Alone()
    for flow in flow_dispatch.FLOWS:
        for group in flow_tables.GROUPS.values():
            yield group, flow(np.empty(8))


def lowered(index: int) -> tuple[str, bytes]:
    """Name and code of a function as numba lowers it, with all that it calls."""
    compiled, given = list(functions())[index]
    modules = {}
    optimise = CPUCodeLibrary._optimize_final_module

    def keep(library: Any) -> None:
        modules[library.name] = str(library._final_module)
        optimise(library)

    CPUCodeLibrary._optimize_final_module = keep
    try:
        arguments, result = normalize_signature(compiled.signature)
        dispatcher = numba.njit(**jit.OPTIONS)(compiled.function)
        gc.disable()
        with kernel_linking.only(compiled.function.__qualname__):
            dispatcher.compile(result(numba.typeof(given), *arguments))
        gc.enable()
    finally:
        CPUCodeLibrary._optimize_final_module = optimise
    (made,) = dispatcher.overloads.values()
    module = llvm.parse_assembly(modules[compiled.function.__qualname__])
    kernel_linking.keep_apart(module)
    name = made.fndesc.llvm_func_name
    for one in (*module.functions, *module.global_variables):
        if not one.is_declaration and one.name != name:
            one.linkage = "internal"
    symbol = compiled.symbol(type(given))
    module.get_function(name).name = symbol
    return symbol, module.as_bitcode()


def _machine(target: Target) -> Any:
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    placed = ("static", "default") if target.in_a_page else ("pic", "small")
    return llvm.Target.from_triple(target.triple).create_target_machine(
        cpu=target.cpu,
        features=target.features,
        opt=3,
        reloc=placed[0],
        codemodel=placed[1],
    )


def machine_code(code: bytes, target: Target) -> bytes:
    """Optimise as numba would for this target, and emit."""
    machine = _machine(target)
    text = str(llvm.parse_bitcode(code))
    text = re.sub(
        "(?m)^target datalayout = .*$", f'target datalayout = "{machine.target_data}"', text
    )
    text = re.sub("(?m)^target triple = .*$", f'target triple = "{target.triple}"', text)
    module = llvm.parse_assembly(text)

    def optimise(prepare: Any, **options: Any) -> None:
        tuning = llvm.create_pipeline_tuning_options(speed_level=3)
        for option, value in options.items():
            setattr(tuning, option, value)
        builder = llvm.create_pass_builder(machine, tuning)
        passes = prepare(builder)
        passes.run(module, builder)

    def unused(builder: Any) -> Any:
        passes = llvm.create_new_module_pass_manager()
        passes.add_global_dead_code_eliminate_pass()
        return passes

    def cheap(builder: Any) -> Any:
        passes = builder.getModulePassManager()
        passes.add_loop_rotate_pass()
        passes.add_instruction_combine_pass()
        passes.add_jump_threading_pass()
        return passes

    optimise(unused)
    for _ in range(2):  # see `kernel_linking`
        optimise(cheap, slp_vectorization=False)
        optimise(lambda builder: builder.getModulePassManager())
    emitted: bytes = machine.emit_object(module)
    return emitted


_COUNTED = "void NRT_MemInfo_call_dtor(void *nothing) {}\n"
"""Of an array whose memory is counted; memory that Python passes is not."""


_FOR_A_PAGE = [
    "-mexec-model=reactor",  # no main, and nothing is imported
    *(
        f"-Wl,{option}"
        for option in (
            "--no-entry,--gc-sections,--strip-all",
            "-z,stack-size=1048576",
            *(f"--export={name}" for name in ("__heap_base", *sorted(engine_layout.SYMBOLS))),
        )
    ),
]


def link(objects: list[bytes], target: Target, path: Path) -> None:
    """Link a library of objects."""
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for i, one in enumerate(objects):
            files.append(Path(folder) / f"{i}.o")
            files[-1].write_bytes(one)
        stub = Path(folder) / "stub.c"
        stub.write_text(_COUNTED)
        command = [sys.executable, "-m", "ziglang", "cc", "-target", target.linker]
        options = ["-s", "-O2", "-o", str(path), "-lm"]
        options += _FOR_A_PAGE if target.in_a_page else ["-shared"]
        subprocess.run([*command, *options, *map(str, files), str(stub)], check=True)
    path.write_bytes(_without_places(path.read_bytes()))


def _without_places(library: bytes) -> bytes:
    """Blank the folders of this machine, which stand in exceptions that no kernel raises."""
    for package in (numba, engine):
        place = str(Path(str(package.__file__)).parents[1]).encode()
        library = library.replace(place, b"." * len(place))
    return library


def _made(work: tuple[bytes, Target]) -> bytes:
    return machine_code(*work)


def main(names: list[str]) -> None:
    """Make the libraries of these names."""
    chosen = {name: TARGETS[name] for name in names or [_own(), engine_layout.WASM]}
    native.FOLDER.mkdir(exist_ok=True)
    digest = native.FOLDER / native.DIGEST
    if not digest.exists() or digest.read_text() != native.digest():
        for old in native.FOLDER.iterdir():
            old.unlink()
    symbols = [compiled.symbol(type(given)) for compiled, given in functions()]
    wanted = [k for k, name in enumerate(symbols) if any(one.has(name) for one in chosen.values())]
    with ProcessPoolExecutor() as pool:
        codes = {}
        for symbol, code in pool.map(lowered, wanted):
            print(f"{symbol}: {len(code) // 1024} kB", flush=True)
            codes[symbol] = code
        for name, target in chosen.items():
            theirs = [(code, target) for symbol, code in codes.items() if target.has(symbol)]
            path = native.FOLDER / name
            link(list(pool.map(_made, theirs)), target, path)
            print(f"{path.name}: {path.stat().st_size / 1e6:.2f} MB", flush=True)
    digest.write_text(native.digest())


def _own() -> str:
    return native.name_of(sys.platform, native.machine(), native.levels()[0])


if __name__ == "__main__":
    main(sys.argv[1:])
