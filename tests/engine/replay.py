"""Calls of the library of this machine, recorded; to repeat them with that of another system.

``python tests/engine/replay.py FOLDER`` records. A small program in C repeats each call with the
same memory, so neither errors of earlier calls nor Python are part of what is compared.
"""

from __future__ import annotations

import json
import struct
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from vibroimpact.engine import native

_TYPES = {"f8": "double", "i8": "int64_t", "boolean": "_Bool"}
_ADDRESS = 1e-300
_RESULT = 16
"""Words of room for a result."""


class Recorder:
    """Writes down the calls of a library's functions, and what they leave."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.script = (folder / "calls.bin").open("wb")
        self.symbols: dict[str, list[str]] = {}
        self.regions: dict[int, tuple[int, np.ndarray]] = {}
        self.expected: list[dict[str, Any]] = []
        self.kept: list[np.ndarray] = []
        self.lock = threading.Lock()

    def function(self, symbol: str, signature: str, first: str) -> Callable[..., Any]:
        """As `native.function`, recorded."""
        call = _FUNCTION(symbol, signature, first)
        matches = native._ARGUMENT.finditer(signature)
        result = next(matches).group()
        kinds = [first, *(one.group() for one in matches)]
        number = len(self.symbols)
        self.symbols[symbol] = kinds

        def recorded(*arguments: Any) -> Any:
            with self.lock:
                inputs = (*arguments[0], *arguments[1:]) if _is_tuple(arguments[0]) else arguments
                arrays = [one for one in inputs if isinstance(one, np.ndarray)]
                for array in arrays:
                    self._region(array)
                # The addresses of a table's functions are those of the library that filled it.
                if "flow_tables" not in symbol:
                    for array in arrays:
                        self._content(array)
                self._call(number, inputs, kinds)
                returned = call(*arguments)
                self._left(symbol, result, returned, arrays)
                return returned

        return recorded

    def _write(self, what: str, *words: int) -> None:
        self.script.write(struct.pack(f"<{1 + len(words)}Q", ord(what), *words))

    def _region(self, array: np.ndarray) -> tuple[int, int]:
        """Number of the memory that an array is a part of, and where it begins there."""
        root = array
        while isinstance(root.base, np.ndarray):
            root = root.base
        start = root.ctypes.data
        if start not in self.regions or self.regions[start][1].nbytes < root.nbytes:
            self.regions[start] = (len(self.kept) + 1, root)
            self.kept.append(root)  # or its address might be given to another
            self._write("N", len(self.kept), root.nbytes, start % 64)
        return self.regions[start][0], array.ctypes.data - start

    def _content(self, array: np.ndarray) -> None:
        number, _ = self._region(array)
        root = self.kept[number - 1]
        raw = root.tobytes()
        self._write("W", number, len(raw))
        self.script.write(raw)
        addresses = np.frombuffer(raw[: len(raw) // 8 * 8], np.uint64)
        within = []
        for start, (other, memory) in self.regions.items():
            inside = (addresses >= start) & (addresses < start + memory.nbytes)
            within += [(8 * int(k), other, int(addresses[k]) - start) for k in inside.nonzero()[0]]
        self.script.write(struct.pack("<Q", len(within)))
        for one in within:
            self.script.write(struct.pack("<3Q", *one))

    def _call(self, number: int, inputs: tuple[Any, ...], kinds: list[str]) -> None:
        words: list[tuple[int, int]] = []
        for one, kind in zip(inputs, kinds, strict=True):
            if kind in _TYPES:
                packed = struct.pack("<d" if kind == "f8" else "<q", one)
                words.append((0, int.from_bytes(packed, "little")))
                continue
            region, at = self._region(one)
            words += [(0, 0), (0, 0), (0, one.size), (0, one.itemsize), (region, at)]
            words += [(0, k % 2**64) for k in (*one.shape, *one.strides)]
        self._write("C", number, len(words))
        for pair in words:
            self.script.write(struct.pack("<2Q", *pair))

    def _left(self, symbol: str, result: str, returned: Any, arrays: list[np.ndarray]) -> None:
        numbers = np.ravel([] if result == "void" else returned)
        left = []
        if "flow_tables" not in symbol:
            # The first is the plan, whose numbers differ in size.
            for array in arrays[1:]:
                region, at = self._region(array)
                self._write("R", region, at, array.nbytes)
                left.append({"type": array.dtype.str, "shape": array.shape, "at": len(left)})
                name = f"{len(self.expected)}-{len(left) - 1}.npy"
                np.save(self.folder / name, array)
        self.expected.append(
            {"symbol": symbol, "result": numbers.tolist(), "float": "f8" in result, "left": left}
        )

    def close(self) -> None:
        """Write what a driver needs besides the calls."""
        self._write("E")
        self.script.close()
        lines = []
        for number, kinds in enumerate(self.symbols.values()):
            types, passed = ["void *", "void *"], ["(void *)w[0]", "(void *)w[1]"]
            for kind in kinds:
                words = [kind] if kind in _TYPES else ["p", "p", "i8", "i8", "p"]
                words += [] if kind in _TYPES else ["i8"] * (2 * kind.count(",") + 2)
                for word in words:
                    types.append(_TYPES.get(word, "void *"))
                    value = f"w[{len(passed)}]"
                    passed.append(f"number({value})" if word == "f8" else f"({types[-1]}){value}")
            lines.append(f"static int32_t call_{number}(void *f, const uint64_t *w) {{")
            lines.append(
                f"    return ((int32_t (*)({', '.join(types)}))f)({', '.join(passed)});\n}}"
            )
        names = ", ".join(f'"{name}"' for name in self.symbols)
        calls = ", ".join(f"call_{k}" for k in range(len(self.symbols)))
        lines += [f"static const char *NAMES[] = {{{names}}};"]
        lines += [f"static const caller CALLERS[] = {{{calls}}};"]
        (self.folder / "calls.h").write_text("\n".join(lines) + "\n")
        (self.folder / "expected.json").write_text(json.dumps(self.expected))


def _is_tuple(one: Any) -> bool:
    return isinstance(one, tuple)


_FUNCTION = native.function


def cases() -> None:
    """A published sweep, motions of problem P, and of two masses.

    Of linear laws: the others keep the addresses of series that were emitted for this processor.
    """
    import vibroimpact as vi

    case = vi.laboratory.case("B2-G1-A3")
    vi.sweep(case, case.frequencies[::60], threads=1)
    problem = vi.Rig(
        vi.Oscillator(
            "1 kg",
            vi.Isolator("1 N/m", "0.1 N s/m"),
            vi.Bumper("100 N/m", "2 N s/m", "0.5 m"),
            vi.Bumper("60 N/m", "1 N s/m", "0.7 m"),
        ),
        "0.6 N",
    )
    vi.simulate(problem, 20, frequency="1.2 rad/s")
    vi.steady(problem, frequency="0.7 rad/s")
    vi.lyapunov_exponents(problem, ["0.7 rad/s"], 20, transient=20, threads=1)
    pair = vi.Assembly(
        masses={"a": "1 kg", "b": "2 kg"},
        links={k: vi.Link("ground", k, vi.Isolator("1 N/m", "0.1 N s/m")) for k in "ab"},
        stops={"s": vi.Link("a", "b", vi.Bumper("30 N/m", "0.3 N s/m", "0.2 m"))},
    )
    vi.simulate(vi.Rig(pair, "1 m/s^2"), 20, frequency="0.2 Hz")


def record(folder: Path) -> None:
    """Record the cases."""
    recorder = Recorder(folder)
    native.function = recorder.function
    try:
        cases()
    finally:
        native.function = _FUNCTION
        recorder.close()


def zig(target: str, *arguments: str | Path) -> None:
    """Compile and link for a system that zig knows."""
    command = [sys.executable, "-m", "ziglang", "cc", "-target", target, "-O2", "-s"]
    subprocess.run([*command, *map(str, arguments)], check=True)


def build(folder: Path, target: str) -> Path:
    """Compile the driver for a system."""
    program = folder / ("replay.exe" if "windows" in target else "replay")
    zig(target, "-I", folder, "-o", program, Path(__file__).with_suffix(".c"), "-lc")
    return program


def largest_difference(folder: Path, answers: Path) -> dict[str, float]:
    """Of each function, the largest difference over the size of what it leaves."""
    raw, at = answers.read_bytes(), 0
    worst: dict[str, float] = {}
    for number, call in enumerate(json.loads((folder / "expected.json").read_text())):
        (status,) = struct.unpack_from("<q", raw, at)
        assert status in (0, -2), (call["symbol"], status)
        words = np.frombuffer(raw, np.float64 if call["float"] else np.int64, _RESULT, at + 8)
        at += 8 * (1 + _RESULT)
        pairs = [(np.array(call["result"], words.dtype), words[: len(call["result"])])]
        for one in call["left"]:
            expected = np.load(folder / f"{number}-{one['at']}.npy")
            there = np.frombuffer(raw, one["type"], expected.size, at).reshape(expected.shape)
            pairs.append((expected, there))
            at += expected.nbytes
        for expected, there in pairs:
            worst[call["symbol"]] = max(worst.get(call["symbol"], 0.0), _away(expected, there))
    assert at == len(raw)
    return worst


def _away(expected: np.ndarray, there: np.ndarray) -> float:
    """Largest difference over the size: of a column, or of a list of numbers."""
    if expected.dtype.kind != "f":
        return 0.0 if np.array_equal(expected, there) else np.inf
    finite = np.isfinite(expected)
    if not np.array_equal(finite, np.isfinite(there)):
        return np.inf
    # What was never written may hold addresses, which read as numbers below 1e-300.
    one, other = (
        np.where(finite & (np.abs(part) > _ADDRESS), part, 0.0) for part in (expected, there)
    )
    if not one.size:
        return 0.0
    size = np.abs(one).max(axis=0) if one.ndim > 1 else np.abs(one).max()
    return float(np.max(np.abs(one - other) / np.where(size > 0.0, size, 1.0)))


if __name__ == "__main__":
    record(Path(sys.argv[1]))
