"""Branches: orbits all along, bifurcations where they must be, ends that are told."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from stability.followed import diagram, near, values
from vibroimpact.response.resonance import features


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
        curve_features = features(
            vi.sweep(vi.Rig(case.oscillator, case.amplitude), np.arange(800, 4001, 4) / 1000)
        )
        assert len(curve_features.jumps) >= 2
        for jump in curve_features.jumps:
            lower, upper = sorted([jump.before, jump.after])
            assert any(lower - 1e-9 <= value <= upper + 1e-9 for value in limits)


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


def test_ends_are_told():
    case = vi.laboratory.case("B2-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 2.0)
    data = vi.branch(
        vi.Rig(case.oscillator, shaken), vary={"frequency": (1.9, 2.2)}, most_points=500
    )
    assert "range ends at 1.9" in data.attrs["ended_low"] + data.attrs["ended_high"]
    assert float(data["frequency"].min()) == 1.9
    short = vi.branch(
        vi.Rig(case.oscillator, shaken), vary={"frequency": (0.3, 5.0)}, most_points=4
    )
    assert "4 points" in short.attrs["ended_low"]


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"vary": {"colour": (1.0, 2.0)}}, "^vary: 'colour' is unknown"),
        (
            {"vary": {"frequency": (3.0, 4.0)}},
            r"^vary\['frequency'\]: 3 Hz to 4 Hz does not contain the rig's frequency of 2 Hz, at "
            "which the first orbit lies; widen this range",
        ),
        ({"period": 0}, "period"),
        ({"most_points": 1.5}, "most_points"),
        ({"vary": {"right.gap": (0.0, 1e-3)}}, r"^vary\['right\.gap'\]: .* does not contain"),
    ],
)
def test_refused(wrong, message):
    case = vi.laboratory.case("B2-G1-A3")
    with pytest.raises(vi.InputError, match=message):
        vi.branch(
            vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 2.0)),
            **{"vary": {"frequency": (0.3, 4.0)}, **wrong},
        )


def test_a_parameter_that_the_bumpers_do_not_share():
    case = vi.laboratory.case("B2-G1-A3")
    rig = case.oscillator.replace(left=case.oscillator.left.replace(gap=6e-3))
    with pytest.raises(vi.InputError, match=r"'right\.gap' or 'left\.gap'"):
        vi.branch(vi.Rig(rig, vi.Harmonic(0.5, 2.0)), vary={"gap": (1e-3, 1e-2)})
    data = vi.branch(vi.Rig(rig, vi.Harmonic(0.5, 2.0)), vary={"stops.left.gap": (1e-3, 1e-2)})
    assert data.sizes["point"] > 5


@pytest.mark.parametrize(
    ("amplitude", "low", "high", "units"),
    [("2 mm", "1 mm", "3 mm", "m"), ("100 N", "50 N", "150 N", "N")],
)
def test_an_amplitude_is_followed_in_its_own_unit(amplitude, low, high, units) -> None:
    """Of a linear rig the excursion is proportional to it; the gap over free flight the inverse."""
    rig = vi.laboratory.case("B2-Ginf-A3").oscillator
    shaken = vi.Harmonic(amplitude, "2 Hz")
    data = vi.branch(vi.Rig(rig, shaken), vary={"amplitude": (low, high)})
    assert data["amplitude"].attrs["units"] == units
    ratio = data["displacement_excursion"].values / data["amplitude"].values
    np.testing.assert_allclose(ratio, ratio[0], rtol=1e-10)
