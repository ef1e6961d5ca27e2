"""Figs. 7, 9, 10, 11, 13 and 17: the resonance curves of one case each."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import frequency_marks, resonance_curves
from vibroimpact.model import laboratory
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import HIGH, LOW, PublishedStudy

S3, S2, S1, S5 = "B2-G1-A3", "B2-G2-A2", "B2-G4-A1", "B3-0mm-A3"
NAMES = ("I", "II", "III")
S5_RANGE = 0.3, 10.0
"""Frequency range for S5 (Hz), up to twice the highest frequency of the tests."""


def curves_of(
    study: PublishedStudy,
    code: str,
    parameters: laboratory.Parameters | None = None,
    reach: tuple[float, float] = (LOW, HIGH),
) -> Figure:
    """Draw the curves. For S3 the three frequencies of Figs. 8 and 12 are marked."""
    axes = resonance_curves(study.curves(code, parameters, *reach))
    if code == S3:
        places = study.regular_places(code, parameters)
        frequency_marks(axes, dict(zip(NAMES, places, strict=True)))
    return axes[0].get_figure(root=True)  # type: ignore[return-value]


ITEMS = (
    Item(
        key="fig07",
        title="Fig. 7: scenario S3, B2-G1-A3",
        caption=(
            "Resonance curves of bumper B2 with a total gap of 15 mm at 0.05 g, computed with the "
            "Simplified Nonlinear Model; the paper shows measurements. The primary resonance ends "
            "in a jump and leaves a right hysteresis; well below it lies a secondary resonance. At "
            "all frequencies swept both directions agree on it, but its branch of orbits turns "
            "back between two of them: a left hysteresis of less than 0.01 Hz, which no test would "
            "show. The marked frequencies are read off the computed curve: I the secondary "
            "resonance, II the valley after it, III just before the downward jump. Contact begins "
            "below 0.5 Hz."
        ),
        draw=lambda study: curves_of(study, S3),
    ),
    Item(
        key="fig09",
        title="Fig. 9: scenario S2, B2-G2-A2",
        caption=(
            "Resonance curves of bumper B2 with a total gap of 20 mm at 0.04 g, computed with the "
            "Simplified Nonlinear Model; the paper shows measurements. There is the primary "
            "resonance with its right hysteresis and nothing else. Unlike in Fig. 7 the gap is so "
            "wide that the mass reaches the bumpers in a middle range of frequencies only; outside "
            "it the curves are those of free flight."
        ),
        draw=lambda study: curves_of(study, S2),
    ),
    Item(
        key="fig10",
        title="Fig. 10: scenario S1, B2-G4-A1",
        caption=(
            "Bumper B2 with the widest gap, 30 mm, at the weakest shaking, 0.03 g, computed with "
            "the Simplified Nonlinear Model; the paper shows measurements. The gap is 0.93 of free "
            "flight's amplitude, so that the mass touches the bumpers near resonance only, and the "
            "displacement stays close to free flight's. The model's contact is not quite without "
            "consequence: the acceleration rises visibly where the mass touches, and the peak ends "
            "in a hysteresis narrower than a step of the tests (0.1 Hz)."
        ),
        draw=lambda study: curves_of(study, S1),
    ),
    Item(
        key="fig11",
        title="Fig. 11: fitted model of scenario S3, B2-G1-A3",
        caption=(
            "Resonance curves of the Simplified Nonlinear Model with the parameters that the paper "
            "fitted to this very test (its Section 5), rather than those of the whole campaign as "
            "in Fig. 7. The paper lays its measured points over them; they are not published as "
            "numbers, so the model stands alone here. I, II and III mark the frequencies of Fig. "
            "12."
        ),
        draw=lambda study: curves_of(study, S3, "identified"),
    ),
    Item(
        key="fig13",
        title="Fig. 13: fitted model of scenario S2, B2-G2-A2",
        caption=(
            "Resonance curves of the Simplified Nonlinear Model with the parameters that the paper "
            "fitted to this test, rather than those of the whole campaign as in Fig. 9. The paper "
            "compares them with measured points, which are not published as numbers: how close "
            "model and experiment are cannot be judged here. The fitted isolator is stiffer than "
            "the one that the campaign's table implies, so that both jumps lie higher than in Fig. "
            "9."
        ),
        draw=lambda study: curves_of(study, S2, "identified"),
    ),
    Item(
        key="fig17",
        title="Fig. 17: scenario S5, B3 without a gap at A3",
        caption=(
            "Resonance curves with the bumpers touching the mass at rest. All is smooth again: "
            "both sweeps coincide, without jumps and without secondary resonances. One bumper "
            "after the other adds its stiffness to the isolator's, so that the resonance lies at "
            "about five times the frequency of free flight. The computed peak is near 5.7 Hz, "
            "where the paper gives about 5.4 Hz."
        ),
        draw=lambda study: curves_of(study, S5, reach=S5_RANGE),
    ),
)
