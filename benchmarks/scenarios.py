"""Maps of scenarios: time for ten thousand rigs, what it grows with, and memory."""

import time
from typing import Any

import numpy as np

import vibroimpact as vi
from benchmarks import fresh
from benchmarks.memory import peak
from benchmarks.report import Table, met, targets

_SECONDS = 45.0
_STUDY = 60.0
_GROWTH = 64.0
"""Growth of peak memory (MiB) that is called none, from one block to many: that of the largest
block, and the allocator's pages."""
_RATIO, _GAP = (0.5, 100.0), (0.0, 1.0)


def mapped(nodes: int, **how: Any) -> float:
    """Seconds for a map over λ and δ0, swept in both directions by hundredths."""
    begin = time.perf_counter()
    vi.scenario_map(
        None,
        ("stiffness_ratio", np.geomspace(*_RATIO, nodes)),
        ("gap_ratio", np.linspace(*_GAP, nodes)),
        threads=2,
        **how,
    )
    return time.perf_counter() - begin


def peak_memory(nodes: int) -> float:
    """Peak memory (MiB) of this process after a map."""
    mapped(nodes, where="threads", block=10)
    return peak() / 1024.0


def scenarios() -> Table:
    """Measure maps of three sizes, and the published study."""
    table = targets("Scenarios")
    mapped(3)  # compiles
    by = {where: mapped(25, where=where) for where in ("threads", "processes")}
    taken = {nodes: mapped(nodes) for nodes in (50, 100)}
    table.add(
        "100 × 100 map of (λ, δ0), both directions by 0.01, 2 processes, s",
        f"{taken[100]:.0f}",
        f"under {_SECONDS:g} s",
        met(taken[100] < _SECONDS),
    )
    for nodes, seconds in taken.items():
        each = f"{2e3 * seconds / nodes**2:.1f}"
        table.add(f"{nodes} × {nodes}: ms a rig and process", each, "", "")
    table.add(
        "25 × 25 on 2 threads, and on 2 processes with their start, s",
        " and ".join(f"{seconds:.1f}" for seconds in by.values()),
        "",
        "",
    )
    small, large = (
        float(
            fresh.python(
                f"from benchmarks.scenarios import peak_memory; print(peak_memory({nodes}))"
            ).output
        )
        for nodes in (10, 40)
    )
    table.add(
        "peak memory, from a map of 1 block to one of 16, MiB",
        f"{small:.0f} to {large:.0f}",
        f"+ {_GROWTH:g} at most",
        met(large - small < _GROWTH),
    )
    done = fresh.python(
        "import tempfile; from paper.__main__ import main\n"
        "with tempfile.TemporaryDirectory() as folder: main(['-o', folder])"
    )
    table.add(
        "the published study (make paper), all figures and claims, s",
        f"{done.seconds:.0f}",
        f"under {_STUDY:g} s",
        met(done.seconds < _STUDY),
    )
    table.notes.append(
        "λ from 0.5 to 100, δ0 from 0 to 1; ξ = 0.15, τ = 0.01; sweeps from 0.4 times the natural "
        "frequency to beyond the primary resonance."
    )
    return table
