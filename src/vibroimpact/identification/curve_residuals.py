"""Measured curves as residuals: each point against its branch, each jump against its step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.identification.branch_response import DirectionResponse, SteppedRig, Way, follow
from vibroimpact.identification.overlay import TestPoints
from vibroimpact.identification.sensor_channel import sensed
from vibroimpact.measurements.features import measured_features, noise_of
from vibroimpact.measurements.names import CURVES
from vibroimpact.model.rig import Rig
from vibroimpact.response.analytic_free_response import reference_excursions
from vibroimpact.response.curve_pair import swept
from vibroimpact.response.hold_rows import HoldRows
from vibroimpact.response.resonance import APART, Jump

Array = NDArray[np.float64]

_QUIET = 1e-3
"""Noise is taken as no smaller, as a share of the largest value: nothing is measured to zero."""
_JUMP = 0.1
"""A jump outside its step by this share of it weighs as a point one standard deviation off."""
_NOISES = 4.0
"""Least change of a value at a jump, in standard deviations."""
_LARGE = 0.7
"""Logarithm of the factor from which on a break of one curve is a jump."""
_UNEVEN = 1e-9
"""Share of its excursion by which a motion goes further to one side that is not its own image."""
_EXTREMES = {"displacement_max", "displacement_min", "acceleration_max", "acceleration_min"}
"""Names of `HoldRows` that are measured as they are."""


class Points(NamedTuple):
    """All measured values of a test, flat."""

    way: NDArray[np.int64]
    """Number of the direction."""
    hold: NDArray[np.int64]
    """Number of the hold in the order of the sweep."""
    variable: NDArray[np.int64]
    """Number in `names`."""
    value: Array


class CurveTest:
    """A stepped-sine test: what was measured, and how a rig compares.

    Parameters
    ----------
    noise
        Standard deviation of a value as a share of it; None to estimate it.
    """

    kind = "curves"

    def __init__(self, name: str, data: xr.Dataset, rig: Rig, noise: float | None) -> None:
        self.name, self.data, self.rig = name, data, rig
        self.names = [variable for variable in CURVES if variable in data]
        self.noise = noise_of(data) if noise is None else noise
        self.weights = dict.fromkeys(self.names, 1.0)
        known = told_jumps(data)
        self.directions = [str(d) for d in data["direction"].values]
        self.ways: list[Way] = []
        parts: list[Array] = []
        steps: list[float] = []
        for number, direction in enumerate(self.directions):
            one = data.sel(direction=direction)
            tables = [one[v].transpose("frequency", ...).values for v in self.names]
            tables = [t.reshape(len(t), -1) for t in tables]
            there = np.any([np.isfinite(t).any(axis=1) for t in tables], axis=0)
            order = np.flatnonzero(there)[:: 1 if direction == "forward" else -1]
            frequency = one["frequency"].values[order]
            jumps = []
            for jump in known:
                if jump.direction != direction:
                    continue
                at = np.flatnonzero(frequency == jump.after)
                if len(at) and at[0] > 0:
                    jumps.append((int(at[0]), jump.upward))
                    steps.append(abs(float(frequency[at[0]] - frequency[at[0] - 1])))
            self.ways.append(Way(frequency, tuple(sorted(jumps))))
            for v, table in enumerate(tables):
                rows = table[order]
                held, _ = np.nonzero(np.isfinite(rows))
                values = rows[np.isfinite(rows)]
                filled = np.full((len(values), 4), number, dtype=float)
                filled[:, 1], filled[:, 2], filled[:, 3] = held, v, values
                parts.append(filled)
        flat = np.concatenate(parts)
        numbers = flat[:, :3].astype(np.int64)
        self.points = Points(numbers[:, 0], numbers[:, 1], numbers[:, 2], flat[:, 3])
        self.steps = np.array(steps)
        sizes = [np.abs(self.points.value[self.points.variable == v]).max(initial=0.0)
                 for v in range(len(self.names))]  # fmt: skip
        self.floor = _QUIET * np.array(sizes)[self.points.variable]
        self._check(sizes)

    def _check(self, sizes: list[float]) -> None:
        """Refuse values a thousand times too large or too small for the rig."""
        free = dict(zip(("displacement", "acceleration"), reference_excursions(self.rig),
                        strict=True))  # fmt: skip
        for name, size in zip(self.names, sizes, strict=True):
            reference = free.get(name.split("_")[0])
            if reference is None or not np.isfinite(reference) or size == 0.0:
                continue
            unit, si = ("mm", "m") if name.startswith("displacement") else ("m/s^2", "m/s²")
            if size > 100.0 * reference or (size < 1e-4 * reference):
                raise InputError(
                    f"data: {name} of {self.name!r} reaches {size:.3g} {si}, but the rig without "
                    f"stops reaches {reference:.3g} {si}; correct the unit or the rig. If the file "
                    f"is in {unit}, pass units={{{name!r}: {unit!r}}} to read_measurement (--units)"
                )

    @property
    def swing(self) -> float:
        """Not known: the shaking and the rig give it."""
        return 0.0

    @property
    def blind(self) -> bool:
        """Whether only excursions were measured, under shaking that is its own mirror image."""
        return self.rig.periodic.half_wave and not set(self.names) & _EXTREMES

    def calibrate(self, sensors: dict[str, float]) -> None:
        """Nothing begins with a measured value."""

    def reach(self, rig: Rig, unknowns: Array) -> tuple[float, float]:
        """How far the mass goes to the right and to the left at the holds (m)."""
        held = HoldRows(np.concatenate([sweep.rows for sweep in self.followed(rig)]))
        right, left = held.displacement_max.max(), -held.displacement_min.min()
        return float(np.nan_to_num(right, nan=np.inf)), float(np.nan_to_num(left, nan=np.inf))

    @property
    def count(self) -> int:
        """Number of its residuals."""
        return len(self.points.value) + len(self.steps)

    @property
    def points_count(self) -> int:
        """Number of measured values."""
        return len(self.points.value)

    @property
    def shares(self) -> Array:
        """Residuals are shares of the values themselves, over the weight of their quantity."""
        of = np.array([self.weights[name] for name in self.names])
        return of[self.points.variable]

    @property
    def channels(self) -> list[str]:
        """What each of its measured values is."""
        return [self.names[v] for v in self.points.variable]

    @property
    def groups(self) -> list[list[tuple[int, NDArray[np.bool_]]]]:
        """None, for there are no unknowns."""
        return []

    @property
    def unknowns(self) -> tuple[Array, Array]:
        """None: a steady motion has forgotten how it began."""
        return np.empty(0), np.empty(0)

    @property
    def frequency(self) -> Array:
        """Of each point, Hz."""
        return np.array(
            [self.ways[w].frequency[h] for w, h in zip(*self.points[:2], strict=True)], dtype=float
        )

    def followed(self, rig: Rig) -> list[DirectionResponse]:
        """What a rig does in each direction."""
        stepped = SteppedRig(rig)
        return [follow(stepped, way) for way in self.ways]

    def model(
        self, rig: Rig, sensors: dict[str, float], followed: list[DirectionResponse]
    ) -> tuple[Array, NDArray[np.bool_]]:
        """What the rig's sensors would show at each point, and whether it settled there."""
        values = np.empty(len(self.points.value))
        settled = np.empty(len(values), dtype=bool)
        normalised = any(name.startswith("eta") for name in self.names)
        largest = reference_excursions(rig) if normalised else (1.0, 1.0)
        for w, sweep in enumerate(followed):
            here = self.points.way == w
            at = self.points.hold[here]
            settled[here] = sweep.settled[at]
            shown = self._as_measured(sweep.rows, largest, sensors)
            values[here] = shown[at, self.points.variable[here]]
            for place, row in self._others(rig, sweep):
                here = (self.points.way == w) & (self.points.hold == place)
                of = self.points.variable[here]
                other = self._as_measured(row[np.newaxis], largest, sensors)[0, of]
                if np.sum(self._off(other, here) ** 2) < np.sum(self._off(values[here], here) ** 2):
                    values[here] = other
        return values, settled

    def _others(self, rig: Rig, sweep: DirectionResponse) -> list[tuple[int, Array]]:
        """What else the rig may do at a hold: on another branch, or as the mirror image.

        Which one of two mirrored motions a mass settles on hangs on the last digits of the rig.
        """
        others = list(sweep.other.items())
        oscillator, shaken = rig.oscillator, rig.periodic
        if oscillator.symmetric and shaken.half_wave and set(self.names) & _EXTREMES:
            held = HoldRows(sweep.rows)
            most, least = held.displacement_max, held.displacement_min
            uneven = np.flatnonzero(np.abs(most + least) > _UNEVEN * (most - least))
            every = [*((int(i), sweep.rows[i]) for i in uneven), *others]
            others += [(place, _mirrored(row)) for place, row in every]
        return others

    def _as_measured(
        self, rows: Array, largest: tuple[float, float], sensors: dict[str, float]
    ) -> Array:
        """What is measured of holds, a column a quantity."""
        held = HoldRows(rows)
        swing, push = held.displacement_excursion, held.acceleration_excursion
        columns = []
        for name in self.names:
            if name in _EXTREMES:
                of = getattr(held, _seen_as(name, sensors))
            elif name.startswith("eta"):
                of = swing / largest[0] if name == "eta_d" else push / largest[1]
            else:
                of = swing if name.startswith("displacement") else push
            columns.append(sensed(name, of, sensors))
        return np.stack(columns, axis=1)

    def _off(self, values: Array, here: NDArray[np.bool_]) -> Array:
        """Differences of asinh(y/floor), in the order of the points.

        They are those of logarithms where a value is large, and differences over the floor where
        it is not, so that negative values and zeros have one, too.
        """
        floor, measured = self.floor[here], self.points.value[here]
        return np.asarray(np.arcsinh(values / floor) - np.arcsinh(measured / floor))

    def test_points(self, rig: Rig, sensors: dict[str, float], unknowns: Array) -> TestPoints:
        """Each point beside what the rig has there."""
        values, _ = self.model(rig, sensors, self.followed(rig))
        return TestPoints(
            self.frequency,
            [self.directions[w] for w in self.points.way],
            [self.names[v] for v in self.points.variable],
            self.points.value,
            values,
            self._off(values, np.ones(len(values), dtype=bool)),
        )

    def residuals(
        self, rig: Rig, sensors: dict[str, float], unknowns: Array
    ) -> tuple[Array, NDArray[np.bool_]]:
        """Of points in shares of their value, of jumps in steps; and which have a derivative."""
        followed = self.followed(rig)
        values, settled = self.model(rig, sensors, followed)
        points = self._off(values, np.ones(len(values), dtype=bool))
        lost = ~np.isfinite(points)
        points[lost] = 3.0  # given up: as if it were off by a factor of 20
        points /= self.shares
        off = np.concatenate([sweep.off for sweep in followed])
        jumps = off / (_JUMP * self.steps)
        return np.concatenate([points, jumps]), np.concatenate([settled & ~lost, jumps > 0.0])


