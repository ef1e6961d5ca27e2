"""Animations of several masses: a GIF for slides, or an HTML page with a slider."""

from __future__ import annotations

import io
import itertools
import json
from collections.abc import Iterator
from html import escape
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from numpy.typing import NDArray

from vibroimpact.datasets.files import write_whole
from vibroimpact.errors import InputError
from vibroimpact.figures.assembly import BOX, PENS, draw
from vibroimpact.figures.assembly_motion import History, history
from vibroimpact.model import Assembly
from vibroimpact.model.argument_types import File, Seconds, String
from vibroimpact.model.assembly.drawing import (
    Drawing,
    MotionFrame,
    column_width,
    drawing,
    gap_scale,
)
from vibroimpact.model.names import literal
from vibroimpact.model.public import public
from vibroimpact.model.units import plain
from vibroimpact.model.written_units import unit

_Array = NDArray[np.float64]

_ENDINGS = (".gif", ".html")
_RATE = 20.0
"""Frames per second of a GIF."""
_HTML_RATE = 60.0
"""Most states per second in an HTML page, between which it interpolates."""
_SHADES = 8
"""Number of shades of each colour of a GIF, for smooth edges."""
_NARROWEST, _WIDEST = 1000.0, 1600.0
"""Width of a GIF in pixels."""
_LONGEST = 120.0
"""Longest animation (s)."""
_FARTHEST = 0.32
"""Largest displacement on the screen, relative to the distance between two bodies."""


@public
def save_animation(
    motion: xr.Dataset,
    path: File,
    *,
    duration: Seconds = 10.0,
    start: Seconds | None = None,
    end: Seconds | None = None,
    title: String | None = None,
) -> Path:
    """Write an animation of the masses of an assembly: a GIF file, or an HTML page.

    Displacements, deformations of stops and gaps have one scale, so that the bodies meet on the
    screen when they meet in the motion. The displacements are relative to the base, which is drawn
    at rest. A touched stop is drawn thick. The page works without a network; it has a slider and a
    button, and shows the motion more smoothly than the GIF.

    Parameters
    ----------
    motion
        Dataset of `simulate`, `steady` or `orbit` with samples, of a rig with an `Assembly`.
    path
        File name. Its ending (``.gif`` or ``.html``) selects the format.
    duration
        Duration of the animation (s), at most 120. Its ratio to the duration of the motion is
        shown as the speed.
    start, end
        First and last time of the motion (s). Default: the whole motion.
    title
        Title above the animation. Default: none.

    Returns
    -------
    Path
        The path of the file.

    Raises
    ------
    InputError
        If the dataset does not hold such a motion, if a time is invalid, if the file name has
        another ending, or if the file cannot be written.
    """
    shown = history(motion)
    file = Path(path)
    if file.suffix.lower() not in _ENDINGS:
        raise InputError(
            f"path: {str(file)!r} does not end in {' or '.join(_ENDINGS)}; use one of these "
            "endings, which select the format"
        )
    if not 0.0 < duration <= _LONGEST:
        raise InputError(
            f"duration: {duration!r}; pass a duration greater than 0 and at most {_LONGEST:g} s"
        )
    time = motion["time"].values
    first = float(time[0]) if start is None else start
    last = float(time[-1]) if end is None else end
    if not time[0] <= first < last <= time[-1]:
        raise InputError(
            f"start, end: {first:g} s and {last:g} s; pass times from {time[0]:g} s to "
            f"{time[-1]:g} s, the earlier one first"
        )
    moving = _Moving(shown)
    speed = f"speed × {plain((last - first) / duration, 2)}"
    if file.suffix.lower() == ".gif":
        at = np.linspace(first, last, max(2, round(_RATE * duration)))
        return write_whole(file, _gif(moving, at, title, speed))
    kept = time[(time >= first) & (time <= last)]
    most = round(_HTML_RATE * duration)
    at = kept if 1 < len(kept) <= most else np.linspace(first, last, max(2, most))
    return write_whole(file, _page(moving, at, duration, title, speed).encode("utf-8"))


