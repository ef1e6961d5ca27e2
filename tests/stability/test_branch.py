"""Branches: orbits all along, bifurcations where they must be, ends that are told."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.response.resonance import features


@cache
def diagram(code: str, low: float = 0.3, high: float = 4.0, phase: float = 0.0):
    case = vi.laboratory.case(code)
    return vi.resonance_diagram(case.oscillator, case.amplitude, low, high, phase=phase)


def values(data, kind: str) -> np.ndarray:
    return np.sort(data["bifurcation_value"].values[data["bifurcation_kind"].values == kind])


def near(data, kind: str, value: float, tolerance: float) -> bool:
    return bool(np.any(np.abs(values(data, kind) - value) <= tolerance))


class TestPublishedRigs:
    """What the sweeps and motions of the laboratory's rigs are made of."""

    def test_non_regular_range(self):
        data = diagram("B3-10mm-A3")
        assert near(data, "symmetry breaking", 1.25, 0.01)
        assert near(data, "fold", 0.68, 0.01)
        assert near(data, "fold", 0.72, 0.01)

    def test_the_pair_loses_stability_by_period_doubling(self):
        """Near 1.11 Hz, at −1 exactly; a pair on the unit circle cannot be.

        Where the bumpers' memory has decayed the product of the multipliers is exp(−∫c dt) < 1,
        so that there is no Neimark-Sacker bifurcation.
        """
        data = diagram("B3-10mm-A3")
        assert near(data, "period doubling", 1.1095, 1e-4)
        assert len(values(data, "Neimark-Sacker")) == 0
        mine = (data["bifurcation_kind"] == "period doubling") & (data["bifurcation_period"] == 1)
        for row in data["bifurcation_multiplier_real"].values[mine.values]:
            assert row[0] == pytest.approx(-1.0, abs=1e-8)
        # And the doubled orbits double again: periods 2 and 4 are there.
        assert set(data["period"].values) >= {1, 2, 4}

    def test_the_antisymmetric_orbit_is_unstable_from_breaking_to_breaking(self):
        data = diagram("B3-10mm-A3")
        first, last = values(data, "symmetry breaking")[[0, -1]]
        own = data["antisymmetric"].values & (data["stable"].values >= 0)
        frequency = data["frequency"].values
        inside = own & (frequency > first + 1e-9) & (frequency < last - 1e-9)
        assert inside.sum() > 3
        assert not data["stable"].values[inside].any()
        for lower, upper in ((0.9, first), (last, 1.5)):
            outside = own & (frequency > lower) & (frequency < upper - 1e-9) & (frequency != first)
            outside &= (frequency < first - 1e-9) | (frequency > last + 1e-9)
            assert data["stable"].values[outside].all()

    def test_no_gap_no_bifurcation(self):
        data = diagram("B3-0mm-A3", 0.3, 10.0)
        assert data.sizes["bifurcation"] == 0
        assert (data["stable"] == 1).all()
        assert len(np.unique(data["branch"])) == 1

    @pytest.mark.parametrize("code", ["B2-G1-A3", "B2-G2-A2"])
    def test_three_orbits_in_the_hysteresis(self, code):
        data = diagram(code, 0.8, 4.0)
        frequency = data["frequency"].values
        low, high = values(data, "fold")[-2:]
        middle = 0.5 * (low + high)
        crossings = np.flatnonzero((frequency[:-1] - middle) * (frequency[1:] - middle) < 0.0)
        assert sorted(int(data["stable"][i]) for i in crossings) == [0, 1, 1]
        saddle = next(i for i in crossings if not int(data["stable"][i]))
        multipliers = data["multiplier_real"].values[saddle]
        assert multipliers[0] > 1.0 > multipliers[1] > 0.0

    @pytest.mark.parametrize("code", ["B2-G1-A3", "B2-G2-A2"])
    def test_jumps_of_a_fine_sweep_bracket_the_folds(self, code):
        case = vi.laboratory.case(code)
        data = diagram(code, 0.8, 4.0)
        limits = np.concatenate([values(data, "fold"), values(data, "grazing")])
        found = features(vi.sweep(case.oscillator, case.amplitude, np.arange(800, 4001, 4) / 1000))
        assert len(found.jumps) >= 2
        for jump in found.jumps:
            lower, upper = sorted([jump.before, jump.after])
            assert any(lower - 1e-9 <= value <= upper + 1e-9 for value in limits)


