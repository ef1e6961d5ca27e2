"""The engine compiled: its entries, and the functions of each flow; as a script, before the tests.

Otherwise each worker would compile what it needs first, while the others wait for it. Flows share
nothing, so they are compiled side by side.
"""

from __future__ import annotations

import importlib
import pkgutil
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from functools import partial

from vibroimpact import engine
from vibroimpact.engine import flow_tables, jit, native
from vibroimpact.engine.entry import Entry
from vibroimpact.engine.flow_tables import plan_of
from vibroimpact.engine.parameters import Drive, free_rig, rig_vector
from vibroimpact.law_numbers import IsolatorNumbers
from vibroimpact.tasks.progress import progress_bar
from vibroimpact.tasks.threads import available

_YIELDS = IsolatorNumbers(friction=1.0)
_SEVERAL = Drive(weights=((1.0, 0.0), (0.0, 1.0)))
_RECORD = Drive(interval=1.0)

RIGS = {
    "Curved": rig_vector(1.0, 1.0, 0.1, None, None, law=IsolatorNumbers(cubic=1.0)),
    "Yielding": rig_vector(1.0, 1.0, 0.1, None, None, law=_YIELDS),
    "AnyStops": rig_vector(1.0, 1.0, 0.1, (0.5, 1.0), None),
    "Bumpers": free_rig(),
    "Several": rig_vector(1.0, 1.0, 0.1, None, None, drive=_SEVERAL),
    "Recorded": rig_vector(1.0, 1.0, 0.1, None, None, drive=_RECORD),
    "YieldingSeveral": rig_vector(1.0, 1.0, 0.1, None, None, drive=_SEVERAL, law=_YIELDS),
    "YieldingRecorded": rig_vector(1.0, 1.0, 0.1, None, None, drive=_RECORD, law=_YIELDS),
}
"""A rig for each flow; what takes longest begins first."""

GROUPS = {
    "Recorded": ("motion", "recorded", "measured"),
    "YieldingSeveral": ("motion", "recorded", "measured"),
    "YieldingRecorded": ("motion", "recorded", "measured"),
}
"""Of the functions of a flow those that the tests ask for, if not all; others by their tests."""


def entries() -> list[Entry]:
    """The engine's entries, which are compiled once for all flows."""
    names = [info.name for info in pkgutil.walk_packages(engine.__path__, f"{engine.__name__}.")]
    return [
        value
        for name in names
        for value in vars(importlib.import_module(name)).values()
        if type(value) is Entry and value.function.__module__ == name
    ]


def parts(flow: str) -> list[Callable[[], object]]:
    """What compiles or loads each group of the functions of a flow, or each entry."""
    if flow == ENTRIES:
        return [partial(entry.of, plan_of(RIGS["Bumpers"], ())) for entry in entries()]
    groups = GROUPS.get(flow, tuple(flow_tables.GROUPS))
    return [partial(plan_of, RIGS[flow], (group,)) for group in groups]


def compile_for(flow: str) -> None:
    """Compile the functions of a flow, or the entries."""
    for part in parts(flow):
        part()


def compiled(flow: str, finished: list[str]) -> int:
    """Compile in a process of its own, which writes a line for each part."""
    command = [sys.executable, __file__, flow]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        finished.extend(process.stdout)
    return process.returncode


def compile_all() -> int:
    """Compile all flows side by side, with a bar; whether one failed."""
    flows, finished = [*RIGS, ENTRIES], []
    total = sum(len(parts(flow)) for flow in flows)
    show = progress_bar("compiling the engine")
    with ThreadPoolExecutor(available()) as pool:
        running = {pool.submit(compiled, flow, finished) for flow in flows}
        while any(not one.done() for one in running):
            show(len(finished), total)
            wait(running, timeout=0.5)
    show(total, total)
    return any(one.result() for one in running)


ENTRIES = "entries"

if __name__ == "__main__":
    if sys.argv[1:]:
        if sys.argv[1] != next(iter(RIGS)):
            jit.announce = lambda text: None  # it is said once
        for part in parts(sys.argv[1]):
            part()
            print("done", flush=True)
    elif native.find_library() is None:
        sys.exit(compile_all())
