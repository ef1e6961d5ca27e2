"""Fits of what others measured and computed, with what the model lacks."""

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from measured import measured
from vibroimpact.figures import fit_history
from vibroimpact.measurements.read import as_measured


def impact(name: str, run: str) -> tuple[xr.Dataset, float]:
    """A cart's contact with a pad, and its mass (kg) by the impulse over the change of velocity.

    The force is negative in compression and has an offset; the pad lies at positive displacement.
    """
    data = vi.read_measurement(measured(f"pad_impacts/{name}.csv"), group=run)
    time, velocity = data.time.values, data.velocity.values
    force = data.contact_force.values - np.median(data.contact_force.values[:30])
    begin = end = int(np.argmin(force))
    while force[begin] < -0.1:
        begin -= 1
    while force[end] < -0.05:
        end += 1
    known = np.isfinite(velocity)
    before = velocity[known & (time < time[begin])][-3:].max()
    behind = velocity[known & (time > time[end])][:3].mean()
    touching = slice(begin, end + 1)
    mass = -np.trapezoid(force[touching], time[touching]) / (before - behind)
    seen = slice(begin - 8, end + 6)
    place = data.displacement.values[seen]
    channels = {
        "displacement": ("time", place - np.nanmin(place)),
        "acceleration": ("time", force[seen] / mass),
        "base_acceleration": ("time", np.zeros(len(place))),
    }
    return as_measured(xr.Dataset(channels, {"time": time[seen]})), float(mass)


@pytest.mark.full
def test_a_foam_pad_is_a_spring_to_a_fortieth_of_its_force_and_no_dashpot():
    data, mass = impact("pad_40mm", "Run 1")
    assert mass == pytest.approx(0.565, abs=0.01)
    stiffness = mass * (np.pi / 0.25) ** 2  # half a period is the time of contact
    pad = vi.Bumper(stiffness, 0.1 * np.sqrt(stiffness * mass), 0.06)
    cart = vi.Oscillator(mass, vi.Isolator(0.0, 0.0), pad, None)
    free = {
        "stops.right.stiffness": None,
        "stops.right.damping": None,
        "stops.right.gap": (0.0, 0.2),
    }
    fit = vi.identify(cart, data, free, tried=0, starts=1)
    value = dict(zip(fit.parameter.values.tolist(), fit.fitted_value.values, strict=True))
    assert value["stops.right.stiffness"] == pytest.approx(83.0, abs=4.0)
    assert 0.0 <= value["stops.right.damping"] < 2.0
    seen = fit.isel(point=fit.point_variable.values == "acceleration")
    left = mass * (seen.modelled_value - seen.measured_value)
    peak = mass * float(abs(seen.measured_value).max())
    assert peak == pytest.approx(5.33, abs=0.05)
    assert float(np.sqrt((left**2).mean())) < 0.03 * peak
    # The force of foam bends off, and comes back otherwise than it went: this is told.
    assert "the residuals are not noise" in fit.attrs["findings"]
    assert float(fit.residual_excess[0]) > 3.0
    assert len(fit_history(fit)) == 2


def test_a_pad_that_is_struck_through_is_no_spring():
    """On 4 mm of foam the cart meets what is beneath: the force doubles within 20 ms."""
    data, mass = impact("pad_4mm", "Run 2")
    stiffness = mass * (np.pi / 0.25) ** 2
    cart = vi.Oscillator(mass, vi.Isolator(0.0, 0.0), vi.Bumper(stiffness, 0.5, 0.06), None)
    free = {"stops.right.stiffness": None, "stops.right.gap": (0.0, 0.2)}
    fit = vi.identify(cart, data, free, tried=0, starts=1, profiles=False)
    # The samples beside the leap of the force count less: when it came is not known better.
    assert float(fit.residual_excess[0]) > 3.5
    assert "times the noise of the measurement" in fit.attrs["findings"]


def test_anothers_simulator_with_a_rigid_stop():
    """Siconos: m = 1 g, k = 100 N/m, e = 0.9, its weight towards the stop at 0."""
    rows = np.loadtxt(measured("siconos/LinearOscillatorED.ref"), skiprows=1)
    steps = np.isclose(rows[:, 0] / 0.005, np.round(rows[:, 0] / 0.005), atol=1e-6)
    _, first = np.unique(np.round(rows[steps, 0] / 0.005), return_index=True)
    rows = rows[steps][first][:20]
    channels = {
        "displacement": ("time", rows[:, 1]),
        "velocity": ("time", rows[:, 2]),
        "base_acceleration": ("time", np.zeros(len(rows))),
    }
    data = as_measured(xr.Dataset(channels, {"time": rows[:, 0]}))
    rig = vi.Oscillator(
        1e-3, vi.Isolator(95.0, 0.0), None, vi.RigidStop(0.85, 0.0), force=-1e-3 * 9.81
    )
    fit = vi.identify(
        rig, data, "isolator.stiffness,stops.left.restitution", profiles=False, tried=32, starts=4
    )
    assert fit.fitted_value.values == pytest.approx([100.0, 0.9], rel=1e-3)
