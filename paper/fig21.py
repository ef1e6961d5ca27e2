"""Fig. 21: scenarios over stiffness ratio and gap ratio."""

from __future__ import annotations

from matplotlib.figure import Figure

from paper.report_item import Item
from paper.study import PublishedStudy
from vibroimpact.figures import Mark, scenario_map
from vibroimpact.figures.style import BUMPERS, SCENARIOS
from vibroimpact.model import laboratory
from vibroimpact.scenarios.borders import jump_border


def draw(study: PublishedStudy) -> Figure:
    """Draw the map, with the tests and the lines of Figs. 19 and 20."""
    data = study.map()
    table = laboratory.table_1()
    scenarios = study.scenarios()
    marks = []
    for bumper, marker in BUMPERS.items():
        mine: dict[str, list[tuple[float, float]]] = {}
        for a, gaps in table.gap.items():
            for name, gap in gaps.items():
                place = (table.stiffness_ratio[a][bumper], gap)
                mine.setdefault(scenarios[f"{bumper}-{name}-{a}"], []).append(place)
        marks.append(Mark(f"tests with {bumper}, coloured by scenario", marker, (), ()))
        for scenario in sorted(mine):
            ratios, deltas = zip(*mine[scenario], strict=True)
            marks.append(Mark("", marker, ratios, deltas, SCENARIOS[scenario].line))
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
        "The scenario depends only on dimensionless ratios. The map shows it over the stiffness "
        "ratio of bumper and isolator (λ), and the ratio of the gap of one side to the amplitude "
        "of free flight (δ0). The damping ratio is 0.15 and the relaxation time is 0.01. Each "
        "symbol is one of the 48 tests, filled with a darker shade of the colour of its scenario. "
        "The borders between the scenarios have steps because the grid is coarse. Only the dashed "
        "curve is exact. On this curve, the two folds of the resonance meet in a cusp, and jumps "
        "begin. An unclassified point has secondary resonances, but no jump at the primary "
        "resonance. Such points occur at small gaps and at λ below about 4. They fit none of the "
        "scenarios in the paper."
    ),
    draw=draw,
)
