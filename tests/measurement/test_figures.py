"""Figures, features and spectra take measured data."""

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.measurement.features import in_words, measured_features, noise_of, strays
from vibroimpact.measurement.read import as_measured

FREQUENCIES = np.round(np.arange(0.5, 5.01, 0.1), 10)


@pytest.fixture(scope="module")
def computed():
    return vi.sweep(vi.laboratory.case("B2-G1-A3", "identified"), FREQUENCIES)


@pytest.fixture(scope="module")
def curves(computed):
    """2 % of noise on both excursions."""
    draw = np.random.default_rng(3)
    names = ["displacement_excursion", "acceleration_excursion"]
    noisy = xr.Dataset({n: computed[n] * (1.0 + 0.02 * draw.normal(size=(2, 46))) for n in names})
    return as_measured(noisy)


@pytest.fixture(scope="module")
def history():
    rig = vi.laboratory.case("B2-G1-A3", "identified")
    motion = vi.simulate(rig, "2 Hz", 40, samples=64)
    time = np.arange(15.0, 19.97, 0.004)
    names = ("displacement", "acceleration", "base_acceleration")
    known = {n: ("time", np.interp(time, motion.time, motion[n])) for n in names}
    return as_measured(xr.Dataset(known, {"time": time})), motion


def test_noise_is_that_of_repeated_values():
    """A mean of four would show half of it, a few frequencies of one way hardly anything."""
    values = np.linspace(1.0, 3.0, 10)[:, None]
    values = values * np.random.default_rng(1).normal(1.0, 0.02, size=(2, 1, 10, 4))
    dims = ("direction", "frequency", "repeat")
    for names, sign in (
        (("displacement_excursion", "acceleration_excursion"), 1.0),
        (("displacement_max", "displacement_min"), [[[[1.0]]], [[[-1.0]]]]),
    ):
        again = {n: (dims, v) for n, v in zip(names, values * sign, strict=True)}
        assert noise_of(xr.Dataset(again)) == pytest.approx(0.02, rel=0.2)


def test_features_are_told_with_the_step(curves):
    assert noise_of(curves) == pytest.approx(0.02, rel=0.4)
    jumps = measured_features(curves).jumps
    assert [(j.direction, j.before, j.after) for j in jumps] == [
        ("forward", 2.6, 2.7),
        ("backward", 1.8, 1.7),
    ]
    words = "\n".join(in_words(curves))
    assert "in steps of 0.1 Hz" in words
    assert "forward: jump down between 2.6 and 2.7 Hz" in words
    assert "hysteresis, forward above: 1.8 to 2.6 Hz" in words


def test_curves_alone_and_over_computed_ones(curves, computed):
    upper, lower = figures.resonance_curves(curves)
    assert upper.get_ylabel().endswith("$E_a$ (g)")
    drawn = next(line for line in lower.lines if line.get_label() == "forward sweep, measured")
    values = drawn.get_ydata()
    expected = 1e3 * curves.displacement_excursion.sel(direction="forward").values
    assert values[np.isfinite(values)] == pytest.approx(expected)
    for physical in (False, True):
        panels = figures.resonance_curves(computed, measured=curves, physical=physical)
        labels = [line.get_label() for line in panels[0].lines]
        assert "measured, forward sweep" in labels
    points = figures.resonance_curves(computed, measured=curves)[1].lines[-1]
    ratio = curves.displacement_excursion.sel(direction="backward") / float(
        computed.largest_free_displacement_excursion
    )
    assert points.get_ydata() == pytest.approx(ratio.values)


def test_histories_and_portraits_lie_over_computed_ones(history):
    data, motion = history
    panels = figures.time_history({"measured": data, "model": motion}, cycles=3)
    curves = [line for line in panels[0].lines if len(line.get_xdata()) > 20]
    at, u = curves[0].get_data()
    x, y = curves[1].get_data()
    assert np.interp(at, x, y) == pytest.approx(u, abs=0.15)
    assert at[0] == pytest.approx(x[0], abs=0.02)
    ax = figures.phase_portrait({"measured": data, "model": motion})
    assert len(ax.lines) >= 2


