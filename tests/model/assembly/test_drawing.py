"""The drawing of an assembly: texts beside stems, and stems that nothing cuts."""

from __future__ import annotations

import itertools
import re

import pytest

import vibroimpact as vi
from vibroimpact.model.assembly.drawing import MotionFrame, as_svg, drawing

_LETTER = 6.2
"""Width of a letter of 11 points in the widest usual font (DejaVu Sans), on average."""
SPRING = vi.Isolator("5 MN/m", "0.2 MN s/m")
MOAT = vi.Bumper("60 MN/m", "0.9 MN s/m", "200 mm")


def building(**stops: vi.Link) -> vi.Assembly:
    """Return a building of three masses."""
    bodies = ("ground", "base", "floor", "roof")
    links = {
        f"storey_{i}": vi.Link(*pair, SPRING) for i, pair in enumerate(itertools.pairwise(bodies))
    }
    return vi.Assembly(dict.fromkeys(bodies[1:], "300 t"), links, stops)


ALL = building(
    moat_left=vi.Link("ground", "base", MOAT),
    moat_right=vi.Link("base", "ground", MOAT),
    neighbour_beside_it=vi.Link("roof", "ground", vi.RigidStop(restitution=0.6, gap="25 cm")),
)


@pytest.mark.parametrize("assembly", [ALL, building(), building(m=vi.Link("base", "roof", MOAT))])
def test_no_text_covers_a_stem_or_a_wall(assembly) -> None:
    made = drawing(assembly)
    upright = [
        (line.points[0][0], line.points[0][1], line.points[-1][1])
        for line in made.lines
        if line.kind in ("stem", "ground") and line.points[0][0] == line.points[-1][0]
    ]
    assert len(upright) > 3
    for words in (one for one in made.words if one.over_lines):
        (x, y), half = words.at, 0.5 * _LETTER * len(words.text)
        covered = [at for at, top, end in upright if top < y + 6.0 and end > y - 6.0]
        assert not [at for at in covered if x - half < at < x + half], words.text
        assert 10.0 < x - half < x + half < made.width - 10.0


def test_a_row_that_passes_a_stem_is_broken_and_not_the_stem() -> None:
    made = drawing(ALL)
    (bridge,) = (line for line in made.lines if line.kind == "bridge")  # moat_right, at the roof
    roof = [line for line in made.lines if line.kind == "stem"][2]
    assert {x for x, _ in bridge.points} == {roof.points[0][0]}
    assert bridge.points[0][1] < bridge.points[1][1] <= roof.points[1][1]
    shapes = re.findall(r'<(polyline|polygon|text) [^>]*?stroke(?:-width)?="([^"]+)"', as_svg(made))
    assert [tag for tag, _ in shapes[-3:]] == ["polyline"] * 3  # the stems, above the texts


def test_texts_move_with_what_they_stand_between() -> None:
    rest = drawing(ALL, MotionFrame({}, {}, 100.0))
    moved = drawing(ALL, MotionFrame({"roof": 0.1}, {}, 100.0))
    shifts = {a.text: b.at[0] - a.at[0] for a, b in zip(rest.words, moved.words, strict=True)}
    assert shifts["roof\n300 t"] == pytest.approx(10.0)
    assert shifts["storey_2"] == pytest.approx(5.0)
    assert shifts["storey_0"] == 0.0
