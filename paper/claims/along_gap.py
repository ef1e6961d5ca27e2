"""Section 6: scenarios and trends of B3-A3 from free flight to no gap at all (Fig. 19)."""

from __future__ import annotations

import numpy as np
import xarray as xr

from paper.claim import Finding, Kind
from paper.claims.reading import BOTH, AbsentError, Array, claim
from paper.study import GAPS, PublishedStudy
from vibroimpact.response.curve_pair import Direction
from vibroimpact.response.peaks import Curve
from vibroimpact.response.resonance import features

_RANGE = (0.3, 8.0)
_CODES = tuple(f"B3-{gap}-A3" for gap in reversed(GAPS))


def jumps_of(data: xr.Dataset) -> dict[str, tuple[float, float]]:
    """Return the downward and upward jump at the primary resonance (Hz) of rigs that have both."""
    pairs = {}
    for code in data["rig"].values:
        jumps = [j for j in features(data.sel(rig=code, drop=True)).jumps if j.settled]
        down = [j.frequency for j in jumps if j.direction == "forward" and not j.upward]
        up = [j.frequency for j in jumps if j.direction == "backward" and j.upward]
        if down and up:
            pairs[str(code)] = max(down), max(up)
    if len(pairs) < 2:
        raise AbsentError("fewer than two of the curves have both jumps")
    return pairs


@claim(
    "scenarios-along-gap",
    "6, Fig. 19",
    "As the gap of B3-A3 falls from free flight to zero, the scenarios follow in the order S0 or "
    "S1, S2, S3, S4, S5.",
    "The scenarios are determined for the total gaps from no bumpers to 0 mm, from 0.3 to 8 Hz. "
    "The order must never reverse, and none of S2 to S5 may be missing.",
    Kind.RULES,
)
def along_gap(study: PublishedStudy) -> Finding:
    """Check that the order never reverses, and that no scenario is missing."""
    scenarios = [study.classification(code, *_RANGE).scenario for code in _CODES]
    listing = ", ".join(
        f"{code.split('-')[1]} {scenario}" for code, scenario in zip(_CODES, scenarios, strict=True)
    )
    return Finding(
        scenarios == sorted(scenarios)
        and {"S2", "S3", "S4", "S5"} <= set(scenarios) <= {f"S{k}" for k in range(6)},
        listing,
    )


@claim(
    "jumps-along-gap",
    "6, Fig. 19",
    "In the computed family of gaps, the jumps also move to higher frequencies as the gap falls. "
    "The upward jump moves less.",
    "As the gap falls, the frequencies of both jumps of B3-A3 must rise, where both jumps exist. "
    "Over the whole family, the upward jump must rise by less than the downward jump.",
)
def jumps_along_gap(study: PublishedStudy) -> Finding:
    """Compare the jumps from the widest gap with a jump to the smallest one."""
    jumps = jumps_of(study.by_gap().sel(rig=list(_CODES)))
    down, up = np.array(list(jumps.values())).T
    listing = ", ".join(
        f"{code.split('-')[1]} {d:.2f} and {u:.2f}" for code, (d, u) in jumps.items()
    )
    rising = (np.diff(down) > 0).all() and (np.diff(up) > 0).all()
    return Finding(rising and np.ptp(up) < np.ptp(down), f"downward and upward jump: {listing} Hz")


def _maxima(study: PublishedStudy, curve: Curve, direction: Direction) -> tuple[Array, float]:
    """Return the largest excursions along falling gaps, and separately without a gap."""
    most = study.by_gap()[curve].sel(rig=list(_CODES), direction=direction).max("frequency")
    return most.values[:-1], float(most[-1])


def _gap(k: int) -> str:
    return _CODES[k].split("-")[1]


@claim(
    "bell-along-gap",
    "6, Fig. 19",
    "Over the wider range of gaps, the maxima of η_a form a bell. The backward maxima do so to a "
    "lesser extent.",
    "For gaps that fall to 2 mm, the largest η_a of B3-A3 must rise to one maximum and then fall, "
    "in each direction. The backward maxima must have the smaller range.",
)
def bell_along_gap(study: PublishedStudy) -> Finding:
    """Check the maxima of both sweep directions."""
    parts, ranges, holds = [], [], True
    for way in BOTH:
        values, none = _maxima(study, "eta_a", way)
        ranges.append(float(np.ptp(values)))
        changes = np.diff(values)
        signs = np.sign(changes[np.abs(changes) > 1e-6 * values[1:]])
        turning = int((np.diff(signs) != 0).sum())
        holds &= turning == 1 and bool(signs[0] > 0)
        top = int(values.argmax())
        parts.append(
            f"{way} {values[0]:.2f} without bumpers, {values[top]:.2f} at {_gap(top)}, "
            f"{values[-1]:.2f} at {_gap(len(values) - 1)} ({turning} turning point"
            f"{'' if turning == 1 else 's'}); {none:.2f} without a gap"
        )
    return Finding(holds and ranges[1] < ranges[0], "; ".join(parts))


@claim(
    "displacement-along-gap",
    "6, Fig. 19",
    "Over the wider range of gaps, the maxima of η_d also fall with the gap.",
    "For gaps that fall to 2 mm, the largest η_d of B3-A3 must never rise, in each direction. It "
    "must fall where the bumpers are hit.",
)
def displacement_along_gap(study: PublishedStudy) -> Finding:
    """Check the maxima of both sweep directions."""
    parts, holds = [], True
    for way in BOTH:
        values, none = _maxima(study, "eta_d", way)
        changes, hit = np.diff(values), values[1:] < values[0] - 1e-6
        wrong = (changes > 1e-6) | (hit & (changes >= 0.0))
        holds &= not wrong.any()
        parts.append(
            f"{way} {values[0]:.2f} to {values[-1]:.3f}, {int(wrong.sum())} exceptions; "
            f"{none:.3f} without a gap"
        )
    return Finding(holds, "; ".join(parts))


CLAIMS = (along_gap, jumps_along_gap, bell_along_gap, displacement_along_gap)
