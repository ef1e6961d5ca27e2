"""Resonance curves of several rigs in one panel, as in the paper's Figs. 3, 5, 6, 19 and 20."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal, get_args

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from vibroimpact.arguments import check_name
from vibroimpact.errors import InputError, alternatives
from vibroimpact.figures.assembly_motion import refuse_masses
from vibroimpact.figures.finish import base_label, finished, in_unit
from vibroimpact.figures.jumps import cut_at, draw_arrow, ends_of
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import axes_or_new, check_axes
from vibroimpact.figures.resonance_panels import draws_eta
from vibroimpact.figures.style import FREE, SWEEPS, CurveStyle, fit_x_axis, sweeps_of
from vibroimpact.model.names import literal
from vibroimpact.model.public import public
from vibroimpact.response.resonance import features

Quantity = Literal["eta_a", "eta_d", "acceleration_excursion", "displacement_excursion"]


_QUANTITIES = {
    "eta_a": (1.0, "normalised excursion of\nabsolute acceleration $\\eta_a$ (–)"),
    "eta_d": (1.0, "normalised excursion of\nrelative displacement $\\eta_d$ (–)"),
    "acceleration_excursion": (1.0, "excursion of absolute\nacceleration $E_a$ (m/s²)"),
    "displacement_excursion": (1e3, "excursion of relative\ndisplacement $E_d$ (mm)"),
}
_NORMALISED = {"eta_a": "acceleration_excursion", "eta_d": "displacement_excursion"}

_COLOURS = ("#1f4fbf", "#c05a00", "#00795c", "#b0006d", "#7a3e9d", "#8c6d1f")
_MARKERS = "os^Dv*P<X>phd8"
_LARGER = {"*": 1.45, "P": 1.2, "X": 1.2, "p": 1.2, "h": 1.2}
_MARKS = 16
"""Number of marks on a curve."""
_LEAST_ARROW = 0.03
"""Smallest height of a jump with an arrow, as a share of the height of the panel. A shorter arrow
would consist only of its head."""


@finished
def resonance_family(
    data: xr.Dataset,
    ax: Axes | None = None,
    *,
    quantity: Quantity | None = None,
    labels: Mapping[str, str] | None = None,
    colours: Mapping[str, str] | None = None,
    markers: Mapping[str, int] | None = None,
    free: bool = True,
    legend: bool = True,
    title: str | None = None,
) -> Axes:
    """Draw one quantity of several rigs over the forcing frequency.

    Each rig has its own colour and marker. The forward sweep is a solid line with markers. The
    backward sweep is a dashed line. Arrows show where a sweep jumps.

    Parameters
    ----------
    data
        Dataset of `vibroimpact.sweeps`.
    ax
        Axes to draw on. Default: a new figure.
    quantity
        Quantity on the vertical axis: ``"eta_a"``, ``"eta_d"``, ``"acceleration_excursion"`` or
        ``"displacement_excursion"``. Default: ``"eta_d"`` for published cases, and
        ``"displacement_excursion"`` for other rigs, as in `resonance_curves`.
    labels
        Text in the legend, by the name of the rig. Default: the name of the rig.
    colours
        Colour, by the name of the rig. Default: the colours of the palette in turn.
    markers
        Number of the marker, by the name of the rig. Use it to draw a rig with the same marker in
        several panels that show different rigs. Default: the markers in turn.
    free
        Whether the motion without stops is drawn. It is drawn only if it is the same for all rigs.
    legend
        Whether there is a legend above the axes. `family_legend` returns its entries.
    title
        Title of the figure, if a new one is made.

    Returns
    -------
    Axes
        The axes. Their attribute ``.figure`` is the figure.

    Raises
    ------
    InputError
        If the dataset does not hold sweeps of several rigs, or if the quantity is unknown. Also if
        a label, a colour or a marker belongs to an unknown rig.
    """
    if not isinstance(data, xr.Dataset) or not {"rig", "direction", "frequency"} <= set(data.dims):
        raise InputError(
            "data: these are not sweeps of rigs; pass the result of vibroimpact.sweeps"
        )
    refuse_masses(data, "mass_resonance, one rig at a time, such as data.isel(rig=0)")
    if quantity is None:
        quantity = "eta_d" if draws_eta(data) else "displacement_excursion"
    check_name(quantity, get_args(Quantity), "quantity")
    names = [str(name) for name in data["rig"].values]
    for field, mapping in (("labels", labels), ("colours", colours), ("markers", markers)):
        for name in mapping or {}:
            if name not in names:
                raise InputError(
                    f"{field}: {name!r} is not a rig of data; use {alternatives(names)}"
                )
    ax = axes_or_new(ax, (7.2, 5.2), title)
    factor, label = _QUANTITIES[quantity]
    factor = in_unit(factor)
    frequency = data["frequency"].values
    flight = f"free_{_NORMALISED.get(quantity, quantity)}"
    references = factor * data[flight].values
    if quantity in _NORMALISED:
        references = references / data[f"largest_{flight}"].values[:, np.newaxis]
    values = factor * data[quantity].transpose("rig", "direction", "frequency").values
    highest = max(np.nanmax(values, initial=0.0), references.max() if free else 0.0)
    ax.set_ylim(0.0, 1.06 * (highest or 1.0))
    if free and np.allclose(references, references[0], rtol=1e-9):
        ax.plot(frequency, references[0], label=FREE.label, zorder=2, **FREE.line)
    for i, name in enumerate(names):
        number, colour = (markers or {}).get(name, i), (colours or {}).get(name)
        look = _curve_style((labels or {}).get(name, literal(name)), number, colour)
        _curves(ax, data.isel(rig=i, drop=True), quantity, factor, look, number)
    fit_x_axis(ax, frequency)
    ax.set_xlabel("excitation frequency $f$ (Hz)")
    ax.set_ylabel(base_label(label, [data]))
    if legend:
        add_legend(ax, family_legend(ax), columns=6)
    return ax


@public
def family_legend(ax: Annotated[Axes, check_axes]) -> list[Artist]:
    """Return the legend entries of a `resonance_family`: the rigs in order, then the directions."""
    rigs = [line for line in ax.lines if not str(line.get_label()).startswith("_")]
    dashes = [
        Line2D([], [], color="0.3", linestyle=look.dashes, linewidth=1.2, label=look.label)
        for direction, look in SWEEPS.items()
        if any(line.get_gid() == direction for line in ax.lines)
    ]
    flight = [line for line in rigs if line.get_label() == FREE.label]
    return [*(line for line in rigs if line not in flight), *dashes, *flight]


def _curve_style(label: str, i: int, colour: str | None) -> CurveStyle:
    marker, colour = _MARKERS[i % len(_MARKERS)], colour or _COLOURS[i % len(_COLOURS)]
    # Filled and open in turn: neighbours differ although their markers are small.
    return CurveStyle(label, colour, "-", 1.1, marker, 4.2 * _LARGER.get(marker, 1.0), i % 2 == 0)


def _curves(
    ax: Axes, one: xr.Dataset, quantity: str, factor: float, look: CurveStyle, number: int
) -> None:
    """Draw both directions of one rig. At jumps, arrows replace the curve."""
    frequency = one["frequency"].values
    jumps = [jump for jump in features(one).jumps if jump.settled]
    top = ax.get_ylim()[1]
    every = max(1, len(frequency) // _MARKS)
    # The markers of the rigs stand at different frequencies.
    first = (number * every * 3 // 7) % every
    for direction, how in sweeps_of(one):
        values = factor * one[quantity].sel(direction=direction).values
        mine = [jump for jump in jumps if jump.direction == direction]
        forward = direction == "forward"
        drawn = look._replace(dashes=how.dashes, width=1.1 if forward else 0.9)
        drawn = drawn if forward else drawn._replace(marker="")
        ax.plot(
            *cut_at(frequency, values, mine),
            markeredgewidth=0.9,
            markevery=(first, every),
            label=look.label if forward or len(one["direction"]) == 1 else "_",
            gid=direction,
            zorder=3.5 if forward else 3,
            **drawn.marks(empty="white") | drawn.line,
        )
        for jump in mine:
            start, end = ends_of(frequency, values, jump)
            if abs(end - start) >= _LEAST_ARROW * top:
                style = {"linestyle": "-" if forward else (0, (3, 1.5)), "color": look.colour}
                draw_arrow(ax, jump, (start, end), 6.0, linewidth=0.8, zorder=4, **style)
