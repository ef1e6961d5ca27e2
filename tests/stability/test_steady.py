"""Steady motions: measured as elsewhere, named by their symmetry, ended where they must."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi


@cache
def steady(code: str, frequency: float, direction: str = "", phase: float = 0.0) -> xr.Dataset:
    case = vi.laboratory.case(code)
    start = None
    if direction:
        way = np.arange(round(0.3 / 0.02), round(6.0 / 0.02)) * 0.02
        path = (
            way[way < frequency - 1e-9] if direction == "forward" else way[way > frequency + 1e-9]
        )
        swept = vi.sweep(vi.Rig(case.oscillator, case.amplitude), path, direction, phase=phase)
        end = -1 if direction == "forward" else 0
        start = swept["section"].isel(direction=0, frequency=end, drop=True)
    return vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, frequency, phase)), start)


@pytest.mark.parametrize("frequency", [0.58, 1.2, 2.0])
def test_it_measures_what_a_sweep_measures(frequency):
    case = vi.laboratory.case("B3-10mm-A3")
    data = steady("B3-10mm-A3", frequency=frequency)
    swept = vi.sweep(vi.Rig(case.oscillator, case.amplitude), [frequency], "forward").isel(
        direction=0, frequency=0
    )
    for name in (
        *("displacement_max", "displacement_min", "acceleration_max", "acceleration_min"),
        *("displacement_excursion", "acceleration_excursion"),
    ):
        assert float(data[name]) == pytest.approx(float(swept[name]), rel=1e-10)
    for name in ("impacts", "period"):
        np.testing.assert_array_equal(data[name], swept[name])
    assert data["motion"].item() == "periodic"
    assert data["status"] == 0


def test_one_period_closes():
    data = steady("B3-10mm-A3", frequency=0.5, phase=0.7)
    for name in ("displacement", "velocity", "acceleration", "deformation"):
        size = float(np.abs(data[name]).max())
        ends = data[name].isel(time=0) - data[name].isel(time=-1)
        assert float(abs(ends).max()) < 1e-10 * size
    assert float(data["cycle"][-1]) == 1.0
    extremes = float(data["displacement"].max()), float(data["displacement"].min())
    assert float(data["displacement_max"]) >= extremes[0]
    assert float(data["displacement_min"]) <= extremes[1]


@pytest.mark.parametrize("phase", [0.0, 1.7, 1.7 + np.pi])
def test_the_log_of_a_period_does_not_depend_on_where_it_begins(phase):
    """A contact that goes on across the section is one contact."""
    reference = steady("B2-G1-A3", 2.0, "forward")
    data = steady("B2-G1-A3", 2.0, "forward", phase)
    assert data.sizes["contact_number"] == 2
    assert (float(data["impacts"].sel(stop="right")), float(data["impacts"].sel(stop="left"))) == (
        1.0,
        1.0,
    )
    for name in ("duration", "impulse", "peak_force", "dissipated", "dissipated_relaxing"):
        log = [d.sortby("contact_stop")[f"contact_{name}"].values for d in (reference, data)]
        np.testing.assert_allclose(log[0], log[1], rtol=1e-9)


def test_a_contact_across_the_section():
    """So that the test above has something to show: the mass is in contact at its section."""
    assert any(
        steady("B2-G1-A3", 2.0, "forward", phase)["touching"].isel(time=0).any()
        for phase in (1.7, 1.7 + np.pi)
    )


@pytest.mark.parametrize(("code", "frequency"), [("B2-G1-A3", 2.0), ("B3-10mm-A3", 1.12)])
def test_energy_over_a_cycle(code, frequency):
    data = steady(code, frequency=frequency)
    supplied = float(data["energy_supplied"])
    assert supplied > 0.0
    lost = float(data["energy_isolator"]) + float(data["energy_bumpers"])
    assert lost == pytest.approx(supplied, rel=1e-12)
    # The base works −M A ∫ u̇ sin θ: only the first harmonic of the velocity counts.
    case = vi.laboratory.case(code)
    line = vi.fourier_spectrum(data, 2).sel(order=1.0)
    in_phase = -float(line["velocity_amplitude"]) * np.sin(float(line["velocity_phase"]))
    period = 1.0 / frequency
    work = -case.oscillator.mass * case.amplitude * 0.5 * period * in_phase
    assert supplied == pytest.approx(work, rel=1e-11)


def test_symmetry():
    both = steady("B2-G1-A3", 2.0, "forward")
    assert bool(both["antisymmetric"])
    assert abs(float(both["eccentricity"])) < 1e-12
    one = steady("B3-10mm-A3", frequency=1.12)
    assert not bool(one["antisymmetric"])
    case = vi.laboratory.case("B2-G1-A3").oscillator
    uneven = case.replace(left=case.left.replace(gap=6e-3))
    data = vi.steady(vi.Rig(uneven, vi.Harmonic(0.49, 2.0)))
    assert not bool(data["antisymmetric"])
    assert float(data["mirror_distance"]) > 1e-3
    assert float(data["eccentricity"]) > 0.0


def test_an_even_period_has_no_mirror_image_of_its_own():
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), vi.Bumper(29.0, 0.0, 1.26), None)
    omega = 0.85
    shaken = vi.Harmonic(0.7 * omega**2, omega / (2 * np.pi), np.pi)
    data = vi.steady(vi.Rig(rig, shaken), vi.State(1.0, 0.0))
    assert int(data["period"]) == 2
    assert np.isnan(float(data["mirror_distance"]))
    assert data.sizes["time"] == 2 * 256 + 1


def test_a_motion_that_does_not_settle():
    case = vi.laboratory.case("B3-10mm-A3")
    data = vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.06)), window=50)
    assert data["motion"].item() == "chaotic"
    assert (int(data["period"]), int(data["stable"])) == (0, 0)
    assert float(data["cycle"][-1]) == 50.0
    assert int(data["exponents_cycles"]) == 20_000
    assert float(data["exponents_uncertainty"][0]) < 0.02
    begins = int((data["contact_stop"] == "right").sum())
    assert float(data["impacts"].sel(stop="right")) == begins / 50


def test_the_event_limit_is_told():
    case = vi.laboratory.case("B3-10mm-A3")
    shaken = vi.Harmonic(case.amplitude, 0.5)
    with pytest.warns(RuntimeWarning, match="max_events"):
        data = vi.steady(vi.Rig(case.oscillator, shaken), max_events=6)
    assert data["motion"].item() == "undecided"
    assert "max_events" in data.attrs["message"]
    assert "max_events" in data.attrs["evidence"]
    # What was found until then: the cycles before, and the events of the last one.
    direct = vi.simulate(vi.Rig(case.oscillator, shaken), 3)
    count = data.sizes["event"]
    assert count > 0
    np.testing.assert_array_equal(data["event_time"], direct["event_time"][:count])
    assert np.isnan(data["exponents"]).all()


def test_no_bumper():
    rig = vi.laboratory.case("B2-Ginf-A3").oscillator
    data = vi.steady(vi.Rig(rig, vi.Harmonic(0.5, 1.3)))
    assert data.sizes["contact_number"] == 0
    assert data["motion"].item() == "periodic"
    expected = -rig.damping_ratio * rig.angular_frequency
    np.testing.assert_allclose(data["exponents"], expected, rtol=1e-12)


@pytest.mark.parametrize(
    "wrong",
    [
        {"samples": 0},
        {"window": 0},
        {"max_cycles": 1.5},
        {"exponent_cycles": True},
        {"max_events": -1},
        {"tolerance": 2.0},
        {"start": "rest"},
    ],
)
def test_refused(wrong):
    case = vi.laboratory.case("B2-G1-A3")
    with pytest.raises(vi.InputError, match=next(iter(wrong))):
        vi.steady(vi.Rig(case.oscillator, vi.Harmonic(0.5, 2.0)), **wrong)


def test_undamped_resonance_is_refused():
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), None, None)
    with pytest.raises(vi.InputError, match="frequency"):
        vi.steady(vi.Rig(rig, vi.Harmonic(1.0, rig.natural_frequency)))


def test_a_bumper_that_is_never_touched_has_no_say():
    """It relaxes more slowly than the mass comes to rest, but is not of the motion."""
    bumper = vi.Bumper(1e5, 1e7, 1.0)
    rig = vi.Oscillator(550.0, vi.Isolator(26e3, 1.1e3), bumper, bumper)
    data = vi.steady(vi.Rig(rig, vi.Harmonic(0.5, 1.3)))
    np.testing.assert_allclose(data["exponents"], -1.0, rtol=1e-12)


def rig(damping: float, right=None, left=None) -> vi.Oscillator:
    sides = [None if side is None else vi.Bumper(*side) for side in (right, left)]
    return vi.Oscillator(1.0, vi.Isolator(1.0, damping), *sides)


@pytest.mark.parametrize("damping", [2e-2, 2e-4, 2e-6])
def test_a_slow_decay_is_not_quasi_periodic(damping):
    """A linear mass, whose transient outlasts the cycles that are looked at."""
    data = vi.steady(vi.Rig(rig(damping), vi.Harmonic(1.0, 0.1)), max_cycles=200)
    assert data["motion"].item() in ("periodic", "undecided")
    if data["motion"].item() == "undecided":
        assert "disturbances still decay slowly" in data.attrs["evidence"]


def test_transient_chaos_that_has_ended():
    """Period 1 since some cycle in the thousands: judged by its orbit, not by its past."""
    bumper = (28.6, 0.0, 0.2)
    data = vi.steady(vi.Rig(rig(0.02, bumper, bumper), vi.Harmonic(1.0, 0.2105)))
    assert (data["motion"].item(), int(data["period"])) == ("periodic", 1)
    np.testing.assert_allclose(data["exponents"], -0.01, rtol=1e-9)
    assert int(data["stable"]) == 1


@pytest.mark.parametrize("limits", [(100, 2000), (1, 3)])
def test_the_event_limit_while_exponents_are_followed(limits):
    case = vi.laboratory.case("B3-10mm-A3")
    with pytest.warns(RuntimeWarning, match="max_events"):
        data = vi.steady(
            vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.06)),
            max_events=6,
            max_cycles=limits[0],
            exponent_cycles=limits[1],
        )
    assert "max_events" in data.attrs["message"]
    assert data["motion"].item() == "undecided"
    # The record begins at the section, at the phase that it claims.
    assert float(data["base_acceleration"][0]) == 0.0
    assert data.sizes["event"] >= 5
    assert np.isfinite(float(data["energy_bumpers"]))


@pytest.mark.parametrize(("which", "shift"), [("end", 0.0), ("start", -1e-15), ("start", 0.0)])
def test_a_section_exactly_at_an_event(which, shift):
    first = steady("B2-G1-A3", 1.5, "forward")
    phase = float(first[f"contact_{which}_phase"][1]) + shift
    data = steady("B2-G1-A3", 1.5, "forward", phase)
    assert (float(data["impacts"].sel(stop="right")), float(data["impacts"].sel(stop="left"))) == (
        1.0,
        1.0,
    )
    lost = float(data["energy_isolator"]) + float(data["energy_bumpers"])
    assert lost == pytest.approx(float(data["energy_supplied"]), rel=1e-9)


def test_without_dissipation_an_orbit_is_neither_stable_nor_unstable():
    for frequency in (0.1, 0.2, 0.3, 0.37):
        omega = 2 * np.pi * frequency
        start = vi.State(0.0, -omega / (1.0 - omega**2))
        with pytest.warns(RuntimeWarning, match="more slowly than exponentially"):
            data = vi.steady(vi.Rig(rig(0.0), vi.Harmonic(1.0, frequency)), start)
        assert int(data["period"]) == 1
        assert int(data["stable"]) == -1
        assert "not isolated" in data.attrs["evidence"]


def test_records_that_would_not_fit_are_refused():
    for field in ("window", "exponent_cycles"):
        with pytest.raises(vi.InputError, match=field):
            vi.steady(vi.Rig(rig(0.1), vi.Harmonic(1.0, 0.1)), **{field: 10**9})


def test_what_settles_slowly_is_not_quasi_periodic_where_bumpers_forget():
    """A period 4 that is approached by the factor 0.99963 a period, just beyond grazing."""
    omega = 2.0 / 5.5
    amplitude = 1.002 * 1.26 * np.hypot(1.0 - omega**2, 0.02 * omega)
    data = vi.steady(
        vi.Rig(rig(0.02, (29.0, 0.0, 1.26)), vi.Harmonic(amplitude, omega / (2 * np.pi)))
    )
    assert (data["motion"].item(), int(data["period"])) == ("periodic", 4)
    assert int(data["stable"]) == 1
    assert "0.99963" in data.attrs["evidence"]
    assert "settles slowly" in data.attrs["evidence"]


def test_a_motion_that_grows_between_a_wall_and_nothing_has_no_kind():
    """A wall doubles the natural frequency: at this resonance nothing holds the motion."""
    oscillator = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), left=vi.Bumper(3.0, 0.0, 0.3))
    data = vi.steady(
        vi.Rig(oscillator, vi.Harmonic(1.0, 4.0 / 3.0 / math.tau)), exponent_cycles=4000
    )
    assert data["motion"].item() == "undecided"
    assert "the motion grows" in data.attrs["evidence"]


def test_a_rig_too_fast_to_be_followed_is_one_line():
    oscillator = vi.Oscillator(1e-12, vi.Isolator(1e8, 0.1), vi.Bumper(1e8, 1.0, 0.01))
    with pytest.raises(vi.InputError, match="the motion could not be simulated: the fastest"):
        vi.steady(vi.Rig(oscillator, vi.Harmonic(0.5, 1.0)), samples=16)
