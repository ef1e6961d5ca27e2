"""What a prepared rig can be asked for: where a motion is later, and what stops it."""

from __future__ import annotations

import numpy as np

import vibroimpact as vi
from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.response.engine_input import engine_state, state_from
from vibroimpact.response.prepared_rig import prepare

CASE = vi.laboratory.case("B3-10mm-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 1.06, 0.3)


ENGINE = prepare(vi.Rig(CASE.oscillator, SHAKEN))


def start():
    return engine_state(CASE.oscillator, vi.State(1e-3, 0.1))


def test_it_is_where_the_simulation_is():
    state = start()
    status, later = ENGINE.propagate(state, 7.25)
    simulated = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 7.25, vi.State(1e-3, 0.1), samples=0)
    assert status is Status.DONE
    end = state_from(later, SHAKEN.phase)
    assert end.displacement == float(simulated["final_state"].sel(component="displacement"))
    assert end.velocity == float(simulated["final_state"].sel(component="velocity"))
    np.testing.assert_array_equal(state, start())  # not written to


def test_sections_cycle_by_cycle():
    state = start()
    status, rows = ENGINE.sections(state, 5)
    assert (status, len(rows)) == (Status.DONE, 5)
    one = start()
    for row in rows:
        _, one = ENGINE.propagate(one, 1.0)
        np.testing.assert_allclose(row[lyapunov.SECTION : lyapunov.SECTION + 2], one[2:4])


def test_a_limit_that_is_met_is_told():
    state = start()
    status, _ = ENGINE.propagate(state, 5.0, max_events=1)
    assert status is Status.TOO_MANY_EVENTS
    status, rows = ENGINE.sections(state, 5, max_events=1)
    assert status is Status.TOO_MANY_EVENTS
    assert len(rows) < 5
