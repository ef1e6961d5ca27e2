"""A recorded motion cut at its contacts and detachments."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine import measure
from vibroimpact.response.motion_phases import beginning, phases, recorded
from vibroimpact.response.phase_measures import measured

CASE = vi.laboratory.case("B2-G1-A3")


@pytest.fixture(scope="module")
def motion():
    return vi.simulate(
        vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 2.0, 0.3)), 6, samples=512
    )


def test_they_follow_each_other(motion):
    parts = phases(motion)
    assert len(parts.contact) == motion.sizes["event"] + 1
    np.testing.assert_allclose(parts.begin[1:], parts.begin[:-1] + parts.length[:-1], rtol=1e-12)
    np.testing.assert_array_equal(parts.first[1:], parts.last[:-1])
    assert (np.abs(np.diff(parts.contact)) == 1).all()  # flights between contacts
    assert parts.length.sum() == pytest.approx(6 / 2.0, rel=1e-12)


def test_whose_motion_it_is(motion):
    origin = recorded(motion)
    assert (origin.oscillator, origin.excitation.phase) == (CASE.oscillator, 0.3)
    assert (origin.cycles, origin.periodic) == (6.0, False)
    assert beginning(motion).phase == 0.3
    with pytest.raises(vi.InputError, match="this is not a recorded motion"):
        phases(motion["displacement"])


def test_measures_of_all_phases_are_the_extremes(motion):
    parts = phases(motion)
    rows = measured(recorded(motion), parts)
    flights = parts.contact == 0
    most = rows[flights, measure.X_MOST].max()
    inside = np.abs(motion["displacement"].values) < CASE.oscillator.right.gap
    assert most >= motion["displacement"].values[inside].max() - 1e-12
    pressed = rows[~flights, measure.X_MOST].max()
    assert pressed == pytest.approx(
        float(np.abs(motion["displacement"]).max()) - CASE.oscillator.right.gap, rel=1e-3
    )
