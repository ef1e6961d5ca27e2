"""Time histories: asymmetric rigs are found, by windows, by records, by steady motions."""

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.identification import fit_inputs
from vibroimpact.measurements.read import as_measured

RIGHT = vi.Bumper("510 kN/m", "0.9 kN s/m", "9 mm")
LEFT = vi.Bumper("350 kN/m", "0.6 kN s/m", "6 mm")
RIG = vi.Oscillator("550 kg", vi.Isolator("26.8 kN/m", "1.1 kN s/m"), RIGHT, LEFT)
START = RIG.replace(
    isolator=RIG.isolator.replace(stiffness=25e3),
    right=RIGHT.replace(stiffness=4.3e5, gap=8.5e-3),
    left=LEFT.replace(stiffness=4e5, gap=6.5e-3),
)
FREE = (
    "isolator.stiffness",
    "stops.right.stiffness",
    "stops.right.gap",
    "stops.left.stiffness",
    "stops.left.gap",
)
TRUE = np.array([26.8e3, 510e3, 9e-3, 350e3, 6e-3])
CHANNELS = ("displacement", "acceleration", "base_acceleration")


def record(motion, noise, names=CHANNELS, seed=1):
    draw = np.random.default_rng(seed)
    noisy = {}
    for name in names:
        values = motion[name].values
        noisy[name] = ("time", values + noise * values.std() * draw.normal(size=len(values)))
    return as_measured(xr.Dataset(noisy, {"time": motion.time.values}))


def motion(frequency, cycles, skip=0, samples=60):
    made = vi.simulate(vi.Rig(RIG, vi.Harmonic("0.05 g", frequency, 0.7)), cycles, samples=samples)
    return made.isel(time=slice(skip * samples, None))


def away(fit):
    return (fit.fitted_value.values - TRUE) / fit.standard_error.values


@pytest.mark.full
def test_unequal_gaps_and_bumpers_from_a_motion_that_hits_both():
    data = record(motion(1.5, 24, skip=8), 0.01)
    fit = vi.identify(START, data, FREE, profiles=False, tried=0, starts=1)
    assert np.abs(fit.fitted_value.values / TRUE - 1.0).max() < 0.02
    assert np.abs(away(fit)).max() < 3.5
    assert float(fit.noise[0]) == pytest.approx(1.0, rel=0.25)
    assert fit.test_kind.values.tolist() == ["history"]


def test_without_noise():
    data = record(motion(1.5, 12, skip=6, samples=100), 0.0)
    fit = vi.identify(START, data, FREE, profiles=False, tried=0, starts=1)
    # Between two of its samples a contact's acceleration is a straight line.
    assert fit.fitted_value.values == pytest.approx(TRUE, rel=2e-3)


@pytest.mark.full
def test_displacement_alone_without_the_base():
    data = record(motion(1.5, 16, skip=8), 0.005, ("displacement",))
    with pytest.raises(vi.InputError, match="rig: this is an Oscillator alone"):
        vi.identify(START, data, FREE)
    fit = vi.identify(vi.Rig(START, "0.05 g"), data, FREE, profiles=False, tried=0, starts=1)
    assert np.abs(fit.fitted_value.values / TRUE - 1.0).max() < 0.05


def test_steady_motions_need_no_initial_states():
    data = record(motion(1.5, 30, skip=24), 0.01)
    fit = vi.identify(START, data, FREE, steady=True, profiles=False, tried=0, starts=1)
    assert np.abs(fit.fitted_value.values / TRUE - 1.0).max() < 0.05


@pytest.mark.full
def test_a_base_that_is_no_sine_is_followed_as_it_was_measured():
    draw = np.random.default_rng(0)
    time = np.arange(0.0, 8.0, 0.01)
    shaken = sum(
        a * np.sin(2.0 * np.pi * f * time + p)
        for f, a, p in zip((1.1, 1.7, 2.6), (0.5, 0.5, 0.4), draw.uniform(0, 6, 3), strict=True)
    )
    moved = vi.simulate(vi.Rig(RIG, vi.Record(shaken, 0.01)))
    data = record(moved, 0.005)
    data["base_acceleration"] = ("time", shaken)
    (test,) = fit_inputs.tests_of(START, data, None, None, False)
    assert isinstance(test.shaking, vi.Record)
    fit = vi.identify(START, data, FREE, profiles=False, tried=0, starts=1)
    assert np.abs(fit.fitted_value.values / TRUE - 1.0).max() < 0.03


def test_a_sensor_with_an_offset_and_a_wrong_scale():
    data = record(motion(1.5, 16, skip=8), 0.002)
    data["displacement"] = 1.04 * data.displacement + 5e-4
    free = ["stops.left.gap", "displacement_scale", "displacement_offset"]
    fit = vi.identify(
        RIG.replace(left=LEFT.replace(gap="7 mm")), data, free, profiles=False, tried=0, starts=1
    )
    assert fit.fitted_value.values == pytest.approx([6e-3, 1.04, 5e-4], rel=0.02)


def test_each_windows_state_moves_its_own_residuals():
    data = record(motion(1.5, 16), 0.01)
    (test,) = fit_inputs.tests_of(START, data, None, 4, False)
    assert len(test.windows) == 4
    begin, _ = test.unknowns
    sensors = {"displacement_scale": 1.0, "acceleration_scale": 1.0,
               "displacement_offset": 0.0, "acceleration_offset": 0.0}  # fmt: skip
    here, _ = test.residuals(test.rig, sensors, begin)
    for group in test.groups:
        for number, rows in group:
            other = begin.copy()
            other[number] += 1e-4
            there, _ = test.residuals(test.rig, sensors, other)
            assert (there[~rows] == here[~rows]).all()
            assert (there[rows] != here[rows]).any()


def test_what_has_nothing_to_fit_is_refused():
    data = record(motion(1.5, 2), 0.0, ("base_acceleration",))
    with pytest.raises(vi.InputError, match="neither displacement nor velocity"):
        vi.identify(RIG, data, "gap")


def test_each_channel_is_weighed_by_its_own_noise():
    made = motion(1.5, 12, skip=6)
    data = record(made, 0.003)
    draw = np.random.default_rng(3)
    clean = made["acceleration"].values
    data["acceleration"] = ("time", clean + 0.06 * clean.std() * draw.normal(size=len(clean)))
    fit = vi.identify(START, data, FREE, profiles=False, tried=0, starts=1)
    assert np.abs(away(fit)).max() < 3.0
    assert np.abs(fit.fitted_value.values / TRUE - 1.0).max() < 0.01
