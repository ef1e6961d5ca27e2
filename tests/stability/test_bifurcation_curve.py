"""Curves of bifurcations over two parameters."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample


@cache
def case():
    return vi.laboratory.case("B2-G1-A3")


@cache
def diagram():
    return vi.resonance_diagram(
        vi.Rig(case().oscillator, case().amplitude), {"frequency": (0.8, 4.0)}
    )


def one(kind: str, number: int = -1):
    rows = np.flatnonzero(diagram()["bifurcation_kind"].values == kind)
    order = np.argsort(diagram()["bifurcation_value"].values[rows])
    return diagram().isel(bifurcation=int(rows[order[number]]))


@cache
def curve(kind: str, other: str, low: float, high: float, number: int = -1):
    return vi.bifurcation_curve(
        vi.Rig(case().oscillator, vi.Harmonic(case().amplitude, 2.0)),
        one(kind, number),
        vary={"frequency": (0.3, 6.0), other: (low, high)},
    )


def test_grazing_of_free_flight_in_closed_form():
    data = curve("grazing", "gap", 1e-3, 20e-3)
    rig = case().oscillator
    omega = 2 * np.pi * data["frequency"].values
    k, c = rig.isolator.stiffness / rig.mass, rig.isolator.damping / rig.mass
    swing = case().amplitude / np.hypot(k - omega**2, c * omega)
    np.testing.assert_allclose(data["gap"], swing, rtol=1e-9)
    assert data["gap"].values.min() == pytest.approx(1e-3)
    assert data["gap"].values.max() == pytest.approx(20e-3)


def test_folds_are_those_of_the_branches_beside_it():
    data = curve("fold", "gap", 4e-3, 12e-3)
    for gap in (6e-3, 9e-3):
        rig = case().oscillator
        rig = rig.replace(right=rig.right.replace(gap=gap), left=rig.left.replace(gap=gap))
        beside = vi.resonance_diagram(vi.Rig(rig, case().amplitude), {"frequency": (1.0, 5.0)})
        folds = beside["bifurcation_value"].values[beside["bifurcation_kind"].values == "fold"]
        order = np.argsort(data["gap"].values)
        here = np.interp(gap, data["gap"].values[order], data["frequency"].values[order])
        assert np.abs(folds - here).min() < 2e-3  # between two points of the curve


def test_both_folds_meet_in_a_cusp():
    """The border between rigs with and without a jump, the same from either fold."""
    cusps = []
    for number in (-1, -2):
        data = curve("fold", "stiffness_ratio", 0.5, 60.0, number)
        assert data.sizes["cusp_number"] == 1
        cusps.append((float(data["cusp_first"][0]), float(data["cusp_second"][0])))
        # Round the cusp and back to the range's end on both sides.
        assert "stiffness_ratio ends at 60" in data.attrs["ended_low"]
        assert "stiffness_ratio ends at 60" in data.attrs["ended_high"]
    np.testing.assert_allclose(cusps[0], cusps[1], rtol=1e-6)
    ratio = cusps[0][1]
    counts = []
    for factor in (0.97, 1.03):
        rig = case().oscillator
        stiffness = factor * ratio * rig.isolator.stiffness
        bumper = rig.right.replace(
            stiffness=stiffness, damping=rig.right.damping * stiffness / rig.right.stiffness
        )
        rig = rig.replace(right=bumper, left=bumper)
        branches = vi.resonance_diagram(vi.Rig(rig, case().amplitude), {"frequency": (1.2, 3.0)})
        counts.append(int((branches["bifurcation_kind"] == "fold").sum()))
    assert counts == [0, 2]


def test_multipliers_stay_critical():
    data = curve("fold", "gap", 4e-3, 12e-3)
    distance = np.abs(data["multiplier_real"].values - 1.0).min(axis=1)
    assert distance.max() < 1e-5


def test_the_parameter_of_the_start_is_the_first_whatever_the_order():
    rig = vi.Rig(case().oscillator, vi.Harmonic(case().amplitude, 2.0))
    both = {"gap": (7e-3, 8e-3), "frequency": (0.3, 6.0)}
    one_way, other = (
        vi.bifurcation_curve(rig, one("fold"), vary=vary)
        for vary in (both, dict(reversed(both.items())))
    )
    assert one_way.attrs["parameter"] == "frequency"
    assert one_way.attrs["other_parameter"] == "gap"
    assert one_way.identical(other)


def test_symmetry_breaking_and_period_doubling():
    rig = vi.laboratory.case("B3-10mm-A3")
    branches = vi.resonance_diagram(
        vi.Rig(rig.oscillator, rig.amplitude), {"frequency": (0.9, 1.4)}
    )
    for kind, critical in (("symmetry breaking", 1.0), ("period doubling", -1.0)):
        row = int(np.flatnonzero(branches["bifurcation_kind"].values == kind)[0])
        data = vi.bifurcation_curve(
            vi.Rig(rig.oscillator, vi.Harmonic(rig.amplitude, 1.2)),
            branches.isel(bifurcation=row),
            vary={"frequency": (0.5, 2.0), "amplitude": (0.47, 0.51)},
        )
        assert data.sizes["point"] > 3
        distance = np.abs(data["multiplier_real"].values - critical).min(axis=1)
        assert distance.max() < 1e-4


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"vary": {"frequency": (0.3, 6.0)}}, r"^vary: 'frequency'; .*, with two parameters, such"),
        (
            {"vary": {"gap": (1e-3, 2e-2), "stops.gap": (1e-3, 2e-2)}},
            r"^vary: 'gap' and 'stops\.gap' are the same parameter",
        ),
        (
            {"vary": {"gap": (1e-3, 2e-2), "amplitude": (0.3, 0.6)}},
            "^vary: neither 'gap' nor 'amplitude' is .*; pass 'frequency' and another one",
        ),
        (
            {"vary": {"frequency": (0.3, 6.0), "mass": (500, 600)}},
            "^vary: no curve can be followed along 'mass'",
        ),
        (
            {"vary": {"frequency": (0.3, 6.0), "gap": (1.0, 2e-2)}},
            r"^vary\['gap'\]: the first value, 1 m, is not below the second, 20 mm",
        ),
        (
            {"vary": {"frequency": (0.3, 6.0), "gap": (1e-2, 2e-2)}},
            r"^vary\['gap'\]: 10 mm to 20 mm does not contain the rig's gap of 7\.5 mm; widen",
        ),
        (
            {"vary": {"frequency": (0.3, 6.0), "gap_ratio": (0.4, 0.5)}},
            r"^vary\['gap_ratio'\]: 0\.4 to 0\.5 does not contain",
        ),
        ({"start": None}, "start"),
    ],
)
def test_refused(wrong, message):
    arguments = {
        "start": one("fold"),
        "vary": {"frequency": (0.3, 6.0), "gap": (1e-3, 2e-2)},
        **wrong,
    }
    with pytest.raises(vi.InputError, match=message):
        vi.bifurcation_curve(vi.Rig(case().oscillator, vi.Harmonic(0.5, 2.0)), **arguments)


def test_no_symmetry_breaking_without_symmetry():
    case = vi.laboratory.case("B3-10mm-A3")
    branches = vi.resonance_diagram(
        vi.Rig(case.oscillator, case.amplitude), {"frequency": (0.9, 1.4)}
    )
    row = int(np.flatnonzero(branches["bifurcation_kind"].values == "symmetry breaking")[0])
    with pytest.raises(vi.InputError, match=r"^vary: 'stops\.right\.gap' makes the rig asymmetric"):
        vi.bifurcation_curve(
            vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.2)),
            branches.isel(bifurcation=row),
            vary={"frequency": (0.5, 2.0), "stops.right.gap": (1e-3, 2e-2)},
        )


def test_neimark_sacker():
    bumper = vi.Bumper(0.01, 0.2, 0.6)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), bumper, bumper)
    turn = 2 * np.pi
    branches = vi.resonance_diagram(vi.Rig(rig, 1.0), {"frequency": (1.0 / turn, 1.5 / turn)})
    row = int(np.flatnonzero(branches["bifurcation_kind"].values == "Neimark-Sacker")[0])
    seen = []
    data = vi.bifurcation_curve(
        vi.Rig(rig, vi.Harmonic(1.0, 1.2 / turn)),
        branches.isel(bifurcation=row),
        vary={"frequency": (0.5 / turn, 2.0 / turn), "gap": (0.4, 0.9)},
        progress=lambda *at: seen.append(at),
    )
    modulus = np.hypot(data["multiplier_real"], data["multiplier_imag"]).values[:, 0]
    np.testing.assert_allclose(modulus, 1.0, atol=1e-9)
    assert len(seen) > 5


@pytest.mark.parametrize("side", ["right", "left"])
def test_grazing_of_one_bumper(side):
    """Free flight reaches one bumper only: its amplitude is that side's gap."""
    rig = case().oscillator
    far = rig.right.replace(gap=1.0)
    rig = rig.replace(**{"left" if side == "right" else "right": far})
    branches = vi.resonance_diagram(vi.Rig(rig, case().amplitude), {"frequency": (1.2, 3.0)})
    row = int(np.flatnonzero(branches["bifurcation_kind"].values == "grazing")[-1])
    data = vi.bifurcation_curve(
        vi.Rig(rig, vi.Harmonic(case().amplitude, 2.0)),
        branches.isel(bifurcation=row),
        vary={"frequency": (0.5, 5.0), f"{side}.gap": (4e-3, 12e-3)},
    )
    omega = 2 * np.pi * data["frequency"].values
    k, c = rig.isolator.stiffness / rig.mass, rig.isolator.damping / rig.mass
    swing = case().amplitude / np.hypot(k - omega**2, c * omega)
    np.testing.assert_allclose(data[f"stops.{side}.gap"], swing, rtol=1e-9)


