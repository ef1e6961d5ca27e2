"""Section 4.3: the motions of scenarios S1 to S3."""

from __future__ import annotations

import numpy as np

from vibroimpact.model import laboratory
from vibroimpact.paper.claim import Finding, Kind
from vibroimpact.paper.claims.reading import (
    ALMOST_ONE_LINE,
    BOTH,
    LINES,
    TEST_STEP,
    AbsentError,
    apart,
    at_most,
    claim,
    contact_span,
    harmonics,
    higher,
    impacts,
    left_folds,
    listed,
    regular_places,
    secondary,
    three_between_jumps,
    told_left,
    touching,
)
from vibroimpact.paper.study import PublishedStudy

_S3, _S2 = "B2-G1-A3", "B2-G2-A2"
_SETS: dict[laboratory.Parameters, str] = {
    "identified": "fitted parameters",
    "table": "those of Table 1",
}


@claim(
    "s3-secondary-without-hysteresis",
    "4.3, Fig. 7",
    "B2-G1-A3 shows a right hysteresis at its primary resonance and, at low frequencies, a "
    "secondary resonance without hysteresis: scenario S3.",
    "Scenario S3, a right hysteresis, and no left hysteresis anywhere below the primary resonance, "
    "between exact folds of the branch either.",
    Kind.RULES,
)
def s3(study: PublishedStudy) -> Finding:
    """Use the branch of orbits, because the sweeps miss a hysteresis narrower than 0.01 Hz."""
    found, left = study.classification(_S3), left_folds(study, _S3)
    resonances = ", ".join(f"{f:.2f} Hz (prominence {p:.0%})" for f, p in secondary(study, _S3))
    right = [f"{item.ends[0]:.3f} to {item.ends[1]:.3f} Hz" for item in found.features.right]
    return Finding(
        found.scenario == "S3" and bool(right) and not left,
        f"{found.scenario}; secondary resonance {resonances or 'none'}; right hysteresis "
        f"{', '.join(right) or 'none'}; {told_left(left)}",
    )


@claim(
    "s3-impacts-from-the-first",
    "4.3, Fig. 7",
    "In B2-G1-A3 the bumpers are hit from the lowest frequency of 0.5 Hz on.",
    "First frequency of the forward sweep with impacts.",
)
def s3_contact(study: PublishedStudy) -> Finding:
    """Check contact from 0.5 Hz on."""
    low, high = contact_span(study, _S3)
    return Finding(low == 0.5, f"{low:g} to {high:g} Hz")


@claim(
    "s3-coincident-below",
    "4.3, Fig. 8",
    "At the secondary resonance and in the valley after it, forward and backward sweep reach the "
    "same motion.",
    "Difference of the two excursions at f_I and f_II, read off the curves; and no left hysteresis "
    "on the secondary resonance, between exact folds of the branch either.",
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
        f"{told_left(left)}",
    )


@claim(
    "s3-many-harmonics",
    "4.3, Fig. 8",
    "At f_I and f_II the motion has several harmonics, each smaller than the one before.",
    "Odd harmonics 1 to 9 over the first (even ones vanish, for the motion is its own mirror "
    "image): falling, and the third above 1 %; of displacement and of acceleration, for the text "
    "does not name the quantity.",
)
def s3_harmonics(study: PublishedStudy) -> Finding:
    """Use exact Fourier coefficients."""
    told, holds = [], True
    for name, frequency in zip(("f_I", "f_II"), regular_places(study, _S3), strict=False):
        motion = study.motion(_S3, frequency, "forward")
        for of in LINES:
            odd = harmonics(motion, of)[:9:2]
            holds &= bool((np.diff(odd) < 0.0).all()) and odd[1] > 0.01
            told.append(f"{name}, {of}: {listed(100.0 * odd)} %")
    return Finding(holds, "; ".join(told))


@claim(
    "s3-one-impact-a-side",
    "4.3, Fig. 8",
    "At f_I, f_II and f_III (just before the downward jump) the mass hits each bumper once in a "
    "forcing cycle.",
    "Impacts per cycle, right and left, of the forward sweep's motion at the three frequencies.",
)
def s3_impacts(study: PublishedStudy) -> Finding:
    """Count the impacts of periodic motions."""
    places = regular_places(study, _S3)
    found = [study.motion(_S3, f, "forward") for f in places]
    counts = [impacts(motion) for motion in found]
    told = "; ".join(
        f"{f:.2f} Hz: {r:g} and {left:g}" for f, (r, left) in zip(places, counts, strict=True)
    )
    return Finding(set(counts) == {(1.0, 1.0)}, told)


@claim(
    "s3-contact-lasts-longer",
    "4.3, Fig. 8",
    "From f_I over f_II to f_III each contact takes a larger share of the forcing period.",
    "Longest contact of the forward sweep's motion over T at the three frequencies: rising.",
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
    "Just before the downward jump a large motion with impacts and a small one without coexist.",
    "Excursion and impacts of the motions that the two sweeps reach at f_III.",
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
        f"{impacts(small)[0]:g} impacts a side",
    )


