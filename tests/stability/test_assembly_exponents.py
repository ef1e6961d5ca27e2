"""Lyapunov exponents of assemblies: of one mass, of orbits, and their sum."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from stability.test_assembly_orbits import STOPS, alone, damper, frame


@pytest.mark.parametrize("kind", STOPS)
def test_those_of_one_mass_are_the_oscillators(kind: str) -> None:
    one, several = (
        vi.lyapunov_exponents(
            [alone(STOPS[kind], assembled=assembled)], [0.9, 1.3, 2.0], 300, transient=1500
        ).isel(rig=0)
        for assembled in (False, True)
    )
    assert several.sizes == one.sizes
    np.testing.assert_allclose(several["effective_damping"], one["effective_damping"], rtol=1e-10)
    mine, theirs = several["exponents"], one["exponents"]
    np.testing.assert_allclose(mine.sum("exponent"), theirs.sum("exponent"), rtol=1e-10)
    # The two of a complex pair, which are equal, oscillate about their mean.
    gap = abs(theirs.diff("exponent").values[:, 0])
    for i, one_gap in enumerate(gap):
        tolerance = 1e-9 if one_gap > 0.1 else 5e-3
        np.testing.assert_allclose(mine[i], theirs[i], rtol=tolerance)


def test_those_of_a_periodic_motion_are_its_multipliers() -> None:
    rig = vi.Rig(frame(), vi.Harmonic("1 m/s2", 0.9))
    averaged = vi.lyapunov_exponents(rig, [0.9], 3200).isel(rig=0, frequency=0)
    exact = vi.orbit(rig)["exponents"]
    assert averaged.sizes["exponent"] == exact.sizes["exponent"] == 4
    # Of a complex pair, the average oscillates about the logarithm of its modulus.
    np.testing.assert_allclose(averaged["exponents"], exact, atol=2e-3 * float(abs(exact).max()))
    first = vi.lyapunov_exponents(rig, [0.9], 3200, count=1).isel(rig=0, frequency=0)
    assert first["exponents"].values == pytest.approx(averaged["exponents"].values[:1], rel=1e-12)


def test_they_sum_to_what_damping_and_impacts_contract() -> None:
    """−tr M⁻¹C + 2 ln e for each impact, also of a chaotic motion."""
    e = 0.6
    rig = damper(zeta=0.05, mass=0.1, e=e, clearance=8.0)
    frequency = rig.periodic.frequency
    cycles, before = 500, 100
    growth = vi.lyapunov_exponents(rig, [frequency], cycles, transient=before)
    growth = growth.isel(rig=0, frequency=0)
    assert growth["exponents"].sizes == {"exponent": 4}
    assert float(growth["exponents"][0]) > 0.0
    # The impacts of the same cycles of the same motion.
    start = vi.simulate(rig, before + 100, samples=0)
    motion = vi.simulate(rig, cycles, start, samples=1)
    impacts = int((motion["event_contact"] == 2).sum())
    expected = -2.0 * 0.05 + 2.0 * math.log(e) * impacts * frequency / cycles
    assert float(growth["exponents"].sum()) == pytest.approx(expected, rel=1e-10)
    assert float(growth["effective_damping"]) == pytest.approx(-expected, rel=1e-10)


def test_rigs_of_different_sizes_stand_beside_each_other() -> None:
    chain = vi.Rig(vi.chain([2.0] * 3, [300.0] * 3, damping_ratio=0.03), vi.Harmonic(0.5, 0.9))
    one = alone(STOPS["bumpers"], assembled=False)
    growth = vi.lyapunov_exponents({"chain": chain, "one": one}, [0.9, 1.3], 10_000)
    assert growth.sizes["exponent"] == 6
    assert np.isnan(growth["exponents"].sel(rig="one")[:, 2:]).all()
    # Without stops, the real parts of the eigenvalues.
    system = chain.system
    expected = np.sort(np.repeat(-system.damping_ratios * system.natural_frequencies, 2))[::-1]
    mine = growth["exponents"].sel(rig="chain").values
    np.testing.assert_allclose(mine, [2 * np.pi * expected] * 2, rtol=2e-2)
    trace = np.trace(np.linalg.solve(system.mass_matrix, system.damping_matrix))
    np.testing.assert_allclose(mine.sum(axis=1), -trace, rtol=1e-11)


def test_wrong_arguments() -> None:
    rig = vi.Rig(frame(), vi.Harmonic("1 m/s2", 0.9))
    with pytest.raises(vi.InputError, match=r"^count: 5; pass a whole number from 1 to 4"):
        vi.lyapunov_exponents(rig, [0.9], 10, count=5)
    with pytest.raises(vi.InputError, match=r"^start: .* is the state of one mass"):
        vi.lyapunov_exponents(rig, [0.9], 10, start=vi.State(0.1, 0.0))
