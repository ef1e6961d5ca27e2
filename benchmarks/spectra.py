"""Response spectra of a long record, beside eqsig."""

from collections.abc import Callable
from importlib import import_module

import numpy as np

import vibroimpact as vi
from benchmarks.records import record
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, interleave

_PERIODS = np.geomspace(0.01, 10.0, 200)
_DAMPINGS = (0.0, 0.02, 0.05, 0.1, 0.2)
_SECONDS = 0.5
_ROUNDS = 5


def spectra() -> Table:
    """Time 200 periods at five damping ratios; errors are those of the displacement at 5 %."""
    quake = record()
    table = targets(f"Response spectra: {len(_PERIODS)} periods, {len(_DAMPINGS)} damping ratios")
    contestants: dict[str, Callable[[], object]] = {
        "ours": lambda: vi.response_spectrum(quake, _PERIODS, _DAMPINGS)
    }
    try:
        peer = import_module("eqsig.sdof").pseudo_response_spectra
        contestants["eqsig"] = lambda: [
            peer(quake.acceleration, quake.step, _PERIODS, ratio) for ratio in _DAMPINGS
        ]
    except ImportError as error:
        table.notes.append(f"eqsig is not installed ({error}).")
    seconds = interleave(contestants, _ROUNDS)
    ours = Spread.of(seconds["ours"])
    table.add(
        f"vi.response_spectrum, {len(quake.acceleration):,} samples, s",
        ours.text(),
        f"under {_SECONDS:g} s",
        met(ours.median < _SECONDS),
    )
    if "eqsig" in seconds:
        theirs = Spread.of([b / a for a, b in zip(seconds["ours"], seconds["eqsig"], strict=True)])
        exact = vi.response_spectrum(quake, _PERIODS, 0.05)["spectral_displacement"].values
        found = np.abs(peer(quake.acceleration, quake.step, _PERIODS, 0.05)[0])
        worst = float(np.abs(found / exact - 1.0).max())
        off = f"; off by up to {100 * worst:.2g} %, at samples only"
        table.add("eqsig: times as long", theirs.text() + off, "", "")
    return table
