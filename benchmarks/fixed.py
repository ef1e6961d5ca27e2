"""What every command takes however little it computes: starting, reading, writing, drawing."""

import math
import tempfile
from pathlib import Path

from benchmarks import fresh
from benchmarks.report import Table
from benchmarks.rounds import Spread, digits

_ROUNDS = 5
_CASE = "B2-G1-A3"
_SINE = ("--frequency", "2Hz")
_FEW = ("--from", "2Hz", "--to", "2.1Hz")
_VARY = ("--vary", "frequency=2Hz:2.1Hz")
_RECORD, _TEST = "quake.csv", "test.csv"

COMMANDS = {
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
    "design": (_CASE, *_FEW, "--vary", "gap=5mm:10mm:2"),
    "ensemble": (_CASE, "--uncertain", "gap=normal:5%", "--draws", "2", *_FEW),
    "classify": (_CASE,),
    "identify": (_TEST, "--rig", _CASE, "--free", "gap", "--starts", "1"),
    "map": ("--vary", "gap_ratio=0.2:0.4:2", "--vary", "stiffness_ratio=5:10:2", "--refine", "0"),
    "cache": (),
}
"""Words of each command by its name; `explore` serves a page until it is ended, and `init`
writes a file and computes nothing."""


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


def run(name: str, source: Path) -> fresh.Ended:
    """Run one command in a process of its own, with the `inputs` of a folder."""
    words = [str(source / word) if word in (_RECORD, _TEST) else word for word in COMMANDS[name]]
    # A folder of its own: a map that is complete would only be read.
    with tempfile.TemporaryDirectory() as out:
        return fresh.vibroimpact(name, *words, *([] if name == "cache" else ["--output", out]))


def fixed() -> Table:
    """Measure the commands in turn, after each has run once."""
    table = Table(
        "Fixed part of each command, cached, whole process", ("Command", "s", "Processor")
    )
    ended: dict[str, list[fresh.Ended]] = {name: [] for name in COMMANDS}
    with tempfile.TemporaryDirectory() as source:
        inputs(Path(source))
        for name in COMMANDS:
            run(name, Path(source))  # compiles
        for _ in range(_ROUNDS):
            for name, runs in ended.items():
                runs.append(run(name, Path(source)))
    for name, runs in ended.items():
        seconds = Spread.of([one.seconds for one in runs])
        work = Spread.of([one.work for one in runs])
        table.add(f"`{name}`", seconds.text(), digits(work.median))
    table.notes.append(
        f"The smallest task of each command, {_ROUNDS} times in turn: median and range. The sweeps "
        "of `classify` and the steps of `branch` and `curve` are as fine as always. `explore` "
        "serves a page, and is left out."
    )
    return table
