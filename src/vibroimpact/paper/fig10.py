"""Fig. 10: scenario S1, B2-G4-A1."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import resonance_curves
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy


def draw(study: PublishedStudy) -> Figure:
    """The curves."""
    axes = resonance_curves(study.curves("B2-G4-A1"))
    return axes[0].get_figure(root=True)  # type: ignore[return-value]


ITEM = Item(
    key="fig10",
    title="Fig. 10: scenario S1, B2-G4-A1",
    caption=(
        "Bumper B2 with the widest gap, 30 mm, at the weakest shaking, 0.03 g, computed with the "
        "Simplified Nonlinear Model; the paper shows measurements. The gap is 0.93 of free "
        "flight's amplitude, so that the mass touches the bumpers near resonance only, and the "
        "displacement stays close to free flight's. The model's contact is not quite without "
        "consequence: the acceleration rises visibly where the mass touches, and the peak ends "
        "in a hysteresis narrower than a step of the tests (0.1 Hz)."
    ),
    draw=draw,
)
