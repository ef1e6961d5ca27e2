"""Section 6: scenario S5, bumpers that touch the mass at rest."""

from __future__ import annotations

import numpy as np
import xarray as xr

from paper.claim import Finding
from paper.claims.reading import (
    ALMOST_ONE_LINE,
    ROUNDING,
    apart,
    at_most,
    claim,
    higher,
    impacts,
    listed,
)
from paper.study import PublishedStudy
from vibroimpact.response.resonance import features

_CODE = "B3-0mm-A3"
_LOW, _HIGH = 0.3, 10.0
_PRINTED = 5.4


def _curves(study: PublishedStudy) -> xr.Dataset:
    return study.curves(_CODE, low=_LOW, high=_HIGH)


def _share(value: float) -> str:
    return "0 (within rounding)" if value < ROUNDING else f"{value:.1%}"


def _resonance(study: PublishedStudy) -> float:
    return float(_curves(study)["eta_d"].sel(direction="forward").idxmax("frequency"))


@claim(
    "s5-smooth",
    "6, Fig. 17",
    "With the bumpers attached to the mass, the curves of B3-A3 are smooth again. They have no "
    "jump, no hysteresis and no secondary resonance.",
    "The sweeps from 0.3 to 10 Hz must show none of these, and the two directions must not differ.",
)
def smooth(study: PublishedStudy) -> Finding:
    """Check that each curve has only one peak."""
    data = _curves(study)
    curve_features = features(data)
    others = [p for p in curve_features.peaks if not p.primary]
    differ = float(apart(data).max())
    holds = not (curve_features.jumps or curve_features.hysteresis or others) and differ < 1e-6
    return Finding(
        holds,
        f"{len(curve_features.jumps)} jumps, {len(curve_features.hysteresis)} hystereses, "
        f"{len(others)} secondary resonances; difference of the directions {at_most(differ)}",
    )


@claim(
    "s5-resonance",
    "6, Fig. 17",
    "With the bumpers attached to the mass, the resonance of B3-A3 moves up to about 5.4 Hz.",
    "The frequency of the largest η_d must be 5.4 Hz to the printed digit (5.35 to 5.45 Hz).",
)
def resonance(study: PublishedStudy) -> Finding:
    """Use the parameters of Table 1."""
    frequency = _resonance(study)
    rig = _curves(study)["eta_a"].sel(direction="forward")
    return Finding(
        abs(frequency - _PRINTED) <= 0.05,
        f"{frequency:.2f} Hz in η_d, {float(rig.idxmax('frequency')):.2f} Hz in η_a; "
        "printed 5.4 Hz",
    )


@claim(
    "s5-one-motion",
    "6, Fig. 18",
    "With the bumpers attached, B3-A3 has one periodic motion with a single frequency at every "
    "forcing frequency.",
    "At all frequencies, both sweeps must reach the same motion, with a period of one forcing "
    "cycle. At 1, 3 and 8 Hz and at resonance, all higher harmonics of the displacement together "
    "must be below 10 % of the first.",
)
def one_motion(study: PublishedStudy) -> Finding:
    """Check all frequencies; spectra are computed at some of them."""
    data = _curves(study)
    places = [1.0, 3.0, _resonance(study), 8.0]
    shares = [higher(study.motion(_CODE, f, "forward")) for f in places]
    settled = bool((data["period"] == 1).all())
    holds = settled and float(apart(data).max()) < 1e-6 and max(shares) < ALMOST_ONE_LINE
    return Finding(
        holds,
        f"{'all' if settled else 'not all'} motions have a period of one cycle; higher harmonics "
        f"{listed([100 * s for s in shares], '.2g')} % at {listed(places)} Hz",
    )


@claim(
    "s5-short-flights",
    "6, Fig. 18",
    "With the bumpers attached, the mass is nearly always in contact with one bumper or the other. "
    "The flights between contacts are very short.",
    "At resonance, there must be one contact per side and cycle. The time between contacts, "
    "divided by the forcing period, must be above 0 and below 5 %.",
)
def flights(study: PublishedStudy) -> Finding:
    """Measure the time between contacts: the bumper that was just left has nearly recovered."""
    place = _resonance(study)
    motion = study.motion(_CODE, place, "forward")
    flight = 1.0 - float(motion["contact_duration_share"].sum())
    return Finding(
        impacts(motion) == (1.0, 1.0) and 0.0 < flight < 0.05,
        f"{flight:.2%} of the period in two flights at {place:.2f} Hz "
        f"({1e3 * flight / place / 2.0:.2f} ms each)",
    )


@claim(
    "s5-recovered-before-met",
    "6, Fig. 18",
    "With the bumpers attached, the mass leaves a bumper when this bumper has recovered almost all "
    "its deformation. The bumper that the mass meets next has recovered long before.",
    "Two deformations are divided by the largest one. The deformation of a bumper at the end of "
    "its contact must be below 10 %. The deformation of the other bumper when the mass meets it "
    "must be below 1 %.",
)
def recovered(study: PublishedStudy) -> Finding:
    """Use the deformations in the log of events."""
    motion = study.motion(_CODE, _resonance(study), "forward")
    largest = float(motion["contact_penetration"].max())
    begins = motion["event_contact"].values == 1
    own = motion["event_deformation"].sel(stop=motion["event_stop"]).values
    left, met = (np.abs(own[where]).max() / largest for where in (~begins, begins))
    return Finding(
        bool(0.0 < left < 0.1 and met < 0.01),
        f"deformation {left:.1%} of the largest when the mass leaves the bumper, {_share(met)} "
        "when the mass meets it",
    )


CLAIMS = (smooth, resonance, one_motion, flights, recovered)
