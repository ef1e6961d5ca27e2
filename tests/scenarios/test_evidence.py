"""What curves made for the purpose show, and the scenario that follows."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from scenarios.made import GAP, GRID, RIG, bump, inside, made, named, primary, slope
from vibroimpact.scenarios.classification import confidence
from vibroimpact.scenarios.evidence import evidence
from vibroimpact.scenarios.thresholds import Thresholds


def test_primary_resonance_alone():
    data = made(*primary())
    features = evidence(RIG, data, 0.01)
    assert [(h.side, h.low, h.high) for h in features.hysteresis] == [("right", 1.61, 2.2)]
    assert features.contact == (0.4, 2.2)
    assert features.gap_ratio == pytest.approx(0.3)
    assert features.penetration == pytest.approx(0.3)
    assert features.extent(0.02) == 0.0
    assert named(data) == "S2"


def test_regular_secondary_resonance():
    forward, backward = primary()
    peak = bump(0.7, 0.05, 0.5)
    data = made(forward + peak, backward + peak)
    features = evidence(RIG, data, 0.01)
    ((frequency, share),) = features.secondary_resonances(0.02)
    assert frequency == pytest.approx(0.7, abs=0.02)
    # Above the higher one of its valleys, which is the one beyond it.
    beyond = (forward + peak)[GRID > 0.7].tolist()
    at = float((forward + peak)[np.isclose(GRID, frequency)][0])
    assert share == pytest.approx((at - min(beyond[:60])) / at, rel=1e-9)
    assert named(data) == "S3"
    # Without the right hysteresis it is none of the scenarios.
    assert named(made(0.3 + peak + bump(1.6, 0.4, 1.0))) == "unclassified"


def test_left_hysteresis_counts_by_its_width():
    """0.1 Hz wide, half-way to the frequencies beside it, at a natural frequency of 1 Hz."""
    forward, backward = primary()
    low = np.where(inside(0.66, 0.75), 0.5, 0.0)
    data = made(forward, backward + low)
    features = evidence(RIG, data, 0.01)
    assert [(h.side, h.low, h.high) for h in features.left] == [("left", 0.66, 0.75)]
    assert features.extent(0.02) == pytest.approx(0.1)
    assert named(data) == "S4"
    assert named(data, extent=0.11) != "S4"
    # Twice the threshold is too much, half of it is not.
    assert confidence(features, Thresholds()) == pytest.approx(7 / 8)


@pytest.mark.parametrize(
    ("period", "uneven", "kind"),
    [(0, False, "not periodic"), (3, False, "subharmonic"), (1, True, "mirrored pair")],
)
def test_irregular_resonance(period, uneven, kind):
    """One that is raised above its valleys, while the mass hits the bumpers there."""
    forward, backward = primary()
    here = inside(1.0, 1.2)
    valley = bump(0.85, 0.06, -0.4)
    peak = valley + np.where(here, 0.3, 0.0)
    data = made(
        forward + peak,
        backward + peak,
        period=np.where(here, period, 1),
        uneven=here & uneven,
    )
    features = evidence(RIG, data, 0.01)
    assert [(i.low, i.high, i.kinds) for i in features.irregular] == [(1.0, 1.2, (kind,))] * 2
    assert features.irregular[0].prominence > 0.1
    assert features.extent(0.02) == pytest.approx(0.2)
    assert named(data) == "S4"
    # With no peak of the excursion in it, it is not a resonance.
    flat = made(
        forward + valley, backward + valley, period=np.where(here, period, 1), uneven=here & uneven
    )
    assert len(evidence(RIG, flat, 0.01).irregular) == 2
    assert evidence(RIG, flat, 0.01).extent(0.02) == 0.0
    assert named(flat) == "S3"  # the valley leaves a regular peak before it


def test_a_pair_of_a_rig_that_is_not_symmetric_is_none():
    """There eccentricity tells nothing."""
    oscillator = RIG.oscillator.replace(left=RIG.oscillator.left.replace(gap=1.01 * GAP))
    data = made(*primary(), uneven=inside(1.0, 1.2))
    assert evidence(vi.Rig(oscillator, RIG.sine), data, 0.01).irregular == ()
    assert len(evidence(RIG, data, 0.01).irregular) == 2


def test_one_direction_is_not_enough():
    data = made(*primary())
    with pytest.raises(vi.InputError, match="sweep in both directions, 'forward' and 'backward'"):
        evidence(RIG, data.isel(direction=[0]), 0.01)
    with pytest.raises(vi.InputError, match="is not the sweep of one rig"):
        evidence(RIG, data.isel(direction=0), 0.01)


def test_a_hysteresis_of_motions_that_did_not_settle_is_none():
    """Two windows of wandering motions differ, too."""
    forward, backward = primary()
    wandering = made(forward, backward, period=np.where(inside(1.55, 2.25), 0, 1))
    features = evidence(RIG, wandering, 0.01)
    assert [item.settled for item in features.hysteresis] == [False]
    assert features.right == ()
    low = np.where(inside(0.66, 0.75), 0.5, 0.0)
    data = made(forward, backward + low, period=np.where(inside(0.6, 0.8), 0, 1))
    assert evidence(RIG, data, 0.01).left == ()


def test_what_lies_above_the_primary_resonance_does_not_count():
    forward = np.where(inside(2.5, 2.8), 0.28, slope(2.2))
    backward = np.where(inside(2.5, 2.8), 0.28, slope(1.6))
    period = np.where(inside(2.5, 2.8), 0, 1)
    data = made(forward, backward, touching=True, period=period)
    features = evidence(RIG, data, 0.01)
    assert [item.low for item in features.irregular] == [2.5, 2.5]
    assert features.extent(0.01) == 0.0
    assert named(data) == "S2"


def test_free_flight_is_that_at_any_frequency():
    """Of a sweep that does not reach the resonance, too."""
    data = made(*primary()).sel(frequency=slice(1.4, 3.0))
    features = evidence(RIG, data, 0.01)
    assert features.gap_ratio == pytest.approx(0.3)
    assert not features.within
    assert named(data) == "unclassified"
    assert named(made(*primary()).sel(frequency=slice(0.4, 1.3))) == "unclassified"
