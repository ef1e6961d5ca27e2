"""Resonance diagrams: all branches, over any parameter, isolated ones among them, each once."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi

STOP = vi.Bumper(10.0, 0.1, 1.0)
ONE_STOP = vi.Oscillator(1.0, vi.Isolator(1.0, 0.05), STOP, None)
HARD = vi.Bumper(40.0, 0.4, 1.0)
TWO_STOPS = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), HARD, HARD)


def hertz(omega: float) -> float:
    return omega / (2.0 * np.pi)


def test_one_branch_has_the_attributes_of_any():
    case = vi.laboratory.case("B3-0mm-A3")
    data = vi.resonance_diagram(vi.Rig(case.oscillator, case.amplitude), {"frequency": (3.0, 4.0)})
    assert set(data["branch"].values) == {0}
    assert data.attrs["branch_0_closed"] == 0
    assert {data.attrs[f"branch_0_ended_{end}"] for end in ("low", "high")} == {
        "the range ends at 3 Hz",
        "the range ends at 4 Hz",
    }


@cache
def isolated() -> xr.Dataset:
    return vi.resonance_diagram(vi.Rig(TWO_STOPS, 2.0), {"frequency": (hertz(1.5), hertz(8.0))})


def test_isolated_branches_are_found_once():
    """Symmetric subharmonics of period 3 lie on a closed branch, which nothing else leads to."""
    data = isolated()
    first = [int(np.flatnonzero(data["branch"] == b)[0]) for b in np.unique(data["branch"])]
    kinds = [(int(data["period"][k]), bool(data["antisymmetric"][k])) for k in first]
    assert kinds == [(1, True), (3, True), (3, False)]
    assert [data.attrs[f"branch_{b}_closed"] for b in range(3)] == [0, 1, 1]
    alone = vi.resonance_diagram(
        vi.Rig(TWO_STOPS, 2.0), {"frequency": (hertz(1.5), hertz(8.0))}, random=0
    )
    assert int(alone["branch"].max()) == 0
    xr.testing.assert_equal(
        isolated(),
        vi.resonance_diagram(vi.Rig(TWO_STOPS, 2.0), {"frequency": (hertz(1.5), hertz(8.0))}),
    )


def test_basins_lead_to_a_branch_that_random_starts_miss():
    """A small isola of period 5, to which 1 state in 100 leads, within 3 % of the frequency."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.059), HARD, None)
    asked = {"rig": vi.Rig(rig, 2.0), "vary": {"frequency": (hertz(4.0), hertz(8.0))}}
    missed = vi.resonance_diagram(**asked, longest=5, random=40)
    assert not (missed["period"] == 5).any()
    basins = vi.basins(vi.Rig(rig, vi.Harmonic(2.0, hertz(6.0))), nodes=40)
    assert float(basins["share"].min()) < 0.01
    data = vi.resonance_diagram(**asked, longest=5, basins=basins)
    isola = data["period"].values == 5
    (number,) = np.unique(data["branch"].values[isola])
    assert data.attrs[f"branch_{number}_closed"] == 1
    ends = data["frequency"].values[isola]
    assert hertz(5.8) < ends.min() < hertz(5.9)
    assert hertz(6.0) < ends.max() < hertz(6.1)
    assert data["stable"].values[isola].any()
    # The rest is what it is without.
    assert int(data["branch"].max()) == int(missed["branch"].max()) + 1


def test_basins_of_a_rig_whose_bumpers_remember():
    slow = vi.Bumper(40.0, 20.0, 1.0)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), slow, None)
    shaking = vi.Harmonic(2.0, hertz(2.0))
    basins = vi.basins(vi.Rig(rig, shaking), nodes=5)
    over = {"random": 0, "starts": 2}
    data = vi.resonance_diagram(vi.Rig(rig, shaking), {"gap": (0.8, 1.2)}, **over, basins=[basins])
    assert int(data["branch"].max()) == 0


def excursions(data: xr.Dataset, value: float) -> list[float]:
    """Of all orbits at a value of the parameter, from a straight line through their neighbours."""
    x, y = data[data.attrs["parameter"]].values, data["displacement_excursion"].values
    same = (data["branch"].values[1:] == data["branch"].values[:-1]) & (
        data["period"].values[1:] == data["period"].values[:-1]
    )
    at = np.flatnonzero(same & ((x[1:] - value) * (x[:-1] - value) < 0.0))
    share = (value - x[at]) / (x[at + 1] - x[at])
    return sorted(y[at] + share * (y[at + 1] - y[at]))


