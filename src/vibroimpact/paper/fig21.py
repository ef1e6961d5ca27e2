"""Fig. 21: scenarios over stiffness ratio and gap ratio."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import Mark, scenario_map
from vibroimpact.figures.style import BUMPERS
from vibroimpact.model import laboratory
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import Study
from vibroimpact.scenario.borders import jump_border


def draw(study: Study) -> Figure:
    """The map, with the tests and the sections of Figs. 19 and 20."""
    data = study.map()
    table = laboratory.table_1()
    marks = []
    for bumper, marker in BUMPERS.items():
        pairs = [
            (table.stiffness_ratio[a][bumper], gap)
            for a, gaps in table.gap.items()
            for gap in gaps.values()
        ]
        ratios, gaps = zip(*pairs, strict=True)
        marks.append(Mark(f"tests with {bumper}", marker, ratios, gaps))
    sections = {
        "B3-A3, as in Fig. 19": ([table.stiffness_ratio["A3"]["B3"]] * 2, [0.0, 1.0]),
        "G3-A1, as in Fig. 20": ([0.5, 100.0], [table.gap["A1"]["G3"]] * 2),
    }
    ax = scenario_map(data, border=jump_border(data), marks=marks, lines=sections)
    figure = ax.get_figure(root=True)
    assert figure is not None
    return figure


ITEM = Item(
    key="fig21",
    title="Fig. 21: scenarios by dimensionless parameters",
    caption=(
        "The scenario depends on ratios alone: bumper to isolator stiffness (λ) and gap to "
        "free-flight amplitude (δ0, of one side), here at a damping ratio of 0.15 and a relaxation "
        "time of 0.01. Symbols are the 48 tests. The dashed curve is exact: on it the two folds of "
        "the resonance meet in a cusp, and jumps begin. Below δ0 = 0.2 and λ = 2, where the paper "
        "has no results, some rigs fit none of its scenarios: secondary resonances without jumps."
    ),
    draw=draw,
)
