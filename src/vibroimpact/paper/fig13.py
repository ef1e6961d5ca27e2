"""Fig. 13: the fitted model of scenario S2, B2-G2-A2."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import resonance_curves
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy


def draw(study: PublishedStudy) -> Figure:
    """With the identified parameters."""
    axes = resonance_curves(study.curves("B2-G2-A2", "identified"))
    return axes[0].get_figure(root=True)  # type: ignore[return-value]


ITEM = Item(
    key="fig13",
    title="Fig. 13: fitted model of scenario S2, B2-G2-A2",
    caption=(
        "Resonance curves of the Simplified Nonlinear Model with the parameters that the paper "
        "fitted to this test, rather than those of the whole campaign as in Fig. 9. The paper "
        "compares them with measured points, which are not published as numbers: how close model "
        "and experiment are cannot be judged here. The fitted isolator is stiffer than the one "
        "that the campaign's table implies, so that both jumps lie higher than in Fig. 9."
    ),
    draw=draw,
)
