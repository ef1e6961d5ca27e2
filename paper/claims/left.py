"""Section 6: scenario S4, with a gap smaller than in the tests, and its left hystereses."""

from __future__ import annotations

import numpy as np
import xarray as xr

from paper.claim import Finding
from paper.claims.named import EDGE_LOW
from paper.claims.reading import (
    BOTH,
    AbsentError,
    claim,
    impacts,
    listed,
    orbits_at,
    turns,
)
from paper.study import PublishedStudy
from vibroimpact.response.resonance import Features, Hysteresis, features

CODE = "B3-10mm-A3"
START = 0.3
AROUND = (0.9, 1.4)
"""Frequency range around the non-regular resonance (Hz)."""


def curves(study: PublishedStudy) -> xr.Dataset:
    """Return the sweeps from 0.3 Hz."""
    return study.curves(CODE, low=START)


def found_features(study: PublishedStudy) -> Features:
    """Return the features of these sweeps."""
    return features(curves(study))


def _left(study: PublishedStudy) -> list[Hysteresis]:
    """Return the left hystereses below 0.9 Hz, by frequency."""
    return [
        item
        for item in found_features(study).hysteresis
        if item.side == "left" and item.settled and item.high < AROUND[0]
    ]


def places(study: PublishedStudy) -> tuple[float, float]:
    """Return `PublishedStudy.other_places`, or raise `AbsentError`."""
    try:
        return study.other_places(CODE, START)
    except ValueError:
        raise AbsentError(
            f"{CODE} has no left hysteresis, or no range without periodic motion"
        ) from None


@claim(
    "s4-left-hystereses",
    "6, Fig. 15",
    "With a total gap of 10 mm, B3-A3 has several secondary resonances with left hysteresis below "
    "0.9 Hz.",
    "The sweeps from 0.3 Hz in steps of 0.01 Hz must show two or more left hystereses (the "
    "backward sweep above the forward sweep). Sweeps from 0.44 Hz, where `vibroimpact classify` "
    "begins, show fewer.",
)
def left(study: PublishedStudy) -> Finding:
    """Count the left hystereses from 0.3 Hz, in steps of 0.01 Hz."""
    ranges = _left(study)
    ends = ", ".join(f"{i.ends[0]:.3f} to {i.ends[1]:.3f}" for i in ranges)
    above = sum(item.low >= EDGE_LOW for item in ranges)
    return Finding(
        len(ranges) >= 2,
        f"{len(ranges)} in sweeps from {START:g} Hz ({above} of them above {EDGE_LOW:g} Hz): "
        f"{ends or 'none'} Hz",
    )


@claim(
    "s4-two-motions",
    "6, Fig. 16",
    "In a left hysteresis, two periodic motions with impacts coexist. Each is its own mirror "
    "image. The larger one is the motion of the backward sweep.",
    "The motions that the two sweeps reach in the middle of the widest left hysteresis must be "
    "periodic, be their own mirror images, and have impacts on both sides. The backward motion "
    "must be the larger one.",
)
def two_motions(study: PublishedStudy) -> Finding:
    """Compare the motions at f_I."""
    place = places(study)[0]
    forward, backward = (study.motion(CODE, place, way) for way in BOTH)
    sizes = [1e3 * float(m["displacement_excursion"]) for m in (forward, backward)]
    holds = sizes[1] > sizes[0] and all(
        str(m["motion"].item()) == "periodic" and bool(m["antisymmetric"]) and min(impacts(m)) > 0
        for m in (forward, backward)
    )
    return Finding(
        holds, f"{place:.2f} Hz: excursions forward {sizes[0]:.2f}, backward {sizes[1]:.2f} mm"
    )


@claim(
    "s4-two-and-one-impact",
    "6, Fig. 16",
    "In the widest left hysteresis, the mass hits each bumper twice per cycle in the forward sweep "
    "and once per cycle in the backward sweep.",
    "The motions in the middle of the widest left hysteresis must have two and one impacts per "
    "cycle and side.",
)
def two_and_one(study: PublishedStudy) -> Finding:
    """Count the impacts of both motions at f_I."""
    place = places(study)[0]
    counts = [impacts(study.motion(CODE, place, way)) for way in BOTH]
    return Finding(
        counts == [(2.0, 2.0), (1.0, 1.0)],
        f"{place:.2f} Hz: forward {listed(counts[0])}, backward {listed(counts[1])} (right, left)",
    )


@claim(
    "s4-loops",
    "6, Fig. 16",
    "In the widest left hysteresis, both phase portraits have inner loops. The loops of the "
    "forward motion cross the bumpers. The loops of the backward motion do not reach them.",
    "In both motions, the velocity must change its sign more than twice per cycle, which means a "
    "loop. The forward motion must have more than one impact per side, and the backward motion "
    "exactly one.",
)
def loops(study: PublishedStudy) -> Finding:
    """Count loops and impacts: a loop that crosses the bumper is a second impact."""
    place = places(study)[0]
    both = [study.motion(CODE, place, way, samples=1024) for way in BOTH]
    counts, more = [turns(m) for m in both], [impacts(m)[0] - 1.0 for m in both]
    return Finding(
        min(counts) > 2.5 and more[0] > 0.0 and more[1] == 0.0,
        f"sign changes: {listed(counts, '.0f')}; additional impacts: {listed(more, '.0f')} "
        "(forward, backward)",
    )


@claim(
    "s4-third-motion",
    "6",
    "In a left hysteresis, a third, unstable motion lies between the two stable ones.",
    "The branch of periodic motions must have two stable motions and an unstable one in the middle "
    "of the widest left hysteresis.",
)
def third(study: PublishedStudy) -> Finding:
    """Check that there are two stable orbits and an unstable one."""
    place, ranges = places(study)[0], _left(study)
    widest = max(ranges, key=lambda item: item.high - item.low)
    branch = study.antisymmetric_branch(CODE, widest.low - 0.1, widest.high + 0.1)
    stable, unstable = orbits_at(branch, place + 1e-6)
    return Finding(
        (stable, unstable) == (2, 1), f"{stable} stable, {unstable} unstable at {place:.2f} Hz"
    )


@claim(
    "s4-impacts-with-frequency",
    "6",
    "Left hystereses at lower frequencies have more impacts per cycle. The forward sweep always "
    "has more impacts than the backward sweep.",
    "The impacts per side are counted in the middle of each left hysteresis. They must increase "
    "from each hysteresis to the next lower one, and the forward sweep must have more than the "
    "backward sweep.",
)
def more_impacts(study: PublishedStudy) -> Finding:
    """Count the impacts in the sweeps."""
    data, rows = curves(study), []
    for item in reversed(_left(study)):
        inside = data.sel(frequency=slice(item.low - 1e-9, item.high + 1e-9))
        middle = inside.isel(frequency=inside.sizes["frequency"] // 2)
        rows.append([float(middle["impacts"].sel(stop="right").sel(direction=way)) for way in BOTH])
    if len(rows) < 2:
        raise AbsentError(f"{len(rows)} left hystereses below 0.9 Hz")
    counts = np.array(rows)
    holds = bool((np.diff(counts, axis=0) > 0).all() and (counts[:, 0] > counts[:, 1]).all())
    return Finding(
        holds,
        f"forward {listed(counts[:, 0], 'g')}; backward {listed(counts[:, 1], 'g')} impacts per "
        "side as the frequency falls",
    )


CLAIMS = (left, two_motions, two_and_one, loops, third, more_impacts)