class _Moving:
    """A drawing whose points are linear functions of displacements and deformations."""

    def __init__(self, shown: History) -> None:
        assembly, motion = shown.assembly, shown.motion
        self.shown = shown
        self.names, self.stops = assembly.names, tuple(assembly.stops)
        moved = motion["displacement"].transpose("time", "mass").values
        farthest = float(np.abs(moved).max(initial=0.0)) or 1.0
        self.scale = min(_FARTHEST * column_width(assembly) / farthest, gap_scale(assembly))
        self.rest = self._drawn(assembly, {}, {})
        base = _points(self.rest)
        shifts = [_points(self._drawn(assembly, {one: 1.0}, {})) - base for one in self.names]
        shifts += [_points(self._drawn(assembly, {}, {one: 1.0})) - base for one in self.stops]
        self.base = base
        self.shifts = np.array(shifts).reshape(len(shifts), len(base), 2)[:, :, 0]
        """Shift to the right of each point, for each displacement and deformation of 1 m."""
        self._moved = moved
        self._pressed = motion["deformation"].transpose("time", "stop").values

    def _drawn(
        self, assembly: Assembly, displacement: dict[str, float], deformation: dict[str, float]
    ) -> Drawing:
        return drawing(assembly, MotionFrame(displacement, deformation, self.scale))

    def values(self, at: _Array) -> _Array:
        """Return displacements and deformations at some times: one row for each time."""
        time = self.shown.motion["time"].values
        columns = np.concatenate([self._moved, self._pressed], axis=1).T
        return np.column_stack([np.interp(at, time, one) for one in columns])

    def touched(self, at: _Array) -> NDArray[np.bool_]:
        """Return whether each stop is touched at some times, from its exact events."""
        shown = self.shown
        is_touched = np.zeros((len(at), len(self.stops)), dtype=bool)
        half = 0.5 * float(np.diff(at).max(initial=0.0))  # so that a short contact is seen, too
        for i, name in enumerate(self.stops):
            hits = shown.event_at[shown.hits(name)]
            for span in [*shown.contacts(name), *zip(hits, hits, strict=True)]:
                begin, end = shown.seconds(np.array(span))
                is_touched[:, i] |= (at >= begin - half) & (at <= end + half)
        return is_touched

    def owners(self) -> list[str]:
        """Return for each line the stop that it is drawn for, or ""."""
        rows = {
            words.text.partition(":")[0]: words.at[1] + 14.0
            for words in self.rest.words
            if words.over_lines and ":" in words.text
        }
        stop_names = []
        for line in self.rest.lines:
            middle = 0.5 * (line.points[0][1] + line.points[-1][1])
            near = [name for name, y in rows.items() if abs(y - middle) < 2.0]
            stop_names.append(near[0] if line.kind == "stop" and near else "")
        return stop_names


def _points(made: Drawing) -> _Array:
    """Return all points of a drawing: of its lines, then of its words."""
    lines = [point for line in made.lines for point in line.points]
    return np.array([*lines, *(words.at for words in made.words)])


def _gif(moving: _Moving, at: _Array, title: str | None, speed: str) -> bytes:
    """Return the animation as the bytes of a GIF file."""
    from PIL import Image

    # With the same colours in all frames, a frame stores only what has changed.
    colours = Image.new("P", (1, 1))
    colours.putpalette(_palette())
    frames = [
        Image.fromarray(picture).quantize(palette=colours, dither=Image.Dither.NONE)
        for picture in _pictures(moving, at, title, speed)
    ]
    file = io.BytesIO()
    frames[0].save(
        file,
        format="GIF",
        save_all=True,
        append_images=frames[1:],
        duration=round(1000.0 / _RATE),
        loop=0,
    )
    return file.getvalue()


def _palette() -> bytes:
    """Return the colours of a GIF: those of the pens on white, and black on a mass."""
    white, box = np.array(to_rgb("white")), np.array(to_rgb(BOX))
    pens = [np.array(to_rgb(colour)) for colour in {pen.colour: None for pen in PENS.values()}]
    share = np.linspace(0.0, 1.0, _SHADES)[:, np.newaxis]
    pairs = [*((white, pen) for pen in pens), (box, np.zeros(3))]
    colours = np.concatenate([(1.0 - share) * one + share * other for one, other in pairs])
    return np.rint(255.0 * colours).astype(np.uint8).tobytes()


