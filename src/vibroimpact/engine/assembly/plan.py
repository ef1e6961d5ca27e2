"""From matrices and stops to a rig's vector, and to a plan."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from math import comb, inf
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.curved.laws import (
    BRANCHING,
    PUSHING,
    initial_stiffness,
    written,
)
from vibroimpact.engine.assembly.curved.layout import MEMORY_STOP
from vibroimpact.engine.assembly.mode import RATES_KEPT
from vibroimpact.engine.assembly.rates import rates_size
from vibroimpact.engine.assembly.tables import RULES, rules, table_size
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.state import FIRST
from vibroimpact.engine.stops import rebound
from vibroimpact.law_numbers import StopNumbers

Matrix = NDArray[np.float64]

GROUND = -1

TABLE_MODES = 32
"""Modes that may have tables. To make a table takes as long as some dozen events without it."""
TABLE_BYTES = 1 << 24
"""What their tables may take."""

RATES_MOST = 1 << 15
"""Numbers of the matrices of modes that are kept (`rates`)."""


class Stop(NamedTuple):
    """A stop between two bodies, met where u_left − u_right = gap.

    Parameters
    ----------
    left, right
        Indices of masses; GROUND for the base.
    gap
        In m.
    stiffness, damping
        Of a Kelvin–Voigt bumper (N/m, N s/m).
    restitution
        Of a rigid stop, 0 to 1; None for a bumper.
    behaviour, law
        Of a curved law (`curved.layout`): what it does, and its numbers as the vector of a rig of
        1 kg (`curved.plan`). Curved links stand behind all stops.
    wall
        Of a rigid stop: its numbers; None if they are `restitution` and `gap`.
    """

    left: int
    right: int
    gap: float
    stiffness: float = 0.0
    damping: float = 0.0
    restitution: float | None = None
    behaviour: int = 0
    law: tuple[float, ...] = ()
    wall: StopNumbers | None = None

    @property
    def rigid(self) -> bool:
        """Whether bodies cannot pass it."""
        return self.restitution is not None or self.wall is not None

    @property
    def kind(self) -> int:
        """What it is, as in a plan."""
        if self.behaviour:
            return at.PUSHING if self.behaviour in PUSHING else at.LINK
        return at.RIGID if self.rigid else at.KELVIN_VOIGT


class Drift(NamedTuple):
    """A pair of bodies whose drift u_right − u_left is observed.

    Parameters
    ----------
    left, right
        Indices of masses; GROUND for the base.
    damping
        Of the dashpot between them that is part of the damping matrix (N s/m): what it loses is
        told apart.
    """

    left: int
    right: int
    damping: float = 0.0


class Forcing(NamedTuple):
    """What drives the masses.

    Parameters
    ----------
    weights : ndarray, shape (degree of freedom, 2 × harmonics)
        Force (N) on each at unit amplitude, in front of the sine and cosine of each harmonic. Of a
        record: shape (degree of freedom,), the force per unit of its value.
    power
        The amplitude is multiplied by ω to this power (2: the amplitude of a displacement).
    interval
        Of a record (s): the length of its lines; 0 for harmonics.
    shaken
        Whether these are the forces of a base that moves, so that absolute accelerations are those
        of all other forces.
    """

    weights: Matrix
    power: int = 0
    interval: float = 0.0
    shaken: bool = False


def base_motion(
    mass: Matrix, influence: Vector, harmonics: Sequence[tuple[float, float]] = ((1.0, 0.0),)
) -> Forcing:
    """A shaken base, A_t = amplitude · Σ ratio_k sin(k θ + phase_k), as forces −M ι A_t."""
    force = -mass @ influence
    columns = [ratio * part for ratio, turn in harmonics for part in (np.cos(turn), np.sin(turn))]
    return Forcing(np.outer(force, columns), shaken=True)


def record_motion(mass: Matrix, influence: Vector, interval: float) -> Forcing:
    """A base that is shaken by a record, of straight lines."""
    return Forcing(-mass @ influence, interval=interval, shaken=True)


def make_vector(
    mass: Matrix,
    damping: Matrix,
    stiffness: Matrix,
    stops: Sequence[Stop],
    forcing: Forcing,
    constant: Vector | None = None,
    tables: bool = True,
    influence: Vector | None = None,
    drifts: Sequence[Drift] = (),
) -> Vector:
    """Write a rig's vector, with which its plan begins.

    Parameters
    ----------
    mass, damping, stiffness : ndarray, shape (n, n)
        kg, N s/m, N/m. `mass` must be positive definite.
    stops
        At most 52. Where events are simultaneous, the earlier in this list is the first.
    constant : ndarray, shape (n,)
        Constant forces (N).
    tables
        Whether modes may have tables (they only make the same motion faster).
    influence : ndarray, shape (n,)
        By how much a mass moves with the base, of which the force on the base is the sum. Default:
        1 for each.
    drifts
        What is observed besides.
    """
    n, count = len(mass), len(stops)
    curved = any(stop.behaviour for stop in stops)
    if bits(stops) > at.MOST_STOPS:
        raise ValueError(f"a mode of {bits(stops)} bits; at most {at.MOST_STOPS} are possible")
    inverse = np.diag(1.0 / np.diag(mass)) if _is_diagonal(mass) else np.linalg.inv(mass)
    record = forcing.interval > 0.0
    waves = 2 if record else forcing.weights.shape[1]
    width = 2 * n + waves + 1
    row = -(-(2 * (n + 1) + waves) // 8) * 8
    constant = np.zeros(n) if constant is None else constant
    influence = np.ones(n) if influence is None else influence

    header = np.zeros(at.HEADER)
    blocks: list[tuple[int, Vector]] = []
    end = at.HEADER

    def buffer(index: int, count: int) -> None:
        nonlocal end
        header[index] = end
        end += -(-count // 8) * 8

    def block(index: int, content: Vector) -> None:
        blocks.append((end, np.ravel(content)))
        buffer(index, content.size)

    header[[at.MASSES, at.STOPS, at.WAVES, at.RECORD]] = n, count, waves, record
    header[[at.POWER, at.INTERVAL, at.MODE]] = forcing.power, forcing.interval, -1
    header[[at.FLOW, at.SHAKEN, at.LOAD]] = par.MASSES, forcing.shaken, influence @ constant
    k, c = inverse @ stiffness, inverse @ damping
    shape = np.zeros((n, waves))
    shape[:, : 1 if record else waves] = inverse @ forcing.weights.reshape(n, -1)
    block(at.ROWS, _ranges((k != 0.0) | (c != 0.0)))
    block(at.STIFFNESS, k)
    block(at.DAMPING, c)
    block(at.SHAPE, shape)
    block(at.CONSTANT, inverse @ constant)
    block(at.MASS, mass)
    block(at.CARRIED, mass @ influence)
    closing = np.zeros((count, n))
    for one, stop in zip(closing, stops, strict=True):
        if stop.left != GROUND:
            one[stop.left] += 1.0
        if stop.right != GROUND:
            one[stop.right] -= 1.0
    response = closing @ inverse
    block(at.RESPONSE, response)
    block(at.COUPLING, response @ closing.T)
    images = partners(stops)
    of_stops = zip(stops, _ranges(response != 0.0), images, strict=True)
    block(at.STOP, np.array([_stop(stop, n, acts, other) for stop, acts, other in of_stops]))
    rigid = inverse @ closing.T @ np.diag([initial_stiffness(stop) for stop in stops]) @ closing
    header[at.DRIFTS] = len(drifts)
    ends = [[n if end == GROUND else end for end in one[:2]] + [one.damping] for one in drifts]
    block(at.DRIFT, np.array(ends, dtype=float))
    block(at.ROW_SUMS, np.stack([abs(k + rigid).sum(1), abs(c).sum(1)]))
    header[at.SYMMETRIC] = -1.0 not in images and not constant.any()
    header[at.CURVED] = sum(stop.behaviour != 0 for stop in stops)
    header[at.ROW] = row
    header[at.LINKS] = sum(stop.kind == at.LINK for stop in stops)
    nodes = 0
    if curved:
        tables = False
        laws, tape = written(stops)
        nodes = len(tape)
        header[at.BRANCHES] = sum(stop.behaviour in BRANCHING for stop in stops)
        block(at.LAWS, laws)
        block(at.TAPE, tape)
    header[at.NUMBERS] = end

    # What follows is only in a plan.
    buffer(at.ECONOMY, at.TERMS * (at.DEGREE + 1))
    buffer(at.PUSH, n * waves)
    buffer(at.PRESSED_LIST, count)
    buffer(at.RESTING_LIST, count)
    buffer(at.FACTOR, count * count)
    for index in (at.Y, at.START, at.END, at.PIECE_Y):
        buffer(index, width + count + 8)
    deformations = (at.DEFORMATION, at.START_DEFORMATION, at.END_DEFORMATION)
    for index in (*deformations, at.PIECE_DEFORMATION, at.ZEROS):
        buffer(index, 2 * count if curved else count)
    buffer(at.SERIES, at.TERMS * row + 16)
    buffer(at.FORCE_SERIES, at.TERMS * count)
    buffer(at.BERNSTEIN, 16)
    buffer(at.COEFFICIENTS, at.TERMS)
    buffer(at.NODES, nodes * at.TERMS)
    buffer(at.POINT, nodes * at.TERMS)
    buffer(at.KEPT_Y, 2 * (width + count + 8))
    buffer(at.ROOM, 64 * 16)
    buffer(at.WIDTHS, 64)
    buffer(at.SCRATCH, 8 * (width + count + 8))

    size = rates_size(n, count, waves)
    slots = 1 << max(min(RATES_MOST // size, 64).bit_length() - 1, 2)
    header[[at.RATES_SLOTS, at.RATES_SIZE]] = slots, size
    buffer(at.POWERS, at.TERMS)
    buffer(at.CODE, 3)
    buffer(at.INPUTS, 1 + count)
    buffer(at.OUTPUTS, 2 * (row + 2 * count + n + 16) + 48)
    buffer(at.RATES, slots * size)
    buffer(at.RATES_MODE, slots)
    buffer(at.RATE_OF, 2 * RATES_KEPT)

    # Modes with few pressed stops have tables, as many as there is room for.
    size = table_size(n, count, waves)
    slots = min(TABLE_MODES, TABLE_BYTES // (8 * size)) if tables else 0
    most, modes = -1, 0
    while most < count and modes + comb(count, most + 1) <= slots:
        most += 1
        modes += comb(count, most)
    header[[at.SLOTS, at.MOST_PRESSED, at.TABLE_SIZE]] = modes, most, size
    buffer(at.RULES, RULES if modes else 0)
    buffer(at.KEYS, 2 * max(modes, 1))
    buffer(at.SLOT_OF, 2 * max(modes, 1))
    buffer(at.TABLE_ROOM, (8 * 16 + 4) * (width + count + 8) if modes else 0)
    buffer(at.TABLE, modes * size)
    buffer(at.SEEN, (2 * n + 1 + len(drifts)) * 16 * width if modes else 0)
    header[at.LENGTH_OF_PLAN] = end

    vector = np.zeros(int(header[at.NUMBERS]))
    vector[: at.HEADER] = header
    for begin, content in blocks:
        vector[begin : begin + len(content)] = content
    return vector


def write_plan(vector: Vector, plan: Vector) -> None:
    """Write what a plan begins with, a rig's vector, and the constants that follow."""
    numbers = int(vector[at.NUMBERS])
    plan[:numbers] = vector[:numbers]
    for index, size in ((at.CODE, 3), (at.SERIES, at.TERMS * int(vector[at.ROW]) + 16)):
        plan[int(vector[index]) : int(vector[index]) + size] = 0.0
    constants = [(at.ECONOMY, _economy())]
    if vector[at.SLOTS] > 0.0:
        constants.append((at.RULES, _rules()))
    for index, numbers_there in constants:
        begin = int(vector[index])
        plan[begin : begin + len(numbers_there)] = numbers_there


