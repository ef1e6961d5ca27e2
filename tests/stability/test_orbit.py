"""Single orbits by Newton's method."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi


def test_it_agrees_with_settling():
    case = vi.laboratory.case("B3-10mm-A3")
    for frequency in (0.5, 1.12, 2.0):
        shaken = vi.Harmonic(case.amplitude, frequency, 0.4)
        settled = vi.steady(vi.Rig(case.oscillator, shaken))
        orbit = vi.orbit(vi.Rig(case.oscillator, shaken), settled)
        for name in ("displacement_max", "acceleration_max", "energy_supplied"):
            assert float(orbit[name]) == pytest.approx(float(settled[name]), rel=1e-10)
        assert float(orbit["residual"]) <= 1e-12
        np.testing.assert_allclose(orbit["exponents"], settled["exponents"], atol=1e-9)
        moduli = np.hypot(orbit["multiplier_real"], orbit["multiplier_imag"]).values
        assert np.log(moduli[0]) * frequency == pytest.approx(
            float(settled["exponents"][0]), abs=1e-9
        )


def test_the_antisymmetric_orbit_of_the_non_regular_range_is_unstable():
    """B3-10mm-A3 through 1.02 to 1.10 Hz: there, with a multiplier above 1."""
    case = vi.laboratory.case("B3-10mm-A3")
    for frequency in (1.02, 1.06, 1.10):
        orbit = vi.orbit(
            vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, frequency)), vi.State(1e-3, -0.02)
        )
        assert bool(orbit["antisymmetric"])
        assert int(orbit["stable"]) == 0
        assert 1.01 < float(orbit["multiplier_real"][0]) < 2.0
        assert orbit.attrs["contacts"] == "LR"
        # A motion beside it leaves.
        shaken = vi.Harmonic(case.amplitude, frequency)
        state = orbit["final_state"].values
        beside = vi.State(state[0] + 1e-7, state[1])
        left = vi.steady(vi.Rig(case.oscillator, shaken), beside, window=50)
        assert float(left["displacement_excursion"]) > 1.005 * float(
            orbit["displacement_excursion"]
        )


def test_a_longer_period():
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), vi.Bumper(29.0, 0.0, 1.26), None)
    omega = 0.81
    shaken = vi.Harmonic(0.7 * omega**2, omega / (2 * np.pi), np.pi)
    settled = vi.steady(vi.Rig(rig, shaken))
    orbit = vi.orbit(vi.Rig(rig, shaken), settled, period=5)
    assert int(orbit["period"]) == 5
    assert float(orbit["cycle"][-1]) == 5.0


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"period": 0}, "period"),
        ({"samples": True}, "samples"),
        ({"start": "rest"}, "start"),
        ({"start": vi.State(0.5, 3.0)}, "no orbit"),
    ],
)
def test_refused(wrong, message):
    case = vi.laboratory.case("B2-G1-A3")
    with pytest.raises(vi.InputError, match=message):
        vi.orbit(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.06, 0.0)), **wrong)


@pytest.mark.parametrize("start", [None, vi.State(), vi.State(0.3, -2.0)])
@pytest.mark.parametrize("damping_ratio", [5e-4, 0.05])
def test_free_flight_is_found_from_anywhere(damping_ratio, start):
    """The problem is linear: how light the damping is, and how small the start, means nothing."""
    omega0 = 2.0 * np.pi
    force = 0.4
    isolator = vi.Isolator(omega0**2, 2.0 * damping_ratio * omega0)
    rig = vi.Oscillator(1.0, isolator, force=force)
    for frequency in (0.05, 0.25, 0.5, 0.99, 1.0, 1.2, 2.0, 7.3):
        omega = 2.0 * np.pi * frequency
        orbit = vi.orbit(vi.Rig(rig, vi.Harmonic(1.5, frequency)), start)
        swing = 1.5 / np.hypot(omega0**2 - omega**2, 2.0 * damping_ratio * omega0 * omega)
        assert float(orbit["displacement_excursion"]) == pytest.approx(2.0 * swing, rel=1e-9)
        assert float(orbit["eccentricity"]) == pytest.approx(force / omega0**2, abs=1e-9 * swing)
        assert int(orbit["period"]) == 1


@pytest.mark.parametrize("gap", [0.0, -0.02])
def test_a_start_at_rest_beside_attached_bumpers_has_no_size(gap):
    rig = vi.Oscillator(1.0, vi.Isolator(40.0, 0.6), vi.Bumper(100.0, 1.0, gap))
    for frequency in (0.7, 1.3, 3.0, 8.0):
        orbit = vi.orbit(vi.Rig(rig, vi.Harmonic(1.0, frequency)), vi.State())
        assert float(orbit["residual"]) <= 1e-12


def test_a_completed_chatter_forgets_everything():
    """A spring that yields on its way to the stop rests on its limit, whatever came before."""
    isolator = vi.BilinearIsolator(
        damping=0.0,
        damping_exponent=0.5,
        elastic_stiffness=1006.7601719594902,
        post_yield_stiffness=902.9338161496553,
        yield_force=32.94496326315633,
    )
    gap = -0.057891466817895885
    rig = vi.Oscillator(74.3114677960523, isolator, vi.RigidStop(0.9, gap))
    shaken = vi.Harmonic(2.153514390835883, 0.0992367688416092)
    start = vi.State(gap, -0.3209708699329611)
    orbit = vi.orbit(vi.Rig(rig, shaken), start)
    assert (np.hypot(orbit["multiplier_real"], orbit["multiplier_imag"]) == 0.0).all()
    assert (vi.steady(vi.Rig(rig, shaken), start)["exponents"] == -np.inf).all()
    growth = vi.lyapunov_exponents(vi.Rig(rig, shaken), [shaken.frequency], start=start)
    assert (growth["exponents"] == -np.inf).all()


@pytest.mark.filterwarnings("ignore:steady. the motion may not have settled:RuntimeWarning")
def test_what_an_elastic_spring_remembers_through_a_rest():
    """One that does not yield on its way to the stop: by differences of the motion itself."""
    isolator = vi.BilinearIsolator(1.0, 0.2, 0.25, 0.05)
    rig = vi.Oscillator(1.0, isolator, vi.RigidStop(0.5, -0.1))
    shaken = vi.Harmonic(0.2, 0.03)
    orbit = vi.orbit(vi.Rig(rig, shaken), vi.steady(vi.Rig(rig, shaken)))
    section = orbit["final_state"].values
    ends = []
    for step in (1e-6, -1e-6):
        start = vi.State(section[0], section[1], isolator=section[-1] + step)
        ends.append(vi.simulate(vi.Rig(rig, shaken), 1, start)["final_state"].values)
    slope = (ends[0] - ends[1]) / 2e-6
    assert slope[-1] == pytest.approx(float(orbit["monodromy"][4, 4]), rel=1e-5, abs=1e-9)


@pytest.mark.filterwarnings("ignore:steady. the motion may not have settled:RuntimeWarning")
def test_a_spring_that_just_yields_has_a_derivative_on_each_side():
    """The motion has settled where the spring just reaches its yield force in each cycle.

    One side of that memory yields and is forgotten in part; on the other side nothing yields and
    all of it is kept. The multiplier is that of the side on which rounding has left the memory;
    central differences give the mean.
    """
    isolator = vi.BilinearIsolator(1.0, 0.2, 0.25, 0.05)
    rig = vi.Rig(vi.Oscillator(1.0, isolator, vi.RigidStop(0.5, -0.3)), vi.Harmonic(0.3, 0.03))
    orbit = vi.orbit(rig, vi.steady(rig))
    u, v, memory = orbit["final_state"].sel(component=["displacement", "velocity", "isolator"]).data
    kept = float(orbit["monodromy"][4, 4])

    def slope(step):
        end = vi.simulate(rig, 1, vi.State(u, v, isolator=memory + step), samples=0)
        return (float(end["final_state"].sel(component="isolator")) - memory) / step

    for step in (1e-3, 1e-5, 1e-7):
        assert slope(step) == pytest.approx(1.0, rel=1e-6)
    assert slope(-1e-6) == pytest.approx(slope(-1e-5), rel=1e-4)
    assert 0.4 < slope(-1e-6) < 0.45
    yields = kept < 0.9
    assert kept == (
        pytest.approx(slope(-1e-6), rel=1e-4) if yields else pytest.approx(1, abs=1e-12)
    )


@pytest.mark.parametrize("phase", [0.0, 1.5, 3.0, 4.5])
def test_exponents_do_not_depend_on_where_the_section_lies(phase):
    """Where the section lies in a rest, what the spring remembers moves nothing at once."""
    isolator = vi.BilinearIsolator(1.0, 0.2, 0.25, 0.05)
    oscillator = vi.Oscillator(1.0, isolator, vi.RigidStop(0.5, -0.1))
    rig = vi.Rig(oscillator, vi.Harmonic(0.2, 0.03, phase))
    with pytest.warns(RuntimeWarning, match="largest Floquet multiplier of its orbit is 1"):
        motion = vi.steady(rig)
    assert motion["exponents"].values[0] == pytest.approx(0.0, abs=1e-12)
    assert motion["exponents"].values[1] == -np.inf
    assert int(motion["stable"]) == -1
    orbit = vi.orbit(rig, motion)
    np.testing.assert_allclose(orbit["exponents"], motion["exponents"], atol=1e-12)
    assert float(orbit["multiplier_real"][0]) == pytest.approx(1.0, abs=1e-12)