def _pictures(
    moving: _Moving, at: _Array, title: str | None, speed: str
) -> Iterator[NDArray[np.uint8]]:
    """Yield the pixels of each frame."""
    made = moving.rest
    wide = float(np.clip(made.width / 72.0, 4.0, 9.0))
    share = wide * 72.0 / made.width
    head = 26.0
    dpi = float(np.clip(1.5 * made.width, _NARROWEST, _WIDEST)) / wide
    figure = Figure(figsize=(wide, share * (made.height + head) / 72.0), dpi=dpi)
    canvas = FigureCanvasAgg(figure)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    size = max(5.0, 8.0 * min(share, 1.0))
    lines, texts = draw(ax, made, size, share, head)
    if title:
        ax.text(8.0, 8.0 - head, literal(title), va="top", fontsize=size + 1.0)
    clock = ax.text(made.width - 8.0, 8.0 - head, "", ha="right", va="top", fontsize=size + 1.0)
    slices, owners, pen = _slices(made), moving.owners(), share * PENS["stop"].width
    for now, values, hit in zip(at, moving.values(at), moving.touched(at), strict=True):
        points = moving.base.copy()
        points[:, 0] += values @ moving.shifts
        pressed = {name for name, one in zip(moving.stops, hit, strict=True) if one}
        for line, where, owner in zip(lines, slices, owners, strict=True):
            line.set_xy(points[where])
            if owner:
                line.set_linewidth(2.2 * pen if owner in pressed else pen)
        for text, point in zip(texts, points[len(points) - len(texts) :], strict=True):
            text.set_position((float(point[0]), float(point[1])))
        clock.set_text(f"t = {now:.2f}{unit(' s')}, {speed}")
        canvas.draw()  # type: ignore[no-untyped-call]
        pixels: Any = canvas.buffer_rgba()  # type: ignore[no-untyped-call]
        yield np.asarray(pixels)[:, :, :3].copy()


def _slices(made: Drawing) -> list[slice]:
    """Return where the points of each line are among all points."""
    ends = np.cumsum([0, *(len(line.points) for line in made.lines)]).tolist()
    return [slice(first, last) for first, last in itertools.pairwise(ends)]


def _page(moving: _Moving, at: _Array, duration: float, title: str | None, speed: str) -> str:
    """Return the animation as an HTML page of its own."""
    made = moving.rest
    owners, slices = moving.owners(), _slices(made)
    shapes: list[dict[str, Any]] = []
    for line, owner, where in zip(made.lines, owners, slices, strict=True):
        pen = PENS[line.kind]
        shapes.append(
            {
                "closed": line.closed,
                "colour": pen.colour,
                "width": pen.width,
                "dashes": "" if pen.dashes == "-" else "3 2",
                "stop": moving.stops.index(owner) if owner else -1,
                "above": line.kind == "stem",  # the outline of a text would cut it
                "points": _linear(moving, range(where.start, where.stop)),
            }
        )
    kinds, order = [line.kind for line in made.lines], list(PENS)
    shapes = [shapes[i] for i in sorted(range(len(kinds)), key=lambda i: order.index(kinds[i]))]
    count = sum(len(line.points) for line in made.lines)
    texts = [
        {
            "rows": words.text.split("\n"),
            "points": _linear(moving, range(i, i + 1)),
            "outlined": words.over_lines,
        }
        for i, words in enumerate(made.words, count)
    ]
    data = {
        "shapes": shapes,
        "texts": texts,
        "times": [float(f"{one:.7g}") for one in at],
        "values": [[float(f"{one:.5g}") for one in row] for row in moving.values(at)],
        "touched": [[int(one) for one in row] for row in moving.touched(at)],
        "masses": len(moving.names),
        "duration": duration,
        "speed": speed,
        "unit": unit(" s"),
    }
    heading = escape(title or "")
    # "</" would end the script.
    written = json.dumps(data, separators=(",", ":")).replace("</", "<\\/")
    page = resources.files(__package__).joinpath("animation.html").read_text("utf-8")
    return (
        page.replace("$TITLE", heading or "Motion")
        .replace("$HEADING", f"<h1>{heading}</h1>" if heading else "")
        .replace("$WIDTH", f"{made.width:g}")
        .replace("$HEIGHT", f"{made.height:g}")
        .replace("$DATA", written)
    )


def _linear(moving: _Moving, where: range) -> list[list[Any]]:
    """Return points as x, y and the shifts of x, as pairs of an index and a number."""
    points = []
    for i in where:
        shifts = [
            [k, float(f"{one:.6g}")] for k, one in enumerate(moving.shifts[:, i]) if one != 0.0
        ]
        points.append([*(float(f"{one:.6g}") for one in moving.base[i]), shifts])
    return points