def test_every_point_is_an_orbit():
    """Simulated from its section for a period it comes back, stable or not."""
    case = vi.laboratory.case("B3-10mm-A3")
    data = diagram("B3-10mm-A3")
    for i in np.linspace(0, data.sizes["point"] - 1, 40).astype(int):
        state = data["section"].isel(point=i)
        shaken = vi.Harmonic(case.amplitude, float(data["frequency"][i]))
        period = int(data["period"][i])
        moved = vi.simulate(case.oscillator, shaken, period, state, 0)["final_state"]
        growth = max(
            1.0,
            float(
                np.hypot(
                    *data.isel(point=i)[["multiplier_real", "multiplier_imag"]].to_array().values
                ).max()
            ),
        )
        np.testing.assert_allclose(moved[:2], state[:2], rtol=0, atol=1e-11 * growth)


def test_steps_are_small_and_stability_changes_at_bifurcations_only():
    data = diagram("B3-10mm-A3")
    stable, piece, branch = (data[name].values for name in ("stable", "piece", "branch"))
    within = (branch[:-1] == branch[1:]) & (piece[:-1] == piece[1:])
    both = within & (stable[:-1] >= 0) & (stable[1:] >= 0)
    assert (stable[:-1][both] == stable[1:][both]).all()
    jump = np.abs(np.diff(data["displacement_excursion"].values))[within]
    assert jump.max() < 0.1 * float(data["displacement_excursion"].max())


def test_the_section_does_not_matter():
    """Bifurcations are where they are, whatever the phase at which the motion is looked at."""
    reference = diagram("B2-G1-A3")
    for phase in (1.0, 2.7):
        data = diagram("B2-G1-A3", phase=phase)
        for kind in ("fold", "grazing"):
            np.testing.assert_allclose(
                values(data, kind), values(reference, kind), rtol=0, atol=1e-9
            )


def test_grazing_of_a_damped_bumper_in_closed_form():
    """Where free flight reaches the gap."""
    case = vi.laboratory.case("B2-G1-A3")
    rig = case.oscillator
    data = diagram("B2-G1-A3", 0.8, 4.0)
    omega = 2 * np.pi * values(data, "grazing")[-1]
    k, c = rig.isolator.stiffness / rig.mass, rig.isolator.damping / rig.mass
    swing = case.amplitude / np.hypot(k - omega**2, c * omega)
    assert swing == pytest.approx(rig.right.gap, rel=1e-11)


