"""The pieces of an assembly's motion: exact ranges and integrals of what each of them shows.

Between two events the engine has a power series of each channel on each piece, with 28 terms at
most. The motion is followed once for each of some Chebyshev nodes, at which all channels are shown.
The polynomial through them is that series up to rounding, so that extremes and integrals are exact.
"""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.polynomial.legendre import legvander
from numpy.typing import NDArray
from scipy.special import spherical_jn

from vibroimpact.engine.assembly import layout
from vibroimpact.engine.assembly.entries import follow_sections
from vibroimpact.engine.assembly.plan import plan_of
from vibroimpact.engine.status import Status
from vibroimpact.model import Assembly, Record, Repeated
from vibroimpact.response.assembly_rig import assembly_numbers, link_parts

_Array = NDArray[np.float64]
_Complex = NDArray[np.complex128]

NODES = 22
"""For integrals of products: their coefficient of order 22 is at most 1.25²²/22! = 1e-19."""
NODES_OF_RANGES = 16
"""For extremes: 2 (2.5/4)¹⁶/16! = 5e-17."""
_GRID = 4
"""Places for each node, between which a derivative changes its sign once at most."""
_HALVINGS = 30
"""Of such an interval: its extreme is then right to the square of 1e-10."""
_MOST = 1e200
"""Displacements and velocities together at which the engine gives a motion up."""


class _Rule(NamedTuple):
    """What follows from the values at Chebyshev nodes of [0, 1], both ends included."""

    tau: _Array
    slope: _Array
    """From values to the coefficients of the derivative."""
    coefficients: _Array
    """From values to those of the polynomial."""
    weights: _Array
    """Of the integral over [0, 1]."""
    legendre: _Array
    """From values to the coefficients of a Legendre series."""
    grid: _Array
    """Places in [−1, 1]."""
    on_grid: _Array
    """From values to the derivative there."""


@cache
def _rule(count: int) -> _Rule:
    x = -np.cos(np.pi * np.arange(count) / (count - 1))
    coefficients: _Array = np.linalg.inv(chebyshev.chebvander(x, count - 1)).astype(np.float64)
    slope = chebyshev.chebder(coefficients).astype(np.float64)
    whole = chebyshev.chebint(coefficients).astype(np.float64)
    weights: _Array = 0.5 * (whole.sum(axis=0) - (-1.0) ** np.arange(count + 1) @ whole)
    grid = -np.cos(np.pi * np.arange(_GRID * count) / (_GRID * count - 1))
    on_grid: _Array = chebyshev.chebvander(grid, count - 2) @ slope
    legendre: _Array = np.linalg.inv(legvander(x, count - 1)).astype(np.float64)
    return _Rule(0.5 + 0.5 * x, slope, coefficients, weights, legendre, grid, on_grid)


def integrals(values: _Array) -> _Array:
    """Return the means of functions over pieces, from their values at the nodes (last axis)."""
    found: _Array = values @ _rule(values.shape[-1]).weights
    return found


def fourier_transforms(values: _Array, begin: _Array, length: _Array, rates: _Array) -> _Complex:
    """Return the integrals of functions times exp(−iνt) over all pieces.

    With x from −1 to 1, a Legendre polynomial has ∫ P_k exp(−iax) dx = 2 (−i)^k j_k(a), where j_k
    is a spherical Bessel function.

    Parameters
    ----------
    values : ndarray, shape (piece, function, node)
        Their values at the nodes.
    begin, length : ndarray, shape (piece,)
        Of the pieces (s).
    rates : ndarray, shape (rate,)
        ν (1/s).

    Returns
    -------
    ndarray, shape (rate, function)
    """
    series = values @ _rule(values.shape[-1]).legendre.T
    order = np.arange(values.shape[-1])
    lengths, which = np.unique(length, return_inverse=True)
    found = np.empty((len(rates), values.shape[1]), dtype=complex)
    for i, rate in enumerate(rates):
        means = (-1j) ** order * spherical_jn(order, 0.5 * rate * lengths[:, np.newaxis])
        turned = length * np.exp(-1j * rate * (begin + 0.5 * length))
        found[i] = np.einsum("p,pk,pfk->f", turned, means[which], series, optimize=True)
    return found


def ranges(values: _Array) -> _Array:
    """Return the least and the largest value of functions on pieces.

    Parameters
    ----------
    values : ndarray, shape (*function, node)
        Their values at the nodes.

    Returns
    -------
    ndarray, shape (*function, 2)
    """
    rule = _rule(values.shape[-1])
    flat = values.reshape(-1, values.shape[-1])
    found = np.stack([flat.min(axis=1), flat.max(axis=1)], axis=1)
    slopes = flat @ rule.on_grid.T
    row, at = np.nonzero(slopes[:, :-1] * slopes[:, 1:] < 0.0)
    if len(row):
        coefficients = flat[row] @ rule.coefficients.T
        slope = flat[row] @ rule.slope.T
        low, high = rule.grid[at], rule.grid[at + 1]
        begins = slopes[row, at] > 0.0
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            same = (_each(middle, slope) > 0.0) == begins
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        extreme = _each(0.5 * (low + high), coefficients)
        np.minimum.at(found[:, 0], row, extreme)
        np.maximum.at(found[:, 1], row, extreme)
    return found.reshape(*values.shape[:-1], 2)


