"""Common parts of figures of several masses: the assembly of a dataset, contacts, and panels."""

from __future__ import annotations

import json
import math
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import NDArray

from vibroimpact.engine.observers.record import IMPACT
from vibroimpact.errors import InputError
from vibroimpact.figures.figure_dimensions import columns_that_fit
from vibroimpact.figures.finish import without_unit
from vibroimpact.figures.notebook import Panels, new_axes
from vibroimpact.figures.style import BANDS, Band, panels
from vibroimpact.model import Assembly
from vibroimpact.model.assembly.names import GROUND, check_known
from vibroimpact.model.names import literal
from vibroimpact.model.written_units import unitless
from vibroimpact.response.motion_phases import contact_intervals

_Array = NDArray[np.float64]

_PAGE = 7.2
"""Width of a new figure in inches."""


def assembly_of(data: Any, what: str, *required: str) -> Assembly:
    """Return the assembly of a dataset that has the required variables, dims or attributes.

    Raises
    ------
    InputError
        If there is none. The message begins with `what`: ``"motion: … the result of simulate"``.
    """
    parameters = json.loads(getattr(data, "attrs", {}).get("parameters", "{}"))
    table = parameters.get("rigs", [parameters])[0].get("assembly")
    if (
        not isinstance(data, xr.Dataset)
        or table is None
        or not set(required) <= {*data.data_vars, *data.dims, *data.attrs}
    ):
        raise InputError(f"{what} of a Rig with an Assembly of several masses")
    return Assembly.model_validate(table)


class History(NamedTuple):
    """The motion of an assembly as it is drawn: over t/T, or over seconds of a record."""

    assembly: Assembly
    motion: xr.Dataset
    """The samples that are drawn."""
    at: _Array
    """Time of each sample: in forcing cycles, or in seconds."""
    label: str
    """Label of the time axis."""
    event_at: _Array
    """Time of each event, in the same unit."""

    @property
    def span(self) -> tuple[float, float]:
        """First and last time."""
        return float(self.at[0]), float(self.at[-1])

    def seconds(self, at: _Array) -> _Array:
        """Return the time of the dataset (s) at times of the axis."""
        return np.asarray(np.interp(at, self.at, self.motion["time"].values))

    def contacts(self, stop: str) -> list[tuple[float, float]]:
        """Return starts and ends of the contacts of a stop, cut to what is drawn."""
        return contact_spans(self.motion, stop, self.event_at, self.span)

    def hits(self, stop: str) -> NDArray[np.intp]:
        """Return the indices of the impacts on a rigid stop that are drawn."""
        mine = (self.motion["event_stop"].values == stop) & (
            self.motion["event_contact"].values == IMPACT
        )
        first, last = self.span
        return np.flatnonzero(mine & (self.event_at >= first) & (self.event_at <= last))

    def touched(self) -> list[str]:
        """Return the stops that are touched in what is drawn, in the order of the assembly."""
        return [name for name in self.assembly.stops if self.contacts(name) or len(self.hits(name))]


def contact_spans(
    motion: xr.Dataset, stop: str, at: _Array, span: tuple[float, float]
) -> list[tuple[float, float]]:
    """Return starts and ends of the contacts with one stop, even if one lasts the whole motion.

    Parameters
    ----------
    at
        When each event is.
    span
        When the motion begins and ends.
    """
    first, last = span
    intervals = contact_intervals(motion, stop, at, last).tolist()
    return [(max(begin, first), end) for begin, end in intervals if end >= first]


def history(motion: Any, cycles: float | None = None) -> History:
    """Return the motion of an assembly as it is drawn: its last cycles, or through a whole record.

    Raises
    ------
    InputError
        If it is not the motion of an assembly with samples, or if `cycles` is invalid.
    """
    what = "motion: this is not a motion with samples; pass the result of simulate, steady or orbit"
    assembly = assembly_of(motion, what)
    if "event_stop" not in motion or not motion.sizes.get("time"):
        raise InputError(f"{what}, with samples greater than 0")
    if cycles is not None and not 0.0 < cycles < math.inf:
        raise InputError(f"cycles: {cycles!r}; use a finite number greater than 0")
    if "cycle" not in motion:
        at, events = motion["time"].values, motion["event_time"].values
        return History(assembly, motion, at, "time (s)", events)
    at = motion["cycle"].values
    period = motion["time"].values[-1] / at[-1] if at[-1] > 0.0 else 1.0
    events = motion["event_cycle"].values + motion["event_cycle_time"].values / period
    if cycles is not None:
        kept = at >= at[-1] - cycles - 1e-9
        motion, at = motion.isel(time=kept), at[kept]
    return History(assembly, motion, at, "time in forcing cycles $t/T$ (–)", events)


def touching(assembly: Assembly, mass: str) -> list[str]:
    """Return the names of the stops of a mass."""
    return [name for name, stop in assembly.stops.items() if mass in (stop.left, stop.right)]


