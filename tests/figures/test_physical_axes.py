"""Figures in an engineer's units: what is drawn is what the datasets hold."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.datasets.stops import quantity
from vibroimpact.figures import branch_diagram, resonance_curves
from vibroimpact.model import GRAVITY

ISOLATOR = vi.Isolator.from_period("5000 t", "2.5 s", 0.15)
WALL = vi.Bumper("500 MN/m", "5 MN s/m", "300 mm")
BUILDING = vi.Oscillator("5000 t", ISOLATOR, WALL, WALL)
RIGID = BUILDING.replace(right=vi.RigidStop(0.5, 0.3), left=None, force=1e6)


@cache
def swept(rig: vi.Oscillator) -> xr.Dataset:
    return vi.sweep(vi.Rig(rig, "0.12 g"), np.arange(0.2, 0.9, 0.05))


def drawn(ax, label: str) -> np.ndarray:
    (line,) = (line for line in ax.lines if line.get_label() == label)
    y = np.asarray(line.get_ydata(), dtype=float)
    return y[~np.isnan(y)]


def test_curves_in_g_millimetres_and_meganewtons() -> None:
    data = swept(BUILDING)
    axes = resonance_curves(data, physical=True)
    labels = [ax.get_ylabel().replace("\n", " ") for ax in axes]
    assert labels == [
        "largest absolute acceleration (g)",
        "largest relative displacement (mm)",
        "largest contact force (MN)",
    ]
    for ax, name, factor in zip(
        axes,
        ("peak_acceleration", "peak_displacement", "peak_force.right"),
        (1.0 / GRAVITY, 1e3, 1e-6),
        strict=True,
    ):
        for direction in ("forward", "backward"):
            values = factor * quantity(data, name).sel(direction=direction).values
            curve = drawn(ax, f"{direction} sweep")
            np.testing.assert_allclose(np.sort(curve), np.sort(values), rtol=1e-12)
            assert ax.get_ylim()[1] > values.max()


def test_free_flight_and_the_gap() -> None:
    data = swept(BUILDING)
    acceleration, displacement, force = resonance_curves(data, physical=True)
    free = vi.sweep(vi.Rig(BUILDING.without_bumpers(), "0.12 g"), data["frequency"].values)
    for ax, name, factor in (
        (acceleration, "peak_acceleration", 1.0 / GRAVITY),
        (displacement, "peak_displacement", 1e3),
    ):
        expected = factor * free[name].sel(direction="forward").values
        np.testing.assert_allclose(drawn(ax, "free flight"), expected, rtol=1e-9)
    assert not [line for line in force.lines if line.get_label() == "free flight"]
    assert drawn(displacement, "gap, 300 mm").tolist() == [300.0, 300.0]
    assert "gap, 300 mm" in [t.get_text() for t in acceleration.get_legend().get_texts()]


def test_a_rigid_stop_has_impulses_and_free_flight_is_shifted_by_a_force() -> None:
    data = swept(RIGID)
    axes = resonance_curves(data, physical=True)
    assert axes[2].get_ylabel().replace("\n", " ") == "largest contact impulse (MN s)"
    curve = drawn(axes[2], "forward sweep")
    values = 1e-6 * data["peak_impulse"].sel(stop="right").sel(direction="forward").values
    np.testing.assert_allclose(np.sort(curve), np.sort(values), rtol=1e-12)
    free = vi.sweep(vi.Rig(RIGID.without_bumpers(), "0.12 g"), data["frequency"].values)
    expected = 1e3 * free["peak_displacement"].sel(direction="forward").values
    np.testing.assert_allclose(drawn(axes[1], "free flight"), expected, rtol=1e-9)
    assert drawn(axes[1], "right gap, 300 mm").tolist() == [300.0, 300.0]


def test_without_contact_there_is_no_panel_of_forces() -> None:
    assert len(resonance_curves(swept(BUILDING.without_bumpers()), physical=True)) == 2
    with pytest.raises(
        vi.InputError,
        match="no peak_acceleration, which older versions did not compute; run the sweep again",
    ):
        resonance_curves(swept(BUILDING).drop_vars("peak_acceleration"), physical=True)


def test_a_branch_in_engineers_units() -> None:
    start = swept(BUILDING)["section"].sel(direction="forward").isel(frequency=4)
    shaken = vi.Harmonic("0.12 g", 0.4)
    data = vi.branch(vi.Rig(BUILDING, shaken), start, vary={"frequency": (0.38, 0.42)})
    for name, unit, factor in (
        ("peak_acceleration", "(g)", 1.0 / GRAVITY),
        ("peak_displacement", "(mm)", 1e3),
        ("peak_force.right", "(MN)", 1e-6),
    ):
        ax = branch_diagram(data, quantity=name)
        assert ax.get_ylabel().endswith(unit)
        most = max(line.get_ydata().max() for line in ax.lines if len(line.get_ydata()) > 1)
        assert most == pytest.approx(factor * float(quantity(data, name).max()), rel=1e-12)
    stiff = vi.branch(vi.Rig(BUILDING, shaken), start, vary={"isolator.stiffness": (31e6, 32e6)})
    assert branch_diagram(stiff).get_xlabel().endswith("(MN/m)")
