"""The motion of the mass as a record: impulses are kept, and spectra converge."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from earthquakes.rigs import RIGS, noise

RECORD = noise(8)


@pytest.mark.parametrize("name", ["bumpers", "walls", "friction"])
def test_all_of_an_impulse_is_in_it(name: str) -> None:
    """The sum of its samples is the change of the absolute velocity, impacts and all."""
    rig = RIGS[name]
    motion = vi.simulate(vi.Rig(rig, RECORD), tail=2.0, samples=4)
    floor = vi.floor_record(motion)
    time = np.arange(len(floor.acceleration) + 1) * floor.step
    ground = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(time) * _sums(RECORD.at(time)))])
    u = motion["displacement"].values[: len(time)]
    # Mean velocities over the last step and before the first one, which is at rest.
    expected = (u[-1] - u[-2]) / floor.step + ground[-1]
    assert floor.acceleration.sum() * floor.step == pytest.approx(expected, abs=1e-9)
    assert np.abs(floor.acceleration).max() > np.abs(RECORD.acceleration).max()


def _sums(values: np.ndarray) -> np.ndarray:
    return np.asarray(values[1:] + values[:-1])


@pytest.mark.parametrize("name", ["bumpers", "walls"])
def test_the_spectrum_converges_to_the_second_order(name: str) -> None:
    """Halving the step quarters the error, jumps and impacts included."""
    rig = RIGS[name]
    periods = [0.3, 0.8, 1.7]
    spectra = []
    for samples in (4, 8, 16, 128):
        motion = vi.simulate(vi.Rig(rig, RECORD), tail=2.0, samples=samples)
        spectrum = vi.response_spectrum(vi.floor_record(motion), periods, 0.05)
        spectra.append(spectrum["spectral_displacement"].values)
    *coarse, fine = spectra
    errors = [np.abs(one / fine - 1.0).max() for one in coarse]
    assert errors[0] < 0.02
    assert errors[2] < errors[0] / 8.0


def test_the_floor_of_a_stiff_rig_is_the_ground() -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1e7, 300.0))
    floor = vi.floor_record(vi.simulate(vi.Rig(rig, RECORD), samples=1)).acceleration
    ground = RECORD.acceleration
    weighted = (ground[:-2] + 4.0 * ground[1:-1] + ground[2:]) / 6.0
    assert np.abs(weighted - ground[1:-1]).max() > 0.1
    np.testing.assert_allclose(floor[1:], weighted, atol=3e-3 * RECORD.peak)


def test_the_base_may_stop_at_once() -> None:
    """A record that ends with its largest value: the mean at its end has half of it."""
    rig = vi.Oscillator(1.0, vi.Isolator(1e9, 3e3))
    record = vi.Record(np.append(np.zeros(10), np.ones(11)), 0.1)
    floor = vi.floor_record(vi.simulate(vi.Rig(rig, record), tail=1.0, samples=1))
    assert floor.acceleration[20] == pytest.approx(0.5, abs=1e-3)
    assert floor.acceleration[15] == pytest.approx(1.0, abs=1e-3)
    assert floor.acceleration[25] == pytest.approx(0.0, abs=1e-3)


def test_wrong_input() -> None:
    rig = RIGS["bumpers"]
    with pytest.raises(
        vi.InputError, match=r"^motion: its excitation is periodic, not a record; pass"
    ):
        vi.floor_record(vi.simulate(vi.Rig(rig, vi.Harmonic(1.0, 1.0)), 3))
    with pytest.raises(vi.InputError, match=r"^motion: 3 samples, but at least 4"):
        vi.floor_record(vi.simulate(vi.Rig(rig, RECORD.cut(0.0, 0.04))))
    with pytest.raises(vi.InputError, match=r"^motion: this is not a recorded motion"):
        vi.floor_record(vi.simulate(vi.Rig(rig, RECORD), samples=0))


def test_light_equipment_on_each_storey_moves_as_its_floor_spectrum_says() -> None:
    """A mass that is 1e-9 of its floor does not move it: its drift is that of the spectrum."""
    period, zeta, light = 0.4, 0.05, 1e-6
    stiffness = light * (2.0 * np.pi / period) ** 2
    spring = vi.Isolator(stiffness, 2.0 * zeta * np.sqrt(stiffness * light))
    wall = vi.Bumper(4e5, 2e3, 0.01)
    links = {
        "isolator": vi.Link("ground", "base", vi.Isolator(2e4, 800.0)),
        "storey": vi.Link("base", "roof", vi.Isolator(3e5, 900.0)),
    }
    stops = {
        "right": vi.Link("base", "ground", wall),
        "left": vi.Link("ground", "base", vi.RigidStop(0.6, 0.012)),
    }
    frame = vi.Assembly({"base": 1e3, "roof": 1e3}, links, stops)
    motion = vi.simulate(vi.Rig(frame, RECORD), tail=2.0, samples=32)
    assert {"right", "left"} == {*motion["event_stop"].values}
    for floor in ("base", "roof"):
        carried = frame.replace(
            masses={**frame.masses, "box": light},
            links={**links, "feet": vi.Link(floor, "box", spring)},
        )
        drift = vi.seismic_response(vi.Rig(carried, RECORD), tail=2.0)["peak_drift"]
        spectrum = vi.response_spectrum(vi.floor_record(motion, floor), period, zeta)
        expected = float(drift.sel(link="feet"))
        assert float(spectrum["spectral_displacement"]) == pytest.approx(expected, rel=2e-4)
