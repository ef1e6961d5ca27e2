"""Fig. 4: the effect of contact, shown by B4-G4-A3 and by free flight."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from paper.report_item import Item
from paper.study import PublishedStudy
from vibroimpact.figures import hysteresis_cycle, resonance_curves
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.style import FREE

CODE, NO_BUMPERS = "B4-G4-A3", "B4-Ginf-A3"


def draw(study: PublishedStudy) -> Figure:
    """Draw the cycles at resonance on the left, and the curves on the right."""
    data, flight = study.curves(CODE), study.curves(NO_BUMPERS)
    at = _highest(data)
    at_free = _highest(flight)
    figure = Figure(figsize=(12.0, 6.6), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=[1.0, 1.25])
    cycle = figure.add_subplot(grid[:, 0])
    hysteresis_cycle(
        {
            f"{CODE}, forward resonance, {at:.2f} Hz": study.motion(CODE, at, "forward"),
            f"free flight, resonance, {at_free:.2f} Hz": study.motion(
                NO_BUMPERS, at_free, "forward"
            ),
        },
        cycle,
    )
    cycle.lines[1].set_linestyle(FREE.dashes)
    add_legend(cycle, columns=1)
    upper = figure.add_subplot(grid[0, 1])
    lower = figure.add_subplot(grid[1, 1], sharex=upper)
    resonance_curves(data, [upper, lower], physical=False)
    upper.tick_params(labelbottom=False)
    figure.align_ylabels([upper, lower])
    return figure


def _highest(data: xr.Dataset) -> float:
    """Return the frequency (Hz) at which the acceleration of the forward sweep is largest."""
    one = data["eta_a"].sel(direction="forward")
    return float(one["frequency"][int(one.values.argmax())])


ITEM = Item(
    key="fig04",
    title="Fig. 4: free flight and contact, B4-G4-A3",
    caption=(
        "Left: absolute acceleration against relative displacement at resonance, with the stiff "
        "bumper B4 and without bumpers. The acceleration jumps where the displacement reaches a "
        "gap (dashed lines). Beyond the gaps, the stiffness of the bumper determines the slope of "
        "the cycle. Right: normalised excursions against frequency. Contact bends the resonance to "
        "the right. Between the two jumps (shaded), the forward sweep stays on the large motion, "
        "and the backward sweep stays in free flight. The paper measured this case. Here it is "
        "computed with the Simplified Nonlinear Model, in which the curves of free flight neither "
        "bend nor jump. Near 0.9 Hz, the model has a second, very narrow hysteresis that the paper "
        "does not mention."
    ),
    draw=draw,
)