def _each(x: _Array, coefficients: _Array) -> _Array:
    """Evaluate a Chebyshev series of each row at a place of its own (Clenshaw)."""
    one, two = np.zeros_like(x), np.zeros_like(x)
    for column in coefficients.T[:0:-1]:
        one, two = column + 2.0 * x * one - two, one
    return coefficients[:, 0] + x * one - two


class Seen(NamedTuple):
    """What is seen of the pieces of some sections, at the nodes."""

    section: NDArray[np.int64]
    begin: _Array
    """Time since the section began (s)."""
    end: _Array
    values: _Array
    """Channels, shape (piece, channel, node)."""
    log: _Array
    """Events, as of `follow_sections`."""
    status: Status
    masses: int
    stops: int
    parts: int
    """Stops, then the curved parts of links."""

    def _of(self, first: int, count: int) -> _Array:
        return self.values[:, first : first + count]

    @property
    def displacement(self) -> _Array:
        """Of each mass, shape (piece, mass, node)."""
        return self._of(0, self.masses)

    @property
    def velocity(self) -> _Array:
        """Of each mass, relative to the base."""
        return self._of(self.masses, self.masses)

    @property
    def acceleration(self) -> _Array:
        """Of each mass, absolute."""
        return self._of(3 * self.masses, self.masses)

    @property
    def clearance(self) -> _Array:
        """Of each stop; 0 throughout while it is touched."""
        return self._of(4 * self.masses, self.stops)

    @property
    def force(self) -> _Array:
        """Of each stop; 0 while it is free."""
        return self._of(4 * self.masses + self.parts, self.stops)

    @property
    def deformation(self) -> _Array:
        """Of each stop."""
        return self._of(4 * self.masses + 2 * self.parts, self.stops)


class Follower:
    """Follows an assembly over sections, and sees each piece at the nodes.

    Parameters
    ----------
    assembly, shaking
        What vibrates, and what shakes it.
    max_events
        In one section, at which the motion is given up.
    nodes
        `NODES` or `NODES_OF_RANGES`.
    """

    def __init__(
        self,
        assembly: Assembly,
        shaking: Repeated | Record,
        max_events: int,
        nodes: int = NODES,
    ) -> None:
        self.plan = plan_of(assembly_numbers(assembly, shaking))
        stops = len(assembly.stops)
        self.shape = len(assembly.names), stops, stops + len(link_parts(assembly))
        self.forcing = forcing_size(shaking)
        self.max_events = max_events
        self.tau = _rule(nodes).tau
        self._rows = np.empty((1024, 2 + 4 * self.shape[0] + 3 * self.shape[2]))

    def over(self, state: _Array, lines: _Array) -> Seen:
        """Follow a motion over sections, in place, and return what is seen of them."""
        log = np.empty((self.max_events + 1 + 64 * len(lines), 4))
        rows, status = [], Status.DONE
        for tau in self.tau:
            count, here, found = self._at(state, lines, float(tau), log)
            rows.append(found)
        if count < 0:
            status, count = why_given_up(self.plan), 0
        state[:] = here
        first, last = rows[0], rows[-1]
        values = np.stack([found[:, 2:] for found in rows], axis=-1)
        section = first[:, 0].astype(np.int64)
        return Seen(section, first[:, 1], last[:, 1], values, log[:count], status, *self.shape)

    def _at(
        self, state: _Array, lines: _Array, tau: float, log: _Array
    ) -> tuple[int, _Array, _Array]:
        """Return the number of events, the state at the end, and the rows of all pieces."""
        while True:
            here = state.copy()
            self._rows[:, 0] = -1.0
            log[:, 0] = -1.0
            count = follow_sections(
                self.plan,
                *self.forcing,
                here,
                lines,
                max_events=self.max_events,
                log=log,
                samples=self._rows,
                tau=tau,
            )
            if count > len(log):
                log = np.empty((count, 4))
                continue
            if self._rows[-1, 0] < 0.0:
                return count, here, self._rows[self._rows[:, 0] >= 0.0].copy()
            self._rows = np.empty((2 * len(self._rows), self._rows.shape[1]))


def why_given_up(plan: _Array) -> Status:
    """Return why `follow_sections` gave a motion up, by its last state, which the plan keeps.

    The log does not tell: it has neither the event that is one too many nor the turns of curved
    links, which count as well.
    """
    state = plan[int(plan[layout.Y]) :][: 2 * int(plan[layout.MASSES])]
    within = bool(np.abs(state).sum() < _MOST)
    return Status.TOO_MANY_EVENTS if within else Status.NOT_FINITE


def forcing_size(shaking: Repeated | Record) -> tuple[float, float]:
    """Return the amplitude and ω (rad/s) of what shakes an assembly; a record has no ω."""
    if isinstance(shaking, Record):
        return shaking.peak, 0.0
    return shaking.amplitude, shaking.angular_frequency


def final_mode(state: _Array) -> int:
    """Return the stops that are touched in a state of the engine, a bit each."""
    mode = state[layout.STATE_MODE]
    return 0 if math.isnan(mode) else int(mode)
