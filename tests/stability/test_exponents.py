"""Lyapunov exponents: their sum, closed forms, multipliers, and many at once."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given

import vibroimpact as vi
from properties.strategies import Motion, examples, motions, simulated
from vibroimpact.engine import lyapunov
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.prepared_rig import prepare

CASES = ["B2-G1-A3", "B3-10mm-A3", "B4-G2-A1", "B3-0mm-A3", "B1-G4-A2"]
FREQUENCIES = [0.58, 0.9, 1.02, 1.06, 1.1, 1.2, 2.0, 3.1]


def test_they_sum_to_minus_the_effective_damping():
    """⟨C_eff⟩/M, a bumper's damping included while it is pressed, for periodic and chaotic."""
    data = vi.lyapunov_exponents([vi.laboratory.case(c) for c in CASES], FREQUENCIES, 2000)
    total = data["exponents"].sum("exponent") + data["effective_damping"]
    assert float(np.abs(total).max()) < 1e-8
    assert float((data["effective_damping"]).max()) > 1.2 * float(data["effective_damping"].min())
    assert int((data["exponents"][..., 0] > 0.1).sum()) >= 3  # chaotic ones are among them


@examples(60)
@given(motions(most_damping=0.5))
def test_each_cycle_contracts_by_the_damping_where_memory_has_decayed(motion: Motion) -> None:
    shaken = motion.excitation

    def forgetful(bumper: vi.Bumper | None) -> vi.Bumper | None:
        """The bumper, with so little damping that after T/200 nothing is left."""
        if bumper is None:
            return None
        most = 1e-4 * bumper.stiffness / shaken.frequency
        return bumper.replace(damping=min(bumper.damping, most))

    rig = motion.oscillator
    rig = rig.replace(right=forgetful(rig.right), left=forgetful(rig.left))
    data = simulated(motion._replace(oscillator=rig), 6.0)
    at = data["event_time"].values * shaken.frequency
    # No contact within that time of another event or of a section.
    assume(len(at) == 0 or np.diff(at, append=6.0).min() > 5e-3)
    assume(len(at) == 0 or np.abs(at - np.round(at)).min() > 5e-3)
    state = engine_state(rig, motion.start)
    _, rows = prepare(vi.Rig(rig, shaken)).sections(state, 5, 1000, discard=1)
    sums = rows[:, : lyapunov.SECTION].sum(axis=1)
    scale = np.abs(rows[:, : lyapunov.SECTION]).max()
    assert np.abs(sums).max() < 1e-10 * max(scale, 1.0)


def test_those_of_a_periodic_motion_are_its_multipliers():
    """Averages over many cycles against the eigenvalues of one: real and complex pairs."""
    case = vi.laboratory.case("B3-10mm-A3")
    for frequency, tolerance in ((1.2, 1e-10), (2.0, 2e-3)):
        averaged = vi.lyapunov_exponents([case], [frequency], 4000).isel(rig=0, frequency=0)
        exact = vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, frequency)))
        np.testing.assert_allclose(averaged["exponents"], exact["exponents"], atol=tolerance)


def test_free_flight():
    case = vi.laboratory.case("B2-Ginf-A3")
    rig = case.oscillator
    data = vi.lyapunov_exponents([case], [0.7, 3.0], 3200)
    np.testing.assert_allclose(
        data["exponents"], -rig.damping_ratio * rig.angular_frequency, rtol=1e-3
    )
    np.testing.assert_allclose(
        data["exponents"].sum("exponent"), -rig.isolator.damping / rig.mass, rtol=1e-12
    )


@pytest.mark.filterwarnings("ignore:. of 12 motions were still converging:RuntimeWarning")
def test_threads_change_nothing():
    rigs = [vi.laboratory.case(c) for c in CASES[:3]]
    seen = []
    one, two = (
        vi.lyapunov_exponents(
            rigs, FREQUENCIES[:4], 200, threads=n, progress=lambda *p: seen.append(p)
        )
        for n in (1, 2)
    )
    for name in one:
        np.testing.assert_array_equal(one[name], two[name])
    cycles = 12 * (500 + 100 + 200)
    assert seen[-1] == (cycles, cycles)


def test_a_motion_that_is_given_up():
    case = vi.laboratory.case("B3-10mm-A3")
    data = vi.lyapunov_exponents([case], [0.5], 50, max_events=6).isel(rig=0, frequency=0)
    assert int(data["status"]) == 2
    assert int(data["exponents_cycles"]) == 0
    assert np.isnan(data["exponents"]).all()


