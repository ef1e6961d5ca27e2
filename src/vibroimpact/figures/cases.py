"""The scenario of each laboratory test, as in the paper's Fig. 14."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from vibroimpact.errors import InputError
from vibroimpact.figures.figure_dimensions import columns_that_fit
from vibroimpact.figures.finish import finished
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.notebook import Panels, new_axes
from vibroimpact.figures.style import SCENARIOS
from vibroimpact.model import laboratory
from vibroimpact.scenarios.scenario import Scenario

_PER_GRAVITY = 1e2 / 9.80665


@finished
def scenario_cases(scenarios: Mapping[str, str], *, title: str | None = None) -> Panels:
    """Draw the scenarios of laboratory tests over gap and bumper, with one panel per acceleration.

    Parameters
    ----------
    scenarios
        Scenarios, as a mapping from case codes such as ``"B2-G1-A3"`` to scenarios. A scenario is
        one of ``"S0"`` to ``"S6"``, or ``"unclassified"``. Tests that are missing in the mapping
        are left blank.
    title
        Title of the figure.

    Returns
    -------
    tuple of Axes
        One Axes for each acceleration, in rising order. ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If a code is not the code of a laboratory test, or if a scenario is unknown.
    """
    known = {case.code for case in laboratory.campaign()}
    for code, scenario in scenarios.items():
        if code not in known:
            raise InputError(
                f"scenarios: {code!r} is not a laboratory test; use codes from B1-G1-A1 to B4-G4-A3"
            )
        if scenario not in SCENARIOS:
            raise InputError(
                f"scenarios[{code}]: {scenario!r} is not a scenario; use one of "
                f"{', '.join(SCENARIOS)}"
            )
    bumpers, gaps = list(laboratory.BUMPERS), list(laboratory.GAPS)
    count = len(laboratory.ACCELERATIONS)
    # Headings of narrow panels have two lines, and their legend has more lines.
    narrow = columns_that_fit(count) < count
    size = (9.6, 6.0 if narrow else 4.0)
    break_ = "\n" if narrow else " "
    axes = Panels(new_axes(1, count, size, sharey=True)[0])
    figure = axes[0].get_figure(root=True)
    assert figure is not None
    for ax, (name, value) in zip(axes, laboratory.ACCELERATIONS.items(), strict=True):
        for i, gap in enumerate(gaps):
            for j, bumper in enumerate(bumpers):
                _cell(ax, i, j, scenarios.get(f"{bumper}-{gap}-{name}"))
        ax.set_xlim(0, len(gaps))
        ax.set_ylim(0, len(bumpers))
        ax.set_aspect("equal")
        millimetres = [f"{gap}\n{1e3 * laboratory.GAPS[gap]:g}" for gap in gaps]
        ax.set_xticks([i + 0.5 for i in range(len(gaps))], millimetres)
        ax.set_yticks(
            [j + 0.5 for j in range(len(bumpers))],
            [f"{b}  {1e-3 * laboratory.BUMPERS[b]:g}" for b in bumpers],
        )
        ax.tick_params(length=0)
        ax.set_title(f"{name}:{break_}{_PER_GRAVITY * value:.0f} % of gravity", fontsize="medium")
        ax.set_xlabel("total gap $G$ (mm)")
    axes[0].set_ylabel("bumper stiffness\n$K_j$ (kN/m)")
    if title:
        figure.suptitle(title)
    add_legend(
        figure,
        [
            SCENARIOS[s.label].entry(f"{s.label}: {s.meaning}")
            for s in Scenario
            if s.label in scenarios.values()
        ],
        columns=3,
        handlelength=2.4,
        handleheight=1.2,
    )
    return axes


def _cell(ax: Axes, column: int, row: int, scenario: str | None) -> None:
    look = SCENARIOS[scenario] if scenario else None
    ax.add_patch(
        Rectangle(
            (column, row),
            1,
            1,
            facecolor=look.colour if look else "white",
            edgecolor=look.line if look else "0.6",
            hatch=look.hatch if look else "",
            linewidth=0.8,
        )
    )
    if scenario:
        ax.text(
            column + 0.5,
            row + 0.5,
            scenario,
            ha="center",
            va="center",
            fontweight="bold",
            bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "linewidth": 0.0},
        )