def test_two_parameters_meet_in_the_same_orbits():
    """Where a diagram over the frequency and one over the gap cross, orbits are the same."""
    shaking = vi.Harmonic(2.0, hertz(4.6))
    over_gap = vi.resonance_diagram(vi.Rig(TWO_STOPS, shaking), {"gap": (0.9, 3.0)})
    one, other = excursions(isolated(), hertz(4.6)), excursions(over_gap, 1.0)
    # Free flight, and the stable and the unstable orbit of period 3.
    assert len(one) == len(other) == 3
    np.testing.assert_allclose(one, other, rtol=1e-2)


@pytest.mark.parametrize(
    ("parameter", "low", "high"),
    [("amplitude", 1.0, 4.0), ("stops.stiffness", 2.0, 50.0), ("damping_ratio", 0.01, 0.2)],
)
def test_what_settles_lies_on_a_branch(parameter, low, high):
    """Each motion of a bifurcation diagram of period 1 to 4 is near an orbit of its period."""
    shaking = vi.Harmonic(2.0, hertz(2.4))
    data = vi.resonance_diagram(vi.Rig(ONE_STOP, shaking), {parameter: (low, high)})
    diagram = vi.bifurcation_diagram(
        vi.Rig(ONE_STOP, shaking), {parameter: (low, high)}, 9, random=2, seed=5
    )
    x, y = data[parameter].values, data["displacement_excursion"].values
    for i, value in enumerate(diagram[parameter].values[1:-1], start=1):
        known = excursions(data, float(value))
        for start in range(diagram.sizes["start"]):
            one = diagram.isel({"start": start, parameter: i})
            if 0 < int(one["period"]) <= 4:
                size = float(one["displacement_excursion"])
                near = np.abs(np.array(known) - size).min(initial=np.inf)
                assert near < 0.02 * size, (value, int(one["period"]), x.shape, y.shape)


def test_the_bifurcations_of_a_branch_are_among_them():
    case = vi.laboratory.case("B3-10mm-A3")
    shaking = vi.Harmonic(case.amplitude, 1.12)
    every = vi.resonance_diagram(case, {"gap": (4.8e-3, 6e-3)}, frequency=1.12, random=0)
    one = vi.branch(vi.Rig(case.oscillator, shaking), vary={"gap": (4.8e-3, 6e-3)})
    for kind in np.unique(one["bifurcation_kind"]):
        mine, theirs = (
            d["bifurcation_value"].values[d["bifurcation_kind"].values == kind]
            for d in (one, every)
        )
        for value in mine:
            assert np.abs(theirs - value).min() < 1e-9


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"vary": {"gap": (1.0, 2.0)}}, "frequency: missing"),
        ({"frequency": 2.0}, "frequency: 2.0, but the frequency is the varied"),
        ({"vary": {"colour": (1.0, 2.0)}, "frequency": 2.0}, "vary: 'colour'"),
        ({"rig": vi.Rig(ONE_STOP, [0.1, 0.2])}, "shaking: a list"),
        ({"random": -1}, "random: -1"),
        ({"starts": 0}, "starts: 0"),
        (
            {"vary": {"frequency": (1.0, 0.5)}},
            r"first value, ω = 6\.28319, is not below .* 3\.14159",
        ),
    ],
)
def test_refused(wrong, message):
    arguments = {"rig": vi.Rig(ONE_STOP, 1.0), "vary": {"frequency": (1.0, 2.0)}}
    with pytest.raises(vi.InputError, match=message):
        vi.resonance_diagram(**{**arguments, **wrong})


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        (
            {"vary": {"frequency": (1.0, 2.0)}},
            r"basins\[0\]: these basins were computed at frequency ω = 1.88496, outside",
        ),
        (
            {"rig": vi.Rig(ONE_STOP, 1.5)},
            r"basins\[0\]: these basins were computed for another rig",
        ),
        ({"phase": 1.0}, r"basins\[0\]: these basins were computed for another rig, shaking or"),
        ({"basins": [xr.Dataset()]}, r"basins\[0\]: this is not a result of basins"),
    ],
)
def test_basins_that_are_refused(changed, message):
    basins = vi.basins(vi.Rig(ONE_STOP, vi.Harmonic(1.0, 0.3)), nodes=3)
    arguments = {"rig": vi.Rig(ONE_STOP, 1.0), "vary": {"frequency": (0.2, 0.4)}, "basins": basins}
    with pytest.raises(vi.InputError, match=message):
        vi.resonance_diagram(**{**arguments, **changed}, starts=1)


def test_where_no_orbit_is_found_it_is_an_error():
    stiff = vi.Oscillator(550.0, vi.Isolator(1e30, 1100.0), right=vi.Bumper(5e5, 900.0, 7.5e-3))
    with pytest.raises(
        vi.InputError, match=r"vary\['frequency'\]: no periodic orbit .* between 2 and 2\.1"
    ):
        vi.resonance_diagram(vi.Rig(stiff, 0.5), {"frequency": (2.0, 2.1)})
