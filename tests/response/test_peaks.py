"""Peaks of resonance curves: the primary resonance, and what counts as another."""

from __future__ import annotations

import numpy as np

from response.curves import grid, made, primary, swept
from vibroimpact.response.peaks import PROMINENCE
from vibroimpact.response.resonance import features


class TestPeaks:
    f = grid(1, 2, 0.1)

    def acceleration_peaks(self, curve, *, prominence=PROMINENCE, **options):
        every = features(made(self.f, curve, **options), prominence=prominence).peaks
        return [p for p in every if p.curve == "eta_a"]

    def test_prominence(self):
        first, second = self.acceleration_peaks([0, 1, 3, 2, 1.5, 2, 5, 4, 1, 1, 1])
        assert (first.frequency, first.value, first.prominence) == (1.2, 3.0, 1.5)
        assert (second.frequency, second.value, second.prominence) == (1.6, 5.0, 4.0)
        assert (first.primary, second.primary) == (False, True)

    def test_ripples_are_left_out(self):
        curve = [1, 2, 1.99, 2, 3, 5, 4, 3, 2, 1.5, 1]
        assert [p.frequency for p in self.acceleration_peaks(curve)] == [1.5]

    def test_plateau_counts_once(self):
        (only,) = self.acceleration_peaks([1, 2, 3, 3, 3, 2, 1, 1, 1, 1, 1])
        assert only.frequency == 1.2

    def test_curve_that_still_rises_at_the_end(self):
        (only,) = self.acceleration_peaks(np.arange(11.0))
        assert (only.frequency, only.at_end, only.primary) == (2.0, True, True)
        (only,) = self.acceleration_peaks(-np.arange(11.0) + 20)
        assert (only.frequency, only.at_end) == (1.0, True)

    def test_subharmonic_resonance_is_not_the_primary_one(self):
        period = np.ones(11, dtype=int)
        period[6:10] = 2
        first, second = self.acceleration_peaks([0, 1, 3, 2, 1.5, 2, 5, 4, 1, 1, 1], period=period)
        assert (first.primary, second.primary) == (True, False)

    def test_absent_values(self):
        (only,) = self.acceleration_peaks([1, 2, np.nan, 5, 2, 1, 1, 1, 1, 1, np.nan])
        assert only.frequency == 1.3
        assert self.acceleration_peaks([np.nan] * 11) == []

    def test_every_curve_has_one_primary_peak(self):
        curve_features = features(swept("B4-G1-A3", 0.5, 5, 0.1))
        for direction in ("forward", "backward"):
            for curve in ("eta_a", "eta_d"):
                primary(curve_features, direction, curve)

    def test_random_curves_by_the_definition_itself(self):
        """Each summit against every point beside it, with plateaus."""
        random = np.random.default_rng(7)
        for _ in range(200):
            y = random.integers(0, 5, size=11).astype(float)
            expected = {self.f[i]: above for i, above in _by_definition(y).items()}
            assert {
                p.frequency: p.prominence for p in self.acceleration_peaks(y, prominence=0.0)
            } == expected


def _by_definition(y):
    """Prominence of each first point that is higher than what is beside it on both sides."""
    prominences = {}
    for i, height in enumerate(y):
        valleys = []
        for side in (y[:i][::-1], y[i + 1 :]):
            lower = []
            for other in side:
                if other > height:
                    break
                lower.append(other)
            valleys += [min(lower)] if lower else []
        other = next((one for one in y[i:] if one != height), np.inf)
        if (i > 0 and y[i - 1] < height and height > other) or i == int(y.argmax()):
            prominences[i] = height - max(valleys, default=height)
    return prominences
