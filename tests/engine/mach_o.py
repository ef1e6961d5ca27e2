"""Machine code of macOS, linked anew for Linux, where its functions then run.

The segments of a library of macOS become a section of one for Linux, byte for byte and at the same
distances. Linux's linker and loader do what macOS's loader would: they add the library's address to
its pointers into itself, bind what it imports, and find what it exports. macOS's own loader,
signatures, protection of memory and mathematical library have no part in it: imports are bound to
Linux's functions of the same names, or to those of `mach_o.c`.

Both systems call functions alike on x86-64. On ARM, macOS packs arguments on the stack, which makes
a difference only if two that follow one another are shorter than eight bytes; and it reserves the
register x18, which its code thus never uses.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from engine.replay import zig

_FUNCTIONS = Path(__file__).with_suffix(".c")
_ALIGNMENT = 16384
"""Bytes of a page of macOS, of which segments are multiples."""


def relink(
    library: Path, target: str, path: Path, imports: Mapping[str, str] | None = None
) -> None:
    """Link a library of macOS anew for another system of the same processor.

    Parameters
    ----------
    library
        File of macOS, for one processor.
    target
        System, as zig names it.
    path
        File to write; others of its name are written beside it.
    imports
        Functions to bind instead of those that it imports, by their names. Default: the same.
    """
    sources = _sources(library, path, imports or {})
    zig(target, "-shared", "-Wl,-z,defs", "-o", path, *sources, "-lm")


def _sources(library: Path, path: Path, imports: Mapping[str, str]) -> list[Path]:
    import lief

    lief.logging.disable()  # it reports that a table is empty
    binary = lief.MachO.parse(str(library)).at(0)
    _refuse_what_is_not_linked(binary)
    image = bytearray(max(one.virtual_address + one.virtual_size for one in binary.segments))
    for one in binary.segments:
        end = one.virtual_address + one.file_size
        image[one.virtual_address : end] = one.content[: one.file_size]
    # A function that is imported has both: until its first call, it points to what binds it.
    words = {
        one.address: f"image + {int.from_bytes(image[one.address : one.address + 8], 'little')}"
        for one in binary.relocations
    }
    for one in binary.bindings:
        name = one.symbol.name.removeprefix("_")
        words[one.address] = f"{imports.get(name, name)} + {one.addend}"
    exports = {one.name.removeprefix("_"): one.value for one in binary.exported_symbols}
    content, source = path.with_suffix(".image"), path.with_suffix(".s")
    content.write_bytes(image)
    source.write_text("\n".join([*_assembly(content, len(image), words, exports), ""]))
    return [source, _FUNCTIONS]


def _assembly(
    content: Path, size: int, words: Mapping[int, str], exports: Mapping[str, int]
) -> Iterator[str]:
    yield from ('.section .macos, "awx", @progbits', f".balign {_ALIGNMENT}", "image:")
    start = 0
    for address, word in sorted(words.items()):
        yield f'.incbin "{content}", {start}, {address - start}'
        yield f".quad {word}"
        start = address + 8
    yield f'.incbin "{content}", {start}, {size - start}'
    for name, address in exports.items():
        # The others are the compiler's, such as the library's header.
        if not name.startswith("_"):
            yield from (f".globl {name}", f".set {name}, image + {address}")


def _refuse_what_is_not_linked(binary: Any) -> None:
    kinds = {one.type.name for one in binary.sections}
    others = {kind for kind in kinds if "THREAD_LOCAL" in kind or "INIT" in kind}
    if binary.has_dyld_chained_fixups:
        others.add("chained fixups")
    others |= {one.type.name for one in binary.relocations} - {"POINTER"}
    others |= {one.binding_class.name for one in binary.bindings} - {"STANDARD", "LAZY"}
    if others:
        raise ValueError(f"{binary.name} has {', '.join(sorted(others))}")
