"""Fig. 18: the motion of scenario S5 at resonance, B3 attached to the mass at A3."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import clearances, phase_portrait, spectrum_lines, time_history
from vibroimpact.paper.fig17 import CODE, HIGH, LOW
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy
from vibroimpact.response.spectrum import spectrum


def draw(study: PublishedStudy) -> Figure:
    """Portrait and spectrum above; histories on the left, clearances on the right."""
    curve = study.curves(CODE, low=LOW, high=HIGH)["eta_d"].sel(direction="forward")
    frequency = float(curve["frequency"][int(curve.values.argmax())])
    motion = study.motion(CODE, frequency, "forward", samples=8192)
    figure = Figure(figsize=(12.0, 12.0), layout="constrained")
    grid = figure.add_gridspec(4, 2, height_ratios=[1.5, 1.0, 1.0, 1.0])
    phase_portrait(motion, figure.add_subplot(grid[0, 0]))
    spectrum_lines(spectrum(motion), figure.add_subplot(grid[0, 1]))
    first = figure.add_subplot(grid[1, 0])
    histories = [first, *(figure.add_subplot(grid[i, 0], sharex=first) for i in (2, 3))]
    time_history(motion, histories, cycles=2.0)
    for ax in histories[:-1]:
        ax.tick_params(labelbottom=False)
    clearances(motion, [figure.add_subplot(grid[1, 1]), figure.add_subplot(grid[2:, 1])])
    figure.suptitle(f"resonance, {frequency:.2f} Hz")
    return figure


ITEM = Item(
    key="fig18",
    title="Fig. 18: motion of scenario S5 at resonance, B3 without a gap at A3",
    caption=(
        "Portrait, spectrum, time histories and clearances (the distances from the mass to each "
        "bumper) at the resonance of Fig. 17. The motion is nearly a sine, and the mass seems to "
        "be pressed by one bumper or the other all the time. Magnified (lower right), there are "
        "two very short flights a cycle, in which both clearances are open: the bumper that the "
        "mass leaves has still a little to recover, the one that it meets has long done so."
    ),
    draw=draw,
)
