"""Where a branch turns back: the same whether it is followed into free flight or not."""

from __future__ import annotations

import math

import pytest

import vibroimpact as vi
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.scenarios.sweep_frequencies import highest
from vibroimpact.stability import branch as followed
from vibroimpact.stability.parameter_family import family


# A fold and a grazing, two folds, none; and gaps beside whose branch another one is free flight.
@pytest.mark.parametrize(
    ("ratio", "gaps", "memory", "damping", "count"),
    [
        (36.6, 0.582, 0.011, 0.045, 2),
        (3.6, 0.553, 0.018, 0.091, 2),
        (0.7, 0.982, 0.009, 0.048, 0),
        (25.0, (0.798493865, 0.958846129), 0.0447, 0.1074, 2),
        (41.4, (0.5622301662577399, 0.8667952305368517), 0.0198, 0.0269, 2),
    ],
)
def test_free_flight_need_not_be_followed(ratio, gaps, memory, damping, count, monkeypatch):
    rig = one_sine(vi.from_dimensionless(ratio, gaps, memory, damping), "rig")
    natural = rig.oscillator.natural_frequency
    here = rig.at(0.99 * natural)
    begin = vi.steady(here)["final_state"]
    ended = []
    turns_into_flight = followed.turns_into_flight

    def seen(*arguments):
        ended.append(turns_into_flight(*arguments))
        return ended[-1]

    def turns() -> list[float]:
        high = highest(rig) * natural
        return sorted(followed.turning_points(here, begin, (0.4 * natural, high)))

    monkeypatch.setattr(followed, "turns_into_flight", seen)
    brief = turns()
    assert len(ended) == 2
    monkeypatch.setattr(followed, "bounded_by_flight", lambda first: False)
    assert brief == pytest.approx(turns(), rel=1e-7)
    assert len(brief) == count


def test_with_rigid_stops_all_is_followed():
    rig = vi.laboratory.case("B2-G2-A2").oscillator
    stiff = rig.replace(right=vi.RigidStop(gap=rig.right.gap, restitution=0.5))
    along = family(vi.Rig(stiff, vi.Harmonic(1.0, 1.0)), "frequency")
    first = followed.first_orbit(along, (0.0, 5.0), None, None)
    assert not followed.bounded_by_flight(first)


def test_a_mass_that_stays_pressed_does_not_fly():
    """It begins no contact, but its branch goes on: a constant force holds it on the stop."""
    k = (2.0 * math.pi) ** 2
    stop = vi.Bumper(3.0 * k, 0.5, 0.0)
    rig = vi.Oscillator(1.0, vi.Isolator(stiffness=k, damping=0.3), right=stop, force=10.0)
    turns = followed.turning_points(vi.Rig(rig, vi.Harmonic(1.0, 2.0)), None, (1.3, 2.3))
    assert sorted(turns) == pytest.approx([1.80744, 1.92063], rel=1e-5)
