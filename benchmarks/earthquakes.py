"""Suites of records at many scales on rigs with many gaps, beside OpenSeesPy on a part."""

import time
from importlib import import_module

import numpy as np
import xarray as xr

import vibroimpact as vi
from benchmarks.report import Table, met, targets

_RECORDS, _SCALES, _GAPS, _SAMPLES, _STEP = 40, 20, 10, 5_000, 0.01
_THREADS, _SECONDS, _TIMES = 2, 20.0, 200.0
_DIVISIONS = (1, 10, 100)
_ROUNDS = 3


def record(seed: int) -> vi.Record:
    """A made-up strong motion: noise between 0.2 and 10 Hz that swells and fades."""
    rng = np.random.default_rng(seed)
    at = np.arange(_SAMPLES) * _STEP
    frequency = np.linspace(0.2, 10.0, 200)
    phase = rng.uniform(0.0, 2.0 * np.pi, len(frequency))
    noise = np.sin(2.0 * np.pi * np.outer(at, frequency) + phase).sum(axis=1)
    return vi.Record(noise * (at / 6.0) ** 2 * np.exp(-at / 6.0), _STEP)


def earthquakes() -> Table:
    """Time vi.demands on B3-A3, and what OpenSees needs for some of its runs."""
    rig = vi.laboratory.case("B3-G3-A3").oscillator
    records = [record(seed) for seed in range(_RECORDS)]
    scales = np.linspace(0.1, 3.0, _SCALES)
    gaps = np.linspace(0.005, 0.020, _GAPS)
    runs = _RECORDS * _SCALES * _GAPS
    table = targets(
        f"vi.demands: {_RECORDS} records of {_SAMPLES:,} samples × {_SCALES} scales × {_GAPS} "
        f"gaps, {_THREADS} threads, warm"
    )

    def ask() -> tuple[float, float, xr.Dataset]:
        begin, worked = time.perf_counter(), time.process_time()
        demands = vi.demands(
            rig, records, scales, intensity="PGA", vary={"gap": gaps}, threads=_THREADS
        )
        return time.perf_counter() - begin, time.process_time() - worked, demands

    vi.demands(rig, records[:1], 1.0)
    timed = [ask() for _ in range(_ROUNDS)]
    seconds, work = (min(values) for values in list(zip(*timed, strict=True))[:2])
    demands = timed[-1][-1]
    table.add(
        f"{runs:,} runs, s", f"{seconds:.1f}", f"under {_SECONDS:g} s", met(seconds < _SECONDS)
    )
    each = work / runs
    table.add("processor time of a run, ms", f"{1e3 * each:.2f}", "", "")
    impacts = demands["impact_count"].sum("stop")
    table.notes.append(
        f"B3-A3 at gaps of 5 to 20 mm and peaks of 0.1 to 3 m/s²: {float((impacts > 0).mean()):.0%}"
        f" of the runs touch a bumper, with {float(impacts.mean()):.1f} contacts per run. The "
        "dataset has the peaks, forces, impulses, counts and residual displacements."
    )
    try:
        peer = import_module("benchmarks.peers.opensees_peer")
    except ImportError as missing:
        table.notes.append(f"OpenSeesPy is not installed ({missing}).")
        return table
    one = demands.isel(record=0, gap=4)
    part = rig.replace(
        **{side: getattr(rig, side).replace(gap=float(one["gap"])) for side in ("right", "left")}
    )
    chosen = (6, 13, 19)
    ours = one["peak_displacement"].values[list(chosen)]
    for divisions in _DIVISIONS:
        begin = time.thread_time()
        theirs = [
            peer.peak(part, records[0].scaled(float(one["factor"][k])), divisions) for k in chosen
        ]
        ratio = (time.thread_time() - begin) / len(chosen) / each
        error = np.abs(np.array(theirs) / ours - 1.0).max()
        last = divisions == _DIVISIONS[-1]
        table.add(
            f"OpenSeesPy, {divisions} steps a sample: times as long a run",
            f"{ratio:,.0f}, peak off by {100 * error:.2g} %",
            f"{_TIMES:g} at the same error" if last else "",
            met(ratio > _TIMES) if last else "",
        )
    table.notes.append(
        f"OpenSees computes {len(chosen)} of the runs; its peak is that of its steps. It does not "
        "reach the accuracy of vi.demands, whose peaks are right to rounding, with any number of "
        "steps. At the same error, the ratio is larger than in the last row."
    )
    return table
