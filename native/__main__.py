"""Make the libraries of machine code: ``python -m native [TARGET ...]``, or ``make kernels``.

numba lowers each entry and each flow's functions once, to code for no processor in particular; LLVM
makes machine code of it for each target, and a linker a library of that. Targets are named as in
`TARGETS`; ``release`` stands for those of a release that have not been made. The default is this
machine and the explorer's page, whose WebAssembly has only the functions that the page calls.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

os.environ["VIBROIMPACT_ENGINE"] = "numba"

import llvmlite.binding as llvm

from native.lowering import lower_all
from native.targets import RELEASE, TARGETS, Target
from vibroimpact.engine import native
from vibroimpact.explorer import engine_layout


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


def machine_code(symbol: str, code: bytes, target: Target) -> bytes:
    """Optimise a function as numba would for this target, and emit."""
    machine = _machine(target)
    text = str(llvm.parse_bitcode(code))
    text = re.sub(
        "(?m)^target datalayout = .*$", f'target datalayout = "{machine.target_data}"', text
    )
    text = re.sub("(?m)^target triple = .*$", f'target triple = "{target.triple}"', text)
    module = llvm.parse_assembly(text)
    if target.system == "win32":
        module.get_function(symbol).storage_class = "dllexport"

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


_COUNTED = """\
__attribute__((visibility("hidden"))) void NRT_MemInfo_call_dtor(void *nothing) {}
"""
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
        made = Path(folder) / path.name
        command = [sys.executable, "-m", "ziglang", "cc", "-target", target.linker]
        options = ["-s", "-O2", "-o", str(made), "-lm"]
        options += _FOR_A_PAGE if target.in_a_page else ["-shared"]
        if target.system == "darwin":
            options.append(f"-Wl,-install_name,@rpath/{path.name}")
        subprocess.run([*command, *options, *map(str, files), str(stub)], check=True)
        shutil.copy(made, path)


def _made(work: tuple[str, bytes, Target]) -> bytes:
    return machine_code(*work)


def main(names: list[str]) -> None:
    """Make the libraries of these names."""
    native.FOLDER.mkdir(exist_ok=True)
    digest = native.FOLDER / native.DIGEST
    if not digest.exists() or digest.read_text() != native.digest():
        for old in native.FOLDER.iterdir():
            old.unlink()
    if names == ["release"]:
        names = [name for name in RELEASE if not (native.FOLDER / name).exists()]
    elif not names:
        names = [_own(), engine_layout.WASM]
    chosen = {name: TARGETS[name] for name in names}
    with ProcessPoolExecutor() as pool:
        codes = dict(lower_all(pool, lambda name: any(one.has(name) for one in chosen.values())))
        for file, target in chosen.items():
            theirs = [
                (symbol, code, target) for symbol, code in codes.items() if target.has(symbol)
            ]
            path = native.FOLDER / file
            link(list(pool.map(_made, theirs)), target, path)
            print(f"{path.name}: {path.stat().st_size / 1e6:.2f} MB", flush=True)
    digest.write_text(native.digest())


def _own() -> str:
    return native.name_of(sys.platform, native.machine(), native.levels()[0])


if __name__ == "__main__":
    main(sys.argv[1:])
