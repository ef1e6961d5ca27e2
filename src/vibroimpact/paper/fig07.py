"""Fig. 7: scenario S3, B2-G1-A3."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import frequency_marks, resonance_curves
from vibroimpact.model import laboratory
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy

CODE = "B2-G1-A3"
NAMES = ("I", "II", "III")


def curves_of(study: PublishedStudy, parameters: laboratory.Parameters) -> Figure:
    """The curves, with the three frequencies of Figs. 8 and 12 marked."""
    axes = resonance_curves(study.curves(CODE, parameters))
    places = study.regular_places(CODE, parameters)
    frequency_marks(axes, dict(zip(NAMES, places, strict=True)))
    return axes[0].get_figure(root=True)  # type: ignore[return-value]


def draw(study: PublishedStudy) -> Figure:
    """With the table's parameters."""
    return curves_of(study, "table")


ITEM = Item(
    key="fig07",
    title="Fig. 7: scenario S3, B2-G1-A3",
    caption=(
        "Resonance curves of bumper B2 with a total gap of 15 mm at 0.05 g, computed with the "
        "Simplified Nonlinear Model; the paper shows measurements. The primary resonance ends in "
        "a jump and leaves a right hysteresis; well below it lies a secondary resonance. At all "
        "frequencies swept both directions agree on it, but its branch of orbits turns back "
        "between two of them: a left hysteresis of less than 0.01 Hz, which no test would show. "
        "The marked frequencies are read off the computed curve: I the secondary resonance, II "
        "the valley behind it, III just before the downward jump. Contact begins below 0.5 Hz."
    ),
    draw=draw,
)
