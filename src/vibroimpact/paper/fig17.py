"""Fig. 17: scenario S5, B3 attached to the mass at A3."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import resonance_curves
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy

CODE = "B3-0mm-A3"
LOW, HIGH = 0.3, 10.0


def draw(study: PublishedStudy) -> Figure:
    """The curves, up to twice the range of the tests."""
    axes = resonance_curves(study.curves(CODE, low=LOW, high=HIGH))
    return axes[0].get_figure(root=True)  # type: ignore[return-value]


ITEM = Item(
    key="fig17",
    title="Fig. 17: scenario S5, B3 without a gap at A3",
    caption=(
        "Resonance curves with the bumpers touching the mass at rest. All is smooth again: both "
        "sweeps coincide, without jumps and without secondary resonances. One bumper after the "
        "other adds its stiffness to the isolator's, so that the resonance lies at about five "
        "times the frequency of free flight. The computed peak is near 5.7 Hz, where the paper "
        "gives about 5.4 Hz."
    ),
    draw=draw,
)
