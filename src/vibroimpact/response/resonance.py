"""What a pair of resonance curves shows: peaks, jumps, hysteresis (the paper's Section 4).

Every function takes the dataset of `vibroimpact.sweep` and judges the normalised excursions
η_a and η_d at the frequencies that were held; nothing is interpolated between them.

Hysteresis is detected by comparing the two directions: where both have settled on the same motion
their excursions agree to rounding, so a difference of one per cent is another motion.

- Right hysteresis, as at the primary resonance: forward above backward. Its upper end is the
  forward sweep's downward jump, its lower end the backward sweep's upward jump.
- Left hysteresis, as at secondary resonances: backward above forward. Its upper end is the
  forward sweep's upward jump, its lower end the backward sweep's downward jump.

Whichever the side, above the upper end both directions follow one motion. The backward sweep
arrives from there, so it is the forward one that has changed motion, and the lower end mirrors
this: **the forward sweep jumps at the upper end, the backward sweep at the lower end.**

A curve by itself also shows a jump, by a step that neither of its neighbours announces
(`STEP`). This finds the jumps of a sweep in one direction, and those of a hysteresis so narrow
that it hides between two neighbouring frequencies. It does not prove one, because frequencies
that are too far apart make such a step of a smooth curve, too: `confirmed_jumps.confirm_jumps`
decides.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple, TypeAlias, TypeVar

import numpy as np
import xarray as xr

from vibroimpact.response.curve_pair import Array, Direction, Flags, Swept, swept
from vibroimpact.response.peaks import CURVES, PROMINENCE, Curve, Peak, peaks

APART = 0.01
"""Excursions that differ by more than this share belong to different motions.

Settled sweeps on the same motion agree to about 1e-9; the motions that coexist in the published
rig differ by at least 1.4 %.
"""

UNSETTLED_APART = 0.1
"""As `APART`, where one of the motions did not settle.

Its excursion is the largest seen in a window, and two windows of the same motion differ: by up
to 2 % near the bifurcations of the published rig.
"""

STEP = 5.0
"""A step this many times steeper than both its neighbours suggests a jump.

Where a continuous branch turns as a square root (at a fold, at grazing), a step is at most
1/(√2 - 1) = 2.4 times its neighbour, and at a cusp, where hysteresis is about to begin and the
branch rises as a cube root to both sides, at most 4.5 times. Only a branch that the frequencies
do not resolve makes a larger one, such as between a minimum and a maximum one step apart.
"""


class Jump(NamedTuple):
    """A sudden change of one direction's motion between two neighbouring frequencies."""

    direction: Direction
    before: float
    """Last frequency, in the order of the sweep, on the old motion (Hz)."""
    after: float
    """First frequency on the new motion (Hz)."""
    eta_a: tuple[float, float]
    """η_a before and after."""
    eta_d: tuple[float, float]
    """η_d before and after."""
    settled: bool
    """False if the motions beside it did not settle, so that a transient may look like it."""
    by: Curve = "eta_a"
    """The curve that shows it: η_d only where η_d alone makes a step, without hysteresis."""

    @property
    def upward(self) -> bool:
        """Whether the excursion that shows it grows."""
        before, after = self.eta_d if self.by == "eta_d" else self.eta_a
        return after > before

    @property
    def frequency(self) -> float:
        """Middle of the two frequencies (Hz)."""
        return 0.5 * (self.before + self.after)


Place: TypeAlias = tuple[Direction, float, float]
"""A direction and two neighbouring frequencies in its order."""


class Hysteresis(NamedTuple):
    """A range of frequencies in which the two directions follow different motions."""

    side: Literal["right", "left"]
    """``"right"``: forward above backward; ``"left"``: backward above forward."""
    low: float
    """Lowest frequency at which they differ (Hz)."""
    high: float
    """Highest frequency at which they differ (Hz)."""
    below: float | None
    """Next lower frequency, where they agree; None if the sweep does not reach so far."""
    above: float | None
    """Next higher frequency, where they agree; None if the sweep does not reach so far."""
    settled: bool
    """False if at no frequency both motions settled, so that transients may look like it."""

    @property
    def order(self) -> str:
        """Which curve lies above the other, in words."""
        higher, lower = ("forward", "backward")[:: 1 if self.side == "right" else -1]
        return f"{higher} curve above {lower} curve"

    @property
    def ends(self) -> tuple[float, float]:
        """Best estimate of its ends: the middle between the last two frequencies (Hz)."""
        low = self.low if self.below is None else 0.5 * (self.below + self.low)
        high = self.high if self.above is None else 0.5 * (self.high + self.above)
        return low, high

    @property
    def jumps(self) -> set[Place]:
        """Where its motions end, between two frequencies in the order of each direction."""
        places: set[Place] = set()
        if self.above is not None:
            places.add(("forward", self.high, self.above))
        if self.below is not None:
            places.add(("backward", self.low, self.below))
        return places