@pytest.mark.parametrize("parameter", ["gap", "amplitude", "bumper_stiffness", "stiffness_ratio"])
def test_other_parameters(parameter):
    """Each orbit belongs to the rig that the parameter says."""
    case = vi.laboratory.case("B2-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 2.0)
    ranges = {
        "gap": (1e-3, 15e-3),
        "amplitude": (0.1, 1.0),
        "bumper_stiffness": (1e5, 1e6),
        "stiffness_ratio": (1.0, 50.0),
    }
    low, high = ranges[parameter]
    data = vi.branch(case.oscillator, shaken, parameter=parameter, low=low, high=high)
    assert data.attrs["parameter"] == parameter
    for i in np.linspace(0, data.sizes["point"] - 1, 8).astype(int):
        value = float(data[parameter][i])
        rig, excitation = case.oscillator, shaken
        if parameter == "amplitude":
            excitation = shaken.replace(amplitude=value)
        elif parameter == "gap":
            rig = rig.replace(right=rig.right.replace(gap=value), left=rig.left.replace(gap=value))
        else:
            stiffness = value if parameter == "bumper_stiffness" else value * rig.isolator.stiffness
            damping = rig.right.damping
            if parameter == "stiffness_ratio":  # the relaxation time is kept
                damping *= stiffness / rig.right.stiffness
            bumper = rig.right.replace(stiffness=stiffness, damping=damping)
            rig = rig.replace(right=bumper, left=bumper)
        state = data["section"].isel(point=i)
        moved = vi.simulate(rig, excitation, 1, state, 0)["final_state"]
        np.testing.assert_allclose(moved[:2], state[:2], rtol=0, atol=1e-9)


def test_a_closed_branch_ends_where_it_began():
    case = vi.laboratory.case("B3-10mm-A3")
    data = vi.branch(case.oscillator, vi.Harmonic(case.amplitude, 1.2), low=0.5, high=2.0)
    assert data.attrs["closed"] == 1
    assert float(data["eccentricity"].max()) > 5e-4
    assert float(data["eccentricity"].min()) < -5e-4


def test_ends_are_told():
    case = vi.laboratory.case("B2-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 2.0)
    data = vi.branch(case.oscillator, shaken, low=1.9, high=2.2, most_points=500)
    assert "range ends at 1.9" in data.attrs["ended_low"] + data.attrs["ended_high"]
    assert float(data["frequency"].min()) == 1.9
    short = vi.branch(case.oscillator, shaken, low=0.3, high=5.0, most_points=4)
    assert "4 points" in short.attrs["ended_low"]


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"parameter": "mass"}, "parameter: 'mass'"),
        ({"low": 3.0}, "leaves out|does not lie"),
        ({"low": 2.5, "high": 2.4}, "does not lie above"),
        ({"low": "1 mm"}, "low"),
        ({"period": 0}, "period"),
        ({"most_points": 1.5}, "most_points"),
        ({"parameter": "right_gap", "low": 0.0, "high": 1e-3}, "leaves out"),
    ],
)
def test_refused(wrong, told):
    case = vi.laboratory.case("B2-G1-A3")
    with pytest.raises(vi.InputError, match=told):
        vi.branch(
            case.oscillator,
            vi.Harmonic(case.amplitude, 2.0),
            **{"low": 0.3, "high": 4.0, **wrong},
        )


def test_a_parameter_that_the_bumpers_do_not_share():
    case = vi.laboratory.case("B2-G1-A3")
    rig = case.oscillator.replace(left=case.oscillator.left.replace(gap=6e-3))
    with pytest.raises(vi.InputError, match="'right_gap' and 'left_gap'"):
        vi.branch(rig, vi.Harmonic(0.5, 2.0), parameter="gap", low=1e-3, high=1e-2)
    data = vi.branch(rig, vi.Harmonic(0.5, 2.0), parameter="left_gap", low=1e-3, high=1e-2)
    assert data.sizes["point"] > 5


def remembering() -> vi.Oscillator:
    """Bumpers that relax more slowly than they are struck."""
    bumper = vi.Bumper(0.01, 0.2, 0.6)
    return vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), bumper, bumper)


@pytest.mark.parametrize("phase", [0.0, 2.0])
def test_neimark_sacker_with_a_long_memory(phase):
    """There a pair can cross the unit circle, and beyond it the motion is quasi-periodic."""
    turn = 2 * np.pi
    data = vi.resonance_diagram(remembering(), 1.0, 1.0 / turn, 1.8 / turn, phase=phase)
    (value,) = values(data, "Neimark-Sacker")
    row = int(np.flatnonzero(data["bifurcation_kind"].values == "Neimark-Sacker")[0])
    pair = data.isel(bifurcation=row)
    modulus = np.hypot(*(pair[f"bifurcation_multiplier_{part}"][0] for part in ("real", "imag")))
    assert float(modulus) == pytest.approx(1.0, abs=1e-9)
    assert abs(float(pair["bifurcation_multiplier_imag"][0])) > 0.1
    beside = [vi.steady(remembering(), vi.Harmonic(1.0, value * f)) for f in (0.98, 1.02)]
    assert [m["motion"].item() for m in beside] == ["periodic", "quasi-periodic"]


