"""Following a motion without looking at it: where it is later, and what stops it."""

from __future__ import annotations

import numpy as np

import vibroimpact as vi
from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.response.engine_input import engine_rig, engine_state, state_from
from vibroimpact.response.propagate import grown, moved_on

CASE = vi.laboratory.case("B3-10mm-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 1.06, 0.3)


def begun():
    return engine_rig(vi.Rig(CASE.oscillator, vi.Harmonic(1.0, 1.0))), engine_state(
        CASE.oscillator, vi.State(1e-3, 0.1)
    )


def test_it_is_where_the_simulation_is():
    rig, state = begun()
    status, later = moved_on(rig, SHAKEN, state, 7.25)
    simulated = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 7.25, vi.State(1e-3, 0.1), samples=0)
    assert status is Status.DONE
    found = state_from(later, SHAKEN.phase)
    assert found.displacement == float(simulated["final_state"].sel(component="displacement"))
    assert found.velocity == float(simulated["final_state"].sel(component="velocity"))
    np.testing.assert_array_equal(state, begun()[1])  # not written to


def test_sections_cycle_by_cycle():
    rig, state = begun()
    status, rows = grown(rig, SHAKEN, state, 5)
    assert (status, len(rows)) == (Status.DONE, 5)
    one = begun()[1]
    for row in rows:
        _, one = moved_on(rig, SHAKEN, one, 1.0)
        np.testing.assert_allclose(row[lyapunov.SECTION : lyapunov.SECTION + 2], one[2:4])


def test_a_limit_that_is_met_is_told():
    rig, state = begun()
    status, _ = moved_on(rig, SHAKEN, state, 5.0, max_events=1)
    assert status is Status.TOO_MANY_EVENTS
    status, rows = grown(rig, SHAKEN, state, 5, max_events=1)
    assert status is Status.TOO_MANY_EVENTS
    assert len(rows) < 5
