"""Figs. 7, 9, 10, 11, 13 and 17: the resonance curves of one case each."""

from __future__ import annotations

from matplotlib.figure import Figure

from paper.report_item import Item
from paper.study import HIGH, LOW, PublishedStudy
from vibroimpact.figures import frequency_marks, resonance_curves
from vibroimpact.model import laboratory

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
    axes = resonance_curves(study.curves(code, parameters, *reach), physical=False)
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
            "Simplified Nonlinear Model. The paper shows measurements. The primary resonance ends "
            "in a jump and has a right hysteresis. A secondary resonance lies well below the "
            "primary resonance. On the secondary resonance, the two sweeps agree at all computed "
            "frequencies. However, the branch of periodic motions turns back between two of these "
            "frequencies. The result is a left hysteresis of less than 0.01 Hz, which no test "
            "would show. The marked frequencies are read from the computed curve: I is the "
            "secondary resonance, II is the valley after it, and III lies just before the downward "
            "jump. Contact begins below 0.5 Hz."
        ),
        draw=lambda study: curves_of(study, S3),
    ),
    Item(
        key="fig09",
        title="Fig. 9: scenario S2, B2-G2-A2",
        caption=(
            "Resonance curves of bumper B2 with a total gap of 20 mm at 0.04 g, computed with the "
            "Simplified Nonlinear Model. The paper shows measurements. The curves show only the "
            "primary resonance with its right hysteresis. The gap is wider than in Fig. 7. "
            "Therefore the mass reaches the bumpers only in a middle range of frequencies. Outside "
            "this range, the curves are those of free flight."
        ),
        draw=lambda study: curves_of(study, S2),
    ),
    Item(
        key="fig10",
        title="Fig. 10: scenario S1, B2-G4-A1",
        caption=(
            "Resonance curves of bumper B2 with the widest gap, 30 mm, at the smallest table "
            "acceleration, 0.03 g, computed with the Simplified Nonlinear Model. The paper shows "
            "measurements. The gap of one side is 0.93 times the amplitude of free flight. "
            "Therefore the mass touches the bumpers only near resonance, and the displacement "
            "stays close to that of free flight. Contact still has an effect in the model. The "
            "acceleration rises visibly where the mass touches a bumper, and the peak ends in a "
            "hysteresis that is narrower than a step of the tests (0.1 Hz)."
        ),
        draw=lambda study: curves_of(study, S1),
    ),
    Item(
        key="fig11",
        title="Fig. 11: fitted model of scenario S3, B2-G1-A3",
        caption=(
            "Resonance curves of the Simplified Nonlinear Model with the parameters that the paper "
            "fitted to this test (Section 5 of the paper). Fig. 7 uses the parameters of the whole "
            "campaign instead. The paper compares its curves with measured points. These points "
            "are not published as numbers. Therefore the figure shows only the model. I, II and "
            "III mark the frequencies of Fig. 12."
        ),
        draw=lambda study: curves_of(study, S3, "identified"),
    ),
    Item(
        key="fig13",
        title="Fig. 13: fitted model of scenario S2, B2-G2-A2",
        caption=(
            "Resonance curves of the Simplified Nonlinear Model with the parameters that the paper "
            "fitted to this test. Fig. 9 uses the parameters of the whole campaign instead. The "
            "paper compares its curves with measured points. These points are not published as "
            "numbers. Therefore this report cannot judge how close model and experiment are. The "
            "fitted isolator is stiffer than the isolator that follows from Table 1, so that both "
            "jumps lie at higher frequencies than in Fig. 9."
        ),
        draw=lambda study: curves_of(study, S2, "identified"),
    ),
    Item(
        key="fig17",
        title="Fig. 17: scenario S5, B3 without a gap at A3",
        caption=(
            "Resonance curves for bumpers that touch the mass at rest. The curves are smooth "
            "again. Both sweeps coincide, and there are no jumps and no secondary resonances. One "
            "bumper after the other adds its stiffness to that of the isolator, so that the "
            "resonance lies at about five times the resonance frequency of free flight. The "
            "computed peak is near 5.7 Hz. The paper gives about 5.4 Hz."
        ),
        draw=lambda study: curves_of(study, S5, reach=S5_RANGE),
    ),
)
