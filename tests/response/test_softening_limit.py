"""A softening isolator that is driven beyond where it pushes back says so."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine.status import Status
from vibroimpact.response.softening_limit import ended, judged

SOFT = vi.PolynomialIsolator(1.0, 0.3, -1.0)  # it pushes back up to 1 m
WELLS = vi.PolynomialIsolator(1.0, 0.3, -1.0, 0.2)  # and again from 1.9 m on
STRONG = vi.Harmonic(2.0, 0.15)
TOLD = "exceeded the range in which the softening isolator has a restoring force"


def test_a_motion_that_runs_away() -> None:
    rig = vi.Oscillator(1.0, SOFT)
    with pytest.warns(RuntimeWarning, match=TOLD):
        data = vi.simulate(vi.Rig(rig, STRONG), 20)
    assert TOLD in data.attrs["message"]
    sweep = vi.sweep(vi.Rig(rig, 2.0), [0.15])
    assert (sweep["status"] == Status.REVERSED).all()
    assert sweep["status"].attrs["flag_meanings"].split()[Status.REVERSED] == "reversed"
    with pytest.warns(RuntimeWarning, match=TOLD):
        assert TOLD in vi.steady(vi.Rig(rig, STRONG)).attrs["message"]


def test_a_motion_that_runs_away_from_its_only_stop() -> None:
    rig = vi.Oscillator(1.0, SOFT, vi.RigidStop(0.5, 0.2))
    sweep = vi.sweep(vi.Rig(rig, 2.0), [0.15])
    assert (sweep["status"] == Status.REVERSED).all()


@pytest.mark.full
def test_a_motion_that_comes_back() -> None:
    """Values are there, for a stiffer spring further out or a stop bounds it."""
    for rig in (vi.Oscillator(1.0, WELLS), vi.Oscillator(1.0, SOFT, vi.RigidStop(0.5, 1.2))):
        rig = rig.replace(left=rig.right)
        sweep = vi.sweep(vi.Rig(rig, 2.0), [0.15])
        assert (sweep["status"] == Status.REVERSED).all()
        assert (sweep["displacement_max"] > 1.0).all()
        with pytest.warns(RuntimeWarning, match=TOLD):
            data = vi.simulate(vi.Rig(rig, STRONG), 20)
        assert TOLD in data.attrs["message"]
        assert np.isfinite(data["final_state"]).all()


def test_through_a_record() -> None:
    record = vi.Record(np.full(400, 0.6), 0.05)
    with pytest.warns(RuntimeWarning, match=TOLD):
        data = vi.simulate(vi.Rig(vi.Oscillator(1.0, SOFT), record))
    assert TOLD in data.attrs["message"]


def test_small_motions_and_other_laws_say_nothing() -> None:
    assert (
        vi.simulate(vi.Rig(vi.Oscillator(1.0, SOFT), vi.Harmonic(0.1, 0.1)), 5).attrs["message"]
        == "done"
    )
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.3))
    codes = judged(rig, [Status.DONE, Status.NOT_FINITE], [1e9, np.nan])
    assert codes.tolist() == [Status.DONE, Status.NOT_FINITE]


def test_nothing_known_is_no_reversal() -> None:
    rig = vi.Oscillator(1.0, SOFT)
    outcomes = [Status.DONE, Status.DONE, Status.TOO_MANY_EVENTS, Status.NOT_SETTLED]
    codes = judged(rig, outcomes, [np.nan, 0.9, 5.0, 5.0])
    assert codes.tolist() == [0, 0, Status.TOO_MANY_EVENTS, Status.REVERSED]
    assert ended(rig, Status.DONE, [], np.nan) is Status.DONE
    assert ended(rig, Status.DONE, [np.nan, -2.0, 1.0], 0.5) is Status.REVERSED


def test_a_motion_that_runs_away_while_it_is_measured() -> None:
    rig = vi.Oscillator(2.0, vi.PolynomialIsolator(50.0, 1.0, -50.0))
    start = vi.State(0.7128601657875597, 1.7338760758080227)
    sweep = vi.sweep(vi.Rig(rig, 3.0), [0.5264547101961601], "forward", start=start, max_cycles=1)
    assert (sweep["status"] == Status.REVERSED).all()
    assert np.isnan(sweep["displacement_max"]).all()
