"""Steady motions with their verdicts, and Lyapunov spectra over a grid of parameters."""

import time

import numpy as np

import vibroimpact as vi
from benchmarks.machine import processors
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, interleave

_ROUNDS = 11
_PERIODIC = 0.05
_WANDERING = 1.0
_SPECTRA = 60.0
_GAPS, _FREQUENCIES, _CYCLES = 100, 100, 1000


def motions() -> Table:
    """Measure `vi.steady` of one frequency and `vi.lyapunov_exponents` of 10,000."""
    case = vi.laboratory.case("B3-10mm-A3")

    def steady(frequency: float) -> object:
        return vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, frequency)))

    table = targets("Motions and their kinds, warm")
    seconds = interleave(
        {"periodic": lambda: steady(1.2), "chaotic": lambda: steady(1.06)}, _ROUNDS
    )
    for kind, target in (("periodic", _PERIODIC), ("chaotic", _WANDERING)):
        spread = Spread.of(seconds[kind])
        table.add(
            f"vi.steady, {kind}, with the verdict, ms",
            spread.text(1e3),
            f"under {1e3 * target:,.0f} ms",
            met(spread.median < target),
        )
    rigs = {
        f"{gap:.3f} mm": vi.Rig(
            vi.laboratory.case(f"B3-{gap:.3f}mm-A3").oscillator,
            vi.Harmonic(case.amplitude, 1.0),
        )
        for gap in np.linspace(5.0, 25.0, _GAPS)
    }
    frequencies = np.linspace(0.5, 3.0, _FREQUENCIES)
    begin = time.perf_counter()
    data = vi.lyapunov_exponents(rigs, frequencies, _CYCLES, threads=2)
    taken = time.perf_counter() - begin
    count = data["status"].size
    cycles = count * (_CYCLES + 600)
    table.add(
        f"{count:,} Lyapunov spectra of {_CYCLES:,} cycles, 2 threads, s",
        f"{taken:.1f}",
        f"under {_SPECTRA:g} s",
        met(taken < _SPECTRA),
    )
    table.add("the same, µs a forcing cycle and thread", f"{2e6 * taken / cycles:.2f}", "", "")
    chaotic = int((data["exponents"][..., 0] > 0.01).sum())
    table.notes.append(
        f"Spectra of B3-A3 at {_GAPS} gaps from 5 to 25 mm and {_FREQUENCIES} frequencies from 0.5 "
        "to 3 Hz, with 600 further cycles each for the transient and the directions. "
        f"{chaotic:,} have a positive exponent."
    )
    if processors() < 2:
        table.notes.append("There is only one processor: two threads cannot be faster.")
    return table
