"""Sections against the motion itself."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi

CASE = vi.laboratory.case("B3-10mm-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 1.06, 0.4)
NAMES = ("displacement", "velocity", "deformation")


def test_at_whole_cycles_it_is_the_samples():
    motion = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 20, vi.State(2e-3, 0.03), samples=8)
    section = vi.stroboscopic_section(motion, 0.4)
    assert section.sizes["section_point"] == 20
    for name in NAMES:
        np.testing.assert_allclose(
            section[f"section_{name}"],
            motion[name].isel(time=slice(0, -1, 8)).transpose("time", ...),
            rtol=1e-14,
            atol=1e-17,
        )


@pytest.mark.parametrize("phase", [0.0, 0.39, 2.0, "90 deg", -3.0, 11.0])
def test_at_any_phase(phase):
    """Against a simulation whose samples begin at that phase: only rounding lies between."""
    motion = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 6, vi.State(2e-3, 0.03), samples=64)
    section = vi.stroboscopic_section(motion, phase, 5)
    angle = math.pi / 2 if isinstance(phase, str) else phase
    ahead = (angle - 0.4) / (2 * math.pi) % 1.0
    first = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), ahead, vi.State(2e-3, 0.03), samples=0)
    later = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 5, first, samples=1)
    for name in NAMES:
        np.testing.assert_allclose(
            section[f"section_{name}"],
            later[name].isel(time=slice(-1)).transpose("time", ...),
            rtol=1e-9,
            atol=1e-13,
        )


def test_more_points_than_the_record_has():
    motion = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 2, samples=1)
    long = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 300, samples=1)
    section = vi.stroboscopic_section(motion, 0.4, 300)
    # The motion is chaotic: rounding grows, but not within 40 cycles.
    np.testing.assert_allclose(section["section_velocity"][:40], long["velocity"][:40], rtol=1e-4)
    assert section.sizes["section_point"] == 300


def test_a_periodic_motion_has_as_many_points_as_its_period():
    motion = vi.steady(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 1.2)))
    section = vi.stroboscopic_section(motion, 1.0, 7)
    assert np.ptp(section["section_displacement"].values) < 1e-12
    assert vi.stroboscopic_section(motion, 1.0).sizes["section_point"] == 1


def test_impacts():
    motion = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 50, samples=1)
    section = vi.impact_section(motion)
    log = vi.contacts(motion)
    for name in ("stop", "start_phase", "start_velocity"):
        np.testing.assert_array_equal(section[f"contact_{name}"], log[f"contact_{name}"])
    # The phase is that of the base: its acceleration there is A sin(phase).
    time = section["contact_start"].values
    angle = 2 * math.pi * 1.06 * time + 0.4
    np.testing.assert_allclose(
        np.sin(section["contact_start_phase"].values), np.sin(angle), atol=1e-9
    )


@pytest.mark.parametrize("cycles", [0, -1, 1.5, True])
def test_refused(cycles):
    motion = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 2, samples=1)
    with pytest.raises(vi.InputError, match="cycles: "):
        vi.stroboscopic_section(motion, 0.0, cycles)
    with pytest.raises(vi.InputError, match="motion"):
        vi.stroboscopic_section(None)
    with pytest.raises(vi.InputError, match="phase"):
        vi.stroboscopic_section(motion, "1 mm")


def test_a_limit_that_is_met_is_told(monkeypatch):
    case = vi.laboratory.case("B2-G1-A3")
    motion = vi.simulate(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 0.6)), 10, samples=8)
    monkeypatch.setattr("vibroimpact.response.sections._MAX_EVENTS", 3)
    for phase in (0.0, 1.0):
        with pytest.warns(RuntimeWarning, match=r"stopped after \d of 10 points: .*max_events"):
            data = vi.stroboscopic_section(motion, phase)
        assert data.sizes["section_point"] < 10
