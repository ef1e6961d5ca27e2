"""Every law of isolators and stops against its stored motion to 25 digits.

From rest, after 1, 5 and 20 cycles with contacts on both sides, the state agrees within 1e-11 of
the largest displacement or velocity seen at the sections.
"""

from __future__ import annotations

import math

import pytest
from mpmath import mp, mpf

import vibroimpact as vi
from reference.law_cases import CASES, CYCLES
from reference.law_states import STATES
from reference.store_law_states import AT

TOLERANCE = 1e-11


def error(name: str) -> float:
    """The largest over the stored states, over the largest displacement or velocity."""
    rig, shaken = CASES[name]
    data = vi.simulate(rig, shaken, CYCLES, samples=1)
    assert data.sizes["time"] == CYCLES + 1, data.attrs["status"]
    columns = [data[which].values for which in ("displacement", "velocity")]
    last = vi.simulate(rig, shaken, CYCLES, samples=0)["final_state"].values
    worst = 0.0
    with mp.workdps(40):
        size = float(abs(columns[0]).max())
        # At a section friction may hold the mass, always.
        speed = max(float(abs(columns[1]).max()), size * 2 * math.pi * shaken.frequency)
        for i, (column, unit) in enumerate(zip(columns, (size, speed), strict=True)):
            ours = [*(column[n] for n in AT), last[i]]
            stored = [state[i] for state in STATES[name]]
            for one, digits in zip(ours, [*stored, stored[-1]], strict=True):
                worst = max(worst, float(abs(mpf(float(one)) - mpf(digits))) / unit)
    return worst


@pytest.mark.parametrize("name", CASES)
def test_stored_motions_are_met(name: str) -> None:
    assert error(name) <= TOLERANCE
