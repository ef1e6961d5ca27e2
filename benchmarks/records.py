"""A motion through a long record, beside OpenSeesPy."""

import time
from importlib import import_module

import numpy as np

import vibroimpact as vi
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, interleave

_COUNT, _STEP, _PEAK = 10_000, 0.01, 1.5
_MILLISECONDS, _TIMES = 3.0, 300.0
_DIVISIONS = (1, 10, 100)
_ROUNDS = 21


def record() -> vi.Record:
    """A made-up strong motion of 100 s: noise between 0.2 and 10 Hz that swells and fades."""
    rng = np.random.default_rng(1)
    time_ = np.arange(_COUNT) * _STEP
    frequency = np.linspace(0.2, 10.0, 200)
    phase = rng.uniform(0.0, 2.0 * np.pi, len(frequency))
    noise = np.sin(2.0 * np.pi * np.outer(time_, frequency) + phase).sum(axis=1)
    shape = (time_ / 10.0) ** 2 * np.exp(-time_ / 10.0)
    values = noise * shape
    return vi.Record(values * (_PEAK / np.abs(values).max()), _STEP)


def records() -> Table:
    """Time the motion of B3-G3-A3 through it, and what OpenSees needs for the same peak."""
    rig, shaking = vi.laboratory.case("B3-G3-A3").oscillator, record()
    table = targets(f"A record of {_COUNT:,} samples at {_STEP:g} s on B3-G3-A3, warm")
    fine = vi.simulate(vi.Rig(rig, shaking), samples=200)
    peak = float(np.abs(fine["displacement"]).max())
    seconds = interleave(
        {
            "samples": lambda: vi.simulate(vi.Rig(rig, shaking)),
            "end": lambda: vi.simulate(vi.Rig(rig, shaking), samples=0),
        },
        _ROUNDS,
        clock=time.thread_time,
    )
    ours = Spread.of(seconds["samples"])
    table.add(
        "vi.simulate, ms",
        ours.text(1e3),
        f"under {_MILLISECONDS:g} ms",
        met(1e3 * ours.median < _MILLISECONDS),
    )
    table.add("the same, final state alone, ms", Spread.of(seconds["end"]).text(1e3), "", "")
    contacts = int((fine["event_contact"] == 1).sum())
    table.notes.append(
        f"The motion has {contacts} contacts and a peak of {1e3 * peak:.4f} mm. The time of "
        "vi.simulate includes its labelled dataset, with every sample and event."
    )
    try:
        peer = import_module("benchmarks.peers.opensees_peer")
    except ImportError as missing:
        table.notes.append(f"OpenSeesPy is not installed ({missing}).")
        return table
    exact = vi.simulate(vi.Rig(rig, shaking))["displacement"].values
    for divisions in _DIVISIONS:
        begin = time.thread_time()
        displacement = peer.follow(rig, shaking, divisions)
        spent = time.thread_time() - begin
        error = abs(np.abs(displacement).max() - np.abs(exact).max()) / np.abs(exact).max()
        ratio = spent / ours.median
        last = divisions == _DIVISIONS[-1]
        table.add(
            f"OpenSeesPy, {divisions} steps a sample: times as long",
            f"{ratio:,.0f} ({spent:.2f} s), peak off by {100 * error:.2g} %",
            f"{_TIMES:g} at the same error" if last else "",
            met(ratio > _TIMES) if last else "",
        )
    table.notes.append(
        "Peaks at the record's samples. OpenSeesPy does not reach the accuracy of vi.simulate, "
        "whose peaks are right to rounding, with any number of steps. At the same error, the ratio "
        "is larger than in the last row."
    )
    return table
