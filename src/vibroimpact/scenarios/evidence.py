"""What a pair of resonance curves shows, as far as it decides the scenario.

A secondary resonance lies below the primary one and within the range in which the mass hits the
bumpers: also in the valley at its foot, on the side of low frequencies. Where contact begins on the
primary resonance's ascending branch, the motion often is not regular over a short range: the
bumpers are grazed, now and then. That is the transition from free flight onto the primary
resonance, no resonance of its own; it is told apart as the onset.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Literal, NamedTuple, TypeAlias

import numpy as np
import xarray as xr

from vibroimpact.model.clearance import at_rest, clearances_at_rest
from vibroimpact.model.rig import Rig
from vibroimpact.model.unbounded import has_no_bound
from vibroimpact.response.analytic_free_response import reference_excursions, resonance_ratio
from vibroimpact.response.curve_pair import Array, Direction, Flags, Swept, as_rigs
from vibroimpact.response.peaks import Peak, peaks
from vibroimpact.response.resonance import Hysteresis, Jump, hysteresis, jumps_beside, runs
from vibroimpact.scenarios.contact_onset import foot_in_contact, onset, within
from vibroimpact.scenarios.resonance_curves import Curves, each_curves

KNOWN = 0.5
"""Share of the holds of either direction that must have a value."""
SETTLED = 0.1
"""Share of the holds that must have settled: where nothing does, the wait was too short."""
SAME = 0.15
"""Peaks of the two directions closer than this share of their frequency are one resonance's."""

Kind: TypeAlias = Literal[
    "not periodic", "quasi-periodic", "chaotic", "subharmonic", "mirrored pair"
]


class Irregular(NamedTuple):
    """Neighbouring frequencies at which the motion is not regular.

    Regular is a motion of one forcing cycle that, on a symmetric rig, is its own mirror image.
    """

    direction: Direction
    low: float
    """First frequency (Hz)."""
    high: float
    """Last frequency (Hz)."""
    kinds: tuple[Kind, ...]
    """What occurs in it. A sweep shows "not periodic" only."""
    prominence: float
    """Of the most prominent peak of η_a in it, over its height; 0 if it holds none."""
    not_periodic: tuple[float, float] | None
    """First and last frequency (Hz) of its motions that are not periodic."""


