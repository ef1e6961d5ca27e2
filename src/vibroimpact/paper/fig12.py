"""Fig. 12: phase portraits of the fitted model, B2-G1-A3."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import phase_portrait
from vibroimpact.paper.fig07 import CODE
from vibroimpact.paper.fig08 import PLACES
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy


def draw(study: PublishedStudy) -> Figure:
    """The three frequencies side by side."""
    figure = Figure(figsize=(12.6, 4.6), layout="constrained")
    axes = figure.subplots(1, len(PLACES))
    places = study.regular_places(CODE, "identified")
    for ax, place, frequency in zip(axes, PLACES, places, strict=True):
        phase_portrait(
            {
                f"{direction} sweep": study.motion(
                    CODE, frequency, direction, "identified", samples=1024
                )
                for direction in ("forward", "backward")
            },
            ax,
        )
        handles = ax.get_legend().legend_handles
        ax.get_legend().remove()
        ax.set_title(f"{place}: {frequency:.2f} Hz", fontsize="medium")
    for ax in axes[1:]:
        ax.set_ylabel("")
    figure.legend(handles=handles, loc="outside lower center", ncols=2, frameon=False)
    return figure


ITEM = Item(
    key="fig12",
    title="Fig. 12: phase portraits of the fitted model, B2-G1-A3",
    caption=(
        "Relative velocity against relative displacement at the three frequencies marked in "
        "Fig. 11, with the parameters fitted to this test; diamonds mark one phase of the forcing, "
        "dashed lines the gaps. At the secondary resonance the orbit has small inner loops, which "
        "the paper sees in its computed cycle, too. The paper compares with measured orbits; they "
        "are not published as numbers and are missing here."
    ),
    draw=draw,
)
