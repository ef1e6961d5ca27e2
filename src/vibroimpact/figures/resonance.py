"""Resonance curves, forward and backward, as in the paper's Figs. 4, 7 and 11."""

from __future__ import annotations

from collections.abc import Set
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.transforms import ScaledTranslation
from numpy.typing import NDArray

from vibroimpact.figures.assembly_motion import refuse_masses
from vibroimpact.figures.finish import finished
from vibroimpact.figures.jumps import cut_at, draw_arrow, ends_of
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.measured import halves_of, measured_curves, measured_points
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.resonance_panels import (
    Drawn,
    draws_eta,
    normalised,
    outputs,
    physical_curves,
)
from vibroimpact.figures.style import EDGE, FREE, SHADE, SWEEPS, CurveStyle, panels, sweeps_of
from vibroimpact.measurements.read import as_measured, is_measured
from vibroimpact.response.resonance import Features, Hysteresis, Jump, features

_HATCHES = {"right": "", "left": "/////"}
_LABELS = {
    "right": "right hysteresis (forward above backward)",
    "left": "left hysteresis (backward above forward)",
}
_ARROWS_APART = 5.0
"""Smallest distance between a forward and a backward arrow, in points."""
_MARKS = 60
"""Number of marks of non-periodic motions that fit side by side."""

_PLAIN = {"marker": "none"}
"""Style of a curve below measured points: without marks, which could be confused with the
points."""


@finished
def resonance_curves(
    data: xr.Dataset,
    axes: Any = None,
    *,
    curve_features: Features | None = None,
    title: str | None = None,
    physical: bool | None = None,
    measured: xr.Dataset | None = None,
) -> Panels:
    """Draw resonance curves: η_a and η_d, or physical quantities, over the forcing frequency.

    If a force on the mass shakes the rig, a further panel shows how much of it is transmitted to
    the base: the transmissibility, or in physical units the largest transmitted force.

    The forward sweep is a solid red line with dots. The backward sweep is a dashed blue line with
    squares. The motion without stops is black. Vertical arrows mark the jumps of a sweep. Ranges
    with hysteresis are shaded; ranges with left hysteresis are also hatched. Crosses mark motions
    that did not become periodic. If many such motions are close together, some crosses are omitted.
    In physical units, dotted lines are the gaps. Own outputs have further panels.

    Parameters
    ----------
    data
        Dataset of `vibroimpact.sweep`, one rig of a dataset of `vibroimpact.sweeps`, or measured
        curves.
    axes
        Axes to draw on: two for η_a and η_d, or one per physical quantity; and one for each own
        output. Default: a new figure.
    curve_features
        Features (resonances, jumps and hysteresis) that are marked. Default: the features are
        computed from the curves.
    title
        Title of the figure, if a new one is made.
    physical
        Whether physical quantities are drawn instead of η_a and η_d. They are the largest absolute
        acceleration (g), the largest displacement (mm) and, if a stop is touched, the largest
        contact force. For rigid stops the largest impulse replaces the force. Default: η_a and η_d
        for a published case, and physical quantities for study files and other rigs; also if the
        motion without stops is unbounded, because then η has no meaning.
    measured
        Measured curves of `vibroimpact.read_measurement`, which are drawn as open points over the
        computed curves. Their excursions are divided by the excursions of the computed rig without
        stops. In physical units, if maxima and minima were not measured, half the excursion is
        drawn for both the measured and the computed curves.

    Returns
    -------
    tuple of Axes
        The Axes of η_a and η_d, or of acceleration, displacement and forces; then those of own
        outputs. ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If the dataset does not hold the sweep of one rig, or if the number of axes is wrong.
    """
    refuse_masses(data, "mass_resonance")
    if is_measured(data) and "motion" not in data:
        return measured_curves(data, axes, title=title)
    curve_features = features(data) if curve_features is None else curve_features
    if measured is not None:
        measured = as_measured(measured, "measured")
    if physical is None:
        physical = not draws_eta(data)
    halves = halves_of(measured) if measured is not None else set()
    drawn = physical_curves(data, halves) if physical else normalised(data)
    names = [one.name for one in drawn]
    drawn += outputs(data)
    what = " and ".join(one.name for one in drawn)
    panel_axes = panels(axes, len(drawn), what, (7.2, 0.4 + 3.2 * len(drawn)), title)
    for ax, one in zip(panel_axes, drawn, strict=True):
        _panel(ax, data, curve_features, one, marked=measured is None)
        ax.set_ylabel(one.label)
    upper = panel_axes[0]
    panel_axes[-1].set_xlabel("excitation frequency $f$ (Hz)")
    frequency = data["frequency"].values
    sides = {
        _side(frequency, one, item)
        for one in drawn
        for item in curve_features.hysteresis
        if item.settled
    }
    entries = _legend(data, sides, marked=measured is None)
    entries += [line.entry() for one in drawn for line in one.levels]
    if measured is not None:
        entries += measured_points(panel_axes[: len(names)], names, data, measured)
    add_legend(upper, entries, columns=2 if len(entries) <= 4 else 3)
    return panel_axes


def _side(frequency: NDArray[np.float64], drawn: Drawn, item: Hysteresis) -> str:
    """Return which sweep lies above in a panel: it may differ between the two panels."""
    within = (frequency >= item.low) & (frequency <= item.high)
    apart = drawn.curves["forward"][within] - drawn.curves["backward"][within]
    total = float(np.nansum(apart))
    return item.side if total == 0.0 else "right" if total > 0.0 else "left"