def make_plan(*args: Any, **kwargs: Any) -> Vector:
    """Make a plan; the arguments are those of `make_vector`."""
    return plan_of(make_vector(*args, **kwargs))


def bits(stops: Sequence[Stop]) -> int:
    """Return how many bits a mode has."""
    return len(stops) + 2 * sum(stop.behaviour in BRANCHING for stop in stops)


def plan_of(vector: Vector) -> Vector:
    """Make the plan of a rig's vector."""
    plan = np.zeros(int(vector[at.LENGTH_OF_PLAN]))
    write_plan(vector, plan)
    return plan


def state_width(n: int, stops: int) -> int:
    """Length of a state with its clock."""
    return FIRST + 2 * n + stops + 3


def economy() -> Matrix:
    """Taylor coefficients on [0, 1] to Bernstein ones of degree 15, a row for each power.

    Exact up to this degree; higher powers are interpolated at Chebyshev points.
    """
    d = at.DEGREE
    x = 0.5 - 0.5 * np.cos(np.pi * (np.arange(d + 1) + 0.5) / (d + 1))
    j = np.arange(d + 1)
    basis = np.array([comb(d, i) for i in j]) * x[:, None] ** j * (1.0 - x[:, None]) ** (d - j)
    rows = [
        [comb(i, p) / comb(d, p) for i in j] if p <= d else np.linalg.solve(basis, x**p)
        for p in range(at.TERMS)
    ]
    return np.array(rows)


