"""Fig. 15: scenario S4, B3 with a total gap of 10 mm at A3."""

from __future__ import annotations

from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from paper.report_item import Item
from paper.study import PublishedStudy
from vibroimpact.figures import frequency_marks, resonance_curves
from vibroimpact.response.resonance import Features, features

CODE = "B3-10mm-A3"
LOW = 0.3
BRANCH = (0.9, 1.4)
"""Range in Hz in which the small antisymmetric motion is followed. It is stable at both ends."""

_GREEN: dict[str, Any] = {
    "color": "#00795c",
    "linestyle": (0, (3, 1.5)),
    "linewidth": 2.0,
    "label": "antisymmetric motion, unstable",
}
_WILD: dict[str, Any] = {"facecolor": "#fbe3bd", "lw": 0.0, "label": "no periodic motion"}


def draw(study: PublishedStudy) -> Figure:
    """Draw the whole range on the left, and the range around 1 Hz on the right."""
    data = study.curves(CODE, low=LOW)
    curve_features = features(data)
    branch = study.antisymmetric_branch(CODE, *BRANCH)
    figure = Figure(figsize=(13.0, 6.8), layout="constrained")
    axes = figure.subplots(2, 2, sharex="col", width_ratios=[2.2, 1.0])
    near = data.sel(frequency=slice(*BRANCH))
    for column, part in ((0, data), (1, near)):
        resonance_curves(part, axes[:, column], curve_features=curve_features, physical=False)
        for ax, excursion in zip(axes[:, column], _EXCURSIONS.values(), strict=True):
            _unstable(ax, data, branch, excursion)
            _unsettled(ax, curve_features)
    for ax, (quantity, excursion) in zip(axes[:, 1], _EXCURSIONS.items(), strict=True):
        low = float((branch[excursion] / _reference(data, excursion)).min())
        high = float(near[quantity].max())
        ax.set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low))
        ax.set_ylabel("")
    first, second = study.other_places(CODE, LOW)
    frequency_marks(axes[:, 0], {"I": first, "II": second})
    frequency_marks(axes[:, 1], {"II": second})
    handles = [
        handle
        for handle in axes[0, 0].get_legend().legend_handles
        if "not settled" not in handle.get_label()
    ]
    for ax, title in zip(axes[0], ("whole range", "around 1 Hz"), strict=True):
        ax.get_legend().remove()
        ax.set_title(title, fontsize="medium")
    figure.legend(
        handles=[*handles, Line2D([], [], **_GREEN), Patch(**_WILD)],
        loc="outside upper center",
        ncols=4,
        frameon=False,
    )
    figure.align_ylabels(axes[:, 0])
    return figure


_EXCURSIONS = {"eta_a": "acceleration_excursion", "eta_d": "displacement_excursion"}


def _reference(data: xr.Dataset, excursion: str) -> float:
    """Return the reference of the sweeps: the maximum of free flight at their frequencies."""
    return float(data[f"free_{excursion}"].max())


def _unstable(ax: Axes, data: xr.Dataset, branch: xr.Dataset, excursion: str) -> None:
    """Draw the antisymmetric motion where it is unstable."""
    where = branch["stable"].values == 0
    ax.plot(
        branch["frequency"].values[where],
        branch[excursion].values[where] / _reference(data, excursion),
        zorder=6,
        **_GREEN,
    )


def _unsettled(ax: Axes, curve_features: Features) -> None:
    """Shade the ranges without periodic motions, because crosses are hard to see between marks."""
    for line in list(ax.lines):
        if "not settled" in str(line.get_label()):
            line.remove()
    for item in curve_features.unsettled:
        if item.direction == "forward":
            ax.axvspan(item.low, item.high, zorder=0, **_WILD)


ITEM = Item(
    key="fig15",
    title="Fig. 15: scenario S4, B3 with a total gap of 10 mm at A3",
    caption=(
        "The figure shows resonance curves for a gap that is smaller than any tested gap. Below "
        "0.9 Hz there is a series of secondary resonances with left hysteresis. In a left "
        "hysteresis, the curve of the backward sweep is the upper one. Around 1 Hz (right), both "
        "sweeps leave the antisymmetric motion, which is its own mirror image. This motion "
        "continues below them as an unstable motion (dashed green). Both sweeps reach a larger "
        "motion, which never repeats itself at some frequencies (shaded). I and II mark the "
        "frequencies of Fig. 16."
    ),
    draw=draw,
)
