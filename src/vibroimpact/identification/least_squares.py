"""A fit as a least-squares problem: residuals and their derivatives over what is free."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol

import numpy as np
import scipy
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.identification.free_parameters import FitNumber, written
from vibroimpact.identification.overlay import TestPoints
from vibroimpact.model.rig import Rig

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_STEP = 1e-5
"""Of a parameter's size, for differences while searching."""
_FINE = 1e-6
"""For central differences, whose error is the square of it over that of the distance, as a share,
from a fold or a grazing; what is left of settling weighs 1e-12 over it."""
_BROKEN = 300.0
"""A value that changes by more than so many times the share of a parameter's change is not
followed: the difference reaches across a jump."""
LOST = 50.0
"""Residual of each point of a rig that cannot be: one that lies outside what a law accepts."""


class Test(Protocol):
    """What a test asks of a fit."""

    name: str
    kind: str
    data: xr.Dataset
    rig: Rig
    noise: float
    """Standard deviation of a point, as far as it is known beforehand."""
    weights: dict[str, float]
    """Noise of each quantity that is measured over that of the test."""

    @property
    def swing(self) -> float:
        """How far the mass was seen to move (m); 0 where that is not known."""

    @property
    def blind(self) -> bool:
        """Whether the mirror image of every rig has the same values."""

    def calibrate(self, sensors: dict[str, float]) -> None:
        """Begin from what the sensors are taken to show at first."""

    def reach(self, rig: Rig, unknowns: Array) -> tuple[float, float]:
        """How far the mass of a rig goes to the right and to the left (m)."""

    @property
    def count(self) -> int:
        """Number of its residuals."""

    @property
    def points_count(self) -> int:
        """Number of those that are measured values, which come first."""

    @property
    def shares(self) -> Array:
        """What a residual of 1 is of a point, as a share of what was measured."""

    @property
    def channels(self) -> list[str]:
        """Which quantity each measured value is of."""

    @property
    def groups(self) -> list[list[tuple[int, Flags]]]:
        """Unknowns that can be varied at once, each with the residuals that depend on it."""

    @property
    def unknowns(self) -> tuple[Array, Array]:
        """Numbers of the test itself that have to be found, such as initial states; their sizes."""

    def residuals(
        self, rig: Rig, sensors: dict[str, float], unknowns: Array
    ) -> tuple[Array, Flags]:
        """Its residuals, and which of them have a derivative."""

    def test_points(self, rig: Rig, sensors: dict[str, float], unknowns: Array) -> TestPoints:
        """Each point beside what the rig has there."""


class ResidualValues(NamedTuple):
    """Residuals at one place."""

    residuals: Array
    """In standard deviations."""
    smooth: Flags
    """Which have a derivative."""


