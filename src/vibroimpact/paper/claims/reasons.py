"""Why statements are not reproduced, as far as the computation tells: read beside the numbers."""

from __future__ import annotations

from collections.abc import Mapping

_EQUAL = (
    "In these tests the hysteresis is shorter than the way from the peak to the jump, or absent: "
    "both sweeps pass over the same peak."
)
_BELL = (
    "The bell exists in the model, but elsewhere: over a wider range of gaps (Fig. 19) the forward "
    "maxima rise and then fall, with a top at smaller gaps than measured, while the backward "
    "maxima have theirs at larger ones."
)

REASONS: Mapping[str, str] = {
    "forward-higher-acceleration": _EQUAL,
    "forward-higher-displacement": _EQUAL,
    "upward-jump-with-bumper": (
        "In the model the backward sweep jumps up where the amplitude of free flight reaches the "
        "gap, and up to there no bumper is felt. For B2 to B4 that is the same to a step of the "
        "sweep; only the softest one shifts it, by one step at most."
    ),
    "bell-in-the-middle": _BELL,
    "bell-descending": _BELL,
    "acceleration-with-acceleration-backward": (
        "The excursions themselves grow with the table acceleration, but for most pairs less than "
        "those of free flight, by which they are divided. The backward sweep joins the motion with "
        "impacts at the upward jump, the further below its top the larger the acceleration."
    ),
    "directions-closer-with-bumper": (
        "From B2 on the difference falls nearly everywhere. The softest bumper breaks the order: "
        "its hysteresis is short, so that both sweeps are already close at small accelerations."
    ),
    "s2-impact-range": (
        "The upper end lies a hundredth of a hertz beyond what the test's step of 0.1 Hz allows "
        "for. The frequencies are read off a figure in the paper."
    ),
    "s1-acceleration-like-free-flight": (
        "The mass presses the bumper by a fraction of a millimetre only, but the bumper is fifteen "
        "times as stiff as the isolator, so that the force, and with it the acceleration, rises "
        "well above that of free flight. The displacement stays close to it."
    ),
    "s4-quasi-periodic": (
        "Disturbances grow exponentially, which no quasi-periodic motion does. Bumpers that forget "
        "within a hundredth of a cycle make the motion from cycle to cycle a map of the plane that "
        "contracts areas: it can have no attracting closed curve. What the paper describes of the "
        "motion (the pair, its eccentricity, the changing number of impacts) is found."
    ),
    "s4-small-motion-reached": (
        "The orbit exists, but it is unstable. A motion that begins close to it stays there for "
        "some cycles and may seem to have settled."
    ),
    "s5-resonance": (
        "With the bumper of Table 1 attached on one side or the other, the natural frequency is "
        "√((K + K_j)/M)/2π = 5.70 Hz, and hardly any damping shifts it. The paper does not print "
        "the parameters of this computation."
    ),
    "gap-is-of-both-sides": (
        "The text defines δ as the sum of both sides' gaps, but Table 1 agrees with one side's to "
        "the last digit, and so does its statement that δ = 1 is grazing."
    ),
    "soft-region-is-s6": (
        "Jumps begin between λ = 1 and λ = 1.9, at a place that depends on the gap. The paper "
        "computed one gap only (Fig. 20) and calls the region unexplored."
    ),
    "small-gap-region-is-s4": (
        "Towards δ = 0.2, and with soft bumpers at still smaller gaps, the curves show secondary "
        "resonances without left hysteresis, as in S3. The paper says itself that other behaviour "
        "is possible there."
    ),
}
"""By key of the claim. They are told only where the verdict, which is computed, is such."""