@pytest.mark.parametrize(
    "wrong",
    [
        {"cycles": 0},
        {"cycles": 1.5},
        {"transient": -1},
        {"max_events": 0},
        {"threads": 0},
        {"frequencies": [-1.0]},
        {"rigs": []},
        {"rigs": [vi.laboratory.case("B2-G1-A3").oscillator]},
    ],
)
def test_refused(wrong):
    arguments = {"rigs": [vi.laboratory.case("B2-G1-A3")], "frequencies": [2.0], "cycles": 10}
    with pytest.raises(vi.InputError, match=next(iter(wrong))):
        vi.lyapunov_exponents(**{**arguments, **wrong})


@pytest.mark.parametrize("damping", [0.1, 2.0, 6.0, 10.0])
def test_strong_contraction(damping):
    """λ = (−c ± √(c² − 4k))/2, also where one direction dies out e^−300 faster than the other."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, damping), None, None)
    data = vi.lyapunov_exponents([vi.Rig(rig, 1.0)], [0.01], 64, transient=10)
    roots = np.roots([1.0, damping, 1.0]).real
    np.testing.assert_allclose(data["exponents"][0, 0], np.sort(roots)[::-1], rtol=2e-2)
    if damping > 2.0:
        np.testing.assert_allclose(data["exponents"][0, 0], np.sort(roots)[::-1], rtol=1e-10)
    assert float(data["exponents"].sum()) == pytest.approx(-damping, rel=1e-12)


def test_the_sum_rule_where_contraction_is_strong():
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 6.0), vi.Bumper(50.0, 1.0, 1e-3), None)
    data = vi.lyapunov_exponents([vi.Rig(rig, 1.0)], [0.2 / 6.2832], 64, transient=50)
    total = float(data["exponents"].sum()) + float(data["effective_damping"][0, 0])
    assert abs(total) < 1e-8


def test_over_any_parameters():
    """Combined; of free flight −ξω0, whatever the frequency, and each as it is by itself."""
    case = vi.laboratory.case("B2-Ginf-A3")
    rig = case.oscillator
    ratios, springs = [0.05, 0.2], [20e3, 30e3, 40e3]
    data = vi.lyapunov_exponents(
        [case], [2.0, 3.0], 640, vary={"damping_ratio": ratios, "isolator.stiffness": springs}
    )
    assert data["exponents"].dims == (
        "rig",
        "frequency",
        "damping_ratio",
        "isolator.stiffness",
        "exponent",
    )
    known = -np.outer(ratios, np.sqrt(np.array(springs) / rig.mass))
    for k in range(2):
        np.testing.assert_allclose(data["exponents"][0, k].mean("exponent"), known, rtol=1e-12)
    assert data["isolator.stiffness"].attrs["units"] == "N m-1"
    case = vi.laboratory.case("B3-10mm-A3")
    data = vi.lyapunov_exponents([case], [1.06], 200, vary={"gap": ["4 mm", "5 mm"]})
    alone = vi.lyapunov_exponents([case], [1.06], 200)
    np.testing.assert_array_equal(data["exponents"].sel(gap=5e-3), alone["exponents"])
    assert float(np.abs(data["exponents"].sel(gap=4e-3) - alone["exponents"]).max()) > 1e-3


@pytest.mark.parametrize(
    ("vary", "message"),
    [
        ({"frequency": [1.0]}, "vary: 'frequency' is set by the argument frequencies; remove it"),
        ({"colour": [1.0]}, "vary: 'colour'"),
        ({"gap": 3e-3}, "is not a list"),
        ({"gap": [1e-3, 1e-3]}, "given twice"),
        ({"cubic": [1.0]}, "cubic"),
    ],
)
def test_values_that_are_refused(vary, message):
    with pytest.raises(vi.InputError, match=message):
        vi.lyapunov_exponents(["B2-G1-A3"], [2.0], 10, vary=vary)


def test_a_chattering_mass_that_rests_on_its_wall_loses_both_disturbances():
    """Rest on a wall leaves nothing of a disturbance: −∞ twice, and never NaN."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), right=vi.RigidStop(0.8, 0.157))
    frequency = 2.4 / (2.0 * np.pi)
    shaken = vi.Rig(rig, vi.Harmonic(1.0, frequency, of="force"))
    data = vi.lyapunov_exponents({"rattle": shaken}, [frequency], 300)
    assert data["status"].item() == 0
    np.testing.assert_array_equal(data["exponents"].values.ravel(), [-np.inf, -np.inf])


def test_a_direction_that_sticking_takes_is_lost_in_every_answer():
    """Second exponent of a mass that sticks: steady, the averages and the multipliers agree."""
    rig = vi.Oscillator(1.0, vi.FrictionIsolator(1.0, 0.0, 0.9))
    shaken = vi.Harmonic(1.0, 0.8 / (2.0 * math.pi))
    steady = vi.steady(vi.Rig(rig, shaken))["exponents"].values
    averaged = vi.lyapunov_exponents({"rig": vi.Rig(rig, shaken)}, [shaken.frequency], 200)
    assert steady[0] == pytest.approx(-0.26024431, abs=1e-7)
    np.testing.assert_allclose(averaged["exponents"].values.ravel(), steady, atol=1e-8)
    assert steady[1] == -math.inf


