"""Fig. 6: η_d of all tests, a panel for each bumper and acceleration."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.paper.fig05 import panels_of
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy


def draw(study: PublishedStudy) -> Figure:
    """η_d."""
    return panels_of(study, "eta_d")


ITEM = Item(
    key="fig06",
    title="Fig. 6: normalised displacement of the 48 tests",
    caption=(
        "As Fig. 5, for the excursion of relative displacement: computed with the Simplified "
        "Nonlinear Model where the paper shows measurements. Bumpers hold the displacement below "
        "free flight's largest one; the stiffer they are, the flatter is the branch in contact, "
        "because the mass hardly enters the bumper. Above free flight's resonance the contact "
        "branch lies higher than free flight at the same frequency. Solid arrows are jumps of the "
        "forward sweep, dashed ones of the backward sweep; the scales differ by row."
    ),
    draw=draw,
)
