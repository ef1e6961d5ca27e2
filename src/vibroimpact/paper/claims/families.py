"""Section 6: scenarios of the tests (Fig. 14), and along gap and stiffness (Figs. 19 and 20)."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.model import laboratory
from vibroimpact.model.dimensionless import peak_displacement
from vibroimpact.paper.claim import Finding
from vibroimpact.paper.claims.reading import (
    ALMOST_ONE_LINE,
    BOTH,
    AbsentError,
    Array,
    apart,
    claim,
    free,
    higher,
    listed,
)
from vibroimpact.paper.study import GAPS, STEP, STIFFNESSES, Study
from vibroimpact.response.peaks import CURVES, Curve
from vibroimpact.response.resonance import features
from vibroimpact.response.swept import Direction

_GAP_RANGE = (0.3, 8.0)
_G_CODES = tuple(f"B3-{gap}-A3" for gap in reversed(GAPS))
_B_CODES = tuple(f"{stiffness}-G3-A1" for stiffness in STIFFNESSES)


def _with(found: dict[str, str], scenario: str, acceleration: str) -> list[str]:
    return [c for c, s in found.items() if s == scenario and c.endswith(acceleration)]


@claim(
    "tests-at-a1",
    "6, Fig. 14",
    "At the smallest acceleration the four tests with the largest gap graze (S1), and all others "
    "are S2.",
    "Scenarios of the 16 tests at A1.",
)
def at_a1(study: Study) -> Finding:
    """Fig. 14's lowest plane."""
    found = study.scenarios()
    grazing, rest = _with(found, "S1", "A1"), _with(found, "S2", "A1")
    holds = {c.split("-")[1] for c in grazing} == {"G4"} and (len(grazing), len(rest)) == (4, 12)
    return Finding(holds, f"S1: {', '.join(grazing) or 'none'}; S2: {len(rest)} tests")


@claim(
    "tests-at-a2-a3",
    "6, Fig. 14",
    "At the two larger accelerations only S2 and S3 occur, and no grazing.",
    "Scenarios of the 32 tests at A2 and A3.",
)
def at_a2_a3(study: Study) -> Finding:
    """Fig. 14's upper planes."""
    found = [s for c, s in study.scenarios().items() if not c.endswith("A1")]
    told = ", ".join(f"{s}: {found.count(s)}" for s in sorted(set(found)))
    return Finding(set(found) == {"S2", "S3"}, told)


@claim(
    "s3-with-small-gap-and-stiff-bumper",
    "6, Fig. 14",
    "S2 turns into S3 as the gap falls and as the bumper gets stiffer.",
    "At A2 and at A3: a test that is S3 stays so with the next smaller gap and the next stiffer "
    "bumper; both scenarios occur.",
)
def transition(study: Study) -> Finding:
    """No exception."""
    found = study.scenarios()
    exceptions, both = [], True
    for a in ("A2", "A3"):
        region = _with(found, "S3", a)
        both &= bool(region) and bool(_with(found, "S2", a))
        for code in region:
            b, g, _ = code.split("-")
            stiffer, narrower = f"B{int(b[1]) + 1}-{g}-{a}", f"{b}-G{int(g[1]) - 1}-{a}"
            exceptions += [
                f"{code} but not {other}"
                for other in (stiffer, narrower)
                if found.get(other, "S3") != "S3"
            ]
    return Finding(both and not exceptions, "; ".join(exceptions) or "no exception")


@claim(
    "s3-region-grows",
    "6, Fig. 14",
    "The larger the acceleration, the more tests are S3.",
    "Tests that are S3 at A1, A2 and A3: rising.",
)
def region(study: Study) -> Finding:
    """Counted."""
    found = study.scenarios()
    counts = [len(_with(found, "S3", a)) for a in laboratory.ACCELERATIONS]
    return Finding(bool((np.diff(counts) > 0).all()), f"{listed(counts, 'd')} (A1, A2, A3)")


@claim(
    "grazing-is-free-flight",
    "6",
    "In the model the curves of a grazing mass (a gap as large as free flight's amplitude) are "
    "those of free flight, without jumps.",
    "Largest difference from free flight of B3 with the gap u_max, at the three accelerations.",
)
def grazing(study: Study) -> Finding:
    """δ0 = 1, where the mass just reaches the bumpers."""
    codes = []
    for name, amplitude in laboratory.ACCELERATIONS.items():
        rig = laboratory.case(f"B3-Ginf-{name}").oscillator
        codes.append(f"B3-{2e3 * peak_displacement(rig, amplitude):.12g}mm-{name}")
    data = study.family(tuple(codes))
    worst = max(float(np.abs(data[c] - free(data, c)).max()) for c in CURVES)
    return Finding(worst < 1e-6, f"at most {worst:.0e} of free flight's maximum")


