"""The masses of an assembly with their links and stops."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

from matplotlib.axes import Axes
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Polygon
from matplotlib.patheffects import withStroke
from matplotlib.text import Text

from vibroimpact.errors import InputError, shown
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.model import Assembly, Bumper, Isolator, Link, Oscillator, RigidStop, Stop
from vibroimpact.model.argument_types import String
from vibroimpact.model.assembly.drawing import Drawing, drawing
from vibroimpact.model.assembly.names import GROUND
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.public import public
from vibroimpact.model.written_units import unitless, written_for

_INCH = 72.0
_LEGIBLE = 6.0
"""Size (pt) below which words are not made smaller."""


class Pen(NamedTuple):
    """How lines of one kind are drawn."""

    colour: str
    width: float
    order: float
    dashes: str = "-"


PENS = {
    "ground": Pen("#595959", 0.8, 2.0),
    "mass": Pen("black", 1.0, 3.0),
    "link": Pen("black", 1.1, 3.0),
    "stop": Pen("#c8102e", 1.3, 3.0),
    "gap": Pen("#1f4fbf", 0.9, 3.0, "--"),
    "bridge": Pen("white", 8.0, 3.5),
    "stem": Pen("black", 2.0, 5.0),  # above the outlines of texts, which would cut it
}
"""Pens, from the lowest layer to the top."""
BOX = "#e8edf5"
"""Colour of a mass."""


def _check_assembly(value: object, field: str) -> Assembly:
    if not isinstance(value, Assembly):
        raise InputError(f"{field}: {shown(value)} is not an Assembly; pass an Assembly")
    return value


@public
def assembly_drawing(
    assembly: Annotated[Assembly, _check_assembly],
    ax: Axes | None = None,
    *,
    title: String | None = None,
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
    made = drawing(assembly)
    ax = axes_or_new(ax, (made.width / _INCH + 0.2, made.height / _INCH + 0.2), title)
    # The drawing shrinks with a narrow figure, and its words with it as far as they can be read.
    figure = ax.get_figure(root=True)
    assert figure is not None
    small = FontProperties(size="small").get_size_in_points()
    share = figure.get_size_inches()[0] * _INCH / made.width
    size = min(small, max(_LEGIBLE, share * small))
    draw(ax, made, size)
    ax.set_aspect("equal")
    return ax


def oscillator_drawing(oscillator: Oscillator, *, title: str | None = None) -> Axes:
    """Draw one mass, its isolator, and its stops with their gaps to scale."""
    # A drawing shows the gaps and the kinds of stops, and no other values of them.
    spring = Isolator(stiffness=1.0, damping=0.0)
    joined = {"right": ("mass", GROUND), "left": (GROUND, "mass")}
    stops = {}
    for side in SIDES:
        stop: Stop | None = getattr(oscillator, side)
        if stop is not None:
            law = RigidStop(0.5, stop.gap) if stop.rigid else Bumper(1.0, 0.0, stop.gap)
            stops[side] = Link(*joined[side], law)
    held = not oscillator.isolator.linear or oscillator.isolator.initial_stiffness > 0.0
    with written_for(oscillator):
        alike = Assembly(
            {"mass": oscillator.mass},
            {"isolator": Link(GROUND, "mass", spring)} if held else {},
            stops,
            units="none" if unitless() else "SI",
        )
    return assembly_drawing(alike, title=title)


def draw(
    ax: Axes, made: Drawing, size: float, share: float = 1.0, head: float = 0.0
) -> tuple[list[Polygon], list[Text]]:
    """Draw a drawing, and return its lines and its texts, in the order in which it holds them.

    Parameters
    ----------
    size
        Size of the texts (pt).
    share
        Factor of the widths of the pens.
    head
        Height of a free strip above the drawing.
    """
    lines, texts = [], []
    for one in made.lines:
        pen, face = PENS[one.kind], BOX if one.closed else "none"
        style: dict[str, Any] = {
            "linewidth": share * pen.width,
            "linestyle": pen.dashes,
            "capstyle": "projecting" if pen.dashes == "-" else "butt",
            "joinstyle": "miter" if one.closed else "round",
        }
        line = Polygon(one.points, closed=one.closed, facecolor=face, edgecolor=pen.colour, **style)
        ax.add_patch(line).set_zorder(pen.order)
        lines.append(line)
    for words in made.words:
        # An outline keeps a text readable on a line.
        text = ax.text(*words.at, words.text, size=size, ha="center", va="center", zorder=4)
        text.set_path_effects([withStroke(linewidth=3.0, foreground="white")] * words.over_lines)
        text.set_in_layout(False)  # the drawing has room for it
        texts.append(text)
    ax.set_xlim(0.0, made.width)
    ax.set_ylim(made.height, -head)
    ax.set_axis_off()
    return lines, texts
