"""Orbits as fixed points of a section's map, with their derivative."""

from __future__ import annotations

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

import vibroimpact as vi
from properties.strategies import Motion, examples, motions
from reference.paper_signs import mode_of, signed_parts
from vibroimpact.stability.fixed_points import Section, corrected, evaluated
from vibroimpact.stability.parameter_family import family


@examples(60)
@given(motions(least_damping=0.02), st.floats(0.0, 6.28))
def test_monodromy_against_differences_of_the_map(motion: Motion, phase: float) -> None:
    """At whatever the state at the section: flight, contact, relaxing bumpers."""
    rig = motion.oscillator
    shaken = motion.excitation.replace(phase=phase)
    fam = family(vi.Rig(rig, shaken), "frequency")
    settled = vi.simulate(vi.Rig(rig, shaken), 20, samples=0)["final_state"].values
    size = max(abs(settled[0]), abs(settled[1]) / shaken.angular_frequency, 1e-12)
    scale = np.array([size, size * shaken.angular_frequency, size, size, size, shaken.frequency])
    section = Section(fam, 1, False, scale)
    point = np.array([*signed_parts(settled), 0.0, shaken.frequency])
    mode = mode_of(settled)
    status, here, _ = evaluated(section, point, mode)
    assume(int(status) == 0)
    for component in (0, 1):
        slopes = []
        for step in (1e-5, 3e-6):
            ends = []
            for sign in (1.0, -1.0):
                beside = point.copy()
                beside[component] += sign * step * scale[component]
                if mode:  # the pressed bumper goes with the mass
                    beside[2 if mode == 1.0 else 3] += (
                        sign * step * scale[component] if component == 0 else 0.0
                    )
                status, other, image = evaluated(section, beside, mode)
                assume(int(status) == 0 and other.contacts == here.contacts)
                ends.append(image[:5])
            slopes.append((ends[0] - ends[1]) / (2.0 * step * scale[component]))
        weight = scale[component] / scale[:5]
        spread = np.max(np.abs(slopes[0] - slopes[1]) * weight)
        assume(spread < 1e-6)
        error = np.max(np.abs(slopes[1] - here.carried[component]) * weight)
        assert error < 1e-6 + 4.0 * spread


def test_the_half_cycle_map_squared_is_the_map():
    case = vi.laboratory.case("B2-G1-A3")
    fam = family(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.3, 0.3)), "frequency")
    settled = vi.steady(vi.Rig(case.oscillator, fam.excitation))["final_state"].values
    point = np.array([*signed_parts(settled), 0.0, 1.3])
    scale = np.array([7.5e-3, 0.06, 7.5e-3, 7.5e-3, 7.5e-3, 1.0])
    halves = [corrected(Section(fam, 1, mirror, scale), point, 0.0) for mirror in (True, False)]
    assert all(int(status) == 0 for status, _ in halves)
    (_, half), (_, full) = halves
    np.testing.assert_allclose(half.monodromy, full.monodromy, atol=1e-9)
    np.testing.assert_allclose(
        np.sort(np.abs(half.multipliers)), np.sort(np.abs(full.multipliers)), atol=1e-9
    )
    assert half.contacts == full.contacts