class FrequencyRange(NamedTuple):
    """Neighbouring frequencies of one direction that have something in common."""

    direction: Direction
    low: float
    """First frequency (Hz)."""
    high: float
    """Last frequency (Hz)."""
    holds: int
    """How many frequencies."""


_Feature = TypeVar("_Feature", Peak, Jump, Hysteresis, FrequencyRange)


class Features(NamedTuple):
    """All that a sweep shows."""

    peaks: tuple[Peak, ...]
    jumps: tuple[Jump, ...]
    hysteresis: tuple[Hysteresis, ...]
    unsettled: tuple[FrequencyRange, ...]
    """Where the motion did not become periodic within the cycle limit."""
    contact: tuple[FrequencyRange, ...]
    """Where the mass touches a bumper."""
    steep: tuple[Jump, ...] = ()
    """Steps that `confirmed_jumps.confirm_jumps` could not prove to be jumps."""

    def scaled(self, factor: float) -> Features:
        """Return the same with all frequencies multiplied by a factor, as for ω = 2π f."""

        def times(one: _Feature, *names: str) -> _Feature:
            values = {name: getattr(one, name) for name in names}
            known = {name: factor * f for name, f in values.items() if f is not None}
            return one._replace(**known)

        ends = ("low", "high")
        return Features(
            tuple(times(one, "frequency") for one in self.peaks),
            tuple(times(one, "before", "after") for one in self.jumps),
            tuple(times(one, *ends, "below", "above") for one in self.hysteresis),
            tuple(times(one, *ends) for one in self.unsettled),
            tuple(times(one, *ends) for one in self.contact),
            tuple(times(one, "before", "after") for one in self.steep),
        )


def features(
    data: xr.Dataset | Swept,
    *,
    apart: float = APART,
    unsettled_apart: float = UNSETTLED_APART,
    step: float = STEP,
    prominence: float = PROMINENCE,
) -> Features:
    """Find all features of a sweep; the thresholds are those of the functions below.

    Of measured curves they are no smaller than the measurement's noise: see
    `vibroimpact.measurements.features`.

    Raises
    ------
    InputError
        If the dataset is not that of a sweep of one rig.
    """
    both = data if isinstance(data, Swept) else swept(data)
    apart_by = hysteresis(both, apart=apart, unsettled_apart=unsettled_apart)
    return Features(
        peaks(both, prominence=prominence),
        jumps_beside(apart_by, both, apart, unsettled_apart, step),
        apart_by,
        ranges(both, ~both.settled),
        ranges(both, both.touching),
    )


def hysteresis(
    both: Swept, *, apart: float = APART, unsettled_apart: float = UNSETTLED_APART
) -> tuple[Hysteresis, ...]:
    """Find the ranges in which forward and backward sweep follow different motions, by frequency.

    Either η_a or η_d has to differ (see `APART` and `UNSETTLED_APART`). A range that changes its
    side in both at once is two ranges. With one direction there is nothing to compare.
    """
    if len(both.directions) < 2:
        return ()
    a, d = _relative(*both.eta_a), _relative(*both.eta_d)
    settled: Flags = both.settled[0] & both.settled[1]
    differ = np.maximum(np.abs(a), np.abs(d)) > np.where(settled, apart, unsettled_apart)
    if not differ.any():
        return ()
    known = np.isfinite(a + d)
    a, d, settled, differ = a[known], d[known], settled[known], differ[known]
    frequency = both.frequency[known]
    sides = np.sign(a), np.sign(d)
    turned = (sides[0][1:] != sides[0][:-1]) & (sides[1][1:] != sides[1][:-1])

    loops = []
    for first, last in runs(differ, turned):
        right = a[first : last + 1].sum() > 0.0
        loops.append(
            Hysteresis(
                "right" if right else "left",
                float(frequency[first]),
                float(frequency[last]),
                float(frequency[first - 1]) if first > 0 else None,
                float(frequency[last + 1]) if last + 1 < len(frequency) else None,
                bool(settled[first : last + 1].any()),
            )
        )
    return tuple(loops)