def band_of(assembly: Assembly, stop: str) -> Band:
    """Return the style of the contacts of a stop."""
    return BANDS[list(assembly.stops).index(stop) % len(BANDS)]


def draw_contacts(ax: Axes, shown: History, stops: list[str]) -> None:
    """Draw the contacts of some stops as bands: one strip of the panel for each stop."""
    for i, name in enumerate(stops):
        band_of(shown.assembly, name).draw(ax, shown.contacts(name), (i, len(stops)))


def contact_legend(assembly: Assembly, stops: list[str]) -> list[Any]:
    """Return the legend entries of the bands of some stops."""
    return [band_of(assembly, name).entry(f"contact, {literal(name)}") for name in stops]


def refuse_masses(data: Any, instead: str) -> None:
    """Refuse a dataset of several masses, and name the figure that draws it.

    Raises
    ------
    InputError
        If the dataset is of an assembly.
    """
    if isinstance(data, xr.Dataset) and {"mass", "stop"} <= set(data.dims):
        raise InputError(
            f"data: it is of an Assembly of several masses; draw it with figures.{instead}"
        )


def chosen(choice: Any, names: tuple[str, ...], what: str, field: str) -> list[str]:
    """Return the names that were passed, checked, or all of them.

    Raises
    ------
    InputError
        If a name does not exist, or if there is none.
    """
    if choice is None:
        selection = list(names)
    else:
        listed = [choice] if isinstance(choice, str) else list(choice)
        selection = [check_known(name, names, what, field) for name in listed]
    if not selection:
        raise InputError(f"{field}: empty; pass the name of at least one {what}")
    return selection


def rows_of_panels(axes: Any, names: list[str], title: str | None) -> Panels:
    """Return one panel for each name below each other, with the name above its left end."""
    size = (_PAGE, 0.8 + 1.45 * len(names))
    made = panels(axes, len(names), "one for each name", size, title)
    return name_panels(made, names)


def grid_of_panels(axes: Any, names: list[str], title: str | None) -> Panels:
    """Return one panel for each name: two side by side if there are many and if they fit."""
    count = len(names)
    if axes is not None:
        return name_panels(panels(axes, count, "one for each name", (_PAGE, _PAGE), title), names)
    columns = min(columns_that_fit(2), 2) if count > 2 else 1
    rows = -(-count // columns)
    made = new_axes(rows, columns, (_PAGE, 0.8 + 1.75 * rows), sharex=True)
    for unused in made.ravel()[count:]:
        unused.remove()
    panel_axes = Panels(made.ravel()[:count])
    for above in panel_axes[count - columns :]:  # those without a panel below them
        above.tick_params(labelbottom=True)
    if title:
        panel_axes[0].figure.suptitle(title)
    return name_panels(panel_axes, names)


def name_panels(made: Panels, names: list[str]) -> Panels:
    """Write the name of each panel above its left end."""
    for ax, name in zip(made, names, strict=True):
        ax.set_title(literal(name), loc="left", fontsize="small")
    return made


def label_values(panel_axes: Panels, axes: Any, label: str) -> None:
    """Label the vertical axes: those of a new figure, which have one scale, once for all."""
    figure = panel_axes[0].get_figure(root=True)
    if axes is None and figure is not None and len(panel_axes) > 1:
        words = without_unit(label) if unitless() else label
        figure.supylabel(words, fontsize=panel_axes[0].yaxis.label.get_fontsize())
    else:
        for ax in panel_axes:
            ax.set_ylabel(label)


def label_each(panel_axes: Panels, axes: Any, labels: list[str]) -> None:
    """Label the vertical axes: once for all panels of a new figure, if the labels are the same."""
    if len(set(labels)) == 1:
        label_values(panel_axes, axes, " ".join(labels[0].split("\n")))
        return
    for ax, label in zip(panel_axes, labels, strict=True):
        ax.set_ylabel(label)


def chains(assembly: Assembly) -> list[list[tuple[str, str]]]:
    """Return the masses in rows from the ground upwards, each with the body below it.

    A row begins with a mass that no link joins to an earlier mass. Masses without links, such as
    those of matrices, are one row.
    """
    names = assembly.names
    if not assembly.links:
        return [list(zip(names, (GROUND, *names[:-1]), strict=True))]
    rows: list[list[tuple[str, str]]] = []
    for i, name in enumerate(names):
        joined = {
            one.left if one.right == name else one.right
            for one in assembly.links.values()
            if name in (one.left, one.right)
        }
        earlier = [other for other in names[:i] if other in joined]
        if earlier:
            row = next((row for row in rows if row[-1][0] == earlier[-1]), None)
            if row is None:
                rows.append(row := [])
            row.append((name, earlier[-1]))
        else:
            rows.append([(name, GROUND)])
    return rows
