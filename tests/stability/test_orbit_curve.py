"""Branches through grazings, sections that move, and back to where they began."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from stability.followed import between_stops, diagram, values


@pytest.mark.parametrize("phase", [0.0, 0.7, 3.0])
def test_an_event_on_the_section_does_not_end_a_branch(phase):
    """With a dashpot the acceleration jumps at contact, and the section's state has a corner."""
    turn = 2 * np.pi
    data = vi.branch(
        vi.Rig(between_stops(3.0), vi.Harmonic(0.2, 2.0 / turn, phase)),
        vary={"frequency": (0.3 / turn, 2.5 / turn)},
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
        vi.Rig(between_stops(0.5), vi.Harmonic(0.2, 1.2 / turn, phase)), vary={"gap": (0.01, 2.0)}
    )
    assert float(data["gap"].min()) == pytest.approx(0.01)
    assert float(data["gap"].max()) == pytest.approx(2.0)
    # At Ω = 1.2 free flight has the amplitude at which it grazes.
    swing = 0.2 / np.hypot(1.0 - 1.2**2, 0.1 * 1.2)
    assert values(data, "grazing")[0] == pytest.approx(swing, rel=1e-11)


def test_no_step_lands_on_another_branch():
    case = vi.laboratory.case("B2-G1-A3")
    data = vi.branch(
        vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 2.0)), vary={"gap": (1e-4, 2e-2)}
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
        vi.Rig(between_stops(10.0), vi.Harmonic(0.2, 2.0 / turn, phase)),
        vary={"frequency": (0.8 / turn, 2.5 / turn)},
    )
    squares = np.sort(np.roots([1.0, -(2.0 - 4.0 * 0.05**2), 1.0 - 0.2**2]).real)
    np.testing.assert_allclose(values(data, "grazing") * turn, np.sqrt(squares), rtol=5e-12)


def test_a_closed_branch_ends_where_it_began():
    case = vi.laboratory.case("B3-10mm-A3")
    data = vi.branch(
        vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.2)), vary={"frequency": (0.5, 2.0)}
    )
    assert data.attrs["closed"] == 1
    assert float(data["eccentricity"].max()) > 5e-4
    assert float(data["eccentricity"].min()) < -5e-4


def test_a_closed_branch_of_a_longer_period_is_gone_round_once():
    """After a round it may meet another of the sections of its first orbit."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.04), vi.Bumper(20.0, 0.0, 0.63))
    data = vi.branch(
        vi.Rig(rig, vi.Harmonic(0.5, 0.091918874526)),
        vi.State(0.342505143, -0.804559204),
        vary={"frequency": ("0.5 rad/s", "2 rad/s")},
        period=4,
    )
    assert data.attrs["closed"] == 1
    assert data.sizes["point"] < 200
    changes = data["bifurcation_value"].values
    assert len(changes) == len(np.unique(np.round(changes, 9))) == 8


def test_each_orbit_of_a_doubled_period_is_listed_once():
    """Beyond the doubling in which it is born a branch would show its orbits again."""
    data = diagram("B4-10mm-A3", 0.4)
    branches, counts = np.unique(data["branch"], return_counts=True)
    assert len(branches) < 10
    assert counts.max() < 1000
    ended = [data.attrs[f"branch_{i}_ended_{end}"] for i in branches for end in ("low", "high")]
    assert not [reason for reason in ended if "no orbit could be found" in reason]
    doubled = [i for i in branches if int(data["period"][data["branch"].values == i][0]) == 2]
    for i in doubled:
        mine = data["bifurcation_branch"].values == i
        own = data["bifurcation_value"].values[mine]
        assert len(own) == len(np.unique(np.round(own, 7)))
        for end in ("low", "high"):
            assert "it meets the orbits of period 1 at 1." in data.attrs[f"branch_{i}_ended_{end}"]


def test_a_branch_may_be_born_in_a_grazing():
    """A multiplier of period 2 jumps past −1 there, and period 4 begins at the corner."""
    data = diagram("B4-10mm-A3", 0.4)
    (four,) = {int(i) for i in data["branch"].values[data["period"].values == 4]}
    low, high = data.attrs[f"branch_{four}_ended_low"], data.attrs[f"branch_{four}_ended_high"]
    assert low == "it meets the orbits of period 2 at 1.10911961 Hz, where they graze"
    assert high == "it meets the orbits of period 2 at 1.22528743 Hz"
    grazing = values(data, "grazing")
    assert np.abs(grazing - 1.109119613).min() < 1e-9
    two = np.flatnonzero(data["period"].values == 2)
    near = two[np.argsort(np.abs(data["frequency"].values[two] - 1.109119613))[:3]]
    leading = data["multiplier_real"].values[near, 0]
    assert leading.max() > -1.0 > leading.min()


@pytest.mark.parametrize(
    ("ratio", "time", "sides"),
    [(1e6, 0.01, 1), (1e6, 0.01, 2), (1e8, 0.01, 1), (1e8, 0.0, 2), (1e8, 1e-6, 2)],
)
def test_through_the_grazings_of_very_stiff_bumpers(ratio, time, sides):
    """The branch that leaves free flight at one end comes back to it at the other."""
    made = vi.from_dimensionless((ratio, ratio if sides == 2 else None), 0.6, time, 0.1)
    rig, amplitude = made.oscillator, made.amplitude
    natural = rig.natural_frequency
    data = vi.branch(
        vi.Rig(rig, vi.Harmonic(amplitude, 0.3 * natural)),
        vary={"frequency": (0.2 * natural, 4.0 * natural)},
    )
    ends = {data.attrs["ended_low"], data.attrs["ended_high"]}
    assert ends == {f"the range ends at ω = {share:.9g}" for share in (0.2, 4.0)}
    # Free flight reaches the gap at two frequencies.
    squares = np.roots([1.0, 4 * 0.1**2 - 2.0, 1.0 - (0.2 * np.sqrt(1 - 0.1**2) / 0.6) ** 2])
    exact = natural * np.sqrt(np.sort(squares.real))
    # From the side of a contact the depth is known to rounding, which is little of a frequency.
    np.testing.assert_allclose(values(data, "grazing")[[0, -1]], exact, rtol=1e-5)
