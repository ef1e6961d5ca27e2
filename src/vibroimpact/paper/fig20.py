"""Fig. 20: G3-A1 with bumpers from soft to nearly rigid."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.model import laboratory
from vibroimpact.paper.fig19 import family_of
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import STIFFNESSES, PublishedStudy

SHOWN = (0.8, 1.8)
"""Range in Hz; outside it all curves are those of free flight."""


def draw(study: PublishedStudy) -> Figure:
    """η_a above η_d, a curve for each stiffness."""
    names = {f"{stiffness}-G3-A1": _name(stiffness) for stiffness in STIFFNESSES}
    names["B1-Ginf-A1"] = "no bumpers"
    data = study.by_stiffness().sel(frequency=slice(*SHOWN))
    scenarios = {code: study.classification(code).scenario for code in names}
    return family_of(data, names, scenarios, "bumper stiffness, scenario")


def _name(stiffness: str) -> str:
    if stiffness in laboratory.BUMPERS:
        return f"{1e-3 * laboratory.BUMPERS[stiffness]:g} kN/m ({stiffness})"
    return stiffness.replace("kN/m", " kN/m")


ITEM = Item(
    key="fig20",
    title="Fig. 20: G3-A1 with different bumper stiffnesses",
    caption=(
        "Total gap 25 mm at 0.03 g, with bumpers from a third of the isolator's stiffness to three "
        "hundred times as stiff. With the softest ones the peak only leans to the right, without "
        "jump or hysteresis (S6); from B1 on it ends in a jump (S2). No "
        "secondary resonance develops at low frequencies, however stiff the bumper; the stiffest "
        "one makes the motion irregular just where contact begins. Solid lines are forward sweeps, "
        "dashed ones backward sweeps; outside the range shown all is free flight."
    ),
    draw=draw,
)
