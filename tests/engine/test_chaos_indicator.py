"""Plain chaos is told within a few cycles, and nothing else is."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact.engine import steady_response
from vibroimpact.engine.settling import PATIENT
from vibroimpact.engine.status import Status
from vibroimpact.response.hold_rows import Settling
from vibroimpact.response.sweep_arrays import plan_sweep, rows
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.scenarios.resonance_curves import swept_alone

CASE = vi.laboratory.case("B3-10mm-A3")
SOON = 20.0 / CASE.oscillator.natural_frequency


def held(frequency: float, transient: float, max_cycles: int):
    """The row of a hold in which a motion may be told to be chaotic."""
    shaken = vi.Harmonic(CASE.amplitude, frequency)
    ready = plan_sweep(vi.Rig(CASE.oscillator, shaken), np.array([frequency]))
    settling = Settling(1e-12, max_cycles, 100, 10_000)
    tally = np.zeros(2, dtype=np.int64)
    results, _ = rows(ready, "forward", 0.0, settling, tally, transient)
    return results[0]


def is_plain(row, max_cycles: int) -> bool:
    return (
        row[steady_response.OUTCOME] == Status.NOT_SETTLED
        and row[steady_response.CYCLES] < max_cycles
    )


def test_chaos_is_told_within_a_few_cycles() -> None:
    """Behind 24 cycles and 4 more growth by 12 is asked for; then 100 are measured."""
    row = held(1.06, SOON, 400)
    assert is_plain(row, 400)
    exponent = float(vi.lyapunov_exponents(CASE, [1.06], 2000)["exponents"].max())
    assert row[steady_response.CYCLES] - 128 == pytest.approx(12.0 / (exponent / 1.06), abs=12)
    assert row[steady_response.PERIOD] == 0
    assert np.isfinite(row[steady_response.A_MOST])


@pytest.mark.parametrize("frequency", [0.7, 1.1035, 1.107, 1.2, 1.5, 3.0])
def test_what_settles_is_as_without(frequency: float) -> None:
    """Among them motions of two and four cycles, which attract weakly."""
    asked, patient = (held(frequency, transient, 3000) for transient in (SOON, PATIENT))
    assert patient[steady_response.PERIOD] > 0
    assert asked[steady_response.PERIOD] == patient[steady_response.PERIOD]
    assert asked[steady_response.A_MOST] == pytest.approx(patient[steady_response.A_MOST], rel=1e-9)


def test_patience_is_the_default() -> None:
    """A sweep that is not told to ask waits, as it is documented to."""
    assert held(1.06, PATIENT, 400)[steady_response.CYCLES] >= 500
    assert vi.sweep(CASE, [1.06], max_cycles=400, window=100)["cycles"].min() >= 500


def test_it_is_asked_behind_the_transient() -> None:
    row = held(1.06, 100.0 / 1.06, 400)
    assert is_plain(row, 400)
    assert 204 < row[steady_response.CYCLES] < 300


def test_what_is_plain_is_chaotic() -> None:
    """The growth of disturbances agrees, over twenty times as many cycles."""
    rig = one_sine(CASE.rig)
    grid = np.arange(1.0, 1.12, sample(0.002, 0.01))
    _, ended = swept_alone(rig, grid, 300, 100, np.zeros(2, dtype=np.int64), SOON)
    places = np.flatnonzero(ended.plain[0])
    assert len(places) > 3
    for i in places:
        start = ended.state("forward", int(i))
        data = vi.lyapunov_exponents(CASE, grid[i : i + 1], 1000, start=start, transient=0)
        assert data["exponents"].max() > 0.0
