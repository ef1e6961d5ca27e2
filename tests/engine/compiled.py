"""The engine compiled: its entries, and the functions of each flow; as a script, before the tests.

Otherwise each worker would compile what it needs first, while the others wait for it. Flows share
nothing, so they are compiled side by side.
"""

from __future__ import annotations

import importlib
import pkgutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

from vibroimpact import engine
from vibroimpact.engine import flow_tables, jit
from vibroimpact.engine.entry import Entry
from vibroimpact.engine.flow_tables import plan_of
from vibroimpact.engine.parameters import Drive, free_rig, rig_vector
from vibroimpact.law_numbers import IsolatorNumbers
from vibroimpact.tasks.threads import available

_YIELDS = IsolatorNumbers(friction=1.0)
_SEVERAL = Drive(weights=((1.0, 0.0), (0.0, 1.0)))
_RECORD = Drive(interval=1.0)

RIGS = {
    "Curved": rig_vector(1.0, 1.0, 0.1, None, None, law=IsolatorNumbers(cubic=1.0)),
    "Yielding": rig_vector(1.0, 1.0, 0.1, None, None, law=_YIELDS),
    "AnyStops": rig_vector(1.0, 1.0, 0.1, (0.5, 1.0), None),
    "Apart": free_rig(),
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
    names = [found.name for found in pkgutil.walk_packages(engine.__path__, f"{engine.__name__}.")]
    return [
        value
        for name in names
        for value in vars(importlib.import_module(name)).values()
        if type(value) is Entry and value.function.__module__ == name
    ]


def compile_for(flow: str) -> None:
    """Compile the functions of a flow, or the entries."""
    if flow == ENTRIES:
        for entry in entries():
            entry.of(plan_of(RIGS["Apart"], ()))
    else:
        plan_of(RIGS[flow], GROUPS.get(flow, tuple(flow_tables.GROUPS)))


def compiled(flow: str) -> int:
    return subprocess.call([sys.executable, __file__, flow])


ENTRIES = "entries"

if __name__ == "__main__":
    if sys.argv[1:]:
        if sys.argv[1] != next(iter(RIGS)):
            jit.announce = lambda text: None  # it is said once
        compile_for(sys.argv[1])
    else:
        with ThreadPoolExecutor(available()) as pool:
            sys.exit(any(pool.map(compiled, [*RIGS, ENTRIES])))
