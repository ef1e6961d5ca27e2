"""Sensors that are turned round or have an offset: suggested as the cause, and fitted if asked."""

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from identification.test_history_residuals import LEFT, RIG, RIGHT, START, motion, record
from identification.twins import PEAKS, curves
from samples import sample
from vibroimpact.identification import fit_inputs
from vibroimpact.identification.sensor_channel import corrected, sensed
from vibroimpact.measurements.read import as_measured

FREE = sample("stops.right.gap,stops.left.gap,isolator.stiffness", "stops.right.gap,stops.left.gap")
QUICK = {"tried": 0, "starts": 1, "profiles": False}
CHANGES = {
    "displacement": (lambda d: -d, "the sign of the displacement reversed"),
    "base_acceleration": (lambda d: -d, "the sign of the base acceleration reversed"),
    "acceleration": (lambda d: -d, "the sign of the acceleration reversed"),
}


@pytest.fixture(scope="module")
def data():
    return record(motion(1.5, 11, skip=6, samples=40), 0.01)


@pytest.mark.parametrize("channel", sample(list(CHANGES), ["displacement"]))
def test_a_reversed_sensor_is_suggested_as_the_cause(data, channel):
    change, cause = CHANGES[channel]
    turned = data.assign({channel: change(data[channel])})
    fit = vi.identify(START, turned, FREE, **QUICK)
    (line,) = [line for line in fit.findings.splitlines() if "reversed" in line]
    assert cause in line
    assert "sign changed in the data" in line
    # It stands first, for the values mean nothing.
    assert fit.findings.splitlines()[0] == line


def test_a_gap_that_no_displacement_comes_near_is_absurd_beside_a_reversed_sensor(data):
    """A gap of 5 m is never touched, so that the fit stays there: 494 times the displacement."""
    far = START.replace(right=RIGHT.replace(gap="5 m"))
    turned = data.assign(displacement=-data.displacement)
    fit = vi.identify(far, turned, "stops.right.gap,stops.left.gap", **QUICK)
    lines = fit.findings.splitlines()
    assert "the sign of the displacement reversed" in lines[0]
    gaps = fit.fitted_value.sel(parameter=["stops.right.gap", "stops.left.gap"]).values
    swing = np.ptp(turned["displacement"].values) / 2.0
    absurd = np.abs(gaps) > 100.0 * swing
    assert absurd.tolist() == [True, False]
    (line,) = [line for line in lines if "is implausible" in line]
    assert line == lines[1]
    assert line.startswith("stops.right.gap 5 m is implausible: ")
    assert float(line.split(": ")[1].split()[0]) == pytest.approx(5.0 / swing, rel=5e-3)


def test_a_right_sensor_is_not_suspected(data):
    fit = vi.identify(START, data, FREE, **QUICK)
    assert "reversed" not in fit.findings


@pytest.mark.full
def test_an_offset_is_suggested_as_the_cause(data):
    moved = data.assign(displacement=data.displacement + 2e-3)
    fit = vi.identify(RIG, moved, "stops.right.gap,stops.left.gap", **QUICK)
    (line,) = [line for line in fit.findings.splitlines() if "offset" in line]
    assert "displacement_offset 2" in line or "displacement_offset 1.99" in line
    assert "its offset free" in line
    free = ["stops.right.gap", "stops.left.gap", "displacement_offset"]
    again = vi.identify(RIG, moved, free, **QUICK)
    assert again.fitted_value.values == pytest.approx([9e-3, 6e-3, 2e-3], rel=0.02)
    assert "check this sensor" not in again.findings


def test_a_scale_below_zero_is_that_of_a_sensor_turned_round(data):
    turned = data.assign(displacement=-1.02 * data.displacement)
    free = {"stops.right.gap": None, "displacement_scale": {"start": -1}}
    rig = RIG.replace(right=RIGHT.replace(gap="8.5 mm"))
    fit = vi.identify(rig, turned, free, **QUICK)
    assert fit.fitted_value.values == pytest.approx([9e-3, -1.02], rel=0.01)


def test_maxima_of_a_sensor_turned_round_are_minima():
    rig = RIG.replace(right=RIGHT, left=LEFT)
    data = curves(rig, "0.05 g", names=PEAKS, frequencies=np.arange(1.0, 2.5, 0.1))
    turned = data.assign(
        displacement_max=-1.03 * data.displacement_min,
        displacement_min=-1.03 * data.displacement_max,
    )
    start = rig.replace(right=RIGHT.replace(gap="8.7 mm"))
    fit = vi.identify(
        start, turned, {"stops.right.gap": None, "displacement_scale": {"start": "-1"}}, **QUICK
    )
    assert fit.fitted_value.values == pytest.approx([9e-3, -1.03], rel=1e-4)


def test_a_velocity_has_no_offset_of_a_displacement():
    sensors = {"displacement_scale": 2.0, "acceleration_scale": 3.0,
               "displacement_offset": 0.1, "acceleration_offset": 0.2}  # fmt: skip
    values = np.array([1.0, -2.0])
    assert sensed("velocity", values, sensors).tolist() == [1.0, -2.0]
    for name in ("displacement", "velocity", "acceleration"):
        assert corrected(name, sensed(name, values, sensors), sensors) == pytest.approx(values)


def test_a_free_vibration_has_the_size_of_its_motion():
    time = np.linspace(0.0, 4.0, 401)
    u = 0.02 * np.exp(-0.5 * time) * np.cos(7.0 * time)
    data = as_measured(
        xr.Dataset({"displacement": ("time", u), "base_acceleration": ("time", 0.0 * u)},
                   {"time": time})
    )  # fmt: skip
    (test,) = fit_inputs.tests_of(RIG, data, None, None, False)
    assert 0.01 < test.swing < 0.02
