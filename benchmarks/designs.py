"""Design charts: time for a chart under sines of a range of frequencies."""

import time

import numpy as np

import vibroimpact as vi
from benchmarks.report import Table, met, targets

_SECONDS = 30.0
_NODES = 50


def charted(nodes: int, threads: int = 2) -> tuple[float, int]:
    """Seconds for a chart over gap and bumper stiffness, and its holds without a period."""
    wall = vi.Bumper("500 MN/m", "5 MN s/m", "300 mm")
    isolator = vi.Isolator.from_period("5000 t", period="2.5 s", damping_ratio=0.15)
    building = vi.Oscillator("5000 t", isolator, wall, wall)
    vary = {
        "gap": np.linspace(0.1, 0.9, nodes),
        "stops.stiffness": np.geomspace(1e7, 5e8, nodes),
    }
    begin = time.perf_counter()
    data = vi.design_chart(
        vi.Rig(building, "0.15 g"), vary, frequency_span=("0.15 Hz", "1.2 Hz"), threads=threads
    )
    return time.perf_counter() - begin, int(data["unsettled_count"].sum())


def designs() -> Table:
    """Measure a chart of 50 by 50 designs."""
    table = targets("Design charts")
    charted(3)  # compiles
    seconds, unsettled = charted(_NODES)
    table.add(
        f"{_NODES} × {_NODES} designs, sines from 0.15 to 1.2 Hz both ways, 2 threads, s",
        f"{seconds:.1f}",
        f"under {_SECONDS:g} s",
        met(seconds < _SECONDS),
    )
    table.add("ms a design and thread", f"{2e3 * seconds / _NODES**2:.1f}", "", "")
    table.notes.append(
        "A building of 5,000 t, T = 2.5 s, 15 % damping, 0.15 g; gaps from 0.1 to 0.9 m, bumpers "
        "from 10 to 500 MN/m. Steps of 0.02 of the natural frequency, 64 times as fine about the "
        f"largest displacement and acceleration. {unsettled} holds were not periodic."
    )
    return table
