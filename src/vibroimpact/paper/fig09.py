"""Fig. 9: scenario S2, B2-G2-A2."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import resonance_curves
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy


def draw(study: PublishedStudy) -> Figure:
    """The curves."""
    axes = resonance_curves(study.curves("B2-G2-A2"))
    return axes[0].get_figure(root=True)  # type: ignore[return-value]


ITEM = Item(
    key="fig09",
    title="Fig. 9: scenario S2, B2-G2-A2",
    caption=(
        "Resonance curves of bumper B2 with a total gap of 20 mm at 0.04 g, computed with the "
        "Simplified Nonlinear Model; the paper shows measurements. There is the primary resonance "
        "with its right hysteresis and nothing else. Unlike in Fig. 7 the gap is so wide that "
        "the mass reaches the bumpers in a middle range of frequencies only; outside it the curves "
        "are those of free flight."
    ),
    draw=draw,
)