def test_the_velocity_is_the_slope_of_the_displacement(history):
    data, motion = history
    ax = figures.phase_portrait(data)
    fastest = np.max(np.abs(ax.lines[0].get_ydata()))
    assert fastest == pytest.approx(float(abs(motion.velocity[-640:]).max()), rel=0.03)


def test_the_spectrum_of_a_history(history):
    data, motion = history
    lines = vi.spectrum(data, 5)
    exact = vi.spectrum(vi.steady(vi.laboratory.case("B2-G1-A3", "identified"), "2 Hz",
                                  start=motion), 5)  # fmt: skip
    for order in (1, 3):
        found = float(lines.displacement_amplitude.sel(order=order, method="nearest"))
        assert found == pytest.approx(
            float(exact.displacement_amplitude.sel(order=order)), rel=0.01
        )
    assert "velocity_amplitude" not in lines


def test_maxima_and_minima_lie_over_computed_curves(computed):
    names = ["displacement_max", "displacement_min", "acceleration_max", "acceleration_min"]
    measured = as_measured(computed[names])
    for ax, name in zip(
        figures.resonance_curves(computed, measured=measured), ("eta_a", "eta_d"), strict=True
    ):
        (line,) = [one for one in ax.lines if str(one.get_label()).startswith("measured, forward")]
        assert line.get_ydata() == pytest.approx(computed[name].sel(direction="forward").values)


def test_excursions_lie_over_half_excursions():
    """At 0.8 Hz this symmetric rig goes further to one side than to the other."""
    bumper = vi.Bumper("510 kN/m", "0.9 kN s/m", gap="10 mm")
    rig = vi.Oscillator("550 kg", vi.Isolator("31.9 kN/m", "1.1 kN s/m"), bumper, bumper)
    computed = vi.sweep(rig, "0.04 g", np.round(np.arange(0.5, 2.01, 0.1), 10))
    names = ["displacement_excursion", "acceleration_excursion"]
    one = {"direction": "forward", "frequency": 0.8}
    half = 0.5 * float(computed[names[1]].sel(one))
    assert float(computed["peak_acceleration"].sel(one)) > 1.2 * half
    panels = figures.resonance_curves(
        computed, measured=as_measured(computed[names]), physical=True
    )
    words = ["half the excursion of absolute acceleration (g)",
             "half the excursion of relative displacement (mm)"]  # fmt: skip
    assert [ax.get_ylabel().replace("\n", " ") for ax in panels[:2]] == words
    for ax in panels[:2]:
        drawn = {str(line.get_label()): np.asarray(line.get_ydata()) for line in ax.lines}
        for way in ("forward", "backward"):
            curve = drawn[f"{way} sweep"]
            assert drawn[f"measured, {way} sweep"] == pytest.approx(curve[np.isfinite(curve)])
    assert any("gap" in str(line.get_label()) for line in panels[1].lines)
    ends = ["displacement_max", "displacement_min", names[1]]
    panels = figures.resonance_curves(computed, measured=as_measured(computed[ends]), physical=True)
    assert panels[1].get_ylabel() == "largest relative\ndisplacement (mm)"


def test_values_of_another_motion_are_found_and_are_no_noise():
    draw = np.random.default_rng(5)
    values = np.linspace(1.0, 3.0, 10)[:, None] * draw.normal(1.0, 0.02, size=(2, 1, 10, 4))
    dims = ("direction", "frequency", "repeat")
    at = {"direction": ["forward"], "frequency": np.arange(1.0, 11.0)}
    names = ("displacement_excursion", "acceleration_excursion")
    data = xr.Dataset({n: (dims, v) for n, v in zip(names, values, strict=True)}, at)
    assert not any(one.any() for one in strays(data).values())
    quiet = noise_of(data)
    data[names[1]][0, 9, 2] *= 0.1
    assert [int(one.sum()) for one in strays(data).values()] == [0, 1]
    assert noise_of(data) == pytest.approx(quiet, rel=0.1)