class Problem:
    """All tests of a fit, and what is free in it.

    Parameters
    ----------
    free
        What is free; counted in its own sizes, so that a fit's numbers are of size 1.
    sigma
        Standard deviation of the points of each test.
    tail
        From how many standard deviations on a residual counts less than its square; infinite for
        plain least squares.
    """

    def __init__(
        self,
        tests: Sequence[Test],
        free: Sequence[FitNumber],
        ties: Mapping[str, str],
        sigma: Sequence[float],
        tail: float,
        weights: Array | None = None,
    ) -> None:
        self.tests, self.free, self.ties = list(tests), list(free), ties
        self.sigma, self.tail, self.weights = list(sigma), tail, weights
        self.scale = np.array(
            [one.scale for one in free] + [s for t in tests for s in t.unknowns[1]], dtype=float
        )
        self.low = np.array([one.low for one in free] + [-np.inf] * self._unknown) / self.scale
        self.high = np.array([one.high for one in free] + [np.inf] * self._unknown) / self.scale
        self.evaluations = 0

    @property
    def _unknown(self) -> int:
        return sum(len(t.unknowns[0]) for t in self.tests)

    def replaced(self, **changes: object) -> Problem:
        """The same with other tests, deviations, tail or weights."""
        now = {
            "tests": self.tests, "free": self.free, "ties": self.ties, "sigma": self.sigma,
            "tail": self.tail, "weights": self.weights,
        }  # fmt: skip
        return Problem(**{**now, **changes})  # type: ignore[arg-type]

    @property
    def _shares(self) -> Array:
        """What a standard deviation of each residual is as a share of a value; 0 of no value."""
        parts = []
        for test, sigma in zip(self.tests, self.sigma, strict=True):
            part = np.zeros(test.count)
            part[: test.points_count] = sigma * test.shares
            parts.append(part)
        return np.concatenate([*parts, np.zeros(self._priors)])

    @property
    def start(self) -> Array:
        """Where the rigs and tests are, in sizes."""
        unknowns = [t.unknowns[0] for t in self.tests]
        begin: Array = np.concatenate([[one.start for one in self.free], *unknowns]) / self.scale
        return begin

    @property
    def measured(self) -> Flags:
        """Which residuals are those of measured values."""
        parts = [np.arange(t.count) < t.points_count for t in self.tests]
        return np.concatenate([*parts, np.zeros(self._priors, dtype=bool)])

    @property
    def shares_of_curves(self) -> Array:
        """As `_shares` of the points of curves; 0 of all others."""
        parts = [np.full(t.count, float(t.kind == "curves")) for t in self.tests]
        kept: Array = self._shares * np.concatenate([*parts, np.zeros(self._priors)])
        return kept

    @property
    def jumps(self) -> Flags:
        """Which residuals are those of the jumps of curves."""
        parts = [(np.arange(t.count) >= t.points_count) & (t.kind == "curves") for t in self.tests]
        return np.concatenate([*parts, np.zeros(self._priors, dtype=bool)])

    @property
    def _priors(self) -> int:
        return sum(one.prior is not None for one in self.free)

    def rig_of(self, x: Array, test: Test) -> tuple[Rig, dict[str, float]]:
        """The rig, shaking and sensors of a test."""
        values = x[: len(self.free)] * self.scale[: len(self.free)]
        return written(self.free, values, test.rig, test.name, self.ties)

    def of_test(self, x: Array, number: int) -> Array:
        """The unknowns of a test."""
        sizes = [len(t.unknowns[0]) for t in self.tests]
        begin = len(self.free) + sum(sizes[:number])
        own = slice(begin, begin + sizes[number])
        unknowns: Array = x[own] * self.scale[own]
        return unknowns

    def values(self, x: Array) -> ResidualValues:
        """Residuals of all tests, then those of the priors."""
        self.evaluations += 1
        parts, smooth = [], []
        for number, (test, sigma) in enumerate(zip(self.tests, self.sigma, strict=True)):
            try:
                rig, sensors = self.rig_of(x, test)
                part, known = test.residuals(rig, sensors, self.of_test(x, number))
            except InputError:
                part, known = np.full(test.count, LOST * sigma), np.zeros(test.count, dtype=bool)
            part = part.copy()
            points = test.points_count
            part[:points] /= sigma
            if np.isfinite(self.tail):
                part[:points] = softened(part[:points], self.tail)
            parts.append(part)
            smooth.append(known)
        prior = [
            (value * one.scale - one.prior[0]) / one.prior[1]
            for one, value in zip(self.free, x, strict=False)
            if one.prior is not None
        ]
        residuals = np.concatenate([*parts, prior])
        if self.weights is not None:
            residuals = residuals * self.weights
        return ResidualValues(residuals, np.concatenate([*smooth, np.ones(len(prior), dtype=bool)]))

    def cost(self, x: Array) -> float:
        """Half the sum of squares."""
        return 0.5 * float(np.sum(self.values(x).residuals ** 2))

    def jacobian(
        self,
        x: Array,
        *,
        fine: bool = False,
        at: ResidualValues | None = None,
        only: Flags | None = None,
    ) -> Array:
        """Derivatives of the residuals by differences of settled motions.

        A motion that has settled is an orbit to 1e-12 of its size, so that a fine difference agrees
        with the derivative by the tangent map to five digits or more (decision 16). What did not
        settle has none, and gets 0.
        """
        here = self.values(x) if at is None else at
        matrix = np.zeros((len(here.residuals), len(x)))
        for group in self._columns(only):
            slopes = self._slope(x, [column for column, _ in group], here, fine=fine)
            for column, rows in group:
                matrix[rows, column] = slopes[rows]
        return matrix if only is None else matrix[:, only]

    def _columns(self, only: Flags | None) -> list[list[tuple[int, Flags]]]:
        """Columns that are found at once, each with the rows in which it is not 0."""
        whole = np.ones(len(self.measured), dtype=bool)
        groups = [[(column, whole)] for column in range(len(self.free))]
        column, row = len(self.free), 0
        for test in self.tests:
            for group in test.groups:
                here = []
                for number, rows in group:
                    wide = np.zeros(len(whole), dtype=bool)
                    wide[row : row + test.count] = rows
                    here.append((column + number, wide))
                groups.append(here)
            column += len(test.unknowns[0])
            row += test.count
        if only is None:
            return groups
        return [kept for group in groups if (kept := [one for one in group if only[one[0]]])]

    def _slope(self, x: Array, columns: list[int], here: ResidualValues, *, fine: bool) -> Array:
        """Columns of the derivatives, on the side without a break where there is one."""
        size = _FINE if fine else _STEP
        shares = self._shares
        slopes: list[Array] = []
        known = here.smooth
        for sign in (1.0, -1.0):
            other = x.copy()
            other[columns] += sign * size
            if (other < self.low).any() or (other > self.high).any():
                continue
            there = self.values(other)
            slopes.append((there.residuals - here.residuals) / (sign * size))
            known = known & there.smooth
            if not fine and not (np.abs(slopes[0]) * shares > _BROKEN).any():
                break
        if not slopes:  # its bounds leave no room for a difference
            return np.zeros(len(here.residuals))
        if len(slopes) == 2:
            right, left = slopes
            smaller = np.where(np.abs(right) < np.abs(left), right, left)
            broken = np.abs(right - left) * shares > _BROKEN
            slopes = [np.where(broken | (not fine), smaller, 0.5 * (right + left))]
        return np.where(known, slopes[0], 0.0)


