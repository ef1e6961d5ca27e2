"""Figures and texts under a force on the mass: the base is at rest, and a force reaches it."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.facts import largest, motions
from vibroimpact.facts.tables import as_text
from vibroimpact.figures import (
    branch_diagram,
    hysteresis_cycle,
    motion_page,
    phase_portrait,
    resonance_curves,
    spectrum_lines,
    time_history,
)
from vibroimpact.figures.resonance_panels import normalised, physical_curves

OMEGA = 2.0 * math.pi * 4.0
STOP = vi.Bumper("3 MN/m", "10 kN s/m", "3 mm")
MACHINE = vi.Oscillator(
    "800 kg", vi.Isolator(800.0 * OMEGA**2, 0.12 * 800.0 * OMEGA), STOP, STOP, force=200.0
)
RIG = vi.Rig(MACHINE, "0.4 kg m", "4.2 Hz")
FREQUENCIES = np.arange(3.0, 6.0, 0.1)


@cache
def motion() -> xr.Dataset:
    return vi.steady(RIG, samples=64)


@cache
def moved() -> xr.Dataset:
    return vi.steady(vi.Rig(MACHINE, "0.4 mm", "4.2 Hz"), samples=64)


@cache
def swept() -> xr.Dataset:
    return vi.sweep(RIG, FREQUENCIES)


def test_a_history_has_a_panel_of_the_transmitted_force() -> None:
    axes = time_history(motion())
    assert [ax.get_ylabel().split("\n")[0] for ax in axes] == [
        "absolute",
        "absolute acceleration",
        "absolute",
        "transmitted",
    ]
    assert not any("A_t" in ax.get_ylabel() for ax in axes)
    assert "t/T" in axes[3].get_xlabel()
    _, carried, applied = axes[3].lines
    cycles, force = applied.get_data()
    omega = 2.0 * math.pi * 4.2
    exact = 1e-3 * 0.4 * omega**2 * np.sin(2.0 * math.pi * np.asarray(cycles))
    np.testing.assert_allclose(force, exact, atol=1e-9)
    # Through both values at a jump.
    drawn = np.asarray(carried.get_ydata())
    for when in ("before", "after"):
        for value in motion()[f"event_transmitted_force_{when}"].values:
            assert np.abs(drawn - 1e-3 * value).min() < 1e-12
    assert "force on the mass" in [t.get_text() for t in axes[0].get_legend().get_texts()]
    with pytest.raises(vi.InputError, match=r"axes: 3 Axes; pass 4 \(.*transmitted force"):
        time_history(motion(), axes[:3])


def test_a_base_that_moves_keeps_its_labels() -> None:
    for motions_drawn in (moved(), {"a": motion(), "b": moved()}):
        axes = time_history(motions_drawn)
        assert len(axes) == 3
        assert axes[0].get_ylabel().startswith("relative")
        assert "A_t" in axes[1].get_ylabel()
    assert moved()["displacement"].attrs["long_name"] == "relative displacement"
    assert hysteresis_cycle(moved()).get_ylabel().startswith("absolute acceleration")


def test_names_are_absolute_in_figures_and_datasets() -> None:
    lines = vi.fourier_spectrum(motion())
    assert spectrum_lines(lines).get_ylabel() == "amplitude of $\\ddot u$ (m/s²)"
    portrait = phase_portrait(motion())
    assert portrait.get_xlabel() == "absolute displacement $u$ (mm)"
    page = motion_page({"4.2 Hz": motion()})
    assert page[2, 0].get_ylabel() == "absolute\ndisplacement $u$ (mm)"
    for data in (motion(), swept(), vi.totals(motion()), vi.contacts(motion())):
        assert not any("relative" in data[name].attrs["long_name"] for name in data.variables)
    assert motion()["velocity"].attrs["long_name"] == "absolute velocity"
    assert swept()["eta_d"].attrs["long_name"] == "normalised excursion of absolute displacement"


def test_a_loop_is_that_of_the_transmitted_force() -> None:
    """It encloses what isolator and stops dissipate in a cycle."""
    ax = hysteresis_cycle(vi.steady(RIG, samples=4096))
    assert ax.get_ylabel() == "transmitted force (kN)"
    u, force = (np.asarray(one) for one in ax.lines[0].get_data())
    lost = float(motion()["energy_isolator"] + motion()["energy_bumpers"])
    area = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(u)))  # mm kN
    assert area == pytest.approx(lost, rel=1e-5)


def test_resonance_curves_show_the_transmissibility() -> None:
    r, xi = FREQUENCIES / 4.0, 0.06
    free = np.hypot(1.0, 2.0 * xi * r) / np.hypot((1.0 - r) * (1.0 + r), 2.0 * xi * r)
    shown = normalised(swept())[2]
    np.testing.assert_allclose(shown.free, free, rtol=1e-12)
    np.testing.assert_array_equal(
        shown.curves["forward"], swept()["transmissibility"].sel(direction="forward")
    )
    forces = {one.name: one for one in physical_curves(swept())}
    excursion = 2.0 * 0.4 * (2.0 * math.pi * FREQUENCIES) ** 2 * free
    np.testing.assert_allclose(
        forces["transmitted force"].free, 1e-3 * (0.5 * excursion + 200.0), rtol=1e-12
    )
    assert len(resonance_curves(swept(), physical=False)) == 3
    labels = [ax.get_ylabel() for ax in resonance_curves(swept(), physical=True)]
    assert [label.split("\n")[0] for label in labels] == [
        "largest absolute",
        "largest absolute",
        "largest transmitted",
        "largest contact",
    ]
    levels = np.linspace(0.2, 0.4, len(FREQUENCIES))
    shaped = vi.sweep(vi.Rig(MACHINE, [f"{size} kg m" for size in levels]), FREQUENCIES)
    np.testing.assert_allclose(normalised(shaped)[2].free, free, rtol=1e-12)


def test_without_units_the_frequency_is_angular_and_the_ratio_is_the_same() -> None:
    plain = vi.Oscillator(1.0, vi.Isolator(1.0, 0.12), units="none")
    omega = np.linspace(0.5, 2.0, 16)
    rig = vi.Rig(plain, vi.Harmonic(0.1, 1.0, of="unbalance"))
    data = vi.sweep(rig, omega / (2.0 * math.pi))
    ax = resonance_curves(data, physical=False)[2]
    free = next(line for line in ax.lines if line.get_label() == "free flight")
    np.testing.assert_allclose(free.get_xdata(), omega, rtol=1e-12)
    exact = np.hypot(1.0, 0.12 * omega) / np.hypot((1.0 - omega) * (1.0 + omega), 0.12 * omega)
    np.testing.assert_allclose(free.get_ydata(), exact, rtol=1e-10)
    assert "N" not in time_history(vi.steady(rig.at(1.5 / (2.0 * math.pi))))[3].get_ylabel()


def test_branches_are_drawn_by_it() -> None:
    along = vi.branch(RIG, vary={"frequency": (3.0, 6.0)})
    ax = branch_diagram(along, quantity="transmissibility", sweep=swept())
    assert ax.get_ylabel() == "transmissibility of the force (–)"
    assert branch_diagram(along, quantity="peak_transmitted_force").get_ylabel().endswith("(kN)")


def test_texts_state_it() -> None:
    facts = largest.facts(swept())
    for name in ("peak_transmitted_force", "transmissibility"):
        assert facts[name]["value"] == float(swept()[name].max())
    text = as_text(motions.text({4.2: {"motion": motion()}}), 100)
    low, high = (1e-3 * float(motion()[f"transmitted_force_{end}"]) for end in ("min", "max"))
    assert f"transmitted force    {low:.5g} to {high:.5g} kN" in text
    assert f"transmissibility {float(motion()['transmissibility']):.4g}" in text
    assert "transmitted" not in as_text(motions.text({4.2: {"motion": moved()}}), 100)
    moved_facts = largest.facts(vi.sweep(moved_rig(), [4.0]))
    assert not {"peak_transmitted_force", "transmissibility"} & set(moved_facts)


def moved_rig() -> vi.Rig:
    return vi.Rig(MACHINE, "0.4 mm")
