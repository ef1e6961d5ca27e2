"""Section 4.3: the motions of scenarios S1 to S3."""

from __future__ import annotations

import numpy as np

from paper.claim import Finding, Kind
from paper.claims.reading import (
    ALMOST_ONE_LINE,
    BOTH,
    LINES,
    TEST_STEP,
    AbsentError,
    apart,
    at_most,
    claim,
    contact_span,
    describe_left,
    harmonics,
    higher,
    impacts,
    left_folds,
    listed,
    regular_places,
    secondary,
    three_between_jumps,
    touching,
)
from paper.study import PublishedStudy
from vibroimpact.model import laboratory

_S3, _S2 = "B2-G1-A3", "B2-G2-A2"
_SETS: dict[laboratory.Parameters, str] = {
    "identified": "fitted parameters",
    "table": "parameters of Table 1",
}


@claim(
    "s3-secondary-without-hysteresis",
    "4.3, Fig. 7",
    "In B2-G1-A3, there is a right hysteresis at the primary resonance and, at low frequencies, a "
    "secondary resonance without hysteresis. The scenario is S3.",
    "The scenario must be S3, with a right hysteresis. There must be no left hysteresis below the "
    "primary resonance, neither in the sweeps nor between exact folds of the branch of periodic "
    "motions.",
    Kind.RULES,
)
def s3(study: PublishedStudy) -> Finding:
    """Use the branch of orbits, because the sweeps miss a hysteresis narrower than 0.01 Hz."""
    classification, left = study.classification(_S3), left_folds(study, _S3)
    resonances = ", ".join(f"{f:.2f} Hz (prominence {p:.0%})" for f, p in secondary(study, _S3))
    right = [
        f"{item.ends[0]:.3f} to {item.ends[1]:.3f} Hz" for item in classification.features.right
    ]
    return Finding(
        classification.scenario == "S3" and bool(right) and not left,
        f"{classification.scenario}; secondary resonance {resonances or 'none'}; right hysteresis "
        f"{', '.join(right) or 'none'}; {describe_left(left)}",
    )


@claim(
    "s3-impacts-from-the-first",
    "4.3, Fig. 7",
    "In B2-G1-A3, the bumpers are hit from the lowest frequency of 0.5 Hz on.",
    "The first frequency with impacts in the forward sweep must be 0.5 Hz.",
)
def s3_contact(study: PublishedStudy) -> Finding:
    """Check contact from 0.5 Hz on."""
    low, high = contact_span(study, _S3)
    return Finding(low == 0.5, f"impacts from {low:g} to {high:g} Hz")


@claim(
    "s3-coincident-below",
    "4.3, Fig. 8",
    "In B2-G1-A3, the forward and backward sweeps reach the same motion at the secondary resonance "
    "(f_I) and in the valley after it (f_II).",
    "The excursions of the two sweeps must be equal at f_I and f_II, which are read from the "
    "curves. There must be no left hysteresis on the secondary resonance, neither in the sweeps "
    "nor between exact folds of the branch of periodic motions.",
)
def s3_coincide(study: PublishedStudy) -> Finding:
    """Compare the directions to rounding, and also between two frequencies of the sweep."""
    first, valley, _ = regular_places(study, _S3)
    differ = apart(study.campaign().sel(rig=_S3))
    worst = float(differ.sel(frequency=[first, valley], method="nearest").max())
    left = left_folds(study, _S3)
    return Finding(
        worst < 1e-6 and not left,
        f"difference {at_most(worst)} at f_I = {first:.2f} and f_II = {valley:.2f} Hz; "
        f"{describe_left(left)}",
    )


@claim(
    "s3-many-harmonics",
    "4.3, Fig. 8",
    "In B2-G1-A3, the motion at f_I and f_II has several harmonics, each smaller than the one "
    "before.",
    "The odd harmonics 1 to 9, divided by the first, must fall, and the third must be above 1 %. "
    "Even harmonics vanish, because the motion is its own mirror image. Displacement and "
    "acceleration are both checked, because the text does not name the quantity.",
)
def s3_harmonics(study: PublishedStudy) -> Finding:
    """Use exact Fourier coefficients."""
    parts, holds = [], True
    for name, frequency in zip(("f_I", "f_II"), regular_places(study, _S3), strict=False):
        motion = study.motion(_S3, frequency, "forward")
        for of in LINES:
            odd = harmonics(motion, of)[:9:2]
            holds &= bool((np.diff(odd) < 0.0).all()) and odd[1] > 0.01
            parts.append(f"at {name}, {of}: {listed(100.0 * odd)} %")
    return Finding(holds, "; ".join(parts))


