"""Fig. 3: free flight at the three table accelerations."""

from __future__ import annotations

from matplotlib.figure import Figure

from paper.report_item import Item
from paper.study import PublishedStudy
from vibroimpact.figures import family_legend, resonance_family
from vibroimpact.figures.family import Quantity
from vibroimpact.figures.legends import add_legend
from vibroimpact.model import laboratory


def draw(study: PublishedStudy) -> Figure:
    """Draw E_a above E_d, with a curve for each acceleration."""
    codes = {f"B1-Ginf-{a}": a for a in laboratory.ACCELERATIONS}
    data = study.family(tuple(codes))
    labels = {code: f"{a} = {_share(a)} g" for code, a in codes.items()}
    figure = Figure(figsize=(7.2, 6.8), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True)
    quantities: tuple[Quantity, ...] = ("acceleration_excursion", "displacement_excursion")
    for ax, quantity in zip((upper, lower), quantities, strict=True):
        resonance_family(data, ax, quantity=quantity, labels=labels, free=False, legend=False)
    upper.set_xlabel("")
    add_legend(upper, family_legend(upper), columns=5)
    figure.align_ylabels()
    return figure


def _share(acceleration: str) -> str:
    return f"{laboratory.ACCELERATIONS[acceleration] / 9.80665:.2f}"


ITEM = Item(
    key="fig03",
    title="Fig. 3: free flight, excursions of absolute acceleration and relative displacement",
    caption=(
        "The figure shows the steady response without bumpers at the three table accelerations, "
        "computed with the Simplified Nonlinear Model. The paper shows measurements here. The "
        "isolator of the model is linear. Therefore no single curve bends to the left or shows "
        "hysteresis, unlike the measured curves, and both sweeps coincide. The softening appears "
        "only in the comparison of the three curves, because each acceleration has its own "
        "equivalent stiffness. At a larger acceleration, the peak is higher and lies at a lower "
        "frequency."
    ),
    draw=draw,
)