def softened(residuals: Array, tail: float) -> Array:
    """Residuals whose squares grow as their size does beyond the tail."""
    share = (residuals / tail) ** 2
    return np.sign(residuals) * tail * np.sqrt(2.0 * share / (np.sqrt(1.0 + share) + 1.0))


def minimized(
    problem: Problem,
    x: Array,
    tolerances: tuple[float, float, float],
    most: int,
    *,
    among: Flags | None = None,
    precise: bool = False,
) -> tuple[Array, float]:
    """Return where the least squares from a place within the bounds end, and the cost there.

    Parameters
    ----------
    tolerances
        Of the cost, the place and the gradient, as of `scipy.optimize.least_squares`.
    most
        Evaluations of the residuals, without those of derivatives.
    among
        Unknowns that are varied. Default: all.
    precise
        Whether derivatives are central, and scale the unknowns.
    """
    free = np.ones(len(x), dtype=bool) if among is None else among
    seen: dict[bytes, ResidualValues] = {}

    def whole(y: Array) -> Array:
        full = x.copy()
        full[free] = y
        return full

    def values(y: Array) -> ResidualValues:
        key = y.tobytes()
        if key not in seen:
            seen.clear()  # the last one is all that a derivative needs
            seen[key] = problem.values(whole(y))
        return seen[key]

    low, high = problem.low[free], problem.high[free]
    done = scipy.optimize.least_squares(
        lambda y: values(y).residuals,
        np.clip(x[free], low, high),
        jac=lambda y: problem.jacobian(whole(y), fine=precise, at=values(y), only=free),
        bounds=(low, high),
        x_scale="jac" if precise else 1.0,
        **dict(zip(("ftol", "xtol", "gtol"), tolerances, strict=True)),
        max_nfev=most,
    )
    return whole(done.x), float(done.cost)
