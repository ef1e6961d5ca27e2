"""What no other design beats, against every pair of designs."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from vibroimpact.design.pareto import non_dominated


def _by_pairs(first, second):
    """Nobody is as good in both and better in one, or the same before; every pair is looked at."""
    points = list(zip(first, second, strict=True))
    return [
        np.isfinite(p).all()
        and not any(
            q[0] <= p[0] and q[1] <= p[1] and (q != p or k < i)
            for k, q in enumerate(points)
            if np.isfinite(q).all()
        )
        for i, p in enumerate(points)
    ]


_few = st.integers(0, 6).map(float)
"""Few values, so that many agree."""
_point = st.tuples(_few, _few) | st.just((np.nan, 1.0)) | st.just((0.0, np.inf))


@given(st.lists(_point, max_size=40))
def test_against_every_pair(points) -> None:
    first, second = np.array(points).reshape(-1, 2).T
    front = non_dominated(first, second)
    assert front.tolist() == _by_pairs(first.tolist(), second.tolist())


def test_what_agrees_up_to_rounding_is_one() -> None:
    first = np.array([[1.0, 1.0 + 1e-15], [0.5, 2.0]])
    second = np.array([[2.0 + 4e-15, 2.0], [3.0, 2.0]])
    np.testing.assert_array_equal(non_dominated(first, second), [[True, False], [True, False]])
