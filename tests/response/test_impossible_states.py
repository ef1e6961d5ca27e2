"""States that contradict themselves are refused; a motion that is given up ends at a section."""

from __future__ import annotations

import pytest

import vibroimpact as vi


def test_a_contact_that_would_pull_is_refused() -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.3), vi.Bumper(20.0, 4.0, 0.0))
    start = vi.State(0.1, -0.9, contact=1)
    with pytest.raises(vi.InputError, match=r"start\.contact: 1, but the bumper would pull"):
        vi.simulate(rig, vi.Harmonic(50.0, 0.2), 1, start)


def test_an_elastic_bumper_cannot_lag_behind() -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.3), vi.Bumper(20.0, 0.0, 1.0))
    with pytest.raises(vi.InputError, match=r"start\.contact: 0, but the mass presses"):
        vi.simulate(rig, vi.Harmonic(1.0, 0.2), 1, vi.State(1.5, 0.1, contact=0))


def test_given_up_motion_ends_at_its_last_section() -> None:
    bumper = vi.Bumper(20.0, 0.4, 0.1)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), bumper, bumper)
    with pytest.warns(RuntimeWarning, match="simulate stopped in cycle 0"):
        motion = vi.simulate(rig, vi.Harmonic(0.6, 0.2, 0.3), 5, max_events=3)
    assert list(motion["final_state"].values) == [0.0, 0.0, 0.0, 0.0, pytest.approx(0.3), 0.0]
