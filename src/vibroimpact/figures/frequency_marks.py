"""Marks of selected frequencies in resonance curves."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes

from vibroimpact.arguments import check_mapping
from vibroimpact.errors import InputError
from vibroimpact.figures.motion_style import check_axes
from vibroimpact.model import to_si
from vibroimpact.model.public import public
from vibroimpact.model.quantities import FREQUENCY

_ROOM = 0.08
"""Height of the names, as a share of the height of the panel."""


def _check_panels(value: object, field: str) -> list[Axes]:
    return [check_axes(ax, field) for ax in np.array(value, dtype=object).ravel()]


Marks: TypeAlias = Annotated[
    Mapping[str, float | str],
    partial(check_mapping, what='a dict of frequencies by name, such as {"f0": "1.2 Hz"}'),
]
"""Frequencies by name, in Hz or with units."""


@public
def frequency_marks(axes: Annotated[Any, _check_panels], frequencies: Marks) -> None:
    """Mark frequencies with vertical dotted lines, and write their names at the top of each panel.

    The vertical axes are extended slightly so that the names do not cover the curves.

    Parameters
    ----------
    axes
        One or several Axes whose horizontal axis is the frequency in Hz.
    frequencies
        Frequencies, as a mapping from names to numbers in Hz or strings with units.

    Raises
    ------
    InputError
        If a frequency is invalid, or if it lies outside the range of an axis.
    """
    values = {
        name: to_si(frequency, FREQUENCY, f"frequencies[{name!r}]", above=0.0)
        for name, frequency in frequencies.items()
    }
    for name, value in values.items():
        for ax in axes:
            low, high = ax.get_xlim()
            if not low <= value <= high:
                raise InputError(
                    f"frequencies[{name!r}]: {value:g} Hz is outside the frequency axis; use "
                    f"a frequency from {low:.4g} to {high:.4g} Hz"
                )
    for ax in axes:
        bottom, top = ax.get_ylim()
        ax.set_ylim(bottom, top + _ROOM * (top - bottom))
        for name, value in values.items():
            ax.axvline(value, color="0.25", linestyle=":", linewidth=1.1, zorder=1.5)
            ax.text(
                value,
                0.985,
                name,
                transform=ax.get_xaxis_transform(),
                ha="center",
                va="top",
                fontsize="small",
                bbox={"boxstyle": "circle,pad=0.15", "facecolor": "white", "linewidth": 0.6},
                zorder=8,
            )
