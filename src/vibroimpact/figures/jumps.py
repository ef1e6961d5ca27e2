"""Jumps of a sweep: gaps in its curve, and arrows."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import FancyArrowPatch
from numpy.typing import NDArray

from vibroimpact.response.resonance import Jump

_Array = NDArray[np.float64]


def cut_at(x: _Array, y: _Array, jumps: Iterable[Jump]) -> tuple[_Array, _Array]:
    """Return a curve with gaps where it jumps, as x and y with NaN between the two sides."""
    cuts = np.searchsorted(x, sorted(max(jump.before, jump.after) for jump in jumps))
    return np.insert(x, cuts, np.nan), np.insert(y, cuts, np.nan)


def ends_of(x: _Array, y: _Array, jump: Jump) -> tuple[float, float]:
    """Return the values of a curve before and after a jump."""
    before, after = (float(y[np.searchsorted(x, at)]) for at in (jump.before, jump.after))
    return before, after


def draw_arrow(ax: Axes, jump: Jump, ends: tuple[float, float], size: float, **style: Any) -> None:
    """Draw an arrow at the frequency of a jump, from the value before to the value after it."""
    places = [(jump.frequency, end) for end in ends]
    ax.add_patch(
        FancyArrowPatch(
            *places, arrowstyle="-|>", mutation_scale=size, shrinkA=0.0, shrinkB=0.0, **style
        )
    )