@claim(
    "s3-one-predominant-harmonic",
    "4.3, Fig. 8",
    "Both motions at f_III are periodic with one predominant harmonic.",
    "All higher harmonics of the displacement together over the first one: below 10 %. The text "
    "does not name the quantity; the acceleration's are listed as well.",
)
def s3_one_line(study: PublishedStudy) -> Finding:
    """Use the harmonics of the displacement."""
    place = regular_places(study, _S3)[2]
    both = [study.motion(_S3, place, way) for way in BOTH]
    shares, others = ([higher(motion, of) for motion in both] for of in LINES)
    holds = all(str(m["motion"].item()) == "periodic" and int(m["period"]) == 1 for m in both)
    return Finding(
        holds and max(shares) < ALMOST_ONE_LINE,
        f"displacement {shares[0]:.1%} of the large motion, {shares[1]:.1%} of the small one; "
        f"acceleration {others[0]:.1%} and {others[1]:.1%}",
    )


@claim(
    "s3-portraits-become-ellipses",
    "4.3, Fig. 8",
    "From the valley to the primary resonance the phase portraits turn into ellipses.",
    "Higher harmonics of the displacement, which a portrait shows, over the first at five "
    "frequencies from f_II to f_III: falling throughout, to below 10 %. The acceleration's are "
    "listed as well.",
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
        f"displacement {listed([100 * s for s in shares])} %, acceleration "
        f"{listed([100 * s for s in others])} % at {listed(places)} Hz",
    )


@claim(
    "s3-one-motion-above",
    "4.3, Fig. 8",
    "Above the downward jump there is one motion only, without impacts, the same in both sweeps.",
    "Contacts and differences of the two directions of B2-G1-A3 above f_III.",
)
def s3_above(study: PublishedStudy) -> Finding:
    """Check that the motion is that without contact."""
    last = regular_places(study, _S3)[2]
    above = study.campaign().sel(rig=_S3, frequency=slice(last + 0.005, None))
    hits, differ = int(touching(above).sum()), float(apart(above).max())
    return Finding(
        hits == 0 and differ < 1e-6, f"{hits} holds with impacts; difference {at_most(differ)}"
    )


@claim(
    "s3-dissymmetry",
    "4.3, Fig. 8",
    "The measured portraits of B2-G1-A3 are not symmetric, for the two gaps differ by accident.",
    "Nothing: the accidental gaps are not given, and the model's are equal.",
)
def dissymmetry(study: PublishedStudy) -> Finding:
    """Report that the computed eccentricity is zero."""
    worst = 1e3 * float(np.abs(study.campaign()["eccentricity"].sel(rig=_S3)).max())
    return Finding(
        None,
        f"with equal gaps the eccentricity is {at_most(worst, unit=' mm')}; needed: the measured "
        "right and left gaps, or the displacement records of this test",
    )


@claim(
    "s2-primary-only",
    "4.3, Fig. 9",
    "B2-G2-A2 shows its primary resonance with right hysteresis and nothing else: scenario S2.",
    "Scenario S2, and no secondary resonance.",
    Kind.RULES,
)
def s2(study: PublishedStudy) -> Finding:
    """Use the classification of the computed curves."""
    found, others = study.classification(_S2), secondary(study, _S2)
    ends = [f"{item.ends[0]:.3f} to {item.ends[1]:.3f} Hz" for item in found.features.right]
    return Finding(
        found.scenario == "S2" and not others,
        f"{found.scenario}; {len(others)} secondary resonances; right hysteresis "
        f"{', '.join(ends) or 'none'}",
    )


@claim(
    "s2-impact-range",
    "4.3, Fig. 9",
    "In B2-G2-A2 the bumpers are hit between about 0.7 and 2 Hz only.",
    "First and last frequency with impacts of the forward sweep by the tests' own steps of 0.1 Hz, "
    "with the parameters fitted to this test: each within one step.",
)
def s2_contact(study: PublishedStudy) -> Finding:
    """Also report the result with the parameters of all tests."""
    told, holds = [], []
    for parameters, name in _SETS.items():
        data = study.tested(_S2, parameters).sel(direction="forward")
        hit = data["frequency"].values[touching(data).values]
        if not len(hit):
            raise AbsentError(f"{_S2} never hits its bumpers with {name}")
        steps = [round(float(f) / TEST_STEP) for f in (hit[0], hit[-1])]
        holds.append(abs(steps[0] - 7) <= 1 and abs(steps[1] - 20) <= 1)
        told.append(f"{name} {hit[0]:.1f} to {hit[-1]:.1f} Hz")
    return Finding(holds[0], ", ".join(told))


@claim(
    "s2-three-motions",
    "4.3, Fig. 9",
    "Between the two jumps of B2-G2-A2, as in B4-G4-A3, three steady motions exist: a large and a "
    "small one that are stable, and an unstable one.",
    "Orbits of the followed branch in the middle between the jumps, by stability.",
)
def s2_three(study: PublishedStudy) -> Finding:
    """Count the orbits on the branch."""
    return three_between_jumps(study, _S2)


@claim(
    "s2-impacts-later",
    "4.3, Fig. 9",
    "In B2-G2-A2, unlike in B2-G1-A3, the bumpers are not hit at the lowest frequency yet.",
    "First frequency of the forward sweep with impacts, in both tests.",
)
def s2_later(study: PublishedStudy) -> Finding:
    """Compare both tests: here the gap is wider, and the acceleration smaller."""
    one, other = contact_span(study, _S2)[0], contact_span(study, _S3)[0]
    return Finding(one > other == 0.5, f"{one:.2f} Hz, against {other:.2f} Hz in {_S3}")


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
