"""The observers of several masses, beside those of one mass."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from response.test_assembly_motion import BUMPER, one_mass
from vibroimpact.engine.observers import fourier
from vibroimpact.engine.phases import measure_motion
from vibroimpact.model import equilibrium
from vibroimpact.response.assembly_rig import assembly_numbers
from vibroimpact.response.assembly_state import assembly_vector
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.engine_system import engine_rig

SINE = vi.Harmonic("2.5 m/s2", 0.9, 0.4)


@pytest.mark.parametrize("tables", [True, False])
def test_fourier_integrals_of_one_mass_are_the_oscillators(tables: bool) -> None:
    single, assembly = one_mass(BUMPER, vi.RigidStop(0.9, 5e-3))
    rigs = engine_rig(vi.Rig(single, SINE)), assembly_numbers(assembly, SINE, tables=tables)
    states = (
        engine_state(single, equilibrium(single)),
        assembly_vector(assembly, equilibrium(assembly)),
    )
    omega = 2.0 * math.pi * SINE.frequency
    lines, integrals = omega * np.array([0.0, 1.0, 5.0, 40.0]), []
    for rig, state in zip(rigs, states, strict=True):
        notes, out = np.zeros(fourier.NOTES), np.zeros((fourier.QUANTITIES, len(lines)))
        notes[fourier.COUNT], notes[fourier.INTERVAL] = len(lines), SINE.period
        row = np.array([[math.nan, math.nan, SINE.period]])
        reached = measure_motion(
            rig, SINE.amplitude, omega, SINE.phase, row, 0, state, 0, 2.0, 1000, notes, lines, out
        )
        assert reached == (2, 0)
        integrals.append(out)
    for one, several in zip(*integrals, strict=True):
        np.testing.assert_allclose(several, one, rtol=0, atol=1e-12 * abs(one).max())
