"""The same bits, however often one looks and however many threads there are."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

import vibroimpact as vi
from properties.strategies import Motion, examples, motions, simulated


@examples(40)
@given(motions(), st.integers(1, 300), st.floats(0.1, 3.0))
def test_samples_only_look(motion: Motion, samples: int, cycles: float) -> None:
    never, once, often = (simulated(motion, cycles, n) for n in (0, 1, samples))
    for data in (once, often):
        np.testing.assert_array_equal(data["final_state"], never["final_state"])
    for name in once.data_vars:
        if str(name).startswith("event"):
            np.testing.assert_array_equal(once[name], often[name])
    whole = int(cycles) + 1
    np.testing.assert_array_equal(
        once["displacement"][:whole], often["displacement"][: whole * samples : samples]
    )


def test_a_second_run_gives_the_same_bits() -> None:
    case = vi.laboratory.case("B3-10mm-A3")
    one, other = (
        vi.simulate(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.06)), 300)
        for _ in range(2)
    )
    xr.testing.assert_identical(one, other)


@pytest.mark.parametrize("threads", [2, 5])
def test_threads_change_no_bit(threads: int) -> None:
    cases = [vi.laboratory.case(code) for code in ("B1-G1-A1", "B2-G1-A3", "B3-10mm-A3")]
    grid = np.arange(0.5, 3.0, 0.1)
    one, other = (vi.sweeps(cases, grid, threads=n) for n in (1, threads))
    xr.testing.assert_identical(one, other)


def test_a_sweep_among_others_is_the_same_sweep() -> None:
    cases = [vi.laboratory.case(code) for code in ("B1-G1-A1", "B2-G1-A3")]
    grid = np.arange(0.5, 3.0, 0.25)
    together = vi.sweeps(cases, grid, threads=2)
    for i, case in enumerate(cases):
        alone = vi.sweep(vi.Rig(case.oscillator, case.amplitude), grid)
        for name in alone.data_vars:
            np.testing.assert_array_equal(alone[name], together[name].isel(rig=i))
