"""Figs. 19 and 20: B3-A3 with different gaps, and G3-A1 with different bumper stiffnesses."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr
from matplotlib.figure import Figure

from paper.report_item import Item
from paper.study import GAPS, STIFFNESSES, PublishedStudy
from vibroimpact.figures import family_legend, resonance_family
from vibroimpact.figures.family import Quantity
from vibroimpact.figures.style import SCENARIOS
from vibroimpact.model import laboratory

LOW, HIGH = 0.3, 8.0
NEAR = (0.3, 2.0)
"""Magnified frequency range (Hz), which contains the secondary resonances."""
NOT_NEAR = ("2mm", "5mm")
"""Gaps that are left out of this range. Most of their motions do not settle there, and would cover
the other curves."""
SHOWN = (0.8, 1.8)
"""Range of Fig. 20 in Hz. Outside it all curves coincide with free flight."""


def _by_gap(study: PublishedStudy) -> Figure:
    """Draw η_a above η_d with a curve for each gap, and magnify the lower part of the range."""
    names = {f"B3-{gap}-A3": _named(gap, laboratory.GAPS, 1e3, "mm") for gap in GAPS}
    scenarios = {code: study.classification(code, LOW, HIGH).scenario for code in names}
    data = study.by_gap()
    kept = [code for code in names if code.split("-")[1] not in NOT_NEAR]
    near = data.sel(rig=kept, frequency=slice(*NEAR))
    return family_of(data, names, scenarios, "total gap, scenario", near)


def family_of(
    data: xr.Dataset,
    names: Mapping[str, str],
    scenarios: Mapping[str, str],
    heading: str,
    near: xr.Dataset | None = None,
) -> Figure:
    """Draw curves of several rigs. Their colours and the legend show the scenarios.

    The curves `near` are shown next to them as a magnified part.
    """
    parts = [data] if near is None else [data, near]
    figure = Figure(figsize=(10.4 if near is None else 14.4, 9.6), layout="constrained")
    axes = figure.subplots(2, len(parts), sharex="col", squeeze=False)
    quantities: tuple[Quantity, ...] = ("eta_a", "eta_d")
    for column, part in enumerate(parts):
        codes = [code for code in names if code in part["rig"].values]
        for ax, quantity in zip(axes[:, column], quantities, strict=True):
            resonance_family(
                part,
                ax,
                quantity=quantity,
                labels={code: f"{names[code]}, {scenarios[code]}" for code in codes},
                colours={code: SCENARIOS[scenarios[code]].line for code in codes},
                markers={code: k for k, code in enumerate(names) if code in codes},
                free=False,
                legend=False,
            )
            if column:
                ax.set_ylabel("")
        axes[0, column].set_xlabel("")
    if near is not None:
        axes[0, 0].set_title("whole range", fontsize="medium")
        axes[0, 1].set_title("{:g} to {:g} Hz".format(*NEAR), fontsize="medium")
    figure.align_ylabels(axes[:, 0])
    figure.legend(
        handles=family_legend(axes[0, 0]),
        loc="outside right upper",
        frameon=False,
        title=heading,
        alignment="left",
    )
    return figure


def _by_stiffness(study: PublishedStudy) -> Figure:
    """Draw η_a above η_d, with a curve for each stiffness."""
    names = {
        f"{stiffness}-G3-A1": _named(stiffness, laboratory.BUMPERS, 1e-3, "kN/m")
        for stiffness in STIFFNESSES
    }
    names["B1-Ginf-A1"] = "no bumpers"
    data = study.by_stiffness().sel(frequency=slice(*SHOWN))
    scenarios = {code: study.classification(code).scenario for code in names}
    return family_of(data, names, scenarios, "bumper stiffness, scenario")


def _named(part: str, known: Mapping[str, float], scale: float, unit: str) -> str:
    if part == "Ginf":
        return "no bumpers"
    if part in known:
        return f"{scale * known[part]:g} {unit} ({part})"
    return part.replace(unit, f" {unit}")


ITEMS = (
    Item(
        key="fig19",
        title="Fig. 19: B3-A3 with different total gaps",
        caption=(
            "The figure shows curves from the widest gap to none. The first curve is free flight. "
            "As the gap becomes smaller, the primary resonance bends further and further to the "
            "right (S2). Then secondary resonances appear below it (S3), followed by left "
            "hysteresis and non-regular motions (S4). Without a gap, there is one smooth resonance "
            "(S5). Solid lines are forward sweeps, dashed lines are backward sweeps, and arrows "
            "are their jumps. The colours and the legend show the scenario that the program "
            "determines. Below about 2 Hz, the curves of the smallest gaps are ragged, because "
            "many motions there do not become periodic. Therefore the magnified panels leave out "
            "the two smallest gaps above zero."
        ),
        draw=_by_gap,
    ),
    Item(
        key="fig20",
        title="Fig. 20: G3-A1 with different bumper stiffnesses",
        caption=(
            "The total gap is 25 mm and the table acceleration is 0.03 g. The stiffness of the "
            "bumpers ranges from a third of the stiffness of the isolator to three hundred times "
            "this stiffness. With the softest bumpers, the peak only bends to the right, without "
            "jump or hysteresis (S6). From B1 on, the peak ends in a jump (S2). No secondary "
            "resonance develops at low frequencies, however stiff the bumper is. With the stiffest "
            "bumper, the motion is irregular just where contact begins. Solid lines are forward "
            "sweeps, and dashed lines are backward sweeps. Outside the range shown, all curves are "
            "those of free flight."
        ),
        draw=_by_stiffness,
    ),
)