def test_grazings_tell_the_contacts_on_both_sides():
    data = diagram("B2-G1-A3", 0.8, 4.0)
    (row,) = np.flatnonzero(data["bifurcation_kind"].values == "grazing")
    told = data["bifurcation_contacts"].values[row]
    assert sorted(told.split(" | ")) == ["0R 0L", "1R 1L"]


def between_stops(damping: float) -> vi.Oscillator:
    stop = vi.Bumper(10.0, damping, 1.0)
    return vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), stop, stop)


@pytest.mark.parametrize("phase", [0.0, 0.7, 3.0])
def test_an_event_on_the_section_does_not_end_a_branch(phase):
    """With a dashpot the acceleration jumps at contact, and the section's state has a corner."""
    turn = 2 * np.pi
    data = vi.branch(
        between_stops(3.0), vi.Harmonic(0.2, 2.0 / turn, phase), low=0.3 / turn, high=2.5 / turn
    )
    assert float(data["frequency"].min()) == pytest.approx(0.3 / turn)
    assert float(data["frequency"].max()) == pytest.approx(2.5 / turn)
    (fold,) = values(data, "fold")
    assert fold * turn == pytest.approx(1.15226, abs=1e-4)
    # Free flight grazes where it reaches the stops.
    squares = np.sort(np.roots([1.0, -(2.0 - 4.0 * 0.05**2), 1.0 - 0.2**2]).real)
    np.testing.assert_allclose(values(data, "grazing") * turn, np.sqrt(squares), rtol=1e-11)


@pytest.mark.parametrize("phase", [0.0, 1.3])
def test_along_the_gap_through_the_grazing(phase):
    """The derivative with respect to the gap jumps there: one side's must be used."""
    turn = 2 * np.pi
    data = vi.branch(
        between_stops(0.5),
        vi.Harmonic(0.2, 1.2 / turn, phase),
        parameter="gap",
        low=0.01,
        high=2.0,
    )
    assert float(data["gap"].min()) == pytest.approx(0.01)
    assert float(data["gap"].max()) == pytest.approx(2.0)
    # At Ω = 1.2 free flight has the amplitude at which it grazes.
    swing = 0.2 / np.hypot(1.0 - 1.2**2, 0.1 * 1.2)
    assert values(data, "grazing")[0] == pytest.approx(swing, rel=1e-11)


def test_no_step_lands_on_another_branch():
    case = vi.laboratory.case("B2-G1-A3")
    data = vi.branch(
        case.oscillator, vi.Harmonic(case.amplitude, 2.0), parameter="gap", low=1e-4, high=2e-2
    )
    assert float(data["gap"].min()) == pytest.approx(1e-4)
    assert float(data["gap"].max()) == pytest.approx(2e-2)
    kinds = list(data["bifurcation_kind"].values)
    assert kinds.count("symmetry breaking") == 2
    assert kinds.count("fold") == 2
    jump = np.abs(np.diff(data["gap"].values))
    assert jump.max() < 0.11 * 2e-2


@pytest.mark.parametrize("phase", [1.5, 2.2])
def test_grazing_of_a_heavy_dashpot(phase):
    """Where Newton's method itself chooses between the sides of a sharp corner."""
    turn = 2 * np.pi
    data = vi.branch(
        between_stops(10.0), vi.Harmonic(0.2, 2.0 / turn, phase), low=0.8 / turn, high=2.5 / turn
    )
    squares = np.sort(np.roots([1.0, -(2.0 - 4.0 * 0.05**2), 1.0 - 0.2**2]).real)
    np.testing.assert_allclose(values(data, "grazing") * turn, np.sqrt(squares), rtol=5e-12)


def test_a_fold_beside_a_period_doubling_is_a_fold():
    data = diagram("B3-10mm-A3")
    kinds, periods = data["bifurcation_kind"].values, data["bifurcation_period"].values
    folds = data["bifurcation_value"].values[(kinds == "fold") & (periods == 4)]
    assert np.abs(folds - 1.1050054621).min() < 1e-8
    assert np.abs(folds - 1.0082179154).min() < 1e-8


