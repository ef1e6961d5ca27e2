"""Functions that make claims, and quantities of the study that several claims use."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Literal, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from paper.claim import Claim, Finding, Kind
from paper.study import HIGH, LOW, STEP, PublishedStudy
from vibroimpact.model import laboratory
from vibroimpact.response.curve_pair import Direction, in_contact
from vibroimpact.response.peaks import Curve, Peak
from vibroimpact.response.spectrum import fourier_spectrum
from vibroimpact.scenarios.evidence import SAME

TEST_STEP = 0.1
"""Frequency step of the tests in Hz. A frequency that the paper calls "about" may differ by it."""
ROUNDING = 1e-9
"""Largest difference of numbers of about 1 that is reported as no difference."""
ALMOST_ONE_LINE = 0.1
"""Ratio of all higher harmonics to the first one below which the first one is predominant."""

ACCELERATIONS = tuple(laboratory.ACCELERATIONS)
BUMPERS = tuple(laboratory.BUMPERS)
FALLING_GAPS = tuple(laboratory.GAPS)[::-1]
CODES = tuple(f"{b}-{g}-{a}" for a in ACCELERATIONS for b in BUMPERS for g in laboratory.GAPS)
"""Codes of the 48 tests."""

BOTH: tuple[Direction, Direction] = ("forward", "backward")

SYMBOLS: Mapping[Curve, str] = {"eta_a": "η_a", "eta_d": "η_d"}

Array = NDArray[np.float64]
Sequences = Mapping[str, Sequence[str]]
"""Cases in the order of one parameter, by the parameters that stay constant."""

ALONG_GAP: Sequences = {
    f"{b}-{a}": [f"{b}-{g}-{a}" for g in FALLING_GAPS] for a in ACCELERATIONS for b in BUMPERS
}
ALONG_ACCELERATION: Sequences = {
    f"{b}-{g}": [f"{b}-{g}-{a}" for a in ACCELERATIONS] for b in BUMPERS for g in laboratory.GAPS
}
ALONG_BUMPER: Sequences = {
    f"{g}-{a}": [f"{b}-{g}-{a}" for b in BUMPERS] for a in ACCELERATIONS for g in laboratory.GAPS
}


class AbsentError(LookupError):
    """Exception for a feature that does not occur, so that a statement about it is not true."""


def claim(
    key: str, section: str, statement: str, quantity: str, kind: Kind = Kind.COMPUTED
) -> Callable[[Callable[[PublishedStudy], Finding]], Claim]:
    """Return a decorator that turns a function into a claim."""

    def made(find: Callable[[PublishedStudy], Finding]) -> Claim:
        def evaluate(study: PublishedStudy) -> Finding:
            try:
                holds, number = find(study)
            except AbsentError as absent:
                return Finding(False, str(absent))
            # Comparisons of arrays give numpy's booleans.
            return Finding(None if holds is None else bool(holds), number)

        return Claim(key, section, statement, quantity, evaluate, kind)

    return made


def peak(study: PublishedStudy, code: str, curve: Curve, direction: Direction) -> Peak:
    """Return the primary resonance of a test."""
    return next(
        p
        for p in study.features(code).peaks
        if p.primary and (p.curve, p.direction) == (curve, direction)
    )


def jump(study: PublishedStudy, code: str, direction: Direction) -> float | None:
    """Return the frequency (Hz) of the jump at the primary resonance: forward down, backward up."""
    return max(
        (
            j.frequency
            for j in study.features(code).jumps
            if j.direction == direction and j.settled and j.upward == (direction == "backward")
        ),
        default=None,
    )


def both_jumps(study: PublishedStudy, code: str) -> tuple[float, float]:
    """Return the frequencies (Hz) of the downward and the upward jump, or raise `AbsentError`."""
    down, up = (jump(study, code, way) for way in BOTH)
    if down is None or up is None:
        raise AbsentError(f"{code} does not jump")
    return down, up


class Trend(NamedTuple):
    """The changes of a value along several sequences of cases."""

    held: int
    """Number of sequences along which the value is monotonic, and changes by more than the smallest
    accepted change."""
    moves: dict[str, float]
    """Last value minus first value."""
    values: dict[str, list[float]]

    @property
    def all_hold(self) -> bool:
        """Return whether there are sequences, and all have the trend."""
        return bool(self.moves) and self.held == len(self.moves)

    def describe(self, digits: str, unit: str = "") -> str:
        """Describe the trend in words."""
        low, high = min(self.moves.values()), max(self.moves.values())
        return (
            f"holds in {self.held} of {len(self.moves)} sequences; total changes from "
            f"{low:+{digits}} to {high:+{digits}}{unit}"
        )


def trend(
    sequences: Sequences, value: Callable[[str], float | None], sign: int, least: float = 0.0
) -> Trend:
    """Return the trend of a value. `sign` is 1 if it should rise, and -1 if it should fall.

    Cases without a value are left out. Sequences with fewer than two other cases are left out, too.
    """
    held, moves, kept = 0, {}, {}
    for name, codes in sequences.items():
        values = [number for code in codes if (number := value(code)) is not None]
        if len(values) < 2:
            continue
        changes = sign * np.diff(values)
        moves[name], kept[name] = values[-1] - values[0], values
        held += bool((changes >= 0.0).all() and changes.sum() > least)
    if not moves:
        raise AbsentError("no sequence has two tests with this feature")
    return Trend(held, moves, kept)


def jump_trend(study: PublishedStudy, sequences: Sequences, direction: Direction) -> Trend:
    """Return the trend of the frequency of a jump, which must rise by more than one step."""
    return trend(sequences, lambda code: jump(study, code, direction), 1, 1.5 * STEP)


def peak_trend(
    study: PublishedStudy, sequences: Sequences, curve: Curve, direction: Direction, sign: int
) -> Trend:
    """Return the trend of the height of the primary resonance."""
    return trend(sequences, lambda code: peak(study, code, curve, direction).value, sign)


def backward_less(forward: Trend, backward: Trend) -> bool:
    """Return whether the backward value rises in all sequences, and less than the forward value.

    Sequences may have different lengths, because a test without a jump is left out of both.
    """
    return backward.all_hold and all(
        abs(move) < abs(forward.moves[name]) for name, move in backward.moves.items()
    )


def touching(data: xr.Dataset) -> xr.DataArray:
    """Return where the mass hits a bumper in a sweep."""
    return in_contact(data)


def contact_span(study: PublishedStudy, code: str) -> tuple[float, float]:
    """Return the first and last frequency (Hz) of the forward sweep at which a bumper is hit."""
    spans = [c for c in study.features(code).contact if c.direction == "forward"]
    if not spans:
        raise AbsentError(f"{code} never hits its bumpers")
    return min(c.low for c in spans), max(c.high for c in spans)


def free(data: xr.Dataset, curve: Curve) -> xr.DataArray:
    """Return free flight on the same scale as η_a or η_d."""
    name = {"eta_a": "free_acceleration_excursion", "eta_d": "free_displacement_excursion"}[curve]
    return data[name] / data[f"largest_{name}"]


def secondary(study: PublishedStudy, code: str) -> list[tuple[float, float]]:
    """Return frequency (Hz) and relative prominence of secondary resonances without hysteresis."""
    classification = study.classification(code)
    return classification.features.secondary_resonances(classification.thresholds.prominence)


def left_folds(study: PublishedStudy, code: str) -> list[tuple[float, float]]:
    """Return the left hystereses of a test below its primary resonance, between exact folds (Hz).

    They are determined on the branch, so that even hystereses narrower than the step of the sweeps
    are found. Hystereses that only the sweeps show are included.
    """
    features = study.classification(code).features
    folds = sorted(features.folds or ())
    below = [fold for fold in folds if fold < features.top]
    if len(below) < len(folds):
        below = below[:-1]  # the last is the lower end of the primary hysteresis
    exact = list(zip(below[-2::-2], below[::-2], strict=False))[::-1]
    swept = [
        item.ends
        for item in features.left
        if not any(low <= item.ends[1] and item.ends[0] <= high for low, high in exact)
    ]
    return sorted([*exact, *swept])


def describe_left(hystereses: list[tuple[float, float]]) -> str:
    """Describe left hystereses in words, with their widths."""
    parts = [f"{low:.4f} to {high:.4f} Hz ({high - low:.3f} Hz wide)" for low, high in hystereses]
    return f"left hysteresis {', '.join(parts)}" if parts else "no left hysteresis"


def at_onset(study: PublishedStudy, code: str) -> list[tuple[float, float]]:
    """Return the peaks of η_a where contact begins, with free flight at their foot.

    They belong to the transition to the primary resonance, and are not secondary resonances. Each
    is returned once, as frequency (Hz) and relative prominence.
    """
    classification = study.classification(code)
    least = classification.thresholds.prominence
    peaks: list[tuple[float, float]] = []
    for one in sorted(classification.features.peaks, key=lambda p: -p.prominence / p.value):
        inside = any(low <= one.frequency <= high for low, high in classification.features.onset)
        if one.primary or one.curve != "eta_a" or not inside or one.prominence < least * one.value:
            continue
        if all(abs(one.frequency - known) > SAME * known for known, _ in peaks):
            peaks.append((one.frequency, one.prominence / one.value))
    return sorted(peaks)


def describe_onset(study: PublishedStudy, codes: Iterable[str]) -> str:
    """Describe in words the peaks that are left out because contact begins there."""
    parts = [
        f"{code} {share:.0%} at {frequency:.2f} Hz"
        for code in codes
        for frequency, share in at_onset(study, code)
    ]
    return f"left out because contact begins there: {', '.join(parts) or 'none'}"


def regular_places(
    study: PublishedStudy, code: str, parameters: laboratory.Parameters = "table"
) -> tuple[float, float, float]:
    """Return `PublishedStudy.regular_places`, or raise `AbsentError`."""
    try:
        return study.regular_places(code, parameters)
    except (ValueError, IndexError, StopIteration):
        raise AbsentError(f"{code} has no secondary resonance, or no downward jump") from None


def impacts(motion: xr.Dataset) -> tuple[float, float]:
    """Return the impacts per forcing cycle, right and left."""
    return float(motion["impacts"].sel(stop="right")), float(motion["impacts"].sel(stop="left"))


Line = Literal["displacement", "acceleration"]
LINES: tuple[Line, Line] = ("displacement", "acceleration")


def harmonics(motion: xr.Dataset, of: Line = "displacement", highest: int = 20) -> Array:
    """Return the amplitudes of the harmonics 1, 2, ... of a quantity, divided by the first one."""
    lines = fourier_spectrum(motion, highest)
    whole = lines.sel(order=list(range(1, highest + 1)))[f"{of}_amplitude"].values
    shares: Array = whole / whole[0]
    return shares


def higher(motion: xr.Dataset, of: Line = "displacement") -> float:
    """Return the size of all higher harmonics of a quantity together, divided by the first one."""
    return float(np.sqrt((harmonics(motion, of)[1:] ** 2).sum()))


def turns(motion: xr.Dataset) -> float:
    """Return the number of sign changes of the velocity per forcing cycle."""
    sign = np.sign(motion["velocity"].values)
    sign = sign[sign != 0.0]
    return float((sign[1:] != sign[:-1]).sum()) / float(motion["cycle"][-1] - motion["cycle"][0])


def orbits_at(branch: xr.Dataset, frequency: float) -> tuple[int, int]:
    """Return the stable and unstable orbits at which a branch passes through a frequency."""
    along, stable = branch["frequency"].values, branch["stable"].values == 1
    passes = (along[1:] - frequency) * (along[:-1] - frequency) < 0.0
    both = stable[1:] & stable[:-1]
    return int((passes & both).sum()), int((passes & ~both).sum())


def three_between_jumps(study: PublishedStudy, code: str) -> Finding:
    """Return whether half-way between the jumps there are two stable orbits and an unstable one."""
    middle = 0.5 * sum(both_jumps(study, code))
    stable, unstable = orbits_at(study.antisymmetric_branch(code, LOW, HIGH), middle)
    return Finding(
        (stable, unstable) == (2, 1), f"{stable} stable, {unstable} unstable at {middle:.2f} Hz"
    )


def apart(data: xr.Dataset) -> xr.DataArray:
    """Return the difference of the two sweep directions in η_a or η_d, as a share of the larger."""

    def one(curve: Curve) -> xr.DataArray:
        eta = data[curve]
        return (eta.max("direction") - eta.min("direction")) / eta.max("direction")

    return xr.concat([one("eta_a"), one("eta_d")], "curve").max("curve")


def span(low: float, high: float, unit: str = "Hz") -> str:
    """Return a range in words."""
    return f"{low:g} to {high:g} {unit}".rstrip()


def at_most(value: float, digits: str = ".1e", unit: str = "") -> str:
    """Return a largest difference in words. A difference within rounding counts as none."""
    return "0 (within rounding)" if abs(value) < ROUNDING else f"at most {value:{digits}}{unit}"


def listed(values: Iterable[float], digits: str = ".3g") -> str:
    """Return values in their order, as text."""
    return ", ".join(f"{value:{digits}}" for value in values)


def runs(frequency: Array, true: NDArray[np.bool_]) -> Iterator[tuple[float, float]]:
    """Return the frequency ranges in which a condition is true."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], true, [False]])))
    for first, end in edges.reshape(-1, 2):
        yield float(frequency[first]), float(frequency[end - 1])
