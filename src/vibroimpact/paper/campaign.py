"""Figs. 5 and 6: η_a and η_d of all tests, with a panel for each bumper and acceleration."""

from __future__ import annotations

from typing import Literal

from matplotlib.figure import Figure

from vibroimpact.figures import family_legend, resonance_family
from vibroimpact.model import laboratory
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy


def panels_of(study: PublishedStudy, quantity: Literal["eta_a", "eta_d"]) -> Figure:
    """Draw a row per bumper, a column per acceleration, and a curve per gap and for free flight."""
    data = study.campaign()
    bumpers, accelerations = tuple(laboratory.BUMPERS), tuple(laboratory.ACCELERATIONS)
    figure = Figure(figsize=(12.0, 13.0), layout="constrained")
    axes = figure.subplots(len(bumpers), len(accelerations), sharex=True, sharey="row")
    for bumper, row in zip(bumpers, axes, strict=True):
        tops = []
        for acceleration, ax in zip(accelerations, row, strict=True):
            labels = {f"{bumper}-{gap}-{acceleration}": gap for gap in laboratory.GAPS}
            resonance_family(
                data.sel(rig=list(labels)), ax, quantity=quantity, labels=labels, legend=False
            )
            ax.set_title(f"{bumper}, {acceleration}", fontsize="medium")
            tops.append(ax.get_ylim()[1])
        # They share the scale: that of the highest.
        row[0].set_ylim(0.0, max(tops))
    for ax in axes.flat:
        ax.label_outer()
    figure.align_ylabels()
    figure.legend(
        handles=family_legend(axes[0, 0]), loc="outside upper center", ncols=7, frameon=False
    )
    return figure


ITEMS = (
    Item(
        key="fig05",
        title="Fig. 5: normalised acceleration of the 48 tests",
        caption=(
            "Excursion of absolute acceleration over the largest one of free flight: a panel for "
            "each bumper (downwards stiffer) and table acceleration (rightwards stronger), a curve "
            "for each total gap from 15 mm (G1) to 30 mm (G4). The paper shows measurements; these "
            "are the same 48 cases computed with the Simplified Nonlinear Model. Smaller gaps, "
            "stiffer bumpers and stronger shaking move the forward sweep's jumps (solid arrows) to "
            "higher frequencies, the backward sweep's (dashed arrows) less, and let secondary "
            "resonances appear near 0.6 Hz, some with a left hysteresis too narrow to be seen "
            "here. Soft bumpers and weak shaking stay closest to free flight; B4 makes irregular "
            "peaks where contact begins. The scales differ by row."
        ),
        draw=lambda study: panels_of(study, "eta_a"),
    ),
    Item(
        key="fig06",
        title="Fig. 6: normalised displacement of the 48 tests",
        caption=(
            "As Fig. 5, for the excursion of relative displacement: computed with the Simplified "
            "Nonlinear Model where the paper shows measurements. Bumpers hold the displacement "
            "below free flight's largest one; the stiffer they are, the flatter is the branch in "
            "contact, because the mass hardly enters the bumper. Above free flight's resonance the "
            "contact branch lies higher than free flight at the same frequency. Solid arrows are "
            "jumps of the forward sweep, dashed ones of the backward sweep; the scales differ by "
            "row."
        ),
        draw=lambda study: panels_of(study, "eta_d"),
    ),
)