@claim(
    "s3-one-impact-a-side",
    "4.3, Fig. 8",
    "In B2-G1-A3, the mass hits each bumper once per forcing cycle at f_I, at f_II and at f_III "
    "(just before the downward jump).",
    "The motion of the forward sweep must have one impact per cycle on each side, at the three "
    "frequencies.",
)
def s3_impacts(study: PublishedStudy) -> Finding:
    """Count the impacts of periodic motions."""
    places = regular_places(study, _S3)
    motions = [study.motion(_S3, f, "forward") for f in places]
    counts = [impacts(motion) for motion in motions]
    listing = "; ".join(
        f"{f:.2f} Hz: {r:g} on the right and {left:g} on the left"
        for f, (r, left) in zip(places, counts, strict=True)
    )
    return Finding(set(counts) == {(1.0, 1.0)}, listing)


@claim(
    "s3-contact-lasts-longer",
    "4.3, Fig. 8",
    "In B2-G1-A3, each contact takes a larger share of the forcing period at f_II than at f_I, and "
    "at f_III than at f_II.",
    "The longest contact divided by the forcing period T must rise over the three frequencies, for "
    "the motion of the forward sweep.",
)
def s3_duration(study: PublishedStudy) -> Finding:
    """Compare the contact time divided by T."""
    shares = [
        float(study.motion(_S3, f, "forward")["contact_duration_share"].max())
        for f in regular_places(study, _S3)
    ]
    return Finding(bool((np.diff(shares) > 0).all()), f"{listed(shares, '.3f')} T")


@claim(
    "s3-two-motions",
    "4.3, Fig. 8",
    "In B2-G1-A3, a large motion with impacts and a small motion without impacts coexist just "
    "before the downward jump.",
    "The excursions and impacts of the motions that the two sweeps reach at f_III. The forward "
    "motion must be the larger one and have impacts, and the backward motion must have none.",
)
def s3_two(study: PublishedStudy) -> Finding:
    """Compare the large motion of the forward sweep with the small one of the backward sweep."""
    place = regular_places(study, _S3)[2]
    large, small = (study.motion(_S3, place, way) for way in BOTH)
    sizes = [1e3 * float(motion["displacement_excursion"]) for motion in (large, small)]
    holds = sizes[0] > sizes[1] and min(impacts(large)) > 0 and impacts(small) == (0.0, 0.0)
    return Finding(
        holds,
        f"{place:.2f} Hz: excursions {listed(sizes)} mm, {impacts(large)[0]:g} and "
        f"{impacts(small)[0]:g} impacts per side (forward, backward)",
    )


@claim(
    "s3-one-predominant-harmonic",
    "4.3, Fig. 8",
    "In B2-G1-A3, both motions at f_III are periodic with one predominant harmonic.",
    "All higher harmonics of the displacement together must be below 10 % of the first. The text "
    "does not name the quantity, so the values of the acceleration are listed as well.",
)
def s3_one_line(study: PublishedStudy) -> Finding:
    """Use the harmonics of the displacement."""
    place = regular_places(study, _S3)[2]
    both = [study.motion(_S3, place, way) for way in BOTH]
    shares, others = ([higher(motion, of) for motion in both] for of in LINES)
    holds = all(str(m["motion"].item()) == "periodic" and int(m["period"]) == 1 for m in both)
    return Finding(
        holds and max(shares) < ALMOST_ONE_LINE,
        f"displacement: {shares[0]:.1%} of the first harmonic in the large motion, {shares[1]:.1%} "
        f"in the small motion; acceleration: {others[0]:.1%} and {others[1]:.1%}",
    )


@claim(
    "s3-portraits-become-ellipses",
    "4.3, Fig. 8",
    "In B2-G1-A3, the phase portraits turn into ellipses from the valley to the primary resonance.",
    "At five frequencies from f_II to f_III, the sum of all higher harmonics of the displacement "
    "is divided by the first harmonic. This ratio must fall throughout, to below 10 %. A phase "
    "portrait is an ellipse if the motion has a single harmonic. The values of the acceleration "
    "are listed as well.",
)
def s3_ellipses(study: PublishedStudy) -> Finding:
    """Use the higher harmonics, because a motion with a single harmonic is an ellipse."""
    _, valley, last = regular_places(study, _S3)
    places = [round(float(f), 2) for f in np.linspace(valley, last, 5)]
    motions = [study.motion(_S3, f, "forward") for f in places]
    shares, others = ([higher(motion, of) for motion in motions] for of in LINES)
    holds = bool((np.diff(shares) < 0).all()) and shares[-1] < ALMOST_ONE_LINE
    return Finding(
        holds,
        f"displacement: {listed([100 * s for s in shares])} %, acceleration: "
        f"{listed([100 * s for s in others])} %, at {listed(places)} Hz",
    )


