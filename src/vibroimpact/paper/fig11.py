"""Fig. 11: the fitted model of scenario S3, B2-G1-A3."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.paper.fig07 import curves_of
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy


def draw(study: PublishedStudy) -> Figure:
    """With the identified parameters."""
    return curves_of(study, "identified")


ITEM = Item(
    key="fig11",
    title="Fig. 11: fitted model of scenario S3, B2-G1-A3",
    caption=(
        "Resonance curves of the Simplified Nonlinear Model with the parameters that the paper "
        "fitted to this very test (its Section 5), rather than those of the whole campaign as in "
        "Fig. 7. The paper lays its measured points over them; they are not published as numbers, "
        "so the model stands alone here. I, II and III mark the frequencies of Fig. 12."
    ),
    draw=draw,
)
