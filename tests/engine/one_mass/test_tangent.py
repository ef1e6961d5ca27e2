"""The exact tangent flow against differences of the flow itself, and against its definition."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import vibroimpact as vi
from properties.strategies import Motion, examples, motions, simulated
from reference.paper_signs import in_paper_signs, signed_parts
from vibroimpact.engine import lyapunov
from vibroimpact.engine.one_mass.disturbed_events import DISTURBANCE, MEMORY
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.engine_system import engine_rig

COMPONENTS = ("displacement", "velocity", "right_bumper", "left_bumper")


def derivative(rig, shaken, start, cycles=1):
    """Rows: what becomes of a unit disturbance of each component; and the damping integral."""
    columns, damping = np.empty((DISTURBANCE, DISTURBANCE)), np.empty(1)
    state = engine_state(rig, start)
    phase = shaken.phase if start.phase is None else start.phase
    outcome = lyapunov.monodromy(
        engine_rig(vi.Rig(rig, vi.Harmonic(1.0, 1.0))),
        shaken.amplitude,
        shaken.frequency,
        phase,
        state,
        cycles,
        10_000,
        columns,
        damping,
    )
    assert outcome == 0
    # A linear isolator remembers nothing.
    assert not columns[MEMORY].any()
    assert not columns[:, MEMORY].any()
    return columns[:MEMORY, :MEMORY], float(damping[0])


def flow(motion: Motion, values) -> np.ndarray:
    rig = motion.oscillator
    parts = [float(v) for v in values]
    # Deformations only where there is a bumper; u_L is negative.
    right = max(parts[2], 0.0) if rig.right else None
    left = max(-parts[3], 0.0) if rig.left else None
    start = vi.State(parts[0], parts[1], {"right": right, "left": left})
    end = vi.simulate(vi.Rig(rig, motion.excitation), 1.0, start, 0)["final_state"]
    return signed_parts(end.values)


@examples(60)
@given(motions(), st.sampled_from([0, 1]))
def test_derivative_agrees_with_central_differences(motion: Motion, component: int) -> None:
    """Of the map over one cycle, with several contacts in it, bumpers with and without memory."""
    rig, shaken = motion.oscillator, motion.excitation
    data = simulated(motion, 1.0)
    signed = in_paper_signs(data)
    first = np.array([float(signed[name][0]) for name in COMPONENTS])
    # The start lies in flight, and so do its neighbours.
    clear = data["clearance"].isel(time=0).values.tolist()
    assume(not any(gap <= 1e-3 * float(np.abs(data["displacement"]).max()) for gap in clear))
    size = float(np.abs(data["displacement"]).max())
    unit = np.array([size, size * shaken.angular_frequency])[component]
    rows, _ = derivative(rig, shaken, motion.start)
    differences = []
    for step in (1e-5, 5e-6):
        ahead, behind = first.copy(), first.copy()
        ahead[component] += step * unit
        behind[component] -= step * unit
        differences.append((flow(motion, ahead) - flow(motion, behind)) / (2.0 * step * unit))
    # Where the map bends too much for differences (grazing), they disagree with each other.
    scale = np.array([size, size * shaken.angular_frequency, size, size]) / unit
    spread = np.max(np.abs(differences[0] - differences[1]) / scale)
    assume(spread < 1e-6)
    assert np.max(np.abs(rows[component] - differences[1]) / scale) < 1e-6 + 4.0 * spread


@cache
def struck() -> Motion:
    """A mass that strikes a bumper which has not yet forgotten the last contact."""
    bumper = vi.Bumper(40.0, 30.0, 0.5)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), bumper, None)
    return Motion(rig, vi.Harmonic(1.0, 0.2, 0.4), vi.State(0.3, 1.1, {"right": 0.05}))


def test_derivative_with_respect_to_a_relaxing_bumper():
    motion = struck()
    data = vi.simulate(vi.Rig(motion.oscillator, motion.excitation), 1.0, motion.start)
    # At contact it is still deformed.
    assert float(data["event_deformation"].sel(stop="right")[0]) > 1e-3
    rows, _ = derivative(motion.oscillator, motion.excitation, motion.start)
    first = np.array([0.3, 1.1, 0.05, 0.0])
    step = 1e-6
    for component in (0, 1, 2):
        ahead, behind = first.copy(), first.copy()
        ahead[component] += step
        behind[component] -= step
        expected = (flow(motion, ahead) - flow(motion, behind)) / (2.0 * step)
        np.testing.assert_allclose(rows[component], expected, atol=2e-8)
        assert np.abs(expected[:2]).max() > 1e-3


def test_a_contact_loses_the_bumpers_direction():
    """At the end, u_R no longer depends on its own past but through the mass."""
    case = vi.laboratory.case("B2-G1-A3")
    rows, _ = derivative(case.oscillator, vi.Harmonic(case.amplitude, 2.0), vi.State(0.0, 0.1))
    assert np.linalg.matrix_rank(rows, tol=1e-12) == 2


def test_section_in_a_contact():
    """The pressed bumper has no disturbance of its own; it goes with the mass."""
    case = vi.laboratory.case("B2-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 2.0)
    start = vi.State(8e-3, 0.05)
    rows, _ = derivative(case.oscillator, shaken, start)
    assert not rows[2].any()
    step = 1e-8
    ends = [
        vi.simulate(vi.Rig(case.oscillator, shaken), 1, vi.State(8e-3 + d, 0.05), 0)["final_state"][
            :4
        ]
        for d in (step, -step)
    ]
    expected = (ends[0] - ends[1]).values / (2.0 * step)
    np.testing.assert_allclose(rows[0], expected, rtol=1e-6, atol=1e-6)


def test_multipliers_of_free_flight():
    """exp((−ξ ± i√(1 − ξ²)) ω₀ T), the closed form, and each bumper's own exp(−T/τ_j)."""
    case = vi.laboratory.case("B2-G1-A3")
    rig = case.oscillator
    period = 1.0 / 3.7
    rows, damping = derivative(rig, vi.Harmonic(1e-3, 3.7), vi.State())
    xi, omega = rig.damping_ratio, rig.angular_frequency
    root = complex(-xi, math.sqrt(1 - xi * xi)) * omega * period
    multipliers = np.linalg.eigvals(rows[:2, :2])
    np.testing.assert_allclose(
        sorted(multipliers, key=lambda z: z.imag),
        sorted([np.exp(root), np.exp(root.conjugate())], key=lambda z: z.imag),
        atol=1e-13,
    )
    assert damping == pytest.approx(rig.isolator.damping / rig.mass * period, rel=1e-14)
    np.testing.assert_allclose(np.diag(rows)[2:], math.exp(-period * 510e3 / rig.right.damping))
