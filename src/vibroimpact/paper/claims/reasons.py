"""Reasons why statements are not reproduced, as far as the computation shows them."""

from __future__ import annotations

from collections.abc import Mapping

_EQUAL = (
    "In no test is it lower. Where it is equal, both sweeps pass over the same peak: the "
    "hysteresis begins beyond it, or does not exist. The tests marked S1 are grazing contact."
)
_NARROW = (
    "The hysteresis is narrower than the 0.1 Hz by which the tests step, and than the 0.01 Hz of "
    "the computed sweeps: only the branch of orbits shows it. A test cannot detect it, so tests "
    "of this model would agree with the paper's statement."
)

REASONS: Mapping[str, str] = {
    "forward-higher-acceleration": _EQUAL,
    "forward-higher-displacement": _EQUAL,
    "upward-jump-with-bumper": (
        "In the model the backward sweep jumps up where the amplitude of free flight reaches the "
        "gap, and until then no bumper is touched. For B2 to B4 that is the same to a step of the "
        "sweep; only the softest one shifts it, by one step at most."
    ),
    "s3-secondary-without-hysteresis": _NARROW,
    "s3-coincident-below": _NARROW,
    "upward-jump-fades": (
        "With the softest bumper the jump fades as the gap grows, and at the smallest acceleration "
        "with all but the stiffest; elsewhere the order breaks. Along the acceleration it holds "
        "for few pairs: the rise is divided by free flight's largest displacement, which grows "
        "with the acceleration."
    ),
    "bell-in-the-middle": (
        "The bell exists in the model, but elsewhere: over a wider range of gaps (Fig. 19) the "
        "forward maxima rise and then fall, with a top at smaller gaps than measured, while the "
        "backward maxima have theirs at larger ones."
    ),
    "bell-descending": (
        "The backward maxima fall as stated, and by more than the forward ones. The forward maxima "
        "miss it by their first step only, which rises; from G3 on they fall."
    ),
    "acceleration-with-acceleration-backward": (
        "The excursions themselves grow with the table acceleration, but for most pairs less than "
        "those of free flight, by which they are divided. The backward sweep joins the motion with "
        "impacts at the upward jump, the further below its top the larger the acceleration."
    ),
    "directions-closer-with-bumper": (
        "From B2 on the difference falls nearly everywhere. The softest bumper breaks the order: "
        "its hysteresis is short, so that both sweeps are already close at small accelerations."
    ),
    "s1-acceleration-like-free-flight": (
        "The mass presses the bumper by a fraction of a millimetre only, but the bumper is many "
        "times as stiff as the isolator, so that the force, and with it the acceleration, rises "
        "well above that of free flight. The displacement stays close to it."
    ),
    "s4-quasi-periodic": (
        "Disturbances grow exponentially, unlike those of a quasi-periodic motion. Bumpers that "
        "relax within a hundredth of a cycle reduce the motion from cycle to cycle to a map of "
        "the plane that contracts areas, which cannot have an attracting closed curve. What the "
        "paper describes of the "
        "motion (the pair, its eccentricity, the changing number of impacts) is found."
    ),
    "s4-small-motion-reached": (
        "The orbit exists, but it is unstable. A motion that begins close to it stays there for "
        "some cycles and may seem to have settled."
    ),
    "s4-plateau": (
        "Over the first frequencies at which nothing settles the excursion still rises from the "
        "antisymmetric motion's; in the middle of that range it is nearly constant, as stated. The "
        "resonance is highest beyond the range, where the pair is periodic."
    ),
    "s5-resonance": (
        "With the bumper of Table 1 attached on one side or the other, the natural frequency is "
        "that of both springs together, √((K + K_j)/M)/2π, and damping hardly shifts it. The "
        "paper does not print the parameters of this computation."
    ),
    "grazing-is-free-flight": (
        "As soon as the mass presses a bumper at all, its force adds to the acceleration, and "
        "all but the softest bend the peak over: the branch of orbits has two folds. The "
        "hysteresis is narrower than the tests' step of 0.1 Hz. The curves coincide only if the "
        "gap is at least the amplitude without stops, and then by construction."
    ),
    "jumps-along-stiffness": (
        "The downward jump rises. The backward sweep jumps up where free flight reaches the gap, "
        "whatever the bumper: from B1 on that moves by less than the step of the sweep."
    ),
    "fitted-stiffness-as-table": (
        "The paper contradicts itself: at A2 the fitted isolator is markedly stiffer than the one "
        "from which the printed dimensionless parameters follow."
    ),
    "fitted-damping-as-assumed": (
        "The paper contradicts itself, as far as it means the same: Section 7 calls both values "
        "assumed and constant, Section 5 fits others."
    ),
    "gap-is-of-both-sides": (
        "The text defines δ as the sum of both sides' gaps, but Table 1 agrees with one side's to "
        "the last digit, and so does its statement that δ = 1 is grazing."
    ),
    "soft-region-is-s6": (
        "Jumps begin within the band, at a λ that depends on the gap (the dashed curve in Fig. "
        "21). The paper computed one gap only (Fig. 20) and calls the region unexplored."
    ),
    "small-gap-region-is-s4": (
        "Towards the band's upper edge, and with soft bumpers throughout, the curves show "
        "secondary resonances without left hysteresis, as in S3. The paper itself states that "
        "other behaviour is possible there."
    ),
}
"""Reasons by the key of the claim. They are printed only if the computed verdict matches."""
