"""The published rig with an isolator that softens with the displacement.

With a linear isolator the upward jump occurs at a frequency that is too low. Therefore the paper
ends with the wish for a model "that includes all the nonlinearities". In this module one law with
one parameter set (`laboratory.REFINED`) replaces the equivalent stiffness of each acceleration.
Figures and statements are computed again.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from matplotlib.figure import Figure

from vibroimpact.model import GRAVITY, Harmonic, Oscillator, laboratory
from vibroimpact.model.rig import Rig
from vibroimpact.paper import fig03, fig14
from vibroimpact.paper.campaign import panels_of
from vibroimpact.paper.curves import S2, S3, curves_of
from vibroimpact.paper.item import Item, Table
from vibroimpact.paper.study import PublishedStudy
from vibroimpact.response.numerical_free_response import largest_flight, resonance


def equivalent(isolator: str, acceleration: str) -> tuple[float, float]:
    """Return stiffness (N/m) and damping ratio of the linear isolator with the same resonance peak.

    The peak of the acceleration without stops has the same height and the same frequency.
    """
    rig = Oscillator(laboratory.MASS, laboratory.REFINED[isolator])
    shaken = Harmonic(laboratory.ACCELERATIONS[acceleration], 1.0)
    height = 0.5 * largest_flight(Rig(rig, shaken))[1] / shaken.amplitude
    # H² = (1 + d)/((1 - s)² + d) at s = r² = 2/(1 + √(1 + 8ξ²)), d = 4ξ²s, is H² = 1/(1 - s²)
    square = math.sqrt(1.0 - height**-2)
    ratio = math.sqrt(((2.0 / square - 1.0) ** 2 - 1.0) / 8.0)
    below = math.sqrt(1.0 - 2.0 * ratio**2)
    omega = math.tau * resonance(Rig(rig, shaken)) / below
    return laboratory.MASS * omega**2, ratio


def isolators(study: PublishedStudy) -> Table:
    """Return a table of the laws, and of their equivalent parameters at each acceleration."""
    wanted = [f"{1e-3 * k:.2f} kN/m, 0.15" for k in laboratory.ISOLATOR_STIFFNESS.values()]
    rows = [("wanted", "", *wanted)]
    for name, law in laboratory.REFINED.items():
        told = str(law).split("(", 1)[1].removesuffix(")")
        each = (equivalent(name, a) for a in laboratory.ACCELERATIONS)
        rows.append((name, told, *(f"{1e-3 * k:.2f} kN/m, {ratio:.3f}" for k, ratio in each)))
    heads = (f"at {a / GRAVITY:.2f} g" for a in laboratory.ACCELERATIONS.values())
    return Table(("isolator", "parameters", *heads), tuple(rows))


_FIGURES: tuple[tuple[str, str, Callable[[PublishedStudy], Figure]], ...] = (
    (
        "Fig. 3, free flight",
        "Steady response without bumpers at the three table accelerations, with one isolator. The "
        "curves bend to the left, as the measured ones do: above the resonance they fall more "
        "slowly than below it. Both sweeps coincide, for the isolator loses much energy.",
        fig03.draw,
    ),
    (
        "Fig. 5, normalised acceleration of the 48 tests",
        "As Fig. 5, with the refined isolator. Both jumps lie at higher frequencies: at the "
        "smaller amplitudes of contact the isolator is stiffer than in free flight's resonance.",
        lambda study: panels_of(study, "eta_a"),
    ),
    (
        "Fig. 6, normalised displacement of the 48 tests",
        "As Fig. 6, with the refined isolator.",
        lambda study: panels_of(study, "eta_d"),
    ),
    (
        "Fig. 11, scenario S3, B2-G1-A3",
        "As Fig. 11, with the refined isolator in the place of parameters fitted to this test. The "
        "upward jump has moved up, by a multiple of what any bumper changes.",
        lambda study: curves_of(study, S3),
    ),
    (
        "Fig. 13, scenario S2, B2-G2-A2",
        "As Fig. 13, with the refined isolator in the place of fitted parameters.",
        lambda study: curves_of(study, S2),
    ),
    (
        "Fig. 14, the 48 tests and their scenarios",
        "As Fig. 14, with the refined isolator.",
        fig14.draw,
    ),
)


def _item(title: str, caption: str, draw: Callable[[PublishedStudy], Figure]) -> Item:
    number = int(title.split()[1].rstrip(","))
    return Item(
        f"refined-fig{number:02}",
        f"Refined model: {title}",
        caption,
        lambda study: draw(study.refined()),
    )


ITEMS: tuple[Item, ...] = (
    Item(
        key="refined-isolators",
        title="Refined model: isolators that soften by themselves",
        caption=(
            "Three hysteretic laws, each with one parameter set for all table accelerations, and "
            "the stiffness and damping ratio of the linear isolator whose free flight has its "
            "largest acceleration at the same frequency and of the same height. The figures below "
            "are computed with the first law, which fits best; the others hardly differ."
        ),
        table=isolators,
    ),
    *(_item(*one) for one in _FIGURES),
)
