"""Section 6: scenario S5, bumpers that touch the mass at rest."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.paper.claim import Finding
from vibroimpact.paper.claims.reading import (
    ALMOST_ONE_LINE,
    ROUNDING,
    apart,
    at_most,
    claim,
    higher,
    impacts,
    listed,
)
from vibroimpact.paper.study import PublishedStudy
from vibroimpact.response.resonance import features

_CODE = "B3-0mm-A3"
_LOW, _HIGH = 0.3, 10.0
_PRINTED = 5.4


def _curves(study: PublishedStudy) -> xr.Dataset:
    return study.curves(_CODE, low=_LOW, high=_HIGH)


def _share(value: float) -> str:
    return "0 to rounding" if value < ROUNDING else f"{value:.1%}"


def _resonance(study: PublishedStudy) -> float:
    return float(_curves(study)["eta_d"].sel(direction="forward").idxmax("frequency"))


@claim(
    "s5-smooth",
    "6, Fig. 17",
    "With the bumpers attached to the mass, B3-A3 shows smooth curves again: no jump, no "
    "hysteresis, no secondary resonance.",
    "What the sweeps from 0.3 to 10 Hz show, and the largest difference of the directions.",
)
def smooth(study: PublishedStudy) -> Finding:
    """Check that each curve has only one peak."""
    data = _curves(study)
    found = features(data)
    others = [p for p in found.peaks if not p.primary]
    differ = float(apart(data).max())
    holds = not (found.jumps or found.hysteresis or others) and differ < 1e-6
    return Finding(
        holds,
        f"{len(found.jumps)} jumps, {len(found.hysteresis)} hystereses, {len(others)} secondary "
        f"resonances; difference of the directions {at_most(differ)}",
    )


@claim(
    "s5-resonance",
    "6, Fig. 17",
    "With the bumpers attached to the mass, the resonance of B3-A3 has moved up to about 5.4 Hz.",
    "Frequency of the largest η_d: 5.4 Hz to the digit printed (5.35 to 5.45 Hz).",
)
def resonance(study: PublishedStudy) -> Finding:
    """Use the parameters of Table 1."""
    found = _resonance(study)
    rig = _curves(study)["eta_a"].sel(direction="forward")
    return Finding(
        abs(found - _PRINTED) <= 0.05,
        f"{found:.2f} Hz in η_d, {float(rig.idxmax('frequency')):.2f} Hz in η_a; printed 5.4 Hz",
    )


@claim(
    "s5-one-motion",
    "6, Fig. 18",
    "With the bumpers attached, B3-A3 has at every frequency one periodic motion of a single "
    "frequency.",
    "Settled on one forcing cycle at all frequencies, both directions alike; at 1, 3 and 8 Hz and "
    "at resonance all higher harmonics of the displacement together are below 10 % of the first.",
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
        f"{'all' if settled else 'not all'} settle on one cycle; higher harmonics "
        f"{listed([100 * s for s in shares], '.2g')} % at {listed(places)} Hz",
    )


@claim(
    "s5-short-flights",
    "6, Fig. 18",
    "With the bumpers attached, the mass is nearly always in contact with one or the other; the "
    "flights between are very short.",
    "At resonance: one contact a side and cycle, and the time between contacts over T: above 0, "
    "below 5 %.",
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
    "With the bumpers attached, each is left when it has recovered almost all its deformation, and "
    "the one that is met next has recovered long before.",
    "Deformation at the end of a contact over the largest one, and that of the other bumper as it "
    "is met over the same: below 10 % and below 1 %.",
)
def recovered(study: PublishedStudy) -> Finding:
    """Use the deformations in the log of events."""
    motion = study.motion(_CODE, _resonance(study), "forward")
    largest = float(motion["contact_penetration"].max())
    side, begins = motion["event_side"].values, motion["event_contact"].values == 1
    own = np.where(
        side == 1, motion["event_right_bumper"].values, -motion["event_left_bumper"].values
    )
    left, met = (np.abs(own[where]).max() / largest for where in (~begins, begins))
    return Finding(
        bool(0.0 < left < 0.1 and met < 0.01),
        f"left at {left:.1%}, met at {_share(met)} of the largest",
    )


CLAIMS = (smooth, resonance, one_motion, flights, recovered)
