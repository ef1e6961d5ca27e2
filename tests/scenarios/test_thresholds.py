"""Thresholds are shares, and can be varied."""

from __future__ import annotations

import math

import pytest

import vibroimpact as vi
from vibroimpact.scenarios.thresholds import Thresholds


@pytest.mark.parametrize("value", [0.0, -0.1, 1.5, math.nan, "a", True])
def test_thresholds_are_shares(value):
    with pytest.raises(
        vi.InputError, match=r"extent: .*; pass a number greater than 0 and at most 1"
    ):
        Thresholds(extent=value)


def test_each_is_halved_and_doubled_in_turn():
    varied = list(Thresholds().variations())
    assert [name for name, _ in varied] == [n for n in Thresholds.names() for _ in range(2)]
    for name, other in varied:
        kept = [n for n in Thresholds.names() if n != name]
        assert all(getattr(other, n) == getattr(Thresholds(), n) for n in kept)
        assert getattr(other, name) / getattr(Thresholds(), name) in (0.5, 2.0)
