"""Whether memory grows with the number of forcing cycles."""

import sys
from collections.abc import Callable
from pathlib import Path

import vibroimpact as vi
from benchmarks import fresh, ours
from benchmarks.peers.problem import P, Problem
from benchmarks.report import Table, met, targets

_FEW, _MANY = 10_000, 1_000_000
_ALLOWED = 1024.0
"""Growth in KiB that is called none; eight bytes a cycle would be eight times as much."""


def memory() -> Table:
    """Measure in a new process each."""
    table = targets("Peak memory")
    for what, function in (
        ("vi.simulate, no samples", "simulate_growth"),
        ("one hold of vi.sweep on a motion that never settles", "hold_growth"),
    ):
        code = f"from benchmarks.memory import {function}; print(*{function}())"
        before, growth = map(float, fresh.python(code).output.split())
        table.add(
            f"{what}: growth from {_FEW:,} to {_MANY:,} cycles, KiB",
            f"{growth:,.0f} (of {before / 1024.0:.0f} MiB)",
            "none",
            met(growth <= _ALLOWED),
        )
    table.notes.append(
        f"A growth of up to {_ALLOWED:,.0f} KiB counts as none, because the allocator reserves "
        "whole pages."
    )
    return table


def simulate_growth() -> tuple[float, float]:
    """Peak memory (KiB) after few cycles of problem P, and its growth over many."""
    rig = ours.oscillator()
    shaking = vi.Harmonic(P.amplitude, ours.frequency(), ours.PHASE)

    def follow(cycles: int) -> None:
        vi.simulate(vi.Rig(rig, shaking), cycles=cycles, samples=0)

    return _growth(follow)


def hold_growth() -> tuple[float, float]:
    """Measure the same of a hold that waits for half the cycles and measures over the rest."""
    restless = Problem(frequency=1.3, amplitude=1.0, bumper_stiffness=200.0, gap=0.3)
    rig, frequencies = ours.oscillator(restless), [ours.frequency(restless)]

    def follow(cycles: int) -> None:
        half = cycles // 2
        data = vi.sweep(
            vi.Rig(rig, restless.amplitude), frequencies, "forward", max_cycles=half, window=half
        )
        if int(data["cycles"].item()) != cycles:
            raise RuntimeError("the motion has settled; find another that does not")

    return _growth(follow)


def _growth(follow: Callable[[int], None]) -> tuple[float, float]:
    follow(_FEW)
    before = peak()
    follow(_MANY)
    return before, peak() - before


def peak() -> float:
    """Greatest resident memory of this process so far, in KiB."""
    status = Path("/proc/self/status")
    if status.exists():  # getrusage would count the parent's, from before the program began
        for line in status.read_text(encoding="ascii").splitlines():
            if line.startswith("VmHWM"):
                return float(line.split()[1])
    import resource

    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most / 1024.0 if sys.platform == "darwin" else float(most)
