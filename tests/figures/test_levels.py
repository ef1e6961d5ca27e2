"""Numbers on contour lines."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from vibroimpact.figures.levels import number_lines
from vibroimpact.figures.notebook import new_axes


@pytest.fixture
def ax():
    panel = new_axes(1, 1, (4.0, 3.0))[0, 0]
    panel.set(xlim=(0.0, 4.0), ylim=(0.0, 3.0))
    return panel


def slanted(begin, slope=0.5, first=0.0, last=4.0):
    x = np.linspace(first, last, 9)
    return np.column_stack([x, begin + slope * x])


def middles(ax):
    """The middles of the numbers in the units of the axes, where they stay in the end."""
    ax.figure.draw_without_rendering()
    back = ax.transData.inverted()
    boxes = {text.get_text(): text.get_window_extent() for text in ax.texts}
    return {name: back.transform((box.p0 + box.p1) / 2.0) for name, box in boxes.items()}


def test_a_number_stands_on_its_line_and_along_it(ax) -> None:
    begins = {0.25: 0.1, 12500.0: 0.7}
    number_lines(ax, [(level, [slanted(begin)]) for level, begin in begins.items()], [])
    centres = middles(ax)
    assert set(centres) == {"0.25", "12500"}
    for text in ax.texts:
        x, y = centres[text.get_text()]
        assert y == pytest.approx(begins[float(text.get_text())] + 0.5 * x, abs=0.03)
        along = ax.transData.transform([[0.0, 0.0], [1.0, 0.5]])
        steep = np.degrees(np.arctan2(*np.diff(along, axis=0)[0][::-1]))
        assert text.get_rotation() == pytest.approx(steep)


def test_a_line_down_is_numbered_upright(ax) -> None:
    number_lines(ax, [(1.0, [slanted(2.5, -0.6)[::-1]])], [])
    (text,) = ax.texts
    assert 270.0 < text.get_rotation() < 360.0


def test_a_number_hides_no_other_line(ax) -> None:
    """Where two lines come together, both are numbered where they are apart."""
    number_lines(ax, [(1.0, [slanted(1.0, 0.0)]), (2.0, [slanted(1.02, 0.1)])], [])
    centres = middles(ax)
    assert set(centres) == {"1", "2"}
    assert min(x for x, _ in centres.values()) > 1.0


def test_a_line_without_room_has_no_number(ax) -> None:
    short = slanted(0.5, first=1.0, last=1.2)
    near = [(2.0, [slanted(1.5, 0.0)]), (3.0, [slanted(1.53, 0.0)])]
    number_lines(ax, [(1.0, [short, np.empty((0, 2))]), *near], [])
    assert not ax.texts


def test_numbers_keep_clear_of_marks_and_of_one_another(ax) -> None:
    levels = [(float(k), [slanted(0.3 * k, 0.1)]) for k in range(9)]
    (marks,) = ax.plot([2.0, 2.0], [0.5, 2.0], "o")
    (edge,) = ax.plot([1.5, 1.5], [0.0, 3.0], "--")
    number_lines(ax, levels, [marks, edge])
    ax.figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in ax.texts]
    assert len(boxes) > 7
    assert not any(a.overlaps(b) for a, b in combinations(boxes, 2))
    spots = ax.transData.transform(np.vstack([marks.get_xydata(), [[1.5, y] for y in (0, 1, 2)]]))
    for box in boxes:
        assert not any(box.contains(*spot) for spot in spots)
        assert not box.x0 < spots[-1][0] < box.x1
