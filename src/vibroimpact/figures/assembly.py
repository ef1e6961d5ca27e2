"""The masses of an assembly with their links and stops."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Polygon
from matplotlib.patheffects import withStroke

from vibroimpact.errors import InputError, shown
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.model import Assembly
from vibroimpact.model.assembly.drawing import drawing
from vibroimpact.model.written_units import written_for

_INCH = 72.0
_OUTLINE = [withStroke(linewidth=3.0, foreground="white")]
"""Keeps a text readable on a line."""
_LEGIBLE = 6.0
"""Size (pt) below which words are not made smaller."""
_PENS: dict[str, dict[str, Any]] = {
    "stem": {"color": "black", "linewidth": 2.0, "zorder": 2},
    "ground": {"color": "0.35", "linewidth": 0.8, "zorder": 2},
    "link": {"color": "black", "linewidth": 1.1, "zorder": 3},
    "stop": {"color": "#c8102e", "linewidth": 1.3, "zorder": 3},
    "gap": {"color": "#1f4fbf", "linewidth": 0.9, "linestyle": "--", "zorder": 3},
    "bridge": {"color": "white", "linewidth": 5.0, "zorder": 2.5},
}


def assembly_drawing(
    assembly: Assembly, ax: Axes | None = None, *, title: str | None = None
) -> Axes:
    """Draw the masses of an assembly, its links, and its stops with their gaps to scale.

    Masses are boxes in the order of the assembly. Each link and each stop is a row between its two
    bodies: links black, stops red. Dashed blue lines are the gaps, all to one scale. The base is
    hatched.

    Parameters
    ----------
    assembly
        The assembly.
    ax
        Axes to draw on. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If ``assembly`` is not an `Assembly`.
    """
    if not isinstance(assembly, Assembly):
        raise InputError(f"assembly: {shown(assembly)} is not an Assembly; pass an Assembly")
    with written_for(assembly):
        made = drawing(assembly)
    ax = axes_or_new(ax, (made.width / _INCH + 0.2, made.height / _INCH + 0.2), title)
    for line in made.lines:
        if line.closed:
            box = Polygon(line.points, facecolor="#e8edf5", edgecolor="black", linewidth=1.0)
            ax.add_patch(box).set_zorder(3)
        else:
            ax.plot(*zip(*line.points, strict=True), **_PENS[line.kind])
    # The drawing shrinks with a narrow figure, and its words with it as far as they can be read.
    figure = ax.get_figure(root=True)
    assert figure is not None
    small = FontProperties(size="small").get_size_in_points()
    share = figure.get_size_inches()[0] * _INCH / made.width
    size = min(small, max(_LEGIBLE, share * small))
    for words in made.words:
        ax.text(
            *words.at,
            words.text,
            ha="center",
            va="center",
            fontsize=size,
            zorder=4,
            path_effects=_OUTLINE if words.over_lines else (),
        ).set_in_layout(False)  # the drawing has room for them
    ax.set_xlim(0.0, made.width)
    ax.set_ylim(made.height, 0.0)
    ax.set_aspect("equal")
    ax.set_axis_off()
    return ax
