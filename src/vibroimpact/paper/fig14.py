"""Fig. 14: the laboratory tests and their scenarios."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import scenario_cases
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy


def draw(study: PublishedStudy) -> Figure:
    """Draw a panel for each acceleration."""
    figure = scenario_cases(study.scenarios())[0].get_figure(root=True)
    assert figure is not None
    return figure


ITEM = Item(
    key="fig14",
    title="Fig. 14: the 48 tests and their scenarios",
    caption=(
        "Each square is one test of the campaign, named by the program from computed curves: its "
        "bumper upwards, its gap to the right, a panel for each table acceleration. The widest "
        "gap with the smallest acceleration only grazes (S1); secondary resonances (S3) come with "
        "small gaps, stiff bumpers and larger accelerations. The curves begin at 0.5 Hz, as the "
        "tests do; from 0.44 Hz, where vibroimpact classify begins, B1-G1-A3 is S3, for it has a "
        "peak at 0.51 Hz, at the very edge. The paper names them from measured curves; what its "
        "text says of them is among the statements below."
    ),
    draw=draw,
)
