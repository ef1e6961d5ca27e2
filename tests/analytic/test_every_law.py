"""Every law of isolators and stops, under every kind of shaking, against stored motions.

From rest, with contacts on both sides, the states that are known to 25 digits agree within 1e-11 of
the largest displacement or velocity seen at the sections, or at the samples of a record.
"""

from __future__ import annotations

import math

import pytest
from mpmath import mp, mpf

import vibroimpact as vi
from reference import law_cases, law_states, shaken_cases, shaken_states
from reference.law_cases import Case
from reference.store_law_states import States, marks, span
from samples import sample

TOLERANCE = 1e-11


def error(one: Case, stored: States) -> float:
    """The largest over the stored states, over the largest displacement or velocity."""
    rig, shaken = one
    at = marks(one)
    cycles = None if isinstance(shaken, vi.Record) else at[-1]
    data = vi.simulate(vi.Rig(rig, shaken), cycles, samples=1)
    assert data.sizes["time"] == at[-1] + 1, data.attrs["message"]
    columns = [data[which].values for which in ("displacement", "velocity")]
    last = vi.simulate(vi.Rig(rig, shaken), cycles, samples=0)["final_state"].values
    worst = 0.0
    with mp.workdps(40):
        size = float(abs(columns[0]).max())
        # At a section friction may hold the mass, always.
        rate = 2 * math.pi / span(shaken) if cycles else 1.0
        speed = max(float(abs(columns[1]).max()), size * rate)
        for i, (column, unit) in enumerate(zip(columns, (size, speed), strict=True)):
            ours = [*(column[n] for n in at), last[i]]
            known = [state[i] for state in stored]
            for value, digits in zip(ours, [*known, known[-1]], strict=True):
                worst = max(worst, float(abs(mpf(float(value)) - mpf(digits))) / unit)
    return worst


@pytest.mark.parametrize("name", sample([*law_cases.CASES], [*law_cases.CASES][::5]))
def test_stored_motions_are_met(name: str) -> None:
    assert error(law_cases.CASES[name], law_states.STATES[name]) <= TOLERANCE


@pytest.mark.parametrize("name", sample([*shaken_cases.CASES], [*shaken_cases.CASES][::9]))
def test_stored_motions_under_every_shaking_are_met(name: str) -> None:
    assert error(shaken_cases.CASES[name], shaken_states.STATES[name]) <= TOLERANCE
