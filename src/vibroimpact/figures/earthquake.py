"""A record and the response of a rig, on one page."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from vibroimpact.errors import InputError
from vibroimpact.figures.figure_dimensions import columns_that_fit, size_of_new
from vibroimpact.figures.finish import acceleration_text, finished, in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import DrawnMotion, drawn_motions, named
from vibroimpact.figures.notebook import NotebookFigure, Panel, Panels
from vibroimpact.figures.record import contact_bands, gap_lines, mark_end, stops_legend, stops_of
from vibroimpact.figures.style import CURVES, EDGE, CurveStyle, also_in_g, fit_x_axis, note_peak
from vibroimpact.model import GRAVITY
from vibroimpact.model.names import literal
from vibroimpact.model.quantities import FORCE, fitting
from vibroimpact.model.written_units import unit
from vibroimpact.response.motion_phases import recorded

_MARKS = {
    "right": CurveStyle("hits the right stop", "#c8102e", "", 0.0, "^", 4.5, True),
    "left": CurveStyle("hits the left stop", "#1f4fbf", "", 0.0, "v", 4.5, True),
}
"""Marks of impacts on the right stop and on the left stop."""


@finished
def earthquake_page(
    motion: xr.Dataset,
    spectra: Mapping[str, xr.Dataset] | None = None,
    *,
    title: str | None = None,
) -> Panels:
    """Draw the motion of a rig through a record, on one page.

    The page has these panels:

    - the record;
    - the displacement between the stops;
    - the absolute acceleration, with a triangle at the start of each contact;
    - the force of isolator and stops over the displacement;
    - response spectra, if they are passed.

    The largest absolute values of the record, the displacement, the acceleration and the force are
    marked and written. At an impact on a rigid stop the force is infinite, so the largest force is
    that between impacts.

    Parameters
    ----------
    motion
        Dataset of `simulate` through a `Record`, with samples.
    spectra
        Response spectra, as a mapping from names to datasets of `response_spectrum` with one
        damping ratio. Examples are the spectra of the ground and of the mass (`floor_record`).
        Default: the page has no panel of spectra.
    title
        Title of the page.

    Returns
    -------
    tuple of Axes
        The Axes of the record, the displacement, the acceleration, the force and, if they are
        passed, the spectra. ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If the dataset does not hold a motion through a record, or if a spectrum is invalid.
    """
    stops = stops_of(motion)
    beside = columns_that_fit(2) > 1 or not spectra
    size = (7.2, 9.4) if beside else (7.2, 12.0)
    figure = NotebookFigure(figsize=size_of_new(size), layout="constrained")
    heights = [1.0, 1.4, 1.4, 1.9, *([] if beside else [1.7])]
    grid = figure.add_gridspec(len(heights), 2, height_ratios=heights)
    new: dict[str, Any] = {"axes_class": Panel}
    base = figure.add_subplot(grid[0, :], **new)
    others = [figure.add_subplot(grid[row, :], sharex=base, **new) for row in (1, 2)]
    last = [figure.add_subplot(grid[3, 0] if spectra and beside else grid[3, :], **new)]
    if spectra:
        last.append(figure.add_subplot(grid[3, 1] if beside else grid[4, :], **new))
    (curve,) = drawn_motions(named(motion, records=True))
    _histories((base, *others), motion, curve, stops)
    _force(last[0], motion, curve)
    if spectra:
        _spectra(last[1], spectra)
    figure.align_ylabels([base, *others])
    if title:
        figure.suptitle(title)
    return Panels((base, *others, *last))


def _histories(
    axes: tuple[Axes, ...], motion: xr.Dataset, curve: DrawnMotion, stops: dict[str, dict[str, Any]]
) -> None:
    base, moved, shaken = axes
    time = motion["time"].values
    for ax in axes:
        ax.axhline(0.0, color=EDGE, linewidth=0.6, zorder=1)
    base.plot(time, motion["base_acceleration"].values, color="black", linewidth=0.7)
    base.set_ylabel("base acceleration\n$A_t$ (m/s²)")
    base.set_xlim(time[0], time[-1])
    ground = motion["base_acceleration"].values
    at = int(np.abs(ground).argmax())
    note_peak(base, time[at], ground[at], acceleration_text(ground[at]))
    for ax, variable, factor in (
        (moved, "displacement", in_unit(1e3)),
        (shaken, "acceleration", 1.0),
    ):
        ax.plot(curve.at, factor * curve.values[variable], color="black", linewidth=0.8, zorder=3)
        contact_bands(ax, motion)
    moved.set_ylabel("relative\ndisplacement $u$ (mm)")
    shaken.set_ylabel("absolute acceleration\n$\\ddot u + A_t$ (m/s²)")
    shaken.set_xlabel("time (s)")
    also_in_g(base)
    also_in_g(shaken)
    for ax in (base, moved):
        ax.tick_params(labelbottom=False)
    gap_lines(moved, stops)
    for ax, variable, factor in (
        (moved, "displacement", in_unit(1e3)),
        (shaken, "acceleration", 1.0),
    ):
        values = factor * curve.values[variable]
        at = int(np.nanargmax(np.abs(values)))
        size = float(values[at])
        words = acceleration_text(size) if "acc" in variable else f"{size:.4g}{unit(' mm')}"
        note_peak(ax, float(curve.at[at]), size, words)
    handles = [*stops_legend(stops, motion), *mark_end(axes, motion)]
    begun = motion["event_contact"].values >= 1
    for side, look in _MARKS.items():
        here = begun & (motion["event_stop"].values == side)
        if here.any():
            shaken.plot(
                motion["event_time"].values[here],
                motion["event_acceleration_after"].values[here],
                markeredgecolor="white",
                markeredgewidth=0.4,
                zorder=4,
                **look.marks(),
            )
            handles.append(Line2D([], [], label=look.label, **look.marks()))
    if handles:
        add_legend(moved, handles, columns=5, columnspacing=1.0)


def _force(ax: Axes, motion: xr.Dataset, curve: DrawnMotion) -> None:
    """Draw the restoring force of isolator and stops. Its loops are the dissipated energy."""
    rig = recorded(motion, records=True).oscillator
    pull = rig.force - rig.mass * curve.values["acceleration"]
    _, scale, symbol = fitting([float(np.abs(pull).max())], FORCE.scales)
    for zero in (ax.axhline, ax.axvline):
        zero(0.0, color="0.7", linewidth=0.6, zorder=0)
    ax.plot(in_unit(1e3) * curve.values["displacement"], pull / scale, color="black", linewidth=0.6)
    for side, gap in curve.gaps.items():
        at = in_unit(1e3) * gap * (1.0 if side == "right" else -1.0)
        ax.axvline(at, color="black", linestyle="--", linewidth=0.8, zorder=1)
    at = int(np.nanargmax(np.abs(pull)))
    size = float(pull[at]) / scale
    place = in_unit(1e3) * float(curve.values["displacement"][at])
    note_peak(ax, place, size, f"{size:.4g} {symbol}".rstrip())
    ax.set_xlabel("relative displacement $u$ (mm)")
    ax.set_ylabel(f"force of isolator and stops ({symbol})")


def _spectra(ax: Axes, spectra: Mapping[str, xr.Dataset]) -> None:
    for i, (name, spectrum) in enumerate(spectra.items()):
        if "spectral_acceleration" not in spectrum or spectrum["spectral_acceleration"].ndim != 1:
            raise InputError(
                f"spectra[{name!r}]: this is not a response spectrum over the period; pass the "
                "result of response_spectrum for several periods and one damping ratio"
            )
        ax.plot(
            spectrum["natural_period"].values,
            spectrum["spectral_acceleration"].values * in_unit(1.0 / GRAVITY),
            **CURVES[i % 4]._replace(width=1.2).line,
            label=f"{literal(str(name))}, $\\zeta$ = {float(spectrum['damping_ratio']):g}",
        )
    periods = next(iter(spectra.values()))["natural_period"].values
    ax.set_xscale("log")
    ax.xaxis.set_major_formatter("{x:g}")
    fit_x_axis(ax, periods)
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel("natural period (s)")
    ax.set_ylabel("spectral acceleration (g)")
    ax.grid(True, which="major", linewidth=0.4, color="0.85")
    add_legend(ax, columns=2, columnspacing=1.0)