ANOTHER = vi.RigidStop(0.6, 0.025)
OVER = [
    (None, "gap", 5e-3, 40e-3),
    (ANOTHER, "amplitude", 0.2, 1.0),
    (ANOTHER, "gap", 5e-3, 40e-3),
    (None, "amplitude", 0.2, 1.0),
]


@pytest.mark.parametrize(("left", "other", "low", "high"), sample(OVER, OVER[:1]))
def test_grazing_of_rigid_stops_in_closed_form(left, other, low, high):
    """Behind it the map is a square root, and Newton's method goes to and fro."""
    rig = vi.Oscillator(550.0, vi.Isolator(26.8e3, 1.1e3), vi.RigidStop(0.6, 0.025), left)
    shaken = vi.Harmonic("0.05 g", 3.0)
    whole = vi.Rig(rig, shaken)
    branch = vi.branch(whole, vary={"frequency": (0.6, 3.0)})
    i = int(np.flatnonzero(branch["bifurcation_kind"].values == "grazing")[0])
    data = vi.bifurcation_curve(
        whole, branch.isel(bifurcation=i), vary={"frequency": (0.3, 6.0), other: (low, high)}
    )
    assert data.sizes["point"] < 300
    for end in ("ended_low", "ended_high"):
        assert data.attrs[end].startswith("the range of")
    omega = 2 * np.pi * data["frequency"].values
    size = data[other].values if other == "amplitude" else shaken.amplitude
    gap = data[other].values if other == "gap" else 0.025
    swing = size / np.hypot(26.8e3 / 550.0 - omega**2, 2.0 * omega)
    # A curve is exact to a share of the sizes at its start.
    np.testing.assert_allclose(swing, gap * np.ones_like(omega), rtol=0.0, atol=1e-8 * 0.025)
