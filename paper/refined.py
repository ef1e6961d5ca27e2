"""The published rig with an isolator that softens with the displacement.

With a linear isolator, the upward jump occurs at a frequency that is too low. Therefore the paper
concludes that a model is needed "that includes all the nonlinearities". In this module, one law
with one parameter set (`laboratory.REFINED`) replaces the equivalent stiffness of each
acceleration, and the figures and statements are computed again.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from matplotlib.figure import Figure

from paper import fig03, fig14
from paper.campaign import panels_of
from paper.curves import S2, S3, curves_of
from paper.report_item import Item, Table
from paper.study import PublishedStudy
from vibroimpact.model import GRAVITY, Harmonic, Oscillator, laboratory
from vibroimpact.model.rig import Rig
from vibroimpact.response.free_response import largest_flight, resonance


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
    rows = [("target", "", *wanted)]
    for name, law in laboratory.REFINED.items():
        parameters = str(law).split("(", 1)[1].removesuffix(")")
        each = (equivalent(name, a) for a in laboratory.ACCELERATIONS)
        rows.append((name, parameters, *(f"{1e-3 * k:.2f} kN/m, {ratio:.3f}" for k, ratio in each)))
    heads = (
        f"stiffness and damping ratio at {a / GRAVITY:.2f} g"
        for a in laboratory.ACCELERATIONS.values()
    )
    return Table(("isolator", "parameters", *heads), tuple(rows))


_FIGURES: tuple[tuple[str, str, Callable[[PublishedStudy], Figure]], ...] = (
    (
        "Fig. 3, free flight",
        "The figure shows the steady response without bumpers at the three table accelerations, "
        "computed with the same isolator for all accelerations. The curves bend to the left, as "
        "the measured curves do: above the resonance they fall more slowly than below it. Both "
        "sweeps coincide, because the isolator dissipates much energy.",
        fig03.draw,
    ),
    (
        "Fig. 5, normalised acceleration of the 48 tests",
        "As Fig. 5, with the refined isolator. Both jumps lie at higher frequencies. In contact, "
        "the amplitudes are smaller than at the resonance of free flight, and the isolator is "
        "stiffer at smaller amplitudes.",
        lambda study: panels_of(study, "eta_a"),
    ),
    (
        "Fig. 6, normalised displacement of the 48 tests",
        "As Fig. 6, with the refined isolator.",
        lambda study: panels_of(study, "eta_d"),
    ),
    (
        "Fig. 11, scenario S3, B2-G1-A3",
        "As Fig. 11, with the refined isolator instead of the parameters fitted to this test. The "
        "upward jump lies at a higher frequency. This shift is several times as large as the shift "
        "that any bumper causes.",
        lambda study: curves_of(study, S3),
    ),
    (
        "Fig. 13, scenario S2, B2-G2-A2",
        "As Fig. 13, with the refined isolator instead of the fitted parameters.",
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
        title="Refined model: isolators that soften with the displacement",
        caption=(
            "The table lists three hysteretic laws, each with one parameter set for all table "
            "accelerations. For each acceleration, it gives the stiffness and damping ratio of an "
            "equivalent linear isolator. With this linear isolator, the largest acceleration of "
            "free flight has the same height and occurs at the same frequency. The figures below "
            "are computed with the first law, which fits best. The other two laws hardly differ "
            "from it."
        ),
        table=isolators,
    ),
    *(_item(*one) for one in _FIGURES),
)