@cache
def _economy() -> Vector:
    return np.ravel(economy())


@cache
def _rules() -> Vector:
    return rules()  # type: ignore[no-any-return]


def partners(stops: Sequence[Stop]) -> list[float]:
    """Of each stop the number of the one that is its mirror image, −1 if there is none.

    Alike ones are paired in their order.
    """
    partner_of = [-1.0] * len(stops)
    for f, stop in enumerate(stops):
        image = stop._replace(left=stop.right, right=stop.left)
        if stop.kind == at.LINK:  # all laws are odd
            partner_of[f] = float(f)
            continue
        free = [g for g, other in enumerate(stops) if other == image and partner_of[g] < 0.0]
        if partner_of[f] < 0.0 and free:
            partner_of[f], partner_of[free[0]] = float(free[0]), float(f)
    return partner_of


def _stop(stop: Stop, n: int, acts: Vector, partner: float) -> list[float]:
    wall = stop.wall or (stop.restitution or 0.0, stop.gap)
    return [
        stop.left if stop.left != GROUND else n,
        stop.right if stop.right != GROUND else n,
        stop.gap,
        stop.kind,
        0.0 if stop.rigid else stop.stiffness,
        0.0 if stop.rigid else stop.damping,
        _relaxation(stop),
        *acts,
        partner,
        *rebound.written(wall),
    ]


def _relaxation(stop: Stop) -> float:
    if stop.kind == at.LINK or stop.behaviour == MEMORY_STOP:
        return 0.0  # its memory has a series
    return stop.stiffness / stop.damping if stop.damping > 0.0 and stop.kind == 0 else inf


def _is_diagonal(matrix: Matrix) -> bool:
    return bool((matrix == np.diag(np.diag(matrix))).all())


def _ranges(filled: NDArray[np.bool_]) -> Matrix:
    """The first of the places, and that after the last, of each row that are filled."""
    ranges = np.zeros((len(filled), 2))
    for i, row in enumerate(filled):
        places = np.flatnonzero(row)
        if len(places):
            ranges[i] = places[0], places[-1] + 1
    return ranges