def test_an_orbit_has_its_least_period():
    case = vi.laboratory.case("B2-G1-A3")
    data = vi.branch(case.oscillator, vi.Harmonic(case.amplitude, 2.0), low=1.9, high=2.1, period=3)
    assert set(data["period"].values) == {1}


def test_a_closed_branch_of_a_longer_period_is_gone_round_once():
    """After a round it may meet another of the sections of its first orbit."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.04), vi.Bumper(20.0, 0.0, 0.63))
    data = vi.branch(
        rig,
        vi.Harmonic(0.5, 0.091918874526),
        vi.State(0.342505143, -0.804559204),
        low="0.5 rad/s",
        high="2 rad/s",
        period=4,
    )
    assert data.attrs["closed"] == 1
    assert data.sizes["point"] < 200
    found = data["bifurcation_value"].values
    assert len(found) == len(np.unique(np.round(found, 9))) == 8


def test_each_orbit_of_a_doubled_period_is_listed_once():
    """Beyond the doubling in which it is born a branch would show its orbits again."""
    data = diagram("B4-10mm-A3", 0.4)
    branches, counts = np.unique(data["branch"], return_counts=True)
    assert len(branches) < 10
    assert counts.max() < 1000
    ended = [data.attrs[f"branch_{i}_ended_{end}"] for i in branches for end in ("low", "high")]
    lost = [reason for reason in ended if "no orbit could be found" in reason]
    assert len(lost) <= 1
    assert all("all but grazes" in reason for reason in lost)
    doubled = [i for i in branches if int(data["period"][data["branch"].values == i][0]) == 2]
    for i in doubled:
        mine = data["bifurcation_branch"].values == i
        own = data["bifurcation_value"].values[mine]
        assert len(own) == len(np.unique(np.round(own, 7)))
        for end in ("low", "high"):
            assert "it is born at 1." in data.attrs[f"branch_{i}_ended_{end}"]


@pytest.mark.parametrize("left", [True, False])
def test_no_pair_passes_the_circle_at_no_damping(left):
    """There all multipliers of elastic bumpers lie on it, to rounding."""
    stop = vi.Bumper(10.0, 0.0, 1.0)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), stop, stop if left else None)
    shaken = vi.Harmonic(0.3, 1.3 / (2 * np.pi))
    data = vi.branch(rig, shaken, parameter="damping", low=0.0, high=0.5)
    assert float(data["damping"].min()) == 0.0
    assert len(values(data, "Neimark-Sacker")) == 0


def test_from_no_dashpot_and_to_none():
    """The rate at which a bumper relaxes is infinite there."""
    turn = 2 * np.pi
    shaken = vi.Harmonic(0.2, 1.2 / turn)
    ends = []
    for damping in (0.0, 1.0):
        data = vi.branch(
            between_stops(damping), shaken, parameter="bumper_damping", low=0.0, high=2.0
        )
        ends.append(data.isel(point=int(data["bumper_damping"].values.argmin())))
        ends.append(data.isel(point=int(data["bumper_damping"].values.argmax())))
    for one, other in ((ends[0], ends[2]), (ends[1], ends[3])):
        assert float(one["bumper_damping"]) == float(other["bumper_damping"])
        np.testing.assert_allclose(one["section"], other["section"], atol=1e-12)


def test_an_orbit_without_extremes_is_told(monkeypatch):
    case = vi.laboratory.case("B2-G1-A3")
    monkeypatch.setattr("vibroimpact.stability.labelled.MAX_EVENTS", 1)
    with pytest.warns(RuntimeWarning, match="the orbit at .* has no extremes: .*max_events"):
        data = vi.branch(case.oscillator, vi.Harmonic(case.amplitude, 2.0), low=1.95, high=2.05)
    assert data["eta_d"].isnull().any()
