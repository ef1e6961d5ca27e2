"""Fig. 19: B3-A3 with gaps from zero to free flight."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr
from matplotlib.figure import Figure

from vibroimpact.figures import family_legend, resonance_family
from vibroimpact.figures.family import Quantity
from vibroimpact.figures.style import SCENARIOS
from vibroimpact.model import laboratory
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import GAPS, Study

LOW, HIGH = 0.3, 8.0


def draw(study: Study) -> Figure:
    """η_a above η_d, a curve for each gap."""
    names = {f"B3-{gap}-A3": _name(gap) for gap in GAPS}
    scenarios = {code: study.classification(code, LOW, HIGH).scenario for code in names}
    return family_of(study.by_gap(), names, scenarios, "total gap, scenario")


def family_of(
    data: xr.Dataset, names: Mapping[str, str], scenarios: Mapping[str, str], heading: str
) -> Figure:
    """Curves of several rigs, coloured by scenario, which the legend names as well."""
    figure = Figure(figsize=(10.4, 9.6), layout="constrained")
    axes = figure.subplots(2, 1, sharex=True)
    quantities: tuple[Quantity, ...] = ("eta_a", "eta_d")
    for ax, quantity in zip(axes, quantities, strict=True):
        resonance_family(
            data,
            ax,
            quantity=quantity,
            labels={code: f"{name}, {scenarios[code]}" for code, name in names.items()},
            colours={code: SCENARIOS[scenarios[code]].line for code in names},
            free=False,
            legend=False,
        )
    axes[0].set_xlabel("")
    figure.align_ylabels()
    figure.legend(
        handles=family_legend(axes[0]),
        loc="outside right upper",
        frameon=False,
        title=heading,
        alignment="left",
    )
    return figure


def _name(gap: str) -> str:
    if gap == "Ginf":
        return "no bumpers"
    if gap in laboratory.GAPS:
        return f"{1e3 * laboratory.GAPS[gap]:g} mm ({gap})"
    return gap.replace("mm", " mm")


ITEM = Item(
    key="fig19",
    title="Fig. 19: B3-A3 with different total gaps",
    caption=(
        "From the widest gap to none: free flight, then a primary resonance that bends further "
        "and further to the right (S2), secondary resonances below it (S3), left hysteresis and "
        "motions that are not regular (S4), and at last, without a gap, one smooth resonance (S5). "
        "Solid lines are forward sweeps, dashed ones backward sweeps, arrows their jumps; colours "
        "and the legend tell the scenario that the program names. Where the curves of the "
        "smallest gaps are ragged, below about 2 Hz, many motions do not settle."
    ),
    draw=draw,
)