@claim(
    "s3-one-motion-above",
    "4.3, Fig. 8",
    "In B2-G1-A3, there is only one motion above the downward jump. It has no impacts and is the "
    "same in both sweeps.",
    "Above f_III, neither sweep may have impacts, and the two sweeps must not differ.",
)
def s3_above(study: PublishedStudy) -> Finding:
    """Check that the motion is that without contact."""
    last = regular_places(study, _S3)[2]
    above = study.campaign().sel(rig=_S3, frequency=slice(last + 0.005, None))
    hits, differ = int(touching(above).sum()), float(apart(above).max())
    return Finding(
        hits == 0 and differ < 1e-6,
        f"{hits} motions with impacts; difference of the sweeps {at_most(differ)}",
    )


@claim(
    "s3-dissymmetry",
    "4.3, Fig. 8",
    "The measured phase portraits of B2-G1-A3 are not symmetric, because the two gaps differ by "
    "accident.",
    "Nothing is compared. The paper does not give the two gaps, and the gaps of the model are "
    "equal.",
)
def dissymmetry(study: PublishedStudy) -> Finding:
    """Report that the computed eccentricity is zero."""
    worst = 1e3 * float(np.abs(study.campaign()["eccentricity"].sel(rig=_S3)).max())
    return Finding(
        None,
        f"with equal gaps, the eccentricity is {at_most(worst, unit=' mm')}; needed: the measured "
        "right and left gaps, or the displacement records of this test",
    )


@claim(
    "s2-primary-only",
    "4.3, Fig. 9",
    "In B2-G2-A2, the curves show only the primary resonance with a right hysteresis. The scenario "
    "is S2.",
    "The scenario must be S2, and there must be no secondary resonance.",
    Kind.RULES,
)
def s2(study: PublishedStudy) -> Finding:
    """Use the classification of the computed curves."""
    classification, others = study.classification(_S2), secondary(study, _S2)
    ends = [
        f"{item.ends[0]:.3f} to {item.ends[1]:.3f} Hz" for item in classification.features.right
    ]
    return Finding(
        classification.scenario == "S2" and not others,
        f"{classification.scenario}; {len(others)} secondary resonances; right hysteresis "
        f"{', '.join(ends) or 'none'}",
    )


@claim(
    "s2-impact-range",
    "4.3, Fig. 9",
    "In B2-G2-A2, the bumpers are hit only between about 0.7 and 2 Hz.",
    "The first and last frequency with impacts in the forward sweep must agree within one step of "
    "the tests (0.1 Hz). The sweep has the steps of the tests and the parameters fitted to this "
    "test.",
)
def s2_contact(study: PublishedStudy) -> Finding:
    """Also report the result with the parameters of all tests."""
    parts, holds = [], []
    for parameters, name in _SETS.items():
        data = study.tested(_S2, parameters).sel(direction="forward")
        hit = data["frequency"].values[touching(data).values]
        if not len(hit):
            raise AbsentError(f"{_S2} never hits its bumpers with {name}")
        steps = [round(float(f) / TEST_STEP) for f in (hit[0], hit[-1])]
        holds.append(abs(steps[0] - 7) <= 1 and abs(steps[1] - 20) <= 1)
        parts.append(f"{name}: {hit[0]:.1f} to {hit[-1]:.1f} Hz")
    return Finding(holds[0], ", ".join(parts))


@claim(
    "s2-three-motions",
    "4.3, Fig. 9",
    "Between the two jumps of B2-G2-A2, as in B4-G4-A3, three steady motions exist: a large and a "
    "small one that are stable, and an unstable one.",
    "The branch of periodic motions, halfway between the jumps, must have two stable motions and "
    "an unstable one.",
)
def s2_three(study: PublishedStudy) -> Finding:
    """Count the orbits on the branch."""
    return three_between_jumps(study, _S2)


@claim(
    "s2-impacts-later",
    "4.3, Fig. 9",
    "In B2-G2-A2, unlike in B2-G1-A3, the bumpers are not yet hit at the lowest frequency.",
    "The first frequency with impacts in the forward sweep must be 0.5 Hz in B2-G1-A3 and higher "
    "in B2-G2-A2.",
)
def s2_later(study: PublishedStudy) -> Finding:
    """Compare both tests: here the gap is wider, and the acceleration smaller."""
    one, other = contact_span(study, _S2)[0], contact_span(study, _S3)[0]
    return Finding(one > other == 0.5, f"{one:.2f} Hz, compared with {other:.2f} Hz in {_S3}")


CLAIMS = (
    s3,
    s3_contact,
    s3_coincide,
    s3_harmonics,
    s3_impacts,
    s3_ellipses,
    s3_two,
    s3_one_line,
    s3_above,
    dissymmetry,
    s3_duration,
    s2,
    s2_later,
    s2_contact,
    s2_three,
)