def _seen_as(name: str, sensors: dict[str, float]) -> str:
    """The extreme that a sensor shows as another one: one that is turned round, as its opposite."""
    kind, _, end = name.partition("_")
    if sensors[f"{kind}_scale"] >= 0.0:
        return name
    return f"{kind}_{'min' if end == 'max' else 'max'}"


def _mirrored(row: Array) -> Array:
    """Extremes of the mirror image of a motion."""
    own, image = HoldRows(row), HoldRows(row.copy())
    image.displacement_max[...], image.displacement_min[...] = (
        -own.displacement_min,
        -own.displacement_max,
    )
    image.acceleration_max[...], image.acceleration_min[...] = (
        -own.acceleration_min,
        -own.acceleration_max,
    )
    return image.array


def told_jumps(data: xr.Dataset) -> list[Jump]:
    """The jumps of measured curves that are no outlier and no steep part.

    What ends a hysteresis is a jump, if both quantities change; where one alone was measured, if
    the hysteresis is wider than one hold. So is any other break that is large enough.
    """
    seen = measured_features(data)
    both = {name.split("_")[-1 if name.startswith("eta") else 0][0] for name in map(str, data)} >= {
        "a",
        "d",
    }
    wide = [h for h in seen.hysteresis if both or h.low < h.high]
    ends = {(h.high, h.above) for h in wide} | {(h.below, h.low) for h in wide}
    least = max(APART, _NOISES * noise_of(swept(data)))  # of the means of what was held again
    jumps = []
    for jump in seen.jumps:
        step = (min(jump.before, jump.after), max(jump.before, jump.after))
        change = [abs(np.log(b / a)) for a, b in (jump.eta_a, jump.eta_d) if a > 0.0 and b > 0.0]
        if min(change, default=0.0) > (least if step in ends else _LARGE):
            jumps.append(jump)
    return jumps
