"""Common parts of all figures: colours, marks, panels and files."""

from __future__ import annotations

import io
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib import rcParams
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from numpy.typing import ArrayLike, NDArray

from vibroimpact.datasets.files import write_whole
from vibroimpact.errors import InputError
from vibroimpact.figures.figure_dimensions import columns_that_fit
from vibroimpact.figures.notebook import EMBEDDED, NotebookFigure, Panels, new_axes
from vibroimpact.model import GRAVITY
from vibroimpact.model.argument_types import File, Positive
from vibroimpact.model.public import public
from vibroimpact.model.written_units import unitless

FORMATS = ("png", "pdf", "svg")
_SCREEN, _PRINT, _MOST_DPI = 200.0, 600.0, 2400.0
"""Pixels per inch."""


class CurveStyle(NamedTuple):
    """Style of one kind of curve. Markers and dashes distinguish it even without colour."""

    label: str
    colour: str
    dashes: Any
    width: float
    marker: str
    size: float
    filled: bool

    @property
    def line(self) -> dict[str, Any]:
        """Keywords of `Axes.plot` for a line without marks."""
        return {"color": self.colour, "linestyle": self.dashes, "linewidth": self.width}

    def marks(self, share: float = 1.0, *, empty: str = "none") -> dict[str, Any]:
        """Return the keywords of `Axes.plot` for marks without a line.

        Their size is multiplied by `share`, and open marks have the colour `empty` inside.
        """
        return {
            "color": self.colour,
            "linestyle": "",
            "marker": self.marker,
            "markersize": share * self.size,
            "markerfacecolor": self.colour if self.filled else empty,
        }

    def cross(self, size: float = 6.0) -> dict[str, Any]:
        """Return the keywords of `Axes.plot` for crosses: × with filled marks, + with open ones."""
        marker = "x" if self.filled else "+"
        return {"color": self.colour, "linestyle": "", "marker": marker, "markersize": size}

    def curve(self, points: int, marks: int = 45) -> dict[str, Any]:
        """Return the keywords of `Axes.plot` for a curve of `points` with about so many marks."""
        every = max(1, points // marks)
        # Open markers half-way between the filled ones, where both cannot be at every point.
        first = 0 if self.filled else every // 2
        each = {"markeredgewidth": 0.9, "markevery": (first, every)}
        return self.marks() | self.line | each


SWEEPS = {
    "forward": CurveStyle("forward sweep", "#c8102e", "-", 1.6, "o", 3.6, True),
    "backward": CurveStyle("backward sweep", "#1f4fbf", "--", 1.3, "s", 5.6, False),
}
"""Styles of sweeps, as in the paper: forward red, backward blue. A dot is visible inside an open
square."""


def sweeps_of(data: xr.Dataset | xr.DataArray) -> list[tuple[str, CurveStyle]]:
    """Return the directions of the sweeps in a dataset, with their styles."""
    return [(name, look) for name, look in SWEEPS.items() if name in data["direction"].values]


MOTIONS = (
    CurveStyle("motion", "black", "-", 1.2, "o", 3.6, True),
    CurveStyle("motion", "#c05a00", "--", 1.2, "^", 4.4, False),
    CurveStyle("motion", "#00795c", "-.", 1.2, "D", 3.8, True),
    CurveStyle("motion", "#7a3e9d", "--", 1.2, "v", 4.4, True),
)
"""Styles of motions whose names contain no sweep direction, in turn."""


class Area(NamedTuple):
    """Style of a scenario: the colour of the paper, a pattern and a label."""

    colour: str
    hatch: str
    line: str
    """A darker shade of the colour, for curves and text."""

    def entry(self, label: str) -> Patch:
        """Return a legend entry."""
        return Patch(
            facecolor=self.colour, edgecolor=self.line, hatch=self.hatch, lw=0.0, label=label
        )


SCENARIOS = {
    "S0": Area("#d9efd9", "", "#5aa469"),
    "S1": Area("#8fce9f", "....", "#2e7d32"),
    "S2": Area("#9dbbe8", "", "#1f4fbf"),
    "S3": Area("#f0a49b", "////", "#c8102e"),
    "S4": Area("#e39ad6", "xxxx", "#b0008e"),
    "S5": Area("#a9e3ee", "----", "#0097b2"),
    "S6": Area("#f9cf94", "\\\\\\\\", "#d97700"),
    "unclassified": Area("#d9d9d9", "++", "0.35"),
}
"""Styles of the scenarios: S0 and S1 green, S2 blue, S3 red, S4 magenta, S5 light blue, S6
orange."""

BUMPERS = {"B1": "o", "B2": "s", "B3": "^", "B4": "D"}
"""Symbols of the laboratory bumpers, as in the paper's Fig. 21."""

CURVES = tuple(
    CurveStyle("", colour, dashes, 1.4, marker, 4.0, False)
    for colour, dashes, marker in (
        ("black", "-", "o"),
        ("#c8102e", "--", "s"),
        ("#1f4fbf", "-.", "^"),
        ("#00795c", ":", "D"),
        ("#c05a00", (0, (5, 1, 1, 1, 1, 1)), "v"),
    )
)
"""Styles of spectra and of other curves, in turn."""

FREE = CurveStyle("free flight", "black", "-.", 0.9, "", 0.0, False)

SHADE = "0.9"
"""Light grey of shaded ranges."""
EDGE = "0.55"
"""Grey of hatches and edges on shaded ranges."""


class Band(NamedTuple):
    """How contacts of a stop are drawn. The edge alone is seen of a contact that is short."""

    colour: Any
    hatch: str
    edge: str
    width: float = 0.7

    @property
    def style(self) -> dict[str, Any]:
        """Keywords of a patch."""
        how = {"facecolor": self.colour, "edgecolor": self.edge, "hatch": self.hatch}
        return {**how, "linewidth": self.width}

    def draw(
        self,
        ax: Axes,
        spans: Iterable[tuple[float, float]],
        strip: tuple[int, int] = (0, 1),
        **options: Any,
    ) -> None:
        """Draw time spans as bands, over the whole height or in one of several strips."""
        number, count = strip
        ax.broken_barh(
            [(first, last - first) for first, last in spans],
            (1.0 - (number + 1) / count, 1.0 / count),
            transform=ax.get_xaxis_transform(),
            zorder=0,
            **self.style,
            **options,
        )

    def entry(self, label: str) -> Patch:
        """Return a legend entry."""
        return Patch(label=label, **self.style)


BANDS = (
    Band("#f7dc8b", "", "#d09a10"),
    Band("#b9dcec", "\\\\", "#4795b8"),
    Band("#c4e3c1", "//", "#55a04e"),
    Band("#ecc3df", "..", "#b5579a"),
    Band("#f3c6a5", "xx", "#cc6a2b"),
    Band("#d9d3ee", "--", "#7d6cc0"),
)
"""Bands of the contacts of stops, in turn."""


def panels(
    axes: Any,
    count: int,
    what: str,
    size: tuple[float, float],
    title: str | None,
    heights: tuple[float, ...] | None = None,
    *,
    sharex: bool = True,
    beside: bool = False,
) -> Panels:
    """Return the axes that were passed, or the axes of a new figure with several panels.

    The panels are arranged below each other or, with ``beside``, as many side by side as fit. Their
    heights are equal, unless ``heights`` is passed. Panels below each other share the horizontal
    axis, unless ``sharex`` is False.

    Raises
    ------
    InputError
        If axes are passed, but not as many as there are panels.
    """
    if axes is None:
        columns = columns_that_fit(count) if beside else 1
        rows = -(-count // columns)
        if beside:
            size = (size[0] * columns / count, size[1] * rows)
        made = new_axes(rows, columns, size, sharex=sharex and not beside, height_ratios=heights)
        for unused in made.ravel()[count:]:
            unused.remove()
        figure = made[0, 0].figure
        figure.align_ylabels()
        if title:
            figure.suptitle(title)
        return Panels(made.ravel()[:count])
    panel_axes = Panels(np.ravel(axes))
    if len(panel_axes) != count:
        raise InputError(f"axes: {len(panel_axes)} Axes; pass {count} ({what})")
    for ax in panel_axes:
        lay_out(ax)
    return panel_axes


def lay_out(ax: Axes) -> None:
    """Make room for labels and legends in a figure that has neither a layout engine nor margins.

    With the margins of matplotlib, the labels of small figures are outside the figure.
    """
    figure, place = ax.get_figure(root=True), ax.get_subplotspec()
    if figure is None or place is None or figure.get_layout_engine() is not None:
        return
    grid = place.get_topmost_subplotspec().get_gridspec()
    usual_margins: Any = rcParams
    sides = ("left", "right", "bottom", "top", "wspace", "hspace")
    usual = all(
        getattr(figure.subplotpars, side) == usual_margins[f"figure.subplot.{side}"]
        and getattr(grid, side, None) is None
        for side in sides
    )
    if usual:
        figure.set_layout_engine("constrained")


def fit_x_axis(ax: Axes, values: ArrayLike) -> None:
    """End the x axis at the smallest and the largest value. A single value is in the middle."""
    x = np.asarray(values, dtype=float)
    if x.min() < x.max():
        ax.set_xlim(x.min(), x.max())
        return
    for line in ax.lines:  # a point alone makes no line
        if line.get_marker() in ("None", "none", "", None):
            line.set_marker("o")
            line.set_markersize(4.0)


def note_peak(ax: Axes, x: float, y: float, words: str) -> None:
    """Mark a peak with a dot, and write its value above it, or below it if it is negative.

    Call it when the horizontal limits and the values of the panel are final.
    """
    ax.plot([x], [y], "o", color="#c8102e", markersize=4, zorder=5)
    up = y >= 0.0
    text = ax.annotate(
        words.replace("-", "−"),
        (x, y),
        (0.0, 4.0 if up else -4.0),
        textcoords="offset points",
        ha="center",
        va="bottom" if up else "top",
        fontsize="small",
        zorder=6,
    )
    text.set_path_effects([withStroke(linewidth=2.0, foreground="white")])
    ax.autoscale_view()  # which matplotlib would put off until it draws
    # The text stays between the sides of the panel.
    box = text.get_window_extent()
    at = ax.transData.transform((x, y))[0]
    half = 0.5 * box.width + 2.0
    shift = np.clip(at, ax.bbox.x0 + half, max(ax.bbox.x1 - half, ax.bbox.x0 + half)) - at
    text.xyann = (shift * 72.0 / ax.figure.dpi, 4.0 if up else -4.0)
    low, high = ax.get_ylim()
    share = min(1.3 * (box.height + 6.0) / ax.bbox.height, 0.6)
    if up:
        ax.set_ylim(top=max(high, y + share * (y - low) / (1.0 - share)))
    else:
        ax.set_ylim(bottom=min(low, y - share * (high - y) / (1.0 - share)))


def also_in_g(ax: Axes) -> None:
    """Add a second scale in g on the right of axes with an acceleration in m/s²."""
    if unitless():
        return
    scale = ax.secondary_yaxis("right", functions=(_in_g, _from_g))
    scale.set_ylabel("(g)")


def _in_g(acceleration: ArrayLike) -> NDArray[np.float64]:
    return np.asarray(acceleration, dtype=float) / GRAVITY


def _from_g(multiple: ArrayLike) -> NDArray[np.float64]:
    return np.asarray(multiple, dtype=float) * GRAVITY


@public
def save_figure(drawn: Any, path: File, *, dpi: Positive | None = None) -> Path:
    """Write a figure to a PNG, PDF or SVG file.

    The same data always give the same file, byte for byte, because the file contains no date and no
    version number. PDF files contain their fonts as TrueType. The text of an SVG file can be
    searched and edited.

    Parameters
    ----------
    drawn
        A Figure, or the Axes that a function of this package returned.
    path
        File name. Its ending (``.png``, ``.pdf`` or ``.svg``) selects the format.
    dpi
        Pixels per inch of a PNG file, and of those parts of a PDF or SVG file that are pixels, such
        as the areas of basins and the many points of chaotic motions. Default: 200 for a PNG file
        whose size is not set by `figure_size`, and 600 for all others.

    Raises
    ------
    InputError
        If ``drawn`` is not a figure, if the file name has another ending, or if the file cannot be
        written. In these cases an existing file is left unchanged.
    """
    import matplotlib

    kind = Path(path).suffix.lower().lstrip(".")
    blank: dict[str, dict[str, str | None]] = {
        "png": {"Software": None},
        "pdf": {"CreationDate": None, "Producer": None, "Creator": None},
        "svg": {"Date": None, "Creator": None},
    }
    if kind not in blank:
        raise InputError(
            f"figure: {str(path)!r} does not end in {', '.join(f'.{one}' for one in FORMATS)}; "
            "use one of these endings, which select the format"
        )
    first = drawn if isinstance(drawn, Figure) else next(iter(np.ravel(drawn)), None)
    if not isinstance(first, Artist) or (figure := first.get_figure(root=True)) is None:
        raise InputError(f"figure: {drawn!r} is not a figure; pass a Figure or Axes of matplotlib")
    if dpi is None:
        on_screen = kind == "png" and not (isinstance(figure, NotebookFigure) and figure.is_print)
        dpi = _SCREEN if on_screen else _PRINT
    elif not 1.0 <= dpi <= _MOST_DPI:
        raise InputError(f"dpi: {dpi!r}; pass a number from 1 to {_MOST_DPI:g}")
    # SVG marks its parts with random names unless it is given a seed.
    fixed: dict[Any, Any] = {"svg.hashsalt": "vibroimpact", "svg.fonttype": "none", **EMBEDDED}
    with matplotlib.rc_context(fixed):
        picture = io.BytesIO()
        figure.savefig(picture, format=kind, dpi=dpi, metadata=blank[kind])
    return write_whole(path, picture.getvalue())