@claim(
    "scenarios-along-gap",
    "6, Fig. 19",
    "As the gap of B3-A3 falls from free flight to zero the scenarios follow in the order S0 or "
    "S1, S2, S3, S4, S5.",
    "Scenarios for the total gaps from none to 0 mm, from 0.3 to 8 Hz.",
)
def along_gap(study: Study) -> Finding:
    """Never back, and none left out."""
    found = [study.classification(code, *_GAP_RANGE).scenario for code in _G_CODES]
    told = ", ".join(
        f"{code.split('-')[1]} {scenario}" for code, scenario in zip(_G_CODES, found, strict=True)
    )
    return Finding(
        found == sorted(found)
        and {"S2", "S3", "S4", "S5"} <= set(found) <= {f"S{k}" for k in range(6)},
        told,
    )


def _down(data: xr.Dataset) -> list[tuple[str, float]]:
    """Downward jumps of the forward sweep at the primary resonance, by rig (Hz)."""
    found = []
    for code in data["rig"].values:
        jumps = [
            j.frequency
            for j in features(data.sel(rig=code, drop=True)).jumps
            if j.direction == "forward" and not j.upward and j.settled
        ]
        if jumps:
            found.append((str(code), max(jumps)))
    if len(found) < 2:
        raise AbsentError("fewer than two of the curves jump")
    return found


@claim(
    "jumps-along-gap",
    "6, Fig. 19",
    "In the computed family of gaps, too, the downward jump moves up as the gap falls.",
    "Frequency of the downward jump of B3-A3 along falling gaps, where there is one: rising.",
)
def jumps_along_gap(study: Study) -> Finding:
    """From the widest gap with a jump to the smallest."""
    found = _down(study.by_gap().sel(rig=list(_G_CODES)))
    values = [f for _, f in found]
    told = ", ".join(f"{code.split('-')[1]} {f:.2f}" for code, f in found)
    return Finding(bool((np.diff(values) > 0).all()), f"{told} Hz")


def _maxima(study: Study, curve: Curve, direction: Direction) -> tuple[Array, float]:
    """Largest excursions along falling gaps, and that without a gap, a scenario of its own."""
    most = study.by_gap()[curve].sel(rig=list(_G_CODES), direction=direction).max("frequency")
    return most.values[:-1], float(most[-1])


def _gap(k: int) -> str:
    return _G_CODES[k].split("-")[1]


@claim(
    "bell-along-gap",
    "6, Fig. 19",
    "Over the wider range of gaps the maxima of η_a form a bell.",
    "Largest η_a of B3-A3 in each direction along gaps that fall to 2 mm: rises to one maximum, "
    "then falls.",
)
def bell_along_gap(study: Study) -> Finding:
    """Both directions."""
    told, holds = [], True
    for way in BOTH:
        values, none = _maxima(study, "eta_a", way)
        changes = np.diff(values)
        signs = np.sign(changes[np.abs(changes) > 1e-6 * values[1:]])
        turning = int((np.diff(signs) != 0).sum())
        holds &= turning == 1 and bool(signs[0] > 0)
        top = int(values.argmax())
        told.append(
            f"{way} {values[0]:.2f} without bumpers, {values[top]:.2f} at {_gap(top)}, "
            f"{values[-1]:.2f} at {_gap(len(values) - 1)} ({turning} turning point"
            f"{'' if turning == 1 else 's'}); {none:.2f} without a gap"
        )
    return Finding(holds, "; ".join(told))


@claim(
    "displacement-along-gap",
    "6, Fig. 19",
    "Over the wider range of gaps, too, the maxima of η_d fall with the gap.",
    "Largest η_d of B3-A3 in each direction along gaps that fall to 2 mm: never rises, and falls "
    "where bumpers are hit.",
)
def displacement_along_gap(study: Study) -> Finding:
    """Both directions."""
    told, holds = [], True
    for way in BOTH:
        values, none = _maxima(study, "eta_d", way)
        changes, hit = np.diff(values), values[1:] < 1.0 - 1e-6
        wrong = (changes > 1e-6) | (hit & (changes >= 0.0))
        holds &= not wrong.any()
        told.append(
            f"{way} {values[0]:.2f} to {values[-1]:.3f}, {int(wrong.sum())} exceptions; "
            f"{none:.3f} without a gap"
        )
    return Finding(holds, "; ".join(told))