class Evidence(NamedTuple):
    """Features that determine the scenario of a rig."""

    natural_frequency: float
    """f0 in Hz."""
    swept: tuple[float, float]
    """Lowest and highest frequency (Hz)."""
    contact: tuple[float, float] | None
    """Lowest and highest frequency at which a bumper is hit (Hz); None in free flight."""
    attached: bool
    """Whether all bumpers touch the mass at rest."""
    known: bool
    """Whether most holds of either direction have values, and some have settled."""
    within: bool
    """Whether free flight's resonance lies within the frequencies swept, and the curves do not
    rise where they end, unless all of them is free flight."""
    gap_ratio: float
    """δ0 of the smallest gap: over the largest amplitude of free flight at any frequency (at
    those swept, without damping)."""
    penetration: float
    """Largest penetration over the gap of that side; NaN if the bumpers are attached."""
    resonance: float
    """Frequency of the largest η_d of the primary resonance, forward, over that of free flight."""
    primary_regular: bool
    """Whether the motion at the primary resonance is regular."""
    primary_beyond: bool
    """Whether the curves still rise where the sweep ends."""
    jumps: tuple[Jump, ...]
    hysteresis: tuple[Hysteresis, ...]
    left: tuple[Hysteresis, ...]
    """Left hystereses of secondary resonances."""
    irregular: tuple[Irregular, ...]
    """All ranges that are not regular, but for the onset."""
    onset: tuple[tuple[float, float], ...]
    """Ranges where contact begins in which the motion is not regular, or the two directions
    differ (Hz)."""
    secondary: tuple[Peak, ...]
    """Peaks of η_a, below the primary resonance, of regular motions with impacts."""
    peaks: tuple[Peak, ...]
    folds: tuple[float, ...] | None = None
    """Frequencies at which the branch of the primary resonance turns back (Hz): where it was
    followed, this is exact."""
    hidden_by: Literal["displacement", "unbalance"] | None = None
    """Amplitude under which η_a of free flight grows with the frequency, if the largest η_a of a
    direction is due to this growth: its primary resonance is then unknown. Otherwise None."""

    @property
    def jumping(self) -> bool:
        """Whether the curves jump anywhere, however narrow the hysteresis."""
        if any(item.settled for item in self.hysteresis):
            return True
        if self.folds is not None:
            return bool(self.folds)
        return any(jump.settled for jump in self.jumps)

    @property
    def top(self) -> float:
        """Highest frequency of a primary resonance's peak (Hz)."""
        return max((p.frequency for p in self.peaks if p.primary), default=math.inf)

    @property
    def right(self) -> tuple[Hysteresis, ...]:
        """Right hystereses."""
        return tuple(item for item in self.hysteresis if item.side == "right" and item.settled)

    @property
    def irregular_once(self) -> tuple[Irregular, ...]:
        """Ranges that are not regular, those of the two directions that overlap once."""
        ranges: list[Irregular] = []
        for item in self.irregular:
            if not any(item.low <= other.high and other.low <= item.high for other in ranges):
                ranges.append(item)
        return tuple(sorted(ranges, key=lambda item: item.low))

    def secondary_resonances(self, prominence: float) -> list[tuple[float, float]]:
        """Frequency (Hz) and prominence (over height) of the regular ones, each once."""
        resonances: list[tuple[float, float]] = []
        for peak in sorted(self.secondary, key=lambda p: -p.prominence):
            share = peak.prominence / peak.value
            if share >= prominence and all(
                abs(peak.frequency - known) > SAME * known for known, _ in resonances
            ):
                resonances.append((peak.frequency, share))
        return sorted(resonances)

    def extent(self, prominence: float) -> float:
        """Width of all left hystereses and non-regular resonances together, over f0.

        `prominence` is the least of a non-regular resonance, as a share of its height.
        """
        spans = [item.ends for item in self.left]
        spans += [
            (item.low, item.high)
            for item in self.irregular
            if item.prominence >= prominence and item.low < self.top
        ]
        total, reached = 0.0, -math.inf
        for low, high in sorted(spans):
            total += max(0.0, high - max(low, reached))
            reached = max(reached, high)
        # A width of whole steps is compared with thresholds: rounding must not decide.
        return round(total / self.natural_frequency, 12)


def evidence(rig: Rig, data: xr.Dataset, prominence: float) -> Evidence:
    """What the sweep of one rig shows.

    `data` is the dataset of its sweep in both directions.

    Parameters
    ----------
    prominence
        Least prominence of peaks that are kept, as a share of their height.

    Raises
    ------
    InputError
        If the dataset is not that of the sweep of one rig in both directions.
    """
    (curves,) = each_curves(as_rigs(data))
    return evidence_of(rig, curves, prominence)


def evidence_of(rig: Rig, curves: Curves, prominence: float) -> Evidence:
    """What the curves of one rig show."""
    both, uneven, free, most, least = curves
    uneven = uneven & rig.oscillator.symmetric
    oscillator = rig.oscillator
    frequency = both.frequency
    rest = at_rest(oscillator)
    reached = {"right": most - rest, "left": rest - least}
    gaps = clearances_at_rest(oscillator)
    touched = np.logical_or.reduce(both.touching).nonzero()[0]
    apart = hysteresis(both)
    all_peaks = peaks(both, prominence=prominence)
    irregular = ~both.settled | (both.period != 1) | uneven
    begins = onset(rig, both, irregular, apart, prominence)
    primary = {p.direction: p for p in all_peaks if p.primary and p.curve == "eta_a"}
    swings = {p.direction: p for p in all_peaks if p.primary and p.curve == "eta_d"}
    swing = swings.get("forward")
    beyond = any(p.at_end and p.frequency == frequency[-1] for p in primary.values())
    top = max((p.frequency for p in all_peaks if p.primary), default=math.inf)
    return Evidence(
        natural_frequency=oscillator.natural_frequency,
        swept=(float(frequency[0]), float(frequency[-1])),
        contact=(float(frequency[touched[0]]), float(frequency[touched[-1]]))
        if len(touched)
        else None,
        attached=bool(gaps) and max(gaps.values()) <= 0.0,
        known=bool(
            all(_share(values) >= KNOWN for values in np.isfinite(both.eta_a))
            and _share(both.settled) >= SETTLED
        ),
        within=not (beyond and len(touched)) and _resonance_within(rig, both),
        gap_ratio=min(gaps.values(), default=math.inf) / _largest(rig, free),
        penetration=max(
            ((reached[side] - gap) / gap for side, gap in gaps.items() if gap > 0.0),
            default=math.nan,
        ),
        resonance=swing.frequency / float(frequency[free.argmax()]) if swing else math.nan,
        primary_regular=not any(irregular[_place(p, both)] for p in primary.values()),
        primary_beyond=beyond,
        jumps=jumps_beside(apart, both),
        hysteresis=apart,
        left=tuple(
            item
            for item in apart
            if item.side == "left"
            and item.settled
            and item.low < top
            and not within(item.low, begins)
        ),
        irregular=tuple(_irregular(both, irregular, uneven, all_peaks, begins)),
        onset=begins,
        secondary=tuple(
            peak
            for peak in all_peaks
            if _regular_secondary(peak, both, irregular, primary)
            and not within(peak.frequency, begins)
            and foot_in_contact(both, *_place(peak, both), prominence)
        ),
        peaks=all_peaks,
        hidden_by=_growth(rig, both, primary, swings) if len(touched) else None,
    )


