"""What every command takes however little it computes: starting, reading, writing, drawing."""

import json
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks import fresh
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, ratio

_ROUNDS = 5
_CASE = "B2-G1-A3"
_SINE = ("--frequency", "2Hz")
_FEW = ("--from", "2Hz", "--to", "2.1Hz")
_VARY = ("--vary", "frequency=2Hz:2.1Hz")
_RECORD, _TEST = "quake.csv", "test.csv"

COMMANDS = {
    "help": ("rigs",),
    "show": (_CASE,),
    "sweep": (_CASE, *_FEW, "--step", "0.1Hz"),
    "motion": (_CASE, *_SINE),
    "branch": (_CASE, *_VARY, "--random", "0"),
    "bifurcation": (_CASE, "--vary", "frequency=2Hz:2.1Hz:2"),
    "curve": (_CASE, "--vary", "frequency=2.4Hz:2.8Hz", "--vary", "gap=7mm:8mm"),
    "basins": (_CASE, *_SINE, "--nodes", "10"),
    "manifolds": (_CASE, *_SINE, "--nodes", "10", "--spacing", "0.1", "--longest", "1"),
    "basin-stability": (_CASE, "--vary", "frequency=2Hz:2.1Hz:2", "--samples", "10"),
    "simulate": (_CASE, *_SINE, "--cycles", "1"),
    "record": (_RECORD, "--periods", "2"),
    "earthquake": (_CASE, _RECORD),
    "design": (_CASE, *_VARY, "--vary", "gap=5mm:10mm:2"),
    "ensemble": (_CASE, "--uncertain", "gap=normal:5%", "--draws", "2", *_FEW),
    "classify": (_CASE,),
    "identify": (_TEST, "--rig", _CASE, "--free", "gap", "--starts", "1"),
    "map": ("--vary", "gap_ratio=0.2:0.4:2", "--vary", "stiffness_ratio=5:10:2", "--refine", "0"),
    "explore": (_CASE, "--no-browser"),
    "init": (),
    "cache": (),
}
"""Words of each command by its name; `explore` is ended once it prints the address of its page."""

_UNIT = "import numpy, xarray, matplotlib.pyplot"
_ENGINES = {"library": "", "numba": "numba"}
_MOST = 1.03
"""Of the library's time over that of code that numba compiled for this processor."""
_PROBLEM = """\
import json, time
from benchmarks import ours
from benchmarks.rounds import interleave
calls = {"engine": ours.engine(1_000)}
print(json.dumps(interleave(calls, 11, clock=time.thread_time)["engine"]))
"""


def inputs(folder: Path) -> None:
    """Write the record and the test that the commands read."""
    rows = [f"{0.01 * k:.2f},{math.sin(0.1 * k):.6f}" for k in range(200)]
    (folder / _RECORD).write_text("\n".join(["time (s),acceleration (m/s^2)", *rows]))
    fresh.python(
        "import vibroimpact as vi\n"
        f"data = vi.sweep({_CASE!r}, [1.0, 1.5, 2.0, 2.5, 3.0])\n"
        "rows = ['# amplitude = 0.05 g', 'f (Hz),direction,Ed (m)']\n"
        "for one in data.displacement_excursion.stack(point=('direction', 'frequency')):\n"
        "    way, f = one.point.item()\n"
        "    rows.append(f'{f},{way},{float(one)}')\n"
        f"open({str(folder / _TEST)!r}, 'w').write('\\n'.join(rows))\n"
    )


def run(name: str, source: Path) -> float:
    """Seconds of one command in a process of its own, with the `inputs` of a folder."""
    words = [str(source / word) if word in (_RECORD, _TEST) else word for word in COMMANDS[name]]
    # A folder of its own: a map that is complete would only be read.
    with tempfile.TemporaryDirectory() as out:
        if name == "explore":
            return _until_served(words)
        if name == "init":
            words = [str(Path(out) / "rig.toml")]
        elif name not in ("cache", "help"):
            words += ["--output", out]
        return fresh.vibroimpact(name, *words).seconds


def _until_served(words: list[str]) -> float:
    command = [str(Path(sys.executable).with_name("vibroimpact")), "explore", *words]
    begin = time.perf_counter()
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        first = server.stdout.readline()
        seconds = time.perf_counter() - begin
        server.terminate()
    if "http" not in first:
        raise RuntimeError(f"explore failed: {first}")
    return seconds


def fixed() -> list[Table]:
    """Measure the commands in turn, after each has run once, and the engine by numba."""
    table = Table(
        f"Fixed part of each command, whole process, in units of `{_UNIT}` of the same round",
        ("Command", "Smallest task", "`--help`"),
    )
    units: list[float] = []
    tasks: dict[str, list[float]] = {name: [] for name in COMMANDS}
    helps: dict[str, list[float]] = {name: [] for name in COMMANDS}
    with tempfile.TemporaryDirectory() as source:
        inputs(Path(source))
        for name in COMMANDS:
            run(name, Path(source))  # compiles
        for _ in range(_ROUNDS):
            units.append(fresh.python(_UNIT).seconds)
            for name in COMMANDS:
                tasks[name].append(run(name, Path(source)))
                helps[name].append(fresh.vibroimpact(name, "--help").seconds)
    for name in COMMANDS:
        table.add(f"`{name}`", ratio(tasks[name], units).text(), ratio(helps[name], units).text())
    table.notes.append(
        f"The smallest task of each command, {_ROUNDS} times in turn: median and range. The unit "
        f"takes {Spread.of(units).text()} s. The sweeps of `classify` and the steps of `branch` "
        "and `curve` are as fine as always. `explore` ends when its page is served."
    )
    return [table, by_numba()]


def by_numba() -> Table:
    """Time problem P in the library and as numba compiles it, in processes in turn."""
    seconds: dict[str, list[float]] = {name: [] for name in _ENGINES}
    for turn in range(_ROUNDS + 1):
        for name, engine in _ENGINES.items():
            ended = fresh.python(_PROBLEM, {"VIBROIMPACT_ENGINE": engine})
            if turn:  # the first compiles
                seconds[name].append(Spread.of(json.loads(ended.output)).median)
    behind = ratio(seconds["library"], seconds["numba"])
    table = targets("Problem P, 1,000 periods: the library, and the engine compiled by numba")
    for name in seconds:
        table.add(f"{name}, ms", Spread.of(seconds[name]).text(1e3), "", "")
    table.add("library over numba", behind.text(), f"at most {_MOST}", met(behind.median <= _MOST))
    table.notes.append(f"{_ROUNDS} processes of each, in turn.")
    return table
