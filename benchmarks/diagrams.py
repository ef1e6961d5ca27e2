"""Bifurcation diagrams and ensembles, beside a loop over scipy's integrator on a hundredth."""

import math
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

import vibroimpact as vi
from benchmarks.peers.problem import P
from benchmarks.peers.scipy_peer import run
from benchmarks.report import Table, met, targets

_VALUES, _POINTS = 1000, 200
_RIGS = 1000
_SHARE = 100
_DIAGRAM, _ENSEMBLE = 20.0, 60.0
_FASTER = 100.0
_RTOL, _ATOL = 1e-8, 1e-11
"""Of scipy: enough for a picture."""


def _rig(gap: float = P.gap) -> vi.Rig:
    """Problem P: the mass and the spring are 1, and the forcing is P's but for its phase."""
    stop = vi.Bumper(P.bumper_stiffness, P.bumper_damping, gap)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 2.0 * P.damping_ratio), stop, stop)
    return vi.Rig(rig, vi.Harmonic(P.amplitude, P.frequency / math.tau))


def _timed(work: Callable[[], object]) -> tuple[float, object]:
    begin = time.perf_counter()
    found = work()
    return time.perf_counter() - begin, found


def _diagram(table: Table) -> None:
    low, high = 0.2, 1.5

    def diagram(steps: int) -> object:
        return vi.bifurcation_diagram(_rig(), "gap", (low, high), steps, points=_POINTS, threads=2)

    diagram(3)
    seconds, data = _timed(lambda: diagram(_VALUES))
    cycles = float(data["cycles"].sum())  # type: ignore[index]
    gaps = np.linspace(low, high, _VALUES // _SHARE)
    theirs, _ = _timed(
        lambda: [run(2 * _POINTS, replace(P, gap=gap), _RTOL, _ATOL) for gap in gaps]
    )
    ratio = 2.0 * _SHARE * theirs / seconds
    table.add(
        f"diagram of {_VALUES:,} gaps up and down, with exponents, 2 threads, s",
        f"{seconds:.1f}",
        f"under {_DIAGRAM:g} s",
        met(seconds < _DIAGRAM),
    )
    table.add(
        f"a loop over scipy, {2 * _POINTS} cycles a gap without exponents, over that",
        f"{ratio:,.0f}",
        f"over {_FASTER:g}",
        met(ratio > _FASTER),
    )
    table.notes.append(
        f"Problem P over gaps from {low} to {high}: {cycles:,.0f} forcing cycles, without those of "
        f"the exponents. scipy (DOP853, rtol {_RTOL:g}) computes {len(gaps)} of the gaps once, "
        f"from rest; its time is multiplied by {2 * _SHARE}."
    )


def _ensemble(table: Table) -> None:
    rig = _rig()
    frequencies = np.linspace(0.5, 3.0, 50) / math.tau
    spread = {
        "gap": "normal:5%",
        "stops.stiffness": "lognormal:0.2",
        "isolator.damping": "lognormal:0.1",
    }

    def ensemble(count: int) -> object:
        response = partial(vi.sweeps, frequencies=frequencies, threads=2)
        return vi.ensemble(rig, spread, response, count, method="latin")

    ensemble(2)
    seconds, data = _timed(lambda: ensemble(_RIGS))
    cycles = data["cycles"].mean(("sample", "direction")).values  # type: ignore[index]

    def loop() -> None:
        for gap in np.linspace(0.9, 1.1, _RIGS // _SHARE):
            for frequency, count in zip(frequencies, cycles, strict=True):
                here = replace(P, gap=gap, frequency=math.tau * frequency)
                run(round(count), here, _RTOL, _ATOL)

    theirs, _ = _timed(loop)
    ratio = 2.0 * _SHARE * theirs / seconds
    table.add(
        f"ensemble of {_RIGS:,} rigs, {len(frequencies)} frequencies both ways, 2 threads, s",
        f"{seconds:.1f}",
        f"under {_ENSEMBLE:g} s",
        met(seconds < _ENSEMBLE),
    )
    table.add(
        "a loop over scipy of as many cycles, over that",
        f"{ratio:,.0f}",
        f"over {_FASTER:g}",
        met(ratio > _FASTER),
    )
    table.notes.append(
        "The ensemble draws P's gap, bumper stiffness and damping. scipy computes ten rigs in one "
        "direction, for as many cycles as the holds took on average; its time is multiplied by "
        f"{2 * _SHARE}."
    )


def diagrams() -> Table:
    """Measure a bifurcation diagram of 1,000 values, and an ensemble of 1,000 rigs."""
    table = targets("Bifurcation diagrams and ensembles")
    _diagram(table)
    _ensemble(table)
    return table
