"""A stop of a curved law."""

from __future__ import annotations

import pytest

from vibroimpact.engine.series.values import Push
from vibroimpact.engine.stops.curved import pushing


def test_a_stop_never_pulls() -> None:
    push = Push(40.0, 1.5, 0.5, 0.0)
    assert pushing(push, 0.04, 1.0) == pytest.approx(40.0 * 0.008 * 1.5, rel=1e-14)
    assert pushing(push, 0.04, -2.0) == pushing(push, 0.04, -9.0) == 0.0
    assert pushing(push, 0.0, 3.0) == pushing(push, -0.1, 3.0) == 0.0
