"""Intervals of shares."""

from __future__ import annotations

import numpy as np
import pytest

from vibroimpact.attraction.basin_fractions import interval


@pytest.mark.parametrize(("hits", "total"), [(0, 10), (3, 10), (10, 10), (250, 1000)])
def test_as_scipy_has_it(hits, total):
    from scipy.stats import binomtest

    theirs = binomtest(hits, total).proportion_ci(0.95, method="exact")
    low, high = interval([hits], total)
    assert (low[0], high[0]) == pytest.approx((theirs.low, theirs.high), abs=1e-12)


def test_the_share_lies_within_as_often_as_is_said():
    generator = np.random.default_rng(1)
    hits = generator.binomial(200, 0.3, 4000)
    low, high = interval(hits, 200)
    assert 0.95 <= ((low <= 0.3) & (high >= 0.3)).mean() <= 0.975