def ranges(both: Swept, flags: Flags) -> tuple[FrequencyRange, ...]:
    """Find the runs of neighbouring frequencies, in each direction, at which `flags` are true."""
    frequency = both.frequency
    return tuple(
        FrequencyRange(direction, float(frequency[first]), float(frequency[last]), last - first + 1)
        for direction, true in zip(both.directions, flags, strict=True)
        for first, last in runs(true)
    )


def jumps_beside(
    apart_by: tuple[Hysteresis, ...],
    both: Swept,
    apart: float = APART,
    unsettled_apart: float = UNSETTLED_APART,
    step: float = STEP,
) -> tuple[Jump, ...]:
    """Find the jumps of each direction: the ends of hysteresis, and breaks in the curve itself.

    Those of each direction come in the order of its sweep. A break has to be larger than `apart` or
    `unsettled_apart` (see `APART` and `UNSETTLED_APART`), and than `step` (see `STEP`).
    """
    places = {
        direction: _breaks(both, k, apart, unsettled_apart, step)
        for k, direction in enumerate(both.directions)
    }
    for loop in apart_by:
        if loop.above is not None:
            places["forward"][loop.high, loop.above] = loop.settled, "eta_a"
        if loop.below is not None:
            places["backward"][loop.below, loop.low] = loop.settled, "eta_a"
    return tuple(
        _jump(both, direction, *(pair if direction == "forward" else pair[::-1]), *shown)
        for direction, breaks in places.items()
        for pair, shown in sorted(breaks.items(), reverse=direction == "backward")
    )


def _relative(one: Array, other: Array) -> Array:
    """Return by how much one exceeds the other, as a share of the larger; 0 where both are 0."""
    larger = np.maximum(np.abs(one), np.abs(other))
    share: Array = (one - other) / (larger + (larger == 0.0))
    return share


def share_of_change(before: float, after: float) -> float:
    """Return how far two values are apart, as a share of the larger; 0 if one is not finite."""
    if not math.isfinite(before - after) or before == after:
        return 0.0
    return abs(after - before) / max(abs(before), abs(after))


def runs(true: Flags, split: Flags | None = None) -> list[tuple[int, int]]:
    """Return first and last index of each run; `split` parts a run between two neighbours."""
    (places,) = true.nonzero()
    if not len(places):
        return []
    parted = places[1:] - places[:-1] > 1
    if split is not None:
        parted |= split[places[:-1]]
    ends = parted.nonzero()[0]
    first, last = places[ends + 1].tolist(), places[ends].tolist()
    return list(zip([int(places[0]), *first], [*last, int(places[-1])], strict=True))


def _breaks(
    both: Swept, k: int, apart: float, unsettled_apart: float, step: float
) -> dict[tuple[float, float], tuple[bool, Curve]]:
    """Find the steps of one direction's curves that are far steeper than both neighbours.

    The first and the last step have one neighbour only, and are not judged.

    Returns
    -------
    dict
        The two frequencies of each, rising; whether a motion settled on both its sides; and the
        curve.
    """
    breaks: dict[tuple[float, float], tuple[bool, Curve]] = {}
    for name in CURVES:
        curve: Array = getattr(both, name)[k]
        known = np.isfinite(curve).nonzero()[0]
        if len(known) < 4:
            continue
        frequency, y = both.frequency[known], curve[known]
        slope = np.abs((y[1:] - y[:-1]) / (frequency[1:] - frequency[:-1]))
        steep = slope[1:-1] > step * np.maximum(slope[:-2], slope[2:])
        for i in steep.nonzero()[0].tolist():
            settled = both.settled[k, known[i : i + 4]].tolist()
            least = apart if settled[1] and settled[2] else unsettled_apart
            if share_of_change(*y[i + 1 : i + 3].tolist()) > least:
                # Near a fold the motion slows down: the last hold before a jump may not settle,
                # but the one before it will.
                evident = any(settled[:2]) and any(settled[2:])
                place = float(frequency[i + 1]), float(frequency[i + 2])
                breaks.setdefault(place, (evident, name))
    return breaks


def _jump(
    both: Swept, direction: Direction, before: float, after: float, settled: bool, by: Curve
) -> Jump:
    k = both.directions.index(direction)
    at = both.frequency.searchsorted([before, after])
    (a0, a1), (d0, d1) = (getattr(both, name)[k][at].tolist() for name in CURVES)
    return Jump(direction, before, after, (a0, a1), (d0, d1), settled, by)
