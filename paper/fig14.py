"""Fig. 14: the laboratory tests and their scenarios."""

from __future__ import annotations

from matplotlib.figure import Figure

from paper.report_item import Item
from paper.study import PublishedStudy
from vibroimpact.figures import scenario_cases


def draw(study: PublishedStudy) -> Figure:
    """Draw a panel for each acceleration."""
    figure = scenario_cases(study.scenarios())[0].get_figure(root=True)
    assert figure is not None
    return figure


ITEM = Item(
    key="fig14",
    title="Fig. 14: the 48 tests and their scenarios",
    caption=(
        "Each square is one test of the campaign. The program determines its scenario from "
        "computed curves. There is one panel for each table acceleration, with the bumpers on the "
        "vertical axis and the gaps on the horizontal axis. The tests with the widest gap and the "
        "smallest acceleration only graze the bumpers (S1). Secondary resonances (S3) occur with "
        "small gaps, stiff bumpers and larger accelerations. The computed curves begin at 0.5 Hz, "
        "as the tests do. If they begin at 0.44 Hz, as in vibroimpact classify, B1-G1-A3 is S3, "
        "because it has a peak at 0.51 Hz, at the very edge of the range. The paper determines the "
        "scenarios from measured curves. The full report tests the statements of the paper about "
        "these scenarios."
    ),
    draw=draw,
)
