"""From matrices and stops to a plan."""

from __future__ import annotations

from collections.abc import Sequence
from math import comb, inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.tables import rules, table_size
from vibroimpact.engine.jit import Vector

Matrix = NDArray[np.float64]

GROUND = -1

TABLE_MODES = 32
"""Modes that may have tables. To make a table takes as long as some hundred events without it."""
TABLE_BYTES = 1 << 24
"""What their tables may take."""


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
    """

    left: int
    right: int
    gap: float
    stiffness: float = 0.0
    damping: float = 0.0
    restitution: float | None = None


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


def make_plan(
    mass: Matrix,
    damping: Matrix,
    stiffness: Matrix,
    stops: Sequence[Stop],
    forcing: Forcing,
    constant: Vector | None = None,
    tables: bool = True,
) -> Vector:
    """Write a plan.

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
    """
    n, count = len(mass), len(stops)
    if count > at.MOST_STOPS:
        raise ValueError(f"{count} stops; at most {at.MOST_STOPS} are possible")
    inverse = np.diag(1.0 / np.diag(mass)) if _is_diagonal(mass) else np.linalg.inv(mass)
    record = forcing.interval > 0.0
    waves = 2 if record else forcing.weights.shape[1]
    width = 2 * n + waves + 1
    row = 2 * (n + 1)

    header = np.zeros(at.HEADER)
    blocks: list[tuple[int, Vector]] = []
    end = at.HEADER

    def block(index: int, content: Vector | int) -> None:
        nonlocal end
        content = np.zeros(content) if isinstance(content, int) else np.ravel(content)
        header[index] = end
        blocks.append((end, content))
        end += -(-len(content) // 8) * 8

    header[[at.MASSES, at.STOPS, at.WAVES, at.RECORD]] = n, count, waves, record
    header[[at.POWER, at.INTERVAL, at.MODE]] = forcing.power, forcing.interval, -1
    header[at.SHAKEN] = forcing.shaken
    k, c = inverse @ stiffness, inverse @ damping
    shape = np.zeros((n, waves))
    shape[:, : 1 if record else waves] = inverse @ forcing.weights.reshape(n, -1)
    block(at.ROWS, _ranges((k != 0.0) | (c != 0.0)))
    block(at.STIFFNESS, k)
    block(at.DAMPING, c)
    block(at.SHAPE, shape)
    block(at.PUSH, n * waves)
    block(at.CONSTANT, inverse @ (np.zeros(n) if constant is None else constant))
    closing = np.zeros((count, n))
    for one, stop in zip(closing, stops, strict=True):
        if stop.left != GROUND:
            one[stop.left] += 1.0
        if stop.right != GROUND:
            one[stop.right] -= 1.0
    response = closing @ inverse
    block(at.RESPONSE, response)
    block(at.COUPLING, response @ closing.T)
    block(
        at.STOP,
        np.array([_stop(s, n, r) for s, r in zip(stops, _ranges(response != 0.0), strict=True)]),
    )
    block(at.ROW_SUMS, np.stack([abs(k).sum(1), abs(c).sum(1)]))
    block(at.ECONOMY, economy())
    block(at.PRESSED_LIST, count)
    block(at.RESTING_LIST, count)
    block(at.FACTOR, count * count)
    for vector in (at.Y, at.START, at.END, at.PIECE_Y):
        block(vector, width + count + 8)
    deformations = (at.DEFORMATION, at.START_DEFORMATION, at.END_DEFORMATION)
    for vector in (*deformations, at.PIECE_DEFORMATION, at.ZEROS):
        block(vector, count)
    block(at.SERIES, at.TERMS * row)
    block(at.WAVE_SERIES, at.TERMS * waves)
    block(at.FORCE_SERIES, at.TERMS * count)
    block(at.BERNSTEIN, 16)
    block(at.COEFFICIENTS, at.TERMS)
    block(at.ROOM, 64 * 16)
    block(at.WIDTHS, 64)
    block(at.SCRATCH, 8 * (width + count + 8))

    # Modes with few pressed stops have tables, as many as there is room for.
    size = table_size(n, count, waves)
    slots = min(TABLE_MODES, TABLE_BYTES // (8 * size)) if tables else 0
    most, modes = -1, 0
    while most < count and modes + comb(count, most + 1) <= slots:
        most += 1
        modes += comb(count, most)
    header[[at.SLOTS, at.MOST_PRESSED, at.TABLE_SIZE]] = modes, most, size
    block(at.KEYS, 2 * max(modes, 1))
    block(at.SLOT_OF, 2 * max(modes, 1))
    block(at.RULES, rules() if modes else 0)
    block(at.TABLE_ROOM, (8 * 16 + 4) * (width + count + 8) if modes else 0)
    block(at.TABLE, modes * size)

    plan = np.zeros(end)
    plan[: at.HEADER] = header
    for begin, content in blocks:
        plan[begin : begin + len(content)] = content
    return plan


def state_width(n: int, stops: int) -> int:
    """Length of a state with its clock."""
    return at.PARTS + 2 * n + stops + 3


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


def _stop(stop: Stop, n: int, acts: Vector) -> list[float]:
    rigid = stop.restitution is not None
    return [
        stop.left if stop.left != GROUND else n,
        stop.right if stop.right != GROUND else n,
        stop.gap,
        at.RIGID if rigid else at.KELVIN_VOIGT,
        0.0 if rigid else stop.stiffness,
        0.0 if rigid else stop.damping,
        stop.restitution if stop.restitution is not None else 0.0,
        stop.stiffness / stop.damping if stop.damping > 0.0 and not rigid else inf,
        *acts,
    ]


def _is_diagonal(matrix: Matrix) -> bool:
    return bool((matrix == np.diag(np.diag(matrix))).all())


def _ranges(filled: NDArray[np.bool_]) -> Matrix:
    """The first of the places, and that after the last, of each row that are filled."""
    found = np.zeros((len(filled), 2))
    for i, row in enumerate(filled):
        places = np.flatnonzero(row)
        if len(places):
            found[i] = places[0], places[-1] + 1
    return found
