"""Where sweeps arrive: the states in which a frequency is reached from below and from above."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from vibroimpact.model import AssemblyState, State
from vibroimpact.model.rig import Rig
from vibroimpact.response.curve_pair import DIRECTIONS
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.sweep import check_frequencies, sweep


def arrivals(
    rig: Rig,
    frequencies: Iterable[float | str] | None = None,
    max_cycles: int = 2000,
    max_events: int = 10_000,
) -> dict[str, State | AssemblyState]:
    """Where a forward and a backward sweep arrive: states by "forward branch", "backward branch".

    Parameters are those of `coexisting_motions`. A sweep without a frequency to begin with is left
    out.
    """
    system, excitation = rig.system, rig.periodic
    if frequencies is None:
        # Never the natural frequency itself, which an undamped isolator forbids.
        unit = system.angular_frequency / math.tau or excitation.frequency
        grid = unit * (np.arange(0.3, 6.0, 0.01) + 0.005)
    else:
        grid = check_frequencies(frequencies)
    aim = excitation.frequency
    arrived: dict[str, State | AssemblyState] = {}
    for direction in DIRECTIONS:
        forward = direction == "forward"
        path = grid[grid < aim * (1 - 1e-12)] if forward else grid[grid > aim * (1 + 1e-12)]
        if not len(path):
            continue
        data = sweep(
            Rig(system, excitation),
            path,
            direction,
            phase=excitation.phase,
            max_cycles=max_cycles,
            max_events=max_events,
        )
        last = data["section"].isel(direction=0, frequency=-1 if forward else 0, drop=True)
        arrived[f"{direction} branch"] = engine_system(system).read(last)
    return arrived
