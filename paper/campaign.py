"""Figs. 5 and 6: η_a and η_d of all tests, with a panel for each bumper and acceleration."""

from __future__ import annotations

from typing import Literal

from matplotlib.figure import Figure

from paper.report_item import Item
from paper.study import PublishedStudy
from vibroimpact.figures import family_legend, resonance_family
from vibroimpact.model import laboratory


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
            "The figure shows the excursion of absolute acceleration divided by the largest one of "
            "free flight. Each panel is for one bumper and one table acceleration. The bumpers "
            "become stiffer from top to bottom, and the acceleration increases from left to right. "
            "Each panel has a curve for each total gap from 15 mm (G1) to 30 mm (G4). The paper "
            "shows measurements. Here, the same 48 cases are computed with the Simplified "
            "Nonlinear Model. Smaller gaps, stiffer bumpers and larger accelerations move the "
            "jumps of the forward sweep (solid arrows) to higher frequencies. They move the jumps "
            "of the backward sweep (dashed arrows) less. They also cause secondary resonances near "
            "0.6 Hz, some with a left hysteresis that is too narrow to be seen here. The curves "
            "for soft bumpers and small accelerations are closest to free flight. With B4, there "
            "are irregular peaks where contact begins. The vertical scales differ by row."
        ),
        draw=lambda study: panels_of(study, "eta_a"),
    ),
    Item(
        key="fig06",
        title="Fig. 6: normalised displacement of the 48 tests",
        caption=(
            "As Fig. 5, for the excursion of relative displacement. The paper shows measurements. "
            "Here, the cases are computed with the Simplified Nonlinear Model. Bumpers keep the "
            "displacement below the largest displacement of free flight. The stiffer the bumper "
            "is, the flatter is the branch in contact, because the mass hardly presses into a "
            "stiff bumper. Above the resonance of free flight, the branch in contact lies above "
            "the curve of free flight. Solid arrows are jumps of the forward sweep, and dashed "
            "arrows are jumps of the backward sweep. The vertical scales differ by row."
        ),
        draw=lambda study: panels_of(study, "eta_d"),
    ),
)