def _panel(
    ax: Axes, data: xr.Dataset, curve_features: Features, drawn: Drawn, *, marked: bool
) -> None:
    frequency = data["frequency"].values
    margin = 0.02 * (frequency[-1] - frequency[0]) or 0.05 * frequency[0]
    ax.set_xlim(frequency[0] - margin, frequency[-1] + margin)
    ax.set_ylim(1.06 * drawn.bottom, 1.06 * drawn.top)

    for item in curve_features.hysteresis:
        if item.settled:
            ax.axvspan(
                *item.ends,
                facecolor=SHADE,
                edgecolor=EDGE,
                lw=0.0,
                hatch=_HATCHES[_side(frequency, drawn, item)],
                zorder=0,
            )
    for level in drawn.levels:
        ax.axhline(level.value, label=level.label, zorder=1, **level.style)
    if drawn.free is not None:
        ax.plot(frequency, drawn.free, label=FREE.label, zorder=2, **FREE.line)
    # Of a part of a sweep its own jumps alone.
    jumps = [
        jump
        for jump in curve_features.jumps
        if jump.settled and {jump.before, jump.after} <= set(frequency)
    ]
    for layer, (direction, look) in enumerate(sweeps_of(data)):
        mine = [jump for jump in jumps if jump.direction == direction]
        values = drawn.curves[direction]
        x, y = cut_at(frequency, values, mine)
        style = look.curve(len(x)) | ({} if marked else _PLAIN)
        wild = data["motion"].sel(direction=direction).values != "periodic"
        if wild.any():  # its marks would hide the crosses
            first, every = style["markevery"]
            hidden = np.isin(x, frequency[wild])
            style["markevery"] = [i for i in range(first, len(x), every) if not hidden[i]]
        ax.plot(x, y, label=look.label, zorder=3 + layer, **style)
        loose = _thinned(frequency, wild)
        if len(loose):
            style = {"zorder": 5 + layer, **_loose_style(look)}
            ax.plot(frequency[loose], values[loose], **style)
    _draw_jumps(ax, frequency, drawn, jumps)


def _loose_style(look: CurveStyle) -> dict[str, Any]:
    """Return keywords of `Axes.plot` for crosses that can be distinguished even if they overlap."""
    style = look.cross(8.0 if look.filled else 12.0)
    return {**style, "markeredgewidth": 1.8, "label": f"{look.label}, not settled"}


def _thinned(frequency: NDArray[np.float64], where: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Return the indices of some of the true values, so that marks do not overlap."""
    least = (frequency[-1] - frequency[0]) / _MARKS
    kept: list[int] = []
    for i in np.flatnonzero(where):
        if not kept or frequency[i] - frequency[kept[-1]] >= least:
            kept.append(int(i))
    return np.array(kept, dtype=np.intp)


def _draw_jumps(ax: Axes, frequency: NDArray[np.float64], drawn: Drawn, jumps: list[Jump]) -> None:
    """Draw vertical arrows from value to value, half-way between the two frequencies of a jump."""
    box = ax.get_window_extent()
    points = 72.0 / ax.figure.dpi
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    per_hertz = box.width * points / (right - left)
    per_unit = box.height * points / (top - bottom)
    for jump in jumps:
        ends = ends_of(frequency, drawn.curves[jump.direction], jump)
        # Arrows of a narrow hysteresis would cover each other: move them apart a little, the
        # lower frequency to the left.
        others = [o.frequency for o in jumps if o.direction != jump.direction]
        away = min((jump.frequency - f for f in others), key=abs, default=np.inf) * per_hertz
        tie = 1.0 if jump.direction == "forward" else -1.0
        shift = 0.5 * max(0.0, _ARROWS_APART - abs(away)) * (np.sign(away) or tie)
        aside = ScaledTranslation(shift / 72.0, 0.0, ax.figure.dpi_scale_trans)
        draw_arrow(
            ax,
            jump,
            ends,
            # The head of a short arrow must leave some of its shaft.
            float(np.clip(0.7 * abs(ends[1] - ends[0]) * per_unit, 4.0, 11.0)),
            transform=ax.transData + aside,
            linewidth=1.2,
            color=SWEEPS[jump.direction].colour,
            zorder=7,
            label=f"{jump.direction} jump {'up' if jump.upward else 'down'}",
        )


def _legend(data: xr.Dataset, sides: Set[str], *, marked: bool) -> list[Artist]:
    """Return a legend entry for each visible element."""
    entries: list[Artist] = []
    loose: list[Artist] = []
    for direction, look in sweeps_of(data):
        style = look.curve(1) | ({} if marked else _PLAIN)
        entries.append(Line2D([], [], label=look.label, **style))
        if (data["motion"].sel(direction=direction) != "periodic").any():
            loose.append(Line2D([], [], **_loose_style(look)))
    entries.append(Line2D([], [], label=FREE.label, **FREE.line))
    entries += [
        Patch(facecolor=SHADE, edgecolor=EDGE, lw=0.0, hatch=_HATCHES[side], label=_LABELS[side])
        for side in ("right", "left")
        if side in sides
    ]
    return [*entries, *loose]
