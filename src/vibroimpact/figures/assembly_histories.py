"""Time histories of several masses, and the forces of their stops."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from vibroimpact.arguments import check_name
from vibroimpact.engine.stops.rebound import restitutions
from vibroimpact.figures.assembly_motion import (
    History,
    chosen,
    contact_legend,
    draw_contacts,
    history,
    label_values,
    rows_of_panels,
    touching,
)
from vibroimpact.figures.finish import base_label, finished, in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.record import impact_entry, mark_end
from vibroimpact.figures.style import EDGE
from vibroimpact.model.names import literal
from vibroimpact.model.quantities import FORCE, GRAVITY, IMPULSE

Quantity = Literal["displacement", "velocity", "acceleration"]
LABELS: dict[str, tuple[float, str]] = {
    "displacement": (1e3, "relative displacement (mm)"),
    "velocity": (1.0, "relative velocity (m/s)"),
    "acceleration": (1.0 / GRAVITY, "absolute acceleration (g)"),
}
"""Factor and label of the histories of masses."""


@finished
def mass_histories(
    motion: xr.Dataset,
    axes: Any = None,
    *,
    quantity: Quantity = "displacement",
    masses: Sequence[str] | None = None,
    closing: Sequence[str] = (),
    cycles: float | None = None,
    title: str | None = None,
) -> Panels:
    """Draw the history of each mass of an assembly in a panel of its own, all to one scale.

    Each contact is a band between its exact start and end in the panels of the masses that it
    joins. If several stops of a mass are touched, each has its own strip of the panel. Dots are
    impacts on rigid stops; of an acceleration, which is infinite there, they are left out. A dotted
    line is the end of a record.

    Parameters
    ----------
    motion
        Dataset of `simulate`, `steady` or `orbit` with samples, of a rig with an `Assembly`.
    axes
        One Axes per mass, and one per stop of ``closing``. Default: a new figure.
    quantity
        ``"displacement"`` and ``"velocity"`` are relative to the base; ``"acceleration"`` is
        absolute.
    masses
        Names of the masses that are drawn, from the top. Default: all, in the order of the
        assembly.
    closing
        Names of stops whose closing displacement u_left − u_right has a panel below the masses,
        with the gap as a dashed line. Default: none.
    cycles
        Number of forcing cycles that are drawn, up to the end of the motion. Default: all.
    title
        Title of the figure, if a new one is made.

    Returns
    -------
    tuple of Axes
        One Axes per mass, and one per stop of ``closing``. ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If the dataset does not hold such a motion, or if a quantity or a mass does not exist.
    """
    shown = history(motion, cycles)
    check_name(quantity, LABELS, "quantity")
    names = chosen(masses, shown.assembly.names, "mass", "masses")
    pairs = chosen(closing, tuple(shown.assembly.stops), "stop", "closing") if closing else []
    every = rows_of_panels(axes, [*names, *pairs], title)
    mass_axes, below = Panels(every[: len(names)]), every[len(names) :]
    factor, label = LABELS[quantity]
    factor, label = in_unit(factor), base_label(label, [motion])
    dots = False
    for ax, name in zip(below, pairs, strict=True):
        _closing(ax, shown, name)
    for ax, name in zip(mass_axes, names, strict=True):
        values = factor * shown.motion[quantity].sel(mass=name).values
        stops = touching(shown.assembly, name)
        draw_contacts(ax, shown, [stop for stop in stops if shown.contacts(stop)])
        ax.axhline(0.0, color=EDGE, linewidth=0.6, zorder=1)
        ax.plot(shown.at, values, color="black", linewidth=0.9, zorder=3)
        if quantity != "acceleration":
            for hit in (shown.hits(stop) for stop in stops):
                seen = factor * motion[f"event_{quantity}"].sel(mass=name).values[hit]
                ax.scatter(shown.event_at[hit], seen, s=9, color="black", zorder=4)
                dots = dots or len(hit) > 0
    share_scale(mass_axes)
    alike = quantity == "displacement"  # a closing displacement is one between two masses
    label_values(every if alike else mass_axes, axes, label)
    for ax in [] if alike else below:
        ax.set_ylabel("closing (mm)")
    for ax in every:
        ax.set_xlim(*shown.span)
        ax.yaxis.set_major_locator(MaxNLocator(4, min_n_ticks=3, steps=[1, 2, 2.5, 5, 10]))
    every[-1].set_xlabel(shown.label)
    of_shown = {stop for name in names for stop in touching(shown.assembly, name)}
    entries = contact_legend(
        shown.assembly, [s for s in shown.touched() if s in of_shown and shown.contacts(s)]
    )
    if dots:
        entries.append(impact_entry())
    entries += mark_end(every, motion)
    if entries:
        add_legend(mass_axes[0], entries)
    return every


def _closing(ax: Axes, shown: History, name: str) -> None:
    """Draw the closing displacement of a stop, with its gap."""
    stop = shown.assembly.stops[name]
    moved = shown.motion["displacement"].transpose(..., "mass").values
    closing = moved @ shown.assembly.closing(stop)
    draw_contacts(ax, shown, [name])
    ax.axhline(0.0, color=EDGE, linewidth=0.6, zorder=1)
    ax.axhline(in_unit(1e3) * stop.stop.gap, color="black", linestyle="--", linewidth=0.8, zorder=2)
    ax.plot(shown.at, in_unit(1e3) * closing, color="black", linewidth=0.9, zorder=3)
    words = literal(f"{name}: closing (dashed: gap)")
    ax.set_title(words, loc="left", fontsize="small")


def share_scale(panel_axes: Panels) -> None:
    """Give panels the same vertical limits."""
    limits = np.array([ax.get_ylim() for ax in panel_axes])
    for ax in panel_axes:
        ax.set_ylim(limits[:, 0].min(), limits[:, 1].max())


@finished
def contact_forces(
    motion: xr.Dataset,
    axes: Any = None,
    *,
    stops: Sequence[str] | None = None,
    cycles: float | None = None,
    title: str | None = None,
) -> Panels:
    """Draw the contact force of each stop of an assembly over time, in a panel of its own.

    An impact on a rigid stop has no finite force. The panel of a rigid stop shows the impulse of
    each impact as a line, (1 + e) m* times the closing speed, and bands of rest in contact. If
    another body rests against one of the two bodies, the impulse differs from this value.

    Parameters
    ----------
    motion
        Dataset of `simulate`, `steady` or `orbit` with samples, of a rig with an `Assembly`.
    axes
        One Axes per stop. Default: a new figure.
    stops
        Names of the stops that are drawn, from the top. Default: all, in the order of the assembly.
    cycles
        Number of forcing cycles that are drawn, up to the end of the motion. Default: all.
    title
        Title of the figure, if a new one is made.

    Returns
    -------
    tuple of Axes
        One Axes per stop. ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If the dataset does not hold such a motion, or if a stop does not exist.
    """
    shown = history(motion, cycles)
    parts = shown.assembly.stops
    names = chosen(stops, tuple(parts), "stop", "stops")
    panel_axes = rows_of_panels(axes, names, title)
    struck = {
        name: impulses(motion, shown.assembly, name)[shown.hits(name)]
        for name in names
        if parts[name].stop.rigid
    }
    pushed = {
        name: shown.motion["contact_force"].sel(stop=name).values
        for name in names
        if name not in struck
    }
    force = FORCE.unit(*(float(np.nanmax(one, initial=0.0)) for one in pushed.values()))
    impulse = IMPULSE.unit(*(float(one.max(initial=0.0)) for one in struck.values()))
    for ax, name in zip(panel_axes, names, strict=True):
        draw_contacts(ax, shown, [name])
        if name in struck:
            at = shown.event_at[shown.hits(name)]
            height = struck[name] / impulse.size
            ax.vlines(at, 0.0, height, color="#c8102e", linewidth=1.0, zorder=3)
            ax.plot(at, height, "o", color="#c8102e", markersize=3.0, zorder=4)
            ax.set_ylabel(f"impulse ({impulse.symbol})")
        else:
            ax.plot(shown.at, pushed[name] / force.size, color="#c8102e", linewidth=0.9, zorder=3)
            ax.set_ylabel(f"contact force ({force.symbol})")
        ax.set_xlim(*shown.span)
    for group in (struck, pushed):
        alike = Panels([ax for ax, name in zip(panel_axes, names, strict=True) if name in group])
        if alike:
            highest = max(ax.get_ylim()[1] for ax in alike)
            for ax in alike:
                ax.set_ylim(0.0, highest)
    panel_axes[-1].set_xlabel(shown.label)
    pressed = [name for name in names if shown.contacts(name)]
    entries = [*contact_legend(shown.assembly, pressed), *mark_end(panel_axes, motion)]
    if entries:
        add_legend(panel_axes[0], entries)
    return panel_axes


def impulses(motion: xr.Dataset, assembly: Any, stop: str) -> Any:
    """Return the impulse of a rigid stop at each event (N s), (1 + e) m* times the closing speed.

    It applies to events that are impacts of this stop.
    """
    part = assembly.stops[stop]
    closing = motion["event_velocity"].values @ assembly.closing(part)
    speed = np.maximum(closing, 0.0)
    e = restitutions(part.law.engine_numbers(), speed)
    return (1.0 + e) * assembly.meeting_mass(part) * speed
