"""Spectra and sections of assemblies: one mass, dense samples, sums of lines, balance of forces."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from response.test_assembly_motion import QUAKE
from stability.test_assembly_orbits import STOPS, alone, damper, frame

QUANTITIES = ("displacement", "velocity", "acceleration")
SINE = vi.Harmonic("1 m/s2", 0.9, 0.3)


def lines(data: xr.Dataset, name: str) -> np.ndarray:
    spectrum = data[f"{name}_amplitude"] * np.exp(1j * data[f"{name}_phase"])
    return spectrum.transpose("order", ...).values


@pytest.mark.parametrize("kind", STOPS)
def test_spectra_of_one_mass_are_the_oscillators(kind: str) -> None:
    one, several = (
        vi.fourier_spectrum(vi.steady(alone(STOPS[kind], assembled=assembled)), 120)
        for assembled in (False, True)
    )
    assert several.attrs["method"] == one.attrs["method"]
    np.testing.assert_array_equal(several["order"], one["order"])
    for name in QUANTITIES:
        mine, theirs = lines(several, name)[:, 0], lines(one, name)
        size = np.abs(theirs).max()
        np.testing.assert_allclose(mine, theirs, rtol=0, atol=2e-12 * size)


def test_lines_are_those_of_dense_samples() -> None:
    motion = vi.steady(vi.Rig(frame(), SINE), samples=2**15)
    assert len(motion["event_time"]) > 2
    spectrum = vi.fourier_spectrum(motion, 60)
    for name in QUANTITIES:
        samples = motion[name].transpose("time", "mass").values[:-1]
        dense = 2.0 * np.fft.rfft(samples, axis=0)[:61] / len(samples)
        dense[0] /= 2.0
        size = np.abs(dense).max(axis=0)
        # The acceleration jumps where a dashpot is met: the trapezoidal rule is of first order.
        tolerance = 1e-4 if name == "acceleration" else 1e-8
        np.testing.assert_allclose(lines(spectrum, name) / size, dense / size, atol=tolerance)


def test_velocities_are_derivatives_and_forces_balance() -> None:
    """To rounding also at orders of many turns on a piece: i omega u = v, momentum from outside."""
    motion = vi.steady(vi.Rig(frame(), SINE))
    spectrum = vi.fourier_spectrum(motion, 200)
    order = spectrum["order"].values[:, np.newaxis]
    omega = 2.0 * np.pi * SINE.frequency * order
    u, v, a = (lines(spectrum, name) for name in QUANTITIES)
    np.testing.assert_allclose(1j * omega * u, v, rtol=0, atol=5e-13 * np.abs(v).max())
    # No stop acts on the roof: its mass times acceleration is the force of the storey.
    stretch, rate = u[:, 1] - u[:, 0], v[:, 1] - v[:, 0]
    force = -(6.0e4 * stretch + 400.0 * rate)
    np.testing.assert_allclose(250.0 * a[:, 1], force, rtol=0, atol=1e-12 * np.abs(force).max())


def test_a_motion_that_is_not_periodic_has_a_window() -> None:
    rig = vi.Rig(frame(), SINE)
    motion = vi.simulate(rig, 30, vi.State(displacement={"roof": 0.02}), samples=32)
    spectrum = vi.fourier_spectrum(motion, 4)
    assert spectrum.attrs["method"] == "Hann window over 30 forcing cycles"
    values = motion["displacement"].sel(mass="roof").values[: 30 * 32]
    assert float(spectrum["displacement_amplitude"].sel(mass="roof")[0]) == pytest.approx(
        abs(values.mean())
    )
    assert spectrum["displacement_amplitude"].sel(order=1.0).argmax("mass") == 1


@pytest.mark.parametrize("kind", STOPS)
@pytest.mark.parametrize("phase", [0.0, 2.0])
def test_sections_of_one_mass_are_the_oscillators(kind: str, phase: float) -> None:
    one, several = (
        vi.stroboscopic_section(vi.simulate(alone(STOPS[kind], assembled=assembled), 12), phase)
        for assembled in (False, True)
    )
    for name in ("displacement", "velocity", "deformation"):
        mine = several[f"section_{name}"].values.reshape(12, -1)
        theirs = one[f"section_{name}"].values.reshape(12, -1)
        size = np.abs(theirs).max() + 1e-3
        np.testing.assert_allclose(mine, theirs, rtol=0, atol=1e-10 * size)


def test_a_section_is_the_motion_at_its_phase() -> None:
    rig = vi.Rig(frame(), SINE)
    motion = vi.simulate(rig, 8, samples=16)
    section = vi.stroboscopic_section(motion, 0.3 + np.pi / 2.0)
    assert section["section_velocity"].dims == ("section_point", "mass")
    for name in ("displacement", "velocity", "deformation"):
        samples = motion[name].isel(time=slice(4, None, 16)).transpose("time", ...)
        np.testing.assert_allclose(section[f"section_{name}"], samples, atol=1e-12)


def test_impacts_are_the_contacts() -> None:
    motion = vi.simulate(damper(zeta=0.05, mass=0.1, e=0.6, clearance=8.0), 30)
    section, log = vi.impact_section(motion), vi.contacts(motion)
    assert section.sizes["contact_number"] > 20
    for name in ("stop", "start", "start_phase", "start_velocity"):
        np.testing.assert_array_equal(section[f"contact_{name}"], log[f"contact_{name}"])
    assert section["contact_start_velocity"].dims == ("contact_number", "mass")


def test_a_record_has_no_spectrum() -> None:
    motion = vi.simulate(vi.Rig(frame(), QUAKE))
    for function in (vi.fourier_spectrum, vi.stroboscopic_section, vi.impact_section):
        with pytest.raises(vi.InputError, match=r"^motion: this is the response to a Record"):
            function(motion)
