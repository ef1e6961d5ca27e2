"""Each entry of the engine, compiled for each flow; as a script, before the tests start.

Otherwise each worker would compile the kernels again for the entry that it needs first, while the
others wait for it. Flows share nothing, so they are compiled side by side.
"""

from __future__ import annotations

import importlib
import pkgutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

from vibroimpact import engine
from vibroimpact.engine import jit
from vibroimpact.engine.batch import trajectory
from vibroimpact.engine.earthquakes import respond
from vibroimpact.engine.entry import Entry
from vibroimpact.engine.measure import measure_phases
from vibroimpact.engine.parameters import Drive, Law, free_rig, rig_vector
from vibroimpact.engine.record_forcing import follow
from vibroimpact.tasks.threads import available

_YIELDS = Law(friction=1.0)
_SEVERAL = Drive(weights=((1.0, 0.0), (0.0, 1.0)))
_RECORD = Drive(interval=1.0)

RIGS = {
    "Curved": rig_vector(1.0, 1.0, 0.1, None, None, law=Law(cubic=1.0)),
    "Yielding": rig_vector(1.0, 1.0, 0.1, None, None, law=_YIELDS),
    "AnyStops": rig_vector(1.0, 1.0, 0.1, (0.5, 1.0), None),
    "Apart": free_rig(),
    "Several": rig_vector(1.0, 1.0, 0.1, None, None, drive=_SEVERAL),
    "Recorded": rig_vector(1.0, 1.0, 0.1, None, None, drive=_RECORD),
    "YieldingSeveral": rig_vector(1.0, 1.0, 0.1, None, None, drive=_SEVERAL, law=_YIELDS),
    "YieldingRecorded": rig_vector(1.0, 1.0, 0.1, None, None, drive=_RECORD, law=_YIELDS),
}
"""A rig for each flow; what takes longest begins first."""

ONLY_RECORDS = (follow, respond)
"""Entries that only records go into."""


def entries(flow: str = "Apart") -> list[Entry]:
    """The engine's entries that the tests ask for of a flow; those without a rig by their tests."""
    names = [found.name for found in pkgutil.walk_packages(engine.__path__, f"{engine.__name__}.")]
    every = [
        value
        for name in names
        for value in vars(importlib.import_module(name)).values()
        if type(value) is Entry and value.function.__module__ == name
    ]
    if flow.endswith("Recorded"):
        return [*ONLY_RECORDS, measure_phases]
    if flow == "YieldingSeveral":
        return [trajectory, measure_phases]
    return [one for one in every if flow == "Curved" or one not in ONLY_RECORDS]


def compile_for(flow: str) -> None:
    for entry in entries(flow):
        entry.prepare(RIGS[flow])


def compiled(flow: str) -> int:
    return subprocess.call([sys.executable, __file__, flow])


if __name__ == "__main__":
    if sys.argv[1:]:
        if sys.argv[1] != next(iter(RIGS)):
            jit.announce = lambda text: None  # it is said once
        compile_for(sys.argv[1])
    else:
        with ThreadPoolExecutor(available()) as pool:
            sys.exit(any(pool.map(compiled, RIGS)))
