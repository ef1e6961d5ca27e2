"""The whole published campaign: 48 rigs, forward and backward, converged."""

import time
from collections.abc import Callable

import numpy as np

import vibroimpact as vi
from benchmarks.machine import processors
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, interleave
from vibroimpact.engine import batch

_ROUNDS = 11
_TARGET = 1.0
_THREADS = (1, 2)


def campaign() -> Table:
    """Measure `vi.sweeps` of the campaign on one and on two threads."""
    rigs = vi.laboratory.campaign()
    frequencies = rigs[0].frequencies

    batch.sweep.prepare()
    begin = time.perf_counter()
    data = vi.sweeps(rigs, frequencies)
    first = time.perf_counter() - begin
    cycles = int(data["cycles"].sum())
    unsettled = int(np.sum(data["motion"] == "undecided"))

    def on(threads: int) -> Callable[[], object]:
        return lambda: vi.sweeps(rigs, frequencies, threads=threads)

    seconds = interleave({str(n): on(n) for n in _THREADS}, _ROUNDS)
    table = targets("The published campaign by vi.sweeps, warm")
    for threads in _THREADS:
        spread = Spread.of(seconds[str(threads)])
        plural = "s" if threads > 1 else ""
        target = f"under {_TARGET:g} s" if threads == 2 else ""
        verdict = met(spread.median < _TARGET) if threads == 2 else ""
        table.add(f"{threads} thread{plural}, s", spread.text(), target, verdict)
        table.add(
            f"{threads} thread{plural}, ns a forcing cycle", spread.text(1e9 / cycles), "", ""
        )
    table.add("first call of a process, after loading the code, s", f"{first:.2f}", "", "")
    table.notes.append(
        f"{len(rigs)} rigs × {data.sizes['direction']} directions × {len(frequencies)} "
        f"frequencies = {data['cycles'].size:,} holds, with {cycles:,} forcing cycles. {unsettled} "
        "do not settle, and are measured over 500 cycles after 2,000. Times include checks, "
        "free-flight references and the labelled dataset."
    )
    if processors() < max(_THREADS):
        table.notes.append("There is only one processor: two threads cannot be faster.")
    return table
