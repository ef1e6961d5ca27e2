"""Reasons why statements are not reproduced, as far as the computation shows them."""

from __future__ import annotations

from collections.abc import Mapping

_EQUAL = (
    "In no test is the forward peak lower. Where both peaks are equal, both sweeps pass over the "
    "same peak. In these tests, the hysteresis begins beyond the peak, or there is no hysteresis. "
    "The tests marked S1 are in grazing contact."
)
_NARROW = (
    "The hysteresis is narrower than the frequency step of the tests (0.1 Hz) and than the step of "
    "the computed sweeps (0.01 Hz). Only the branch of periodic motions shows it. A test cannot "
    "detect it, so tests of this model would agree with the statement of the paper."
)

REASONS: Mapping[str, str] = {
    "forward-higher-acceleration": _EQUAL,
    "forward-higher-displacement": _EQUAL,
    "upward-jump-with-bumper": (
        "In the model, the backward sweep jumps up where the amplitude of free flight reaches the "
        "gap. Until then, the mass touches no bumper. For B2 to B4, this frequency is the same to "
        "within a step of the sweep. Only the softest bumper shifts it, by at most one step."
    ),
    "s3-secondary-without-hysteresis": _NARROW,
    "s3-coincident-below": _NARROW,
    "upward-jump-fades": (
        "With the softest bumper, the jump becomes smaller as the gap grows. At the smallest "
        "acceleration, this holds for all bumpers except the stiffest. Elsewhere, the trend is "
        "broken. For rising accelerations, the trend holds for few pairs, because the rise is "
        "divided by the largest displacement of free flight, which grows with the acceleration."
    ),
    "bell-in-the-middle": (
        "The model has a bell, but at other gaps. Over a wider range of gaps (Fig. 19), the "
        "forward maxima rise and then fall, with the top at smaller gaps than measured. The "
        "backward maxima have their top at larger gaps than measured."
    ),
    "bell-descending": (
        "The backward maxima fall as stated, and by more than the forward maxima. The forward "
        "maxima rise in the first step, from G4 to G3. From G3 on, they fall as stated."
    ),
    "acceleration-with-acceleration-backward": (
        "The excursions themselves grow with the table acceleration. For most pairs, they grow "
        "less than the excursions of free flight, by which they are divided. The backward sweep "
        "reaches the motion with impacts at the upward jump. The larger the acceleration, the "
        "further this jump lies below the top of the resonance."
    ),
    "directions-closer-with-bumper": (
        "From B2 on, the difference falls nearly everywhere. The softest bumper breaks the trend. "
        "Its hysteresis is short, so that both sweeps are already close at small accelerations."
    ),
    "s1-acceleration-like-free-flight": (
        "The mass presses into the bumper by only a fraction of a millimetre. However, the bumper "
        "is many times as stiff as the isolator. Therefore the force, and with it the "
        "acceleration, rises well above that of free flight. The displacement stays close to that "
        "of free flight."
    ),
    "s4-quasi-periodic": (
        "Disturbances grow exponentially, unlike those of a quasi-periodic motion. The bumpers "
        "relax within a hundredth of a cycle. Therefore a map of the plane that contracts areas "
        "describes the motion from cycle to cycle. Such a map cannot have an attracting closed "
        "curve, which a quasi-periodic motion would need. The other properties that the paper "
        "describes are found: the pair, its eccentricity and the changing number of impacts."
    ),
    "s4-small-motion-reached": (
        "The orbit exists, but it is unstable. A motion that begins close to it stays there for "
        "some cycles and may seem to be steady."
    ),
    "s4-plateau": (
        "At the first frequencies without periodic motion, the excursion still rises from that of "
        "the antisymmetric motion. In the middle of that range, it is nearly constant, as stated. "
        "The resonance is highest beyond the range, where the pair is periodic."
    ),
    "s5-resonance": (
        "With the bumper of Table 1 attached on one side or the other, the natural frequency is "
        "that of both springs together, √((K + K_j)/M)/2π. Damping hardly shifts it. The paper "
        "does not print the parameters of this computation."
    ),
    "grazing-is-free-flight": (
        "As soon as the mass presses into a bumper, the contact force adds to the acceleration. "
        "All bumpers except the softest also bend the peak over, so that the branch of periodic "
        "motions has two folds. The hysteresis is narrower than the step of the tests (0.1 Hz). "
        "The curves coincide only if the gap is at least the amplitude of free flight, and then "
        "they coincide by construction."
    ),
    "jumps-along-stiffness": (
        "The downward jump moves to higher frequencies as stated. The backward sweep jumps up "
        "where free flight reaches the gap, whatever the bumper is. From B1 on, this frequency "
        "changes by less than the step of the sweep."
    ),
    "fitted-stiffness-as-table": (
        "The paper contradicts itself. At A2, the fitted isolator is markedly stiffer than the "
        "isolator from which the printed dimensionless parameters follow."
    ),
    "fitted-damping-as-assumed": (
        "The paper contradicts itself, if both sections mean the same quantities. Section 7 calls "
        "both values assumed and constant. Section 5 fits other values."
    ),
    "gap-is-of-both-sides": (
        "The text defines δ as the sum of the gaps of both sides. However, the numbers of Table 1 "
        "agree to the last digit with the gap of one side. The statement that δ = 1 is grazing "
        "also agrees with the gap of one side."
    ),
    "soft-region-is-s6": (
        "Jumps begin within the band, at a λ that depends on the gap (the dashed curve in Fig. "
        "21). The paper computed only one gap (Fig. 20) and calls the region unexplored."
    ),
    "small-gap-region-is-s4": (
        "Towards the upper edge of the band, and for soft bumpers in the whole band, the curves "
        "show secondary resonances without left hysteresis, as in S3. The paper itself states that "
        "other behaviour is possible there."
    ),
}
"""Reasons by the key of the claim. They are printed only if the computed verdict matches."""
