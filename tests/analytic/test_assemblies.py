"""Assemblies with curved links against motions that were computed to 25 digits."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from reference.assembly_cases import CASES, CYCLES
from reference.assembly_states import STATES
from reference.public_motion import WORDS

EXACT = 1e-11
"""Of the largest displacement, velocity or force, and of a cycle."""


def test_every_case_is_stored() -> None:
    assert list(STATES) == list(CASES)


@pytest.mark.parametrize("name", CASES)
def test_states_peaks_forces_and_times(name: str) -> None:
    rig, start = CASES[name]
    known, names = STATES[name], list(rig.system.names)
    for cycles, true in zip((1, CYCLES), known.states, strict=True):
        motion = vi.simulate(rig, cycles, start)
        end = motion["final_state"]
        for part, exact in (("displacement", true[: len(names)]), ("velocity", true[len(names) :])):
            values = end.sel(component=[f"{part}.{one}" for one in names]).values
            expected = np.array(exact, float)
            assert np.abs(values - expected).max() <= EXACT * np.abs(expected).max()
    assert motion.sizes["event"] == known.events
    columns = (motion[f"event_{one}"].values[-len(known.last) :] for one in ("stop", "contact"))
    contacts = [(stop, WORDS[what]) for stop, what in zip(*columns, strict=True)]
    assert contacts == [(stop, kind) for stop, kind, _ in known.last]
    times = np.array([time for _, _, time in known.last], float)
    off = motion["event_time"].values[-len(times) :] - times
    assert np.abs(off).max() <= EXACT * rig.harmonic.period
    whole = vi.totals(motion)
    for mass, exact in known.peaks.items():
        low, high = (float(whole[f"displacement_{end}"].sel(mass=mass)) for end in ("min", "max"))
        assert max(high, -low) == pytest.approx(float(exact), rel=EXACT)
    for stop, exact in known.forces.items():
        force = float(whole["peak_force"].sel(stop=stop))
        assert force == pytest.approx(float(exact), rel=EXACT)
