"""The motions of a search as variables of a dataset."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.attraction.attractors import Attractor
from vibroimpact.attraction.basin_fractions import interval
from vibroimpact.datasets.stops import stops_of
from vibroimpact.model import Oscillator
from vibroimpact.response.sections import section_variables
from vibroimpact.stability.equivalence import mirrors

_KEPT = (
    "displacement_excursion",
    "acceleration_excursion",
    "eccentricity",
)
POINTS = 1000
"""Points that are kept of a motion that does not repeat itself."""


def ranked(known: Sequence[Attractor]) -> list[int]:
    """Numbers of the motions, the largest first."""

    def size(number: int) -> tuple[float, ...]:
        one = known[number].motion
        excursion = float(one["displacement_excursion"])
        # To nine digits, for of a mirrored pair rounding decides; then by the side.
        return -float(f"{excursion:.9g}"), -float(one["eccentricity"])

    return sorted(range(len(known)), key=size)


def variables(oscillator: Oscillator, known: Sequence[Attractor]) -> dict[str, Any]:
    """What a dataset says of motions, in this order."""
    along = ("attractor",)
    shown = [one.points[: one.found.period or POINTS] for one in known]
    points = np.vstack([*shown, np.empty((0, 5))])
    return {
        "motion": (along, np.array([str(one.motion["motion"].values) for one in known], dtype=str)),
        "period": (along, np.array([int(one.motion["period"]) for one in known], dtype=np.int64)),
        **{name: (along, np.array([float(a.motion[name]) for a in known])) for name in _KEPT},
        "impacts": (
            (*along, "stop"),
            np.array([one.motion["impacts"].values for one in known]).reshape(len(known), -1),
        ),
        "stop": stops_of(oscillator),
        "exponents": (
            (*along, "exponent"),
            np.array([one.motion["exponents"].values for one in known]).reshape(-1, 2),
        ),
        "mirror_image": (along, _mirror_images(known)),
        "section_attractor": (
            "point",
            np.repeat(np.arange(len(known)), [len(one) for one in shown]),
        ),
        **section_variables(oscillator, points[:, :4] * [1.0, 1.0, 1.0, -1.0], ("point",)),
    }


def shares(labels: NDArray[np.integer[Any]], motions: int, drawn: int) -> dict[str, Any]:
    """Shares of states, with the intervals of as many that are drawn at random."""
    known = labels[labels >= -1]
    counts = np.array([(known == one).sum() for one in range(motions)], dtype=np.int64)
    share = counts / max(known.size, 1)
    low, high = interval(share * drawn, drawn)
    return {
        "states": ("attractor", counts),
        "share": ("attractor", share),
        "share_low": ("attractor", low),
        "share_high": ("attractor", high),
    }


def _mirror_images(known: Sequence[Attractor]) -> NDArray[np.int64]:
    """Which motion is each one's mirror image; -1 where that is not among them."""
    found = np.full(len(known), -1, dtype=np.int64)
    for i, one in enumerate(known):
        if not one.found.symmetric:
            continue
        for j, other in enumerate(known):
            alike = one.found.period == other.found.period
            if alike and mirrors(one.found, other.found, 10_000):
                found[i] = j
                break
    return found
