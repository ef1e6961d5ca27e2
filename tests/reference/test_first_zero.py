"""The first zero of a polynomial, which every reference computation asks for, where it is known."""

from __future__ import annotations

import pytest
from mpmath import mp, mpf

from reference.first_zero import first_zero


@pytest.mark.parametrize(
    ("zeros", "first"),
    [
        (["0.5"], "0.5"),
        (["0.7", "0.71", "0.2"], "0.2"),
        (["0.25", "0.25", "0.75"], "0.75"),
        (["0.3", "0.3000000000000000000001", "0.9"], "0.3"),
        (["0.5", "0.6", "0.8"], "0.5"),
        (["1e-88", "0.3", "0.6"], "0"),
        (["1.2", "-0.4"], None),
    ],
)
def test_the_first_zero_is_the_first(zeros: list[str], first: str | None) -> None:
    with mp.workdps(70):
        series = [mpf(1)]
        for zero in zeros:
            shifted = [mpf(0), *series]
            series = [mpf(zero) * a - b for a, b in zip([*series, mpf(0)], shifted, strict=True)]
        if series[0] < 0:
            series = [-value for value in series]
        root = first_zero(series)
        if first is None:
            assert root is None
        else:
            assert root is not None
            assert abs(root - mpf(first)) < mpf(10) ** -40
