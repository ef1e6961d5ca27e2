"""A drawing of an assembly: the masses, their links, and the gaps to scale.

Each mass is a box with a stem below it. Each link and each stop is a row between the stems of its
two bodies, and is broken where it passes the stem of another body. The base is a hatched line on
the left and on the right. A stop is a spring or a plate on its right body, and its gap is the
distance from the stem of its left body.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from html import escape
from typing import TYPE_CHECKING, Literal

from vibroimpact.model.assembly.names import GROUND
from vibroimpact.model.quantities import LENGTH, MASS
from vibroimpact.model.units import pretty

if TYPE_CHECKING:
    from vibroimpact.model.assembly.assembly import Assembly
    from vibroimpact.model.assembly.link import Link

Kind = Literal["mass", "stem", "ground", "link", "stop", "gap", "bridge"]
Point = tuple[float, float]

_COLUMN, _ROW, _BOX, _WALL = 120.0, 34.0, 36.0, 10.0
"""Distance between bodies, height of a row, height of the boxes, and width of the base, in
points."""
_LETTER, _MARGIN = 6.3, 14.0
"""Width of a letter, and room beside a text, in points."""
_ABOVE = 14.0
"""Distance of the middle of a text from the row below it, in points."""
_LONGEST_GAP = 0.5
"""Length of the largest gap, relative to the room between two bodies."""
_TEETH = 4


@dataclass(frozen=True)
class Line:
    """A polyline."""

    kind: Kind
    points: tuple[Point, ...]
    closed: bool = False


@dataclass(frozen=True)
class Words:
    """A text of one or two lines, whose middle is at a point. One over lines is outlined."""

    text: str
    at: Point
    over_lines: bool = True


@dataclass
class Drawing:
    """Lines and texts in points; y increases downwards."""

    width: float
    height: float
    lines: list[Line] = field(default_factory=list)
    words: list[Words] = field(default_factory=list)

    def line(self, kind: Kind, *points: Point, closed: bool = False) -> None:
        """Add a polyline."""
        self.lines.append(Line(kind, points, closed))


@dataclass(frozen=True)
class MotionFrame:
    """Where the parts of an assembly are at one instant of a motion."""

    displacement: Mapping[str, float]
    """Displacement of each mass (m)."""
    deformation: Mapping[str, float]
    """Deformation of each stop (m)."""
    scale: float
    """Points of the drawing per metre of displacements, deformations and gaps."""


def drawing(assembly: Assembly, moved: MotionFrame | None = None) -> Drawing:
    """Return the drawing of an assembly: at rest, or at one instant of a motion.

    Every point of the drawing is a linear function of the displacements and deformations.
    """
    names = assembly.names
    parts = [*assembly.links.items(), *assembly.stops.items()]
    column = column_width(assembly)
    made = Drawing(
        column * (len(names) + 1) + 2.0 * _WALL, _BOX + 12.0 + _ROW * max(len(parts), 1) + 10.0
    )
    place = {name: _WALL + column * (i + 1) for i, name in enumerate(names)}
    scale = gap_scale(assembly)
    rest, pressed = dict(place), dict.fromkeys(assembly.stops, 0.0)
    if moved is not None:
        scale = moved.scale
        for name, by in moved.displacement.items():
            place[name] += scale * by
        pressed.update({name: scale * by for name, by in moved.deformation.items()})
    rows = {name: _BOX + 12.0 + _ROW * (i + 0.75) for i, (name, _) in enumerate(parts)}
    left, right = _WALL, made.width - _WALL
    sides = {
        x
        for _, link in parts
        for x in [left] * (link.left == GROUND) + [right] * (link.right == GROUND)
    }
    for x in sorted(sides):
        _draw_ground(made, x, -1.0 if x == left else 1.0)
    foot = {
        name: max(
            (rows[part] for part, link in parts if name in (link.left, link.right)), default=0.0
        )
        for name in names
    }
    for name, x in place.items():
        if foot[name]:
            made.line("stem", (x, _BOX), (x, foot[name]))
        _draw_mass(made, assembly, name, x, column)
    for name, link in parts:
        y = rows[name]
        x0 = left if link.left == GROUND else place[link.left]
        x1 = right if link.right == GROUND else place[link.right]
        r0, r1 = rest.get(link.left, left), rest.get(link.right, right)
        if link.is_stop:
            # The face of a stop moves with its right body, and a deformation brings it nearer.
            length = abs(r1 - r0) - max(link.stop.gap, 0.0) * scale
            face = x1 - math.copysign(1.0, r1 - r0) * (length - pressed[name])
            _draw_stop(made, link, (x0, face, x1, y), length)
        else:
            _draw_spring(made, "link", x0, x1, y, abs(r1 - r0))
        low, high = sorted((r0, r1))
        between = [one for one in names if low < rest[one] < high]
        for other in between:
            if foot[other] > y - 8.0:
                made.line("bridge", (place[other], y - 8.0), (place[other], y + 8.0))
        edges = sorted([(r0, x0), (r1, x1)])
        edges[1:1] = [(rest[one], place[one]) for one in between if foot[one] > y - 1.5 * _ABOVE]
        text = _label(name, link)
        made.words.append(Words(text, (_free_middle(edges, _length(text)), y - _ABOVE)))
    return made


def _free_middle(edges: list[Point], length: float) -> float:
    """Return the middle of a text, which covers no stem: as near to that of its row as it can be.

    Parameters
    ----------
    edges
        From left to right, where each stem or wall is at rest, and where it is now.
    """
    middle = 0.5 * (edges[0][0] + edges[-1][0])
    at, (r0, x0), (r1, x1) = min(
        (
            (min(max(middle, left[0] + 0.5 * length), right[0] - 0.5 * length), left, right)
            for left, right in itertools.pairwise(edges)
        ),
        key=lambda room: abs(room[0] - middle),
    )
    return x0 + (at - r0) / (r1 - r0) * (x1 - x0)


def _length(text: str) -> float:
    """Return the room that a text needs, in points."""
    return _LETTER * len(text) + _MARGIN


def column_width(assembly: Assembly) -> float:
    """Return the distance between two bodies of a drawing, in points."""
    parts = {**assembly.links, **assembly.stops}
    return max(
        _COLUMN,
        8.0 * max(len(name) for name in assembly.names) + 40.0,
        *(_length(_label(name, link)) for name, link in parts.items()),
    )


def gap_scale(assembly: Assembly) -> float:
    """Return the scale of the gaps in a drawing at rest, in points per metre."""
    gaps = [abs(stop.stop.gap) for stop in assembly.stops.values()]
    return _LONGEST_GAP * column_width(assembly) / (max(gaps, default=0.0) or 1.0)


def _draw_ground(made: Drawing, x: float, side: float) -> None:
    made.line("ground", (x, 4.0), (x, made.height - 4.0))
    y = 8.0
    while y < made.height - 4.0:
        made.line("ground", (x, y), (x + side * 7.0, y + 6.0))
        y += 9.0


def _draw_mass(made: Drawing, assembly: Assembly, name: str, x: float, column: float) -> None:
    half = 0.5 * column - 16.0
    box = ((x - half, 2.0), (x + half, 2.0), (x + half, _BOX), (x - half, _BOX))
    made.line("mass", *box, closed=True)
    mass = f"\n{pretty(assembly.masses[name], MASS)}" if name in assembly.masses else ""
    made.words.append(Words(f"{name}{mass}", (x, 0.5 * (2.0 + _BOX)), over_lines=False))


def _draw_spring(made: Drawing, kind: Kind, x0: float, x1: float, y: float, length: float) -> None:
    """Draw a spring, whose number of teeth depends on its length at rest."""
    lead = 0.15 * (x1 - x0)
    start, end = x0 + lead, x1 - lead
    count = max(2 * _TEETH, 2 * round(0.7 * length / 16.0))
    teeth = [
        (start + (end - start) * (i + 0.5) / count, y + (5.0 if i % 2 else -5.0))
        for i in range(count)
    ]
    made.line(kind, (x0, y), (start, y), *teeth, (end, y), (x1, y))


def _draw_stop(
    made: Drawing,
    link: Link,
    where: tuple[float, float, float, float],
    length: float,
) -> None:
    """Draw a stop from its face to its right body, and its gap, which begins at the left body."""
    x0, face, x1, y = where
    gap = link.stop.gap
    made.line("stop", (face, y - 8.0), (face, y + 8.0))
    if link.stop.rigid:
        made.line("stop", (face, y - 3.0), (x1, y - 3.0), (x1, y + 3.0), (face, y + 3.0))
    else:
        _draw_spring(made, "stop", face, x1, y, length)
    if gap > 0.0:
        made.line("gap", (x0, y + 6.0), (face, y + 6.0))


def _label(name: str, link: Link) -> str:
    """Return the name of a link, or the name and the gap of a stop."""
    if not link.is_stop:
        return name
    gap = link.stop.gap
    return f"{name}: {'preload' if gap < 0.0 else 'gap'} {pretty(abs(gap), LENGTH)}"


_PENS = {
    "mass": 'fill="#e8edf5" stroke="black" stroke-width="1.2"',
    "stem": 'fill="none" stroke="black" stroke-width="2"',
    "ground": 'fill="none" stroke="#555" stroke-width="1"',
    "link": 'fill="none" stroke="black" stroke-width="1.2"',
    "stop": 'fill="none" stroke="#c8102e" stroke-width="1.4"',
    "gap": 'fill="none" stroke="#1f4fbf" stroke-width="1" stroke-dasharray="3 2"',
    "bridge": 'fill="none" stroke="white" stroke-width="8"',
}


_OUTLINE = ' stroke="white" stroke-width="3" paint-order="stroke"'
"""Keeps a text readable on a line."""


def as_svg(made: Drawing) -> str:
    """Return a drawing as SVG, for notebooks."""
    pieces = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{made.width:g}" height="{made.height:g}" '
        f'viewBox="0 0 {made.width:g} {made.height:g}" style="background:white">'
    ]
    pieces += [_shape(line) for line in made.lines if line.kind != "stem"]
    for words in made.words:
        outline = _OUTLINE if words.over_lines else ""
        rows = words.text.split("\n")
        for i, row in enumerate(rows):
            y = words.at[1] + 3.5 + 14.0 * (i - 0.5 * (len(rows) - 1))
            pieces.append(
                f'<text x="{words.at[0]:g}" y="{y:g}" text-anchor="middle" '
                f'font-family="sans-serif" font-size="11"{outline}>{escape(row)}</text>'
            )
    # The outline of a text must not cut a stem.
    pieces += [_shape(line) for line in made.lines if line.kind == "stem"]
    return "".join([*pieces, "</svg>"])


def _shape(line: Line) -> str:
    shape = "polygon" if line.closed else "polyline"
    return f'<{shape} points="{_points(line.points)}" {_PENS[line.kind]}/>'


def _points(points: Iterable[Point]) -> str:
    return " ".join(f"{x:.6g},{y:.6g}" for x, y in points)