@pytest.mark.filterwarnings("ignore:steady. the motion may not have settled:RuntimeWarning")
@pytest.mark.parametrize(
    ("isolator", "restitution", "gap", "amplitude"),
    [
        (vi.BoucWenIsolator(1.0, 0.2, 0.25, 0.05, exponent=2), 0.5, -0.3, 0.3),
        (vi.BoucWenIsolator(1.0, 0.2, 0.25, 0.05, exponent=2), 0.9, -0.3, 0.3),
        (vi.BilinearIsolator(1.0, 0.2, 0.25, 0.05), 0.5, -0.1, 0.2),
    ],
)
def test_what_an_isolator_remembers_through_a_rest_grows_alike_in_every_answer(
    isolator, restitution, gap, amplitude
):
    """A rest takes displacement and velocity; what the isolator remembers is the first exponent."""
    oscillator = vi.Oscillator(1.0, isolator, right=vi.RigidStop(restitution, gap))
    rig = vi.Rig(oscillator, vi.Harmonic(amplitude, 0.03))
    steady = vi.steady(rig)["exponents"].values
    averaged = vi.lyapunov_exponents(rig, [0.03], 50, transient=50)["exponents"].values.ravel()
    assert -0.2 < steady[0] < 1e-10
    assert averaged[0] == pytest.approx(steady[0], rel=1e-6, abs=1e-10)
    assert averaged[1] == steady[1] == -math.inf


def test_strong_damping_leaves_a_second_exponent():
    """A multiplier of 5e-29, lost in rounding beside 0.45: their sum is the damping."""
    rig, shaken = vi.Oscillator(1.0, vi.Isolator(1.0, 8.0)), vi.Harmonic(1.0, 0.8 / (2 * math.pi))
    slow = 4.0 - math.sqrt(15.0)
    exact = np.array([-slow, -(8.0 - slow)])
    np.testing.assert_allclose(vi.steady(vi.Rig(rig, shaken))["exponents"], exact, rtol=1e-12)


def test_what_has_not_settled_says_so():
    """A multiplier of 0.991: a few hundred cycles later the motion still comes closer."""
    rig = vi.Rig(
        vi.Oscillator(1.0, vi.Isolator(1.0, 0.003), vi.Bumper(30.0, 0.0, 100.0)),
        vi.Harmonic(1.0, 0.2),
    )
    with pytest.warns(RuntimeWarning, match="1 of 1 motions were still converging"):
        data = vi.lyapunov_exponents({"slow": rig}, [0.2], 500, transient=0)
    assert data["settling"].item()
    settled = vi.lyapunov_exponents({"slow": rig}, [0.2], 500, transient=20_000)
    assert not settled["settling"].item()


def test_the_uncertainty_of_a_complex_pair_covers_its_error():
    """Against the multipliers of the orbit: a rotation comes again in each block of cycles."""
    for law in (vi.FrictionIsolator(1.0, 0.1, 0.1), vi.BilinearIsolator(2.0, 1.0, 0.3, 0.05)):
        oscillator = vi.Oscillator(1.0, law)
        for frequency in (0.11, 0.23):
            shaken = vi.Harmonic(1.0, frequency)
            orbit = vi.orbit(vi.Rig(oscillator, shaken))
            pair = orbit["multiplier_real"].values + 1j * orbit["multiplier_imag"].values
            assert abs(pair[0].imag) > 1e-3
            exact = frequency * np.log(np.abs(pair[:2]))
            for cycles in (200, 500, 1300):
                data = vi.lyapunov_exponents(
                    {"one": vi.Rig(oscillator, shaken)}, [frequency], cycles, transient=500
                )
                error = np.abs(data["exponents"].values.ravel() - exact)
                assert (error <= 4.0 * data["exponents_uncertainty"].values.ravel()).all()


def test_a_damping_beyond_all_pieces_of_a_cycle_is_followed_at_once():
    """A mass of 1e-12 kg under the damping of a rig: 7e12 pieces of a cycle, all alike."""
    rig = vi.Oscillator(1e-12, vi.Isolator(26800.0, 1100.0))
    data = vi.lyapunov_exponents([vi.Rig(rig, 0.5)], [1.0], 4, transient=2)
    first, second = data["exponents"].values.ravel()
    # The logarithm of a piece is 3e-12, and is rounded to 1e-16.
    assert first == pytest.approx(-26800.0 / 1100.0, rel=1e-4)
    assert second == pytest.approx(-1100.0 / 1e-12, rel=1e-6)
