"""What the orbits behind the curves add: kinds of motion, and exact jumps."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.scenarios.evidence import evidence
from vibroimpact.scenarios.orbit_evidence import primary_branch, with_folds, with_kinds
from vibroimpact.scenarios.resonance_curves import holds
from vibroimpact.stability.motion_exponents import judge_wandering
from vibroimpact.tasks.threads import Stopped


def looked_at(code: str, low: float, high: float, step: float):
    case = vi.laboratory.case(code)
    rig = vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.0))
    data = vi.sweep(rig, np.arange(round(low / step), round(high / step) + 1) * step)
    return evidence(rig, data, 0.01), rig, holds(data)


@pytest.fixture(scope="module")
def chaotic():
    return looked_at("B3-10mm-A3", 0.9, 1.5, 0.02)


def test_motions_that_are_not_periodic_are_named(chaotic):
    features, rig, ended = chaotic
    assert any("not periodic" in item.kinds for item in features.irregular)
    named = with_kinds(features, rig, ended)
    assert any("chaotic" in item.kinds for item in named.irregular)
    assert not any("quasi-periodic" in item.kinds for item in named.irregular)


def test_a_motion_that_meets_the_event_limit_stays_unnamed(chaotic, monkeypatch):
    monkeypatch.setattr("vibroimpact.scenarios.orbit_evidence._MAX_EVENTS", 1)
    features, rig, ended = chaotic
    named = with_kinds(features, rig, ended)
    assert [item.kinds for item in named.irregular] == [item.kinds for item in features.irregular]


def test_naming_ends_where_it_is_not_wanted_any_more(chaotic):
    features, rig, ended = chaotic
    asked = []

    def check() -> None:
        asked.append(1)
        if len(asked) == 2:
            raise Stopped

    with pytest.raises(Stopped):
        with_kinds(features, rig, ended, check=check)


def test_folds_lie_where_the_sweeps_jump():
    features, rig, ended = looked_at("B2-G1-A3", 0.9, 4.0, 0.05)
    exact = with_folds(features, rig, ended).folds
    (right,) = features.right
    assert right.below < exact[-2] < right.low
    assert right.high < exact[-1] < right.above


def test_no_contact_no_branch():
    features, rig, ended = looked_at("B2-Ginf-A3", 0.9, 4.0, 0.1)
    assert primary_branch(features, rig, ended) is None
    assert with_folds(features, rig, ended).folds is None


@pytest.mark.parametrize("relaxation", [1.0, 1000.0])
def test_a_map_asks_once_what_forgetful_bumpers_leave_only_chaos_for(
    chaotic, relaxation, monkeypatch
):
    features, rig, ended = chaotic
    asked = []

    def judged(followed, state, cycles, max_events):
        asked.append(cycles)
        return judge_wandering(followed, state, cycles, max_events)

    monkeypatch.setattr("vibroimpact.scenarios.orbit_evidence.judge_wandering", judged)
    monkeypatch.setattr("vibroimpact.scenarios.orbit_evidence._RELAXATIONS", 20.0 * relaxation)
    whole = with_kinds(features, rig, ended)
    all_of_them, asked[:] = len(asked), []
    brief = with_kinds(features, rig, ended, brief=True)
    again = [item for item in brief.irregular if "not periodic" in item.kinds]
    assert (len(asked) < all_of_them) == bool(again) == (relaxation == 1.0)
    for one, other in zip(whole.irregular, brief.irregular, strict=True):
        assert one == other or one.direction == "backward"
    chaos = [
        e._replace(irregular=tuple(i for i in e.irregular if "chaotic" in i.kinds))
        for e in (whole, brief)
    ]
    assert len({len(e.irregular_once) for e in chaos}) == 1