@claim(
    "soft-bumpers-bend-only",
    "6, Fig. 20",
    "With very soft bumpers the curves of G3-A1 bend to the right a little, without jumps or "
    "hysteresis (S6); with stiffer ones they are S2.",
    "Scenarios for the bumper stiffnesses from 10 kN/m to 10 MN/m: S6 first, then S2, no other.",
)
def soft(study: Study) -> Finding:
    """In the order of stiffness."""
    found = [study.classification(code).scenario for code in _B_CODES]
    told = ", ".join(f"{s} {f}" for s, f in zip(STIFFNESSES, found, strict=True))
    return Finding(found == sorted(found, reverse=True) and set(found) == {"S6", "S2"}, told)


@claim(
    "soft-bumpers-one-motion",
    "6, Fig. 20",
    "Where those soft bumpers are hit there is one periodic motion of a single frequency.",
    "For the stiffnesses that give S6: settled on one cycle, the directions alike; at resonance "
    "all higher harmonics of the displacement together are below 10 % of the first.",
)
def soft_motion(study: Study) -> Finding:
    """At the resonance of each."""
    codes = [code for code in _B_CODES if study.classification(code).scenario == "S6"]
    if not codes:
        raise AbsentError("no stiffness gives S6")
    data = study.by_stiffness().sel(rig=codes)
    places = data["eta_d"].sel(direction="forward").idxmax("frequency")
    shares = [higher(study.motion(c, float(places.sel(rig=c)), "forward")) for c in codes]
    holds = bool((data["period"] == 1).all()) and float(apart(data).max()) < 1e-6
    return Finding(
        holds and max(shares) < ALMOST_ONE_LINE,
        f"{', '.join(c.split('-')[0] for c in codes)}: higher harmonics "
        f"{listed([100 * s for s in shares], '.2g')} %",
    )


@claim(
    "no-secondary-for-g3-a1",
    "6, Fig. 20",
    "For G3-A1 no secondary resonance develops, however stiff the bumper.",
    "Secondary resonances of the curves up to 10 MN/m, 2 % prominent; irregular motion where "
    "contact begins is no resonance of its own.",
)
def no_secondary(study: Study) -> Finding:
    """By the classification's evidence."""
    found = {}
    for code in _B_CODES:
        one = study.classification(code)
        if one.features.secondary_resonances(one.thresholds.prominence) or one.features.left:
            found[code] = one.scenario
    return Finding(
        not found, ", ".join(found) or f"none with any of {len(_B_CODES)} bumper stiffnesses"
    )


@claim(
    "trends-along-stiffness",
    "6, Fig. 20",
    "In the computed family of stiffnesses, too, stiffer bumpers raise the downward jump and the "
    "maximum of η_a, and lower that of η_d.",
    "Downward jump (never falls, and rises over the family) and forward maxima of G3-A1 along "
    "rising stiffness.",
)
def along_stiffness(study: Study) -> Finding:
    """All at once."""
    data = study.by_stiffness().sel(rig=list(_B_CODES))
    jumps = [f for _, f in _down(data)]
    a, d = (data[c].sel(direction="forward").max("frequency").values for c in CURVES)
    holds = (
        (np.diff(jumps) >= 0).all()
        and jumps[-1] - jumps[0] > 1.5 * STEP
        and (np.diff(a) > 0).all()
        and (np.diff(d) < 0).all()
    )
    return Finding(
        bool(holds),
        f"jump {jumps[0]:.2f} to {jumps[-1]:.2f} Hz; η_a {a[0]:.2f} to {a[-1]:.2f}; "
        f"η_d {d[0]:.3f} to {d[-1]:.3f}",
    )


TESTS = (at_a1, at_a2_a3, transition, region)
CLAIMS = (
    grazing,
    along_gap,
    jumps_along_gap,
    bell_along_gap,
    displacement_along_gap,
    soft,
    soft_motion,
    no_secondary,
    along_stiffness,
)
