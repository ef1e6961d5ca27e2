"""Peaks, jumps and hysteresis: on the published rig, and on curves made to try the definitions."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import vibroimpact as vi
from response.curves import grid, made, primary, swept
from vibroimpact.response.curve_pair import swept as arrays
from vibroimpact.response.resonance import (
    Features,
    Hysteresis,
    Jump,
    features,
    ranges,
)


def brackets(jump_list: tuple[Jump, ...], direction: str) -> list[tuple[float, float, str]]:
    return [
        (j.before, j.after, "up" if j.upward else "down")
        for j in jump_list
        if j.direction == direction
    ]


def secondary(curve_features: Features, direction: str, curve: str = "eta_a") -> list[float]:
    return [
        p.frequency
        for p in curve_features.peaks
        if (p.direction, p.curve, p.primary) == (direction, curve, False)
    ]


class TestPublishedRig:
    def test_secondary_resonance_and_right_hysteresis(self):
        curve_features = features(swept("B2-G1-A3", 0.5, 5, 0.01, "identified"))
        assert brackets(curve_features.jumps, "forward") == [(2.65, 2.66, "down")]
        assert brackets(curve_features.jumps, "backward") == [(1.68, 1.67, "up")]
        assert curve_features.hysteresis == (Hysteresis("right", 1.68, 2.65, 1.67, 2.66, True),)
        assert curve_features.hysteresis[0].ends == pytest.approx((1.675, 2.655))
        for direction in ("forward", "backward"):
            assert secondary(curve_features, direction) == [0.57]
        assert primary(curve_features, "forward") == 2.63
        assert primary(curve_features, "backward") == 1.67
        assert curve_features.unsettled == ()
        assert [(r.direction, r.low, r.high) for r in curve_features.contact] == [
            ("forward", 0.5, 2.65),
            ("backward", 0.5, 1.67),
        ]

    def test_the_same_on_the_coarse_grid_of_the_tests(self):
        curve_features = features(swept("B2-G1-A3", 0.5, 5, 0.1, "identified"))
        assert brackets(curve_features.jumps, "forward") == [(2.6, 2.7, "down")]
        assert brackets(curve_features.jumps, "backward") == [(1.8, 1.7, "up")]
        assert secondary(curve_features, "forward") == [0.6]

    def test_a_fine_sweep_resolves_the_small_left_hysteresis(self):
        curve_features = features(swept("B2-G1-A3", 0.5, 0.62, 0.001, "identified"))
        assert [(h.side, h.low, h.high) for h in curve_features.hysteresis] == [
            ("left", 0.561, 0.567)
        ]
        assert brackets(curve_features.jumps, "forward") == [(0.567, 0.568, "up")]
        assert brackets(curve_features.jumps, "backward") == [(0.561, 0.56, "down")]

    @pytest.mark.parametrize("direction", ["forward", "backward"])
    @pytest.mark.parametrize("step", [0.1, 0.01])
    def test_one_direction_alone_shows_its_jump(self, direction, step):
        both = swept("B2-G1-A3", 0.5, 5, step, "identified")
        alone = both.sel(direction=[direction])
        assert features(alone).jumps == tuple(
            j for j in features(both).jumps if j.direction == direction
        )
        assert features(alone).hysteresis == ()

    def test_scenario_with_the_primary_resonance_only(self):
        curve_features = features(swept("B2-G2-A2", 0.5, 5, 0.01, "identified"))
        assert brackets(curve_features.jumps, "forward") == [(2.11, 2.12, "down")]
        assert brackets(curve_features.jumps, "backward") == [(1.53, 1.52, "up")]
        assert secondary(curve_features, "forward") == secondary(curve_features, "backward") == []
        assert curve_features.contact[0].low == 0.71

    def test_left_hysteresis_and_motions_that_do_not_settle(self):
        curve_features = features(swept("B3-10mm-A3", 0.3, 4, 0.01))
        left = [h for h in curve_features.hysteresis if h.side == "left"]
        assert (left[-1].low, left[-1].high) == (0.68, 0.72)
        assert [(h.low, h.high) for h in curve_features.hysteresis if h.side == "right"] == [
            (1.91, 3.29)
        ]
        # Left hysteresis: the forward sweep jumps up at its upper end, the backward sweep
        # down at its lower end.
        assert (0.72, 0.73, "up") in brackets(curve_features.jumps, "forward")
        assert (0.68, 0.67, "down") in brackets(curve_features.jumps, "backward")
        assert all(j.settled for j in curve_features.jumps)
        for direction in ("forward", "backward"):
            loose = [r for r in curve_features.unsettled if r.direction == direction]
            assert any(r.low <= 1.02 and r.high >= 1.1 for r in loose)
            assert all(r.low > 0.99 and r.high < 1.27 for r in loose)

    def test_a_backward_secondary_resonance_may_be_the_higher_one(self):
        curve_features = features(swept("B3-10mm-A3", 0.3, 4, 0.01))
        heights = {
            p.frequency: p.value for p in curve_features.peaks if p[:2] == ("backward", "eta_a")
        }
        assert heights[0.68] > heights[1.9]
        assert primary(curve_features, "backward") == 1.9
        assert primary(curve_features, "forward") == 3.28

    @pytest.mark.parametrize(
        ("code", "low", "high"), [("B2-G4-A1", 1.293, 1.3), ("B1-G1-A1", 1.538, 1.662)]
    )
    def test_narrow_right_hysteresis(self, code, low, high):
        curve_features = features(swept(code, 1.2, 1.8, 0.001))
        assert [(h.side, h.low, h.high) for h in curve_features.hysteresis] == [
            ("right", low, high)
        ]
        assert brackets(curve_features.jumps, "forward") == [(high, round(high + 0.001, 9), "down")]
        assert brackets(curve_features.jumps, "backward") == [(low, round(low - 0.001, 9), "up")]

    @pytest.mark.parametrize("code", ["B2-Ginf-A3", "B3-0mm-A3"])
    @pytest.mark.parametrize("step", [0.1, 0.01, 0.001])
    def test_no_jump_on_a_smooth_resonance(self, code, step):
        stop = 8.0 if step > 0.005 else 2.0
        curve_features = features(swept(code, 0.3, stop, step))
        assert curve_features.jumps == ()
        assert curve_features.hysteresis == ()
        assert curve_features.unsettled == ()

    @pytest.mark.parametrize("step", [0.1, 0.03, 0.01])
    @pytest.mark.parametrize("damping_ratio", [0.003, 0.03, 0.9])
    def test_no_jump_in_free_flight_however_sharp_its_peak(self, damping_ratio, step):
        made = vi.from_dimensionless(None, 0, 0, damping_ratio)
        oscillator, amplitude = made.oscillator, made.amplitude
        f0 = oscillator.natural_frequency
        data = vi.sweep(vi.Rig(oscillator, amplitude), [f0 * r for r in grid(0.3, 3, step)])
        assert features(data).jumps == ()

    def test_no_jump_where_soft_bumpers_only_bend_the_curve(self):
        made = vi.from_dimensionless(0.1, 0.5, 0.01, 0.15)
        oscillator, amplitude = made.oscillator, made.amplitude
        f0 = oscillator.natural_frequency
        data = vi.sweep(vi.Rig(oscillator, amplitude), [f0 * r for r in grid(0.3, 3, 0.02)])
        assert features(data).contact != ()
        assert features(data).jumps == ()

    def test_a_transient_that_outlasts_the_cycle_limit_is_no_evidence(self):
        made = vi.from_dimensionless(None, 0, 0, 1e-4)
        oscillator, amplitude = made.oscillator, made.amplitude
        f0 = oscillator.natural_frequency
        data = vi.sweep(
            vi.Rig(oscillator, amplitude), [f0 * r for r in grid(0.9, 1.1, 0.01)], max_cycles=300
        )
        curve_features = features(data)
        assert curve_features.unsettled != ()
        assert not any(j.settled for j in curve_features.jumps)
        assert not any(h.settled for h in curve_features.hysteresis)


class TestHysteresis:
    f = grid(1, 2, 0.1)

    def test_sides(self):
        low, high = np.ones(11), np.ones(11)
        high[4:7] = 1.5
        right = features(made(self.f, high, low)).hysteresis
        left = features(made(self.f, low, high)).hysteresis
        assert right == (Hysteresis("right", 1.4, 1.6, 1.3, 1.7, True),)
        assert left == (Hysteresis("left", 1.4, 1.6, 1.3, 1.7, True),)

    def test_which_sweep_jumps_where(self):
        low, high = np.ones(11), np.ones(11)
        high[4:7] = 1.5
        right = features(made(self.f, high, low)).jumps
        assert ("forward", 1.6, 1.7) in [j[:3] for j in right]
        assert ("backward", 1.4, 1.3) in [j[:3] for j in right]

    def test_range_that_goes_on_beyond_the_sweep(self):
        data = made(self.f, np.full(11, 2.0), np.full(11, 1.0))
        assert features(data).hysteresis == (Hysteresis("right", 1.0, 2.0, None, None, True),)
        assert features(data).hysteresis[0].ends == (1.0, 2.0)
        assert features(data).jumps == ()

    def test_small_differences_are_the_same_motion(self):
        forward = np.ones(11)
        backward = forward * 1.009
        assert features(made(self.f, forward, backward)).hysteresis == ()
        assert len(features(made(self.f, forward, backward), apart=0.005).hysteresis) == 1

    def test_wide_tolerance_where_a_motion_did_not_settle(self):
        forward = np.ones(11)
        settled = np.ones((2, 11), dtype=bool)
        settled[0, 3:8] = False
        backward = np.where(settled[0], forward, 1.09)
        assert features(made(self.f, forward, backward, settled=settled)).hysteresis == ()
        backward = np.where(settled[0], forward, 1.2)
        (only,) = features(made(self.f, forward, backward, settled=settled)).hysteresis
        assert not only.settled

    def test_two_sides_beside_each_other_are_two_ranges(self):
        forward, backward = np.ones(11), np.ones(11)
        backward[3:5], forward[5:8] = 2.0, 2.0
        sides = features(made(self.f, forward, backward)).hysteresis
        assert [(h.side, h.low, h.high) for h in sides] == [("left", 1.3, 1.4), ("right", 1.5, 1.7)]

    def test_absent_values_are_left_out(self):
        forward, backward = np.ones(11), np.ones(11)
        forward[4:7] = 1.5
        backward[5] = np.nan
        (only,) = features(made(self.f, forward, backward)).hysteresis
        assert (only.low, only.high) == (1.4, 1.6)


class TestBreaks:
    """Jumps of a curve by itself."""

    def test_step_between_level_parts(self):
        f = grid(1, 2, 0.1)
        data = made(f, np.where(np.array(f) < 1.45, 2.0, 1.0) + 0.001 * np.array(f))
        assert brackets(features(data).jumps, "forward") == [(1.4, 1.5, "down")]

    @pytest.mark.parametrize("power", [1 / 2, 1 / 3])
    @pytest.mark.parametrize("place", [0.0, 0.1, 0.25, 0.5, 0.9])
    def test_no_continuous_branch_jumps(self, power, place):
        # The steepest ways in which a branch turns: fold or grazing, and cusp.
        x = np.arange(-20, 21) + place
        for curve in (np.sign(x) * np.abs(x) ** power, np.where(x > 0, np.abs(x) ** power, 0)):
            assert features(made(x + 30, curve - curve.min() + 1.0)).jumps == ()
            assert features(made(x + 30, 3.0 - curve)).jumps == ()

    def test_uneven_steps_of_frequency_do_not_matter(self):
        f = np.array([1.0, 1.01, 1.02, 1.03, 1.5, 1.51, 1.52, 1.53])
        assert features(made(f, f)).jumps == ()
        assert len(features(made(f, np.where(f < 1.025, f, f + 1))).jumps) == 1

    def test_both_directions_across_a_hysteresis_narrower_than_a_step(self):
        f = grid(1, 2, 0.1)
        curve = np.where(np.array(f) < 1.45, 1.0, 2.0) + 0.001 * np.array(f)
        both = features(made(f, curve, curve)).jumps
        assert brackets(both, "forward") == [(1.4, 1.5, "up")]
        assert brackets(both, "backward") == [(1.5, 1.4, "down")]
        assert both[0].eta_a == pytest.approx((1.0014, 2.0015))
        assert both[1].eta_a == pytest.approx((2.0015, 1.0014))

    def test_unsettled_curve_may_wander(self):
        f = grid(1, 2, 0.1)
        curve = np.where(np.array(f) < 1.45, 1.0, 1.08)
        assert features(made(f, curve, settled=False)).jumps == ()
        assert len(features(made(f, curve)).jumps) == 1

    def test_short_and_empty_curves(self):
        assert features(made([1.0], [1.0])).jumps == ()
        assert features(made([1.0, 2.0, 3.0], [1.0, 9.0, 1.0])).jumps == ()
        assert features(made([1.0, 2.0], [np.nan, np.nan])).jumps == ()


def test_ranges_are_runs():
    f = grid(1, 2, 0.1)
    data = made(f, np.ones(11))
    where = np.isin(np.arange(11), [0, 1, 5, 10])[np.newaxis]
    runs = ranges(arrays(data), where)
    assert [r[1:] for r in runs] == [(1.0, 1.1, 2), (1.5, 1.5, 1), (2.0, 2.0, 1)]


def test_jumps_are_in_the_order_of_their_sweep():
    every = features(swept("B3-10mm-A3", 0.3, 4, 0.01)).jumps
    for direction, rising in (("forward", True), ("backward", False)):
        places = [j.frequency for j in every if j.direction == direction]
        assert len(places) > 2
        assert all((a < b) == rising for a, b in pairwise(places))
