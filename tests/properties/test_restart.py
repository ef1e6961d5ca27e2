"""A run may be cut anywhere and taken up again; so may a sweep."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray

import vibroimpact as vi
from properties.strategies import Motion, distance, examples, motions, simulated, tame
from reference.paper_signs import signed_parts

ROUNDING = 1e-11

CYCLES = 3


def end_of_cut_run(motion: Motion, cut: float) -> NDArray[np.float64]:
    """The end of a run that was stopped at `cut` cycles and taken up again."""
    rig, shaken, _ = motion
    half = simulated(motion, cut, samples=0)["final_state"]
    end = vi.simulate(vi.Rig(rig, shaken), CYCLES - cut, half, samples=0)["final_state"].values
    assert math.isclose(math.cos(end[4] - shaken.phase), 1.0)
    return signed_parts(end)


@examples(60)
@given(motions(), st.floats(1e-6, CYCLES * (1 - 1e-6)))
def test_a_run_may_be_cut_anywhere(motion: Motion, cut: float) -> None:
    assert distance(tame(motion, CYCLES), end_of_cut_run(motion, cut)) < ROUNDING


@examples(60)
@given(motions(), st.integers(0), st.floats(0.01, 0.99))
def test_a_run_may_be_cut_inside_a_contact(motion: Motion, which: int, where: float) -> None:
    data = tame(motion, CYCLES)
    times = data["event_time"].values * motion.excitation.frequency
    begins = np.flatnonzero(data["event_contact"].values[:-1])
    begins = begins[times[begins + 1] - times[begins] > 1e-5]  # not a touch
    assume(len(begins))
    i = begins[which % len(begins)]
    cut = times[i] + where * (times[i + 1] - times[i])
    assert distance(data, end_of_cut_run(motion, cut)) < ROUNDING


@examples(60)
@given(motions(), st.integers(0), st.sampled_from([-1.0, 0.0, 1.0]))
def test_a_run_may_be_cut_at_an_event(motion: Motion, which: int, towards: float) -> None:
    data = tame(motion, CYCLES)
    times = data["event_time"].values * motion.excitation.frequency
    times = times[times > 1e-5]
    assume(len(times))
    cut = times[which % len(times)]
    cut = math.nextafter(cut, cut + towards)
    assume(cut < CYCLES)
    assert distance(data, end_of_cut_run(motion, cut)) < ROUNDING


def test_an_elastic_contact_may_be_cut_at_its_end() -> None:
    """Where rounding may put the face of the bumper a little too far."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 2.0), vi.Bumper(4.8, 0.0, 0.0))
    shaken = vi.Harmonic(2.0, 0.16)
    for i in range(40):
        start = vi.State(0.0, 0.05 + 0.002 * i)
        data = vi.simulate(vi.Rig(rig, shaken), 1, start, samples=1)
        detached = data["event_contact"].values == 0
        cut = float(data["event_cycle_time"].values[detached][0]) * shaken.frequency
        for ulp in range(-2, 3):
            half = vi.simulate(vi.Rig(rig, shaken), cut * (1.0 + ulp * 2.0**-52), start, samples=0)
            vi.simulate(vi.Rig(rig, shaken), 1, half, samples=0)


@pytest.mark.parametrize("code", ["B2-G1-A3", "B4-G3-A1", "B1-0mm-A2", "B3-10mm-A3"])
def test_the_section_of_a_sweep_repeats_itself(code: str) -> None:
    case = vi.laboratory.case(code)
    data = vi.sweep(vi.Rig(case.oscillator, case.amplitude), [0.5, 0.9, 1.6, 2.4, 3.1], phase=0.3)
    settled = data["period"].values > 0
    assert settled.sum() >= 8
    for d, f in np.argwhere(settled):
        held = data.isel(direction=d, frequency=f)
        shaken = vi.Harmonic(case.amplitude, float(held["frequency"]), 0.3)
        period = int(held["period"])
        again = vi.simulate(vi.Rig(case.oscillator, shaken), period, held["section"], 256)
        section = signed_parts(held["section"].values)
        assert distance(again, section) < ROUNDING
        seen = np.ptp(again["displacement"].values) / float(held["displacement_excursion"])
        assert 1 - 1e-2 <= seen <= 1 + ROUNDING
        begins = again["event_contact"].values == 1
        for stop in ("right", "left"):
            hits = np.sum(begins & (again["event_stop"].values == stop))
            assert hits == held["impacts"].sel(stop=stop) * period