def _growth(
    rig: Rig, both: Swept, primary: dict[Direction, Peak], swings: dict[Direction, Peak]
) -> Literal["displacement", "unbalance"] | None:
    """The kind of amplitude that makes the largest η_a of a direction one of growth, or None.

    η_d has its largest value at the resonance, whatever shakes the rig. A largest η_a above that
    frequency is not a resonance if the mass is in free flight there, or where the sweep ends.
    """
    of = rig.sine.of
    if of not in ("displacement", "unbalance"):
        return None
    grown = any(
        peak.frequency > swings[direction].frequency
        and (peak.at_end or not both.touching[_place(peak, both)])
        for direction, peak in primary.items()
    )
    return of if grown else None


def _share(flags: Flags) -> float:
    return np.count_nonzero(flags) / flags.size


def _place(peak: Peak, both: Swept) -> tuple[int, int]:
    """Its direction and its frequency, as indices."""
    return both.directions.index(peak.direction), int(both.frequency.searchsorted(peak.frequency))


def _resonance_within(rig: Rig, both: Swept) -> bool:
    at = resonance_ratio(rig) * rig.oscillator.natural_frequency
    low, high = both.frequency[0], both.frequency[-1]
    return bool((at == 0.0 or low <= at) and (math.isinf(at) or at <= high))


def _largest(rig: Rig, free: Array) -> float:
    """Largest amplitude of free flight (m); if it has no bound, that at the frequencies swept."""
    bounded = not has_no_bound(rig)
    return 0.5 * reference_excursions(rig)[0] if bounded else float(np.nanmax(free))


def _irregular(
    both: Swept,
    irregular: Flags,
    uneven: Flags,
    all_peaks: tuple[Peak, ...],
    begins: tuple[tuple[float, float], ...],
) -> Iterator[Irregular]:
    frequency = both.frequency
    for k, direction in enumerate(both.directions):
        for first, last in runs(irregular[k]):
            low, high = float(frequency[first]), float(frequency[last])
            if within(low, begins):
                continue
            inside = slice(first, last + 1)
            unsettled = frequency[inside][~both.settled[k, inside]]
            present: dict[Kind, bool] = {
                "not periodic": len(unsettled) > 0,
                "subharmonic": bool((both.period[k, inside] > 1).any()),
                "mirrored pair": bool((uneven[k, inside] & (both.period[k, inside] == 1)).any()),
            }
            heights = [
                p.prominence / p.value
                for p in all_peaks
                if p.curve == "eta_a"
                and p.direction == direction
                and not p.primary
                and low <= p.frequency <= high
            ]
            yield Irregular(
                direction,
                low,
                high,
                tuple(kind for kind, there in present.items() if there),
                max(heights, default=0.0),
                (float(unsettled[0]), float(unsettled[-1])) if len(unsettled) else None,
            )


def _regular_secondary(
    peak: Peak, both: Swept, irregular: Flags, primary: dict[Direction, Peak]
) -> bool:
    if peak.curve != "eta_a" or peak.primary or peak.at_end:
        return False
    if peak.frequency >= primary[peak.direction].frequency:
        return False
    place = _place(peak, both)
    return bool(both.touching[place] and not irregular[place])
