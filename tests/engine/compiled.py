"""Each entry of the engine, compiled for each flow; as a script, before the tests start.

Otherwise each worker would compile the kernels again for the entry that it needs first, while the
others wait for it. Flows share nothing, so they are compiled side by side.
"""

from __future__ import annotations

import importlib
import pkgutil
import subprocess
import sys

from vibroimpact import engine
from vibroimpact.engine import jit
from vibroimpact.engine.earthquakes import respond
from vibroimpact.engine.entry import Entry
from vibroimpact.engine.parameters import Law, free_rig, rig_vector
from vibroimpact.engine.recorded import follow

RIGS = {
    "Apart": free_rig(),
    "AnyStops": rig_vector(1.0, 1.0, 0.1, (0.5, 1.0), None),
    "Curved": rig_vector(1.0, 1.0, 0.1, None, None, law=Law(cubic=1.0)),
    "Yielding": rig_vector(1.0, 1.0, 0.1, None, None, law=Law(friction=1.0)),
}
"""A rig for each flow of one sine; the flows of other forcings are compiled by their tests."""

RECORDED = (follow, respond)
"""Entries that only records go into."""


def entries() -> list[Entry]:
    """All of the engine's that one sine needs; those without a rig are compiled by their tests."""
    names = [found.name for found in pkgutil.walk_packages(engine.__path__, f"{engine.__name__}.")]
    return [
        value
        for name in names
        for value in vars(importlib.import_module(name)).values()
        if type(value) is Entry and value.function.__module__ == name and value not in RECORDED
    ]


def compile_for(flow: str) -> None:
    for entry in entries():
        entry.prepare(RIGS[flow])


if __name__ == "__main__":
    if sys.argv[1:]:
        if sys.argv[1] != next(iter(RIGS)):
            jit.announce = lambda text: None  # it is said once
        compile_for(sys.argv[1])
    else:
        side_by_side = [subprocess.Popen([sys.executable, __file__, flow]) for flow in RIGS]
        codes = [process.wait() for process in side_by_side]
        sys.exit(any(codes))
