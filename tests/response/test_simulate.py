"""``simulate``: what the dataset holds, how samples and states agree with the equations."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from reference.paper_signs import in_paper_signs
from reference.paper_signs import start as start_at

CASE = vi.laboratory.case("B2-G1-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 1.1, 0.4)

EVERY_SAMPLE = {
    "displacement": "m",
    "velocity": "m s-1",
    "acceleration": "m s-2",
    "base_acceleration": "m s-2",
}
EVERY_STOP = {"deformation": "m", "clearance": "m", "touching": "1"}


@pytest.fixture(scope="module")
def motion() -> xr.Dataset:
    """Ten cycles with contacts on both sides."""
    return vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 10, vi.State(1e-3, 0.1), samples=512)


def test_variables_dims_and_units(motion: xr.Dataset) -> None:
    for name, units in EVERY_SAMPLE.items():
        assert motion[name].dims == ("time",)
        assert motion[name].attrs["units"] == units
    assert motion["stop"].values.tolist() == ["right", "left"]
    for name, units in EVERY_STOP.items():
        assert motion[name].dims == ("stop", "time")
        assert motion[name].attrs["units"] == units
    assert motion["touching"].dtype == bool
    assert motion["time"].attrs["units"] == "s"
    assert motion["final_state"].dims == ("component",)
    assert motion.sizes["time"] == 10 * 512 + 1
    for name in motion.variables:
        assert motion[name].attrs["long_name"]
        assert not motion[name].isnull().any()


def test_the_dataset_says_how_it_was_made(motion: xr.Dataset) -> None:
    assert motion.attrs["created_by"] == "vibroimpact.simulate"
    assert motion.attrs["vibroimpact_version"] == vi.__version__
    assert motion["status"] == 0
    made = json.loads(motion.attrs["parameters"])
    assert vi.Oscillator(**made["oscillator"]) == CASE.oscillator
    assert [made[k] for k in ("amplitude", "frequency", "phase", "cycles")] == [
        *(SHAKEN.amplitude, SHAKEN.frequency, SHAKEN.phase),
        10,
    ]


def test_time_and_base(motion: xr.Dataset) -> None:
    cycle = np.arange(10 * 512 + 1) / 512
    np.testing.assert_array_equal(motion["cycle"], cycle)
    np.testing.assert_allclose(motion["time"], cycle / 1.1, rtol=1e-15)
    base = CASE.amplitude * np.sin(2 * np.pi * cycle + 0.4)
    np.testing.assert_allclose(motion["base_acceleration"], base, atol=1e-13)


def test_samples_obey_the_equations(motion: xr.Dataset) -> None:
    rig = CASE.oscillator
    right, left = rig.right, rig.left
    assert right
    assert left
    signed = in_paper_signs(motion)
    u, v, contact = (signed[name].values for name in ("displacement", "velocity", "contact"))
    face = {1: signed["right_bumper"].values, -1: signed["left_bumper"].values}
    assert (motion["deformation"] >= 0.0).all()
    assert {-1, 0, 1} == set(contact.tolist())
    force = rig.isolator.stiffness * u + rig.isolator.damping * v
    for side, bumper in ((1, right), (-1, left)):
        pressing = bumper.stiffness * face[side] + bumper.damping * v
        assert (side * pressing[contact == side]).min() >= -1e-9
        assert (side * face[side]).min() >= 0.0
        force += np.where(contact == side, pressing, 0.0)
        np.testing.assert_allclose(
            u[contact == side] - side * bumper.gap, face[side][contact == side], atol=1e-17
        )
    np.testing.assert_allclose(motion["acceleration"], -force / rig.mass, atol=1e-13)
    # Equation 4.
    apart = right.gap + face[1] - u, left.gap + u - face[-1]
    for name, clearance in zip(("right", "left"), apart, strict=True):
        np.testing.assert_allclose(motion["clearance"].sel(stop=name), clearance, atol=1e-17)
        assert motion["clearance"].sel(stop=name).min() >= 0.0
    # Between events the derivative of u is v; the samples are close enough for six digits.
    smooth = contact[2:] == contact[:-2]
    slope = (u[2:] - u[:-2]) / np.diff(motion["time"].values[::2][:2])
    np.testing.assert_allclose(slope[smooth], v[1:-1][smooth], atol=2e-3 * np.abs(v).max())


def test_events_are_where_the_contact_changes(motion: xr.Dataset) -> None:
    begins, side = (
        motion["event_contact"].values,
        in_paper_signs(motion)["event_side"].values,
    )
    assert motion["event_contact"].dims == ("event",)
    assert motion["event_time"].attrs["units"] == "s"
    np.testing.assert_array_equal(begins[::2], 1)
    np.testing.assert_array_equal(begins[1::2], 0)
    np.testing.assert_array_equal(side[::2], side[1::2])
    time = motion["event_time"].values
    assert (np.diff(time) > 0.0).all()
    again = (motion["event_cycle"] + motion["event_cycle_time"] * 1.1) / 1.1
    np.testing.assert_allclose(time, again, rtol=1e-15)
    # The contact of a sample is that behind the last event.
    last = np.searchsorted(time, motion["time"].values, side="right") - 1
    expected = np.where(last < 0, 0, (begins * side)[last])
    np.testing.assert_array_equal(in_paper_signs(motion)["contact"], expected)
    # A Kelvin-Voigt contact begins with a jump of C_j v, and ends without one.
    bumper = CASE.oscillator.right
    assert bumper
    jump = (motion["event_acceleration_after"] - motion["event_acceleration_before"]).values
    v = motion["event_velocity"].values
    press = bumper.stiffness * np.where(
        side == 1,
        motion["event_deformation"].sel(stop="right"),
        (-motion["event_deformation"].sel(stop="left")),
    )
    size = np.abs(motion["acceleration"]).max().item()
    start = -(bumper.damping * v + press) / CASE.oscillator.mass
    np.testing.assert_allclose(jump, np.where(begins == 1, start, 0.0), atol=1e-12 * size)


def test_an_absent_bumper_is_no_stop(tmp_path) -> None:
    rig = CASE.oscillator.replace(left=None)
    data = vi.simulate(vi.Rig(rig, SHAKEN), 3)
    assert data["stop"].values.tolist() == ["right"]
    assert not data["clearance"].isnull().any()
    assert set(data["event_stop"].values) == {"right"}
    bare = vi.simulate(vi.Rig(rig.without_bumpers(), SHAKEN), 3)
    assert bare.sizes["stop"] == 0
    assert bare["deformation"].shape == (0, bare.sizes["time"])
    vi.save(bare, tmp_path / "bare.nc")
    xr.testing.assert_identical(vi.load(tmp_path / "bare.nc"), bare)
    assert not [name for name in vi.to_table(bare) if "." in name]
    assert {"clearance.right", "touching.right"} <= set(vi.to_table(data))


@pytest.mark.parametrize(("cycles", "samples"), [(2.5, 4), (0.01, 16), (3.999, 7), (1, 1)])
def test_the_end_is_the_end(cycles: float, samples: int) -> None:
    data = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), cycles, samples=samples)
    assert data.sizes["time"] == math.ceil(cycles * samples - 1e-9) + 1
    assert data["cycle"].values[-1] == pytest.approx(cycles, rel=1e-15)
    assert (np.diff(data["cycle"]) > 0.0).all()
    end = data["final_state"].sel(component=["displacement", "velocity"]).values
    np.testing.assert_array_equal([data["displacement"][-1], data["velocity"][-1]], end)
    phase = data["final_state"].sel(component="phase").item()
    assert math.remainder(phase - (0.4 + math.tau * cycles), math.tau) == pytest.approx(0, abs=1e-9)


def test_every_form_of_start_goes_on_the_same() -> None:
    whole = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 5, samples=0)
    first = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 2, samples=8)
    state = start_at(first["final_state"].values[:5])
    for start in (first, first["final_state"], state):
        end = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 3, start, samples=0)["final_state"]
        np.testing.assert_allclose(end, whole["final_state"], rtol=1e-12, atol=1e-15)
    # The state's phase goes before that of the excitation.
    other = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN.replace(phase=2.0)), 3, first, samples=0)
    np.testing.assert_array_equal(other["final_state"], end)


def test_no_samples_no_memory() -> None:
    data = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 100_000, samples=0)
    assert set(data.data_vars) == {"final_state", "status"}


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"cycles": 0}, "cycles"),
        ({"cycles": -1.0}, "cycles"),
        ({"cycles": math.nan}, "cycles"),
        ({"cycles": math.inf}, "cycles"),
        ({"cycles": "3 s"}, "cycles"),
        ({"samples": -1}, "samples"),
        ({"samples": 2.5}, "samples"),
        ({"samples": True}, "samples"),
        ({"max_events": 0}, "max_events"),
    ],
)
def test_bad_numbers(arguments: dict[str, object], field: str) -> None:
    with pytest.raises(vi.InputError, match=rf"^{field}: .*(pass|use)") as caught:
        vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), **{"cycles": 1, **arguments})
    assert "\n" not in str(caught.value)


def test_a_motion_that_is_given_up() -> None:
    slow = vi.Harmonic(CASE.amplitude, 0.3)
    with pytest.warns(
        RuntimeWarning,
        match=r"^simulate stopped in cycle 0: one forcing cycle or record step has more events",
    ):
        data = vi.simulate(vi.Rig(CASE.oscillator, slow), 5, samples=16, max_events=3)
    assert "raise max_events" in data.attrs["message"]
    assert data.sizes["time"] == 0
    assert data.sizes["event"] == 3
    whole = vi.simulate(vi.Rig(CASE.oscillator, slow), 5, samples=16)
    np.testing.assert_array_equal(data["event_time"], whole["event_time"][:3])


def test_a_stiffness_beyond_reach_is_told() -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), vi.Bumper(1e30, 0.0, 0.5))
    with pytest.warns(RuntimeWarning, match="raise the frequency, or lower the largest stiffness"):
        vi.simulate(vi.Rig(rig, vi.Harmonic(1.0, 0.1)), 1)


def test_given_up_motion_ends_at_its_last_section() -> None:
    bumper = vi.Bumper(20.0, 0.4, 0.1)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), bumper, bumper)
    with pytest.warns(RuntimeWarning, match="simulate stopped in cycle 0"):
        motion = vi.simulate(vi.Rig(rig, vi.Harmonic(0.6, 0.2, 0.3)), 5, max_events=3)
    assert list(motion["final_state"].values) == [
        *[0.0] * 4,
        pytest.approx(0.3),
        *[0.0] * 3,
    ]


def test_a_drag_that_is_too_stiff_is_told_as_one() -> None:
    """Nothing touches here: it is not chatter, and no number of events would do."""
    rig = vi.Oscillator(550.0, vi.Isolator(26e3, 500.0, damping_exponent=0.1), None, None)
    with pytest.warns(
        RuntimeWarning, match="a damping_exponent below 1 makes the motion too stiff"
    ):
        data = vi.simulate(vi.Rig(rig, vi.Harmonic(0.5, 1.0)), 1)
    assert "too stiff near rest, raise the exponent" in data.attrs["message"]
