"""How two disturbances grow between linear laws: one of them, and the area that both span."""

from __future__ import annotations

import math

from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.carry import damping, disturb, disturb_area, press_area
from vibroimpact.engine.linear.tables import stiff_rate
from vibroimpact.engine.motion import LEFT, LIMIT, RIGHT, Stretch
from vibroimpact.engine.observers.growth import BOTH, DISSIPATION, FIRST, LENGTH, SHRUNK
from vibroimpact.engine.observers.tangent import DISTURBANCE, contraction, tie

AREA = 6
"""Components of the area that two disturbances span, see `carry.disturb_area`."""

_RANGE = 150.0  # twice this may pass between two looks; the square of exp(−300) is a number
_MANY, _MOST_PIECES = 1000, 1e15
"""Pieces of a stretch after which it is checked whether further ones do the same; and at most."""
_SAME = 1e-9
"""Relative change of a direction that counts as none."""


@kernel
def sizes(q: Vector, w: Vector, weight: float, mode: int) -> tuple[float, float]:
    """Sizes of a disturbance and of an area.

    The norm of a disturbance is weight² (u² + u_R² + u_L²) + v², that of an area the one that
    belongs to it. A pressed bumper moves with the mass and is left out.
    """
    w2 = weight * weight
    right = 0.0 if mode & RIGHT else 1.0
    left = 0.0 if mode & LEFT else 1.0
    length = math.sqrt((w2 * q[0] ** 2 + q[1] ** 2) + w2 * (right * q[2] ** 2 + left * q[3] ** 2))
    area = weight * math.sqrt(
        (w[0] ** 2 + right * w[3] ** 2 + left * w[4] ** 2)
        + w2 * (right * w[1] ** 2 + left * w[2] ** 2 + right * left * w[5] ** 2)
    )
    return length, area


@kernel
def scale(q: Vector, w: Vector, length: float, area: float) -> None:
    """Divide a disturbance and an area by sizes."""
    for j in range(DISTURBANCE):
        q[j] /= length
    for j in range(AREA):
        w[j] /= area


@kernel
def start_growth(plan: Vector, q: Vector, w: Vector, weight: float, mode: int) -> None:
    """A disturbance and an area of displacement and velocity, of unit size."""
    for j in range(DISTURBANCE):
        q[j] = 0.0
    for j in range(AREA):
        w[j] = 0.0
    q[0], q[1], w[0] = 1.0, weight, 1.0
    tie(mode, q, 0)
    press_area(mode, w)
    length, area = sizes(q, w, weight, mode)
    scale(q, w, length, area)


@kernel
def normalise(plan: Vector, q: Vector, w: Vector, weight: float, mode: int) -> tuple[float, float]:
    """Bring a disturbance and an area to unit size; return the logarithms of their sizes."""
    length, area = sizes(q, w, weight, mode)
    if length == 0.0:  # a rest forgets everything
        start_growth(plan, q, w, weight, mode)
        return -math.inf, -math.inf
    scale(q, w, length, area if area > 0.0 else 1.0)
    return math.log(length), math.log(area) if area > 0.0 else -math.inf


@kernel
def grow(plan: Vector, notes: Vector, q: Vector, w: Vector, stretch: Stretch) -> None:
    """Carry both through one stretch."""
    before, t, event, step, arrival, after = stretch
    weight = stiff_rate(plan)
    first, both, shrunk, length = notes[FIRST], notes[BOTH], notes[SHRUNK], notes[LENGTH]
    here = damping(plan, before.mode)
    # In pieces over which nothing shrinks below the range of numbers.
    pieces = 1 + int(min((here + weight) * step / _RANGE, _MOST_PIECES))
    piece = 0
    ago, direction, slope = 0, math.nan, math.nan
    while piece < pieces:
        piece += 1
        last = piece == pieces
        end, behind = (event, after) if last else (LIMIT, before)
        disturb(plan, before.mode, end, arrival, behind, step / pieces, q, 1)
        disturb_area(plan, before.mode, end, arrival, behind, step / pieces, w)
        shrunk += (here + weight) * step / pieces
        if shrunk > _RANGE or (last and (event == LIMIT or t + step >= length)):
            more, more_both = normalise(plan, q, w, weight, behind.mode)
            first += more
            both += more_both
            shrunk = 0.0
            if pieces > _MANY and not last:
                # A strongly damped rig: each further piece does the same to both.
                same = abs(q[0] * slope - q[1] * direction) <= _SAME * abs(q[0] * slope)
                alike = (pieces - 1 - piece) // (piece - ago)
                if same and piece > _MANY and alike > 0:
                    first += alike * more
                    both += alike * more_both
                    piece += alike * (piece - ago)
                ago, direction, slope = piece, q[0], q[1]
    notes[FIRST], notes[BOTH], notes[SHRUNK] = first, both, shrunk
    notes[DISSIPATION] += here * step + contraction(plan, event, after)
