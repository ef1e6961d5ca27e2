"""Folds that no two frequencies of a sweep show: none is missed, and little has to be followed."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact.response.curve_pair import Swept
from vibroimpact.scenarios import map_node
from vibroimpact.scenarios.classification import scenario
from vibroimpact.scenarios.hidden_folds import hidden_stretches
from vibroimpact.scenarios.orbit_evidence import with_folds
from vibroimpact.scenarios.resonance_curves import Holds
from vibroimpact.scenarios.thresholds import Thresholds

FREQUENCY = np.linspace(1.0, 2.0, 101)


def _looked_at(curve, contacts=1.0, backward=None, period=1):
    curves = np.array([curve, curve if backward is None else backward])
    counts = np.broadcast_to(np.asarray(contacts, float)[..., np.newaxis], (2, 101, 2))
    periods = np.broadcast_to(period, (2, 101))
    both = Swept(
        FREQUENCY,
        ("forward", "backward"),
        curves,
        curves,
        periods > 0,
        periods,
        counts.any(axis=-1),
    )
    ended = Holds(FREQUENCY, periods, np.zeros((2, 101, 7)), periods < 0, counts)
    return hidden_stretches(both, ended)


SMOOTH = 1.0 / np.sqrt((1.5**2 - FREQUENCY**2) ** 2 + (0.1 * FREQUENCY) ** 2)


def test_nothing_hides_in_a_smooth_resonance():
    assert _looked_at(SMOOTH) == []


@pytest.mark.parametrize("at", np.linspace(0.0, 0.01, 11))
@pytest.mark.parametrize("rise", [0.0, 2.0])
def test_a_cusp_shows_wherever_it_lies_between_two_frequencies(at, rise):
    place = FREQUENCY - (FREQUENCY[40] + at)
    spans = _looked_at(1.0 + np.cbrt(place) + rise * place)
    assert any(first <= 40 and last >= 41 for first, last in spans)
    assert sum(last - first for first, last in spans) <= 4


@pytest.mark.parametrize("given_up", [38, 39, 42, 43])
def test_a_hold_that_was_given_up_hides_no_cusp_beside_it(given_up):
    curve = 1.0 + np.cbrt(FREQUENCY - FREQUENCY[40] - 0.005)
    curve[given_up] = np.nan
    spans = _looked_at(curve, period=np.where(np.arange(101) == given_up, 0, 1))
    assert any(first <= 40 and last >= 41 for first, last in spans)


def test_where_the_contacts_change_it_is_looked_at():
    contacts = np.where(FREQUENCY > 1.305, 1.0, 0.0)
    assert _looked_at(SMOOTH, contacts) == [(30, 31)]
    assert _looked_at(SMOOTH, 0.0 * contacts) == []  # free flight does not fold


def test_where_two_directions_or_periods_differ_it_is_looked_at():
    backward = np.where(np.abs(FREQUENCY - 1.3) < 0.005, 1.01 * SMOOTH, SMOOTH)
    assert _looked_at(SMOOTH, backward=backward) == [(29, 31)]
    twice = np.where(np.abs(FREQUENCY - 1.3) < 0.015, 2, 1)
    assert _looked_at(SMOOTH, period=twice) == [(28, 32)]


@pytest.mark.full
def test_a_part_of_the_branch_tells_what_the_whole_one_tells(monkeypatch):
    """Rigs beside the cusp in which jumps begin, and others."""
    asked = []

    def both_ways(features, rig, ended, both):
        part = with_folds(features, rig, ended, both)
        asked.append((with_folds(features, rig, ended), part))
        return part

    monkeypatch.setattr(map_node, "with_folds", both_ways)
    side = sample(14, 7)
    gaps = {"gap_ratio": np.linspace(0.02, 0.97, side)}
    hard = {"stiffness_ratio": np.geomspace(0.7, 6.0, side)}
    vi.scenario_map(None, {**hard, **gaps}, threads=1)
    light = vi.from_dimensionless(3.0, 0.5, 0.01, 0.05)
    vi.scenario_map(light, {"relaxation_time": np.geomspace(0.001, 1.0, 4), **gaps}, threads=1)
    thresholds = Thresholds()
    assert len(asked) > sample(60, 15)
    assert any(whole.folds for whole, _ in asked)
    for whole, part in asked:
        assert scenario(part, thresholds) is scenario(whole, thresholds)
        assert set(np.round(whole.folds, 7)) <= set(np.round(part.folds, 7))
