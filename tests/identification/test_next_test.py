"""What to test next."""

from __future__ import annotations

import numpy as np

from vibroimpact.identification.next_test import _first_least


def test_a_tie_is_not_broken_by_rounding():
    """Of candidates that only rounding parts the first one is taken, whatever the processor."""
    values = np.full((2, 2, 3), np.nan)
    values[0, 0, 1], values[0, 1, 1], values[1, 0, 2] = 0.25, 0.25 * (1.0 - 1e-12), 0.3
    assert _first_least(values) == (0, 0, 1)
    assert _first_least(-values) == (1, 0, 2)
    values[1, 1, 0] = 0.24
    assert _first_least(values) == (1, 1, 0)
