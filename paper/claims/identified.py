"""Section 5: the model with parameters that were fitted to single tests."""

from __future__ import annotations

from contextlib import suppress

from paper.claim import Finding, Kind
from paper.claims.reading import BOTH, AbsentError, claim, regular_places, turns
from paper.study import PublishedStudy
from vibroimpact.model import laboratory
from vibroimpact.model.dimensionless import DimensionlessBumper, to_dimensionless
from vibroimpact.model.rig import Rig
from vibroimpact.response.resonance import features

_S3, _S2 = "B2-G1-A3", "B2-G2-A2"
_CLOSE = 0.05
"""Largest relative difference of parameters that are called the same."""


def _jumps(study: PublishedStudy, code: str) -> str:
    """Describe the jumps of the primary resonance with fitted parameters."""
    jumps = features(study.curves(code, "identified")).jumps
    parts = []
    for way in BOTH:
        ends = [j.frequency for j in jumps if j.direction == way and j.upward == (way != "forward")]
        place = f"{max(ends):.3f} Hz" if ends else "none"
        parts.append(f"{'down' if way == 'forward' else 'up'} {place}")
    return ", ".join(parts)


@claim(
    "fitted-scenarios",
    "5, Figs. 11 and 13",
    "With the fitted parameters, the model shows S3 for B2-G1-A3 and S2 for B2-G2-A2.",
    "The scenarios of the two computed pairs of curves (forward and backward).",
    Kind.RULES,
)
def scenarios(study: PublishedStudy) -> Finding:
    """Use the classification of the computed curves."""
    by_test = {c: study.classification(c, parameters="identified").scenario for c in (_S3, _S2)}
    return Finding(
        by_test == {_S3: "S3", _S2: "S2"}, ", ".join(f"{c}: {s}" for c, s in by_test.items())
    )


@claim(
    "fitted-loops",
    "5, Fig. 12",
    "At the secondary resonance, the computed phase portrait of B2-G1-A3 has inner loops.",
    "The velocity must change its sign more than twice in a forcing cycle at f_I of Fig. 11. It "
    "changes twice in an orbit without loops.",
)
def loops(study: PublishedStudy) -> Finding:
    """Count the sign changes of the velocity: an inner loop adds two."""
    place = regular_places(study, _S3, "identified")[0]
    count = turns(study.motion(_S3, place, "forward", "identified", samples=1024))
    return Finding(count > 2.5, f"{count:.0f} sign changes per cycle at {place:.2f} Hz")


@claim(
    "fitted-agreement",
    "5, Figs. 11 and 13",
    "The fitted model agrees with the measured curves in the height and frequency of the primary "
    "resonance, in the downward jump and in the secondary resonance.",
    "The computed frequencies of the jumps. The measured points are published only as pictures.",
)
def agreement(study: PublishedStudy) -> Finding:
    """Report the computed values that have to be compared with the measurement."""
    return Finding(
        None,
        f"computed jumps: {_S3} {_jumps(study, _S3)}; {_S2} {_jumps(study, _S2)}; needed: the "
        "measured excursions of these two tests at each frequency",
    )


@claim(
    "fitted-upward-jump",
    "5, Figs. 11 and 13",
    "The upward jump of the model lies at a lower frequency than the measured one, because free "
    "flight does not soften in the model.",
    "The computed frequency of the upward jump. The measured one is not given as a number.",
)
def upward(study: PublishedStudy) -> Finding:
    """Report the computed value that has to be compared with the measurement."""
    return Finding(
        None,
        f"computed jumps of {_S3}: {_jumps(study, _S3)}; needed: the frequency of the measured "
        "upward jump, and the measured backward sweep of free flight",
    )


@claim(
    "fitted-portraits",
    "5, Fig. 12",
    "The computed phase portraits agree with the measured ones at f_I, f_II and f_III of Fig. 11.",
    "The computed excursions. The measured orbits are published only as pictures.",
)
def portraits(study: PublishedStudy) -> Finding:
    """Report the computed values that have to be compared with the measurement."""
    sizes = []
    with suppress(AbsentError):  # the verdict stays: nothing computed can give another
        for frequency in regular_places(study, _S3, "identified"):
            motion = study.motion(_S3, frequency, "forward", "identified", samples=1024)
            size = 1e3 * float(motion["displacement_excursion"])
            sizes.append(f"{size:.1f} mm at {frequency:.2f} Hz")
    return Finding(
        None,
        f"computed excursions: {', '.join(sizes) or 'none'}; needed: displacement and velocity "
        f"records of {_S3} at its three frequencies",
    )


@claim(
    "fitted-stiffness-as-table",
    "5, Table 1",
    "The isolator stiffness that was fitted to a test is the equivalent stiffness at the "
    "acceleration of this test.",
    "K fitted to B2-G1-A3 and to B2-G2-A2 must agree within 5 % with the K from which Table 1 "
    "follows.",
    Kind.INPUTS,
)
def stiffness(study: PublishedStudy) -> Finding:
    """Compare both stiffnesses, which describe the isolator at the same acceleration."""
    parts, off = [], []
    for code in (_S3, _S2):
        fitted = laboratory.IDENTIFIED[code].stiffness
        table = laboratory.ISOLATOR_STIFFNESS[code[-2:]]
        off.append(fitted / table - 1.0)
        parts.append(
            f"{code}: fitted {1e-3 * fitted:.1f} kN/m, for Table 1 {1e-3 * table:.1f} kN/m "
            f"({off[-1]:+.0%})"
        )
    return Finding(max(map(abs, off)) <= _CLOSE, "; ".join(parts))


@claim(
    "fitted-damping-as-assumed",
    "5, Section 7",
    "The damping ratio of the isolator is 0.15 and the relaxation time of the bumpers 0.01.",
    "ξ and τ of the parameters fitted to B2-G1-A3 and to B2-G2-A2 must agree with both values "
    "within 5 %.",
    Kind.INPUTS,
)
def damping(study: PublishedStudy) -> Finding:
    """Compare the assumption of Section 7 with the fitted parameters of Section 5."""
    parts, off = [], []
    for code in (_S3, _S2):
        case = laboratory.case(code, "identified")
        group = to_dimensionless(Rig(case.oscillator, case.amplitude))
        assert isinstance(group.right, DimensionlessBumper)
        ratio, time = group.damping_ratio, group.right.relaxation_time
        off += [ratio / laboratory.DAMPING_RATIO - 1.0, time / laboratory.RELAXATION_TIME - 1.0]
        parts.append(f"{code}: ξ {ratio:.3f} ({off[-2]:+.0%}), τ {time:.4f} ({off[-1]:+.0%})")
    return Finding(max(map(abs, off)) <= _CLOSE, "; ".join(parts))


CLAIMS = (scenarios, loops, agreement, upward, portraits, stiffness, damping)
